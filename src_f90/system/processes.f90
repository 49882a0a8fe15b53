!> Child processes: what the runner of many members asks of Linux.
module processes
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_int8_t, c_int16_t, c_long, c_null_char, c_size_t
   use text, only: to_text
   use posix, only: c_kill, c_write
   use system_errors, only: error_number, system_reason
   implicit none (type, external)
   private
   public :: processors, make_folder, remove_folder, new_process, end_child, end_with_parent, ended, stop_process
   public :: record_length, open_pipe, close_pipe, send_record, receive_record, wait_for_record

   !> Bytes of a record; a pipe keeps up to 4096 together.
   integer, parameter :: record_length = 4000
   !> Linux' numbers.
   integer(c_int), parameter :: sigterm = 15, already_there = 17, wait_no_hang = 1, set_parent_death_signal = 1
   integer(c_int16_t), parameter :: readable = 1
   !> Permissions of a new folder, before the user's mask; bytes of a set of processors.
   integer(c_int), parameter :: all_may = int(o'777', c_int), set_bytes = 8192

   !> struct pollfd.
   type, bind(c) :: poll_type
      integer(c_int) :: descriptor
      integer(c_int16_t) :: wanted, found
   end type poll_type

   interface
      integer(c_int) function c_sched_getaffinity(process, bytes, set) bind(c, name='sched_getaffinity')
         import :: c_int, c_int8_t, c_size_t
         integer(c_int), value :: process
         integer(c_size_t), value :: bytes
         integer(c_int8_t), intent(inout) :: set(*)
      end function c_sched_getaffinity

      integer(c_int) function c_mkdir(path, mode) bind(c, name='mkdir')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
      end function c_mkdir

      integer(c_int) function c_rmdir(path) bind(c, name='rmdir')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_rmdir

      integer(c_int) function c_fork() bind(c, name='fork')
         import :: c_int
      end function c_fork

      integer(c_int) function c_getppid() bind(c, name='getppid')
         import :: c_int
      end function c_getppid

      subroutine c_leave(status) bind(c, name='_exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_leave

      integer(c_int) function c_prctl(what, argument) bind(c, name='prctl')
         import :: c_int, c_long
         integer(c_int), value :: what
         integer(c_long), value :: argument
      end function c_prctl

      integer(c_int) function c_pipe(ends) bind(c, name='pipe')
         import :: c_int
         integer(c_int), intent(out) :: ends(2)
      end function c_pipe

      integer(c_size_t) function c_read(descriptor, bytes, count) bind(c, name='read')
         import :: c_int, c_char, c_size_t, record_length
         integer(c_int), value :: descriptor
         character(kind=c_char), intent(out) :: bytes(record_length)
         integer(c_size_t), value :: count
      end function c_read

      integer(c_int) function c_poll(list, count, milliseconds) bind(c, name='poll')
         import :: c_int, c_long, poll_type
         type(poll_type), intent(inout) :: list
         integer(c_long), value :: count
         integer(c_int), value :: milliseconds
      end function c_poll

      integer(c_int) function c_waitpid(process, status, options) bind(c, name='waitpid')
         import :: c_int
         integer(c_int), value :: process, options
         integer(c_int), intent(out) :: status
      end function c_waitpid

      integer(c_int) function c_close(descriptor) bind(c, name='close')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_close
   end interface

contains

   !> Processors that this process may use.
   integer function processors()
      integer(c_int8_t) :: set(set_bytes)
      set = 0
      processors = 1
      if (c_sched_getaffinity(0_c_int, size(set, kind=c_size_t), set) == 0) processors = max(1, sum(popcnt(set)))
   end function processors

   !> Makes a folder unless something of its name is there; `trouble` is the system's reason, empty if all is well.
   subroutine make_folder(path, trouble)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: trouble
      trouble = ''
      if (c_mkdir(path//c_null_char, all_may) == 0) return
      if (error_number() /= already_there) trouble = system_reason()
   end subroutine make_folder

   !> Removes an empty folder, if it is there.
   subroutine remove_folder(path)
      character(len=*), intent(in) :: path
      integer(c_int) :: ignored
      ignored = c_rmdir(path//c_null_char)
   end subroutine remove_folder

   !> The process goes on twice: 0 is returned in the child, its number in the parent, and -1 where it could not be.
   integer function new_process()
      new_process = int(c_fork())
   end function new_process

   !> Ends a child at once, without what the parent would do at its end.
   subroutine end_child(status)
      integer, intent(in) :: status
      call c_leave(int(status, c_int))
   end subroutine end_child

   !> Called in a child: SIGTERM will come when the parent ends, or ends the child now if it has.
   subroutine end_with_parent(parent)
      integer, intent(in) :: parent
      integer(c_int) :: ignored
      ignored = c_prctl(set_parent_death_signal, int(sigterm, c_long))
      if (c_getppid() /= parent) call c_leave(1_c_int)
   end subroutine end_with_parent

   !> Ends for reading and for writing; ok is false if there are none to be had.
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

   !> Waits until a record is there, or so many milliseconds, or until a signal comes; true if one is there.
   logical function wait_for_record(pipe, milliseconds)
      integer, intent(in) :: pipe, milliseconds
      type(poll_type) :: list
      list%descriptor = int(pipe, c_int)
      list%wanted = readable
      list%found = 0
      wait_for_record = c_poll(list, 1_c_long, int(milliseconds, c_int)) == 1
   end function wait_for_record

   !> True once a child has ended, and how. With `wait` true it waits for that.
   logical function ended(process, wait, how)
      integer, intent(in) :: process
      logical, intent(in) :: wait
      character(len=:), allocatable, intent(out) :: how
      integer(c_int) :: status, found
      how = ''
      do
         found = c_waitpid(int(process, c_int), status, merge(0_c_int, wait_no_hang, wait))
         ! a signal may end the waiting early
         if (found /= -1 .or. .not. wait) exit
      end do
      ended = found == process
      if (.not. ended) return
      if (iand(status, 127) /= 0) then
         how = 'ended by signal '//to_text(iand(int(status), 127))
      else
         how = 'ended with status '//to_text(iand(ishft(int(status), -8), 255))//' and without a word'
      end if
   end function ended

   !> Sends a process SIGTERM.
   subroutine stop_process(process)
      integer, intent(in) :: process
      integer(c_int) :: ignored
      ignored = c_kill(int(process, c_int), sigterm)
   end subroutine stop_process
end module processes
