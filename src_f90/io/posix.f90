!> The few things the system does for us that Fortran has no word for.
module posix
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_funptr, c_int, c_int16_t, c_intptr_t, &
      & c_null_char, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only: output_unit
   implicit none (type, external)
   private
   public :: rename_file, delete_file, real_path, is_regular, process_id, is_terminal, write_output
   public :: keep_file_size_quiet

   !> Longest path, and Linux' numbers for statx and for the signal of a file grown too large.
   integer, parameter :: path_max = 4096
   integer(c_int), parameter :: at_fdcwd = -100, statx_type = 1, sigxfsz = 25
   !> Shorts in struct statx; the one that holds the mode; file type in it, and that of regular files.
   integer, parameter :: statx_shorts = 128, mode_at = 15
   integer, parameter :: type_mask = int(o'170000'), type_regular = int(o'100000')

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

   !> The path without links; as it is where nothing is there.
   function real_path(path)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: real_path
      character(kind=c_char) :: buffer(path_max)
      integer :: i, length
      real_path = path
      if (.not. c_associated(c_realpath(path//c_null_char, buffer))) return
      length = findloc(buffer, c_null_char, dim=1) - 1
      real_path = repeat(' ', length)
      do i = 1, length
         real_path(i:i) = buffer(i)
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
