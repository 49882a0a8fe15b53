!> The few things the system does for us that Fortran has no word for.
module posix
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_funptr, c_int, c_loc, c_int16_t, c_intptr_t, &
      & c_long, c_null_char, c_null_ptr, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only: output_unit
   use c_strings, only: fortran_text
   use system_errors, only: error_number
   implicit none (type, external)
   private
   public :: rename_file, delete_file, real_path, is_regular, process_id, is_terminal, write_output
   public :: keep_file_size_quiet, copy_file, link_file, sync_file, begin_sync, host_name, process_alive, pause_seconds
   public :: set_environment
   !> C's own, for modules that keep a descriptor.
   public :: c_fopen, c_fileno, c_fclose, c_write, c_statx, c_kill

   !> Longest path, and Linux' numbers for statx and for the signal of a file grown too large.
   integer, parameter :: path_max = 4096
   !> Links that may follow one another, as in Linux.
   integer, parameter :: most_links = 40
   integer(c_int), parameter :: at_fdcwd = -100, statx_type = 1, sigxfsz = 25
   !> Shorts in struct statx; the one that holds the mode; file type in it, and that of regular files.
   integer, parameter, public :: statx_shorts = 128
   integer, parameter :: mode_at = 15
   integer, parameter :: type_mask = int(o'170000'), type_regular = int(o'100000')
   !> Linux' error that a process is no more.
   integer, parameter :: no_process = 3
   !> Linux' number for the beginning of writing, without waiting for its end.
   integer(c_int), parameter :: sync_write = 2
   !> Bytes copied at a time.
   integer(c_size_t), parameter :: copy_bytes = 2_c_size_t**30

   interface
      integer(c_int) function c_rename(old, new) bind(c, name='rename')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: old(*), new(*)
      end function c_rename

      integer(c_int) function c_unlink(path) bind(c, name='unlink')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_unlink

      integer(c_int) function process_id() bind(c, name='getpid')
         import :: c_int
      end function process_id

      !> Its layout is the same on all machines, unlike stat's.
      integer(c_int) function c_statx(directory, path, flags, mask, buffer) bind(c, name='statx')
         import :: c_int, c_char, c_int16_t
         integer(c_int), value :: directory, flags, mask
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int16_t), intent(out) :: buffer(*)
      end function c_statx

      type(c_ptr) function c_realpath(path, resolved) bind(c, name='realpath')
         import :: c_ptr, c_char, path_max
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(inout) :: resolved(path_max)
      end function c_realpath

      integer(c_size_t) function c_readlink(path, target, length) bind(c, name='readlink')
         import :: c_char, c_size_t, path_max
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(inout) :: target(path_max)
         integer(c_size_t), value :: length
      end function c_readlink

      type(c_funptr) function c_signal(number, handler) bind(c, name='signal')
         import :: c_funptr, c_int, c_intptr_t
         integer(c_int), value :: number
         integer(c_intptr_t), value :: handler
      end function c_signal

      integer(c_size_t) function c_write(descriptor, bytes, count) bind(c, name='write')
         import :: c_int, c_char, c_size_t
         integer(c_int), value :: descriptor
         character(kind=c_char), intent(in) :: bytes(*)
         integer(c_size_t), value :: count
      end function c_write

      integer(c_int) function c_link(old, new) bind(c, name='link')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: old(*), new(*)
      end function c_link

      type(c_ptr) function c_fopen(path, mode) bind(c, name='fopen')
         import :: c_ptr, c_char
         character(kind=c_char), intent(in) :: path(*), mode(*)
      end function c_fopen

      integer(c_int) function c_fileno(stream) bind(c, name='fileno')
         import :: c_int, c_ptr
         type(c_ptr), value :: stream
      end function c_fileno

      integer(c_int) function c_fclose(stream) bind(c, name='fclose')
         import :: c_int, c_ptr
         type(c_ptr), value :: stream
      end function c_fclose

      integer(c_int) function c_fsync(descriptor) bind(c, name='fsync')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_fsync

      integer(c_int) function c_sync_file_range(descriptor, offset, bytes, what) bind(c, name='sync_file_range')
         import :: c_int, c_long
         integer(c_int), value :: descriptor, what
         integer(c_long), value :: offset, bytes
      end function c_sync_file_range

      !> Copies within the kernel, from and to where the descriptors are.
      integer(c_size_t) function c_sendfile(to, from, offset, count) bind(c, name='sendfile')
         import :: c_int, c_ptr, c_size_t
         integer(c_int), value :: to, from
         type(c_ptr), value :: offset
         integer(c_size_t), value :: count
      end function c_sendfile

      integer(c_int) function c_gethostname(name, length) bind(c, name='gethostname')
         import :: c_int, c_char, c_size_t, path_max
         character(kind=c_char), intent(inout) :: name(path_max)
         integer(c_size_t), value :: length
      end function c_gethostname

      integer(c_int) function c_kill(process, number) bind(c, name='kill')
         import :: c_int
         integer(c_int), value :: process, number
      end function c_kill

      integer(c_int) function c_nanosleep(time, rest) bind(c, name='nanosleep')
         import :: c_int, c_long, c_ptr
         integer(c_long), intent(in) :: time(2)
         type(c_ptr), value :: rest
      end function c_nanosleep

      integer(c_int) function c_setenv(name, value, overwrite) bind(c, name='setenv')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: name(*), value(*)
         integer(c_int), value :: overwrite
      end function c_setenv

      integer(c_int) function c_isatty(descriptor) bind(c, name='isatty')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_isatty
   end interface

contains

   !> Renames a file at once, replacing one of the new name; ok is false if that failed.
   logical function rename_file(old, new) result(ok)
      character(len=*), intent(in) :: old, new
      ok = c_rename(old//c_null_char, new//c_null_char) == 0
   end function rename_file

   !> Deletes a file if it is there.
   subroutine delete_file(path)
      character(len=*), intent(in) :: path
      integer(c_int) :: ignored
      ignored = c_unlink(path//c_null_char)
   end subroutine delete_file

   !> Gives a file a second name; ok is false where that is not possible.
   logical function link_file(old, new) result(ok)
      character(len=*), intent(in) :: old, new
      ok = c_link(old//c_null_char, new//c_null_char) == 0
   end function link_file

   !> Copies a file, replacing one of the new name; ok is false if not all of it could be copied.
   logical function copy_file(old, new) result(ok)
      character(len=*), intent(in) :: old, new
      type(c_ptr) :: from, to
      integer(c_size_t) :: copied
      ok = .false.
      from = c_fopen(old//c_null_char, 'rb'//c_null_char)
      if (.not. c_associated(from)) return
      to = c_fopen(new//c_null_char, 'wb'//c_null_char)
      if (c_associated(to)) then
         copied = 1
         do while (copied > 0)
            copied = c_sendfile(c_fileno(to), c_fileno(from), c_null_ptr, copy_bytes)
         end do
         ok = c_fclose(to) == 0 .and. copied == 0
      end if
      copied = c_fclose(from)
   end function copy_file

   !> Has a file (or folder: the names in it) written to the disk itself; ok is false if that failed.
   logical function sync_file(path) result(ok)
      character(len=*), intent(in) :: path
      type(c_ptr) :: stream
      integer(c_int) :: ignored
      stream = c_fopen(path//c_null_char, 'rb'//c_null_char)
      ok = c_associated(stream)
      if (.not. ok) return
      ok = c_fsync(c_fileno(stream)) == 0
      ignored = c_fclose(stream)
   end function sync_file

   !> Has the system begin to write a file to the disk, so that there is less to wait for in `sync_file`.
   subroutine begin_sync(path)
      character(len=*), intent(in) :: path
      type(c_ptr) :: stream
      integer(c_int) :: ignored
      stream = c_fopen(path//c_null_char, 'rb'//c_null_char)
      if (.not. c_associated(stream)) return
      ignored = c_sync_file_range(c_fileno(stream), 0_c_long, 0_c_long, sync_write)
      ignored = c_fclose(stream)
   end subroutine begin_sync

   !> Name of this machine.
   function host_name()
      character(len=:), allocatable :: host_name
      character(kind=c_char), target :: buffer(path_max)
      host_name = 'unknown'
      if (c_gethostname(buffer, int(path_max, c_size_t)) == 0) host_name = fortran_text(c_loc(buffer))
   end function host_name

   !> False where no process of this number runs on this machine.
   logical function process_alive(process)
      integer, intent(in) :: process
      process_alive = .true.
      if (c_kill(int(process, c_int), 0_c_int) /= 0) process_alive = error_number() /= no_process
   end function process_alive

   !> Does nothing for so many seconds, or until a signal comes.
   subroutine pause_seconds(seconds)
      integer, intent(in) :: seconds
      integer(c_int) :: ignored
      ignored = c_nanosleep([int(seconds, c_long), 0_c_long], c_null_ptr)
   end subroutine pause_seconds

   !> Sets an environment variable that is not set yet.
   subroutine set_environment(name, value)
      character(len=*), intent(in) :: name, value
      integer(c_int) :: ignored
      ignored = c_setenv(name//c_null_char, value//c_null_char, 0_c_int)
   end subroutine set_environment

   !> The path without links; where nothing is there, that at which the links end.
   function real_path(path)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: real_path, target
      character(kind=c_char), target :: buffer(path_max)
      integer :: i
      real_path = path
      do i = 1, most_links
         if (c_associated(c_realpath(real_path//c_null_char, buffer))) then
            real_path = fortran_text(c_loc(buffer))
            return
         end if
         buffer = c_null_char
         if (c_readlink(real_path//c_null_char, buffer, int(path_max - 1, c_size_t)) < 1) return
         target = fortran_text(c_loc(buffer))
         if (target(1:1) /= '/') target = real_path(:index(real_path, '/', back=.true.))//target
         real_path = target
      end do
   end function real_path

   !> True for an ordinary file, false for folders, devices, pipes and where nothing is there.
   logical function is_regular(path)
      character(len=*), intent(in) :: path
      integer(c_int16_t) :: buffer(statx_shorts)
      is_regular = .false.
      if (c_statx(at_fdcwd, path//c_null_char, 0_c_int, statx_type, buffer) /= 0) return
      is_regular = iand(int(buffer(mode_at)), type_mask) == type_regular
   end function is_regular

   !> A file that grows past the limit of the shell then fails in writing, instead of ending the program.
   subroutine keep_file_size_quiet()
      type(c_funptr) :: ignored
      ignored = c_signal(sigxfsz, 1_c_intptr_t)
   end subroutine keep_file_size_quiet

   !> Writes text to standard output; ok is false if not all of it could be written, which Fortran's own
   !> output does not tell.
   logical function write_output(text) result(ok)
      character(len=*), intent(in) :: text
      integer(c_size_t) :: done, now
      flush (output_unit)
      done = 0
      do while (done < len(text))
         now = c_write(1_c_int, text(done + 1:), len(text, c_size_t) - done)
         if (now <= 0) exit
         done = done + now
      end do
      ok = done == len(text)
   end function write_output

   !> True where standard output is a terminal.
   logical function is_terminal()
      is_terminal = c_isatty(1_c_int) == 1
   end function is_terminal
end module posix
