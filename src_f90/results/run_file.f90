!> The file of a run: what it is, its checkpoints, how a run continues from one, and its end.
module run_file
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, degree, pi
   use errors, only: error_type, raise, system_error
   use case_inputs, only: case_type
   use parameter_study, only: run_tag
   use growing_file, only: growing_file_type
   use summary_group, only: put_figure
   use provenance, only: provenance_type, running
   use run_statistics, only: run_statistics_type
   implicit none (type, external)
   private
   public :: run_file_type

   type, extends(growing_file_type) :: run_file_type
      type(provenance_type), private :: provenance
   contains
      procedure :: start
      procedure :: resume
      procedure :: put_tag
      procedure :: begin_checkpoint
      procedure :: checkpoint
      procedure :: finish
   end type run_file_type

contains

   !> Starts the file of a case under the name claimed; `input` is its resolved namelist.
   subroutine start(self, inputs, input, error)
      class(run_file_type), intent(inout) :: self
      character(len=*), intent(in) :: input
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      call self%begin(error)
      if (allocated(error)) then
         call self%abandon()
         return
      end if
      call self%provenance%begin(self)
      call self%put_flag('complete', 0)
      call self%put_text('title', inputs%about%title)
      call self%put_text('task', inputs%about%task)
      call self%put_text('input', input)
      call self%put_list('pad', [(real(i, wp), i=1, inputs%pad_count())], '1', 'pad number', 'pad')
      if (inputs%about%task /= 'branch') call put_figure(self, 'speed', inputs%operation%speed_rpm*pi/30, 'rad/s', &
         & 'shaft speed at the end')
      call self%put_list('pivot_angle', inputs%pads%pivot_angle_deg*degree, 'rad', 'pivot angle', 'pad')
      call self%error_of(error)
      if (allocated(error)) call self%abandon()
   end subroutine start

   !> Continues the file of the name claimed from its checkpoint: simulated time t, s, and state.
   subroutine resume(self, t, statistics, error, state)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(out) :: t
      !> The list of figures, which get the values in the file.
      type(run_statistics_type), intent(inout) :: statistics
      type(error_type), allocatable, intent(out) :: error
      !> Of a march; of the size that the case has.
      real(wp), intent(inout), optional :: state(:)
      logical :: ok
      t = 0
      call self%reopen(error)
      if (.not. allocated(error)) then
         t = self%get_real('checkpoint/time')
         if (present(state)) call self%get_list('checkpoint/state', state)
         call statistics%read(self)
         call self%provenance%resume(self, t)
         call self%error_of(error)
         ok = ieee_is_finite(t)
         if (present(state)) ok = ok .and. all(ieee_is_finite(state))
         if (.not. allocated(error) .and. .not. ok) call raise(error, system_error, &
            & self%path()//': damaged: its checkpoint is not a number')
      end if
      if (allocated(error)) call self%abandon()
   end subroutine resume

   !> Notes which run of a study the run is.
   subroutine put_tag(self, tag)
      class(run_file_type), intent(inout) :: self
      type(run_tag), intent(in) :: tag
      call self%put_flag('run', tag%number)
      call self%put_flag('runs', tag%runs)
      call self%put_text('sweep', tag%study)
      call self%put_text('study_marks', tag%marks)
   end subroutine put_tag

   !> Begins a new checkpoint, at time t, s: what the run goes on from belongs into its group.
   subroutine begin_checkpoint(self, t)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(in) :: t
      ! what it holds may have another size than in the last
      call self%delete('checkpoint')
      call self%make_group('checkpoint')
      call self%put_real('checkpoint/time', t, 's', 'time from which the run can go on')
   end subroutine begin_checkpoint

   !> Publishes what there is, with the checkpoint that was begun or, of a march, with the state y. With an exit status
   !> other than `running`, which needs its reason, this is the end of the file's writing.
   subroutine checkpoint(self, t, statistics, status, reason, error, y)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(in) :: t
      type(run_statistics_type), intent(in) :: statistics
      integer, intent(in) :: status
      character(len=*), intent(in) :: reason
      type(error_type), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: y(:)
      if (present(y)) then
         call self%begin_checkpoint(t)
         call self%put_list('checkpoint/state', y, '1', 'state of the march at that time', '')
      end if
      call statistics%write(self)
      call self%provenance%note(self, t, status, reason)
      call self%publish(status == running, error)
   end subroutine checkpoint

   !> Closes the file and publishes it. An exit status other than 0 needs its reason; t is the simulated time
   !> reached, s.
   subroutine finish(self, t, statistics, status, reason, error)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(in) :: t
      type(run_statistics_type), intent(in) :: statistics
      integer, intent(in) :: status
      character(len=*), intent(in) :: reason
      type(error_type), allocatable, intent(out) :: error
      call self%delete('checkpoint')
      call statistics%write(self)
      call self%provenance%note(self, t, status, reason)
      if (status == 0) call self%put_flag('complete', 1)
      call self%publish(.false., error)
   end subroutine finish
end module run_file
