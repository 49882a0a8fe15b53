!> A lock that keeps a second writer off a file: a file NAME.lock beside it that is locked (fcntl) and says who
!> holds it: "host process heartbeats", and the identities of the files that the holder has made beside it.
!>
!> The system frees the lock of a process that ended, however it ended. Whether locks reach across machines depends
!> on the file system (NFS 4: yes; Lustre, BeeGFS: as mounted; some: not at all). A holder therefore counts
!> heartbeats in the file while it runs; if those of one on another machine stand still, it is taken for dead.
!>
!> Only a lock file is opened for writing or deleted: an ordinary file with one name that says the above, or nothing,
!> as the fall of a machine can leave it.
module file_lock
   use, intrinsic :: iso_c_binding, only: c_bool, c_char, c_int
   use text, only: to_text
   use errors, only: error_type, raise, system_error, stopped
   use stop_signals, only: stop_requested, stop_reason
   use files, only: delete_file
   use processes, only: host_name, pause_seconds, process_alive, process_id
   use system_texts, only: system_reason
   implicit none (type, external)
   private
   public :: file_lock_type

   !> Seconds from one heartbeat of a living holder to the next.
   integer, parameter :: heartbeat_seconds = 10
   !> Characters of a lock file.
   integer, parameter :: longest = 300
   !> What an attempt found; `foreign`: something else has the name of the lock file.
   integer, parameter :: free = 0, held = 1, unknown = 2, failed = 3, foreign = 4

   type :: file_lock_type
      private
      character(len=:), allocatable :: path
      !> Of the open lock file; negative where it is not open.
      integer(c_int) :: descriptor = -1
      integer :: heartbeats = 0, last_heartbeat = 0
      !> Seconds for which a holder on another machine is watched where its lock is free or locks are not known
      !> here, and where its lock is held (a dead NFS client's is freed after 90 s).
      integer, public :: watch_free = 3*heartbeat_seconds, watch_held = 120
      !> The dead process whose lock was taken, "process 12 on node1"; empty where there was none.
      character(len=:), allocatable, public :: taken_from
      !> Who has the lock where it was refused for that; else empty.
      character(len=:), allocatable, public :: held_by
      !> Identities of the files that the dead process had made and not deleted, separated by blanks.
      character(len=:), allocatable, public :: files_left
      character(len=:), allocatable :: files
   contains
      procedure :: acquire
      !> Notes the identities of the files that the holder has made, separated by blanks.
      procedure :: note_files
      !> Shows that the holder lives; to be called often.
      procedure :: heartbeat
      procedure :: release
      procedure :: is_ours
   end type file_lock_type

   interface
      !> -1 where it cannot be opened or made, -2 where the name is another thing's.
      integer(c_int) function open_lock(path) bind(c, name='tiltpad_open_lock')
         import :: c_char, c_int
         character(kind=c_char, len=*), intent(in) :: path
      end function open_lock

      !> One of `free`, `held`, `unknown`.
      integer(c_int) function try_lock(descriptor) bind(c, name='tiltpad_try_lock')
         import :: c_int
         integer(c_int), value :: descriptor
      end function try_lock

      logical(c_bool) function has_name(descriptor, path) bind(c, name='tiltpad_has_name')
         import :: c_bool, c_char, c_int
         integer(c_int), value :: descriptor
         character(kind=c_char, len=*), intent(in) :: path
      end function has_name

      !> Characters read of a text as long as there is room; negative after a failure.
      integer(c_int) function read_start(descriptor, text) bind(c, name='tiltpad_read_start')
         import :: c_char, c_int
         integer(c_int), value :: descriptor
         ! allow(C072)
         character(kind=c_char, len=*), intent(inout) :: text
      end function read_start

      logical(c_bool) function write_start(descriptor, text) bind(c, name='tiltpad_write_start')
         import :: c_bool, c_char, c_int
         integer(c_int), value :: descriptor
         character(kind=c_char, len=*), intent(in) :: text
      end function write_start

      integer(c_int) function c_close(descriptor) bind(c, name='close')
         import :: c_int
         integer(c_int), value :: descriptor
      end function c_close
   end interface

contains

   !> Locks the file of this path (which need not be there), or says who has it. A holder on another machine is
   !> watched for up to two minutes where the file system cannot tell whether it lives.
   subroutine acquire(self, path, error)
      class(file_lock_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: holder, first
      integer :: found, waited, watched
      self%path = path//'.lock'
      self%taken_from = ''
      self%held_by = ''
      self%files_left = ''
      self%files = ''
      waited = 0
      do
         call attempt(self, found, holder)
         if (found == failed) then
            call raise(error, system_error, 'cannot write '//path//': '//no_lock_reason(path))
         else if (found == foreign) then
            call raise(error, system_error, 'cannot write '//path//': '//self%path &
               & //' is no lock file of tiltpad; remove or rename it')
         end if
         if (allocated(error)) return
         if (waited == 0) first = holder
         watched = watch_time(self, found, holder)
         if (found /= held .and. waited >= watched) exit
         call close_lock(self)
         if (holder /= first .or. waited >= watched) then
            self%held_by = described(holder)
            call raise(error, system_error, 'cannot write '//path//': '//self%held_by//' is writing it')
            return
         end if
         ! opened anew each time, as network file systems look anew only then
         call pause_seconds(1)
         if (stop_requested()) then
            call raise(error, stopped, path//': '//stop_reason()//' before it started')
            return
         end if
         waited = waited + 1
      end do
      if (holder /= '') then
         self%taken_from = described(holder)
         self%files_left = from_word(holder, 4)
         ! the lock says so until there are files of ours
         self%files = self%files_left
      end if
      self%heartbeats = 0
      if (.not. write_heartbeat(self)) then
         call delete_file(self%path)
         call close_lock(self)
         call raise(error, system_error, 'cannot write '//path//': '//no_lock_reason(path))
      end if
   end subroutine acquire

   !> Why a lock file could not be made or written just now.
   function no_lock_reason(path) result(reason)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: reason, folder
      logical :: exists
      reason = 'its lock file, '//path//'.lock, cannot be made: '//system_reason()
      folder = path(:index(path, '/', back=.true.))
      if (folder == '') return
      inquire (file=folder//'.', exist=exists)
      if (.not. exists) reason = 'there is no folder '//folder
   end function no_lock_reason

   !> Seconds for which the holder's heartbeats are watched.
   integer function watch_time(self, found, holder) result(watched)
      class(file_lock_type), intent(in) :: self
      integer, intent(in) :: found
      character(len=*), intent(in) :: holder
      watched = merge(self%watch_held, self%watch_free, found == held)
      if (found /= held .and. holder == '') watched = 0
      if (index(holder, host_name()//' ') /= 1) return
      ! on this machine the system knows
      if (found == unknown) then
         if (process_alive(process_of(holder))) return
      end if
      watched = 0
   end function watch_time

   !> Opens the lock file and tries to lock it.
   subroutine attempt(self, found, holder)
      class(file_lock_type), intent(inout) :: self
      integer, intent(out) :: found
      !> What the file says.
      character(len=:), allocatable, intent(out) :: holder
      logical :: is_lock
      holder = ''
      do
         self%descriptor = open_lock(self%path)
         found = merge(failed, foreign, self%descriptor == -1)
         if (self%descriptor < 0) return
         found = try_lock(self%descriptor)
         ! its holder may have deleted it after we opened it
         if (is_there(self)) exit
         call close_lock(self)
      end do
      call read_content(self, holder, is_lock)
      if (is_lock) return
      call close_lock(self)
      found = foreign
   end subroutine attempt

   !> False where the open lock file has been deleted, renamed or replaced.
   logical function is_there(self)
      class(file_lock_type), intent(in) :: self
      is_there = has_name(self%descriptor, self%path)
   end function is_there

   !> The line in the open lock file, and whether it is what a lock file says: one line, which a fall of the machine may
   !> have cut among the blanks at its end, or nothing.
   subroutine read_content(self, line, is_lock)
      class(file_lock_type), intent(in) :: self
      character(len=:), allocatable, intent(out) :: line
      logical, intent(out) :: is_lock
      character(len=longest + 1) :: content
      integer :: length
      content = ''
      length = max(0, read_start(self%descriptor, content))
      line = ''
      ! nothing, or zeros in its place
      is_lock = length <= longest .and. verify(content(:length), achar(0)//achar(10)) == 0
      if (is_lock .or. length > longest) return
      if (verify(content(length:length), ' '//achar(10)) /= 0 .or. index(content(:length - 1), achar(10)) > 0) return
      line = trim(content(:length - 1))
      is_lock = is_whole(word(line, 2)) .and. is_whole(word(line, 3)) &
         & .and. verify(from_word(line, 4), '0123456789:. ') == 0
   end subroutine read_content

   pure logical function is_whole(text)
      character(len=*), intent(in) :: text
      is_whole = text /= '' .and. verify(text, '0123456789') == 0
   end function is_whole

   !> The rest of a line from its k-th word on; words are separated by single blanks.
   pure recursive function from_word(line, k) result(rest)
      character(len=*), intent(in) :: line
      integer, intent(in) :: k
      character(len=:), allocatable :: rest
      rest = line
      if (k > 1) rest = from_word(line(index(line//' ', ' ') + 1:), k - 1)
   end function from_word

   pure function word(line, k)
      character(len=*), intent(in) :: line
      integer, intent(in) :: k
      character(len=:), allocatable :: word
      word = from_word(line, k)
      word = word(:index(word//' ', ' ') - 1)
   end function word

   !> False once another process took this one for dead and took the lock, or deleted it: then this one must not write
   !> any more.
   logical function is_ours(self)
      class(file_lock_type), intent(in) :: self
      character(len=:), allocatable :: line
      is_ours = .false.
      if (self%descriptor < 0) return
      if (.not. is_there(self)) return
      call read_content(self, line, is_ours)
      if (is_ours) is_ours = index(line, identity()) == 1
   end function is_ours

   !> "host process ".
   function identity()
      character(len=:), allocatable :: identity
      identity = host_name()//' '//to_text(process_id())//' '
   end function identity

   !> Cheap: writes only every ten seconds. `now` is a clock, s.
   subroutine heartbeat(self, now)
      class(file_lock_type), intent(inout) :: self
      integer, intent(in) :: now
      logical :: ignored
      if (now - self%last_heartbeat < heartbeat_seconds) return
      if (.not. self%is_ours()) return
      self%last_heartbeat = now
      self%heartbeats = self%heartbeats + 1
      ignored = write_heartbeat(self)
   end subroutine heartbeat

   subroutine note_files(self, identities, noted)
      class(file_lock_type), intent(inout) :: self
      character(len=*), intent(in) :: identities
      logical, intent(out), optional :: noted
      logical :: ok
      ok = self%is_ours()
      if (ok) then
         self%files = trim(adjustl(identities))
         ok = write_heartbeat(self)
      end if
      if (present(noted)) noted = ok
   end subroutine note_files

   !> True if it could be written.
   logical function write_heartbeat(self) result(ok)
      class(file_lock_type), intent(in) :: self
      character(len=longest) :: line
      ! of one length, so that it replaces what is there and needs no room on the disk
      line = trim(identity()//to_text(self%heartbeats)//' '//self%files)
      line(longest:) = achar(10)
      ok = write_start(self%descriptor, line)
   end function write_heartbeat

   !> Frees the lock, and deletes its file if it is ours and no file that it notes is left.
   subroutine release(self, files_left)
      class(file_lock_type), intent(inout) :: self
      logical, intent(in), optional :: files_left
      logical :: delete
      delete = self%is_ours()
      if (present(files_left)) delete = delete .and. .not. files_left
      if (delete) call delete_file(self%path)
      if (self%descriptor < 0) return
      call close_lock(self)
   end subroutine release

   subroutine close_lock(self)
      class(file_lock_type), intent(inout) :: self
      integer(c_int) :: ignored
      ignored = c_close(self%descriptor)
      self%descriptor = -1
   end subroutine close_lock

   !> "node1 12 3" to "process 12 on node1".
   pure function described(holder)
      character(len=*), intent(in) :: holder
      character(len=:), allocatable :: described
      described = 'another process'
      if (holder /= '') described = 'process '//word(holder, 2)//' on '//word(holder, 1)
   end function described

   !> Its process number; 0 where it says none.
   pure integer function process_of(holder)
      character(len=*), intent(in) :: holder
      character(len=:), allocatable :: number
      integer :: status
      number = word(holder, 2)
      read (number, *, iostat=status) process_of
      if (status /= 0) process_of = 0
   end function process_of
end module file_lock
