!> A file that is written as NAME.part and renamed to NAME when it is whole, so that a crash at any moment leaves a
!> whole file under that name.
!>
!> A growing file is published again and again without copying all of it each time: there are two of them, and while
!> one bears the name, the other, NAME.part, is written. Publishing exchanges their names; the part then lacks only the
!> last stretch.
module working_file
   use errors, only: error_type, raise, system_error
   use files, only: rename_file, link_file, delete_file, copy_file, sync_file, begin_sync, real_path, is_regular
   use system_errors, only: system_reason
   use file_lock, only: file_lock_type
   implicit none (type, external)
   private
   public :: working_file_type

   type :: working_file_type
      !> Name of the file, links followed, and the name under which it is written.
      character(len=:), allocatable :: path, part
      !> True once this run has published; true where the part could not be renamed and is kept.
      logical :: published = .false., stranded = .false.
      type(file_lock_type) :: lock
   contains
      !> Locks the name; no other run writes under it until `release`.
      procedure :: claim
      !> Makes the part a copy of the published file.
      procedure :: copy_published
      procedure :: publish
      !> Has the system begin to write the part to the disk.
      procedure :: begin_sync => begin_part
      !> Deletes the part; frees the lock.
      procedure :: release
   end type working_file_type

contains

   subroutine claim(self, path, error)
      class(working_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      logical :: exists
      ! a link is followed, so that its target is replaced and not the link
      self%path = real_path(path)
      self%part = self%path//'.part'
      inquire (file=self%path//'/.', exist=exists)
      if (.not. exists) inquire (file=self%path, exist=exists)
      if (exists) exists = .not. is_regular(self%path)
      if (exists) then
         call raise(error, system_error, 'cannot write '//path//': it is a directory, device or pipe')
         return
      end if
      call self%lock%acquire(self%path, error)
   end subroutine claim

   subroutine copy_published(self, error)
      class(working_file_type), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      ! a new file under the name: a reader may still have the old one open
      call delete_file(self%part)
      if (.not. copy_file(self%path, self%part)) call raise(error, system_error, &
         & 'cannot write '//self%part//': '//system_reason())
   end subroutine copy_published

   !> Gives the closed part the file's name, safe on disk. `exchanged` tells whether the part is now what this run
   !> published before; otherwise there is no part.
   subroutine publish(self, exchanged, error)
      class(working_file_type), intent(inout) :: self
      logical, intent(out) :: exchanged
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: spare
      logical :: ok
      exchanged = .false.
      if (.not. self%lock%is_ours()) then
         call raise(error, system_error, 'cannot write '//self%path &
            & //': its lock is gone, to another run or with its folder')
         return
      end if
      spare = self%path//'.old'
      ok = sync_file(self%part)
      if (ok .and. self%published) then
         call delete_file(spare)
         exchanged = link_file(self%path, spare)
      end if
      if (.not. ok) then
         call raise(error, system_error, 'cannot write '//self%path//': '//system_reason())
         return
      end if
      if (.not. rename_file(self%part, self%path)) then
         self%stranded = .true.
         call raise(error, system_error, 'cannot rename '//self%part//', which is whole, to '//self%path//': ' &
            & //system_reason())
         return
      end if
      if (exchanged) exchanged = rename_file(spare, self%part)
      self%published = .true.
      ! the renaming itself; where a file system cannot, nothing is lost that could be kept
      ok = sync_file(self%path(:index(self%path, '/', back=.true.))//'.')
   end subroutine publish

   subroutine begin_part(self)
      class(working_file_type), intent(in) :: self
      call begin_sync(self%part)
   end subroutine begin_part

   subroutine release(self)
      class(working_file_type), intent(inout) :: self
      ! without the lock they may be another's
      if (.not. self%lock%is_ours()) then
         call self%lock%release()
         return
      end if
      if (.not. self%stranded) call delete_file(self%part)
      call delete_file(self%path//'.old')
      call self%lock%release()
   end subroutine release
end module working_file
