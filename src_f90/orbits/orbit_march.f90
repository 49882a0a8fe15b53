!> A march that brings a periodic orbit near: period after period, and the last one as intervals of a collocation.
module orbit_march
   ! heap: arrays as long as a run
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error, stopped, asked_to_stop, asked
   use marching, only: march_options
   use cvode_integrator, only: integrator_type
   use orbit_polynomials, only: orbit_type, points, place
   implicit none (type, external)
   private
   public :: march_period, mesh_options

   !> Tolerance of the march over what is asked for: on its steps the collocation is that much more accurate.
   !> Not so where the march would become too coarse to start from.
   real(wp), parameter :: looser = 10, loosest = 1e-4_wp
   !> Fewest steps of the march, and so intervals, in a revolution: a motion that hardly moves would take few.
   real(wp), parameter :: fewest = 24
   !> Steps between two questions whether to stop.
   integer(i8), parameter :: steps_between_questions = 64

contains

   !> How to march for a mesh, where a march would be so, and a revolution takes this time, s.
   pure type(march_options) function mesh_options(march, revolution) result(options)
      type(march_options), intent(in) :: march
      real(wp), intent(in) :: revolution
      real(wp) :: factor
      options = march
      factor = max(1.0_wp, min(looser, loosest/march%relative_tolerance))
      options%relative_tolerance = factor*march%relative_tolerance
      options%absolute_tolerance = factor*march%absolute_tolerance
      options%keeps_outputs = .false.
      options%max_step = revolution/fewest
      if (march%max_step > 0) options%max_step = min(options%max_step, march%max_step)
   end function mesh_options

   !> Marches over period number `period` = 0, 1, .., in whose first step the integrator stands; its steps become the
   !> intervals of the orbit. An error says why, where and when the march ended.
   subroutine march_period(integrator, options, period, length, orbit, error, give_up)
      type(integrator_type), intent(inout) :: integrator
      type(march_options), intent(in) :: options
      integer, intent(in) :: period
      !> s.
      real(wp), intent(in) :: length
      type(orbit_type), intent(inout) :: orbit
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      real(wp), allocatable :: ends(:), at(:, :, :)
      real(wp) :: t, before
      integer :: n, i
      call integrator%interpolate(period*length, orbit%start)
      allocate (ends(64), at(size(orbit%start), points, 64))
      n = 0
      before = 0
      do
         t = min(length, integrator%time() - period*length)
         if (t > before) then
            if (n == size(ends)) then
               ends = [ends, ends]
               at = reshape(at, [size(at, 1), points, 2*n], pad=at)
            end if
            n = n + 1
            ends(n) = t
            do i = 1, points
               call integrator%interpolate(period*length + before + place(i)*(t - before), at(:, i, n))
            end do
            before = t
         end if
         if (t >= length) exit
         call do_step(integrator, options, error, give_up)
         if (allocated(error)) return
      end do
      call orbit%set_mesh([0.0_wp, ends(:n)], at(:, :, :n))
   end subroutine march_period

   !> A step, unless there were too many or `give_up` says so.
   subroutine do_step(integrator, options, error, give_up)
      type(integrator_type), intent(inout) :: integrator
      type(march_options), intent(in) :: options
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      logical :: stops
      associate (counts => integrator%counts())
         stops = .false.
         if (mod(counts%steps, steps_between_questions) == 0) stops = asked(give_up)
         if (stops) then
            call raise(error, stopped, 'asked to stop')
         else if (counts%steps >= options%max_steps) then
            call raise(error, numerics_error, 'too many steps (integration%max_steps)')
         else
            call integrator%step(error)
         end if
         ! the text takes longer than a step
         if (allocated(error)) call add_context(error, 'the march stopped at t = '//to_text(integrator%time()) &
            & //' s, after '//to_text(counts%steps)//' steps')
      end associate
   end subroutine do_step
end module orbit_march
