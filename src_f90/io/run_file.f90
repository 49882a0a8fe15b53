!> The result file of a run: names, dimensions and units as docs/results.md lists them.
!>
!> It is written beside its place and put there whole, at checkpoints and at the end, so that a crash at any moment
!> leaves the last checkpoint, or before the first one the previous file as it was.
module run_file
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, i8, pi, degree
   use text, only: to_text
   use errors, only: error_type, raise, system_error
   use scene, only: scene_type
   use equations_of_motion, only: bearing_model
   use equilibrium, only: equilibrium_type
   use hdf5_file, only: hdf5_type
   use sample_table, only: sample_table_type
   use run_statistics, only: run_statistics_type
   use provenance, only: provenance_type, running
   use working_file, only: working_file_type
   implicit none (type, external)
   private
   public :: run_file_type, format_version

   !> Version of the names in the file.
   integer, parameter :: format_version = 1

   type :: run_file_type
      private
      type(working_file_type) :: place
      type(hdf5_type) :: file
      type(sample_table_type) :: table
      type(provenance_type) :: provenance
      !> Clock of the last beat, s.
      integer :: last_beat = 0
   contains
      !> Locks the place of the file, so that no other run writes it, until `finish`, `stop` or `abandon`.
      procedure :: claim
      procedure :: create
      procedure :: resume
      procedure :: put_member
      procedure :: put_equilibrium
      procedure :: add_sample
      procedure :: samples
      procedure :: last_samples
      procedure :: put_spectrum
      procedure :: checkpoint
      procedure :: finish
      !> Gives up what was not published, and the lock.
      procedure :: abandon
      !> Shows other programs that this one lives, and has the system write; to be called often with a clock, s.
      procedure :: beat
      !> The dead process that held the file's lock; empty where there was none.
      procedure :: taken_from
      procedure, private :: close_parts
      procedure, private :: catch_up
      procedure, private :: error_of
   end type run_file_type

contains

   subroutine claim(self, path, error)
      class(run_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      call self%place%claim(path, error)
   end subroutine claim

   !> Starts the file of a scene in the place claimed; `input` is its resolved namelist.
   subroutine create(self, scene, input, error)
      class(run_file_type), intent(inout) :: self
      character(len=*), intent(in) :: input
      type(scene_type), intent(in) :: scene
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      associate (file => self%file)
         call file%create(self%place%part)
         call file%put_flag('format_version', format_version)
         call self%provenance%begin(file)
         call file%put_text('title', scene%about%title)
         call file%put_text('task', scene%about%task)
         call file%put_flag('complete', 0)
         call file%put_text('input', input)
         call file%put_list('pad', [(real(i, wp), i=1, scene%pad_count())], '1', 'pad number', 'pad')
         call file%put_list('pivot_angle', scene%pads%pivot_angle_deg*degree, 'rad', 'pivot angle', 'pad')
         call self%table%begin(file)
      end associate
      call self%error_of(error)
      if (allocated(error)) call self%abandon()
   end subroutine create

   !> Goes on with the file that stands in the place claimed, from its checkpoint: simulated time t, s, and state.
   subroutine resume(self, t, state, statistics, error)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(out) :: t
      !> Of the size that the scene has.
      real(wp), intent(out) :: state(:)
      type(run_statistics_type), intent(out) :: statistics
      type(error_type), allocatable, intent(out) :: error
      t = 0
      state = 0
      call self%place%copy_published(error)
      if (.not. allocated(error)) then
         call self%file%open(self%place%part, writing=.true.)
         t = self%file%get_real('checkpoint/time')
         call self%file%get_list('checkpoint/state', state)
         call statistics%get(self%file)
         call self%provenance%resume(self%file, t)
         call self%table%begin(self%file)
         call self%error_of(error)
         if (.not. allocated(error) .and. .not. all(ieee_is_finite([t, state]))) call raise(error, system_error, &
            & self%place%path//': damaged: its checkpoint is not a number')
      end if
      if (allocated(error)) call self%abandon()
   end subroutine resume

   !> The run is a member of a sweep: its number, how many there are, and what is its own, a line each.
   subroutine put_member(self, number, members, sweep)
      class(run_file_type), intent(inout) :: self
      integer, intent(in) :: number, members
      character(len=*), intent(in) :: sweep
      call self%file%put_flag('member', number)
      call self%file%put_flag('members', members)
      call self%file%put_text('sweep', sweep)
   end subroutine put_member

   subroutine put_equilibrium(self, found, radial)
      class(run_file_type), intent(inout) :: self
      type(equilibrium_type), intent(in) :: found
      logical, intent(in) :: radial
      associate (file => self%file)
         call file%make_group('equilibrium')
         call file%put_real('equilibrium/journal_y', found%journal(1), 'm', 'journal displacement, vertical')
         call file%put_real('equilibrium/journal_z', found%journal(2), 'm', 'journal displacement, horizontal')
         call file%put_list('equilibrium/pad_tilt', found%tilt, 'rad', 'pad tilt', 'pad')
         if (radial) call file%put_list('equilibrium/pad_penetration', found%penetration, 'm', &
            & 'pivot penetration', 'pad')
         call file%put_list('equilibrium/contact_force', found%contact_force, 'N', 'pivot contact force', 'pad')
         call file%put_list('equilibrium/min_film_thickness', found%min_film, 'm', 'least film thickness', 'pad')
         call file%put_list('equilibrium/max_pressure', found%max_pressure, 'Pa', 'highest film pressure', 'pad')
         call file%put_real('equilibrium/residual', found%residual, '1', 'unbalanced force over load')
      end associate
   end subroutine put_equilibrium

   !> Adds the state y at time t; the model has been evaluated there.
   subroutine add_sample(self, model, t, y, error)
      class(run_file_type), intent(inout) :: self
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: t, y(:)
      type(error_type), allocatable, intent(out) :: error
      integer :: n
      n = size(model%places)
      call self%table%new_sample(self%file)
      call one('time', t, 's', 'time')
      call one('shaft_angle', model%scene%shaft_angle(t), 'rad', 'shaft angle')
      call one('speed', model%scene%speed(t), 'rad/s', 'shaft speed')
      call one('journal_y', y(1), 'm', 'journal displacement, vertical')
      call one('journal_z', y(2), 'm', 'journal displacement, horizontal')
      call one('journal_vy', y(3), 'm/s', 'journal velocity, vertical')
      call one('journal_vz', y(4), 'm/s', 'journal velocity, horizontal')
      call each('pad_tilt', state(1), 'rad', 'pad tilt')
      call each('pad_tilt_rate', state(2), 'rad/s', 'pad tilt rate')
      if (model%radial) then
         call each('pad_penetration', state(3), 'm', 'pivot penetration')
         call each('pad_penetration_rate', state(4), 'm/s', 'pivot penetration rate')
      end if
      if (model%friction%has_bristle) call each('bristle_deflection', state(model%states_per_pad), 'm', &
         & 'bristle deflection')
      call each('contact_force', model%loads%contact, 'N', 'pivot contact force')
      call each('friction_moment', model%ball_radius*model%loads%friction%force, 'N m', 'pivot friction moment')
      call each('film_force_tangential', model%response%force(1), 'N', &
         & 'film force on the journal along the pad (y'')')
      call each('film_force_radial', model%response%force(2), 'N', 'film force on the journal outward (z'')')
      call each('min_film_thickness', model%response%min_film, 'm', 'least film thickness')
      call each('max_pressure', model%response%max_pressure, 'Pa', 'highest film pressure')
      call self%error_of(error)
   contains
      !> The i-th state of every pad.
      function state(i)
         integer, intent(in) :: i
         real(wp) :: state(n)
         state = y(4 + i:4 + (n - 1)*model%states_per_pad + i:model%states_per_pad)
      end function state

      subroutine one(name, value, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: value
         call self%table%add(self%file, name, [value], 0, units, long_name)
      end subroutine one

      subroutine each(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(:)
         call self%table%add(self%file, name, values, n, units, long_name)
      end subroutine each
   end subroutine add_sample

   !> Samples added, also before the run was resumed.
   integer(i8) function samples(self)
      class(run_file_type), intent(in) :: self
      samples = self%table%samples
   end function samples

   !> The last n samples of a series, (width, n); n at most the samples there are.
   subroutine last_samples(self, name, n, values)
      class(run_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      call self%table%last(self%file, name, n, values)
   end subroutine last_samples

   !> Amplitude spectra over the last revolutions of a run at constant speed, rad/s.
   subroutine put_spectrum(self, interval, revolutions, speed, journal_y, journal_z, journal_full, tilt)
      class(run_file_type), intent(inout) :: self
      !> Between samples, s.
      real(wp), intent(in) :: interval
      integer, intent(in) :: revolutions
      real(wp), intent(in) :: speed
      !> One-sided, at k/T; full, at k/T with k = -((n-1)/2) .. n/2; one-sided (k, pad).
      real(wp), intent(in) :: journal_y(:), journal_z(:), journal_full(:), tilt(:, :)
      real(wp) :: step
      integer :: k, n
      n = size(journal_full)
      step = 1/(n*interval)
      associate (file => self%file)
         call file%make_group('spectrum')
         call file%put_list('spectrum/frequency', [(k*step, k=0, n/2)], 'Hz', 'frequency', 'spectrum/frequency')
         call file%put_list('spectrum/order', [(k*step, k=0, n/2)]*2*pi/speed, '1', &
            & 'frequency over shaft frequency', 'spectrum/frequency')
         call file%put_list('spectrum/journal_y', journal_y, 'm', 'amplitude of journal_y', 'spectrum/frequency')
         call file%put_list('spectrum/journal_z', journal_z, 'm', 'amplitude of journal_z', 'spectrum/frequency')
         call file%put_table('spectrum/pad_tilt', tilt, 'rad', 'amplitude of pad_tilt', &
            & 'pad spectrum/frequency')
         call file%put_list('spectrum/full_frequency', [(k*step, k=-((n - 1)/2), n/2)], 'Hz', &
            & 'frequency, positive for forward whirl', 'spectrum/full_frequency')
         call file%put_list('spectrum/journal_full', journal_full, 'm', &
            & 'amplitude of journal_y + i journal_z', 'spectrum/full_frequency')
         call file%put_count('spectrum/revolutions', int(revolutions, i8), 'revolutions covered')
      end associate
   end subroutine put_spectrum

   !> Publishes what there is, with the state y at time t, s, to go on from, and goes on writing. With an exit
   !> status other than `running`, which needs its reason, that was the end.
   subroutine checkpoint(self, t, y, statistics, status, reason, error)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      type(run_statistics_type), intent(in) :: statistics
      integer, intent(in) :: status
      character(len=*), intent(in) :: reason
      type(error_type), allocatable, intent(out) :: error
      logical :: exchanged
      associate (file => self%file)
         if (.not. file%has('checkpoint')) call file%make_group('checkpoint')
         call file%put_real('checkpoint/time', t, 's', 'time from which the run can go on')
         call file%put_list('checkpoint/state', y, '1', 'state of the march at that time', '')
         call statistics%put(file)
         call self%provenance%note(file, t, status, reason)
      end associate
      call self%close_parts()
      call self%error_of(error)
      if (.not. allocated(error)) call self%place%publish(exchanged, error)
      if (.not. allocated(error) .and. status == running) call self%catch_up(exchanged, error)
      if (allocated(error) .or. status /= running) call self%abandon()
   end subroutine checkpoint

   !> Makes the part what was just published: adds the last stretch to what was published before, or, where that
   !> cannot be written (a reader has it open), copies it all.
   subroutine catch_up(self, exchanged, error)
      class(run_file_type), intent(inout) :: self
      logical, intent(in) :: exchanged
      type(error_type), allocatable, intent(out) :: error
      type(hdf5_type) :: published
      if (exchanged) then
         call self%file%open(self%place%part, writing=.true.)
         call published%open(self%place%path, writing=.false.)
         call self%table%open(self%file)
         call self%table%copy_missing(self%file, published)
         call published%close()
         if (.not. allocated(self%file%failure) .and. .not. allocated(published%failure)) return
         call self%table%close(self%file)
         call self%file%close()
      end if
      call self%place%copy_published(error)
      if (allocated(error)) return
      call self%file%open(self%place%part, writing=.true.)
      call self%table%open(self%file)
      call self%error_of(error)
   end subroutine catch_up

   !> Closes the file and puts it in its place. An exit status other than 0 needs its reason; t is the simulated
   !> time reached, s.
   subroutine finish(self, t, statistics, status, reason, error)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(in) :: t
      type(run_statistics_type), intent(in) :: statistics
      integer, intent(in) :: status
      character(len=*), intent(in) :: reason
      type(error_type), allocatable, intent(out) :: error
      logical :: exchanged
      call self%file%delete('checkpoint')
      call statistics%put(self%file)
      call self%provenance%note(self%file, t, status, reason)
      if (status == 0) call self%file%put_flag('complete', 1)
      call self%close_parts()
      call self%error_of(error)
      if (.not. allocated(error)) call self%place%publish(exchanged, error)
      call self%abandon()
   end subroutine finish

   subroutine abandon(self)
      class(run_file_type), intent(inout) :: self
      call self%table%close(self%file)
      call self%file%close()
      call self%place%release()
   end subroutine abandon

   subroutine close_parts(self)
      class(run_file_type), intent(inout) :: self
      call self%table%write(self%file)
      call self%table%close(self%file)
      call self%file%close()
   end subroutine close_parts

   subroutine beat(self, now)
      class(run_file_type), intent(inout) :: self
      integer, intent(in) :: now
      if (now == self%last_beat) return
      self%last_beat = now
      call self%place%lock%beat(now)
      call self%place%begin_sync()
   end subroutine beat

   function taken_from(self)
      class(run_file_type), intent(in) :: self
      character(len=:), allocatable :: taken_from
      taken_from = self%place%lock%taken_from
   end function taken_from

   subroutine error_of(self, error)
      class(run_file_type), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      if (allocated(self%file%failure)) call raise(error, system_error, 'cannot write '//self%place%path//': ' &
         & //self%file%failure)
   end subroutine error_of
end module run_file
