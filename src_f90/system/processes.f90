!> This process, its output and its children: what the runner of many runs asks of the system.
module processes
   use, intrinsic :: iso_c_binding, only: c_bool, c_char, c_int, c_long, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only: output_unit
   use text, only: to_text
   use errors, only: system_error
   use system_texts, only: fortran_text
   implicit none (type, external)
   private
   public :: process_id, process_alive, host_name, pause_seconds, set_environment, processors, can_have
   public :: is_terminal, write_output
   public :: new_process, end_child, limit_child, end_with_parent, ended, exit_status, stop_process
   public :: record_length, open_pipe, close_pipe, close_end, send_record, receive_record, wait_for_record
   public :: send_bytes, receive_bytes

   !> Bytes of a record; a pipe keeps up to 4096 together.
   integer, parameter :: record_length = 4000

   interface
      integer(c_int) function process_id() bind(c, name='getpid')
         import :: c_int
      end function process_id

      !> False where no process of this number runs on this machine.
      logical(c_bool) function process_alive(process) bind(c, name='tiltpad_is_alive')
         import :: c_bool, c_int
         integer(c_int), value :: process
      end function process_alive

      !> Does nothing for this number of seconds, or until a signal comes.
      subroutine pause_seconds(seconds) bind(c, name='tiltpad_pause')
         import :: c_int
         integer(c_int), value :: seconds
      end subroutine pause_seconds

      !> Sets an environment variable that is not set yet.
      subroutine set_environment(name, value) bind(c, name='tiltpad_set_environment')
         import :: c_char
         character(kind=c_char, len=*), intent(in) :: name, value
      end subroutine set_environment

      !> Processors that this process may use.
      integer(c_int) function processors() bind(c, name='tiltpad_processors')
         import :: c_int
      end function processors

      !> Whether the system gives this much memory, bytes, now.
      logical(c_bool) function can_have(bytes) bind(c, name='tiltpad_can_have')
         import :: c_bool, c_long
         integer(c_long), value :: bytes
      end function can_have

      !> True where standard output is a terminal.
      logical(c_bool) function is_terminal() bind(c, name='tiltpad_is_terminal')
         import :: c_bool
      end function is_terminal

      !> Starts a child that continues here as well: 0 in the child, its number in the parent, -1 if there is none.
      integer(c_int) function new_process() bind(c, name='fork')
         import :: c_int
      end function new_process

      !> Ends a child at once, without what the parent would do at its end.
      subroutine end_child(status) bind(c, name='_exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine end_child

      !> Called in a child: it prints nothing from now on, and ends after this number of seconds, of time or of the
      !> processor's time; it gets this number of megabytes of memory more than it has.
      subroutine limit_child(seconds, work, room) bind(c, name='tiltpad_limit_child')
         import :: c_int
         integer(c_int), value :: seconds, work, room
      end subroutine limit_child

      !> Called in a child: SIGTERM will come when the parent ends, or ends the child now if it has.
      subroutine end_with_parent(parent) bind(c, name='tiltpad_end_with_parent')
         import :: c_int
         integer(c_int), value :: parent
      end subroutine end_with_parent

      !> Sends a process SIGTERM.
      subroutine stop_process(process) bind(c, name='tiltpad_stop')
         import :: c_int
         integer(c_int), value :: process
      end subroutine stop_process

      !> Ends for reading and for writing; false if the system has none.
      logical(c_bool) function open_pipe(ends) bind(c, name='tiltpad_open_pipe')
         import :: c_bool, c_int
         integer(c_int), intent(out) :: ends(2)
      end function open_pipe

      subroutine close_pipe(ends) bind(c, name='tiltpad_close_pipe')
         import :: c_int
         integer(c_int), intent(in) :: ends(2)
      end subroutine close_pipe

      !> Sends a record through a pipe, whole and unmixed with others'.
      subroutine send_record(pipe, record) bind(c, name='tiltpad_send')
         import :: c_char, c_int
         integer(c_int), value :: pipe
         character(kind=c_char, len=*), intent(in) :: record
      end subroutine send_record

      !> Takes a record out of a pipe where one waits; false if that failed.
      logical(c_bool) function receive_record(pipe, record) bind(c, name='tiltpad_receive')
         import :: c_bool, c_char, c_int
         integer(c_int), value :: pipe
         ! allow(C072)
         character(kind=c_char, len=*), intent(inout) :: record
      end function receive_record

      subroutine close_end(pipe) bind(c, name='tiltpad_close_end')
         import :: c_int
         integer(c_int), value :: pipe
      end subroutine close_end

      !> Sends bytes through a pipe, waiting until they are taken; false where nobody takes them any more.
      logical(c_bool) function send_bytes(pipe, bytes, length) bind(c, name='tiltpad_send_bytes')
         import :: c_bool, c_int, c_ptr, c_size_t
         integer(c_int), value :: pipe
         type(c_ptr), value :: bytes
         integer(c_size_t), value :: length
      end function send_bytes

      !> Takes this number of bytes out of a pipe; false where the sender has ended before it sent them.
      logical(c_bool) function receive_bytes(pipe, bytes, length) bind(c, name='tiltpad_receive_bytes')
         import :: c_bool, c_int, c_ptr, c_size_t
         integer(c_int), value :: pipe
         type(c_ptr), value :: bytes
         integer(c_size_t), value :: length
      end function receive_bytes

      !> Waits until a record is there, or this number of milliseconds, or until a signal comes; true if one is there.
      logical(c_bool) function wait_for_record(pipe, milliseconds) bind(c, name='tiltpad_can_read')
         import :: c_bool, c_int
         integer(c_int), value :: pipe, milliseconds
      end function wait_for_record

      type(c_ptr) function c_host_name() bind(c, name='tiltpad_host_name')
         import :: c_ptr
      end function c_host_name

      logical(c_bool) function c_write_output(text) bind(c, name='tiltpad_write_output')
         import :: c_bool, c_char
         character(kind=c_char, len=*), intent(in) :: text
      end function c_write_output

      integer(c_int) function c_child_state(process, wait, code) bind(c, name='tiltpad_child_state')
         import :: c_int
         integer(c_int), value :: process, wait
         integer(c_int), intent(inout) :: code
      end function c_child_state
   end interface

contains

   !> Name of this machine, a word.
   function host_name()
      character(len=:), allocatable :: host_name
      host_name = fortran_text(c_host_name())
   end function host_name

   !> Writes text to standard output; false if not all of it could be written, which Fortran's own output does not tell.
   logical function write_output(text)
      character(len=*), intent(in) :: text
      flush (output_unit)
      write_output = c_write_output(text)
   end function write_output

   !> True once a child has ended, and how: nothing to say with status 0. With `wait` true it waits for that.
   logical function ended(process, wait, how)
      integer, intent(in) :: process
      logical, intent(in) :: wait
      character(len=:), allocatable, intent(out) :: how
      integer(c_int) :: code
      ended = .true.
      code = 0
      select case (c_child_state(process, merge(1_c_int, 0_c_int, wait), code))
      case (1)
         how = 'ended with status '//to_text(code)//' and without a report'
         ! the one end of a child with this status (program_start.c)
         if (code == system_error) how = 'out of memory'
         if (code == 0) how = ''
      case (2)
         how = 'ended by signal '//to_text(code)
      case default
         how = ''
         ended = .false.
      end select
   end function ended

   !> Waits for the end of a child: its exit status, or -1 where it ended otherwise.
   integer function exit_status(process) result(status)
      integer, intent(in) :: process
      integer(c_int) :: code, state
      code = 0
      ! a line of its own, as the order in which the arguments of a function are evaluated is free
      state = c_child_state(process, 1_c_int, code)
      status = merge(int(code), -1, state == 1)
   end function exit_status
end module processes
