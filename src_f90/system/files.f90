!> What the system does with files that Fortran has no statement for.
module files
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_loc, c_null_char, c_size_t
   use c_strings, only: fortran_text
   implicit none (type, external)
   private
   public :: rename_file, exchange_files, delete_file, create_file, copy_file, sync_file, begin_sync, &
      & real_path, is_regular
   public :: file_identity

   !> Room for a path.
   integer, parameter :: path_length = 4096
   !> Links that may follow one another.
   integer, parameter :: most_links = 40
   !> Most characters of an identity.
   integer, parameter :: identity_length = 60

   interface
      integer(c_int) function c_rename(old, new) bind(c, name='rename')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: old(*), new(*)
      end function c_rename

      integer(c_int) function c_unlink(path) bind(c, name='unlink')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_unlink

      integer(c_int) function c_exchange(one, other) bind(c, name='tiltpad_exchange')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: one(*), other(*)
      end function c_exchange

      subroutine c_identity(path, identity, length) bind(c, name='tiltpad_identity')
         import :: c_char, c_size_t, identity_length
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(inout) :: identity(identity_length + 1)
         integer(c_size_t), value :: length
      end subroutine c_identity

      integer(c_size_t) function c_readlink(path, target, length) bind(c, name='readlink')
         import :: c_char, c_size_t, path_length
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(inout) :: target(path_length)
         integer(c_size_t), value :: length
      end function c_readlink

      integer(c_int) function c_real_path(path, resolved, length) bind(c, name='tiltpad_real_path')
         import :: c_char, c_int, c_size_t, path_length
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(inout) :: resolved(path_length)
         integer(c_size_t), value :: length
      end function c_real_path

      integer(c_int) function c_is_regular(path) bind(c, name='tiltpad_is_regular')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_is_regular

      integer(c_int) function c_create(path) bind(c, name='tiltpad_create')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_create

      integer(c_int) function c_copy(old, new) bind(c, name='tiltpad_copy')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: old(*), new(*)
      end function c_copy

      integer(c_int) function c_sync(path) bind(c, name='tiltpad_sync')
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_sync

      subroutine c_begin_sync(path) bind(c, name='tiltpad_begin_sync')
         import :: c_char
         character(kind=c_char), intent(in) :: path(*)
      end subroutine c_begin_sync
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

   !> Exchanges the names of two files at once; ok is false where the file system cannot.
   logical function exchange_files(one, other) result(ok)
      character(len=*), intent(in) :: one, other
      ok = c_exchange(one//c_null_char, other//c_null_char) == 1
   end function exchange_files

   !> Tells the file of this name from every other of its folder, later ones too: "inode:birth", with birth 0 where the
   !> file system does not know it. Empty where there is nothing, "-" for what is no ordinary file; links are not
   !> followed.
   function file_identity(path) result(identity)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: identity
      character(kind=c_char), target :: buffer(identity_length + 1)
      call c_identity(path//c_null_char, buffer, size(buffer, kind=c_size_t))
      identity = fortran_text(c_loc(buffer))
   end function file_identity

   !> Makes an empty file; ok is false if something has its name, or it cannot be made.
   logical function create_file(path) result(ok)
      character(len=*), intent(in) :: path
      ok = c_create(path//c_null_char) == 1
   end function create_file

   !> Copies a file into another that is there; ok is false if it is not, or not all could be copied.
   logical function copy_file(old, new) result(ok)
      character(len=*), intent(in) :: old, new
      ok = c_copy(old//c_null_char, new//c_null_char) == 1
   end function copy_file

   !> Has a file (or folder: the names in it) written to the disk itself; ok is false if that failed.
   logical function sync_file(path) result(ok)
      character(len=*), intent(in) :: path
      ok = c_sync(path//c_null_char) == 1
   end function sync_file

   !> Has the system begin to write a file to the disk, so that there is less to wait for in `sync_file`.
   subroutine begin_sync(path)
      character(len=*), intent(in) :: path
      call c_begin_sync(path//c_null_char)
   end subroutine begin_sync

   !> The path without links; where nothing is there, that at which the links end.
   function real_path(path)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: real_path, target
      character(kind=c_char), target :: buffer(path_length)
      integer :: i
      real_path = path
      do i = 1, most_links
         if (c_real_path(real_path//c_null_char, buffer, int(path_length, c_size_t)) == 1) then
            real_path = fortran_text(c_loc(buffer))
            return
         end if
         buffer = c_null_char
         if (c_readlink(real_path//c_null_char, buffer, int(path_length - 1, c_size_t)) < 1) return
         target = fortran_text(c_loc(buffer))
         if (target(1:1) /= '/') target = real_path(:index(real_path, '/', back=.true.))//target
         real_path = target
      end do
   end function real_path

   !> True for an ordinary file, false for folders, devices, pipes and where nothing is there.
   logical function is_regular(path)
      character(len=*), intent(in) :: path
      is_regular = c_is_regular(path//c_null_char) == 1
   end function is_regular
end module files
