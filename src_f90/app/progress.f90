!> Progress of a march on standard output: one line that renews itself on a terminal, a plain line now
!> and then in a batch log.
module progress
   use, intrinsic :: iso_fortran_env, only: output_unit
   use kinds, only: wp, i8
   use text, only: to_text
   use posix, only: is_terminal
   implicit none (type, external)
   private
   public :: progress_type, new_progress, wall_clock

   !> Seconds between two lines on a terminal and in a log.
   real(wp), parameter :: terminal_pause = 0.2_wp, log_pause = 10

   type :: progress_type
      logical :: quiet = .true., terminal = .false., shown = .false.
      real(wp) :: from = 0, duration = 0, started = 0, last = 0
   contains
      procedure :: report
      procedure :: note
      procedure :: clear
   end type progress_type

contains

   !> Starts the clock of a march from one simulated time to another, s.
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
      if (self%quiet) return
      if (now - self%last < merge(terminal_pause, log_pause, self%terminal)) return
      self%last = now
      line = 't = '//to_text(t)//' s of '//to_text(self%duration)//' s, '//to_text(int(100*t/self%duration)) &
         & //' %, '//to_text(steps)//' steps'
      if (t > self%from) line = line//', '//to_text(ceiling((now - self%started)*(self%duration - t)/(t - self%from))) &
         & //' s left'
      if (self%terminal) then
         write (output_unit, '(a)', advance='no') achar(13)//line//achar(27)//'[K'
      else
         write (output_unit, '(a)') line
      end if
      flush (output_unit)
      self%shown = .true.
   end subroutine report

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

   !> Wall clock, s.
   real(wp) function wall_clock()
      integer(i8) :: count, rate
      call system_clock(count, rate)
      wall_clock = real(count, wp)/real(rate, wp)
   end function wall_clock
end module progress
