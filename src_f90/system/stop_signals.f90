!> Signals that ask the program to stop. They are only noted; the program looks when it can stop well.
module stop_signals
   use, intrinsic :: iso_c_binding, only: c_int
   use text, only: to_text
   implicit none (type, external)
   private
   public :: catch_signals, ignore_file_limit, stop_requested, stop_reason

   interface
      !> From now on SIGINT, SIGUSR1, SIGTERM and SIGXCPU (a limit of CPU time) end nothing by themselves but are
      !> noted; nor does a reader of what is printed end a run by going away.
      subroutine catch_signals() bind(c, name='tiltpad_catch_signals')
      end subroutine catch_signals

      !> A file that grows past the limit of the shell then fails in writing, instead of ending the program.
      subroutine ignore_file_limit() bind(c, name='tiltpad_ignore_file_limit')
      end subroutine ignore_file_limit

      !> The signal that came last; 0 for none.
      integer(c_int) function received_signal() bind(c, name='tiltpad_received_signal')
         import :: c_int
      end function received_signal
   end interface

contains

   !> True once a signal has come.
   logical function stop_requested()
      stop_requested = received_signal() /= 0
   end function stop_requested

   !> "stopped by signal 15": the one that came last.
   function stop_reason()
      character(len=:), allocatable :: stop_reason
      stop_reason = 'stopped by signal '//to_text(int(received_signal()))
   end function stop_reason
end module stop_signals
