!> Signals that ask the program to stop. The handler only takes a note; the program looks when it can stop well.
module stop_signals
   use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_int, c_intptr_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: catch_signals, stop_requested, stop_reason

   !> Linux' numbers of SIGINT, SIGUSR1 and SIGTERM.
   integer(c_int), parameter :: caught(*) = [2_c_int, 10_c_int, 15_c_int]
   integer(c_int), parameter :: sigpipe = 13
   !> C's SIG_IGN.
   integer(c_intptr_t), parameter :: ignore = 1
   !> The signal that came last; 0 for none. The handler writes it, hence not an argument.
   integer(c_int), volatile :: received = 0

   interface
      type(c_funptr) function c_signal(number, handler) bind(c, name='signal')
         import :: c_funptr, c_int
         integer(c_int), value :: number
         type(c_funptr), value :: handler
      end function c_signal
   end interface

contains

   !> From now on SIGINT, SIGUSR1 and SIGTERM end nothing by themselves but are noted; nor does a reader of what is
   !> printed end a run by going away.
   subroutine catch_signals()
      type(c_funptr) :: ignored
      integer :: i
      do i = 1, size(caught)
         ignored = c_signal(caught(i), c_funloc(note))
      end do
      ignored = c_signal(sigpipe, transfer(ignore, ignored))
   end subroutine catch_signals

   !> True once a signal has come.
   logical function stop_requested()
      stop_requested = received /= 0
   end function stop_requested

   !> "stopped by signal 15": the one that came last.
   function stop_reason()
      character(len=:), allocatable :: stop_reason
      stop_reason = 'stopped by signal '//to_text(int(received))
   end function stop_reason

   subroutine note(number) bind(c)
      integer(c_int), value :: number
      received = number
   end subroutine note
end module stop_signals
