!> The file of a study: a row for each run, at its number from the beginning, with the parameters of all runs. It is
!> written beside its name and published whole at checkpoints and at the end, so that a kill at any moment leaves the
!> last checkpoint. After a failure every routine does nothing; the next one with an error tells it.
module study_file
   use kinds, only: wp
   use errors, only: error_type
   use clock, only: wall_clock
   use record, only: record_type
   use parameter_study, only: study_type
   use guarded_open, only: unlock, empty
   use hdf5_file, only: hdf5_type
   use hdf5_texts, only: text_type
   use working_file, only: working_file_type
   use study_rows, only: study_rows_type, not_run, stays
   use study_parameters, only: parameter_type, parameters_of, write_parameters
   use study_origin, only: put_origin, names_of, write_runs
   use study_marks, only: put_marks, check_marks, open_study, missing_runs
   use study_join, only: join_rows
   implicit none (type, external)
   private
   public :: study_file_type

   !> A checkpoint must have paid for itself: this many times the time of the last one passes before the next.
   real(wp), parameter :: rest = 20

   type, extends(hdf5_type) :: study_file_type
      !> Name of the file, as it was given.
      character(len=:), allocatable :: name
      type(working_file_type) :: working
      type(study_rows_type), private :: rows
      !> Clock when the last checkpoint was done, and how long it took, s.
      real(wp), private :: last_checkpoint = 0, taken = 0
      !> Whether rows have been added since.
      logical, private :: grown = .false.
   contains
      !> Locks the name of the file, so that nobody else writes it, until `finish` or `abandon`.
      procedure :: claim
      procedure :: begin
      procedure :: reopen
      procedure :: has_row
      !> Exit status of a run; -2 where it has no row.
      procedure :: status
      procedure :: add
      procedure :: checkpoint_if_due
      procedure :: checkpoint
      procedure :: join
      procedure :: publish
      procedure :: finish
      !> Deletes what was not published, and frees the lock.
      procedure :: abandon
      !> Forgets the file in a child process; nothing happens to it.
      procedure :: let_go
      !> Who has the lock, where it was refused for that; else empty.
      procedure :: held_by
   end type study_file_type

contains

   subroutine claim(self, path, error)
      class(study_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      self%name = path
      call self%working%claim(path, error)
   end subroutine claim

   !> Starts a new file under the name claimed, with no row yet. Numbers and parameters are those of all runs, or of a
   !> block of them, from `first` to `last`, where the file is one of many that are to be joined.
   subroutine begin(self, study, error, first, last)
      class(study_file_type), intent(inout) :: self
      type(study_type), intent(in) :: study
      type(error_type), allocatable, intent(out) :: error
      integer, intent(in), optional :: first, last
      type(parameter_type), allocatable :: parameters(:)
      integer :: from, to
      call self%working%make_part(error)
      if (.not. allocated(error)) then
         from = 1
         to = study%runs
         if (present(first)) from = first
         if (present(last)) to = last
         call self%create(self%working%part)
         call unlock(self%hdf5_type)
         parameters = parameters_of(study)
         call put_origin(self, study, parameters)
         call write_runs(self, study%runs, from, to, .false.)
         call write_parameters(self, study, parameters, from, to, .false.)
         call self%rows%begin(self, study%runs, names_of(parameters))
         self%last_checkpoint = wall_clock()
         call self%error_of(self%working%path, error)
      end if
      if (allocated(error)) call self%abandon()
   end subroutine begin

   !> Opens a copy of the file of the name claimed, to go on with it. It must be of this study, which may have got more
   !> runs since.
   subroutine reopen(self, study, error)
      class(study_file_type), intent(inout) :: self
      type(study_type), intent(in) :: study
      type(error_type), allocatable, intent(out) :: error
      type(hdf5_type) :: found
      type(parameter_type), allocatable :: parameters(:)
      integer :: runs
      call open_study(self%working%path, found, error)
      if (.not. allocated(error)) then
         call check_marks(self%working%path, found, study, error)
         call found%close()
      end if
      if (.not. allocated(error)) call self%working%copy_published(error)
      if (.not. allocated(error)) call open_part(self, error)
      if (.not. allocated(error)) then
         parameters = parameters_of(study)
         call self%rows%read_layout(self, names_of(parameters))
         runs = self%rows%table%runs
         if (study%runs > runs) then
            call write_runs(self, study%runs, runs + 1, study%runs, .true.)
            call write_parameters(self, study, parameters, runs + 1, study%runs, .true.)
            call self%rows%resize(self, study%runs)
            call put_marks(self, study)
         end if
         call self%put_flag('finished', 0)
         self%last_checkpoint = wall_clock()
         call self%error_of(self%working%path, error)
      end if
      if (allocated(error)) call self%abandon()
   end subroutine reopen

   !> Whether run k has a row that is to stay.
   pure logical function has_row(self, k)
      class(study_file_type), intent(in) :: self
      integer, intent(in) :: k
      has_row = stays(self%rows%status(k))
   end function has_row

   pure integer function status(self, k)
      class(study_file_type), intent(in) :: self
      integer, intent(in) :: k
      status = self%rows%status(k)
   end function status

   !> The row of run k: exit status, reason where that is not 0, and results; in place of one that it has. Records of
   !> one source, numbered from 1, are mostly alike; each process and reader is one. `own`: where its file is, if it has
   !> one, relative to the folder of this file.
   subroutine add(self, k, status, reason, record, source, own)
      class(study_file_type), intent(inout) :: self
      integer, intent(in) :: k, status, source
      character(len=*), intent(in) :: reason
      type(record_type), intent(in) :: record
      character(len=*), intent(in), optional :: own
      self%grown = .true.
      if (.not. allocated(self%failure)) call self%rows%add(self, k, status, reason, record, source)
      if (.not. present(own) .or. allocated(self%failure)) return
      if (own /= '') call self%rows%put_files(self, k, [text_type(own)])
   end subroutine add

   !> A checkpoint, if this many seconds have passed since the last, and 20 times what it took; `now` is the wall clock.
   !> 0 seconds: never.
   subroutine checkpoint_if_due(self, now, seconds, error)
      class(study_file_type), intent(inout) :: self
      real(wp), intent(in) :: now, seconds
      type(error_type), allocatable, intent(out) :: error
      if (allocated(self%failure)) then
         call self%error_of(self%working%path, error)
         call self%abandon()
      else if (self%grown .and. seconds > 0 .and. now - self%last_checkpoint >= max(seconds, rest*self%taken)) then
         call self%checkpoint(error)
      end if
   end subroutine checkpoint_if_due

   !> Publishes all rows that were added, and goes on with a copy.
   subroutine checkpoint(self, error)
      class(study_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: started
      logical :: exchanged
      started = wall_clock()
      self%grown = .false.
      call note(self)
      call close_all(self)
      call self%error_of(self%working%path, error)
      if (.not. allocated(error)) call self%working%publish(exchanged, error)
      if (.not. allocated(error)) call self%working%copy_published(error)
      if (.not. allocated(error)) call open_part(self, error)
      if (.not. allocated(error)) then
         call self%rows%open(self)
         call self%error_of(self%working%path, error)
      end if
      if (allocated(error)) call self%abandon()
      self%last_checkpoint = wall_clock()
      self%taken = self%last_checkpoint - started
   end subroutine checkpoint

   !> Adds all rows of another file of this study that this one has not. Where the error is that file's, nothing of it
   !> was added, and there is no failure.
   subroutine join(self, study, path, error)
      class(study_file_type), intent(inout) :: self
      type(study_type), intent(in) :: study
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      call self%error_of(self%working%path, error)
      if (.not. allocated(error)) call join_rows(self, self%rows, study, path, error)
      if (.not. allocated(error)) call self%error_of(self%working%path, error)
   end subroutine join

   !> Writes what is left and publishes the file, which is finished where all runs have a row. Nothing can be added
   !> then.
   subroutine publish(self, error)
      class(study_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      logical :: exchanged
      call note(self)
      call close_all(self)
      call self%error_of(self%working%path, error)
      if (.not. allocated(error)) call self%working%publish(exchanged, error)
   end subroutine publish

   !> Publishes the file and frees its lock.
   subroutine finish(self, error)
      class(study_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call self%publish(error)
      call self%abandon()
   end subroutine finish

   !> Writes the rows that are held back, and which runs have none.
   subroutine note(self)
      class(study_file_type), intent(inout) :: self
      if (allocated(self%failure)) return
      call self%rows%flush(self)
      call self%put_flag('finished', merge(0, 1, any(self%rows%status == not_run)))
      call self%put_text('missing', missing_runs(self%rows%status == not_run))
   end subroutine note

   subroutine let_go(self)
      class(study_file_type), intent(inout) :: self
      call empty(self%hdf5_type)
      call close_all(self)
   end subroutine let_go

   !> Opens the part, unless another run has taken the place of this one, whose part then has the name.
   subroutine open_part(self, error)
      class(study_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call self%working%check_part(error)
      if (allocated(error)) return
      call self%open(self%working%part, writing=.true.)
      call unlock(self%hdf5_type)
   end subroutine open_part

   subroutine close_all(self)
      class(study_file_type), intent(inout) :: self
      call self%rows%close(self)
      call self%close()
   end subroutine close_all

   subroutine abandon(self)
      class(study_file_type), intent(inout) :: self
      call close_all(self)
      call self%working%release()
   end subroutine abandon

   function held_by(self)
      class(study_file_type), intent(in) :: self
      character(len=:), allocatable :: held_by
      held_by = ''
      if (allocated(self%working%lock%held_by)) held_by = self%working%lock%held_by
   end function held_by
end module study_file
