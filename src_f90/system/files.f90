!> What the system does with files that Fortran has no statement for. The functions are true where they succeeded.
module files
   use, intrinsic :: iso_c_binding, only: c_bool, c_char, c_int, c_long, c_ptr
   use system_texts, only: fortran_text, system_reason
   implicit none (type, external)
   private
   public :: rename_file, exchange_files, delete_file, create_file, copy_file, sync_file, begin_sync
   public :: block_names, take_mode, is_writable, is_readable
   public :: real_path, is_regular, file_identity, untold, make_folder, remove_folder, other_number

   !> Stands for the identity that the system does not tell.
   character(len=*), parameter :: untold = '?'

   interface
      !> Renames a file at once, replacing one of the new name.
      logical(c_bool) function rename_file(old, new) bind(c, name='tiltpad_rename')
         import :: c_bool, c_char
         character(kind=c_char, len=*), intent(in) :: old, new
      end function rename_file

      !> Deletes a file if it is there.
      subroutine delete_file(path) bind(c, name='tiltpad_delete')
         import :: c_char
         character(kind=c_char, len=*), intent(in) :: path
      end subroutine delete_file

      !> Exchanges the names of two files at once, where the file system can.
      logical(c_bool) function exchange_files(one, other) bind(c, name='tiltpad_exchange')
         import :: c_bool, c_char
         character(kind=c_char, len=*), intent(in) :: one, other
      end function exchange_files

      !> Makes an empty file; nothing may have its name.
      logical(c_bool) function create_file(path) bind(c, name='tiltpad_create')
         import :: c_bool, c_char
         character(kind=c_char, len=*), intent(in) :: path
      end function create_file

      !> Gives a file the permissions of another, where that is there.
      subroutine take_mode(from, path) bind(c, name='tiltpad_take_mode')
         import :: c_char
         character(kind=c_char, len=*), intent(in) :: from, path
      end subroutine take_mode

      !> Whether this user may write a file that is there.
      logical(c_bool) function is_writable(path) bind(c, name='tiltpad_is_writable')
         import :: c_bool, c_char
         character(kind=c_char, len=*), intent(in) :: path
      end function is_writable

      !> Whether the system lets an ordinary file be read.
      logical(c_bool) function is_readable(path) bind(c, name='tiltpad_is_readable')
         import :: c_bool, c_char
         character(kind=c_char, len=*), intent(in) :: path
      end function is_readable

      !> Copies a file into another that is there.
      logical(c_bool) function copy_file(old, new) bind(c, name='tiltpad_copy')
         import :: c_bool, c_char
         character(kind=c_char, len=*), intent(in) :: old, new
      end function copy_file

      !> Has a file (or folder: the names in it) written to the disk itself.
      logical(c_bool) function sync_file(path) bind(c, name='tiltpad_sync')
         import :: c_bool, c_char
         character(kind=c_char, len=*), intent(in) :: path
      end function sync_file

      !> Has the system begin to write a file to the disk, so that there is less to wait for in `sync_file`.
      subroutine begin_sync(path) bind(c, name='tiltpad_begin_sync')
         import :: c_char
         character(kind=c_char, len=*), intent(in) :: path
      end subroutine begin_sync

      !> True for an ordinary file, false for folders, devices, pipes and where nothing is there.
      logical(c_bool) function is_regular(path) bind(c, name='tiltpad_is_regular')
         import :: c_bool, c_char
         character(kind=c_char, len=*), intent(in) :: path
      end function is_regular

      !> Removes an empty folder, if it is there.
      subroutine remove_folder(path) bind(c, name='tiltpad_remove_folder')
         import :: c_char
         character(kind=c_char, len=*), intent(in) :: path
      end subroutine remove_folder

      type(c_ptr) function c_identity(path) bind(c, name='tiltpad_identity')
         import :: c_char, c_ptr
         character(kind=c_char, len=*), intent(in) :: path
      end function c_identity

      type(c_ptr) function c_real_path(path) bind(c, name='tiltpad_real_path')
         import :: c_char, c_ptr
         character(kind=c_char, len=*), intent(in) :: path
      end function c_real_path

      logical(c_bool) function c_make_folder(path) bind(c, name='tiltpad_make_folder')
         import :: c_bool, c_char
         character(kind=c_char, len=*), intent(in) :: path
      end function c_make_folder

      type(c_ptr) function c_other_number(folder, digits, last) bind(c, name='tiltpad_other_number')
         import :: c_char, c_int, c_long, c_ptr
         character(kind=c_char, len=*), intent(in) :: folder
         integer(c_int), value :: digits
         integer(c_long), value :: last
      end function c_other_number

      type(c_ptr) function c_block_names(path, ending) bind(c, name='tiltpad_block_names')
         import :: c_char, c_ptr
         character(kind=c_char, len=*), intent(in) :: path, ending
      end function c_block_names
   end interface

contains

   !> Tells the file of this name from every other of its folder, later ones too: "inode:birth", with birth 0 where the
   !> file system does not know it. Empty where there is nothing, "-" for what is no ordinary file, `untold`
   !> where the system gives a reason for not saying; links are not followed.
   function file_identity(path) result(identity)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: identity
      identity = fortran_text(c_identity(path))
   end function file_identity

   !> The path without links; where nothing is there, that at which the links end.
   function real_path(path)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: real_path
      real_path = fortran_text(c_real_path(path))
   end function real_path

   !> Makes a folder unless something of its name is there; `refusal` is the system's reason, empty if all is well.
   subroutine make_folder(path, refusal)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: refusal
      refusal = ''
      if (.not. c_make_folder(path)) refusal = system_reason()
   end subroutine make_folder

   !> A name in a folder that is a number with '.h5', but not one from 1 to `last` with this number of digits; empty
   !> where there is none.
   function other_number(folder, digits, last) result(name)
      character(len=*), intent(in) :: folder
      integer, intent(in) :: digits, last
      character(len=:), allocatable :: name
      name = fortran_text(c_other_number(folder, int(digits, c_int), int(last, c_long)))
   end function other_number

   !> The names in its folder that are the path's with ".IofN" and an ending, in order, each with a slash behind it.
   function block_names(path, ending) result(names)
      character(len=*), intent(in) :: path, ending
      character(len=:), allocatable :: names
      names = fortran_text(c_block_names(path, ending))
   end function block_names
end module files
