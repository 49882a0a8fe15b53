!> A rotor in few displacements: how many modes with its journals held (fixed_interface) it keeps, and what the others
!> and the damping of the high ones cost; and the equations that the time integration has of a shaft.
module rotor_reduction
   use kinds, only: wp, pi, rpm
   use linear_algebra, only: zgbsv, solve_complex
   use sparse_matrix, only: sparse_matrix_type
   use case_groups, only: is_set, mount_type, station_element_type
   use case_inputs, only: case_type
   use rotor_component, only: rotor_component_type, static_forces, unbalance_moments
   use fixed_interface, only: fixed_interface_type
   use linear_element, only: relative_displacements, add_supports, housing_pair
   use bent_shaft, only: bow_forces, skew_moments
   use acting_element, only: acting_element_type, new_acting_element
   implicit none (type, external)
   private
   public :: mode_selection_type, select_modes, damped_above, far_above, most_modes, rotor_matrices_type, reduced_rotor

   !> A forced vibration q exp(rate*t) of a rotor at a speed, rad/s.
   type :: vibration_type
      real(wp) :: speed = 0
      complex(wp) :: rate = 0
      !> (n, loads), and where the stations are: observed%times(q); rows of those by which modes are chosen.
      real(wp), allocatable :: loads(:, :)
      type(sparse_matrix_type) :: observed
      integer, allocatable :: chosen_by(:)
      !> Displacements of the journals, and the dynamic stiffness of their bearings, N/m.
      integer, allocatable :: journals(:)
      complex(wp), allocatable :: bearings(:)
   contains
      procedure :: exact
      procedure :: reduced
   end type vibration_type

   !> The same in few displacements x: stiffness x = loads; matmul(observed, x).
   type :: reduced_vibration_type
      complex(wp), allocatable :: stiffness(:, :)
      real(wp), allocatable :: loads(:, :), observed(:, :)
   contains
      procedure :: amplitudes
   end type reduced_vibration_type

   !> Matrices of a rotor in few displacements.
   type :: projection_type
      real(wp), allocatable, dimension(:, :) :: mass, damping, gyroscopic, stiffness, circulatory
   end type projection_type

   !> Modes kept in a plane, and errors of amplitudes at the highest speed, relative to the largest one: of journals and
   !> discs by leaving out the others and, in a motion, by damping those above a frequency, Hz; of all stations by
   !> leaving out the others.
   type :: mode_selection_type
      integer :: modes = 0
      real(wp) :: truncation_error = 0, damping_error = 0, damped_above = 0, station_error = 0
   end type mode_selection_type

   !> The modes are chosen for this error of amplitudes, and include all below this multiple of the highest speed, and
   !> below this frequency, Hz, so that a map over speeds has the same vibrations at all of them.
   real(wp), parameter :: target_error = 1e-4_wp, lowest_multiple = 3, lowest_frequency = 500
   !> Modes below this multiple of the highest frequency are not damped, nor are those below `lowest_frequency`.
   real(wp), parameter :: far_above = 4
   !> Most modes that a rotor keeps, those of both planes: a march has dense matrices of them.
   integer, parameter :: most_modes = 120
   !> Amplitudes are compared in a vibration that grows so fast, relative to its frequency: as with this damping ratio.
   real(wp), parameter :: growth = 0.05_wp

   !> M x'' + (C + Omega G) x' + (K + Omega N) x = load + forces of the bearings + unbalance. Displacements x: first
   !> those of the journals relative to their bearings, y and z of each; then those of the housings that have supports,
   !> y and z of each, m, 0 where the spring is not loaded; then slopes of journals against their bearings, dy/dx and
   !> dz/dx of each that counts in a film; then the amplitudes of the modes with the journals held, in
   !> y and z of each (kg^1/2 m), whose mass is 1. The weight of a housing acts on its support.
   type, extends(mode_selection_type) :: rotor_matrices_type
      integer :: journals = 0
      real(wp), allocatable, dimension(:, :) :: mass, damping, gyroscopic, stiffness
      !> N, of internal damping; not allocated where there is none.
      real(wp), allocatable :: circulatory(:, :)
      !> Damping of the displacements that the reduction adds, as they are modes above `damped_above`, 1/s.
      real(wp), allocatable :: high_damping(:)
      !> Weight (along -y), static loads, and what the offsets of the bearings bend.
      real(wp), allocatable :: load(:)
      !> (n, 2): the force of the unbalances at the shaft angle phi is Omega**2*(unbalance(:, 1)*cos(phi)
      !> + unbalance(:, 2)*sin(phi)) + Omega'*(unbalance(:, 1)*sin(phi) - unbalance(:, 2)*cos(phi)).
      real(wp), allocatable :: unbalance(:, :)
      !> The same of skew discs; the force of a bow is bow(:, 1)*cos(phi) + bow(:, 2)*sin(phi). Not allocated where
      !> there is neither.
      real(wp), allocatable :: skew(:, :), bow(:, :)
      !> Where the shaft is at its stations, m: y and z of station 1, y and z of station 2, ... are
      !> matmul(station, x) + station_offset. The offset has what the bearings' offsets and the modes that are left out
      !> have of the static deflection, which is exact so. The same of the slopes dy/dx and dz/dx.
      real(wp), allocatable :: station(:, :), station_offset(:), slope(:, :), slope_offset(:)
      !> Of each bearing the pair of displacements that are its slopes, 0: there is none; half its width, m.
      integer, allocatable :: slope_pairs(:)
      real(wp), allocatable :: half_width(:)
      !> Of the rotor without housings, kg.
      real(wp) :: total_mass = 0
      !> Frequencies of the kept modes, Hz (each in both planes of a shaft); of the first that is left out, 0: none is.
      real(wp), allocatable :: mode_frequency(:)
      real(wp) :: left_out_frequency = 0
      !> How many of these, in a plane, are what the modes of the shaft leave out of the deflections under elements.
      integer :: residual_modes = 0
      !> Where there are some.
      type(acting_element_type), allocatable :: elements(:)
   end type rotor_matrices_type

contains

   ! How many modes are kept.

   !> Chooses the modes for a highest speed, rad/s: by `reduction%frequency`, or else by the error of amplitudes. These
   !> are then found. More than `most_modes` are counted alone, to be refused.
   subroutine select_modes(inputs, component, fixed, border, highest_speed, selection)
      type(case_type), intent(in) :: inputs
      type(rotor_component_type), intent(in) :: component
      type(fixed_interface_type), intent(inout) :: fixed
      !> Displacements of the journals, and their slopes that count in films.
      integer, intent(in) :: border(:)
      real(wp), intent(in) :: highest_speed
      type(mode_selection_type), intent(inout) :: selection
      type(vibration_type) :: whole
      type(reduced_vibration_type) :: reduced
      complex(wp), allocatable :: exact(:, :), found(:, :)
      real(wp), allocatable :: damping(:)
      logical :: given
      integer :: most, tried, i
      associate (frequency => inputs%rotor%elastic%reduction%frequency, modes => selection%modes)
         given = is_set(frequency)
         most = min(size(fixed%frequency), most_modes/fixed%planes)
         if (given) then
            modes = count(fixed%frequency <= 2*pi*frequency)
         else
            modes = min(most, count(fixed%frequency <= max(lowest_multiple*highest_speed, 2*pi*lowest_frequency)))
         end if
         if (modes > most) return
         whole = new_vibration(inputs, component, fixed, border, highest_speed)
         exact = whole%exact(component)
         tried = modes
         call fixed%find_modes(tried)
         reduced = whole%reduced(component, fixed%basis(tried))
         do
            found = reduced%amplitudes(size(border) + fixed%planes*modes)
            selection%truncation_error = amplitude_error(found(whole%chosen_by, :), exact(whole%chosen_by, :))
            if (given .or. modes == most .or. selection%truncation_error <= target_error) exit
            modes = modes + 1
            if (modes <= tried) cycle
            ! twice as many, so that the matrices are projected a few times at most
            tried = min(2*modes, most)
            call fixed%find_modes(tried)
            reduced = whole%reduced(component, fixed%basis(tried))
         end do
         selection%station_error = amplitude_error(found, exact)
         if (.not. inputs%moves()) return
         damping = mode_damping(inputs%rotor%elastic%reduction%damping_ratio, fixed, selection)
         do i = 1, size(damping)
            associate (element => reduced%stiffness(size(border) + i, size(border) + i))
               element = element + whole%rate*damping(i)
            end associate
         end do
         exact = reduced%amplitudes(size(border) + size(damping))
         selection%damping_error = amplitude_error(exact(whole%chosen_by, :), found(whole%chosen_by, :))
      end associate
   end subroutine select_modes

   !> Vibration of a rotor at a speed, rad/s: the loads are its mass along y, as of an even eccentricity,
   !> and its unbalances. Modes are chosen by journals and discs: a force in between also deflects the shaft just
   !> where it acts, which takes many modes. The bearings are springs and dampers that resist the journals as
   !> much as the rotor itself does, where both matter most.
   function new_vibration(inputs, component, fixed, border, speed) result(vibration)
      type(case_type), intent(in) :: inputs
      type(rotor_component_type), intent(in) :: component
      type(fixed_interface_type), intent(in) :: fixed
      integer, intent(in) :: border(:)
      real(wp), intent(in) :: speed
      type(vibration_type) :: vibration
      type(projection_type) :: static
      real(wp), allocatable :: moments(:, :)
      type(mount_type), allocatable :: mounts(:)
      integer, allocatable :: rows(:)
      integer :: i
      mounts = inputs%mounts()
      vibration%speed = speed
      vibration%rate = speed*cmplx(growth, 1.0_wp, wp)
      vibration%journals = border
      static = projected_matrices(component, fixed%basis(0))
      vibration%bearings = [(cmplx(1.0_wp, 1.0_wp, wp)*(static%stiffness(i, i) &
         & + abs(vibration%rate)**2*static%mass(i, i)), i=1, size(border))]
      associate (station => component%station)
         moments = unbalance_moments(inputs%rotor%elastic%unbalances, station%rows, component%sense)
         vibration%loads = reshape([component%weighed, station%transposed_times(moments(1, :))], [station%columns, 2])
         if (size(inputs%rotor%elastic%bows) > 0) vibration%loads = reshape([vibration%loads, bow_forces( &
            & inputs%rotor%elastic, mounts%station, component)], [station%columns, 4])
         rows = [mounts%station, inputs%rotor%elastic%discs%station]
         vibration%chosen_by = [2*rows - 1, 2*rows]
         vibration%observed = station
      end associate
   end function new_vibration

   !> Frequency, Hz, above which modes are damped: as given, or by the highest speed, rad/s, and the excitations.
   pure real(wp) function damped_above(inputs, highest_speed)
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: highest_speed
      damped_above = inputs%rotor%elastic%reduction%damp_above
      if (is_set(damped_above)) return
      damped_above = max(lowest_frequency, far_above*max(highest_speed/(2*pi), &
         & maxval(inputs%excitations%highest_frequency(highest_speed))))
   end function damped_above

   !> Damping of the modes in each plane, of modal mass 1, 1/s: those above a frequency have a damping ratio. Without
   !> damping they hold up an integrator of high order.
   pure function mode_damping(ratio, fixed, selection) result(damping)
      real(wp), intent(in) :: ratio
      type(fixed_interface_type), intent(in) :: fixed
      type(mode_selection_type), intent(in) :: selection
      real(wp) :: damping(fixed%planes*selection%modes)
      integer :: p
      associate (frequency => fixed%frequency(:selection%modes))
         do p = 1, fixed%planes
            damping(p::fixed%planes) = merge(2*ratio*frequency, 0.0_wp, frequency > 2*pi*selection%damped_above)
         end do
      end associate
   end function mode_damping

   ! How well a reduced rotor vibrates: amplitudes of forced vibrations, compared with those of the whole one.

   !> Amplitudes of the whole rotor, (observed, load), m. A growing vibration on dampers has no resonance.
   function exact(self, component)
      class(vibration_type), intent(in) :: self
      type(rotor_component_type), intent(in) :: component
      complex(wp), allocatable :: exact(:, :), matrix(:, :), x(:, :)
      integer :: pivots(size(self%loads, 1)), n, k, i, info
      n = size(self%loads, 1)
      associate (c => component, rate => self%rate)
         k = max(c%mass%half_band_width(), c%damping%half_band_width(), c%gyroscopic%half_band_width(), &
            & c%stiffness%half_band_width())
         allocate (matrix(3*k + 1, n), source=(0.0_wp, 0.0_wp))
         matrix(k + 1:, :) = rate**2*c%mass%band(k, k) + rate*(c%damping%band(k, k) + self%speed &
            & *c%gyroscopic%band(k, k)) + c%stiffness%band(k, k)
         if (allocated(c%circulatory)) matrix(k + 1:, :) = matrix(k + 1:, :) + self%speed*c%circulatory%band(k, k)
      end associate
      do i = 1, size(self%journals)
         associate (element => matrix(2*k + 1, self%journals(i)))
            element = element + self%bearings(i)
         end associate
      end do
      x = cmplx(self%loads, kind=wp)
      call zgbsv(n, k, k, size(x, 2), matrix, 3*k + 1, pivots, x, n, info)
      exact = cmplx(self%observed%times(x%re), self%observed%times(x%im), wp)
   end function exact

   !> The same vibration in displacements x with q = matmul(basis, x), of which the first are those of the journals.
   pure function reduced(self, component, basis) result(problem)
      class(vibration_type), intent(in) :: self
      type(rotor_component_type), intent(in) :: component
      real(wp), intent(in) :: basis(:, :)
      type(reduced_vibration_type) :: problem
      type(projection_type) :: p
      integer :: i
      p = projected_matrices(component, basis)
      problem%stiffness = self%rate**2*p%mass + self%rate*(p%damping + self%speed*p%gyroscopic) + p%stiffness
      if (allocated(p%circulatory)) problem%stiffness = problem%stiffness + self%speed*p%circulatory
      do i = 1, size(self%bearings)
         problem%stiffness(i, i) = problem%stiffness(i, i) + self%bearings(i)
      end do
      problem%loads = matmul(transpose(basis), self%loads)
      problem%observed = self%observed%times(basis)
   end function reduced

   !> Amplitudes of the first n displacements' motion, the others being held: (observed, load), m.
   function amplitudes(self, n)
      class(reduced_vibration_type), intent(in) :: self
      integer, intent(in) :: n
      complex(wp), allocatable :: amplitudes(:, :), x(:, :)
      logical :: ignored
      x = cmplx(self%loads(:n, :), kind=wp)
      call solve_complex(n, size(x, 2), self%stiffness(:n, :n), x, ignored)
      amplitudes = matmul(self%observed(:, :n), x)
   end function amplitudes

   !> The largest error of amplitudes, relative to the largest amplitude under the same load.
   pure real(wp) function amplitude_error(found, exact) result(error)
      complex(wp), intent(in) :: found(:, :), exact(:, :)
      integer :: i
      error = 0
      do i = 1, size(exact, 2)
         error = max(error, maxval(abs(found(:, i) - exact(:, i)))/max(maxval(abs(exact(:, i))), tiny(1.0_wp)))
      end do
   end function amplitude_error

   ! The equations of the rotor with the modes that it keeps.

   !> The rotor of a case with the selected modes in its bearings.
   function reduced_rotor(inputs, component, fixed, selection) result(r)
      type(case_type), intent(in) :: inputs
      type(rotor_component_type), intent(in) :: component
      type(fixed_interface_type), intent(inout) :: fixed
      type(mode_selection_type), intent(in) :: selection
      type(rotor_matrices_type) :: r
      real(wp), allocatable :: basis(:, :), into(:, :), offset(:), force(:), deflection(:)
      type(mount_type), allocatable :: mounts(:)
      integer :: i, modes, held
      mounts = inputs%mounts()
      associate (inclined => inputs%inclined(), n => size(inputs%bearings))
         held = 2*(size(mounts) + size(inclined))
         allocate (r%slope_pairs(n), source=0)
         r%slope_pairs(inclined) = housing_pair(mounts, size(mounts)) + [(i, i=1, size(inclined))]
         r%half_width = [(0.5_wp*maxval(inputs%bearings(i)%axial_length), i=1, n)]
         offset = [(mounts(i)%offset, i=1, size(mounts)), (inputs%bearings(inclined(i))%misalignment, &
            & i=1, size(inclined))]
      end associate
      r%mode_selection_type = selection
      modes = selection%modes
      if (modes < size(fixed%frequency)) r%left_out_frequency = fixed%frequency(modes + 1)/(2*pi)
      force = unit_loads(inputs, component)
      if (size(force) > 0) call fixed%add_residual_modes(reshape(force, [component%station%columns/component%planes, &
         & size(force)*component%planes/component%station%columns]), modes, r%residual_modes)
      modes = modes + r%residual_modes
      r%modes = modes
      r%journals = size(inputs%bearings)
      basis = fixed%basis(modes)
      into = relative_displacements(mounts, size(basis, 2))
      call reduce_matrices(component, basis, into, held, r)
      force = component%station%transposed_times(static_forces(inputs%rotor%elastic%loads, component%station%rows)) &
         & - inputs%rotor%gravity*component%weighed
      deflection = matmul(basis(:, :held), offset)
      r%load = matmul(matmul(force - component%stiffness%times(deflection), basis), into)
      deflection = deflection + fixed%residual_deflection(force, modes)
      basis = matmul(basis, into)
      r%station = component%station%times(basis)
      r%station_offset = component%station%times(deflection)
      r%slope = component%slope%times(basis)
      r%slope_offset = component%slope%times(deflection)
      r%unbalance = transpose(matmul(unbalance_moments(inputs%rotor%elastic%unbalances, component%station%rows, &
         & component%sense), r%station))
      if (any(inputs%rotor%elastic%discs%skew > 0) .or. size(inputs%rotor%elastic%bows) > 0) then
         r%skew = transpose(matmul(skew_moments(inputs%rotor%elastic, component%slope%rows, component%sense), r%slope))
         r%bow = matmul(transpose(basis), bow_forces(inputs%rotor%elastic, mounts%station, component))
      end if
      r%total_mass = component%total_mass
      r%mode_frequency = fixed%frequency(:modes)/(2*pi)
      ! the last displacements are the modes
      r%high_damping = [spread(0.0_wp, 1, size(r%load) - fixed%planes*modes), &
         & mode_damping(inputs%rotor%elastic%reduction%damping_ratio, fixed, r%mode_selection_type)]
      do i = 1, size(r%load)
         r%damping(i, i) = r%damping(i, i) + r%high_damping(i)
      end do
      call add_supports(mounts, inputs%rotor%gravity, r%mass, r%damping, r%stiffness, r%load)
      call add_elements(inputs, mounts, r)
   end function reduced_rotor

   !> Loads, one after the other as forces_at has them, of which no deflection is left out: those of elements, and the
   !> moments of skew discs.
   pure function unit_loads(inputs, component) result(loads)
      type(case_type), intent(in) :: inputs
      type(rotor_component_type), intent(in) :: component
      real(wp), allocatable :: loads(:), forces(:, :)
      type(station_element_type), allocatable :: elements(:)
      integer, allocatable :: stations(:)
      elements = inputs%station_elements()
      associate (discs => inputs%rotor%elastic%discs)
         stations = [elements%station, pack(elements%to_station, elements%to_station > 0)]
         forces = forces_at(component, component%station, stations)
         loads = reshape(forces, [size(forces)])
         stations = pack(discs%station, discs%skew > 0)
         forces = forces_at(component, component%slope, stations)
         loads = [loads, reshape(forces, [size(forces)])]
      end associate
   end function unit_loads

   !> Forces of 1 N at stations, or moments of 1 N m over the slopes there, each once, on all displacements: of one
   !> plane where both are alike.
   pure function forces_at(component, over, stations) result(forces)
      type(rotor_component_type), intent(in) :: component
      !> component%station or component%slope.
      type(sparse_matrix_type), intent(in) :: over
      integer, intent(in) :: stations(:)
      real(wp), allocatable :: forces(:, :)
      real(wp) :: one(component%station%rows)
      integer :: i, p, n
      allocate (forces(component%station%columns/component%planes, 2*size(stations)/component%planes))
      n = 0
      do i = 1, size(stations)
         do p = 1, 2/component%planes
            one = 0
            one(2*stations(i) - 2 + p) = 1
            n = n + 1
            associate (whole => over%transposed_times(one))
               forces(:, n) = whole(::component%planes)
            end associate
         end do
      end do
   end function forces_at

   !> Adds the elements: what is constant and acts at rest is part of the matrices, and masses are.
   pure subroutine add_elements(inputs, mounts, r)
      type(case_type), intent(in) :: inputs
      type(mount_type), intent(in) :: mounts(:)
      type(rotor_matrices_type), intent(inout) :: r
      type(station_element_type), allocatable :: from(:)
      real(wp) :: c(2, 2, 3)
      integer :: i, b, at, own
      from = inputs%station_elements()
      if (size(from) == 0) return
      allocate (r%elements(size(from)))
      do i = 1, size(from)
         r%elements(i) = new_acting_element(from(i), inputs%sense())
         associate (e => r%elements(i), here => [2*from(i)%station - 1, 2*from(i)%station])
            e%ends = r%station(here, :)
            e%offset = r%station_offset(here) - from(i)%origin
            if (from(i)%under_housing) then
               e%ends = 0
               e%offset = 0
            end if
            if (from(i)%to_station > 0) then
               associate (there => [2*from(i)%to_station - 1, 2*from(i)%to_station])
                  e%ends = e%ends - r%station(there, :)
                  e%offset = e%offset - r%station_offset(there)
               end associate
            end if
            do b = 1, merge(0, size(mounts), from(i)%housing == '')
               if (mounts(b)%name /= from(i)%housing) cycle
               at = 2*housing_pair(mounts, b)
               own = merge(1, -1, from(i)%under_housing)
               e%ends(1, at - 1) = e%ends(1, at - 1) + own
               e%ends(2, at) = e%ends(2, at) + own
            end do
            associate (speed => inputs%operation%speed_rpm*rpm)
               c = e%coefficients(speed)
               r%mass = r%mass + e%onto_rotor(c(:, :, 3))
               e%in_matrices = e%static .and. e%is_constant()
               if (.not. e%in_matrices) cycle
               r%damping = r%damping + e%onto_rotor(c(:, :, 2))
               r%stiffness = r%stiffness + e%onto_rotor(c(:, :, 1))
               r%load = r%load - matmul(matmul(c(:, :, 1), e%offset), e%ends)
            end associate
         end associate
      end do
   end subroutine add_elements

   !> The matrices in the displacements x. The mass of the modes is 1 and no stiffness joins them, but for rounding.
   pure subroutine reduce_matrices(component, basis, into, journals, r)
      type(rotor_component_type), intent(in) :: component
      real(wp), intent(in) :: basis(:, :), into(:, :)
      integer, intent(in) :: journals
      type(rotor_matrices_type), intent(inout) :: r
      type(projection_type) :: p
      real(wp) :: own
      integer :: i
      p = projected_matrices(component, basis)
      do i = journals + 1, size(basis, 2)
         own = p%stiffness(i, i)
         p%stiffness(i, :) = 0
         p%stiffness(:, i) = 0
         p%stiffness(i, i) = own
         p%mass(i, journals + 1:) = 0
         p%mass(i, i) = 1
      end do
      r%mass = projected(p%mass, into)
      r%stiffness = projected(p%stiffness, into)
      r%damping = projected(p%damping, into)
      r%gyroscopic = projected(p%gyroscopic, into)
      if (allocated(p%circulatory)) r%circulatory = projected(p%circulatory, into)
   end subroutine reduce_matrices

   !> The matrices of a rotor in displacements x with q = matmul(basis, x).
   pure function projected_matrices(component, basis) result(p)
      type(rotor_component_type), intent(in) :: component
      real(wp), intent(in) :: basis(:, :)
      type(projection_type) :: p
      p%mass = matmul(transpose(basis), component%mass%times(basis))
      p%damping = matmul(transpose(basis), component%damping%times(basis))
      p%gyroscopic = matmul(transpose(basis), component%gyroscopic%times(basis))
      p%stiffness = matmul(transpose(basis), component%stiffness%times(basis))
      if (allocated(component%circulatory)) p%circulatory = matmul(transpose(basis), component%circulatory%times(basis))
   end function projected_matrices

   pure function projected(matrix, basis)
      real(wp), intent(in) :: matrix(:, :), basis(:, :)
      real(wp) :: projected(size(basis, 2), size(basis, 2))
      projected = matmul(transpose(basis), matmul(matrix, basis))
   end function projected
end module rotor_reduction
