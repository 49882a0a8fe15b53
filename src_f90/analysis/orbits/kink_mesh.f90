!> The kinks of friction on an orbit: ends of intervals of its collocation are moved to where a pivot passes one, or the
!> polynomials would lose their order there.
module kink_mesh
   use kinds, only: wp
   use equations_of_motion, only: bearing_model
   use orbit_polynomials, only: orbit_type
   implicit none (type, external)
   private
   public :: follow_kinks

   !> The part of an interval by which an end may be moved.
   real(wp), parameter :: beside = 0.3_wp
   !> Ends that are closer than this part of the period are one.
   real(wp), parameter :: rounding = 1e-9_wp
   !> Bisections that find a passage.
   integer, parameter :: bisections = 50

   !> A mesh in the making: ends of intervals, s, with those moved already marked, and new ends.
   type :: mesh_type
      real(wp), allocatable :: time(:), new(:)
      logical, allocatable :: moved(:)
   contains
      procedure :: put_end
   end type mesh_type

contains

   !> Puts an orbit on a mesh with an end of an interval wherever the pivot of a pad passes a kink of its friction; its
   !> mesh stays where it has settled.
   subroutine follow_kinks(model, orbit)
      type(bearing_model), intent(in) :: model
      type(orbit_type), intent(inout) :: orbit
      type(mesh_type) :: mesh
      real(wp), allocatable :: kinks(:), ends(:)
      integer :: pad, i, k, state
      if (orbit%settled .or. .not. model%layout%tilting) return
      kinks = model%bearing%friction%kinks()
      if (size(kinks) == 0) return
      allocate (mesh%time(0:orbit%intervals()), source=orbit%time)
      allocate (mesh%moved(0:orbit%intervals()), source=.false.)
      allocate (mesh%new(0))
      do pad = 1, model%layout%pads
         state = model%layout%tilt_rate(pad)
         ends = orbit%values_at_ends(state)
         do i = 1, size(kinks)
            associate (rate => kinks(i)/model%bearing%pads(pad)%ball_radius)
               do k = 1, orbit%intervals()
                  if ((ends(k) < rate) .neqv. (ends(k + 1) < rate)) call mesh%put_end(k, &
                     & passage(orbit, state, rate, orbit%time(k - 1), orbit%time(k)))
               end do
            end associate
         end do
      end do
      call orbit%change_mesh(sorted([mesh%time, mesh%new]))
   end subroutine follow_kinks

   !> An end at time t, s, in interval k: one of its ends, if it is close and free, else a new one.
   pure subroutine put_end(self, k, t)
      class(mesh_type), intent(inout) :: self
      integer, intent(in) :: k
      real(wp), intent(in) :: t
      integer :: end
      logical :: moves
      end = merge(k - 1, k, t - self%time(k - 1) < self%time(k) - t)
      moves = abs(t - self%time(end)) < beside*(self%time(k) - self%time(k - 1)) .and. .not. self%moved(end) &
         & .and. end > 0 .and. end < ubound(self%time, 1)
      if (moves) then
         self%time(end) = t
         self%moved(end) = .true.
      else
         self%new = [self%new, t]
      end if
   end subroutine put_end

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

   !> Times in their order, without those that are next to another by rounding.
   pure function sorted(times)
      !> Most of them in their order.
      real(wp), intent(in) :: times(:)
      real(wp), allocatable :: sorted(:)
      real(wp) :: next, apart
      integer :: k, i, n
      allocate (sorted(size(times)))
      apart = rounding*maxval(times)
      n = 0
      do k = 1, size(times)
         next = times(k)
         i = n
         do while (i > 0)
            if (sorted(i) <= next) exit
            i = i - 1
         end do
         if (any(abs(sorted(max(i, 1):min(i + 1, n)) - next) <= apart)) cycle
         sorted(i + 2:n + 1) = sorted(i + 1:n)
         sorted(i + 1) = next
         n = n + 1
      end do
      sorted = sorted(:n)
   end function sorted
end module kink_mesh
