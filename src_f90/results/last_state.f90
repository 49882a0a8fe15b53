!> The states in the samples of a result, and the last one of another result, from which a march may start.
module last_state
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, i8, pi
   use text, only: to_text
   use errors, only: error_type, raise, system_error
   use hdf5_file, only: hdf5_type
   use hdf5_series, only: hdf5_series_type
   use abstract_rotor, only: journal_motion
   use kinematics, only: pad_state
   use state_layout, only: pads_layout_type
   use restart, only: restart_type, read_result, open_result
   implicit none (type, external)
   private
   public :: read_last_state, read_states, all_finite

   !> Part of a turn within which samples count as equally close to a whole one.
   real(wp), parameter :: same_angle = 1e-6_wp

contains

   !> The motion of the journal and the states of the pads in the last sample of a result at which the shaft had turned
   !> whole revolutions, as closely as samples are: so the unbalance goes on from where it was. The result must have
   !> the states of this layout.
   subroutine read_last_state(path, layout, journal, pads, error)
      character(len=*), intent(in) :: path
      type(pads_layout_type), intent(in) :: layout
      type(journal_motion), intent(inout) :: journal
      type(pad_state), intent(inout) :: pads(:)
      type(error_type), allocatable, intent(out) :: error
      type(restart_type) :: found
      type(hdf5_type) :: file
      integer(i8) :: at
      call read_result(path, found, error)
      if (.not. allocated(error)) call open_result(path, file, error)
      if (allocated(error)) return
      call refuse_other_states(path, file, found, layout, error)
      if (.not. allocated(error)) then
         at = last_whole_turn(file, found%inputs%output%samples_per_revolution)
         call read_states(file, layout, at, journal, pads)
         if (allocated(file%failure)) call raise(error, system_error, path//': damaged: '//file%failure)
      end if
      call file%close()
      if (.not. allocated(error) .and. .not. all_finite(journal, pads)) call raise(error, system_error, path &
         & //': damaged: its last state is not a number')
   end subroutine read_last_state

   !> Refuses a result without samples, or whose pads have other states.
   subroutine refuse_other_states(path, file, found, layout, error)
      character(len=*), intent(in) :: path
      class(hdf5_type), intent(inout) :: file
      type(restart_type), intent(in) :: found
      type(pads_layout_type), intent(in) :: layout
      type(error_type), allocatable, intent(out) :: error
      type(hdf5_series_type) :: time
      logical :: bristles
      bristles = found%inputs%friction%model == 'lugre'
      if (found%inputs%pad_count() /= layout%pads) then
         call raise(error, system_error, path//': has '//to_text(found%inputs%pad_count())//' pads, and this case ' &
            & //to_text(layout%pads)//'; no start for it')
      else if (any([found%inputs%tilting(), found%inputs%tilting_radial()] .neqv. [layout%tilting, layout%radial])) then
         call raise(error, system_error, path//': has pads%motion = '''//found%inputs%pads%motion &
            & //''', and this case another; no start for it')
      else if (bristles .neqv. layout%bristles) then
         call raise(error, system_error, path//': has friction%model = '''//found%inputs%friction%model//''', which ' &
            & //trim(merge('has   ', 'has no', bristles))//' bristle deflections; no start for this case')
      else
         if (file%has('time')) then
            call time%open(file, 'time')
            call time%close(file)
         end if
         if (time%length == 0) call raise(error, system_error, path//': has no samples of a motion to start from')
      end if
   end subroutine refuse_other_states

   !> Number of the sample, from 0, in which the shaft has turned whole revolutions, of the last revolution.
   integer(i8) function last_whole_turn(file, samples_per_revolution) result(at)
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: samples_per_revolution
      type(hdf5_series_type) :: series
      real(wp), allocatable :: angle(:, :), revolutions(:), beside(:)
      integer :: n
      at = 0
      call series%open(file, 'shaft_angle')
      n = int(min(int(samples_per_revolution, i8), series%length))
      call series%read(file, series%length - n, n, angle)
      call series%close(file)
      if (allocated(file%failure)) return
      if (n == 0 .or. .not. all(ieee_is_finite(angle))) then
         call file%check_read(-1, 'read shaft_angle')
         return
      end if
      revolutions = angle(1, :)/(2*pi)
      beside = abs(revolutions - anint(revolutions))
      at = series%length - n + findloc(beside <= minval(beside) + same_angle, .true., dim=1, back=.true.) - 1
   end function last_whole_turn

   !> The states in a sample; the file keeps a failure where one is not there.
   subroutine read_states(file, layout, at, journal, pads)
      class(hdf5_type), intent(inout) :: file
      type(pads_layout_type), intent(in) :: layout
      integer(i8), intent(in) :: at
      type(journal_motion), intent(inout) :: journal
      type(pad_state), intent(inout) :: pads(:)
      real(wp) :: one(1)
      call read_one('journal_y', one)
      journal%position(1) = one(1)
      call read_one('journal_z', one)
      journal%position(2) = one(1)
      call read_one('journal_vy', one)
      journal%velocity(1) = one(1)
      call read_one('journal_vz', one)
      journal%velocity(2) = one(1)
      if (layout%tilting) call read_one('pad_tilt', pads%tilt)
      if (layout%tilting) call read_one('pad_tilt_rate', pads%tilt_rate)
      if (layout%radial) call read_one('pivot_deflection', pads%pivot_deflection)
      if (layout%radial) call read_one('pivot_deflection_rate', pads%pivot_deflection_rate)
      if (layout%bristles) call read_one('bristle_deflection', pads%deflection)
   contains
      !> The values of a series in the sample.
      subroutine read_one(name, values)
         character(len=*), intent(in) :: name
         real(wp), intent(inout) :: values(:)
         type(hdf5_series_type) :: series
         real(wp), allocatable :: found(:, :)
         call series%open(file, name)
         if (.not. allocated(file%failure)) then
            if (series%width /= size(values) .or. series%length <= at) call file%check_read(-1, 'find '//name)
         end if
         call series%read(file, at, 1, found)
         call series%close(file)
         if (.not. allocated(file%failure)) values = found(:, 1)
      end subroutine read_one
   end subroutine read_states

   pure logical function all_finite(journal, pads)
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      all_finite = all(ieee_is_finite([journal%position, journal%velocity, pads%tilt, pads%tilt_rate, &
         & pads%pivot_deflection, pads%pivot_deflection_rate, pads%deflection]))
   end function all_finite
end module last_state
