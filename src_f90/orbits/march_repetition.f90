!> What displacements do from period to period of a march: repeat, repeat after some periods, creep, or none of these.
module march_repetition
   ! heap: arrays as long as a run
   use kinds, only: wp
   use text, only: to_text
   implicit none (type, external)
   private
   public :: march_repetition_type

   !> Where journal (first two) and tilts are at the ends of the periods, over their scales, (displacement, period).
   type :: march_repetition_type
      real(wp), allocatable :: at(:, :)
   contains
      procedure :: add
      procedure :: change
      procedure :: repeats
      procedure :: cause
   end type march_repetition_type

   !> A march repeats where its last periods, this many, each changed the displacements by less than this.
   real(wp), parameter :: small = 1e-3_wp
   integer, parameter :: looked_at = 3
   !> Most periods after which it is asked whether the march repeats.
   integer, parameter :: most_periods = 8
   !> A motion creeps where its way over `most_periods` periods is straight: not shorter than this part of the sum of
   !> its changes.
   real(wp), parameter :: straight = 0.9_wp

contains

   !> Adds the displacements at the end of a period.
   subroutine add(self, displacements)
      class(march_repetition_type), intent(inout) :: self
      real(wp), intent(in) :: displacements(:)
      if (allocated(self%at)) then
         self%at = reshape([self%at, displacements], [size(displacements), size(self%at, 2) + 1])
      else
         self%at = reshape(displacements, [size(displacements), 1])
      end if
   end subroutine add

   !> The largest change of a displacement over a number of periods, of the last three such changes.
   pure real(wp) function change(self, periods)
      class(march_repetition_type), intent(in) :: self
      integer, intent(in) :: periods
      associate (n => size(self%at, 2))
         change = huge(change)
         if (n < periods + looked_at) return
         change = maxval(abs(self%at(:, n - looked_at + 1:) - self%at(:, n - looked_at + 1 - periods:n - periods)))
      end associate
   end function change

   !> Whether the march repeats after a number of periods.
   pure logical function repeats(self, periods)
      class(march_repetition_type), intent(in) :: self
      integer, intent(in) :: periods
      repeats = self%change(periods) < small
   end function repeats

   !> Why there is no orbit of one period, which takes this number of revolutions.
   function cause(self, revolutions)
      class(march_repetition_type), intent(in) :: self
      integer, intent(in) :: revolutions
      character(len=:), allocatable :: cause
      real(wp) :: way
      integer :: k, worst
      cause = ''
      associate (n => size(self%at, 2))
         if (n < most_periods + looked_at) return
         do k = 2, most_periods
            if (.not. self%repeats(k)) cycle
            cause = 'the march repeats after '//to_text(k)//' periods: try periodic%revolutions = ' &
               & //to_text(k*revolutions)
            return
         end do
         worst = maxloc(maxval(abs(self%at(:, n - looked_at + 1:) - self%at(:, n - looked_at:n - 1)), dim=2), dim=1)
         associate (last => self%at(worst, n - most_periods:n))
            way = sum(abs(last(2:) - last(:most_periods)))
            cause = 'the march does not repeat: the journal'
            if (worst > 2) cause = 'the march does not repeat: pad '//to_text(worst - 2)
            if (abs(last(most_periods + 1) - last(1)) > straight*way) then
               cause = cause//' creeps by '//to_text(way/most_periods)
            else
               cause = cause//' changes by up to '//to_text(maxval(abs(last(2:) - last(:most_periods))))
            end if
            cause = cause//' of its characteristic scale in a period'
         end associate
      end associate
   end function cause
end module march_repetition
