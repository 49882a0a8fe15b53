!> The log of a study: what it says of itself, then a row for each run that has ended, in the order in which they ended,
!> and before them what rows have, where it is new. A row of a run that has one replaces it. Everything else that is
!> made of a study's rows is made of its log: the table (study_builder), the study that goes on, and joined blocks.
module study_log
   use kinds, only: wp, i8
   use errors, only: error_type, raise, system_error
   use frame_log, only: frame_log_type
   use packet, only: packet_type, packet_of, text_type
   use study_header, only: header_type
   use study_layout, only: layout_type
   implicit none (type, external)
   private
   public :: study_log_type, row_type, not_run, unreadable, stays, text_names, text_meanings

   !> The status of a run that has no row, and, in a study that was collected, of one whose file cannot be read.
   integer, parameter :: not_run = -2, unreadable = -9
   !> Texts of a row; empty where there is nothing to say.
   character(len=*), parameter :: text_names(3) = [character(len=7) :: 'reason', 'remarks', 'file']
   character(len=*), parameter :: text_meanings(3) = [character(len=75) :: 'reason of the failure', &
      & 'what is unusual in the run, or leaves the range of the model, a line each', &
      & 'result file, relative to the folder of this file']
   !> Kinds of frames.
   character, parameter :: of_study = 'S', of_description = 'D', of_row = 'R'
   !> Place of the number of the description in the contents of a row, and whole numbers before its texts, 4 bytes each.
   integer, parameter :: description_place = 9, row_head = 12
   !> Descriptions that a new one is compared with.
   integer, parameter :: most_recent = 16
   !> Descriptions that a log has at most; only a damaged one says more.
   integer, parameter :: most_descriptions = 10000000

   type :: row_type
      integer :: run = 0, status = not_run, description = 0
      type(text_type) :: texts(size(text_names))
      real(wp), allocatable :: numbers(:)
   end type row_type

   type :: recent_type
      character(len=:), allocatable :: bytes
      integer :: number = 0
   end type recent_type

   type :: study_log_type
      type(header_type) :: header
      !> Exit status of each row.
      integer, allocatable :: status(:)
      !> Bytes at its end, or in it, that are no whole frames.
      integer(i8) :: lost = 0
      type(frame_log_type), private :: frames
      !> Where the frames of rows and descriptions are; 0 where there is none.
      integer(i8), allocatable, private :: rows(:), descriptions(:)
      type(recent_type), private :: recent(most_recent)
   contains
      procedure :: begin
      procedure :: put_header
      procedure :: open => open_log
      procedure :: describe
      procedure :: add
      procedure :: take
      procedure :: row
      procedure :: layout
      procedure :: sync
      procedure :: rename
      procedure :: close => close_log
   end type study_log_type

contains

   !> Whether the row of a run that ended so is to stay. The row of one that the system failed is to be written again.
   elemental logical function stays(status)
      integer, intent(in) :: status
      stays = status /= not_run .and. status /= system_error
   end function stays

   !> A new log, without rows, under a name that nothing has.
   subroutine begin(self, path, header, error)
      class(study_log_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(header_type), intent(in) :: header
      type(error_type), allocatable, intent(out) :: error
      call self%close()
      if (allocated(self%status)) deallocate (self%status, self%rows, self%descriptions)
      self%recent%number = 0
      call self%frames%create(path, error)
      if (.not. allocated(error)) call self%put_header(header, error)
   end subroutine begin

   !> Says of which study it is; the last that was said holds.
   subroutine put_header(self, header, error)
      class(study_log_type), intent(inout) :: self
      type(header_type), intent(in) :: header
      type(error_type), allocatable, intent(out) :: error
      type(packet_type) :: packed
      integer(i8) :: place
      call take_header(self, header)
      call self%header%exchange(packed)
      call self%frames%append(of_study, packed%bytes(), place, error)
   end subroutine put_header

   subroutine take_header(self, header)
      type(study_log_type), intent(inout) :: self
      type(header_type), intent(in) :: header
      self%header = header
      if (allocated(self%status)) then
         if (size(self%status) == size(header%numbers)) return
         deallocate (self%status, self%rows, self%descriptions)
      end if
      allocate (self%status(size(header%numbers)), source=not_run)
      allocate (self%rows(size(header%numbers)), source=0_i8)
      allocate (self%descriptions(0))
   end subroutine take_header

   !> Opens a log to read it, and finds its rows. An error where it is none of a study.
   subroutine open_log(self, path, error)
      class(study_log_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: contents
      type(header_type) :: header
      type(packet_type) :: packed
      character :: kind
      integer(i8) :: at, place, whole
      logical :: more, ok
      call self%frames%open(path, error)
      if (allocated(error)) return
      at = self%frames%first()
      ok = .false.
      whole = at
      do
         place = at
         call self%frames%next(at, kind, contents, more)
         if (.not. more) exit
         if (kind == of_study) then
            packed = packet_of(contents)
            header = header_type()
            call header%exchange(packed)
            if (packed%at_end()) call take_header(self, header)
            ok = ok .or. packed%at_end()
         else if (ok .and. kind == of_description) then
            call note_description(self, contents, place)
         else if (ok .and. kind == of_row) then
            call note_row(self, contents, place)
         end if
         if (kind /= ' ') whole = whole + at - place
      end do
      self%lost = self%frames%bytes() - whole
      if (.not. ok) call raise(error, system_error, path//': damaged: it does not say of which study it is')
   end subroutine open_log

   subroutine note_description(self, contents, place)
      type(study_log_type), intent(inout) :: self
      character(len=*), intent(in) :: contents
      integer(i8), intent(in) :: place
      type(packet_type) :: packed
      integer :: n
      packed = packet_of(contents)
      call packed%whole(n)
      if (n < 1 .or. n > most_descriptions) return
      if (n > size(self%descriptions)) self%descriptions = [self%descriptions, spread(0_i8, 1, &
         & max(n, 2*size(self%descriptions)) - size(self%descriptions))]
      self%descriptions(n) = place
   end subroutine note_description

   !> Notes the row of a run, if it is one of this study and is described.
   subroutine note_row(self, contents, place)
      type(study_log_type), intent(inout) :: self
      character(len=*), intent(in) :: contents
      integer(i8), intent(in) :: place
      type(packet_type) :: packed
      integer :: k, status, n
      packed = packet_of(contents(:min(row_head, len(contents))))
      call packed%whole(k)
      call packed%whole(status)
      call packed%whole(n)
      if (.not. packed%ok .or. k < 1 .or. k > size(self%rows) .or. n < 1 .or. n > size(self%descriptions)) return
      if (self%descriptions(n) == 0) return
      self%rows(k) = place
      self%status(k) = status
   end subroutine note_row

   !> The number of a description, which is added where it is new.
   subroutine describe(self, bytes, number, error)
      class(study_log_type), intent(inout) :: self
      character(len=*), intent(in) :: bytes
      integer, intent(out) :: number
      type(error_type), allocatable, intent(out) :: error
      type(packet_type) :: packed
      character(len=:), allocatable :: contents
      integer(i8) :: place
      integer :: i
      do i = 1, most_recent
         number = self%recent(i)%number
         if (number == 0) cycle
         if (self%recent(i)%bytes == bytes) return
      end do
      number = maxval(self%recent%number) + 1
      contents = bytes
      call packed%whole(number)
      call packed%text(contents)
      call self%frames%append(of_description, packed%bytes(), place, error)
      if (allocated(error)) return
      call note_description(self, packed%bytes(), place)
      i = 1 + mod(number, most_recent)
      self%recent(i)%number = number
      self%recent(i)%bytes = bytes
   end subroutine describe

   !> Adds a row, whose description is in the log.
   subroutine add(self, row, error)
      class(study_log_type), intent(inout) :: self
      type(row_type), intent(inout) :: row
      type(error_type), allocatable, intent(out) :: error
      type(packet_type) :: packed
      call exchange(row, packed)
      call add_contents(self, packed%bytes(), error)
   end subroutine add

   !> A row into a packet, or out of it.
   subroutine exchange(row, packed)
      type(row_type), intent(inout) :: row
      type(packet_type), intent(inout) :: packed
      integer :: i
      call packed%whole(row%run)
      call packed%whole(row%status)
      call packed%whole(row%description)
      do i = 1, size(row%texts)
         call packed%text(row%texts(i)%text)
      end do
      call packed%reals(row%numbers)
   end subroutine exchange

   subroutine add_contents(self, contents, error)
      class(study_log_type), intent(inout) :: self
      character(len=*), intent(in) :: contents
      type(error_type), allocatable, intent(out) :: error
      integer(i8) :: place
      call self%frames%append(of_row, contents, place, error)
      if (.not. allocated(error)) call note_row(self, contents, place)
   end subroutine add_contents

   !> Adds the rows of another log that are wanted.
   subroutine take(self, other, wanted, error)
      class(study_log_type), intent(inout) :: self
      type(study_log_type), intent(inout) :: other
      logical, intent(in) :: wanted(:)
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: contents, described
      integer :: k, before, number, theirs
      before = 0
      self%lost = self%lost + other%lost
      do k = 1, size(wanted)
         if (.not. wanted(k)) cycle
         call read_frame(other, other%rows(k), contents, error)
         if (allocated(error)) return
         theirs = transfer(contents(description_place:), theirs)
         if (theirs /= before) then
            call description(other, theirs, described, error)
            if (.not. allocated(error)) call self%describe(described, number, error)
            if (allocated(error)) return
            before = theirs
         end if
         contents(description_place:row_head) = transfer(number, contents(description_place:row_head))
         call add_contents(self, contents, error)
         if (allocated(error)) return
      end do
   end subroutine take

   subroutine read_frame(self, place, contents, error)
      type(study_log_type), intent(inout) :: self
      integer(i8), intent(in) :: place
      character(len=:), allocatable, intent(out) :: contents
      type(error_type), allocatable, intent(out) :: error
      integer(i8) :: at
      character :: kind
      logical :: more
      at = place
      call self%frames%next(at, kind, contents, more)
      if (kind == ' ') call raise(error, system_error, 'cannot read '//self%frames%path//': it has changed')
   end subroutine read_frame

   !> The bytes of a description.
   subroutine description(self, number, bytes, error)
      type(study_log_type), intent(inout) :: self
      integer, intent(in) :: number
      character(len=:), allocatable, intent(out) :: bytes
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: contents
      type(packet_type) :: packed
      integer :: own
      call read_frame(self, self%descriptions(number), contents, error)
      if (allocated(error)) return
      packed = packet_of(contents)
      call packed%whole(own)
      call packed%text(bytes)
   end subroutine description

   !> Reads the row of run k, which has one.
   subroutine row(self, k, found, error)
      class(study_log_type), intent(inout) :: self
      integer, intent(in) :: k
      type(row_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: contents
      type(packet_type) :: packed
      call read_frame(self, self%rows(k), contents, error)
      if (allocated(error)) return
      packed = packet_of(contents)
      call exchange(found, packed)
      if (.not. packed%ok) call raise(error, system_error, self%frames%path//': damaged: the row of a run')
   end subroutine row

   !> Reads what rows of a description have.
   subroutine layout(self, number, found, error)
      class(study_log_type), intent(inout) :: self
      integer, intent(in) :: number
      type(layout_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: bytes
      type(packet_type) :: packed
      call description(self, number, bytes, error)
      if (allocated(error)) return
      packed = packet_of(bytes)
      call found%exchange(packed)
      if (.not. packed%at_end()) call raise(error, system_error, self%frames%path//': damaged: what a row of it has')
   end subroutine layout

   subroutine sync(self, error)
      class(study_log_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call self%frames%sync(error)
   end subroutine sync

   !> Gives the log another name.
   subroutine rename(self, path, error)
      class(study_log_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      call self%frames%rename(path, error)
   end subroutine rename

   subroutine close_log(self)
      class(study_log_type), intent(inout) :: self
      call self%frames%close()
   end subroutine close_log
end module study_log
