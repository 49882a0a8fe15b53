!> A log: a file of frames, to which frames are added at its end alone. Each has its length and a checksum, so that what
!> was cut off or damaged is recognised, and nothing is lost but that. A frame: its kind, a letter, 4 bytes; the
!> checksum of kind and contents (CRC-32), 4 bytes; the length of the contents, 8 bytes; its contents.
module frame_log
   use, intrinsic :: iso_c_binding, only: c_bool, c_char, c_int, c_int32_t, c_long
   use kinds, only: i8
   use errors, only: error_type, raise, system_error
   use files, only: create_file, rename_file
   use system_texts, only: system_reason
   implicit none (type, external)
   private
   public :: frame_log_type, is_log

   !> What a log begins with, and bytes before the contents of a frame.
   character(len=*), parameter :: beginning = 'tiltpad log 1'//achar(10)
   integer, parameter :: head = 16
   !> Bytes of a frame; only a damaged one says more.
   integer(i8), parameter :: longest = 2_i8**30

   type :: frame_log_type
      character(len=:), allocatable :: path
      integer(c_int), private :: file = -1
      !> Bytes of the log: behind the last whole frame.
      integer(i8) :: ends = 0
   contains
      !> A new log, whose name nothing may have.
      procedure :: create
      !> An existing one, to be read from its beginning.
      procedure :: open => open_log
      procedure :: append
      procedure :: first
      procedure :: next
      !> Bytes of the file.
      procedure :: bytes
      procedure :: sync
      procedure :: rename
      procedure :: close => close_log
   end type frame_log_type

   interface
      !> The system's number of a file that is opened; negative where it cannot be.
      integer(c_int) function open_file(path, writing) bind(c, name='tiltpad_open')
         import :: c_bool, c_char, c_int
         character(kind=c_char, len=*), intent(in) :: path
         logical(c_bool), value :: writing
      end function open_file

      integer(c_long) function size_of(file) bind(c, name='tiltpad_size')
         import :: c_int, c_long
         integer(c_int), value :: file
      end function size_of

      !> All of it, or nothing: what was written of it is cut off.
      logical(c_bool) function write_at(file, bytes, place) bind(c, name='tiltpad_write_at')
         import :: c_bool, c_char, c_int, c_long
         integer(c_int), value :: file
         character(kind=c_char, len=*), intent(in) :: bytes
         integer(c_long), value :: place
      end function write_at

      logical(c_bool) function read_at(file, bytes, place) bind(c, name='tiltpad_read_at')
         import :: c_bool, c_char, c_int, c_long
         integer(c_int), value :: file
         ! allow(C072)
         character(kind=c_char, len=*), intent(inout) :: bytes
         integer(c_long), value :: place
      end function read_at

      integer(c_int32_t) function checksum(bytes, before) bind(c, name='tiltpad_crc32')
         import :: c_char, c_int32_t
         character(kind=c_char, len=*), intent(in) :: bytes
         integer(c_int32_t), value :: before
      end function checksum

      logical(c_bool) function sync_open(file) bind(c, name='tiltpad_sync_open')
         import :: c_bool, c_int
         integer(c_int), value :: file
      end function sync_open

      integer(c_int) function c_close(file) bind(c, name='close')
         import :: c_int
         integer(c_int), value :: file
      end function c_close
   end interface

contains

   !> Whether a file is a log, or the beginning of one.
   logical function is_log(path)
      character(len=*), intent(in) :: path
      type(frame_log_type) :: self
      type(error_type), allocatable :: error
      call self%open(path, error)
      is_log = .not. allocated(error)
      call self%close()
   end function is_log

   subroutine create(self, path, error)
      class(frame_log_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      self%path = path
      self%ends = 0
      if (create_file(path)) self%file = open_file(path, .true._c_bool)
      if (self%file < 0) then
         call raise(error, system_error, 'cannot write '//path//': '//system_reason())
      else
         call write_bytes(self, beginning, error)
      end if
   end subroutine create

   subroutine open_log(self, path, error)
      class(frame_log_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      character(len=len(beginning)) :: found
      integer(i8) :: there
      self%path = path
      self%ends = 0
      self%file = open_file(path, .false._c_bool)
      if (self%file < 0) then
         call raise(error, system_error, 'cannot read '//path//': '//system_reason())
         return
      end if
      there = min(size_of(self%file), len(beginning, i8))
      found = ''
      if (there > 0) then
         if (.not. read_at(self%file, found(:there), 0_c_long)) then
            call raise(error, system_error, 'cannot read '//path//': '//system_reason())
            return
         end if
      end if
      if (found(:there) /= beginning(:there)) call raise(error, system_error, path//': is no log of a study')
      self%ends = there
   end subroutine open_log

   subroutine write_bytes(self, bytes, error)
      class(frame_log_type), intent(inout) :: self
      character(len=*), intent(in) :: bytes
      type(error_type), allocatable, intent(out) :: error
      if (write_at(self%file, bytes, self%ends)) then
         self%ends = self%ends + len(bytes)
      else
         call raise(error, system_error, 'cannot write '//self%path//': '//system_reason())
      end if
   end subroutine write_bytes

   !> Adds a frame; `place` is where it begins.
   subroutine append(self, kind, contents, place, error)
      class(frame_log_type), intent(inout) :: self
      character, intent(in) :: kind
      character(len=*), intent(in) :: contents
      integer(i8), intent(out) :: place
      type(error_type), allocatable, intent(out) :: error
      place = self%ends
      call write_bytes(self, kind//'   '//transfer(sum_of(kind, contents), '    ') &
         & //transfer(len(contents, i8), '        ')//contents, error)
   end subroutine append

   integer(c_int32_t) function sum_of(kind, contents)
      character, intent(in) :: kind
      character(len=*), intent(in) :: contents
      sum_of = checksum(contents, checksum(kind, 0_c_int32_t))
   end function sum_of

   !> The place of the first frame.
   pure integer(i8) function first(self)
      class(frame_log_type), intent(in) :: self
      first = min(self%ends, len(beginning, i8))
   end function first

   integer(i8) function bytes(self)
      class(frame_log_type), intent(in) :: self
      bytes = size_of(self%file)
   end function bytes

   !> Reads the frame at a place, which becomes that behind it. The kind is blank where it is damaged, and `more` false
   !> where none is there, or only the beginning of one.
   subroutine next(self, place, kind, contents, more)
      class(frame_log_type), intent(inout) :: self
      integer(i8), intent(inout) :: place
      character, intent(out) :: kind
      character(len=:), allocatable, intent(out) :: contents
      logical, intent(out) :: more
      character(len=head) :: words
      integer(i8) :: length, left
      kind = ' '
      contents = ''
      left = size_of(self%file) - place - head
      more = left >= 0
      if (more) more = read_at(self%file, words, place)
      if (.not. more) return
      length = transfer(words(9:16), length)
      more = length >= 0 .and. length <= min(left, longest)
      if (.not. more) return
      deallocate (contents)
      allocate (character(len=length) :: contents)
      if (length > 0) more = read_at(self%file, contents, place + head)
      if (.not. more) return
      if (transfer(words(5:8), 0_c_int32_t) == sum_of(words(1:1), contents)) kind = words(1:1)
      place = place + head + length
      if (kind /= ' ') self%ends = max(self%ends, place)
   end subroutine next

   !> Has what was added written to the disk itself.
   subroutine sync(self, error)
      class(frame_log_type), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      if (.not. sync_open(self%file)) call raise(error, system_error, 'cannot write '//self%path//': ' &
         & //system_reason())
   end subroutine sync

   subroutine rename(self, path, error)
      class(frame_log_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      if (rename_file(self%path, path)) then
         self%path = path
      else
         call raise(error, system_error, 'cannot write '//path//': '//system_reason())
      end if
   end subroutine rename

   subroutine close_log(self)
      class(frame_log_type), intent(inout) :: self
      integer(c_int) :: ignored
      if (self%file >= 0) ignored = c_close(self%file)
      self%file = -1
   end subroutine close_log
end module frame_log
