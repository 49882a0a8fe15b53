!> The switching points that an orbit passes: intervals of its collocation end there, or the polynomials would lose
!> their order. Such an end goes with the orbit as Newton's method corrects it; here it is found that there is, or is no
!> longer, one.
module event_mesh
   ! heap: arrays as long as a run
   use kinds, only: wp
   use roots, only: root_bracket
   use ode_model, only: ode_model_type
   use orbit_polynomials, only: orbit_type, points, place
   implicit none (type, external)
   private
   public :: follow_switching_points

   !> Ends that are closer than this part of the period are one.
   real(wp), parameter :: rounding = 1e-9_wp
   !> A passage is found to this part of the distance of two points; most evaluations for it.
   real(wp), parameter :: closeness = 1e-14_wp
   integer, parameter :: most_cuts = 50

   !> A mesh in the making: ends of intervals, s, and the switching points at them.
   type :: mesh_type
      real(wp), allocatable :: time(:)
      integer, allocatable :: switching_point(:)
      logical :: changed = .false.
   end type mesh_type

contains

   !> Puts an end of an interval wherever an orbit passes a switching point of its model, and drops those where it no
   !> longer does.
   subroutine follow_switching_points(model, orbit)
      class(ode_model_type), intent(in) :: model
      type(orbit_type), intent(inout) :: orbit
      type(mesh_type) :: mesh
      integer, allocatable :: state(:)
      real(wp), allocatable :: value(:)
      integer :: switching_point, k
      call model%switching_points(state, value)
      mesh%time = [orbit%time]
      mesh%switching_point = [orbit%switching_point]
      do k = 1, orbit%intervals()
         if (orbit%switching_point(k) < 0) call drop_end(mesh, orbit%time(k))
      end do
      do switching_point = 1, size(state)
         call follow_switching_point(orbit, switching_point, state(switching_point), value(switching_point), mesh)
      end do
      if (mesh%changed) call orbit%change_mesh(mesh%time, mesh%switching_point)
   end subroutine follow_switching_points

   !> Does so for one switching point. The state is on different sides before and after an end that lies there, and
   !> elsewhere on one side from point to point.
   subroutine follow_switching_point(orbit, switching_point, state, value, mesh)
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: switching_point, state
      real(wp), intent(in) :: value
      type(mesh_type), intent(inout) :: mesh
      logical :: at_end
      real(wp) :: before, now, last, above
      integer :: k, i
      last = orbit%start(state) - value
      at_end = .false.
      before = 0
      do k = 1, orbit%intervals()
         do i = 1, points
            now = orbit%time(k - 1) + place(i)*(orbit%time(k) - orbit%time(k - 1))
            if (i == points .and. orbit%switching_point(k) == switching_point) then
               at_end = .true.
            else
               above = orbit%at(state, i, k) - value
               if (at_end) then
                  if (above < 0 .eqv. last < 0) call drop_end(mesh, orbit%time(k - 1))
               else if (above < 0 .neqv. last < 0) then
                  call put_end(mesh, passage(orbit, state, value, root_bracket([before, now], [last, above])), &
                     & switching_point)
               end if
               at_end = .false.
               last = above
            end if
            before = now
         end do
      end do
   end subroutine follow_switching_point

   !> An end at a switching point at time t, s: a new one, or the one that is there, if it lies at no other switching
   !> point.
   pure subroutine put_end(self, t, switching_point)
      class(mesh_type), intent(inout) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: switching_point
      integer :: closest, before
      closest = minloc(abs(self%time - t), dim=1)
      if (abs(self%time(closest) - t) <= rounding*self%time(size(self%time))) then
         if (self%switching_point(closest) /= 0 .or. closest == 1 .or. closest == size(self%time)) return
         self%switching_point(closest) = switching_point
      else
         before = count(self%time < t)
         self%time = [self%time(:before), t, self%time(before + 1:)]
         self%switching_point = [self%switching_point(:before), switching_point, self%switching_point(before + 1:)]
      end if
      self%changed = .true.
   end subroutine put_end

   !> Without the end at time t, s.
   pure subroutine drop_end(self, t)
      class(mesh_type), intent(inout) :: self
      real(wp), intent(in) :: t
      self%switching_point = pack(self%switching_point, abs(self%time - t) > 0)
      self%time = pack(self%time, abs(self%time - t) > 0)
      self%changed = .true.
   end subroutine drop_end

   !> When a state passes a value, s, between the two times of a bracket.
   pure real(wp) function passage(orbit, state, value, between)
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: state
      real(wp), intent(in) :: value
      type(root_bracket), intent(in) :: between
      type(root_bracket) :: bracket
      real(wp) :: y(size(orbit%start))
      integer :: i
      bracket = between
      do i = 1, most_cuts
         passage = bracket%estimate()
         if (abs(passage - bracket%place(2)) <= closeness*between%width()) return
         call orbit%state_at(passage, y)
         call bracket%narrow(passage, y(state) - value)
      end do
   end function passage
end module event_mesh
