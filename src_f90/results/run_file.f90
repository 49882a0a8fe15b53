!> The result file of a run: names, dimensions and units as docs/results.md lists them.
module run_file
   use kinds, only: wp, i8, pi, degree
   use errors, only: error_type
   use scene, only: scene_type
   use equations_of_motion, only: bearing_model
   use equilibrium, only: equilibrium_type
   use growing_file, only: growing_file_type
   implicit none (type, external)
   private
   public :: run_file_type, format_version

   !> Version of the names in the file.
   integer, parameter :: format_version = 1

   type, extends(growing_file_type) :: run_file_type
   contains
      procedure :: create
      procedure :: put_member
      procedure :: put_equilibrium
      procedure :: add_sample
      procedure :: put_spectrum
   end type run_file_type

contains

   !> Starts the file of a scene in the place claimed; `input` is its resolved namelist.
   subroutine create(self, scene, input, error)
      class(run_file_type), intent(inout) :: self
      character(len=*), intent(in) :: input
      type(scene_type), intent(in) :: scene
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      call self%begin()
      associate (file => self%file)
         call file%put_flag('format_version', format_version)
         call file%put_text('title', scene%about%title)
         call file%put_text('task', scene%about%task)
         call file%put_text('input', input)
         call file%put_list('pad', [(real(i, wp), i=1, scene%pad_count())], '1', 'pad number', 'pad')
         call file%put_list('pivot_angle', scene%pads%pivot_angle_deg*degree, 'rad', 'pivot angle', 'pad')
      end associate
      call self%error_of(error)
      if (allocated(error)) call self%abandon()
   end subroutine create

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
end module run_file
