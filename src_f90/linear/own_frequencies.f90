!> Vibrations of a machine whose elements depend on the frequency of a whirl: each with its own frequency, from those
!> with the frequency of the speed.
module own_frequencies
   use kinds, only: wp, pi
   use text, only: to_text
   use linear_algebra, only: solve, solve_complex, zgesv, zgetrs
   use errors, only: error_type, raise, numerics_error
   use elastic_rotor, only: elastic_rotor_type
   implicit none (type, external)
   private
   public :: take_own_frequencies, follow_mode

   !> What the modes of rotor and pads answer to forces between the ends of the elements that depend on the frequency of
   !> a whirl: with such forces f on the elements the part of mode k in a vibration exp(value t) is `driven(k, :)` f
   !> over values(k) - value.
   type :: mode_answer_type
      complex(wp), allocatable :: values(:), shapes(:, :)
      !> What the displacements of the rotor, and the shapes, are between the ends, (end, position) and (end, mode).
      real(wp), allocatable :: ends(:, :)
      complex(wp), allocatable :: at_ends(:, :), driven(:, :)
      !> Whether the modes are a basis of all motions.
      logical :: ok = .false.
   end type mode_answer_type

   !> Parts in which the elements' own frequencies come in; most rounds of Newton's method for each, and the last change
   !> of an eigenvalue, over itself.
   integer, parameter :: parts = 4, most_rounds = 60
   real(wp), parameter :: closeness = 1e-11_wp
   !> They come in at once where a shape stays alike to this; factors are kept where a change falls to this part of the
   !> one before.
   real(wp), parameter :: alike = 0.9_wp, falls = 0.3_wp
   !> What rounding leaves of the forces on the rotor in a mode, over these.
   real(wp), parameter :: rounding = 1e-9_wp

contains

   !> Brings the eigenvalues, 1/s, and shapes of the positions that are kept from elements with the frequency of the
   !> speed to elements with that of each vibration, its imaginary part: by what all modes answer to the difference, and
   !> where this does not hold in parts that grow to all of it, so that no mode is taken for another.
   subroutine take_own_frequencies(rotor, speed, stiffness, damping, mass, values, shapes, error)
      type(elastic_rotor_type), intent(in) :: rotor
      !> Of the shaft, rad/s.
      real(wp), intent(in) :: speed
      !> Of these positions, with the elements at the frequency of the speed.
      real(wp), intent(in), dimension(:, :) :: stiffness, damping, mass
      complex(wp), intent(inout) :: values(:), shapes(:, :)
      type(error_type), allocatable, intent(inout) :: error
      type(mode_answer_type) :: answer
      complex(wp) :: value, shape(size(shapes, 1))
      logical :: ok
      integer :: i, k
      if (.not. rotor%has_own_frequencies()) return
      call find_answer(rotor, mass, values, shapes, answer)
      do i = 1, size(values)
         if (values(i)%im < 0) cycle
         call take_own_frequency(rotor, speed, stiffness, damping, mass, answer, i, value, shape, ok)
         if (ok) then
            values(i) = value
            shapes(:, i) = shape
            cycle
         end if
         do k = 1, parts
            call follow_mode(rotor, speed, stiffness, damping, mass, real(k, wp)/parts, values(i), shapes(:, i), error)
            if (allocated(error)) return
         end do
      end do
   end subroutine take_own_frequencies

   !> The answer of the modes with these eigenvalues, 1/s, and shapes of the positions that are kept.
   subroutine find_answer(rotor, mass, values, shapes, answer)
      type(elastic_rotor_type), intent(in) :: rotor
      real(wp), intent(in) :: mass(:, :)
      complex(wp), intent(in) :: values(:), shapes(:, :)
      type(mode_answer_type), intent(out) :: answer
      real(wp), allocatable :: accelerations(:, :)
      complex(wp), allocatable :: states(:, :)
      integer :: k
      answer%values = values
      answer%shapes = shapes
      answer%ends = rotor%whirl_ends()
      associate (n => size(mass, 1), m => size(answer%ends, 1), r => rotor%positions)
         ! the first positions are the rotor's, and all of these move
         answer%at_ends = matmul(answer%ends, shapes(:r, :))
         allocate (accelerations(n, m), source=0.0_wp)
         accelerations(:r, :) = transpose(answer%ends)
         call solve(n, m, mass, accelerations, answer%ok)
         allocate (states(2*n, 2*n), answer%driven(2*n, m))
         states(:n, :) = shapes
         do k = 1, 2*n
            states(n + 1:, k) = values(k)*shapes(:, k)
         end do
         answer%driven(:n, :) = 0
         answer%driven(n + 1:, :) = accelerations
         if (answer%ok) call solve_complex(2*n, m, states, answer%driven, answer%ok)
      end associate
   end subroutine find_answer

   !> Mode i with the elements at its own frequency. With its part of the motion held, the others and the ends of the
   !> elements follow from each other, and the eigenvalue from what the elements change there: a fixed point. `ok` is
   !> false where it is none, does not solve the equations, or is no longer this mode.
   subroutine take_own_frequency(rotor, speed, stiffness, damping, mass, answer, i, value, shape, ok)
      type(elastic_rotor_type), intent(in) :: rotor
      real(wp), intent(in) :: speed
      real(wp), intent(in), dimension(:, :) :: stiffness, damping, mass
      integer, intent(in) :: i
      type(mode_answer_type), intent(in) :: answer
      complex(wp), intent(out) :: value, shape(:)
      logical, intent(out) :: ok
      complex(wp), dimension(size(answer%values)) :: weight
      complex(wp), dimension(size(answer%ends, 1), size(answer%ends, 1)) :: change, system
      complex(wp) :: u(size(answer%ends, 1)), next, residual(size(mass, 1), 3)
      integer :: k, round
      value = answer%values(i)
      shape = answer%shapes(:, i)
      ok = answer%ok
      do round = 1, most_rounds
         if (.not. ok) return
         associate (c => rotor%whirl_changes(speed, value%im))
            change = c(:, :, 1) + value*(c(:, :, 2) + value*c(:, :, 3))
         end associate
         weight = value - answer%values
         weight(i) = 1
         ok = all(abs(weight) > 0)
         if (.not. ok) return
         weight = 1/weight
         weight(i) = 0
         system = matmul(answer%at_ends*spread(weight, 1, size(u)), matmul(answer%driven, change))
         do k = 1, size(u)
            system(k, k) = system(k, k) + 1
         end do
         u = answer%at_ends(:, i)
         call solve_complex(size(u), 1, system, u, ok)
         u = matmul(change, u)
         next = answer%values(i) - sum(answer%driven(i, :)*u)
         next%im = merge(max(0.0_wp, next%im), 0.0_wp, answer%values(i)%im > 0)
         ok = abs(next - value) <= closeness*abs(next)
         value = next
         if (ok) exit
         ok = round < most_rounds
      end do
      if (.not. ok) return
      shape = shape - matmul(answer%shapes, weight*matmul(answer%driven, u))
      residual(:, 1) = matmul(stiffness, shape)
      residual(:, 2) = value*matmul(damping, shape)
      residual(:, 3) = value**2*matmul(mass, shape)
      weight(:rotor%positions) = sum(residual(:rotor%positions, :), 2) + matmul(u, answer%ends)
      ok = norm2(abs(weight(:rotor%positions))) <= rounding*norm2(abs(residual(:rotor%positions, :))) .and. &
         & abs(dot_product(shape, answer%shapes(:, i))) >= alike*norm2(abs(shape))*norm2(abs(answer%shapes(:, i)))
   end subroutine take_own_frequency

   !> Newton's method on an eigenvalue, 1/s, and its shape, with this part of what its own frequency changes: a fixed
   !> point in the frequency. Its equations are factored anew where the last factors lead on too slowly.
   subroutine follow_mode(rotor, speed, stiffness, damping, mass, part, value, shape, error)
      type(elastic_rotor_type), intent(in) :: rotor
      real(wp), intent(in) :: speed, part
      real(wp), intent(in), dimension(:, :) :: stiffness, damping, mass
      complex(wp), intent(inout) :: value, shape(:)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), allocatable :: ends(:, :), changes(:, :, :)
      complex(wp) :: factors(size(shape) + 1, size(shape) + 1), step(size(shape) + 1, 1)
      real(wp) :: before, change
      integer :: round, pivots(size(shape) + 1), info
      logical :: anew
      ends = rotor%whirl_ends()
      anew = .true.
      change = huge(change)
      do round = 1, most_rounds
         changes = part*rotor%whirl_changes(speed, value%im)
         shape = shape/norm2([norm2(shape%re), norm2(shape%im)])
         call solve_step(shape, step)
         if (info /= 0) exit
         associate (n => size(shape))
            shape = shape + step(:n, 1)
            if (value%im <= 0) step(n + 1, 1)%im = 0
            value = value + step(n + 1, 1)
            value%im = max(0.0_wp, value%im)
            before = change
            change = abs(step(n + 1, 1))
            if (change <= closeness*abs(value)) return
            anew = change > falls*before
         end associate
      end do
      call raise(error, numerics_error, 'a mode at '//to_text(value%im/(2*pi))//' Hz does not settle with the ' &
         & //'coefficients of its elements at its own frequency; element%frequency = ''synchronous'' takes those of ' &
         & //'the speed')
   contains
      !> Changes of shape and eigenvalue.
      subroutine solve_step(shape, step)
         complex(wp), intent(in) :: shape(:)
         complex(wp), intent(out) :: step(:, :)
         complex(wp), dimension(size(shape)) :: of_mass, of_damping
         complex(wp) :: u(size(ends, 1))
         associate (n => size(shape), r => rotor%positions)
            of_mass = matmul(mass, shape)
            of_damping = matmul(damping, shape)
            ! the first positions are the rotor's, and all of these move
            u = matmul(ends, shape(:r))
            of_mass(:r) = of_mass(:r) + matmul(matmul(changes(:, :, 3), u), ends)
            of_damping(:r) = of_damping(:r) + matmul(matmul(changes(:, :, 2), u), ends)
            step(:n, 1) = -matmul(stiffness, shape) - value*of_damping - value**2*of_mass
            step(:r, 1) = step(:r, 1) - matmul(matmul(changes(:, :, 1), u), ends)
            step(n + 1, 1) = 0
            if (.not. anew) then
               call zgetrs('N', n + 1, 1, factors, n + 1, pivots, step, n + 1, info)
               return
            end if
            factors(:n, :n) = stiffness + value*damping + value**2*mass
            factors(:r, :r) = factors(:r, :r) + matmul(transpose(ends), matmul(changes(:, :, 1) &
               & + value*changes(:, :, 2) + value**2*changes(:, :, 3), ends))
            factors(:n, n + 1) = of_damping + 2*value*of_mass
            factors(n + 1, :n) = conjg(shape)
            factors(n + 1, n + 1) = 0
            call zgesv(n + 1, 1, factors, n + 1, pivots, step, n + 1, info)
         end associate
      end subroutine solve_step
   end subroutine follow_mode
end module own_frequencies
