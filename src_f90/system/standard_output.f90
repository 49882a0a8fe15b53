!> Standard output, as the system sees it.
module standard_output
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_size_t
   use, intrinsic :: iso_fortran_env, only: output_unit
   implicit none (type, external)
   private
   public :: is_terminal, write_output

   !> Its descriptor.
   integer(c_int), parameter :: descriptor = 1

   interface
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

   !> True where it is a terminal.
   logical function is_terminal()
      is_terminal = c_isatty(descriptor) == 1
   end function is_terminal

   !> Writes text; ok is false if not all of it could be written, which Fortran's own output does not tell.
   logical function write_output(text) result(ok)
      character(len=*), intent(in) :: text
      integer(c_size_t) :: done, now
      flush (output_unit)
      done = 0
      do while (done < len(text))
         now = c_write(descriptor, text(done + 1:), len(text, c_size_t) - done)
         if (now <= 0) exit
         done = done + now
      end do
      ok = done == len(text)
   end function write_output
end module standard_output
