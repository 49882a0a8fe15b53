!> What a point of a branch is drawn by: how far journals, stations and pads go in a period, and the vibration with the
!> shaft.
module orbit_figures
   use kinds, only: wp, i8, pi
   use state_layout, only: tilt
   use equations_of_motion, only: machine_model
   use bearing_samples, only: bearing_sample, take_sample, element_positions, eccentricities
   use orbit_problem, only: orbit_problem_type
   use limit_cycle, only: limit_cycle_type
   implicit none (type, external)
   private
   public :: orbit_figures_type, whirl_figures_type, bearing_figures_type, find_orbit_figures

   !> Of a journal or a station along y and z, m.
   type :: whirl_figures_type
      !> Highest and lowest, amplitude of the vibration with the shaft, and the angle of the shaft, rad, by which its
      !> maximum comes after the unbalance at angle 0 points along +y.
      real(wp) :: highest(2) = -huge(1.0_wp), lowest(2) = huge(1.0_wp), amplitude(2) = 0, phase(2) = 0
      !> The part of the vibration with the shaft, until all samples are in.
      complex(wp), private :: synchronous(2) = 0
   end type whirl_figures_type

   type :: bearing_figures_type
      type(whirl_figures_type) :: journal
      !> Of each pad: highest and lowest tilt, rad; minimum film thickness, m.
      real(wp), allocatable :: highest_tilt(:), lowest_tilt(:), film(:)
   end type bearing_figures_type

   type :: orbit_figures_type
      type(bearing_figures_type), allocatable :: bearings(:)
      type(whirl_figures_type), allocatable :: stations(:), elements(:)
      !> Largest displacements of the rings of dampers over their clearances.
      real(wp), allocatable :: eccentricities(:)
      !> Of an orbit: revolutions of the shaft in it, 0 else; intervals of its collocation; its period, s.
      real(wp) :: revolutions = 0, period = 0
      integer :: intervals = 0
      !> Whether it is a limit cycle; the error of its multiplier that is 1.
      logical :: is_cycle = .false.
      real(wp) :: trivial_error = 0
   contains
      procedure :: add_state
   end type orbit_figures_type

contains

   !> The figures of an orbit, from a number of samples in each revolution, or in a limit cycle, whose own frequency
   !> then takes the place of the shaft's.
   subroutine find_orbit_figures(model, problem, samples, figures)
      type(machine_model), intent(in) :: model
      class(orbit_problem_type), intent(inout) :: problem
      integer, intent(in) :: samples
      type(orbit_figures_type), intent(out) :: figures
      real(wp) :: y(model%n), t
      integer(i8) :: k, n
      figures%revolutions = problem%revolutions()
      figures%intervals = problem%orbit%intervals()
      figures%period = problem%period()
      select type (problem)
      type is (limit_cycle_type)
         figures%is_cycle = .true.
         figures%trivial_error = problem%trivial_error()
      end select
      n = int(problem%period_multiple, i8)*samples
      do k = 0, n - 1
         t = problem%orbit%time(figures%intervals)*k/n
         call problem%orbit%state_at(t, y)
         call figures%add_state(model, t, y, 2*pi*k/samples)
      end do
      ! of fewer samples the vibration is not known
      if (samples < 3) return
      call finish(figures%bearings%journal)
      call finish(figures%stations)
      call finish(figures%elements)

   contains

      elemental subroutine finish(whirl)
         type(whirl_figures_type), intent(inout) :: whirl
         whirl%synchronous = 2*whirl%synchronous/n
         whirl%amplitude = abs(whirl%synchronous)
         whirl%phase = atan2(whirl%synchronous%im, whirl%synchronous%re)
      end subroutine finish
   end subroutine find_orbit_figures

   !> Takes a state at time t, s, and shaft angle, rad, into the figures: of an equilibrium the only one.
   subroutine add_state(figures, model, t, y, angle)
      class(orbit_figures_type), intent(inout) :: figures
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: t, y(:), angle
      type(bearing_sample) :: sample
      real(wp) :: none(model%outputs), displacements(2, model%rotor%stations), &
         & positions(2, model%rotor%elements + size(model%others))
      integer :: b, i
      none = 0
      if (.not. allocated(figures%bearings)) then
         allocate (figures%bearings(size(model%bearings)), figures%stations(model%rotor%stations), &
            & figures%elements(size(positions, 2)), figures%eccentricities(size(model%inputs%dampers())))
         figures%eccentricities = 0
      end if
      do b = 1, size(figures%bearings)
         if (allocated(sample%states)) deallocate (sample%states, sample%loads)
         if (allocated(sample%slopes)) deallocate (sample%slopes)
         call take_sample(model, t, y, none, b, sample)
         associate (of => figures%bearings(b), tilts => sample%states%x(tilt), film => sample%loads%min_film_thickness)
            call add_place(of%journal, sample%journal%position, angle)
            if (.not. allocated(of%film)) then
               of%highest_tilt = tilts
               of%lowest_tilt = tilts
               of%film = film
            end if
            of%highest_tilt = max(of%highest_tilt, tilts)
            of%lowest_tilt = min(of%lowest_tilt, tilts)
            of%film = min(of%film, film)
         end associate
      end do
      displacements = model%rotor%station_displacements(y(:model%rotor%states))
      do i = 1, size(figures%stations)
         call add_place(figures%stations(i), displacements(:, i), angle)
      end do
      positions = element_positions(model, y)
      do i = 1, size(figures%elements)
         call add_place(figures%elements(i), positions(:, i), angle)
      end do
      if (size(figures%eccentricities) > 0) figures%eccentricities = max(figures%eccentricities, &
         & eccentricities(model%inputs, positions(:, model%rotor%elements + 1:)))
   end subroutine add_state

   !> Takes a place, m, at a shaft angle, rad, into the figures of a journal or a station.
   pure subroutine add_place(whirl, place, angle)
      type(whirl_figures_type), intent(inout) :: whirl
      real(wp), intent(in) :: place(2), angle
      whirl%highest = max(whirl%highest, place)
      whirl%lowest = min(whirl%lowest, place)
      whirl%synchronous = whirl%synchronous + place*cmplx(cos(angle), sin(angle), wp)
   end subroutine add_place
end module orbit_figures
