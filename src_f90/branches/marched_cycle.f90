!> The limit cycle to which a march leads, whose period is not known: found by the returns of the motion to where it
!> crossed the plane across itself before.
module marched_cycle
   use kinds, only: wp, pi
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error
   use marching, only: march_options
   use ode_model, only: integrator_counts_type
   use cvode_integrator, only: integrator_type
   use equations_of_motion, only: machine_model
   use orbit_polynomials, only: orbit_type
   use march_settings, only: march_period, mesh_options, do_step
   use roots, only: root_bracket
   implicit none (type, external)
   private
   public :: find_marched_cycle

   !> A motion has returned where it crosses the plane closer to where it was than this part of how far it went from
   !> there, and repeats where displacements change by less than this of that way.
   real(wp), parameter :: close_by = 0.3_wp, settled = 1e-4_wp
   !> What moves by less than this, over the scales, is at rest.
   real(wp), parameter :: rest = 1e-5_wp
   !> Revolutions of the shaft in which a cycle returns, those that are marched at most; most cuts for the time of a
   !> crossing.
   integer, parameter :: longest_cycle = 20, most_revolutions = 2000, most_cuts = 30

   !> Where the motion crossed the plane: state, rate and time, s, and how far displacements have been from there since.
   type :: crossing_type
      real(wp), allocatable :: state(:), rate(:)
      real(wp) :: time = 0, farthest = 0
   end type crossing_type

contains

   !> The cycle, from a march from state y; an error where this comes to rest or does not repeat.
   subroutine find_marched_cycle(model, march, y, orbit, counts, error)
      type(machine_model), intent(inout), target :: model
      !> Tolerances of a march; they choose the mesh.
      type(march_options), intent(in) :: march
      real(wp), intent(in) :: y(:)
      type(orbit_type), intent(out) :: orbit
      type(integrator_counts_type), intent(out) :: counts
      type(error_type), allocatable, intent(out) :: error
      type(integrator_type) :: integrator
      type(march_options) :: options
      type(crossing_type) :: last
      integer, allocatable :: x(:), v(:)
      real(wp) :: now(size(y)), revolution, period, change, before, along, start, t
      logical :: at_rest
      revolution = 2*pi/model%point%speed(0.0_wp)
      options = mesh_options(march, revolution)
      options%give_up => model%give_up
      call model%pairs(x, v)
      call integrator%start(model, options, 0.0_wp, y, most_revolutions*revolution, error)
      if (.not. allocated(error)) last = crossing(0.0_wp)
      change = huge(change)
      before = 0
      at_rest = .false.
      do while (.not. (allocated(error) .or. at_rest) .and. change > settled)
         start = integrator%time()
         call do_step(integrator, options, error)
         if (allocated(error)) exit
         t = integrator%time()
         along = ahead(t)
         last%farthest = max(last%farthest, distance(now))
         if (t - last%time > longest_cycle*revolution) then
            at_rest = last%farthest < rest
            last = crossing(t)
            along = 0
         else if (before < 0 .and. along >= 0) then
            call look()
         end if
         before = along
         if (t >= most_revolutions*revolution) exit
      end do
      counts = integrator%counts()
      if (.not. allocated(error) .and. (at_rest .or. change > settled)) call refuse()
      if (.not. allocated(error)) call take_mesh()
      call add_context(error, 'no limit cycle was found')
   contains
      !> That at a time to which the march has come, s.
      type(crossing_type) function crossing(t)
         real(wp), intent(in) :: t
         logical :: ok
         crossing%time = t
         allocate (crossing%state(size(y)), crossing%rate(size(y)))
         call integrator%interpolate(t, crossing%state)
         call model%rhs(t, crossing%state, crossing%rate, ok)
         if (.not. ok) crossing%rate = 0
      end function crossing

      !> How far the motion is ahead of the plane at a time, s; `now` becomes its state.
      real(wp) function ahead(t)
         real(wp), intent(in) :: t
         call integrator%interpolate(t, now)
         ahead = sum(last%rate(x)*(now(x) - last%state(x))/model%scale(x)**2)
      end function ahead

      pure real(wp) function distance(state)
         real(wp), intent(in) :: state(:)
         distance = norm2((state(x) - last%state(x))/model%scale(x))
      end function distance

      !> Whether the crossing in the last step, which began at `start`, is a return.
      subroutine look()
         type(root_bracket) :: bracket
         real(wp) :: return_time
         integer :: cut
         bracket = root_bracket([start, t], [before, along])
         do cut = 1, most_cuts
            return_time = bracket%estimate()
            call bracket%narrow(return_time, ahead(return_time))
            if (bracket%width() <= 10*spacing(t)) exit
         end do
         if (distance(now) > close_by*last%farthest) return
         at_rest = last%farthest < rest
         period = return_time - last%time
         change = distance(now)/last%farthest
         last = crossing(return_time)
         along = ahead(t)
      end subroutine look

      !> The orbit on the steps of a march over the second of two periods: the first has the short ones of a start.
      subroutine take_mesh()
         integer :: k
         orbit%start = last%state
         orbit%scale = model%scale
         call integrator%start(model, options, 0.0_wp, last%state, 2*period, error)
         do k = 0, 1
            if (.not. allocated(error)) call march_period(integrator, options, k, period, orbit, error)
         end do
      end subroutine take_mesh

      subroutine refuse()
         if (at_rest) then
            call raise(error, numerics_error, 'the march from the start of the case comes to rest: it begins within ' &
               & //'an unstable cycle, or there is no cycle; begin at the end of a march that whirls (start%from = ' &
               & //'''file''), or further away (start%journal)')
         else
            call raise(error, numerics_error, 'the march from the start of the case does not repeat itself within ' &
               & //to_text(most_revolutions)//' revolutions; it still changes by '//to_text(change) &
               & //' of its size in a cycle')
         end if
      end subroutine refuse
   end subroutine find_marched_cycle
end module marched_cycle
