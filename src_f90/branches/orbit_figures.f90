!> What a point of a branch is drawn by: how far journal and pads go in a period, and the vibration with the shaft.
module orbit_figures
   use kinds, only: wp, i8, pi
   use equations_of_motion, only: machine_model
   use bearing_samples, only: bearing_sample, take_sample
   use orbit_problem, only: orbit_problem_type
   implicit none (type, external)
   private
   public :: orbit_figures_type, find_orbit_figures

   type :: orbit_figures_type
      !> Of the journal along y and z, m: highest and lowest, amplitude of the vibration with the shaft, and the angle
      !> of the shaft, rad, by which its maximum comes after the unbalance points along +y.
      real(wp) :: highest(2) = 0, lowest(2) = 0, amplitude(2) = 0, phase(2) = 0
      !> Of each pad: highest and lowest tilt, rad; minimum film thickness, m.
      real(wp), allocatable :: highest_tilt(:), lowest_tilt(:), film(:)
      !> Of an orbit: revolutions of the shaft in it, intervals of its collocation, and its period, s.
      integer :: revolutions = 0, intervals = 0
      real(wp) :: period = 0
   contains
      procedure :: add_state
   end type orbit_figures_type

contains

   !> The figures of an orbit, from a number of samples in each revolution.
   subroutine find_orbit_figures(model, problem, samples, figures)
      type(machine_model), intent(in) :: model
      type(orbit_problem_type), intent(in) :: problem
      integer, intent(in) :: samples
      type(orbit_figures_type), intent(out) :: figures
      real(wp) :: y(model%n), t
      complex(wp) :: synchronous(2)
      integer(i8) :: k, n
      figures%revolutions = problem%period_multiple
      figures%intervals = problem%orbit%intervals()
      figures%period = problem%period()
      n = int(figures%revolutions, i8)*samples
      synchronous = 0
      do k = 0, n - 1
         t = problem%orbit%time(figures%intervals)*k/n
         call problem%orbit%state_at(t, y)
         call figures%add_state(model, t, y)
         associate (journal => model%rotor%journal(y(:model%rotor%states), 1), angle => 2*pi*k/samples)
            synchronous = synchronous + journal%position*cmplx(cos(angle), sin(angle), wp)
         end associate
      end do
      ! of fewer samples the vibration is not known
      if (samples < 3) synchronous = 0
      synchronous = 2*synchronous/n
      figures%amplitude = abs(synchronous)
      figures%phase = atan2(synchronous%im, synchronous%re)
   end subroutine find_orbit_figures

   !> Takes a state at time t, s, into the figures: of an equilibrium the only one.
   subroutine add_state(figures, model, t, y)
      class(orbit_figures_type), intent(inout) :: figures
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: t, y(:)
      type(bearing_sample) :: sample
      real(wp) :: none(model%outputs)
      none = 0
      call take_sample(model, t, y, none, 1, sample)
      associate (position => sample%journal%position, tilt => sample%states%tilt, &
         & film => sample%loads%min_film_thickness)
         if (.not. allocated(figures%film)) then
            figures%highest = position
            figures%lowest = position
            figures%highest_tilt = tilt
            figures%lowest_tilt = tilt
            figures%film = film
         end if
         figures%highest = max(figures%highest, position)
         figures%lowest = min(figures%lowest, position)
         figures%highest_tilt = max(figures%highest_tilt, tilt)
         figures%lowest_tilt = min(figures%lowest_tilt, tilt)
         figures%film = min(figures%film, film)
      end associate
   end subroutine add_state
end module orbit_figures
