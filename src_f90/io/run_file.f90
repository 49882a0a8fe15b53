!> The result file of a run: names, dimensions and units as docs/results.md lists them.
!>
!> It is written under a temporary name beside its place and renamed when it is whole, so that a crash
!> at any moment leaves the previous file as it was.
module run_file
   use kinds, only: wp, i8, pi, degree
   use text, only: to_text
   use errors, only: error_type, raise, system_error
   use build_info, only: program_version, program_commit
   use cvode_march, only: march_statistics
   use scene, only: scene_type
   use equations_of_motion, only: bearing_model
   use equilibrium, only: equilibrium_type
   use hdf5_file, only: hdf5_type, growing_type
   use posix, only: rename_file, delete_file, process_id, real_path, is_regular
   implicit none (type, external)
   private
   public :: run_file_type, format_version

   !> Version of the names in the file.
   integer, parameter :: format_version = 1
   !> Samples held back before they are written.
   integer, parameter :: buffer_samples = 1024

   type :: series_type
      character(len=:), allocatable :: name
      type(growing_type) :: data
      real(wp), allocatable :: buffer(:, :)
   end type series_type

   type :: run_file_type
      private
      character(len=:), allocatable :: path, temporary
      type(hdf5_type) :: file
      type(series_type), allocatable :: series(:)
      integer :: filled = 0
      !> Samples added.
      integer(i8), public :: samples = 0
   contains
      procedure :: create
      procedure :: put_equilibrium
      procedure :: add_sample
      procedure :: last_samples
      procedure :: put_spectrum
      procedure :: put_statistics
      procedure :: finish
      !> Closes and deletes the temporary file.
      procedure :: abandon
      procedure, private :: write_buffers
      procedure, private :: error_of
   end type run_file_type

contains

   !> Starts the file of a scene; `input` is its resolved namelist.
   subroutine create(self, path, scene, input, error)
      class(run_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path, input
      type(scene_type), intent(in) :: scene
      type(error_type), allocatable, intent(out) :: error
      character(len=200) :: message
      integer :: unit, status, i, clock(8)
      character(len=25) :: created
      logical :: exists, regular
      ! a link is followed, so that its target is replaced and not the link
      self%path = real_path(path)
      self%temporary = self%path//'.part'//to_text(int(process_id()))
      inquire (file=self%path//'/.', exist=exists)
      if (.not. exists) inquire (file=self%path, exist=exists)
      regular = is_regular(self%path)
      if (exists .and. .not. regular) then
         call raise(error, system_error, 'cannot write '//path//': it is a directory, device or pipe')
         return
      end if
      ! the system says better than HDF5 why a file cannot be made
      open (newunit=unit, file=self%temporary, status='replace', action='write', iostat=status, iomsg=message)
      if (status /= 0) then
         call raise(error, system_error, 'cannot write '//path//': '//reason(message))
         return
      end if
      close (unit)
      call date_and_time(values=clock)
      write (created, '(i4.4,2("-",i2.2),"T",i2.2,2(":",i2.2),sp,i3.2,":",ss,i2.2)') clock(1:3), clock(5:7), &
         & clock(4)/60, mod(abs(clock(4)), 60)
      allocate (self%series(0))
      call self%file%create(self%temporary)
      call self%file%put_flag('format_version', format_version)
      call self%file%put_text('program', 'tiltpad')
      call self%file%put_text('version', program_version)
      call self%file%put_text('commit', program_commit)
      call self%file%put_text('created', created)
      call self%file%put_text('title', scene%about%title)
      call self%file%put_text('task', scene%about%task)
      call self%file%put_flag('complete', 0)
      call self%file%put_text('input', input)
      call self%file%put_list('pad', [(real(i, wp), i=1, scene%pad_count())], '1', 'pad number', 'pad')
      call self%file%put_list('pivot_angle', scene%pads%pivot_angle_deg*degree, 'rad', &
         & 'pivot angle', 'pad')
      call self%error_of(error)
      if (allocated(error)) call self%abandon()
   end subroutine create

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
      integer :: k, n
      k = 0
      n = size(model%places)
      if (self%filled == buffer_samples) call self%write_buffers()
      self%filled = self%filled + 1
      self%samples = self%samples + 1
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
         call next(name, [value], 0, units, long_name)
      end subroutine one

      subroutine each(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(:)
         call next(name, values, n, units, long_name)
      end subroutine each

      !> The k-th series; made when its first sample comes.
      subroutine next(name, values, width, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(:)
         integer, intent(in) :: width
         type(series_type) :: new
         character(len=:), allocatable :: scales
         k = k + 1
         if (k > size(self%series)) then
            new%name = name
            allocate (new%buffer(size(values), buffer_samples))
            scales = 'time'
            if (width > 0) scales = 'time pad'
            call self%file%make_growing(name, width, units, long_name, scales, new%data)
            self%series = [self%series, new]
         end if
         self%series(k)%buffer(:, self%filled) = values
      end subroutine next
   end subroutine add_sample

   subroutine write_buffers(self)
      class(run_file_type), intent(inout) :: self
      integer :: k
      do k = 1, size(self%series)
         call self%file%append(self%series(k)%data, self%series(k)%buffer(:, :self%filled))
      end do
      self%filled = 0
   end subroutine write_buffers

   !> The last n samples of a series, (width, n); n at most the samples there are.
   subroutine last_samples(self, name, n, values)
      class(run_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      integer :: k
      call self%write_buffers()
      do k = 1, size(self%series)
         if (self%series(k)%name == name) call self%file%read_tail(self%series(k)%data, n, values)
      end do
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

   subroutine put_statistics(self, march, model, observer_seconds, wall_seconds)
      class(run_file_type), intent(inout) :: self
      type(march_statistics), intent(in) :: march
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: observer_seconds, wall_seconds
      associate (file => self%file, film => model%film%counters)
         call file%make_group('statistics')
         call file%put_count('statistics/steps', march%steps, 'time steps')
         call file%put_count('statistics/rhs_evaluations', march%rhs_evaluations, 'right-hand sides')
         call file%put_count('statistics/jacobian_evaluations', march%jacobian_evaluations, 'Jacobians')
         call file%put_count('statistics/error_test_failures', march%error_test_failures, &
            & 'steps refused by the error test')
         call file%put_count('statistics/convergence_failures', march%convergence_failures, &
            & 'Newton iterations that failed')
         call file%put_count('statistics/film_modal', film%modal, 'pads solved by axial modes in the march')
         call file%put_count('statistics/film_sor', film%sor, 'pads solved on finite volumes in the march')
         call file%put_count('statistics/sor_sweeps', film%sweeps, &
            & 'sweeps of over-relaxation, or eliminations, in the march')
         call file%put_real('statistics/film_seconds', model%film_seconds, 's', 'wall time of the film in the march')
         call file%put_real('statistics/output_seconds', observer_seconds, 's', 'wall time of sampling')
         call file%put_real('statistics/wall_seconds', wall_seconds, 's', 'wall time of the run')
      end associate
   end subroutine put_statistics

   !> Closes the file and puts it in its place.
   subroutine finish(self, complete, error)
      class(run_file_type), intent(inout) :: self
      logical, intent(in) :: complete
      type(error_type), allocatable, intent(out) :: error
      integer :: k
      call self%write_buffers()
      do k = 1, size(self%series)
         call self%file%close_growing(self%series(k)%data)
      end do
      if (complete) call self%file%put_flag('complete', 1)
      call self%file%close()
      if (.not. allocated(self%file%failure)) then
         if (.not. rename_file(self%temporary, self%path)) call raise(error, system_error, &
            & 'cannot rename the result to '//self%path//'; it is in '//self%temporary)
         return
      end if
      call self%error_of(error)
      call delete_file(self%temporary)
   end subroutine finish

   subroutine abandon(self)
      class(run_file_type), intent(inout) :: self
      integer :: k
      do k = 1, size(self%series)
         call self%file%close_growing(self%series(k)%data)
      end do
      call self%file%close()
      call delete_file(self%temporary)
   end subroutine abandon

   subroutine error_of(self, error)
      class(run_file_type), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      if (allocated(self%file%failure)) call raise(error, system_error, 'cannot write '//self%path//': ' &
         & //self%file%failure//' (disk full, quota, or no permission?)')
   end subroutine error_of

   !> The last part of a system message, behind its last colon.
   pure function reason(message)
      character(len=*), intent(in) :: message
      character(len=:), allocatable :: reason
      reason = trim(adjustl(message(index(trim(message), ':', back=.true.) + 1:)))
   end function reason
end module run_file
