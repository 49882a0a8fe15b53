!> This process and its children: what the runner of many runs asks of the system.
module processes
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_loc, c_long, c_null_char, c_size_t
   use text, only: to_text
   use c_strings, only: fortran_text
   use system_errors, only: system_reason
   implicit none (type, external)
   private
   public :: process_id, process_alive, host_name, pause_seconds, set_environment, processors
   public :: make_folder, remove_folder, other_number
   public :: new_process, end_child, limit_child, end_with_parent, ended, stop_process
   public :: record_length, open_pipe, close_pipe, send_record, receive_record, wait_for_record

   !> Bytes of a record; a pipe keeps up to 4096 together.
   integer, parameter :: record_length = 4000
   !> Room for the name of a machine, or of a file.
   integer, parameter :: name_length = 256

   interface
      integer(c_int) function process_id() bind(c, name='getpid')
         import :: c_int
      end function process_id

      integer(c_int) function c_is_alive(process) bind(c, name='tiltpad_is_alive')
         import :: c_int
         integer(c_int), value :: process
      end function c_is_alive

      integer(c_int) function c_gethostname(name, length) bind(c, name='gethostname')
         import :: c_int, c_char, c_size_t, name_length
         character(kind=c_char), intent(inout) :: name(name_length)
         integer(c_size_t), value :: length
      end function c_gethostname

      integer(c_int) function c_sleep(seconds) bind(c, name='sleep')
         import :: c_int
         integer(c_int), value :: seconds
      end function c_sleep

      integer(c_int) function c_setenv(name, value, overwrite) bind(c, name='setenv')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: name(*), value(*)
         integer(c_int), value :: overwrite
      end function c_setenv

      integer(c_int) function c_processors() bind(c, name='tiltpad_processors')
         import :: c_int
      end function c_processors

      integer(c_int) function c_make_folder(path) bind(c, name='tiltpad_make_folder')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_make_folder

      subroutine c_other_number(folder, digits, last, name, length) bind(c, name='tiltpad_other_number')
         import :: c_char, c_int, c_long, c_size_t, name_length
         character(kind=c_char), intent(in) :: folder(*)
         integer(c_int), value :: digits
         integer(c_long), value :: last
         character(kind=c_char), intent(inout) :: name(name_length)
         integer(c_size_t), value :: length
      end subroutine c_other_number

      integer(c_int) function c_rmdir(path) bind(c, name='rmdir')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_rmdir

      integer(c_int) function c_fork() bind(c, name='fork')
         import :: c_int
      end function c_fork

      subroutine c_leave(status) bind(c, name='_exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_leave

      subroutine c_limit_child(seconds, work, room) bind(c, name='tiltpad_limit_child')
         import :: c_int
         integer(c_int), value :: seconds, work, room
      end subroutine c_limit_child

      integer(c_int) function c_end_with_parent(parent) bind(c, name='tiltpad_end_with_parent')
         import :: c_int
         integer(c_int), value :: parent
      end function c_end_with_parent

      integer(c_int) function c_child_state(process, wait, code) bind(c, name='tiltpad_child_state')
         import :: c_int
         integer(c_int), value :: process, wait
         integer(c_int), intent(inout) :: code
      end function c_child_state

      subroutine c_stop(process) bind(c, name='tiltpad_stop')
         import :: c_int
         integer(c_int), value :: process
      end subroutine c_stop

      integer(c_int) function c_pipe(ends) bind(c, name='pipe')
         import :: c_int
         integer(c_int), intent(out) :: ends(2)
      end function c_pipe

      integer(c_int) function c_close(descriptor) bind(c, name='close')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_close

      integer(c_size_t) function c_read(descriptor, bytes, count) bind(c, name='read')
         import :: c_int, c_char, c_size_t, record_length
         integer(c_int), value :: descriptor
         character(kind=c_char), intent(out) :: bytes(record_length)
         integer(c_size_t), value :: count
      end function c_read

      integer(c_size_t) function c_write(descriptor, bytes, count) bind(c, name='write')
         import :: c_int, c_char, c_size_t
         integer(c_int), value :: descriptor
         character(kind=c_char), intent(in) :: bytes(*)
         integer(c_size_t), value :: count
      end function c_write

      integer(c_int) function c_can_read(pipe, milliseconds) bind(c, name='tiltpad_can_read')
         import :: c_int
         integer(c_int), value :: pipe, milliseconds
      end function c_can_read
   end interface

contains

   !> False where no process of this number runs on this machine.
   logical function process_alive(process)
      integer, intent(in) :: process
      process_alive = c_is_alive(int(process, c_int)) == 1
   end function process_alive

   !> Name of this machine.
   function host_name()
      character(len=:), allocatable :: host_name
      character(kind=c_char), target :: buffer(name_length)
      host_name = 'unknown'
      if (c_gethostname(buffer, int(name_length, c_size_t)) == 0) host_name = fortran_text(c_loc(buffer))
   end function host_name

   !> Does nothing for this number of seconds, or until a signal comes.
   subroutine pause_seconds(seconds)
      integer, intent(in) :: seconds
      integer(c_int) :: ignored
      ignored = c_sleep(int(seconds, c_int))
   end subroutine pause_seconds

   !> Sets an environment variable that is not set yet.
   subroutine set_environment(name, value)
      character(len=*), intent(in) :: name, value
      integer(c_int) :: ignored
      ignored = c_setenv(name//c_null_char, value//c_null_char, 0_c_int)
   end subroutine set_environment

   !> Processors that this process may use.
   integer function processors()
      processors = max(1, int(c_processors()))
   end function processors

   !> Makes a folder unless something of its name is there; `refusal` is the system's reason, empty if all is well.
   !> `made` is true if it was not there.
   subroutine make_folder(path, refusal, made)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: refusal
      logical, intent(out), optional :: made
      integer(c_int) :: found
      found = c_make_folder(path//c_null_char)
      refusal = ''
      if (found == 0) refusal = system_reason()
      if (present(made)) made = found == 1
   end subroutine make_folder

   !> A name in a folder that is a number with '.h5', but not one from 1 to `last` with this number of digits; empty
   !> where there is none.
   function other_number(folder, digits, last) result(name)
      character(len=*), intent(in) :: folder
      integer, intent(in) :: digits, last
      character(len=:), allocatable :: name
      character(kind=c_char), target :: buffer(name_length)
      call c_other_number(folder//c_null_char, int(digits, c_int), int(last, c_long), buffer, &
         & size(buffer, kind=c_size_t))
      name = fortran_text(c_loc(buffer))
   end function other_number

   !> Removes an empty folder, if it is there.
   subroutine remove_folder(path)
      character(len=*), intent(in) :: path
      integer(c_int) :: ignored
      ignored = c_rmdir(path//c_null_char)
   end subroutine remove_folder

   !> Starts a child that continues here as well: 0 in the child, its number in the parent, -1 if there is none.
   integer function new_process()
      new_process = int(c_fork())
   end function new_process

   !> Ends a child at once, without what the parent would do at its end.
   subroutine end_child(status)
      integer, intent(in) :: status
      call c_leave(int(status, c_int))
   end subroutine end_child

   !> Called in a child: it prints nothing from now on, and ends after this number of seconds, of time or of the
   !> processor's time; it gets this number of megabytes of memory more than it has.
   subroutine limit_child(seconds, work, room)
      integer, intent(in) :: seconds, work, room
      call c_limit_child(int(seconds, c_int), int(work, c_int), int(room, c_int))
   end subroutine limit_child

   !> Called in a child: SIGTERM will come when the parent ends, or ends the child now if it has.
   subroutine end_with_parent(parent)
      integer, intent(in) :: parent
      if (c_end_with_parent(int(parent, c_int)) == 0) call c_leave(1_c_int)
   end subroutine end_with_parent

   !> True once a child has ended, and how. With `wait` true it waits for that.
   logical function ended(process, wait, how)
      integer, intent(in) :: process
      logical, intent(in) :: wait
      character(len=:), allocatable, intent(out) :: how
      integer(c_int) :: code
      ended = .true.
      code = 0
      select case (c_child_state(int(process, c_int), merge(1_c_int, 0_c_int, wait), code))
      case (1)
         how = 'ended with status '//to_text(int(code))//' and without a report'
      case (2)
         how = 'ended by signal '//to_text(int(code))
      case default
         how = ''
         ended = .false.
      end select
   end function ended

   !> Sends a process SIGTERM.
   subroutine stop_process(process)
      integer, intent(in) :: process
      call c_stop(int(process, c_int))
   end subroutine stop_process

   !> Ends for reading and for writing; ok is false if the system has none.
   subroutine open_pipe(ends, ok)
      integer, intent(out) :: ends(2)
      logical, intent(out) :: ok
      integer(c_int) :: found(2)
      ok = c_pipe(found) == 0
      ends = int(found)
   end subroutine open_pipe

   subroutine close_pipe(ends)
      integer, intent(in) :: ends(2)
      integer(c_int) :: ignored
      integer :: i
      do i = 1, 2
         ignored = c_close(int(ends(i), c_int))
      end do
   end subroutine close_pipe

   !> Sends a record through a pipe, whole and unmixed with others'.
   subroutine send_record(pipe, record)
      integer, intent(in) :: pipe
      character(len=record_length), intent(in) :: record
      integer(c_size_t) :: ignored
      ignored = c_write(int(pipe, c_int), record, len(record, c_size_t))
   end subroutine send_record

   !> Takes a record out of a pipe where one waits; ok is false if that failed.
   subroutine receive_record(pipe, record, ok)
      integer, intent(in) :: pipe
      character(len=record_length), intent(out) :: record
      logical, intent(out) :: ok
      ok = c_read(int(pipe, c_int), record, len(record, c_size_t)) == record_length
   end subroutine receive_record

   !> Waits until a record is there, or this number of milliseconds, or until a signal comes; true if one is there.
   logical function wait_for_record(pipe, milliseconds)
      integer, intent(in) :: pipe, milliseconds
      wait_for_record = c_can_read(int(pipe, c_int), int(milliseconds, c_int)) == 1
   end function wait_for_record
end module processes
