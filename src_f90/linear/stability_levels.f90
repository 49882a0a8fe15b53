!> How stable a machine is under cross-coupled stiffness, as the stability levels of API 617 ask it: the first forward
!> mode with a stiffness Q from none to ten times the anticipated one, and its undamped critical speeds.
module stability_levels
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp, pi
   use errors, only: error_type, raise, input_error
   use linear_algebra, only: dsygv
   use roots, only: root_bracket
   use case_groups, only: impeller_type
   use case_inputs, only: case_type
   use equations_of_motion, only: machine_model
   use elastic_rotor, only: elastic_rotor_type
   use force_balance, only: mode_name, position_lengths
   use linear_bearing, only: linear_bearing_type, bearing_coefficients_type, vibration_modes_type, find_modes
   use own_frequencies, only: follow_mode
   use rotor_response, only: synchronous_rotor
   implicit none (type, external)
   private
   public :: stability_levels_type, find_stability_levels, matrices

   !> The ways in which bearings act in a mode: by the pads' own equations, or by synchronously reduced coefficients.
   character(len=*), parameter :: matrices(2) = ['full       ', 'synchronous']

   type :: stability_levels_type
      !> Of each impeller and their sum, N/m, and the station where that acts (0: each at its impeller).
      real(wp), allocatable :: impellers(:)
      real(wp) :: anticipated = 0
      integer :: station = 0
      !> Mean density of the gas, kg/m^3, between the first suction and the last discharge.
      real(wp) :: density = 0
      !> Q, N/m, and the first forward mode with each, 1/s, (Q, matrices, pivot); Q where it is as little damped as
      !> grown, (matrices, pivot). No number where there is none up to the last Q.
      real(wp), allocatable :: cross_stiffness(:), zero(:, :)
      complex(wp), allocatable :: eigenvalue(:, :, :)
      !> Undamped forward critical speeds, rad/s, (critical speed, stiffness), on bearings of a stiffness, N/m, alike
      !> along y and z; and on rigid ones. None of a rotor whose planes differ.
      real(wp), allocatable :: bearing_stiffness(:), critical(:, :), rigid(:)
   end type stability_levels_type

   !> Steps of Q, over the anticipated one; how like, from 0 to 1, the shapes of a mode are that was followed a step.
   integer, parameter :: steps = 40
   real(wp), parameter :: last_multiple = 10, alike = 0.9_wp
   !> Above this damping ratio nothing resonates: such a mode is none of the shaft's that whirls.
   real(wp), parameter :: damped = 0.5_wp
   !> 60/(2 pi), rounded as the standard has it; factors of the formula for centrifugal and axial stages.
   real(wp), parameter :: of_speed = 9.55_wp, of_centrifugal = 3, of_axial = 1.5_wp
   !> Decades of the stiffness of bearings on both sides of that of the shaft, stiffnesses in one; critical speeds kept.
   integer, parameter :: decades = 2, in_decade = 10, most_critical = 6

contains

   !> Of a machine with impellers whose coefficients were found.
   subroutine find_stability_levels(model, coefficients, found, error)
      type(machine_model), intent(in) :: model
      type(bearing_coefficients_type), intent(in) :: coefficients
      type(stability_levels_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      type(linear_bearing_type) :: reduced
      real(wp), allocatable :: cross(:, :), lengths(:)
      logical :: ok
      integer :: i, k
      select type (rotor => model%rotor)
      type is (elastic_rotor_type)
         call anticipate(model%inputs, rotor, found, cross, error)
         if (allocated(error)) return
         found%cross_stiffness = found%anticipated*last_multiple*[(real(k, wp)/steps, k=0, steps)]
         lengths = position_lengths(model)
         associate (pivots => size(coefficients%with_rotor))
            allocate (found%eigenvalue(steps + 1, 2, pivots), found%zero(2, pivots))
            do i = 1, pivots
               call follow(model, rotor, coefficients%with_rotor(i), cross, lengths, 1.0_wp, &
                  & found%cross_stiffness, found%eigenvalue(:, 1, i), found%zero(1, i))
               call synchronous_rotor(model, coefficients%bearings(i), reduced, ok)
               if (.not. ok) cycle
               call follow(model, rotor, reduced, cross, spread(1.0_wp, 1, rotor%positions), 0.0_wp, &
                  & found%cross_stiffness, found%eigenvalue(:, 2, i), found%zero(2, i))
            end do
         end associate
         call find_critical_speeds(rotor, model%point%sense, found)
      end select
   end subroutine find_stability_levels

   !> The anticipated cross-coupled stiffness, and the matrix of the rotor's displacements for one of 1 N/m: in the
   !> middle between the outer bearings, or in parts where impellers are that overhang.
   subroutine anticipate(inputs, rotor, found, cross, error)
      type(case_type), intent(in) :: inputs
      type(elastic_rotor_type), intent(in) :: rotor
      type(stability_levels_type), intent(inout) :: found
      real(wp), allocatable, intent(out) :: cross(:, :)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: turned(2, 2) = reshape([0.0_wp, -1.0_wp, 1.0_wp, 0.0_wp], [2, 2])
      real(wp), allocatable :: share(:)
      integer, allocatable :: stations(:)
      integer :: i, ends(2)
      associate (elastic => inputs%rotor%elastic, impellers => inputs%rotor%elastic%impellers)
         found%impellers = anticipated_at(impellers, inputs%operation%speed_rpm)
         found%anticipated = sum(found%impellers)
         found%density = (minval(impellers%suction_density) + maxval(impellers%discharge_density))/2
         if (any([(impellers(i)%kind == 'axial', i=1, size(impellers))])) found%density = ieee_value(0.0_wp, &
            & ieee_quiet_nan)
         ends = [minval(inputs%bearings%station), maxval(inputs%bearings%station)]
         if (allocated(elastic%lateral)) found%station = elastic%lateral%cross_station
         if (found%station == 0 .and. all(impellers%station > ends(1) .and. impellers%station < ends(2))) then
            associate (x => [(sum(elastic%shaft%length(:i)), i=0, size(elastic%shaft%length))])
               found%station = minloc(abs(x - (x(ends(1)) + x(ends(2)))/2), dim=1)
            end associate
         end if
         stations = impellers%station
         share = found%impellers/found%anticipated
         if (found%station > 0) then
            stations = [found%station]
            share = [1.0_wp]
         end if
      end associate
      if (maxval(stations) > rotor%stations) call raise(error, input_error, 'impeller%station or ' &
         & //'lateral%cross_station: must be a station of the rotor in rotor%file')
      if (allocated(error)) return
      allocate (cross(rotor%positions, rotor%positions), source=0.0_wp)
      do i = 1, size(stations)
         associate (at => rotor%matrices%station(2*stations(i) - 1:2*stations(i), :))
            cross = cross + inputs%sense()*share(i)*matmul(transpose(at), matmul(turned, at))
         end associate
      end do
   end subroutine anticipate

   !> Anticipated cross-coupled stiffness of a stage, N/m, at a speed, rpm.
   elemental real(wp) function anticipated_at(impeller, speed_rpm)
      type(impeller_type), intent(in) :: impeller
      real(wp), intent(in) :: speed_rpm
      anticipated_at = of_speed*impeller%power/(impeller%diameter*impeller%width*speed_rpm)
      if (impeller%kind == 'axial') anticipated_at = of_axial*anticipated_at
      if (impeller%kind == 'centrifugal') anticipated_at = of_centrifugal*anticipated_at*impeller%discharge_density &
         & /impeller%suction_density
   end function anticipated_at

   !> Follows the first forward mode of a rotor on its bearings over a stiffness, from where one whirls forward at all:
   !> without any it may be planar. `own` is 1 where its elements have the mode's own frequency, 0 that of the speed.
   subroutine follow(model, rotor, bearing, cross, lengths, own, q, eigenvalue, zero)
      type(machine_model), intent(in) :: model
      type(elastic_rotor_type), intent(in) :: rotor
      type(linear_bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: cross(:, :), lengths(:), own, q(0:)
      complex(wp), intent(out) :: eigenvalue(0:)
      real(wp), intent(out) :: zero
      complex(wp), allocatable :: shapes(:, :)
      complex(wp) :: value
      integer, allocatable :: kept(:)
      type(root_bracket) :: between
      logical :: ok
      integer :: i, first, k
      kept = pack([(i, i=1, size(bearing%moves))], bearing%moves)
      zero = ieee_value(1.0_wp, ieee_quiet_nan)
      eigenvalue = cmplx(zero, zero, wp)
      allocate (shapes(size(kept), 0:ubound(q, 1)))
      do first = steps/nint(last_multiple), ubound(q, 1)
         call find_forward(first, ok)
         if (ok) exit
      end do
      if (.not. ok) return
      do k = first - 1, 0, -1
         call go_on(k + 1, q(k), eigenvalue(k), shapes(:, k))
      end do
      do k = first + 1, ubound(q, 1)
         call go_on(k - 1, q(k), eigenvalue(k), shapes(:, k))
      end do
      k = findloc(eigenvalue%re > 0, .true., dim=1) - 1
      if (k == 0) zero = 0
      if (k <= 0) return
      between = root_bracket(q(k - 1:k), eigenvalue(k - 1:k)%re)
      do while (between%width() > 1e-9_wp*q(k))
         zero = between%estimate()
         call go_on(k - 1, zero, value, shapes(:, k))
         if (abs(value%re) <= 1e-9_wp*abs(value)) exit
         call between%narrow(zero, value%re)
      end do
   contains
      !> The slowest mode of the shaft that whirls forward, with q(k).
      subroutine find_forward(k, ok)
         integer, intent(in) :: k
         logical, intent(out) :: ok
         type(vibration_modes_type) :: modes
         type(error_type), allocatable :: error
         complex(wp) :: shape(model%layout%n_positions())
         logical, allocatable :: forward(:)
         real(wp), parameter :: parts(4) = [0.25_wp, 0.5_wp, 0.75_wp, 1.0_wp]
         integer :: i
         call find_modes(with(q(k)), 0.0_wp, lengths, modes, ok)
         if (.not. ok) return
         allocate (forward(size(modes%eigenvalue)))
         do i = 1, size(forward)
            shape = 0
            shape(:size(lengths)) = modes%shape(:, i)
            forward(i) = modes%eigenvalue(i)%im > 0 .and. modes%damping_ratio(i) < damped
            if (forward(i)) forward(i) = mode_name(model, shape, position_lengths(model), .true.) == 'shaft, forward'
         end do
         ok = any(forward)
         if (.not. ok) return
         i = minloc(modes%eigenvalue%im, dim=1, mask=forward)
         eigenvalue(k) = modes%eigenvalue(i)
         shapes(:, k) = modes%shape(kept, i)
         do i = 1, size(parts)
            call take_frequency(with(q(k)), own*parts(i), eigenvalue(k), shapes(:, k), error)
         end do
         ok = .not. allocated(error)
      end subroutine find_forward

      !> The mode with another stiffness, from that with q(start): in steps, so short that it keeps its shape.
      subroutine go_on(start, stiffness, value, shape)
         integer, intent(in) :: start
         real(wp), intent(in) :: stiffness
         complex(wp), intent(out) :: value, shape(:)
         type(error_type), allocatable :: error
         complex(wp) :: next, moved(size(shape))
         real(wp) :: at, step
         value = eigenvalue(start)
         shape = shapes(:, start)
         at = q(start)
         step = stiffness - at
         do while (abs(stiffness - at) > 0)
            next = value
            moved = shape
            call take_frequency(with(at + step), own, next, moved, error)
            if (abs(dot_product(shape, moved)) < alike*norm2(abs(shape))*norm2(abs(moved)) .or. allocated(error)) then
               step = step/2
               if (allocated(error)) deallocate (error)
               if (abs(step) < 1e-6_wp*q(ubound(q, 1))) then
                  value = cmplx(zero, zero, wp)
                  return
               end if
               cycle
            end if
            value = next
            shape = moved
            at = at + step
            if (abs(stiffness - at) <= 1e-12_wp*abs(stiffness)) at = stiffness
            step = stiffness - at
         end do
      end subroutine go_on

      !> Brings a mode of the rotor on its bearings to its own frequency, or this part of what that changes.
      subroutine take_frequency(all, part, value, shape, error)
         type(linear_bearing_type), intent(in) :: all
         real(wp), intent(in) :: part
         complex(wp), intent(inout) :: value, shape(:)
         type(error_type), allocatable, intent(inout) :: error
         call follow_mode(rotor, model%point%speed(0.0_wp), all%stiffness(kept, kept), all%damping(kept, kept), &
            & all%mass(kept, kept), part, value, shape, error)
      end subroutine take_frequency

      !> The rotor on its bearings with a cross-coupled stiffness.
      type(linear_bearing_type) function with(stiffness)
         real(wp), intent(in) :: stiffness
         with = bearing
         associate (n => size(cross, 1))
            with%stiffness(:n, :n) = with%stiffness(:n, :n) + stiffness*cross
         end associate
      end function with
   end subroutine follow

   !> Undamped critical speeds of synchronous forward whirl, where a circle in both planes makes one of the equations:
   !> (K - omega^2 (M - G)) x = 0, with housings held.
   subroutine find_critical_speeds(rotor, sense, found)
      type(elastic_rotor_type), intent(in) :: rotor
      real(wp), intent(in) :: sense
      type(stability_levels_type), intent(inout) :: found
      integer, allocatable :: y(:)
      real(wp) :: least
      integer :: i, first
      associate (m => rotor%matrices, n => 2*rotor%journals)
         first = rotor%positions - 2*size(m%mode_frequency) + 1
         ! a mode in each plane
         allocate (found%critical(0, 0), found%bearing_stiffness(0), found%rigid(0))
         if (first <= n .or. size(m%mode_frequency) == 0) return
         found%rigid = critical_speeds([(i, i=first, rotor%positions, 2)], 0.0_wp)
         y = [(i, i=1, n, 2), (i, i=first, rotor%positions, 2)]
         least = m%total_mass*(2*pi*minval(m%mode_frequency))**2
         found%bearing_stiffness = least*[(10.0_wp**(real(i, wp)/in_decade), i=-decades*in_decade, decades*in_decade)]
         found%critical = reshape([(critical_speeds(y, found%bearing_stiffness(i)), &
            & i=1, size(found%bearing_stiffness))], [most_critical, size(found%bearing_stiffness)])
      end associate
   contains
      !> Those of displacements along y, with this stiffness under the journals.
      function critical_speeds(y, stiffness) result(speeds)
         integer, intent(in) :: y(:)
         real(wp), intent(in) :: stiffness
         real(wp) :: speeds(most_critical), k(size(y), size(y)), m(size(y), size(y)), mu(size(y)), work(34*size(y))
         integer :: i, info
         associate (from => rotor%matrices, z => y + 1)
            k = (from%stiffness(y, y) + from%stiffness(z, z))/2
            m = (from%mass(y, y) + from%mass(z, z))/2 - sense*from%gyroscopic(y, z)
         end associate
         do i = 1, count(y <= 2*rotor%journals)
            k(i, i) = k(i, i) + stiffness
         end do
         ! mu = 1/omega^2, below 0 where gyroscopic moments leave none
         call dsygv(1, 'N', 'U', size(y), m, size(y), k, size(y), mu, work, size(work), info)
         speeds = ieee_value(1.0_wp, ieee_quiet_nan)
         do i = 1, merge(min(most_critical, count(mu > 0)), 0, info == 0)
            speeds(i) = 1/sqrt(mu(size(mu) + 1 - i))
         end do
      end function critical_speeds
   end subroutine find_critical_speeds
end module stability_levels
