!> How many fixed-interface modes a rotor keeps, and what the others and the damping of the high ones cost.
module mode_selection
   ! heap: matrices of all displacements of a shaft
   use kinds, only: wp, pi
   use case_groups, only: is_set, reduction_type
   use case_inputs, only: case_type
   use rotor_component, only: rotor_component_type, unbalance_moments
   use fixed_interface, only: fixed_interface_type
   use linear_algebra, only: zgesv
   implicit none (type, external)
   private
   public :: mode_selection_type, select_modes, mode_damping, most_modes

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
   !> the others, and of damping those above `reduction%damp_above`.
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

contains

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
      complex(wp) :: rate
      integer :: n
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
      call add_damping(inputs%rotor%elastic%reduction, fixed, selection%modes, rate, reduced)
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
         rows = station_rows([inputs%bearings%station, inputs%rotor%elastic%discs%station])
         problem%observed = c%station(rows, :)
         static = fixed%basis(0)
         problem%journals = border
         problem%bearings = [(cmplx(1.0_wp, 1.0_wp, wp)*(quadratic(c%stiffness, static(:, i)) &
            & + abs(rate)**2*quadratic(c%mass, static(:, i))), i=1, size(border))]
      end associate
   end function response_problem

   !> y and z of stations.
   pure function station_rows(stations) result(rows)
      integer, intent(in) :: stations(:)
      integer :: rows(2*size(stations))
      rows = [2*stations - 1, 2*stations]
   end function station_rows

   pure real(wp) function quadratic(matrix, x)
      real(wp), intent(in) :: matrix(:, :), x(:)
      quadratic = dot_product(x, matmul(matrix, x))
   end function quadratic

   !> Adds the damping of the high modes to a reduced problem.
   pure subroutine add_damping(r, fixed, modes, rate, reduced)
      type(reduction_type), intent(in) :: r
      type(fixed_interface_type), intent(in) :: fixed
      integer, intent(in) :: modes
      complex(wp), intent(in) :: rate
      type(response_problem_type), intent(inout) :: reduced
      real(wp) :: damping(modes)
      integer :: i, at, p
      damping = mode_damping(r, fixed, modes)
      at = size(reduced%journals)
      do i = 1, modes
         do p = 1, fixed%planes
            at = at + 1
            reduced%stiffness(at, at) = reduced%stiffness(at, at) + rate*damping(i)
         end do
      end do
   end subroutine add_damping

   !> Damping of the first modes, of modal mass 1, 1/s: those above `reduction%damp_above` have a damping ratio. Without
   !> damping they hold up an integrator of high order.
   pure function mode_damping(r, fixed, modes) result(damping)
      type(reduction_type), intent(in) :: r
      type(fixed_interface_type), intent(in) :: fixed
      integer, intent(in) :: modes
      real(wp) :: damping(modes)
      associate (frequency => fixed%frequency(:modes))
         damping = merge(2*r%damping_ratio*frequency, 0.0_wp, frequency > 2*pi*r%damp_above)
      end associate
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
      integer :: pivots(n), i, info
      matrix = problem%stiffness(:n, :n)
      do i = 1, size(problem%journals)
         associate (element => matrix(problem%journals(i), problem%journals(i)))
            element = element + problem%bearings(i)
         end associate
      end do
      x = cmplx(problem%loads(:n, :), kind=wp)
      call zgesv(n, size(x, 2), matrix, n, pivots, x, n, info)
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
end module mode_selection
