!> Elements between a rotor and the ground beside its bearings: what a model makes of the smallest one, a spring with a
!> damper and with cross-coupling, on a rigid journal, on the journals of a shaft and on the housing of a bearing.
program test_elements
   use kinds, only: wp, pi
   use text, only: to_text
   use errors, only: error_type
   use linear_algebra, only: find_eigenvalues
   use case_inputs, only: case_type
   use factories, only: converged_films
   use state_layout, only: pad_state
   use abstract_element, only: element_slot
   use squeeze_film_damper, only: squeeze_film_damper_type
   use rigid_rotor, only: journal_motion
   use film_oils, only: film_oil
   use case_groups, only: damper_type
   use linear_element, only: linear_element_type, support_element
   use equations_of_motion, only: machine_model, new_machine_model
   use bearing_samples, only: element_forces
   use force_balance, only: forces, force_derivatives, masses
   use equilibrium_record, only: equilibrium_type
   use static_model, only: make_static, solve_equilibrium
   use equilibrium, only: bearing_loads, find_equilibrium, settle_equilibrium
   use linear_bearing, only: bearing_coefficients_type, find_coefficients
   use input_cases, only: case_of
   use machine_cases, only: symmetric_rotor
   use machine_orbits, only: stand
   use check, only: runs, expect, expect_close, expect_no_error, between, report
   implicit none (type, external)

   !> N/m and N s/m, column by column: about as much as the films have.
   real(wp), parameter :: springs(2, 2) = reshape([3e8_wp, -1e8_wp, 2e8_wp, 5e8_wp], [2, 2])
   real(wp), parameter :: dampers(2, 2) = reshape([4e5_wp, 1e5_wp, -2e5_wp, 6e5_wp], [2, 2])
   !> The paper's bearing with films that are smooth.
   character(len=*), parameter :: smooth = '&film solver = ''fourier'', cavitation = ''none'' / '

   if (runs('force_by_hand')) call force_by_hand()
   if (runs('sampled')) call sampled()
   if (runs('jacobian')) call jacobian()
   if (runs('jacobian_by_differences')) call jacobian_by_differences()
   if (runs('solutions')) then
      call solutions(case_of(smooth), [1], 'rigid journal')
      call solutions(symmetric_rotor('lugre', 4100.0_wp, 0.01_wp), [2, 1, 2], 'shaft')
   end if
   if (runs('balance')) call balance()
   if (runs('rest_on_spring')) call rest_on_spring()
   if (runs('modes')) call modes()
   if (runs('two_on_one_pair')) call two_on_one_pair()
   if (runs('on_a_shaft')) call on_a_shaft()
   if (runs('under_a_housing')) call under_a_housing()
   if (runs('shares_of_the_load')) call shares_of_the_load()
   if (runs('damper_forces')) call damper_forces()
   if (runs('damper_derivatives')) call damper_derivatives()
   call report()

contains

   pure type(linear_element_type) function spring()
      spring%stiffness = springs
      spring%damping = dampers
   end function spring

   !> These elements on these pairs of the rotor's displacements.
   function on_pairs(elements, pairs) result(others)
      type(linear_element_type), intent(in) :: elements(:)
      integer, intent(in) :: pairs(:)
      type(element_slot) :: others(size(elements))
      integer :: i
      do i = 1, size(others)
         allocate (others(i)%of, source=elements(i))
         others(i)%pair = pairs(i)
      end do
   end function on_pairs

   !> Journals and pads that carry, in motion, away from the switching points of friction; the rotor's other
   !> displacements move by part of their scale.
   function moving_state(model) result(y)
      type(machine_model), intent(in) :: model
      real(wp) :: y(model%n)
      integer :: b, i, k
      y = 0
      y(:model%rotor%states) = [(between(-0.1_wp, 0.1_wp)*model%scale(k), k=1, model%rotor%states)]
      do b = 1, size(model%bearings)
         y(2*b - 1) = between(-40e-6_wp, -20e-6_wp)
         associate (of => model%layout%elements(b))
            call of%put_pads([(pad_state(merge(-1e-4_wp, 7e-4_wp, i == 1), between(0.3_wp, 0.6_wp), &
               & between(4e-6_wp, 8e-6_wp), between(-2e-3_wp, 2e-3_wp), 1e-7_wp), i=1, of%pads)], y)
         end associate
      end do
   end function moving_state

   !> A bearing with a spring and a damper, and without.
   subroutine make_both(with, without)
      type(machine_model), intent(out) :: with, without
      with = new_machine_model(case_of(smooth), others=on_pairs([spring()], [1]))
      without = new_machine_model(case_of(smooth))
      call expect(with%n == without%n, 'it adds no states')
      call expect(with%outputs == without%outputs, 'nor outputs of pads')
      call expect(all(abs(with%scale - without%scale) <= 0), 'nor does it change scales')
   end subroutine make_both

   !> The journal is accelerated by -(K x + C x')/M more, and pads are not.
   subroutine force_by_hand()
      type(machine_model) :: with, without
      real(wp), allocatable :: y(:), f(:), f0(:)
      logical :: ok, ok0
      call make_both(with, without)
      y = moving_state(with)
      allocate (f, f0, mold=y)
      call with%rhs(0.01_wp, y, f, ok)
      call without%rhs(0.01_wp, y, f0, ok0)
      call expect(ok .and. ok0, 'a state with films')
      associate (expected => -(matmul(springs, y(1:2)) + matmul(dampers, y(3:4)))/with%inputs%rotor%mass)
         call expect(norm2(expected) > 0.01_wp*norm2(f0(3:4)), 'the force counts')
         call expect_close(norm2(f(3:4) - f0(3:4) - expected), 0.0_wp, 1e-12_wp*norm2(f(3:4)), 'force')
      end associate
      call expect(all(abs(f([1, 2]) - f0([1, 2])) <= 0) .and. all(abs(f(5:) - f0(5:)) <= 0), 'pads know nothing of it')
   end subroutine force_by_hand

   !> What is sampled are the forces of the elements, in their order, from the state alone.
   subroutine sampled()
      type(machine_model) :: model
      type(linear_element_type) :: other
      real(wp), allocatable :: y(:)
      real(wp) :: found(2, 2)
      other%damping = transpose(springs)*1e-3_wp
      model = new_machine_model(symmetric_rotor('none', 4100.0_wp, 0.0_wp), others=on_pairs([spring(), other], [2, 1]))
      y = moving_state(model)
      found = element_forces(model, 0.01_wp, y)
      associate (n => model%rotor%positions)
         associate (expected => -(matmul(springs, y(3:4)) + matmul(dampers, y(n + 3:n + 4))))
            call expect_close(norm2(found(:, 1) - expected), 0.0_wp, 1e-14_wp*norm2(expected), 'spring and damper')
         end associate
         associate (expected => -matmul(other%damping, y(n + 1:n + 2)))
            call expect_close(norm2(found(:, 2) - expected), 0.0_wp, 1e-14_wp*norm2(expected), 'a damper alone')
         end associate
      end associate
   end subroutine sampled

   !> The Jacobian has -K/M and -C/M more in the rows of the journal's rates.
   subroutine jacobian()
      type(machine_model) :: with, without
      real(wp), allocatable :: y(:), f(:), found(:, :), found0(:, :), expected(:, :)
      logical :: ok, ok0
      integer :: row
      call make_both(with, without)
      y = moving_state(with)
      allocate (f, mold=y)
      allocate (found(with%n, with%n), found0(with%n, with%n), expected(with%n, with%n))
      call with%rhs_and_jacobian(0.01_wp, y, f, found, ok)
      call without%rhs_and_jacobian(0.01_wp, y, f, found0, ok0)
      call expect(ok .and. ok0, 'a state with films')
      expected = found0
      expected(3:4, 1:2) = expected(3:4, 1:2) - springs/with%inputs%rotor%mass
      expected(3:4, 3:4) = expected(3:4, 3:4) - dampers/with%inputs%rotor%mass
      do row = 1, with%n
         call expect_close(maxval(abs(found(row, :) - expected(row, :))), 0.0_wp, &
            & 1e-13_wp*maxval(abs(expected(row, :))), 'row '//to_text(row))
      end do
   end subroutine jacobian

   !> Five-point differences with steps of 1e-3 of the scales: error 1e-12 of the fifth derivative, some 1e3, rounding
   !> 1e-13; each row by its largest entry, all in the scales of the states.
   subroutine jacobian_by_differences()
      real(wp), parameter :: h = 1e-3_wp, offsets(4) = [-2*h, -h, h, 2*h]
      real(wp), parameter :: weights(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/(12*h)
      type(machine_model) :: model
      real(wp), allocatable :: y(:), trial(:), f(:), found(:, :), expected(:, :)
      integer :: column, k, row
      logical :: ok
      model = new_machine_model(case_of(smooth), others=on_pairs([spring()], [1]))
      y = moving_state(model)
      allocate (f, mold=y)
      allocate (found(model%n, model%n), expected(model%n, model%n))
      call model%rhs_and_jacobian(0.01_wp, y, f, found, ok)
      expected = 0
      do column = 1, model%n
         do k = 1, size(offsets)
            trial = y
            trial(column) = y(column) + offsets(k)*model%scale(column)
            if (ok) call model%rhs(0.01_wp, trial, f, ok)
            expected(:, column) = expected(:, column) + weights(k)*f
         end do
         found(:, column) = found(:, column)*model%scale(column)
      end do
      call expect(ok, 'all states are admitted')
      do row = 1, model%n
         call expect_close(maxval(abs(found(row, :) - expected(row, :))), 0.0_wp, &
            & 1e-6_wp*maxval(abs(expected(row, :))), 'row '//to_text(row))
      end do
   end subroutine jacobian_by_differences

   !> With springs on these pairs (1 - gamma J) v = b has the solution v: in a step of 0.1 ms they are felt.
   subroutine solutions(inputs, pairs, what)
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: pairs(:)
      character(len=*), intent(in) :: what
      real(wp), parameter :: gamma = 1e-4_wp
      type(machine_model) :: model
      real(wp), allocatable :: matrix(:, :), v(:), rates(:), b(:)
      logical :: ok
      integer :: k
      model = new_machine_model(inputs, others=on_pairs([(spring(), k=1, size(pairs))], pairs))
      allocate (matrix(model%n, model%n), rates(model%n))
      call model%rhs_and_jacobian(0.01_wp, moving_state(model), rates, matrix, ok)
      call expect(ok, 'the state is admitted, '//what)
      v = [(between(-1.0_wp, 1.0_wp)*model%scale(k), k=1, model%n)]
      b = v - gamma*matmul(matrix, v)
      call model%solve(gamma, b, ok)
      call expect(ok, 'there is a solution, '//what)
      call expect_close(maxval(abs(b - v)/model%scale), 0.0_wp, 1e-9_wp, 'of the linear system, '//what)
   end subroutine solutions

   !> Forces and derivatives that are not divided by masses gain what the element has, and nothing else does.
   subroutine balance()
      type(machine_model) :: with, without
      real(wp), allocatable, dimension(:, :) :: over_positions, over_rates, of_bearing, of_bearing_rates
      real(wp), allocatable :: y(:), force(:)
      logical :: ok
      integer :: n
      call make_both(with, without)
      y = moving_state(with)
      call with%evaluate(0.0_wp, y, .true., ok)
      if (ok) call without%evaluate(0.0_wp, y, .true., ok)
      call expect(ok, 'a state with films')
      force = forces(with, 0.0_wp, y) - forces(without, 0.0_wp, y)
      force(1:2) = force(1:2) + matmul(springs, y(1:2)) + matmul(dampers, y(3:4))
      call expect_close(norm2(force), 0.0_wp, 1e-12_wp*norm2(forces(without, 0.0_wp, y)), 'forces')
      n = with%layout%n_positions()
      allocate (over_positions(n, n), over_rates(n, n), of_bearing(n, n), of_bearing_rates(n, n))
      call force_derivatives(with, over_positions, over_rates)
      call force_derivatives(without, of_bearing, of_bearing_rates)
      of_bearing(1:2, 1:2) = of_bearing(1:2, 1:2) - springs
      of_bearing_rates(1:2, 1:2) = of_bearing_rates(1:2, 1:2) - dampers
      call expect_close(maxval(abs(over_positions - of_bearing)), 0.0_wp, 1e-13_wp*maxval(abs(of_bearing)), &
         & 'over positions')
      call expect_close(maxval(abs(over_rates - of_bearing_rates)), 0.0_wp, 1e-13_wp*maxval(abs(of_bearing_rates)), &
         & 'over rates')
      call expect(all(abs(masses(with) - masses(without)) <= 0), 'it moves no mass')
   end subroutine balance

   !> A static model of the paper's bearing with an element, and its equilibrium, found from that without.
   subroutine stand_on_spring(static, y)
      type(machine_model), intent(out) :: static
      real(wp), allocatable, intent(out) :: y(:)
      type(machine_model) :: plain, model
      type(equilibrium_type) :: found
      type(error_type), allocatable :: error
      real(wp) :: residual
      call stand(case_of(smooth), plain, found)
      model = new_machine_model(case_of(smooth), converged_films, on_pairs([spring()], [1]))
      call make_static(model, .false., static)
      ! the element adds no states
      y = plain%static_state(found%rotor, found%pads)
      call solve_equilibrium(static, y, residual, error)
      call expect_no_error(error, 'an equilibrium with the spring')
      call expect(norm2(y(1:2) - found%rotor) > 1e-2_wp*static%inputs%bearings(1)%clearance(), 'it is another')
   end subroutine stand_on_spring

   !> The journal lies where it does without a spring under the load that the spring leaves: both searches end at 1e-8
   !> of the load, 1e-7 of the clearance or less.
   subroutine rest_on_spring()
      type(machine_model) :: static, model
      type(case_type) :: inputs
      type(equilibrium_type) :: found
      real(wp), allocatable :: y(:)
      call stand_on_spring(static, y)
      inputs = case_of(smooth)
      inputs%rotor%static_load = inputs%rotor%static_load - matmul(springs, y(1:2))
      call stand(inputs, model, found)
      call expect_close(norm2(found%rotor - y(1:2)), 0.0_wp, 1e-7_wp*inputs%bearings(1)%clearance(), 'the same place')
      y = y - model%static_state(found%rotor, found%pads)
      call expect_close(maxval(abs(y)/static%scale), 0.0_wp, 1e-6_wp, 'and the same pads')
   end subroutine rest_on_spring

   !> Linear analysis: the bearing alone is that without the spring, what the rotor meets has its stiffness and damping
   !> more, and the modes are the eigenvalues of the Jacobian, which is put together in another way.
   subroutine modes()
      type(machine_model) :: static, plain
      type(bearing_coefficients_type) :: found, without
      type(error_type), allocatable :: error
      real(wp), allocatable :: y(:), rates(:), matrix(:, :)
      complex(wp), allocatable :: values(:)
      logical :: ok
      integer :: k
      call stand_on_spring(static, y)
      call find_coefficients(static, y, found, error)
      call expect_no_error(error, 'coefficients')
      call make_static(new_machine_model(case_of(smooth), converged_films), .false., plain)
      call find_coefficients(plain, y, without, error)
      call expect_no_error(error, 'without a spring')
      if (.not. allocated(found%modes) .or. .not. allocated(without%modes)) return
      call expect_close(maxval(abs(found%stiffness - without%stiffness)), 0.0_wp, &
         & 1e-12_wp*maxval(abs(found%stiffness)), 'the bearing alone, stiffness')
      call expect_close(maxval(abs(found%damping - without%damping)), 0.0_wp, &
         & 1e-12_wp*maxval(abs(found%damping)), 'and damping')
      associate (alone => found%bearings(1), whole => found%with_rotor(1))
         call expect_close(maxval(abs(whole%stiffness(1:2, 1:2) - alone%stiffness(1:2, 1:2) - springs)), 0.0_wp, &
            & 1e-12_wp*maxval(abs(whole%stiffness)), 'the rotor on both')
         call expect_close(maxval(abs(whole%damping(1:2, 1:2) - alone%damping(1:2, 1:2) - dampers)), 0.0_wp, &
            & 1e-12_wp*maxval(abs(whole%damping)), 'and their damping')
      end associate
      allocate (matrix(static%n, static%n), values(static%n), rates(static%n))
      call static%rhs_and_jacobian(0.0_wp, y, rates, matrix, ok)
      if (ok) call find_eigenvalues(matrix, values, ok)
      call expect(ok, 'eigenvalues of the Jacobian')
      associate (modes => found%modes(1)%eigenvalue, largest => maxval(abs(values)))
         call expect(size(modes) == count(values%im >= 0), 'as many modes')
         do k = 1, size(modes)
            call expect_close(minval(abs(values - modes(k))), 0.0_wp, 1e-9_wp*largest, 'mode '//to_text(k))
         end do
         call expect(maxval([(minval(abs(without%modes(1)%eigenvalue - modes(k)))/abs(modes(k)), k=1, size(modes))]) &
            & > 0.1_wp, 'without the spring they are others')
      end associate
   end subroutine modes

   !> Two elements on a journal do what their sum does.
   subroutine two_on_one_pair()
      type(machine_model) :: two, one
      type(linear_element_type) :: half, rest
      real(wp), allocatable :: y(:)
      half%stiffness = reshape([1e8_wp, 4e8_wp, 0.0_wp, -1e8_wp], [2, 2])
      half%damping = reshape([0.0_wp, 3e5_wp, 5e5_wp, 0.0_wp], [2, 2])
      rest%stiffness = springs - half%stiffness
      rest%damping = dampers - half%damping
      two = new_machine_model(case_of(smooth), others=on_pairs([half, rest], [1, 1]))
      one = new_machine_model(case_of(smooth), others=on_pairs([spring()], [1]))
      y = moving_state(one)
      call same_motion(two, one, y, 'two elements and one')
      call expect(size(two%layout%elements) == 3, 'bearing and two elements')
   end subroutine two_on_one_pair

   !> Both have the same rates, the same Jacobian and the same solutions, to rounding.
   subroutine same_motion(model, other, y, what)
      type(machine_model), intent(inout) :: model, other
      real(wp), intent(in) :: y(:)
      character(len=*), intent(in) :: what
      real(wp), parameter :: gamma = 1e-4_wp
      real(wp), dimension(size(y), size(y)) :: matrix, matrix_of_other
      real(wp), dimension(size(y)) :: f, g, solution, solution_of_other
      logical :: ok(4)
      integer :: k
      call expect(model%n == other%n, 'as many states, '//what)
      call model%rhs_and_jacobian(0.01_wp, y, f, matrix, ok(1))
      call other%rhs_and_jacobian(0.01_wp, y, g, matrix_of_other, ok(2))
      solution = [(between(-1.0_wp, 1.0_wp)*model%scale(k), k=1, model%n)]
      solution_of_other = solution
      call model%solve(gamma, solution, ok(3))
      call other%solve(gamma, solution_of_other, ok(4))
      call expect(all(ok), 'states with films, '//what)
      associate (scale => model%scale)
         call expect_close(maxval(abs(f - g)/scale), 0.0_wp, 1e-11_wp*maxval(abs(g)/scale), 'rates, '//what)
         do k = 1, size(y)
            call expect_close(maxval(abs(matrix(k, :) - matrix_of_other(k, :))*scale), 0.0_wp, &
               & 1e-11_wp*maxval(abs(matrix_of_other(k, :))*scale), 'row '//to_text(k)//' of the Jacobian, '//what)
         end do
         call expect_close(maxval(abs(solution - solution_of_other)/scale), 0.0_wp, 1e-9_wp, 'solutions, '//what)
      end associate
   end subroutine same_motion

   !> On the second journal of a shaft: its force, by the masses of all displacements, is on that pair alone.
   subroutine on_a_shaft()
      type(machine_model) :: with, without
      type(case_type) :: inputs
      real(wp), allocatable :: y(:), f(:), f0(:), force(:)
      logical :: ok, ok0
      inputs = symmetric_rotor('none', 4100.0_wp, 0.01_wp)
      with = new_machine_model(inputs, others=on_pairs([spring()], [2]))
      without = new_machine_model(inputs)
      y = moving_state(with)
      allocate (f, f0, mold=y)
      call with%rhs(0.01_wp, y, f, ok)
      call without%rhs(0.01_wp, y, f0, ok0)
      call expect(ok .and. ok0, 'a state with films')
      associate (n => with%rotor%positions)
         force = matmul(with%rotor%masses(), f(n + 1:2*n) - f0(n + 1:2*n))
         associate (expected => -(matmul(springs, y(3:4)) + matmul(dampers, y(n + 3:n + 4))))
            call expect_close(norm2(force(3:4) - expected), 0.0_wp, 1e-8_wp*norm2(expected), 'force')
            force(3:4) = 0
            call expect_close(norm2(force), 0.0_wp, 1e-8_wp*norm2(expected), 'on nothing else')
         end associate
         call expect(all(abs(f(2*n + 1:) - f0(2*n + 1:)) <= 0), 'pads know nothing of it')
      end associate
   end subroutine on_a_shaft

   !> A shaft in housings on supports that are in the rotor's matrices, and one with a part of them there and the rest
   !> as elements on the pair of each housing.
   subroutine make_supported(folded, acting)
      type(machine_model), intent(out) :: folded, acting
      type(case_type) :: inputs, part
      type(linear_element_type) :: rest(2)
      integer :: b
      inputs = symmetric_rotor('lugre', 4100.0_wp, 0.01_wp)
      part = inputs
      do b = 1, 2
         allocate (inputs%bearings(b)%support)
         associate (support => inputs%bearings(b)%support)
            support%mass = 300
            support%stiffness = [4e8_wp, 7e8_wp]*b
            support%damping = [5e5_wp, 2e5_wp]
            part%bearings(b)%support = support
            part%bearings(b)%support%stiffness = 0.25_wp*support%stiffness
            part%bearings(b)%support%damping = 0.5_wp*support%damping
            rest(b) = support_element(support)
            rest(b)%stiffness = 0.75_wp*rest(b)%stiffness
            rest(b)%damping = 0.5_wp*rest(b)%damping
         end associate
      end do
      folded = new_machine_model(inputs)
      acting = new_machine_model(part, others=on_pairs(rest, [3, 4]))
   end subroutine make_supported

   !> They move alike.
   subroutine under_a_housing()
      type(machine_model) :: folded, acting
      call make_supported(folded, acting)
      call same_motion(acting, folded, moving_state(folded), 'supports')
   end subroutine under_a_housing

   !> They rest alike, found from nothing and from one another, to the 1e-8 of the load at which searches end. Without
   !> the elements a quarter of the supports would carry, and the journals lie elsewhere.
   subroutine shares_of_the_load()
      type(machine_model) :: folded, acting, static
      type(equilibrium_type) :: expected, found
      type(error_type), allocatable :: error
      real(wp), allocatable :: y(:)
      call make_supported(folded, acting)
      call find_equilibrium(folded, expected, error)
      call expect_no_error(error, 'an equilibrium, supports in the matrices')
      call find_equilibrium(acting, found, error)
      call expect_no_error(error, 'an equilibrium, supports as elements')
      if (.not. allocated(expected%pads) .or. .not. allocated(found%pads)) return
      call same_rest(folded, expected, acting, found, 'found from nothing')
      call make_static(acting, acting%point%cavitation, static)
      call settle_equilibrium(static, found, y, error)
      call expect_no_error(error, 'an equilibrium from a known one')
      call same_rest(folded, expected, acting, found, 'found from itself')
   end subroutine shares_of_the_load

   subroutine same_rest(model, expected, other, found, what)
      type(machine_model), intent(in) :: model, other
      type(equilibrium_type), intent(in) :: expected, found
      character(len=*), intent(in) :: what
      real(wp) :: loads(2, 2)
      loads = bearing_loads(model, expected)
      call expect_close(maxval(abs(bearing_loads(other, found) - loads)), 0.0_wp, 1e-6_wp*maxval(abs(loads)), &
         & 'loads on the bearings, '//what)
      call expect_close(maxval(abs(found%rotor - expected%rotor)/model%scale(:size(found%rotor))), 0.0_wp, 1e-6_wp, &
         & 'displacements, '//what)
   end subroutine same_rest

   !> Forces by quadrature of n (n.v)/h^3 to rounding, of rings that go outward, across, and that stand in the middle;
   !> sealed ends: on a circle 24 pi mu L (R/c)^3/((2 + e^2) sqrt(1 - e^2)) times the velocity along it.
   subroutine damper_forces()
      real(wp), parameter :: places(2, 3) = reshape([30e-6_wp, 20e-6_wp, 80e-6_wp, -40e-6_wp, 0.0_wp, 0.0_wp], [2, 3])
      real(wp), parameter :: rates(2, 3) = reshape([0.01_wp, -0.004_wp, -0.02_wp, 0.03_wp, 0.01_wp, 0.02_wp], [2, 3])
      real(wp), parameter :: cavitated(2, 3) = reshape([-382.86843104397116_wp, 6.727497360354518_wp, &
         & -8.202464700321075_wp, -196.9820160525287_wp, -156.89365039439716_wp, -313.78730078879414_wp], [2, 3])
      real(wp), parameter :: whole(2, 3) = reshape([-474.688253062607_wp, 96.00436578794306_wp, &
         & 124893.65283710542_wp, -69463.32376895189_wp, -313.78730078879397_wp, -627.5746015775883_wp], [2, 3])
      real(wp), parameter :: e = 0.6_wp, mu = 0.007_wp
      type(squeeze_film_damper_type) :: damper
      integer :: i
      do i = 1, 3
         call expect_close(norm2(force_of('pi', places(:, i), rates(:, i)) - cavitated(:, i)), 0.0_wp, &
            & 1e-12_wp*norm2(cavitated(:, i)), 'it cavitates, state '//to_text(i))
         call expect_close(norm2(force_of('full', places(:, i), rates(:, i)) - whole(:, i)), 0.0_wp, &
            & 1e-12_wp*norm2(whole(:, i)), 'whole, state '//to_text(i))
      end do
      damper = damper_of('sealed')
      associate (d => damper%of)
         call expect_close(norm2(force_of('sealed', [0.0_wp, e*d%clearance], [0.01_wp, 0.0_wp]) + [24*pi*mu*d%length &
            & *(d%radius/d%clearance)**3/((2 + e**2)*sqrt(1 - e**2))*0.01_wp, 0.0_wp]), 0.0_wp, 1e-10_wp, 'sealed')
      end associate
   end subroutine damper_forces

   !> Those that Newton's method has are those of the forces, by central differences; at rest a cavitated film has
   !> half of the damping of a full one.
   subroutine damper_derivatives()
      character(len=*), parameter :: films(*) = [character(len=6) :: 'pi', 'full', 'sealed']
      real(wp), dimension(2, 2) :: over_positions, over_rates, half, ignored
      real(wp) :: u(2), v(2), step(2)
      integer :: i, k, trial
      do i = 1, size(films)
         do trial = 1, 5
            u = [between(-50e-6_wp, 50e-6_wp), between(-50e-6_wp, 50e-6_wp)]
            v = [between(-0.02_wp, 0.02_wp), between(-0.02_wp, 0.02_wp)]
            call derivatives_of(trim(films(i)), u, v, over_positions, over_rates)
            do k = 1, 2
               step = 0
               step(k) = 1e-9_wp
               call expect_close(norm2((force_of(trim(films(i)), u + step, v) - force_of(trim(films(i)), u - step, v)) &
                  & /(2*step(k)) - over_positions(:, k)), 0.0_wp, 1e-6_wp*norm2(over_positions), films(i)//' position')
               step(k) = 1e-6_wp
               call expect_close(norm2((force_of(trim(films(i)), u, v + step) - force_of(trim(films(i)), u, v - step)) &
                  & /(2*step(k)) - over_rates(:, k)), 0.0_wp, 1e-6_wp*norm2(over_rates), films(i)//' rate')
            end do
         end do
      end do
      call derivatives_of('pi', u, [0.0_wp, 0.0_wp], ignored, half)
      call derivatives_of('full', u, [0.0_wp, 0.0_wp], ignored, over_rates)
      call expect_close(norm2(half - over_rates/2), 0.0_wp, 1e-12_wp*norm2(half), 'half at rest')
   end subroutine damper_derivatives

   type(squeeze_film_damper_type) function damper_of(film) result(damper)
      character(len=*), intent(in) :: film
      damper%of = damper_type(0.065_wp, 0.028_wp, 100e-6_wp, 0.007_wp, film)
      damper%title = 'the damper'
   end function damper_of

   function force_of(film, u, v) result(force)
      character(len=*), intent(in) :: film
      real(wp), intent(in) :: u(2), v(2)
      real(wp) :: force(2)
      type(squeeze_film_damper_type) :: damper
      damper = damper_of(film)
      force = damper%sampled_force(journal_motion(u, v), [pad_state ::], 0.0_wp)
   end function force_of

   subroutine derivatives_of(film, u, v, over_positions, over_rates)
      character(len=*), intent(in) :: film
      real(wp), intent(in) :: u(2), v(2)
      real(wp), intent(out) :: over_positions(2, 2), over_rates(2, 2)
      type(squeeze_film_damper_type) :: damper
      character(len=:), allocatable :: refusal
      logical :: ok
      damper = damper_of(film)
      call damper%evaluate(journal_motion(u, v), [pad_state ::], [film_oil ::], 0.0_wp, .true., refusal, ok)
      call expect(ok, 'a ring that does not touch')
      call damper%part_derivatives(1, 2, .true., over_positions, over_rates)
   end subroutine derivatives_of
end program test_elements
