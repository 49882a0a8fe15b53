!> What a point of a branch is drawn by: how far journal and pads go in a period, and the vibration with the shaft.
module orbit_figures
   use kinds, only: wp, i8, pi
   use equations_of_motion, only: bearing_model, model_sample
   use orbit_polynomials, only: orbit_type
   implicit none (type, external)
   private
   public :: orbit_figures_type, find_orbit_figures, figures_of_equilibrium

   type :: orbit_figures_type
      !> Of the journal along y and z, m: highest and lowest, amplitude of the vibration with the shaft, and the angle
      !> of the shaft, rad, by which its maximum comes after the unbalance points along +y.
      real(wp) :: highest(2) = 0, lowest(2) = 0, amplitude(2) = 0, phase(2) = 0
      !> Of each pad: highest and lowest tilt, rad; minimum film thickness, m.
      real(wp), allocatable :: highest_tilt(:), lowest_tilt(:), film(:)
   end type orbit_figures_type

contains

   !> The figures of an orbit over a number of revolutions, from a number of samples in each.
   subroutine find_orbit_figures(model, orbit, revolutions, samples, figures)
      type(bearing_model), intent(in) :: model
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: revolutions, samples
      type(orbit_figures_type), intent(out) :: figures
      real(wp) :: y(model%n), t
      complex(wp) :: synchronous(2)
      integer(i8) :: k, n
      n = int(revolutions, i8)*samples
      synchronous = 0
      do k = 0, n - 1
         t = orbit%time(orbit%intervals())*k/n
         call orbit%state_at(t, y)
         call widen(model, t, y, figures)
         associate (journal => model%rotor%journal(y(:model%rotor%states)), angle => 2*pi*k/samples)
            synchronous = synchronous + journal%position*cmplx(cos(angle), sin(angle), wp)
         end associate
      end do
      ! of fewer samples the vibration is not known
      if (samples < 3) synchronous = 0
      synchronous = 2*synchronous/n
      figures%amplitude = abs(synchronous)
      figures%phase = atan2(synchronous%im, synchronous%re)
   end subroutine find_orbit_figures

   !> The figures of a state in equilibrium.
   subroutine figures_of_equilibrium(model, y, figures)
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(orbit_figures_type), intent(out) :: figures
      call widen(model, 0.0_wp, y, figures)
   end subroutine figures_of_equilibrium

   !> Takes a state at time t, s, into the figures.
   subroutine widen(model, t, y, figures)
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: t, y(:)
      type(orbit_figures_type), intent(inout) :: figures
      type(model_sample) :: sample
      real(wp) :: none(model%outputs)
      none = 0
      call model%take_sample(t, y, none, sample)
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
   end subroutine widen
end module orbit_figures
