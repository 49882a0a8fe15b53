!> What the equations of a machine, linearised at its equilibrium, say beside its modes: the steady whirl of its
!> stations under the unbalance; the stations in each mode; and the modes with each bearing's synchronous stiffness and
!> damping in the place of its pads, as rotor dynamics without pads has them.
module rotor_response
   use kinds, only: wp
   use linear_algebra, only: zgesv
   use errors, only: error_type, raise, numerics_error
   use operating_point, only: operating_point_type
   use equations_of_motion, only: machine_model
   use elastic_rotor, only: elastic_rotor_type
   use mode_names, only: at_stations
   use linear_bearing, only: linear_bearing_type, vibration_modes_type, bearing_coefficients_type, find_modes
   implicit none (type, external)
   private
   public :: rotor_response_type, find_rotor_response

   !> One element, or the last dimension, for each way that the pivots may behave.
   type :: rotor_response_type
      !> Stations under the unbalance, m, (2, station, pivot): y and z are the real parts of these times
      !> exp(i shaft angle).
      complex(wp), allocatable :: unbalance(:, :, :)
      !> Stations in the modes, m, (2, station, mode, pivot); 0 of modes that there are not.
      complex(wp), allocatable :: shapes(:, :, :, :)
      !> Part of the damping of each mode that the reduction gives to high modes, (mode, pivot); 0 of modes that there
      !> are not.
      real(wp), allocatable :: of_reduction(:, :)
      !> Modes of the rotor on synchronously reduced coefficients.
      type(vibration_modes_type), allocatable :: synchronous(:)
   end type rotor_response_type

contains

   !> Of a model whose coefficients were found. The unbalance is that of the model's case.
   subroutine find_rotor_response(model, coefficients, found, error)
      type(machine_model), intent(in) :: model
      type(bearing_coefficients_type), intent(in) :: coefficients
      type(rotor_response_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      logical :: ok
      integer :: i, k, modes
      associate (pivots => size(coefficients%modes), stations => model%rotor%stations)
         modes = maxval([(size(coefficients%modes(i)%eigenvalue), i=1, pivots)])
         allocate (found%unbalance(2, stations, pivots), found%shapes(2, stations, modes, pivots), &
            & found%of_reduction(modes, pivots), found%synchronous(pivots))
         found%shapes = 0
         found%of_reduction = 0
         do i = 1, pivots
            call whirl(model, coefficients%with_rotor(i), found%unbalance(:, :, i), ok)
            if (ok) call reduce(model, coefficients%bearings(i), found%synchronous(i), ok)
            if (.not. ok) then
               call raise(error, numerics_error, 'the linear equations of the rotor with ' &
                  & //trim(coefficients%with_rotor(i)%pivot)//' pivots are singular')
               return
            end if
            do k = 1, size(coefficients%modes(i)%eigenvalue)
               found%shapes(:, :, k, i) = at_stations(model, coefficients%modes(i)%shape(:, k))
               found%of_reduction(k, i) = part_of_reduction(model, coefficients%with_rotor(i), &
                  & coefficients%modes(i)%shape(:, k), coefficients%modes(i)%eigenvalue(k))
            end do
         end do
      end associate
   end subroutine find_rotor_response

   !> Part of the damping of a mode that the reduction gives to the high modes of the shaft: the power of this damping
   !> in a vibration, over the power with which the vibration decays. 0 of what does not vibrate.
   pure real(wp) function part_of_reduction(model, linear, shape, eigenvalue) result(part)
      type(machine_model), intent(in) :: model
      type(linear_bearing_type), intent(in) :: linear
      complex(wp), intent(in) :: shape(:), eigenvalue
      part = 0
      if (.not. eigenvalue%im > 0) return
      select type (rotor => model%rotor)
      type is (elastic_rotor_type)
         part = sum(rotor%matrices%high_damping*abs(shape(:rotor%positions))**2)/max(tiny(part), &
            & 2*abs(eigenvalue%re)*real(dot_product(shape, matmul(linear%mass, shape))))
      end select
   end function part_of_reduction

   !> The steady whirl under the unbalance: (K + i Omega C - Omega^2 M) x = f.
   subroutine whirl(model, linear, stations, ok)
      type(machine_model), intent(in) :: model
      type(linear_bearing_type), intent(in) :: linear
      complex(wp), intent(out) :: stations(:, :)
      logical, intent(out) :: ok
      complex(wp), allocatable :: z(:, :), x(:), positions(:)
      type(operating_point_type) :: point
      real(wp) :: turning(model%rotor%positions), speed
      integer, allocatable :: kept(:), pivots(:)
      integer :: i, info
      speed = model%point%speed(0.0_wp)
      kept = pack([(i, i=1, size(linear%moves))], linear%moves)
      z = cmplx(linear%stiffness(kept, kept) - speed**2*linear%mass(kept, kept), speed*linear%damping(kept, kept), wp)
      allocate (positions(size(linear%moves)), pivots(size(kept)))
      positions = 0
      point = operating_point_type(model%inputs)
      point%speed_rpm = model%point%speed_rpm
      point%acceleration = 0
      if (allocated(point%excitations)) deallocate (point%excitations)
      associate (n => model%rotor%positions)
         ! f = Re(F exp(i phi)): F from f at phi = 0 and from df/dt = Re(i Omega F) there
         turning = model%rotor%turn(point, 0.0_wp)/speed
         positions(:n) = cmplx(model%rotor%force(spread(0.0_wp, 1, 2*n), point, 0.0_wp) &
            & - model%rotor%force(spread(0.0_wp, 1, 2*n), point%static(), 0.0_wp), -turning, wp)
      end associate
      x = positions(kept)
      call zgesv(size(kept), 1, z, size(kept), pivots, x, size(kept), info)
      ok = info == 0
      positions = 0
      positions(kept) = x
      stations = at_stations(model, positions)
   end subroutine whirl

   !> The modes of the rotor on the stiffness and damping of bearings at the synchronous frequency.
   subroutine reduce(model, bearings, modes, ok)
      type(machine_model), intent(in) :: model
      type(linear_bearing_type), intent(in) :: bearings
      type(vibration_modes_type), intent(out) :: modes
      logical, intent(out) :: ok
      type(linear_bearing_type) :: linear
      real(wp) :: stiffness(2, 2), damping(2, 2)
      integer :: b, n
      n = model%rotor%positions
      linear%pivot = bearings%pivot
      linear%mass = model%rotor%masses()
      allocate (linear%stiffness(n, n), linear%damping(n, n))
      allocate (linear%moves(n), source=.true.)
      call model%rotor%force_derivatives(model%point%speed(0.0_wp), linear%stiffness, linear%damping)
      linear%stiffness = -linear%stiffness
      linear%damping = -linear%damping
      do b = 1, size(model%bearings)
         associate (of => model%layout%elements(b), at => model%layout%elements(b)%journal)
            call bearings%condense(of%all_positions(), 1.0_wp, model%point%speed(0.0_wp), stiffness, damping, ok)
            if (.not. ok) return
            linear%stiffness(at, at) = linear%stiffness(at, at) + stiffness
            linear%damping(at, at) = linear%damping(at, at) + damping
         end associate
      end do
      call find_modes(linear, 0.0_wp, spread(1.0_wp, 1, n), modes, ok)
   end subroutine reduce
end module rotor_response
