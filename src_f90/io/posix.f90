!> The few things the system does for us that Fortran has no word for.
module posix
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
   implicit none (type, external)
   private
   public :: rename_file, delete_file, process_id, is_terminal

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

   !> True where standard output is a terminal.
   logical function is_terminal()
      is_terminal = c_isatty(1_c_int) == 1
   end function is_terminal
end module posix
