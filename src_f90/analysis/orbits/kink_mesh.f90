!> The kinks that an orbit passes: intervals of its collocation end there, or the polynomials would lose their order.
!> Such an end goes with the orbit as Newton's method corrects it; here it is found that there is, or is no longer, one.
module kink_mesh
   use kinds, only: wp
   use ode_model, only: ode_model_type
   use orbit_polynomials, only: orbit_type, points, place
   implicit none (type, external)
   private
   public :: follow_kinks

   !> Ends that are closer than this part of the period are one.
   real(wp), parameter :: rounding = 1e-9_wp
   !> Bisections that find a passage.
   integer, parameter :: bisections = 50

   !> A mesh in the making: ends of intervals, s, and the kinks at them.
   type :: mesh_type
      real(wp), allocatable :: time(:)
      integer, allocatable :: kink(:)
      logical :: changed = .false.
   contains
      procedure :: put_end
      procedure :: drop_end
   end type mesh_type

contains

   !> Puts an end of an interval wherever an orbit passes a kink of its model, and drops those where it no longer does.
   subroutine follow_kinks(model, orbit)
      class(ode_model_type), intent(in) :: model
      type(orbit_type), intent(inout) :: orbit
      type(mesh_type) :: mesh
      integer, allocatable :: state(:)
      real(wp), allocatable :: value(:)
      integer :: kink, k
      call model%kinks(state, value)
      mesh%time = [orbit%time]
      mesh%kink = [orbit%kink]
      do k = 1, orbit%intervals()
         if (orbit%kink(k) < 0) call mesh%drop_end(orbit%time(k))
      end do
      do kink = 1, size(state)
         call follow_kink(orbit, kink, state(kink), value(kink), mesh)
      end do
      if (mesh%changed) call orbit%change_mesh(mesh%time, mesh%kink)
   end subroutine follow_kinks

   !> Does so for one kink. The state is on different sides before and after an end that lies there, and elsewhere on
   !> one side from point to point.
   subroutine follow_kink(orbit, kink, state, value, mesh)
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: kink, state
      real(wp), intent(in) :: value
      type(mesh_type), intent(inout) :: mesh
      logical :: was_below, is_below, at_end
      real(wp) :: before, now
      integer :: k, i
      was_below = orbit%start(state) < value
      at_end = .false.
      before = 0
      do k = 1, orbit%intervals()
         do i = 1, points
            now = orbit%time(k - 1) + place(i)*(orbit%time(k) - orbit%time(k - 1))
            if (i == points .and. orbit%kink(k) == kink) then
               at_end = .true.
            else
               is_below = orbit%at(state, i, k) < value
               if (at_end) then
                  if (is_below .eqv. was_below) call mesh%drop_end(orbit%time(k - 1))
               else if (is_below .neqv. was_below) then
                  call mesh%put_end(passage(orbit, state, value, before, now), kink)
               end if
               at_end = .false.
               was_below = is_below
            end if
            before = now
         end do
      end do
   end subroutine follow_kink

   !> An end at a kink at time t, s: a new one, or the one that is there, if it lies at no other kink.
   pure subroutine put_end(self, t, kink)
      class(mesh_type), intent(inout) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: kink
      integer :: near, before
      near = minloc(abs(self%time - t), dim=1)
      if (abs(self%time(near) - t) <= rounding*self%time(size(self%time))) then
         if (self%kink(near) /= 0 .or. near == 1 .or. near == size(self%time)) return
         self%kink(near) = kink
      else
         before = count(self%time < t)
         self%time = [self%time(:before), t, self%time(before + 1:)]
         self%kink = [self%kink(:before), kink, self%kink(before + 1:)]
      end if
      self%changed = .true.
   end subroutine put_end

   !> Without the end at time t, s.
   pure subroutine drop_end(self, t)
      class(mesh_type), intent(inout) :: self
      real(wp), intent(in) :: t
      self%kink = pack(self%kink, abs(self%time - t) > 0)
      self%time = pack(self%time, abs(self%time - t) > 0)
      self%changed = .true.
   end subroutine drop_end

   !> When a state passes a value between two times, s.
   pure real(wp) function passage(orbit, state, value, from, to)
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: state
      real(wp), intent(in) :: value, from, to
      real(wp) :: y(size(orbit%start)), low, high
      logical :: below
      integer :: i
      call orbit%state_at(from, y)
      below = y(state) < value
      low = from
      high = to
      do i = 1, bisections
         passage = 0.5_wp*(low + high)
         call orbit%state_at(passage, y)
         if ((y(state) < value) .eqv. below) then
            low = passage
         else
            high = passage
         end if
      end do
   end function passage
end module kink_mesh
