!> Progress of a march, or of the runs of a study, on standard output: one line that renews itself on a terminal, a
!> plain line now and then in a batch log.
module progress
   use, intrinsic :: iso_fortran_env, only: output_unit
   use kinds, only: wp, i8
   use clock, only: wall_clock
   use text, only: to_text, fixed_text
   use processes, only: is_terminal
   implicit none (type, external)
   private
   public :: progress_type, new_progress

   !> Seconds between two lines on a terminal and in a log.
   real(wp), parameter :: terminal_pause = 0.2_wp, log_pause = 10

   type :: progress_type
      logical :: quiet = .true., terminal = .false., shown = .false.
      real(wp) :: from = 0, duration = 0, started = 0, last = 0
   contains
      procedure :: report
      procedure :: report_runs
      procedure :: note
      procedure :: clear
   end type progress_type

contains

   !> Starts the clock of a march from one simulated time to another, s, or of this many runs.
   function new_progress(from, duration, quiet) result(progress)
      real(wp), intent(in) :: from, duration
      logical, intent(in) :: quiet
      type(progress_type) :: progress
      progress%from = from
      progress%duration = duration
      progress%quiet = quiet
      progress%terminal = is_terminal()
      progress%started = wall_clock()
      progress%last = progress%started
   end function new_progress

   !> Shows the time reached and the steps done, if it is time to. `now` is the wall clock, s.
   subroutine report(self, t, steps, now)
      class(progress_type), intent(inout) :: self
      real(wp), intent(in) :: t, now
      integer(i8), intent(in) :: steps
      character(len=:), allocatable :: line
      if (.not. is_due(self, now)) return
      line = 't = '//to_text(t)//' s of '//to_text(self%duration)//' s, '//to_text(int(100*t/self%duration)) &
         & //' %, '//to_text(steps)//' steps'
      call show(self, line, t)
   end subroutine report

   !> Shows how many runs have ended, well or not, and how many a second since the clock was started, if it is time to.
   subroutine report_runs(self, ended, failed)
      class(progress_type), intent(inout) :: self
      integer, intent(in) :: ended, failed
      real(wp) :: rate
      if (.not. is_due(self, wall_clock())) return
      rate = (ended - self%from)/(self%last - self%started)
      call show(self, to_text(ended)//' of '//to_text(nint(self%duration))//' runs, '//to_text(failed)//' failed, ' &
         & //fixed_text(rate, merge(1, 3, rate >= 10))//' runs/s', real(ended, wp))
   end subroutine report_runs

   !> True where a line is to be shown at this wall clock, s.
   logical function is_due(self, now)
      class(progress_type), intent(inout) :: self
      real(wp), intent(in) :: now
      is_due = .not. self%quiet .and. now - self%last >= merge(terminal_pause, log_pause, self%terminal)
      if (is_due) self%last = now
   end function is_due

   !> Shows a line, with the time left where so much of the duration is reached.
   subroutine show(self, text, reached)
      class(progress_type), intent(inout) :: self
      character(len=*), intent(in) :: text
      real(wp), intent(in) :: reached
      character(len=:), allocatable :: line
      line = text
      if (reached > self%from) line = line//', '//to_text(ceiling((self%last - self%started) &
         & *(self%duration - reached)/(reached - self%from))) &
         & //' s left'
      if (self%terminal) then
         write (output_unit, '(a)', advance='no') achar(13)//line//achar(27)//'[K'
      else
         write (output_unit, '(a)') line
      end if
      flush (output_unit)
      self%shown = .true.
   end subroutine show

   !> A line for the log; a terminal has its progress line.
   subroutine note(self, text)
      class(progress_type), intent(in) :: self
      character(len=*), intent(in) :: text
      if (self%quiet .or. self%terminal) return
      write (output_unit, '(a)') text
      flush (output_unit)
   end subroutine note

   !> Takes the renewing line away.
   subroutine clear(self)
      class(progress_type), intent(in) :: self
      if (self%shown .and. self%terminal) write (output_unit, '(a)', advance='no') achar(13)//achar(27)//'[K'
   end subroutine clear
end module progress
