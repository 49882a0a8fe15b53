!> The states in the samples of a result, and the last one of another result, from which a march may start.
module last_state
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, i8, pi
   use text, only: to_text
   use errors, only: error_type, raise, system_error
   use growing_file, only: growing_file_type
   use case_groups, only: bearing_type, mount_type
   use case_inputs, only: case_type
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, element_layout_type
   use tilting_pad, only: pad_coordinates_type, new_pad_coordinates
   use equations_of_motion, only: machine_model
   use machine_results, only: bearing_group, turned_time, turned_state, mode_signs, other_signs
   use restart, only: restart_type, read_result, open_result
   implicit none (type, external)
   private
   public :: read_last_state, read_states, all_finite

   !> Part of a turn within which samples count as equally close to a whole one.
   real(wp), parameter :: same_angle = 1e-6_wp

contains

   !> The states of rotor and pads in the last sample of a result at which the shaft had turned whole revolutions, as
   !> closely as samples are: so the unbalance goes on from where it was. The result must have the states of this case
   !> and its model; of the modes of a shaft it may have fewer or more.
   subroutine read_last_state(path, inputs, model, rotor, pads, error)
      character(len=*), intent(in) :: path
      type(case_type), intent(in) :: inputs
      type(machine_model), intent(in) :: model
      !> Displacements of the rotor, then their rates; states of the pads of all bearings.
      real(wp), intent(out) :: rotor(:)
      type(pad_state), intent(inout) :: pads(:)
      type(error_type), allocatable, intent(out) :: error
      type(restart_type) :: found
      type(growing_file_type) :: file
      type(journal_motion) :: journal
      integer(i8) :: at
      integer :: b
      rotor = 0
      call read_result(path, found, error, texts_alone=.false.)
      if (.not. allocated(error)) call open_result(path, file, error)
      if (allocated(error)) return
      call refuse_other_rotor(path, found%inputs, inputs, error)
      do b = 1, size(model%bearings)
         if (.not. allocated(error)) call refuse_other_pads(path, found%inputs%bearings(b), model%layout%elements(b), &
            & error)
      end do
      if (.not. (allocated(error) .or. inputs%rotor%is_rigid())) then
         if (.not. file%has(mode_signs)) call raise(error, system_error, path//': '//other_signs)
      end if
      call file%begin_series('time', 0_i8)
      if (.not. allocated(error) .and. file%samples == 0) call raise(error, system_error, path//': has no samples of ' &
         & //'a motion to start from')
      if (.not. allocated(error)) then
         at = last_whole_turn(file, found%inputs%output%samples_per_revolution)
         do b = 1, size(model%bearings)
            associate (own => model%layout%elements(b))
               call read_states(file, bearing_group(inputs%bearings(b)), model%bearings(b)%coordinates, own%bristles, &
                  & at, journal, pads(own%first_pad:own%last_pad))
            end associate
         end do
         if (inputs%rotor%is_rigid()) then
            rotor = [journal%position, journal%velocity]
         else
            call read_turned_rotor(file, 2*model%rotor%journals, at, rotor)
         end if
         if (allocated(file%failure)) call raise(error, system_error, path//': damaged: '//file%failure)
      end if
      call file%close()
      if (allocated(error) .or. all(ieee_is_finite(rotor)) .and. all_finite(journal, pads)) return
      call raise(error, system_error, path//': damaged: its last state is not a number')
   end subroutine read_last_state

   !> Refuses a rotor whose displacements are others: in other bearings, or on other supports.
   subroutine refuse_other_rotor(path, there, here, error)
      character(len=*), intent(in) :: path
      type(case_type), intent(in) :: there, here
      type(error_type), allocatable, intent(out) :: error
      type(mount_type), allocatable :: mounts(:), others(:)
      integer :: b
      if (there%operation%rotation /= here%operation%rotation) then
         call raise(error, system_error, path//': its shaft turns '//there%operation%rotation &
            & //', and that of this case '//here%operation%rotation//'; no start for it')
         return
      end if
      mounts = here%mounts()
      others = there%mounts()
      if (size(others) /= size(mounts)) then
         call raise(error, system_error, path//': has '//rotor_text(there)//', and this case '//rotor_text(here) &
            & //'; no start for it')
         return
      end if
      do b = 1, size(mounts)
         associate (one => others(b), own => mounts(b))
            if (one%name /= own%name) then
               call raise(error, system_error, path//': has the bearing '//one%name//' where this case has '//own%name &
                  & //'; no start for it')
            else if (one%kind /= own%kind) then
               call raise(error, system_error, path//': the bearing '//one%name//' has kind = '''//one%kind//''' ' &
                  & //'there and '''//own%kind//''' in this case; no start for it')
            else if (allocated(one%support) .neqv. allocated(own%support)) then
               call raise(error, system_error, path//': the bearing '//own%name//' stands on a support there or in ' &
                  & //'this case, not in both; no start for it')
            end if
         end associate
         if (allocated(error)) return
      end do
   end subroutine refuse_other_rotor

   pure function rotor_text(inputs) result(text)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: text
      text = 'a rigid journal in one bearing'
      if (.not. inputs%rotor%is_rigid()) text = 'a shaft in '//to_text(size(inputs%mounts()))//' bearings'
   end function rotor_text

   !> Refuses the result of a bearing whose pads have other states.
   subroutine refuse_other_pads(path, there, layout, error)
      character(len=*), intent(in) :: path
      type(bearing_type), intent(in) :: there
      type(element_layout_type), intent(in) :: layout
      type(error_type), allocatable, intent(out) :: error
      type(pad_coordinates_type) :: coordinates
      logical :: bristles
      integer :: k
      bristles = there%friction%model == 'lugre'
      coordinates = new_pad_coordinates(there%pads%motion)
      if (there%pad_count() /= layout%pads) then
         call raise(error, system_error, path//': has '//to_text(there%pad_count())//' pads, and this case ' &
            & //to_text(layout%pads)//'; no start for it')
      else if (coordinates%n /= layout%coordinates .or. &
         & .not. all([(layout%has(coordinates%kind(k)), k=1, coordinates%n)])) then
         call raise(error, system_error, path//': has pads%motion = '''//there%pads%motion &
            & //''', and this case another; no start for it')
      else if (bristles .neqv. layout%bristles) then
         call raise(error, system_error, path//': has friction%model = '''//there%friction%model//''', which ' &
            & //trim(merge('has   ', 'has no', bristles))//' bristle deflections; no start for this case')
      end if
   end subroutine refuse_other_pads

   !> The states of the rotor of a machine, kept where the shaft had turned whole revolutions, and the number, from 0,
   !> of this sample. Behind the first displacements, `fixed` in number and those of supports, stand the modes: those
   !> that are not in the file stay 0, and those that the case does not have are left out.
   subroutine read_turned_rotor(file, fixed, at, rotor)
      class(growing_file_type), intent(inout) :: file
      integer, intent(in) :: fixed
      integer(i8), intent(out) :: at
      real(wp), intent(inout) :: rotor(:)
      real(wp), allocatable :: time(:, :), found(:)
      real(wp) :: turned
      integer :: own, other, both
      at = 0
      call file%get_list(turned_state, found)
      other = size(found)/2
      if (other < fixed) call file%check_read(-1, 'read '//turned_state)
      if (allocated(file%failure)) return
      turned = file%get_real(turned_time)
      call file%part_of_samples('time', 0_i8, int(file%samples), time)
      if (allocated(file%failure)) return
      at = minloc(abs(time(1, :) - turned), dim=1) - 1
      own = size(rotor)/2
      both = min(own, other)
      rotor(:both) = found(:both)
      rotor(own + 1:own + both) = found(other + 1:other + both)
   end subroutine read_turned_rotor

   !> Number of the sample, from 0, in which the shaft has turned whole revolutions, of the last revolution.
   integer(i8) function last_whole_turn(file, samples_per_revolution) result(at)
      class(growing_file_type), intent(inout) :: file
      integer, intent(in) :: samples_per_revolution
      real(wp), allocatable :: angle(:, :), revolutions(:), beside(:)
      integer :: n
      at = 0
      n = int(min(int(samples_per_revolution, i8), file%samples))
      call file%last_samples('shaft_angle', n, angle)
      if (allocated(file%failure)) return
      if (n == 0 .or. .not. all(ieee_is_finite(angle))) then
         call file%check_read(-1, 'read shaft_angle')
         return
      end if
      revolutions = angle(1, :)/(2*pi)
      beside = abs(revolutions - anint(revolutions))
      at = file%samples - n + findloc(beside <= minval(beside) + same_angle, .true., dim=1, back=.true.) - 1
   end function last_whole_turn

   !> The states in a sample of the bearing of a group; the file keeps a failure where one is not there.
   subroutine read_states(file, group, coordinates, bristles, at, journal, pads)
      class(growing_file_type), intent(inout) :: file
      character(len=*), intent(in) :: group
      !> What its pads do, and whether they have bristles.
      class(pad_coordinates_type), intent(in) :: coordinates
      logical, intent(in) :: bristles
      integer(i8), intent(in) :: at
      type(journal_motion), intent(inout) :: journal
      type(pad_state), intent(inout) :: pads(:)
      integer :: k
      call read_one('journal_y', journal%position(1:1))
      call read_one('journal_z', journal%position(2:2))
      call read_one('journal_vy', journal%velocity(1:1))
      call read_one('journal_vz', journal%velocity(2:2))
      do k = 1, coordinates%n
         associate (of => coordinates%words(k), kind => coordinates%kind(k))
            call read_one(trim(of%series), pads%x(kind))
            call read_one(trim(of%series)//'_rate', pads%v(kind))
         end associate
      end do
      do k = 1, merge(coordinates%rotations, 0, bristles)
         call read_one(coordinates%bristle_series(k), pads%bristle(k))
      end do
   contains
      !> The values of a series in the sample.
      subroutine read_one(name, values)
         character(len=*), intent(in) :: name
         real(wp), intent(inout) :: values(:)
         real(wp), allocatable :: found(:, :)
         call file%part_of_samples(group//name, at, 1, found)
         if (size(found, 1) /= size(values)) call file%check_read(-1, 'find '//name)
         if (.not. allocated(file%failure)) values = found(:, 1)
      end subroutine read_one
   end subroutine read_states

   pure logical function all_finite(journal, pads)
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      integer :: i
      all_finite = all(ieee_is_finite([journal%position, journal%velocity, [(pads(i)%x, pads(i)%v, i=1, size(pads))], &
         & [(pads(i)%bristle, i=1, size(pads))]]))
   end function all_finite
end module last_state
