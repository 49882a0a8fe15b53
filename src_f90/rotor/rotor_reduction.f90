!> A rotor in few displacements: the basis of Craig and Bampton (AIAA Journal 6 (1968) 1313-1319), which are static
!> deflections over displacements of the journals and vibration modes with the journals held; how many of these modes a
!> rotor keeps, and what the others and the damping of the high ones cost; and the equations that the time integration
!> has of a shaft.
module rotor_reduction
   use kinds, only: wp, pi
   use linear_algebra, only: dpotrf, dpotrs, dsygv, solve_complex
   use case_groups, only: is_set, reduction_type
   use case_inputs, only: case_type
   use rotor_component, only: rotor_component_type, in_planes, static_forces, unbalance_moments
   use linear_element, only: relative_displacements, add_supports
   implicit none (type, external)
   private
   public :: fixed_interface_type, find_fixed_interface, mode_selection_type, select_modes, most_modes, &
      & rotor_matrices_type, reduced_rotor

   !> Of one plane where both are alike. `border`: displacements of the journals among all; `inner`: the others.
   type :: fixed_interface_type
      integer :: planes = 1
      integer, allocatable :: border(:), inner(:)
      !> Deflections over unit displacements of the journals, (displacement, journal's).
      real(wp), allocatable :: static(:, :)
      !> Modes with the journals held, (displacement, mode), with modal masses 1, the lowest first; rad/s.
      real(wp), allocatable :: modes(:, :), frequency(:)
      !> Cholesky factor of the inner stiffness.
      real(wp), allocatable, private :: factor(:, :)
   contains
      procedure :: basis
      procedure :: residual_deflection
   end type fixed_interface_type

   !> The smallest part of a stiffness that elimination may leave: less is rounding.
   real(wp), parameter :: rounding = 1e-13_wp


   !> A forced vibration at one frequency: D q = loads.
   type :: response_problem_type
      !> Dynamic stiffness, (n, n), N/m, without bearings.
      complex(wp), allocatable :: stiffness(:, :)
      !> (n, loads), and displacements that matter: matmul(observed, q).
      real(wp), allocatable :: loads(:, :), observed(:, :)
      !> Displacements of the journals, and the dynamic stiffness of their bearings, N/m.
      integer, allocatable :: journals(:)
      complex(wp), allocatable :: bearings(:)
   contains
      procedure :: reduced
   end type response_problem_type

   !> Modes kept in a plane, and errors of amplitudes at the highest speed, relative to the largest one: of leaving out
   !> the others, and of damping those above `reduction%damp_above`; 0 where the number of modes was given.
   type :: mode_selection_type
      integer :: modes = 0
      real(wp) :: truncation_error = 0, damping_error = 0
   end type mode_selection_type

   !> The modes are chosen for this error of amplitudes, and include all below this multiple of the highest speed, and
   !> below this frequency, Hz, so that a map over speeds has the same vibrations at all of them.
   real(wp), parameter :: target_error = 1e-4_wp, lowest_multiple = 3, lowest_frequency = 500
   !> Most modes that a rotor keeps, those of both planes: a march has dense matrices of them.
   integer, parameter :: most_modes = 120
   !> Amplitudes are compared in a vibration that grows so fast, relative to its frequency: as with this damping ratio.
   real(wp), parameter :: growth = 0.05_wp


   !> M x'' + (C + Omega G) x' + K x = load + forces of the bearings + unbalance. Displacements x: first those of the
   !> journals relative to their bearings, y and z of each; then those of the housings that have supports, y and z of
   !> each, m, 0 where the spring is not loaded; then the amplitudes of the modes with the journals held, in y and z of
   !> each (kg^1/2 m), whose mass is 1. The weight of a housing acts on its support.
   type, extends(mode_selection_type) :: rotor_matrices_type
      integer :: journals = 0
      real(wp), allocatable, dimension(:, :) :: mass, damping, gyroscopic, stiffness
      !> Damping of the displacements that the reduction adds, as they are modes above reduction%damp_above, 1/s.
      real(wp), allocatable :: high_damping(:)
      !> Weight (along -y), static loads, and what the offsets of the bearings bend.
      real(wp), allocatable :: load(:)
      !> (n, 2): the force of the unbalances at the shaft angle phi is Omega**2*(unbalance(:, 1)*cos(phi)
      !> + unbalance(:, 2)*sin(phi)) + Omega'*(unbalance(:, 1)*sin(phi) - unbalance(:, 2)*cos(phi)).
      real(wp), allocatable :: unbalance(:, :)
      !> Where the shaft is at its stations, m: y and z of station 1, y and z of station 2, ... are
      !> matmul(station, x) + station_offset. The offset has what the bearings' offsets and the modes that are left out
      !> have of the static deflection, which is exact so. The same of the slopes dy/dx and dz/dx.
      real(wp), allocatable :: station(:, :), station_offset(:), slope(:, :), slope_offset(:)
      !> Of the rotor without housings, kg.
      real(wp) :: total_mass = 0
      !> Frequencies of the kept modes, Hz (each in both planes of a shaft); of the first that is left out, 0: none is.
      real(wp), allocatable :: mode_frequency(:)
      real(wp) :: left_out_frequency = 0
   end type rotor_matrices_type

contains

   !> The basis of a rotor, and whether its journals hold it (else the basis is not found). `border`: the displacements
   !> of the journals, y and z of each.
   subroutine find_fixed_interface(component, border, fixed, held)
      type(rotor_component_type), intent(in) :: component
      integer, intent(in) :: border(:)
      type(fixed_interface_type), intent(out) :: fixed
      logical, intent(out) :: held
      real(wp), allocatable :: mass(:, :), stiffness(:, :), right(:, :)
      integer :: n, i, info
      associate (p => component%planes)
         fixed%planes = p
         fixed%border = (border(::p) + p - 1)/p
         mass = component%mass(::p, ::p)
         stiffness = component%stiffness(::p, ::p)
      end associate
      n = size(mass, 1)
      fixed%inner = pack([(i, i=1, n)], [(all(fixed%border /= i), i=1, n)])
      fixed%factor = stiffness(fixed%inner, fixed%inner)
      call dpotrf('U', size(fixed%inner), fixed%factor, size(fixed%inner), info)
      held = info == 0
      if (held) held = all([(fixed%factor(i, i)**2 > rounding*stiffness(fixed%inner(i), fixed%inner(i)), i=1, &
         & size(fixed%inner))])
      if (.not. held) return
      right = -stiffness(fixed%inner, fixed%border)
      call dpotrs('U', size(right, 1), size(right, 2), fixed%factor, size(right, 1), right, size(right, 1), info)
      allocate (fixed%static(n, size(fixed%border)), source=0.0_wp)
      fixed%static(fixed%inner, :) = right
      do i = 1, size(fixed%border)
         fixed%static(fixed%border(i), i) = 1
      end do
      call find_modes(mass(fixed%inner, fixed%inner), stiffness(fixed%inner, fixed%inner), n, fixed, held)
   end subroutine find_fixed_interface

   !> Modes of the inner displacements. M x = mu K x is solved, as the largest mu = 1/omega^2 are
   !> the most accurate ones.
   subroutine find_modes(mass, stiffness, n, fixed, found)
      real(wp), intent(in) :: mass(:, :), stiffness(:, :)
      integer, intent(in) :: n
      type(fixed_interface_type), intent(inout) :: fixed
      logical, intent(out) :: found
      real(wp), allocatable :: vectors(:, :), factor(:, :), mu(:), work(:)
      integer :: inner, count, i, info
      inner = size(mass, 1)
      vectors = mass
      factor = stiffness
      allocate (mu(inner), work(34*inner))
      call dsygv(1, 'V', 'U', inner, vectors, inner, factor, inner, mu, work, size(work), info)
      found = info == 0
      if (.not. found) return
      count = merge(0, 1, inner == 0)
      if (count > 0) count = int(sum(merge(1, 0, mu > rounding*mu(inner))))
      allocate (fixed%modes(n, count), source=0.0_wp)
      allocate (fixed%frequency(count))
      do i = 1, count
         associate (value => mu(inner + 1 - i), vector => vectors(:, inner + 1 - i))
            fixed%frequency(i) = 1/sqrt(value)
            ! modes are found with stiffness 1
            fixed%modes(fixed%inner, i) = vector/sqrt(value)
         end associate
      end do
   end subroutine find_modes

   !> Static deflections and this many modes, in all planes: (all displacements, journals and modes), y and z of
   !> each one after the other.
   pure function basis(self, modes)
      class(fixed_interface_type), intent(in) :: self
      integer, intent(in) :: modes
      real(wp), allocatable :: basis(:, :), one(:, :)
      allocate (one(size(self%static, 1), size(self%static, 2) + modes))
      one(:, :size(self%static, 2)) = self%static
      one(:, size(self%static, 2) + 1:) = self%modes(:, :modes)
      basis = in_planes(one, self%planes)
   end function basis

   !> Static deflection under a force on all displacements, N, with the journals held, less what this many modes have
   !> of it.
   function residual_deflection(self, force, modes) result(deflection)
      class(fixed_interface_type), intent(in) :: self
      real(wp), intent(in) :: force(:)
      integer, intent(in) :: modes
      real(wp) :: deflection(size(force))
      real(wp), allocatable :: inner(:, :), amplitude(:)
      integer :: p, i, info
      deflection = 0
      do p = 1, self%planes
         associate (plane => force(p::self%planes))
            inner = reshape(plane(self%inner), [size(self%inner), 1])
            call dpotrs('U', size(inner), 1, self%factor, size(inner), inner, size(inner), info)
            amplitude = matmul(plane, self%modes(:, :modes))/self%frequency(:modes)**2
         end associate
         do i = 1, size(self%inner)
            associate (row => self%inner(i))
               deflection(self%planes*(row - 1) + p) = inner(i, 1) - dot_product(self%modes(row, :modes), amplitude)
            end associate
         end do
      end do
   end function residual_deflection

   ! How many modes are kept.

   !> Chooses the modes for a highest speed, rad/s: by `reduction%frequency`, or else by the error of amplitudes.
   !> More than `most_modes` are counted alone, to be refused.
   subroutine select_modes(inputs, component, fixed, border, highest_speed, selection)
      type(case_type), intent(in) :: inputs
      type(rotor_component_type), intent(in) :: component
      type(fixed_interface_type), intent(in) :: fixed
      !> Displacements of the journals.
      integer, intent(in) :: border(:)
      real(wp), intent(in) :: highest_speed
      type(mode_selection_type), intent(out) :: selection
      type(response_problem_type) :: whole, reduced
      complex(wp), allocatable :: exact(:, :), found(:, :)
      real(wp), allocatable :: damping(:)
      complex(wp) :: rate
      integer :: n, i
      rate = highest_speed*cmplx(growth, 1.0_wp, wp)
      whole = response_problem(inputs, component, fixed, border, highest_speed, rate)
      exact = amplitudes(whole, size(whole%stiffness, 1))
      reduced = whole%reduced(fixed%basis(size(fixed%frequency)))
      if (is_set(inputs%rotor%elastic%reduction%frequency)) then
         selection%modes = count(fixed%frequency <= 2*pi*inputs%rotor%elastic%reduction%frequency)
      else
         selection%modes = min(most_modes/fixed%planes, &
            & count(fixed%frequency <= max(lowest_multiple*highest_speed, 2*pi*lowest_frequency)))
      end if
      if (fixed%planes*selection%modes > most_modes) return
      do
         n = size(border) + fixed%planes*selection%modes
         found = amplitudes(reduced, n)
         selection%truncation_error = amplitude_error(found, exact)
         if (is_set(inputs%rotor%elastic%reduction%frequency) .or. selection%modes == size(fixed%frequency) &
            & .or. fixed%planes*(selection%modes + 1) > most_modes .or. selection%truncation_error <= target_error) exit
         selection%modes = selection%modes + 1
      end do
      damping = mode_damping(inputs%rotor%elastic%reduction, fixed, selection%modes)
      do i = 1, size(damping)
         associate (element => reduced%stiffness(size(border) + i, size(border) + i))
            element = element + rate*damping(i)
         end associate
      end do
      selection%damping_error = amplitude_error(amplitudes(reduced, n), found)
   end subroutine select_modes

   !> Vibration q exp(rate*t) of a rotor at a speed, rad/s: the loads are its mass along y, as of an even eccentricity,
   !> and its unbalances. Amplitudes are those of journals and discs: a force in between also deflects the shaft
   !> just where it acts, which takes many modes. The bearings are springs and dampers that resist the journals as
   !> much as the rotor itself does, where both matter most.
   function response_problem(inputs, component, fixed, border, speed, rate) result(problem)
      type(case_type), intent(in) :: inputs
      type(rotor_component_type), intent(in) :: component
      type(fixed_interface_type), intent(in) :: fixed
      integer, intent(in) :: border(:)
      real(wp), intent(in) :: speed
      complex(wp), intent(in) :: rate
      type(response_problem_type) :: problem
      real(wp), allocatable :: static(:, :), moments(:, :)
      integer, allocatable :: rows(:)
      integer :: i
      associate (c => component)
         problem%stiffness = rate**2*c%mass + rate*(c%damping + speed*c%gyroscopic) + c%stiffness
         allocate (problem%loads(size(c%mass, 1), 2))
         problem%loads(:, 1) = c%weighed
         moments = unbalance_moments(inputs%rotor%elastic%unbalances, size(c%station, 1), c%sense)
         problem%loads(:, 2) = matmul(moments(1, :), c%station)
         rows = [inputs%bearings%station, inputs%rotor%elastic%discs%station]
         rows = [2*rows - 1, 2*rows]
         problem%observed = c%station(rows, :)
         static = fixed%basis(0)
         problem%journals = border
         problem%bearings = [(cmplx(1.0_wp, 1.0_wp, wp)*(quadratic(c%stiffness, static(:, i)) &
            & + abs(rate)**2*quadratic(c%mass, static(:, i))), i=1, size(border))]
      end associate
   end function response_problem

   pure real(wp) function quadratic(matrix, x)
      real(wp), intent(in) :: matrix(:, :), x(:)
      quadratic = dot_product(x, matmul(matrix, x))
   end function quadratic

   !> Damping of the first modes in each plane, of modal mass 1, 1/s: those above `reduction%damp_above` have a damping
   !> ratio. Without damping they hold up an integrator of high order.
   pure function mode_damping(r, fixed, modes) result(damping)
      type(reduction_type), intent(in) :: r
      type(fixed_interface_type), intent(in) :: fixed
      integer, intent(in) :: modes
      real(wp) :: damping(fixed%planes*modes)
      integer :: p
      do p = 1, fixed%planes
         damping(p::fixed%planes) = merge(2*r%damping_ratio*fixed%frequency(:modes), 0.0_wp, &
            & fixed%frequency(:modes) > 2*pi*r%damp_above)
      end do
   end function mode_damping

   ! How well a reduced rotor vibrates: amplitudes of forced vibrations, compared with those of the whole one.

   !> The same problem in displacements x with q = matmul(basis, x), of which the first are those of the journals.
   pure function reduced(self, basis) result(problem)
      class(response_problem_type), intent(in) :: self
      real(wp), intent(in) :: basis(:, :)
      type(response_problem_type) :: problem
      integer :: i
      problem%stiffness = matmul(transpose(basis), matmul(self%stiffness, basis))
      problem%loads = matmul(transpose(basis), self%loads)
      problem%observed = matmul(self%observed, basis)
      problem%journals = [(i, i=1, size(self%journals))]
      problem%bearings = self%bearings
   end function reduced

   !> Amplitudes of the first n displacements' motion, the others being held: (observed, load), m.
   function amplitudes(problem, n)
      type(response_problem_type), intent(in) :: problem
      integer, intent(in) :: n
      complex(wp), allocatable :: amplitudes(:, :), matrix(:, :), x(:, :)
      integer :: i
      logical :: ignored
      matrix = problem%stiffness(:n, :n)
      do i = 1, size(problem%journals)
         associate (element => matrix(problem%journals(i), problem%journals(i)))
            element = element + problem%bearings(i)
         end associate
      end do
      x = cmplx(problem%loads(:n, :), kind=wp)
      call solve_complex(n, size(x, 2), matrix, x, ignored)
      ! a growing vibration on dampers has no resonance
      amplitudes = matmul(problem%observed(:, :n), x)
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
      type(fixed_interface_type), intent(in) :: fixed
      type(mode_selection_type), intent(in) :: selection
      type(rotor_matrices_type) :: r
      real(wp), allocatable :: basis(:, :), into(:, :), offset(:), force(:), deflection(:)
      integer :: i, modes
      r%mode_selection_type = selection
      modes = selection%modes
      r%journals = size(inputs%bearings)
      basis = fixed%basis(modes)
      into = relative_displacements(inputs%bearings, size(basis, 2))
      offset = [(inputs%bearings(i)%offset, i=1, r%journals)]
      call reduce_matrices(component, basis, into, 2*r%journals, r)
      force = matmul(static_forces(inputs%rotor%elastic%loads, size(component%station, 1)), component%station) &
         & - inputs%rotor%gravity*component%weighed
      deflection = matmul(basis(:, :2*r%journals), offset)
      r%load = matmul(matmul(force - matmul(component%stiffness, deflection), basis), into)
      deflection = deflection + fixed%residual_deflection(force, modes)
      basis = matmul(basis, into)
      r%unbalance = transpose(matmul(unbalance_moments(inputs%rotor%elastic%unbalances, size(component%station, 1), &
         & component%sense), matmul(component%station, basis)))
      r%station = matmul(component%station, basis)
      r%station_offset = matmul(component%station, deflection)
      r%slope = matmul(component%slope, basis)
      r%slope_offset = matmul(component%slope, deflection)
      r%total_mass = component%total_mass
      r%mode_frequency = fixed%frequency(:modes)/(2*pi)
      if (modes < size(fixed%frequency)) r%left_out_frequency = fixed%frequency(modes + 1)/(2*pi)
      ! the last displacements are the modes
      r%high_damping = [spread(0.0_wp, 1, size(r%load) - fixed%planes*modes), &
         & mode_damping(inputs%rotor%elastic%reduction, fixed, modes)]
      do i = 1, size(r%load)
         r%damping(i, i) = r%damping(i, i) + r%high_damping(i)
      end do
      call add_supports(inputs%bearings, inputs%rotor%gravity, r%mass, r%damping, r%stiffness, r%load)
   end function reduced_rotor

   !> The matrices in the displacements x. The mass of the modes is 1 and no stiffness joins them, but for rounding.
   pure subroutine reduce_matrices(component, basis, into, journals, r)
      type(rotor_component_type), intent(in) :: component
      real(wp), intent(in) :: basis(:, :), into(:, :)
      integer, intent(in) :: journals
      type(rotor_matrices_type), intent(inout) :: r
      real(wp), allocatable :: stiffness(:, :), mass(:, :)
      real(wp) :: own
      integer :: i
      mass = projected(component%mass, basis)
      stiffness = projected(component%stiffness, basis)
      do i = journals + 1, size(basis, 2)
         own = stiffness(i, i)
         stiffness(i, :) = 0
         stiffness(:, i) = 0
         stiffness(i, i) = own
         mass(i, journals + 1:) = 0
         mass(i, i) = 1
      end do
      r%mass = projected(mass, into)
      r%stiffness = projected(stiffness, into)
      r%damping = projected(projected(component%damping, basis), into)
      r%gyroscopic = projected(projected(component%gyroscopic, basis), into)
   end subroutine reduce_matrices

   pure function projected(matrix, basis)
      real(wp), intent(in) :: matrix(:, :), basis(:, :)
      real(wp) :: projected(size(basis, 2), size(basis, 2))
      projected = matmul(transpose(basis), matmul(matrix, basis))
   end function projected
end module rotor_reduction
