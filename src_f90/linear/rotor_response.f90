!> What the equations of a machine, linearised at its equilibrium, say beside its modes: the steady whirl of its
!> stations under what turns with it; the stations in each mode, and what damps it; and the modes with each bearing's
!> synchronous stiffness and damping in the place of its pads, as rotor dynamics without pads has them.
module rotor_response
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp, pi
   use linear_algebra, only: solve_complex
   use errors, only: error_type, raise, numerics_error
   use equations_of_motion, only: machine_model
   use force_balance, only: at_stations, other_derivatives, part_derivatives
   use operating_point, only: operating_point_type
   use elastic_rotor, only: elastic_rotor_type
   use linear_bearing, only: linear_bearing_type, bearing_coefficients_type, vibration_modes_type, find_modes, &
      & take_high_damping
   implicit none (type, external)
   private
   public :: rotor_response_type, find_rotor_response, synchronous_rotor

   !> One element, or the last dimension, for each way that the pivots may behave.
   type :: rotor_response_type
      !> Stations under what turns with the shaft, m, (2, station, pivot): y and z are the real parts of these times
      !> exp(i shaft angle).
      complex(wp), allocatable :: unbalance(:, :, :)
      !> Stations in the modes, m, (2, station, mode, pivot); 0 of modes that there are not.
      complex(wp), allocatable :: shapes(:, :, :, :)
      !> Part of the damping of each mode in a march that the reduction gives to high modes, (mode, pivot); 0 of modes
      !> that there are not.
      real(wp), allocatable :: of_reduction(:, :)
      !> What each element and damper adds to the logarithmic decrement of each mode, (element, mode, pivot); no number
      !> of modes that do not vibrate.
      real(wp), allocatable :: of_elements(:, :, :)
      !> Modes of the rotor on synchronously reduced coefficients; which of them is the counterpart of each mode, (mode,
      !> pivot), 0: none is.
      type(vibration_modes_type), allocatable :: synchronous(:)
      integer, allocatable :: counterpart(:, :)
   end type rotor_response_type

contains

   !> Of a model whose coefficients were found. Unbalance, bow and skew are those of the model's case.
   subroutine find_rotor_response(model, coefficients, found, error)
      type(machine_model), intent(in) :: model
      type(bearing_coefficients_type), intent(in) :: coefficients
      type(rotor_response_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      type(linear_bearing_type) :: synchronous
      logical :: ok
      integer :: i, k, modes
      associate (pivots => size(coefficients%modes), stations => model%rotor%stations)
         modes = maxval([(size(coefficients%modes(i)%eigenvalue), i=1, pivots)])
         allocate (found%unbalance(2, stations, pivots), found%shapes(2, stations, modes, pivots), &
            & found%of_reduction(modes, pivots), found%synchronous(pivots), found%of_elements( &
            & model%rotor%elements + size(model%others), modes, pivots), found%counterpart(modes, pivots))
         found%of_elements = ieee_value(1.0_wp, ieee_quiet_nan)
         found%shapes = 0
         found%of_reduction = 0
         found%counterpart = 0
         do i = 1, pivots
            call whirl(coefficients%with_rotor(i), found%unbalance(:, :, i))
            if (ok) call synchronous_rotor(model, coefficients%bearings(i), synchronous, ok)
            if (ok) call find_modes(synchronous, 0.0_wp, spread(1.0_wp, 1, model%rotor%positions), &
               & found%synchronous(i), ok)
            if (.not. ok) then
               call raise(error, numerics_error, 'the linear equations of the rotor with ' &
                  & //trim(coefficients%with_rotor(i)%pivot)//' pivots are singular')
               return
            end if
            do k = 1, size(coefficients%modes(i)%eigenvalue)
               found%shapes(:, :, k, i) = at_stations(model, coefficients%modes(i)%shape(:, k))
               found%of_reduction(k, i) = part_of_reduction(model, coefficients%with_rotor(i), &
                  & coefficients%modes(i)%shape(:, k), coefficients%modes(i)%eigenvalue(k))
               if (coefficients%modes(i)%eigenvalue(k)%im > 0) found%of_elements(:, k, i) = parts_of_elements(model, &
                  & coefficients%with_rotor(i), coefficients%modes(i)%shape(:, k), coefficients%modes(i)%eigenvalue(k))
            end do
            found%counterpart(:, i) = counterparts(model, coefficients%modes(i)%eigenvalue, found%shapes(:, :, :, i), &
               & found%synchronous(i))
         end do
      end associate

   contains

      !> The steady whirl under what turns with the shaft: (K + i Omega C - Omega^2 M) x = f.
      subroutine whirl(linear, stations)
         type(linear_bearing_type), intent(in) :: linear
         complex(wp), intent(out) :: stations(:, :)
         complex(wp), allocatable :: z(:, :), x(:), positions(:)
         type(operating_point_type) :: point
         real(wp) :: turning(model%rotor%positions), speed
         integer, allocatable :: kept(:)
         integer :: i
         speed = model%point%speed(0.0_wp)
         kept = pack([(i, i=1, size(linear%moves))], linear%moves)
         z = cmplx(linear%stiffness(kept, kept) - speed**2*linear%mass(kept, kept), &
            & speed*linear%damping(kept, kept), wp)
         allocate (positions(size(linear%moves)))
         positions = 0
         point = operating_point_type(model%inputs)
         point%speed_rpm = model%point%speed_rpm
         point%acceleration = 0
         point%moves = .false.
         if (allocated(point%excitations)) deallocate (point%excitations)
         associate (n => model%rotor%positions)
            ! f = Re(F exp(i phi)): F from f at phi = 0 and from df/dt = Re(i Omega F) there
            turning = model%rotor%turn(point, 0.0_wp)/speed
            positions(:n) = cmplx(model%rotor%force(spread(0.0_wp, 1, 2*n), point, 0.0_wp) &
               & - model%rotor%force(spread(0.0_wp, 1, 2*n), point%static(), 0.0_wp), -turning, wp)
         end associate
         x = positions(kept)
         call solve_complex(size(kept), 1, z, x, ok)
         positions = 0
         positions(kept) = x
         stations = at_stations(model, positions)
      end subroutine whirl
   end subroutine find_rotor_response

   !> Of modes with these eigenvalues and shapes, (2, station, mode), the one of others that is the same vibration: of
   !> all pairs whose shapes are more alike than not (by the criterion of Allemang and Brown, 1982) the nearest
   !> eigenvalues first, and each once; 0: none is. Forward and backward whirls of the same shape are not alike.
   function counterparts(model, eigenvalue, shapes, others) result(found)
      type(machine_model), intent(in) :: model
      complex(wp), intent(in) :: eigenvalue(:), shapes(:, :, :)
      type(vibration_modes_type), intent(in) :: others
      integer :: found(size(shapes, 3)), pair(2), i, k
      real(wp), parameter :: alike = 0.5_wp
      real(wp) :: distance(size(eigenvalue), size(others%eigenvalue))
      logical :: waiting(size(eigenvalue), size(others%eigenvalue))
      complex(wp) :: own(2*size(shapes, 2), size(eigenvalue)), theirs(2*size(shapes, 2))
      do i = 1, size(eigenvalue)
         own(:, i) = of_unit_length(shapes(:, :, i))
      end do
      waiting = .false.
      do k = 1, size(distance, 2)
         if (.not. others%eigenvalue(k)%im > 0) cycle
         theirs = of_unit_length(at_stations(model, others%shape(:, k)))
         distance(:, k) = abs(others%eigenvalue(k) - eigenvalue)
         do i = 1, size(distance, 1)
            if (eigenvalue(i)%im > 0) waiting(i, k) = abs(dot_product(own(:, i), theirs))**2 > alike
         end do
      end do
      found = 0
      do while (any(waiting))
         pair = minloc(distance, mask=waiting)
         found(pair(1)) = pair(2)
         waiting(pair(1), :) = .false.
         waiting(:, pair(2)) = .false.
      end do
   contains
      !> A shape at the stations as a vector of this length; 0 stays 0.
      pure function of_unit_length(shape) result(vector)
         complex(wp), intent(in) :: shape(:, :)
         complex(wp) :: vector(size(shape))
         vector = reshape(shape, [size(shape)])
         vector = vector/max(sqrt(sum(vector%re**2 + vector%im**2)), tiny(1.0_wp))
      end function of_unit_length
   end function counterparts

   !> The rotor on the stiffness and damping of bearings at the synchronous frequency. `ok` is false where there are
   !> none.
   subroutine synchronous_rotor(model, bearings, linear, ok)
      type(machine_model), intent(in) :: model
      type(linear_bearing_type), intent(in) :: bearings
      type(linear_bearing_type), intent(out) :: linear
      logical, intent(out) :: ok
      real(wp), allocatable, dimension(:, :) :: stiffness, damping
      real(wp), dimension(model%layout%n_positions(), model%layout%n_positions()) :: of_others, rates_of_others
      integer :: b, n
      ok = .true.
      n = model%rotor%positions
      linear%pivot = bearings%pivot
      linear%mass = model%rotor%masses()
      allocate (linear%stiffness(n, n), linear%damping(n, n))
      allocate (linear%moves(n), source=.true.)
      call model%rotor%force_derivatives(model%point%speed(0.0_wp), linear%stiffness, linear%damping)
      call other_derivatives(model, of_others, rates_of_others)
      linear%stiffness = -linear%stiffness - of_others(:n, :n)
      linear%damping = -linear%damping - rates_of_others(:n, :n)
      call take_high_damping(model, linear%damping)
      do b = 1, size(model%bearings)
         associate (of => model%layout%elements(b), at => model%layout%elements(b)%on_rotor())
            if (allocated(stiffness)) deallocate (stiffness, damping)
            allocate (stiffness(size(at), size(at)), damping(size(at), size(at)))
            call bearings%condense(of, 1.0_wp, model%point%speed(0.0_wp), stiffness, damping, ok)
            if (.not. ok) return
            linear%stiffness(at, at) = linear%stiffness(at, at) + stiffness
            linear%damping(at, at) = linear%damping(at, at) + damping
         end associate
      end do
   end subroutine synchronous_rotor

   !> What each element, and then each other thing that acts on the rotor, adds to the logarithmic decrement of a mode
   !> that vibrates. The real part of shape^H (lambda M + C + K/lambda) shape = 0 is a sum of what each matrix adds to
   !> -Re(lambda), over M + K/|lambda|^2 of the shape.
   function parts_of_elements(model, linear, shape, value) result(parts)
      type(machine_model), intent(in) :: model
      type(linear_bearing_type), intent(in) :: linear
      complex(wp), intent(in) :: shape(:), value
      real(wp) :: parts(model%rotor%elements + size(model%others)), c(2, 2, 3)
      real(wp), allocatable, dimension(:, :) :: over_positions, over_rates
      complex(wp) :: stiffness, mass
      integer :: e
      stiffness = dot_product(shape, matmul(linear%stiffness, shape))
      mass = dot_product(shape, matmul(linear%mass, shape))
      associate (n => model%rotor%elements, speed => model%point%speed(0.0_wp))
         select type (rotor => model%rotor)
         type is (elastic_rotor_type)
            do e = 1, n
               associate (of => rotor%matrices%elements(e), u => matmul(rotor%matrices%elements(e)%ends, &
                  & shape(:rotor%positions)))
                  c = of%coefficients(speed)
                  if (of%own_frequency) then
                     stiffness = stiffness - dot_product(u, matmul(c(:, :, 1), u))
                     mass = mass - dot_product(u, matmul(c(:, :, 3), u))
                     c = of%coefficients(speed, value%im)
                     stiffness = stiffness + dot_product(u, matmul(c(:, :, 1), u))
                     mass = mass + dot_product(u, matmul(c(:, :, 3), u))
                  end if
                  parts(e) = added(u, c)
               end associate
            end do
         end select
         do e = 1, size(model%others)
            associate (of => model%layout%elements(size(model%bearings) + e))
               call part_derivatives(model%others(e)%of, 1, 0, over_positions, over_rates)
               c(:, :, 1) = -over_positions
               c(:, :, 2) = -over_rates
               c(:, :, 3) = 0
               parts(n + e) = added(shape(of%journal), c)
            end associate
         end do
      end associate
      parts = 2*pi/value%im*parts/(real(mass) + real(stiffness)/abs(value)**2)
   contains
      pure real(wp) function added(u, c)
         complex(wp), intent(in) :: u(2)
         real(wp), intent(in) :: c(2, 2, 3)
         added = real(dot_product(u, matmul(c(:, :, 2), u))) + aimag(dot_product(u, matmul(c(:, :, 1), u)))*value%im &
            & /abs(value)**2 - aimag(dot_product(u, matmul(c(:, :, 3), u)))*value%im
      end function added
   end function parts_of_elements

   !> Part of the damping of a mode in a march that the reduction gives to the high modes of the shaft: the power of
   !> this damping in a vibration, over the sum of it and of the power with which the mode decays or grows without, or
   !> would with the damping ratio `slight`: what has less of its own is no high mode by that. 0 of what does not
   !> vibrate, or not faster than twice the speed of the shaft.
   pure real(wp) function part_of_reduction(model, linear, shape, eigenvalue) result(part)
      type(machine_model), intent(in) :: model
      type(linear_bearing_type), intent(in) :: linear
      complex(wp), intent(in) :: shape(:), eigenvalue
      real(wp), parameter :: slight = 0.01_wp, slow = 2
      part = 0
      if (.not. eigenvalue%im > slow*model%point%speed(0.0_wp)) return
      select type (rotor => model%rotor)
      type is (elastic_rotor_type)
         associate (power => sum(rotor%matrices%high_damping*abs(shape(:rotor%positions))**2), &
            & own => 2*max(abs(eigenvalue%re), slight*abs(eigenvalue)) &
            & *real(dot_product(shape, matmul(linear%mass, shape))))
            part = power/max(tiny(part), power + own)
         end associate
      end select
   end function part_of_reduction
end module rotor_response
