!> The states of rotor and pads: where they stand, and the balance of forces in them.
program test_state_layout
   use kinds, only: wp
   use text, only: to_text
   use rigid_rotor, only: journal_motion
   use state_layout, only: state_layout_type, element_layout_type, new_element_layout, new_state_layout, pad_state, &
      & tilt, pivot_deflection, most_coordinates
   use case_inputs, only: case_type
   use equations_of_motion, only: machine_model, new_machine_model
   use force_balance, only: forces, force_derivatives, masses
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)
   integer, parameter :: pads = 3, none(0) = [integer ::]
   logical, parameter :: choices(2) = [.false., .true.]
   integer :: i, k, l
   character(len=*), parameter :: motions(3) = [character(len=14) :: 'tilting_radial', 'tilting_only', 'fixed']
   character(len=*), parameter :: frictions(3) = [character(len=12) :: 'none', 'bengisu_akay', 'lugre']
   type(element_layout_type) :: of, other

   do k = 1, size(choices)
      do l = 1, size(choices)
         of = new_element_layout(pads, kinds(choices(k)), choices(l))
         other = new_element_layout(5, kinds(.not. choices(k)), choices(l))
         ! a rigid journal, and other rotors; bearings of two kinds and numbers of pads
         call check_layout(new_state_layout(4, [of], [1]))
         call check_layout(new_state_layout(10, [of], [1]))
         call check_layout(new_state_layout(8, [of, other], [1, 2]))
         call check_layout(new_state_layout(12, [new_element_layout(2, none, choices(l)), of, of], [1, 2, 3]))
         ! pads with a third and a fourth displacement; elements on one pair, of which one has no displacements
         call check_layout(new_state_layout(8, [of, new_element_layout(2, [tilt, 3, 4], choices(l))], [1, 2]))
         call check_layout(new_state_layout(8, [of, other, new_element_layout(1, none, .false.), of], [2, 1, 2, 1]))
         if (runs('fixed_pads')) call fixed_pads(new_state_layout(4, [new_element_layout(pads, none, choices(l))], [1]))
      end do
   end do
   do i = 1, size(motions)
      do k = 1, size(frictions)
         if (motions(i) == 'fixed' .and. k > 1) cycle
         if (runs('against_motion')) call against_motion(motions(i), frictions(k))
      end do
   end do
   call report()

contains

   subroutine check_layout(layout)
      type(state_layout_type), intent(in) :: layout
      if (runs('indices')) call indices(layout)
      if (runs('states_of_pads')) call states_of_pads(layout)
   end subroutine check_layout

   !> Of pads that tilt, on rigid or on flexible pivots.
   pure function kinds(flexible)
      logical, intent(in) :: flexible
      integer, allocatable :: kinds(:)
      kinds = [tilt]
      if (flexible) kinds = [tilt, pivot_deflection]
   end function kinds

   pure function what(layout)
      type(state_layout_type), intent(in) :: layout
      character(len=:), allocatable :: what
      integer :: b
      what = ', rotor of '//to_text(layout%rotor)
      do b = 1, size(layout%elements)
         what = what//', bearing of '//to_text(layout%elements(b)%pads)
         if (layout%elements(b)%has(pivot_deflection)) what = what//' with pivot deflections'
         if (layout%elements(b)%bristles) what = what//' with bristles'
      end do
   end function what

   !> Rotor, then the pads one after another: every state has one index, and every position a rate.
   subroutine indices(layout)
      type(state_layout_type), intent(in) :: layout
      integer, allocatable :: found(:), bristles(:), all_pads(:), own(:)
      integer :: b, i, k, last
      found = [(i, i=1, layout%rotor)]
      allocate (bristles(0), own(0))
      last = layout%rotor
      do b = 1, size(layout%elements)
         associate (of => layout%elements(b))
            call expect(of%states_before == last, 'bearing behind bearing'//what(layout))
            last = last + of%pads*of%per_pad
            call expect(all(of%all_pads() == sum(layout%elements(:b - 1)%pads) + [(i, i=1, of%pads)]), &
               & 'pads of all bearings are counted'//what(layout))
            if (of%coordinates == 0) cycle
            all_pads = [(i, i=1, of%pads)]
            call expect(of%per_pad == 2*of%coordinates + merge(1, 0, of%bristles), 'states of a pad'//what(layout))
            call expect(all(of%before(all_pads) == of%states_before + of%per_pad*(all_pads - 1)), &
               & 'states before'//what(layout))
            found = [found, ((of%before(i) + k, k=1, 2*of%coordinates), i=1, of%pads)]
            if (of%bristles) bristles = [bristles, of%bristle(all_pads)]
            own = [own, (of%own_positions(i), i=1, of%pads)]
         end associate
      end do
      call expect(layout%n == last, 'number of states'//what(layout))
      call expect_each_once(layout, [found, bristles], 'all states')
      call expect_each_once(layout, [layout%positions(), layout%rates(), bristles], 'positions, rates and bristles')
      call expect(all([[(i, i=1, layout%rotor/2)], own] == [(i, i=1, layout%n_positions())]), &
         & 'every displacement is the rotor''s or a pad''s'//what(layout))
      associate (positions => layout%positions(), rates => layout%rates())
         call expect(size(positions) == size(rates), 'each position has a rate'//what(layout))
         call expect(all(positions(:layout%rotor/2) == [(i, i=1, layout%rotor/2)]) &
            & .and. all(rates(:layout%rotor/2) == positions(:layout%rotor/2) + layout%rotor/2), &
            & 'displacements and then rates of the rotor'//what(layout))
         call expect(all(rates(layout%rotor/2 + 1:) == positions(layout%rotor/2 + 1:) + 1), &
            & 'rates of the pads stand behind what they are rates of'//what(layout))
      end associate
   end subroutine indices

   !> Fixed pads have no states: those of the rotor are all, and what is put is lost.
   subroutine fixed_pads(layout)
      type(state_layout_type), intent(in) :: layout
      type(pad_state) :: states(pads)
      real(wp) :: y(layout%n)
      integer :: i
      call expect(layout%n == layout%rotor .and. layout%n_positions() == layout%rotor/2, 'the rotor''s alone')
      call expect(all([layout%positions(), layout%rates()] == [(i, i=1, layout%n)]), 'positions and rates of the rotor')
      states = pad_state(1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp)
      y = -1
      call layout%elements(1)%put_pads(states, y)
      call expect(all(y < 0), 'nothing is put')
      states = layout%elements(1)%pad_states(y)
      do i = 1, pads
         call expect(all(abs([states(i)%x, states(i)%v, states(i)%bristle]) <= 0), 'all is 0')
      end do
   end subroutine fixed_pads

   subroutine expect_each_once(layout, found, name)
      type(state_layout_type), intent(in) :: layout
      integer, intent(in) :: found(:)
      character(len=*), intent(in) :: name
      integer :: counted(layout%n), i
      counted = 0
      do i = 1, size(found)
         counted(found(i)) = counted(found(i)) + 1
      end do
      call expect(all(counted == 1), name//', each once'//what(layout))
   end subroutine expect_each_once

   !> What a layout has comes back, the rest as 0; other states stay as they are.
   subroutine states_of_pads(layout)
      type(state_layout_type), intent(in) :: layout
      type(pad_state) :: states(layout%pads)
      real(wp) :: y(layout%n)
      integer :: b, i, k
      do i = 1, layout%pads
         states(i)%x = [(10.0_wp*k + i, k=1, most_coordinates)]
         states(i)%v = [(100.0_wp*k + i, k=1, most_coordinates)]
         states(i)%bristle = 1000.0_wp + i
      end do
      y = -1
      call layout%put_all_pads(states, y)
      call expect(all(y(:layout%rotor) < 0) .and. all(y(layout%rotor + 1:) > 0), 'pads alone are put'//what(layout))
      do b = 1, size(layout%elements)
         associate (of => layout%elements(b))
            call come_back(of, states(of%all_pads()), of%pad_states(y), y, what(layout))
         end associate
      end do
   end subroutine states_of_pads

   subroutine come_back(of, put, back, y, what)
      type(element_layout_type), intent(in) :: of
      type(pad_state), intent(in) :: put(:), back(:)
      real(wp), intent(in) :: y(:)
      character(len=*), intent(in) :: what
      type(pad_state) :: expected
      integer :: i, k
      do i = 1, of%pads
         expected = pad_state()
         do k = 1, of%coordinates
            expected%x(of%kind(k)) = put(i)%x(of%kind(k))
            expected%v(of%kind(k)) = put(i)%v(of%kind(k))
         end do
         if (of%bristles) expected%bristle(:of%rotations) = put(i)%bristle(:of%rotations)
         call expect_close(maxval(abs([back(i)%x - expected%x, back(i)%v - expected%v, back(i)%bristle &
            & - expected%bristle])), 0.0_wp, 0.0_wp, 'what a pad has comes back, the rest is 0'//what)
         do k = 1, of%coordinates
            call expect_close(y(of%before(i) + 2*k - 1), put(i)%x(of%kind(k)), 0.0_wp, &
               & 'displacement '//to_text(k)//' by its index'//what)
            call expect_close(y(of%before(i) + 2*k), put(i)%v(of%kind(k)), 0.0_wp, &
               & 'rate '//to_text(k)//' by its index'//what)
         end do
         if (of%bristles) call expect_close(y(of%bristle(i)), put(i)%bristle(1), 0.0_wp, &
            & 'bristles by their index'//what)
      end do
   end subroutine come_back

   !> Sums of some ten numbers, and a pad's masses, whose inverse loses a digit or two: 1e-12 of each row's largest
   !> entry.
   subroutine against_motion(motion, friction)
      character(len=*), intent(in) :: motion, friction
      type(case_type) :: inputs
      type(machine_model) :: model
      real(wp), allocatable :: y(:), rates(:), jacobian(:, :), expected(:), matrix(:, :), over_positions(:, :)
      real(wp), allocatable :: over_rates(:, :)
      real(wp), parameter :: t = 0.0123_wp
      character(len=:), allocatable :: what
      logical :: ok
      integer :: n, i
      what = trim(motion)//', '//trim(friction)
      inputs = case_type()
      inputs%bearings(1)%pads%motion = trim(motion)
      inputs%bearings(1)%friction%model = trim(friction)
      inputs%bearings(1)%pads%centre_tangential = [3e-3_wp, -6e-3_wp]
      inputs%bearings(1)%pads%mass = [0.8_wp, 0.6_wp]
      model = new_machine_model(inputs)
      y = model%state(journal_motion([-4e-5_wp, 2e-6_wp], [1e-3_wp, -2e-3_wp]), &
         & [(pad_state(4e-4_wp*(i - 1), between(0.3_wp, 0.6_wp), 7e-6_wp, 1e-3_wp, 1e-7_wp), i=1, 2)])
      n = model%layout%n_positions()
      allocate (rates(model%n), jacobian(model%n, model%n), over_positions(n, n), over_rates(n, n))
      call model%rhs(t, y, rates, ok)
      call expect(ok, 'a state with films, '//what)
      expected = forces(model, t, y)
      associate (x => model%layout%positions(), v => model%layout%rates())
         call expect(size(expected) == size(x), 'a force for each position, '//what)
         call compare(spread(matmul(masses(model), rates(v)), 2, 1), spread(expected, 2, 1), 'forces, '//what)
         call model%rhs_and_jacobian(t, y, rates, jacobian, ok)
         call force_derivatives(model, over_positions, over_rates)
         matrix = matmul(masses(model), jacobian(v, x))
         call compare(matrix, over_positions, 'derivatives over positions, '//what)
         matrix = matmul(masses(model), jacobian(v, v))
         call compare(matrix, over_rates, 'derivatives over rates, '//what)
      end associate
   end subroutine against_motion

   subroutine compare(found, expected, what)
      real(wp), intent(in) :: found(:, :), expected(:, :)
      character(len=*), intent(in) :: what
      integer :: row
      do row = 1, size(found, 1)
         call expect_close(maxval(abs(found(row, :) - expected(row, :))), 0.0_wp, &
            & 1e-12_wp*maxval(abs(expected(row, :))), 'row '//to_text(row)//', '//what)
      end do
   end subroutine compare
end program test_state_layout
