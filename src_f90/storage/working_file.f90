!> A file that is written as NAME.part and renamed to NAME when it is whole, so that a crash at any moment leaves a
!> whole file under that name.
!>
!> A growing file is published again and again without copying all of it each time: there are two of them, and while
!> one bears the name, the other, NAME.part, is written. Publishing exchanges their names; the part then lacks only the
!> last stretch.
!>
!> Only files that this program has made are written, renamed or deleted. The lock file keeps their identities, so that
!> the next run recognises the part of a run that was killed, or could not rename or delete it. If NAME.part is
!> something else, it is left alone, and the part is NAME.part2, and so on.
module working_file
   use text, only: to_text
   use errors, only: error_type, raise, system_error
   use files, only: rename_file, exchange_files, delete_file, create_file, copy_file, sync_file, begin_sync, &
      & real_path, is_regular, is_writable, take_mode, file_identity, untold
   use system_texts, only: system_reason
   use file_lock, only: file_lock_type
   implicit none (type, external)
   private
   public :: working_file_type, clear_leftovers

   !> Names tried for the part.
   integer, parameter :: most_parts = 99
   !> Stands in the lock for the identity of a part that is about to be made.
   character(len=*), parameter :: about_to_be = '0'

   type :: working_file_type
      !> Name of the file, links followed, and the name under which it is written.
      character(len=:), allocatable :: path, part
      !> Identities of the two; empty where there is none.
      character(len=:), allocatable, private :: there, made
      !> True once this run has published; true where the part could not be renamed and is kept.
      logical :: published = .false., stranded = .false.
      type(file_lock_type) :: lock
      !> Clock of the last heartbeat, s.
      integer, private :: last_heartbeat = 0
   contains
      !> Locks the name; no other run writes under it until `release`.
      procedure :: claim
      !> Makes the part, an empty file of this run's.
      procedure :: make_part
      !> Makes the part a copy of the published file.
      procedure :: copy_published
      procedure :: publish
      !> Shows other programs that this one lives, and has the system begin to write the part to the disk; to be called
      !> often with a clock, s.
      procedure :: heartbeat
      !> Deletes the part if it is the one that this run has made.
      procedure :: drop_part => delete_part
      !> The same, and frees the lock, whose file stays where the part does.
      procedure :: release
      !> An error where the part must not be written any more; to be asked before it is opened.
      procedure :: check_part
   end type working_file_type

contains

   subroutine claim(self, path, error)
      class(working_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      logical :: exists
      ! a link is followed, so that its target is replaced and not the link
      self%path = real_path(path)
      inquire (file=self%path//'/.', exist=exists)
      if (.not. exists) inquire (file=self%path, exist=exists)
      if (exists .and. .not. is_regular(self%path)) then
         call raise(error, system_error, 'cannot write '//path//': it is a directory, device or pipe')
      else if (exists .and. .not. is_writable(self%path)) then
         call raise(error, system_error, 'cannot write '//path//': '//system_reason())
      end if
      if (allocated(error)) return
      call self%lock%acquire(self%path, error)
      if (allocated(error)) return
      call choose_part(self, error)
      if (allocated(error)) then
         call self%lock%release(files_left=.true.)
         return
      end if
      call identify(self%path, self%there, error)
      if (allocated(error)) call self%lock%release()
   end subroutine claim

   !> Deletes what a run that was killed has left beside a complete file, unless somebody else may use it.
   subroutine clear_leftovers(path)
      character(len=*), intent(in) :: path
      type(working_file_type) :: work
      type(error_type), allocatable :: ignored
      logical :: exists
      inquire (file=real_path(path)//'.lock', exist=exists)
      if (.not. exists) return
      ! whoever holds it may still be there
      work%lock%watch_held = 0
      call work%claim(path, ignored)
      if (.not. allocated(ignored)) call work%release()
   end subroutine clear_leftovers

   !> The identity of a file, or the system's reason for not telling it.
   subroutine identify(path, identity, error)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: identity
      type(error_type), allocatable, intent(out) :: error
      identity = file_identity(path)
      if (identity == untold) call raise(error, system_error, 'cannot write '//path//': the system does not say ' &
         & //'which file it is: '//system_reason())
   end subroutine identify

   !> The first name of a part that is free, once the parts of a dead run are deleted.
   subroutine choose_part(self, error)
      class(working_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: found
      logical :: left
      integer :: k, length
      self%made = ''
      do k = 1, most_parts
         self%part = self%path//'.part'
         if (k > 1) self%part = self%part//to_text(k)
         found = file_identity(self%part)
         if (found == '') return
         left = among(found, self%lock%files_left)
         ! noted where its time of birth was not known
         if (.not. left) left = among(found(:index(found, ':'))//'0.0', self%lock%files_left)
         inquire (file=self%part, size=length)
         if (length == 0 .and. found /= '-') left = left .or. among(about_to_be, self%lock%files_left)
         if (.not. left) cycle
         call delete_file(self%part)
         if (file_identity(self%part) /= '') call raise(error, system_error, 'cannot write '//self%path//': ' &
            & //self%part//', which a killed run has left, cannot be deleted: '//system_reason())
         return
      end do
   end subroutine choose_part

   !> True where a list, separated by blanks, has this word.
   pure logical function among(word, list)
      character(len=*), intent(in) :: word, list
      among = index(' '//list//' ', ' '//word//' ') > 0
   end function among

   subroutine make_part(self, error)
      class(working_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: lost
      character(len=:), allocatable :: published
      logical :: noted
      ! what this run has published becomes the part when the names are exchanged
      published = ''
      if (self%published) published = ' '//self%there
      call check_lock(self, error)
      if (allocated(error)) return
      call self%lock%note_files(about_to_be//published, noted)
      if (.not. noted) then
         call raise(error, system_error, 'cannot write '//self%path//': its lock cannot be written: '//system_reason())
         return
      end if
      if (.not. create_file(self%part)) then
         call raise(error, system_error, 'cannot write '//self%part//': '//system_reason())
         return
      end if
      call take_mode(self%path, self%part)
      call identify(self%part, self%made, error)
      if (allocated(error)) then
         self%made = ''
         call check_lock(self, lost)
         if (.not. allocated(lost)) call delete_file(self%part)
         return
      end if
      call self%lock%note_files(self%made//published)
      ! it may have stood still for long at any of these lines
      call self%check_part(error)
      if (allocated(error)) call delete_part(self)
   end subroutine make_part

   !> An error once another run has taken this one for dead, or the folder is gone.
   subroutine check_lock(self, error)
      class(working_file_type), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      if (.not. self%lock%is_ours()) call raise(error, system_error, 'cannot write '//self%path &
         & //': its lock is gone, to another run or with its folder')
   end subroutine check_lock

   !> The same, and where the part is no longer what this run has made.
   subroutine check_part(self, error)
      class(working_file_type), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: found
      call check_lock(self, error)
      if (.not. allocated(error)) call identify(self%part, found, error)
      if (allocated(error)) return
      if (found /= self%made) call raise(error, system_error, 'cannot write '//self%path//': ' &
         & //self%part//' was removed or replaced by something else')
   end subroutine check_part

   subroutine copy_published(self, error)
      class(working_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      ! a new file under the name: a reader may still have the old one open
      call delete_part(self)
      call self%make_part(error)
      if (allocated(error)) return
      if (.not. copy_file(self%path, self%part)) call raise(error, system_error, &
         & 'cannot write '//self%part//': '//system_reason())
   end subroutine copy_published

   !> Gives the closed part the file's name, safe on disk. `exchanged` tells whether the part is now what this run
   !> published before; otherwise there is no part.
   subroutine publish(self, exchanged, error)
      class(working_file_type), intent(inout) :: self
      logical, intent(out) :: exchanged
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: found, made, reason
      logical :: ok
      exchanged = .false.
      reason = ''
      if (.not. sync_file(self%part)) reason = system_reason()
      ! a run that takes over takes the lock first and the name then: asked the other way round
      call identify(self%path, found, error)
      if (.not. allocated(error)) call self%check_part(error)
      if (.not. allocated(error) .and. reason /= '') call raise(error, system_error, 'cannot write '//self%path//': ' &
         & //reason)
      if (allocated(error)) return
      if (found /= '' .and. found /= self%there) then
         self%stranded = .true.
         call raise(error, system_error, 'cannot rename '//self%part//', which is whole, to '//self%path &
            & //': something else has been put there')
         return
      end if
      made = self%made
      if (self%published) exchanged = exchange_files(self%part, self%path)
      if (exchanged) then
         self%made = self%there
      else if (rename_file(self%part, self%path)) then
         self%made = ''
      else
         self%stranded = .true.
         call raise(error, system_error, 'cannot rename '//self%part//', which is whole, to '//self%path//': ' &
            & //system_reason())
         return
      end if
      self%there = made
      self%published = .true.
      ! the renaming itself; where a file system cannot, nothing is lost that could be kept
      ok = sync_file(self%path(:index(self%path, '/', back=.true.))//'.')
   end subroutine publish

   subroutine heartbeat(self, now)
      class(working_file_type), intent(inout) :: self
      integer, intent(in) :: now
      if (now == self%last_heartbeat) return
      self%last_heartbeat = now
      call self%lock%heartbeat(now)
      call begin_sync(self%part)
   end subroutine heartbeat

   !> What stays stays in the lock.
   subroutine delete_part(self)
      class(working_file_type), intent(inout) :: self
      character(len=:), allocatable :: found
      if (self%made == '') return
      if (file_identity(self%part) == self%made) call delete_file(self%part)
      found = file_identity(self%part)
      if (found /= self%made .and. found /= untold) self%made = ''
   end subroutine delete_part

   subroutine release(self)
      class(working_file_type), intent(inout) :: self
      ! without the lock it may be another's
      if (.not. self%stranded) then
         if (self%lock%is_ours()) call delete_part(self)
      end if
      if (self%made /= '') call self%lock%note_files(self%made)
      call self%lock%release(files_left=self%made /= '')
      self%made = ''
   end subroutine release
end module working_file
