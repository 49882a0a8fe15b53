!> The states of a bearing: where they stand, and the balance of forces in them.
program test_state_layout
   use kinds, only: wp
   use text, only: to_text
   use rigid_journal, only: journal_motion
   use kinematics, only: pad_state, columns, tilt_column
   use state_layout, only: state_layout_type, new_state_layout, at_tilt, at_tilt_rate, at_deflection, at_deflection_rate
   use case_inputs, only: case_type
   use equations_of_motion, only: bearing_model, new_bearing_model
   use force_balance, only: forces, force_derivatives, masses
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)
   integer, parameter :: pads = 3
   !> That of a rigid journal, and another.
   integer, parameter :: rotors(*) = [4, 10]
   logical, parameter :: choices(2) = [.false., .true.]
   integer :: i, k, l
   character(len=*), parameter :: motions(3) = [character(len=14) :: 'tilting_radial', 'tilting_only', 'fixed']
   character(len=*), parameter :: frictions(3) = [character(len=12) :: 'none', 'bengisu_akay', 'lugre']

   do i = 1, size(rotors)
      do k = 1, size(choices)
         do l = 1, size(choices)
            associate (layout => new_state_layout(rotors(i), pads, .true., choices(k), choices(l)))
               if (runs('indices')) call indices(layout)
               if (runs('states_of_pads')) call states_of_pads(layout)
            end associate
            if (runs('fixed_pads')) call fixed_pads(new_state_layout(rotors(i), pads, .false., choices(k), choices(l)))
         end do
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

   pure function what(layout)
      type(state_layout_type), intent(in) :: layout
      character(len=:), allocatable :: what
      what = ', rotor of '//to_text(layout%rotor)
      if (layout%radial) what = what//', pivot deflections'
      if (layout%bristles) what = what//', bristles'
   end function what

   !> Rotor, then the pads one after another: every state has one index, and every position a rate.
   subroutine indices(layout)
      type(state_layout_type), intent(in) :: layout
      integer :: all_pads(pads), own, i
      integer, allocatable :: found(:)
      own = merge(4, 2, layout%radial) + merge(1, 0, layout%bristles)
      call expect(layout%per_pad == own .and. layout%n == layout%rotor + pads*own, 'number of states'//what(layout))
      all_pads = [(i, i=1, pads)]
      call expect(all(layout%before(all_pads) == layout%rotor + own*(all_pads - 1)), 'states before'//what(layout))
      found = [[(i, i=1, layout%rotor)], layout%before(all_pads) + at_tilt, layout%before(all_pads) + at_tilt_rate]
      if (layout%radial) found = [found, layout%before(all_pads) + at_deflection, &
         & layout%before(all_pads) + at_deflection_rate]
      if (layout%bristles) found = [found, layout%bristle(all_pads)]
      call expect_each_once(layout, found, 'all states')
      found = [layout%positions(), layout%rates()]
      if (layout%bristles) found = [found, layout%bristle(all_pads)]
      call expect_each_once(layout, found, 'positions, rates and bristles')
      associate (positions => layout%positions(), rates => layout%rates())
         call expect(size(positions) == size(rates), 'each position has a rate'//what(layout))
         call expect(all(positions(:layout%rotor/2) == [(i, i=1, layout%rotor/2)]) &
            & .and. all(rates(:layout%rotor/2) == positions(:layout%rotor/2) + layout%rotor/2), &
            & 'displacements and then rates of the rotor'//what(layout))
         call expect(all(rates(layout%rotor/2 + 1:) == positions(layout%rotor/2 + 1:) + 1), &
            & 'rates of the pads stand behind what they are rates of'//what(layout))
      end associate
   end subroutine indices

   !> Fixed pads have no states: those of the rotor are all, what is put is lost, and only the journal changes.
   subroutine fixed_pads(layout)
      type(state_layout_type), intent(in) :: layout
      type(pad_state) :: states(pads)
      real(wp) :: y(layout%n), change(columns, pads)
      integer :: i
      call expect(layout%n == layout%rotor .and. layout%n_positions() == layout%rotor/2, 'the rotor''s alone')
      call expect(all([layout%positions(), layout%rates()] == [(i, i=1, layout%n)]), 'positions and rates of the rotor')
      states = pad_state(1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp)
      y = -1
      call layout%put_pads(states, y)
      call expect(all(y < 0), 'nothing is put')
      states = layout%pad_states(y)
      call expect(all(abs([states%tilt, states%tilt_rate, states%pivot_deflection, states%pivot_deflection_rate, &
         & states%deflection]) <= 0), 'all is 0')
      change = layout%over_columns([1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], y)
      call expect(all(abs(sum(change, dim=1) - 10) <= 0) .and. all(abs(change(tilt_column:, :)) <= 0), 'the journal''s')
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
      type(pad_state) :: states(pads), back(pads)
      real(wp) :: y(layout%n)
      integer :: i
      states = [(pad_state(10.0_wp + i, 20.0_wp + i, 30.0_wp + i, 40.0_wp + i, 50.0_wp + i), i=1, pads)]
      y = -1
      call layout%put_pads(states, y)
      call expect(all(y(:layout%rotor) < 0) .and. all(y(layout%rotor + 1:) > 0), 'pads alone are put'//what(layout))
      back = layout%pad_states(y)
      call expect_close(maxval(abs(back%tilt - states%tilt) + abs(back%tilt_rate - states%tilt_rate)), 0.0_wp, 0.0_wp, &
         & 'tilts come back'//what(layout))
      if (.not. layout%radial) then
         states%pivot_deflection = 0
         states%pivot_deflection_rate = 0
      end if
      if (.not. layout%bristles) states%deflection = 0
      call expect_close(maxval(abs(back%pivot_deflection - states%pivot_deflection) &
         & + abs(back%pivot_deflection_rate - states%pivot_deflection_rate) + abs(back%deflection &
            & - states%deflection)), 0.0_wp, 0.0_wp, 'what a pad has comes back, the rest is 0'//what(layout))
      do i = 1, pads
         call expect_close(y(layout%before(i) + at_tilt_rate), 20.0_wp + i, 0.0_wp, 'tilt rate by its index' &
            & //what(layout))
         if (layout%radial) call expect_close(y(layout%before(i) + at_deflection), 30.0_wp + i, 0.0_wp, &
            & 'pivot deflection by its index'//what(layout))
         if (layout%bristles) call expect_close(y(layout%bristle(i)), 50.0_wp + i, 0.0_wp, &
            & 'bristles by their index'//what(layout))
      end do
   end subroutine states_of_pads

   !> Sums of some ten numbers, and a pad's masses, whose inverse loses a digit or two: 1e-12 of each row's largest
   !> entry.
   subroutine against_motion(motion, friction)
      character(len=*), intent(in) :: motion, friction
      type(case_type) :: inputs
      type(bearing_model) :: model
      real(wp), allocatable :: y(:), rates(:), jacobian(:, :), expected(:), matrix(:, :), over_positions(:, :)
      real(wp), allocatable :: over_rates(:, :)
      real(wp), parameter :: t = 0.0123_wp
      character(len=:), allocatable :: what
      logical :: ok
      integer :: n, i
      what = trim(motion)//', '//trim(friction)
      inputs = case_type()
      inputs%pads%motion = trim(motion)
      inputs%friction%model = trim(friction)
      inputs%pads%centre_tangential = [3e-3_wp, -6e-3_wp]
      inputs%pads%mass = [0.8_wp, 0.6_wp]
      model = new_bearing_model(inputs)
      y = model%state(journal_motion([-4e-5_wp, 2e-6_wp], [1e-3_wp, -2e-3_wp]), &
         & [(pad_state(4e-4_wp*(i - 1), between(0.3_wp, 0.6_wp), 7e-6_wp, 1e-3_wp, 1e-7_wp), i=1, 2)])
      n = model%layout%n_positions()
      allocate (rates(model%n), jacobian(model%n, model%n), over_positions(n, n), over_rates(n, n))
      call model%rhs(t, y, rates, ok)
      call expect(ok, 'a state with films, '//what)
      expected = forces(model, t)
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
