!> A study that is being performed: its log, to which each run that ends adds a row, and its file, the table that is
!> made of the log at checkpoints and at the end. A kill at any moment loses no row that was added. After a failure
!> every routine does nothing; the next one with an error tells it.
module study_file
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp, i8
   use text, only: printable
   use errors, only: error_type
   use clock, only: wall_clock
   use files, only: delete_file, is_regular, take_mode
   use parameter_study, only: study_type
   use hdf5_file, only: hdf5_type
   use working_file, only: working_file_type
   use frame_log, only: is_log
   use study_header, only: header_type, header_of, own_build
   use study_layout, only: layout_type
   use study_log, only: study_log_type, row_type, stays
   use study_row, only: study_row_type
   use study_source, only: take_rows, log_path
   use study_builder, only: write_table
   use verification_results, only: states_figure
   implicit none (type, external)
   private
   public :: study_file_type, make_table

   !> A checkpoint must have paid for itself: this many times the time of the last one passes before the next.
   real(wp), parameter :: rest = 20

   type :: study_file_type
      !> Name of the file, as it was given.
      character(len=:), allocatable :: name
      type(working_file_type) :: working
      type(study_log_type), private :: log
      !> Whether the log has its name.
      logical, private :: named = .false.
      !> Whether it says which builds made the rows that were taken.
      logical, private :: has_builds = .false.
      type(error_type), allocatable, private :: failure
      !> Clock when the last checkpoint was done, and how long it took, s; whether rows have been added since.
      real(wp), private :: last_checkpoint = 0, taken = 0
      logical, private :: grown = .false.
   contains
      !> Locks the name of the file, so that nobody else writes it, until `abandon`.
      procedure :: claim
      procedure :: begin
      procedure :: take
      procedure :: start
      procedure :: has_row
      !> Exit status of a run; -2 where it has no row.
      procedure :: status
      !> States of a run whose films were solved closely, by its row.
      procedure :: verified_states
      !> Bytes of the logs whose rows were taken that were no whole rows.
      procedure :: lost
      procedure :: add
      procedure :: checkpoint_if_due
      procedure :: publish
      !> Frees the lock.
      procedure :: abandon
      !> Who has the lock, where it was refused for that; else empty.
      procedure :: held_by
   end type study_file_type

contains

   subroutine claim(self, path, error)
      class(study_file_type), intent(out) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      self%name = path
      call self%working%claim(path, error)
   end subroutine claim

   !> Begins a log for the name claimed, with no row yet: NAME.rows.part. Numbers and parameters are those of all runs,
   !> or of a block of them, from `first` to `last`.
   subroutine begin(self, study, first, last, error)
      class(study_file_type), intent(inout) :: self
      type(study_type), intent(in) :: study
      integer, intent(in) :: first, last
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: part
      part = log_path(self%working%path)//'.part'
      ! a killed run has left it
      if (is_regular(part)) then
         if (is_log(part)) call delete_file(part)
      end if
      call self%log%begin(part, header_of(study, first, last), error)
      if (.not. allocated(error)) call take_mode(self%working%path, part)
      if (allocated(error)) call self%abandon()
   end subroutine begin

   !> Takes the rows of log and table of a path: of the name claimed, or of a block of the study. `other` is true where
   !> they are of another study, so that they may be replaced.
   subroutine take(self, study, path, other, error)
      class(study_file_type), intent(inout) :: self
      type(study_type), intent(in) :: study
      character(len=*), intent(in) :: path
      logical, intent(out) :: other
      type(error_type), allocatable, intent(out) :: error
      type(header_type) :: origin, header
      integer :: status(study%runs)
      status = self%log%status
      call take_rows(path, study, status, other, error, self%log, origin)
      if (allocated(error) .or. .not. allocated(origin%created)) return
      header = self%log%header
      if (path == self%name) header%created = origin%created
      if (.not. self%has_builds) header%version = ''
      self%has_builds = .true.
      call header%add_builds(origin%version)
      call put_new(self, header, error)
   end subroutine take

   !> Lets the log say when it was begun, and which builds made its rows, where that is new.
   subroutine put_new(self, header, error)
      class(study_file_type), intent(inout) :: self
      type(header_type), intent(in) :: header
      type(error_type), allocatable, intent(inout) :: error
      associate (own => self%log%header)
         if (header%created == own%created .and. header%version == own%version) return
      end associate
      call self%log%put_header(header, error)
   end subroutine put_new

   !> Gives the log its name; rows may be added from now on.
   subroutine start(self, error)
      class(study_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call self%log%sync(error)
      if (.not. allocated(error)) call self%log%rename(log_path(self%working%path), error)
      self%named = .not. allocated(error)
      if (allocated(error)) call self%abandon()
      self%last_checkpoint = wall_clock()
   end subroutine start

   !> Whether run k has a row that is to stay.
   pure logical function has_row(self, k)
      class(study_file_type), intent(in) :: self
      integer, intent(in) :: k
      has_row = stays(self%log%status(k))
   end function has_row

   pure integer function status(self, k)
      class(study_file_type), intent(in) :: self
      integer, intent(in) :: k
      status = self%log%status(k)
   end function status

   integer function verified_states(self, k) result(states)
      class(study_file_type), intent(inout) :: self
      integer, intent(in) :: k
      type(row_type) :: row
      type(layout_type) :: layout
      type(error_type), allocatable :: error
      integer :: c
      states = 0
      call self%log%row(k, row, error)
      if (.not. allocated(error)) call self%log%layout(row%description, layout, error)
      if (allocated(error)) return
      c = layout%find(states_figure)
      if (c == 0) return
      associate (at => layout%columns(c)%before + 1)
         if (at > size(row%numbers)) return
         if (.not. ieee_is_nan(row%numbers(at))) states = nint(row%numbers(at))
      end associate
   end function verified_states

   pure integer(i8) function lost(self)
      class(study_file_type), intent(in) :: self
      lost = self%log%lost
   end function lost

   !> The row of run k: exit status, reason where that is not 0, and results; in place of one that it has. `own`: where
   !> its file is, if it has one, relative to the folder of this file.
   subroutine add(self, k, status, reason, row, own)
      class(study_file_type), intent(inout) :: self
      integer, intent(in) :: k, status
      character(len=*), intent(in) :: reason, own
      type(study_row_type), intent(in) :: row
      type(row_type) :: new
      type(header_type) :: header
      if (allocated(self%failure)) return
      self%grown = .true.
      new%run = k
      new%status = status
      new%texts(1)%text = trim(printable(reason))
      new%texts(2)%text = row%remarks
      new%texts(3)%text = own
      new%numbers = row%numbers
      ! not for each row: a header has a number for each run
      if (.not. self%log%header%has_build(own_build)) then
         header = self%log%header
         call header%add_builds(own_build)
         call put_new(self, header, self%failure)
      end if
      if (.not. allocated(self%failure)) call self%log%describe(row%description, new%description, self%failure)
      if (.not. allocated(self%failure)) call self%log%add(new, self%failure)
   end subroutine add

   !> A checkpoint, if this many seconds have passed since the last, and 20 times what it took; `now` is the wall clock.
   !> 0 seconds: never.
   subroutine checkpoint_if_due(self, now, seconds, error)
      class(study_file_type), intent(inout) :: self
      real(wp), intent(in) :: now, seconds
      type(error_type), allocatable, intent(out) :: error
      if (.not. allocated(self%failure)) then
         if (.not. self%grown .or. seconds <= 0) return
         if (now - self%last_checkpoint < max(seconds, rest*self%taken)) return
      end if
      call write_out(self, error)
      self%last_checkpoint = wall_clock()
      self%taken = max(0.0_wp, self%last_checkpoint - now)
   end subroutine checkpoint_if_due

   !> Makes the file of all rows, which is finished where all runs have one. Nothing can be added then.
   subroutine publish(self, error)
      class(study_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call write_out(self, error)
      if (allocated(error)) return
      call self%log%close()
      if (self%named) call delete_file(log_path(self%working%path))
      self%named = .false.
   end subroutine publish

   !> Makes the table of the log under the name claimed.
   subroutine write_out(self, error)
      class(study_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      logical :: exchanged
      self%grown = .false.
      if (allocated(self%failure)) error = self%failure
      if (.not. allocated(error)) call self%log%sync(error)
      if (.not. allocated(error)) call self%working%make_part(error)
      if (.not. allocated(error)) call make_table(self%log, self%working%part, self%working%path, error)
      if (.not. allocated(error)) call self%working%publish(exchanged, error)
      call self%working%drop_part()
      if (.not. allocated(error)) return
      if (self%named) error%message = error%message//'; '//log_path(self%working%path)//' has the rows so far, from ' &
         & //'which the next run of the study goes on'
      call self%abandon()
   end subroutine write_out

   !> Makes the table of a log, a new file; `name` is what messages call it.
   subroutine make_table(log, path, name, error)
      type(study_log_type), intent(inout) :: log
      character(len=*), intent(in) :: path, name
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: of_file
      type(hdf5_type) :: file
      call file%create(path)
      call write_table(log, file, error)
      call file%close()
      call file%error_of(name, of_file)
      if (allocated(of_file)) call move_alloc(of_file, error)
   end subroutine make_table

   subroutine abandon(self)
      class(study_file_type), intent(inout) :: self
      character(len=:), allocatable :: part
      call self%log%close()
      if (allocated(self%working%path)) then
         part = log_path(self%working%path)//'.part'
         if (is_regular(part)) then
            if (self%working%lock%is_ours()) call delete_file(part)
         end if
      end if
      self%named = .false.
      call self%working%release()
   end subroutine abandon

   function held_by(self)
      class(study_file_type), intent(in) :: self
      character(len=:), allocatable :: held_by
      held_by = ''
      if (allocated(self%working%lock%held_by)) held_by = self%working%lock%held_by
   end function held_by
end module study_file
