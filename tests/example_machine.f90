!> Machines of tests, and the linear vibration of their rotors in bearings that are springs and dampers.
module example_machine
   use kinds, only: wp, pi
   use linear_algebra, only: dgesv, zgesv, find_eigenvalues
   use errors, only: error_type
   use case_inputs, only: case_type
   use case_groups, only: bearing_type, disc_type, unbalance_type
   use rotor_reduction, only: rotor_matrices_type
   use rotor_factory, only: find_rotor
   use check, only: expect_no_error
   implicit none (type, external)
   private
   public :: turbine, plain_shaft, put_bearings, put_disc, put_unbalance, rotor_of, all_modes, unbalance_response, &
      & response_error, damping_error, static_stations, whirl_frequencies

   !> More modes than there are: all.
   integer, parameter :: all_modes = 1000

contains

   !> A turbine's rotor of 4 t in two bearings: a disc in the middle of a shaft of 1.8 m.
   function turbine() result(machine)
      type(case_type) :: machine
      integer :: i
      machine = plain_shaft([0.05_wp, 0.05_wp, (0.2_wp, i=1, 8), 0.05_wp, 0.05_wp], 0.34_wp)
      machine%rotor%elastic%shaft%diameter([1, 2, 11, 12]) = 0.0998_wp
      call put_disc(machine, 7, 2847.3706547456786_wp, 512.526717854222_wp, 280.5609218476075_wp)
      call put_bearings(machine, [2, 12])
      call put_unbalance(machine, 7, 0.02_wp, 0.0_wp)
   end function turbine

   !> A shaft of steel without discs and bearings.
   function plain_shaft(lengths, diameter) result(machine)
      real(wp), intent(in) :: lengths(:), diameter
      type(case_type) :: machine
      allocate (machine%rotor%elastic, machine%bearings(0), machine%excitations(0))
      machine%about%task = 'march'
      call machine%rotor%elastic%begin(0, 0, 0)
      associate (shaft => machine%rotor%elastic%shaft)
         shaft%length = lengths
         shaft%diameter = 0*lengths + diameter
         shaft%bore = 0*lengths
      end associate
   end function plain_shaft

   subroutine put_disc(machine, station, mass, polar_inertia, diametral_inertia)
      type(case_type), intent(inout) :: machine
      integer, intent(in) :: station
      real(wp), intent(in) :: mass, polar_inertia, diametral_inertia
      associate (elastic => machine%rotor%elastic)
         elastic%discs = [elastic%discs, disc_type(station, mass, polar_inertia, diametral_inertia)]
      end associate
   end subroutine put_disc

   !> Adds an unbalance, kg m, at an angle, deg.
   subroutine put_unbalance(machine, station, moment, angle_deg)
      type(case_type), intent(inout) :: machine
      integer, intent(in) :: station
      real(wp), intent(in) :: moment, angle_deg
      associate (elastic => machine%rotor%elastic)
         elastic%unbalances = [elastic%unbalances, unbalance_type(station, moment, angle_deg)]
      end associate
   end subroutine put_unbalance

   !> Bearings at these stations in place of those that are there.
   subroutine put_bearings(machine, stations)
      type(case_type), intent(inout) :: machine
      integer, intent(in) :: stations(:)
      integer :: b
      deallocate (machine%bearings)
      allocate (machine%bearings(size(stations)))
      do b = 1, size(stations)
         machine%bearings(b) = bearing_type()
         machine%bearings(b)%name = achar(iachar('a') + b - 1)
         machine%bearings(b)%station = stations(b)
      end do
   end subroutine put_bearings

   !> The rotor of a valid machine for a highest speed, rad/s.
   function rotor_of(machine, speed, modes) result(rotor)
      type(case_type), intent(in) :: machine
      real(wp), intent(in) :: speed
      integer, intent(in), optional :: modes
      type(rotor_matrices_type) :: rotor
      type(error_type), allocatable :: error
      call find_rotor(machine, speed, rotor, error, modes)
      call expect_no_error(error, 'a rotor is found')
   end function rotor_of

   !> Stiffness with springs, N/m, at the journals: y and z of each.
   function on_springs(rotor, springs) result(stiffness)
      type(rotor_matrices_type), intent(in) :: rotor
      real(wp), intent(in) :: springs(:)
      real(wp), allocatable :: stiffness(:, :)
      integer :: i
      stiffness = rotor%stiffness
      do i = 1, size(springs)
         stiffness(i, i) = stiffness(i, i) + springs(i)
      end do
   end function on_springs

   !> Complex amplitudes y and z of all stations, m, at a speed, rad/s, in bearings that are springs, N/m, and dampers,
   !> N s/m: y and z of each. The unbalances may grow in a radian by this part of themselves.
   function unbalance_response(rotor, speed, springs, dampers, growth) result(response)
      type(rotor_matrices_type), intent(in) :: rotor
      real(wp), intent(in) :: speed, springs(:), dampers(:)
      real(wp), intent(in), optional :: growth
      complex(wp) :: rate
      complex(wp), allocatable :: response(:), matrix(:, :), x(:, :)
      integer, allocatable :: pivots(:)
      integer :: n, i, info
      n = size(rotor%load)
      rate = cmplx(0.0_wp, speed, wp)
      if (present(growth)) rate = rate + growth*speed
      matrix = on_springs(rotor, springs) + rate**2*rotor%mass + rate*(rotor%damping + speed*rotor%gyroscopic)
      do i = 1, size(dampers)
         matrix(i, i) = matrix(i, i) + rate*dampers(i)
      end do
      x = reshape(speed**2*cmplx(rotor%unbalance(:, 1), -rotor%unbalance(:, 2), wp), [n, 1])
      allocate (pivots(n))
      call zgesv(n, 1, matrix, n, pivots, x, n, info)
      response = matmul(rotor%station, x(:, 1))
   end function unbalance_response

   !> The largest error of amplitudes of journals and discs at ten speeds up to the highest, rad/s, relative to the
   !> largest one of a speed: of leaving out modes.
   real(wp) function response_error(machine, highest, springs, dampers, modes, growth) result(error)
      type(case_type), intent(in) :: machine
      real(wp), intent(in) :: highest, springs(:), dampers(:)
      integer, intent(in), optional :: modes
      real(wp), intent(in), optional :: growth
      type(case_type) :: undamped
      undamped = machine
      undamped%rotor%elastic%reduction%damping_ratio = 0
      error = largest_difference(machine, rotor_of(undamped, highest, modes), rotor_of(undamped, highest, all_modes), &
         & highest, springs, dampers, growth)
   end function response_error

   !> The same error of the damping of high modes.
   real(wp) function damping_error(machine, highest, springs, dampers, growth) result(error)
      type(case_type), intent(in) :: machine
      real(wp), intent(in) :: highest, springs(:), dampers(:)
      real(wp), intent(in), optional :: growth
      type(case_type) :: undamped
      undamped = machine
      undamped%rotor%elastic%reduction%damping_ratio = 0
      error = largest_difference(machine, rotor_of(machine, highest), rotor_of(undamped, highest), highest, springs, &
         & dampers, growth)
   end function damping_error

   !> Of amplitudes of journals and discs of a rotor from those of an exact one.
   real(wp) function largest_difference(machine, rotor, exact, highest, springs, dampers, growth) result(largest)
      type(case_type), intent(in) :: machine
      type(rotor_matrices_type), intent(in) :: rotor, exact
      real(wp), intent(in) :: highest, springs(:), dampers(:)
      real(wp), intent(in), optional :: growth
      complex(wp), allocatable :: expected(:), difference(:)
      integer, allocatable :: rows(:)
      integer :: i
      rows = [machine%bearings%station, machine%rotor%elastic%discs%station]
      rows = [2*rows - 1, 2*rows]
      largest = 0
      do i = 1, 10
         expected = unbalance_response(exact, highest*i/10, springs, dampers, growth)
         difference = unbalance_response(rotor, highest*i/10, springs, dampers, growth) - expected
         largest = max(largest, maxval(abs(difference(rows)))/maxval(abs(expected)))
      end do
   end function largest_difference

   !> Where the stations are, y and z of each, m, in bearings that are springs; `displacements` of the rotor.
   function static_stations(rotor, springs, displacements) result(stations)
      type(rotor_matrices_type), intent(in) :: rotor
      real(wp), intent(in) :: springs(:)
      real(wp), allocatable, intent(out), optional :: displacements(:)
      real(wp), allocatable :: stations(:), matrix(:, :), x(:, :)
      integer, allocatable :: pivots(:)
      integer :: n, info
      n = size(rotor%load)
      matrix = on_springs(rotor, springs)
      x = reshape(rotor%load, [n, 1])
      allocate (pivots(n))
      call dgesv(n, 1, matrix, n, pivots, x, n, info)
      stations = matmul(rotor%station, x(:, 1)) + rotor%station_offset
      if (present(displacements)) displacements = x(:, 1)
   end function static_stations

   !> Frequencies, Hz, of the free vibration M x'' + C x' + K x = 0 that are not 0, the lowest first.
   function whirl_frequencies(mass, damping, stiffness) result(frequencies)
      real(wp), dimension(:, :), intent(in) :: mass, damping, stiffness
      real(wp), allocatable :: frequencies(:), factor(:, :), right(:, :), system(:, :)
      complex(wp), allocatable :: values(:)
      integer, allocatable :: pivots(:)
      real(wp) :: swapped
      integer :: n, i, j, info
      logical :: ok
      n = size(mass, 1)
      allocate (right(n, 2*n), system(2*n, 2*n), source=0.0_wp)
      allocate (pivots(n), values(2*n))
      factor = mass
      right(:, :n) = -stiffness
      right(:, n + 1:) = -damping
      call dgesv(n, 2*n, factor, n, pivots, right, n, info)
      system(n + 1:, :) = right
      do i = 1, n
         system(i, n + i) = 1
      end do
      call find_eigenvalues(system, values, ok)
      frequencies = pack(values%im, values%im > 0)/(2*pi)
      do i = 2, size(frequencies)
         do j = i, 2, -1
            if (frequencies(j) >= frequencies(j - 1)) exit
            swapped = frequencies(j)
            frequencies(j) = frequencies(j - 1)
            frequencies(j - 1) = swapped
         end do
      end do
   end function whirl_frequencies
end module example_machine
