!> The checkpoint of a run of branches in its file: from it they go on to the last bit.
module branch_checkpoint
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type, raise, system_error
   use newton_method, only: branch_point_type
   use bifurcations, only: kinds_of_points
   use branch_progress, only: branch_progress_type
   use branch_results, only: noted_point_type
   use record, only: record_type
   implicit none (type, external)
   private
   public :: put_branches, get_branches

contains

   !> Into the group of the checkpoint, which is there; the file has the bifurcation points, too.
   subroutine put_branches(file, branches, special)
      class(record_type), intent(inout) :: file
      type(branch_progress_type), intent(in) :: branches
      type(noted_point_type), intent(in) :: special(:)
      type(branch_point_type) :: point
      logical :: ok
      integer :: k
      call file%put('checkpoint/branch', int(branches%branch, i8), 'number of the branch that is followed')
      call file%put('checkpoint/points', int(branches%points, i8), 'its points so far')
      call file%put('checkpoint/step', branches%length, '1', 'length of its next step')
      if (size(special) > 0) call file%put('checkpoint/special_kinds', real(special%kind, wp), '1', &
         & 'kind of each bifurcation point: number in the list of all kinds')
      point = branches%here
      call pass_point(file, 'checkpoint/point', branches, point, .false., ok)
      do k = 1, size(branches%period_doublings)
         point = branches%period_doublings(k)
         call pass_point(file, doubling_name(k), branches, point, .false., ok)
      end do
   end subroutine put_branches

   !> The group of a period doubling from which a branch is still to be followed.
   function doubling_name(k) result(name)
      integer, intent(in) :: k
      character(len=:), allocatable :: name
      name = 'checkpoint/flip_'//to_text(k)
   end function doubling_name

   !> A point, into a group or, with `reading`, out of it: the one list of what is kept of it. `ok` becomes false where
   !> a number that was read is none.
   subroutine pass_point(file, group, branches, point, reading, ok)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: group
      type(branch_progress_type), intent(in) :: branches
      type(branch_point_type), intent(inout) :: point
      logical, intent(in) :: reading
      logical, intent(inout) :: ok
      character(len=:), allocatable :: units
      integer :: k
      call number('value', point%parameter, branches%parameter%unit, branches%parameter%meaning)
      call number('arc_length', point%arc_length, '1', 'length of the branch up to the point')
      call number('along', point%along, '1', 'length of the step to it')
      call numbers('change', point%change, '1', 'correction from where the equations were linearised')
      call numbers('tangent', point%tangent, '1', 'unit tangent of the branch')
      call numbers('growth', point%growth, '1', 'how far each eigenvalue or multiplier is on the unstable side')
      if (reading) call branches%problem%get_place(point%place)
      do k = 1, size(point%place)
         associate (part => point%place(k))
            units = trim(part%units)
            if (units == '') units = branches%parameter%unit
            call numbers(trim(part%name), part%values, units, trim(part%long_name))
         end associate
      end do
   contains
      subroutine number(name, value, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(inout) :: value
         if (reading) then
            value = file%get_real(group//'/'//name)
            ok = ok .and. ieee_is_finite(value)
         else
            call file%put(group//'/'//name, value, units, long_name)
         end if
      end subroutine number

      subroutine numbers(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), allocatable, intent(inout) :: values(:)
         if (reading) then
            values = file%get_all(group//'/'//name)
            ok = ok .and. all(ieee_is_finite(values))
         else if (size(values) > 0) then
            call file%put(group//'/'//name, values, units, long_name)
         end if
      end subroutine numbers
   end subroutine pass_point

   !> The same of branches that are ready to go on. An error where the file holds none of these numbers; `ok` is false
   !> where they cannot be a checkpoint.
   subroutine get_branches(file, path, branches, special, ok, error)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: path
      type(branch_progress_type), intent(inout) :: branches
      type(noted_point_type), allocatable, intent(out) :: special(:)
      logical, intent(out) :: ok
      type(error_type), allocatable, intent(out) :: error
      type(branch_point_type) :: point
      character(len=:), allocatable :: group
      ok = .false.
      if (.not. file%has('checkpoint/point')) then
         call raise(error, system_error, path//': its checkpoint is of another version of tiltpad; start the run anew')
         return
      end if
      branches%branch = nint(file%get_real('checkpoint/branch'))
      branches%points = nint(file%get_real('checkpoint/points'))
      branches%length = file%get_real('checkpoint/step')
      call get_special(file, special, ok)
      if (.not. file%has('checkpoint/step')) ok = .false.
      ok = ok .and. branches%branch > 0 .and. branches%points >= 0 .and. ieee_is_finite(branches%length)
      if (ok) call pass_point(file, 'checkpoint/point', branches, point, .true., ok)
      if (.not. ok) return
      branches%here = point
      do
         group = doubling_name(size(branches%period_doublings) + 1)
         if (.not. file%has(group)) exit
         call pass_point(file, group, branches, point, .true., ok)
         if (.not. ok) return
         branches%period_doublings = [branches%period_doublings, point]
      end do
   end subroutine get_branches

   subroutine get_special(file, special, ok)
      class(record_type), intent(inout) :: file
      type(noted_point_type), allocatable, intent(out) :: special(:)
      logical, intent(out) :: ok
      real(wp), allocatable, dimension(:) :: kind, point, branch, parameter, re, im
      integer :: k
      ok = .true.
      allocate (special(0))
      if (.not. file%has('checkpoint/special_kinds')) return
      kind = file%get_all('checkpoint/special_kinds')
      point = file%get_all('bifurcations/point')
      branch = file%get_all('bifurcations/branch')
      parameter = file%get_all('bifurcations/parameter')
      re = file%get_all('bifurcations/value_real')
      im = file%get_all('bifurcations/value_imag')
      ok = all([size(point), size(branch), size(parameter), size(re), size(im)] == size(kind))
      if (ok) ok = all(kind >= 1 .and. kind <= size(kinds_of_points)) .and. all(abs([point, branch]) < huge(1))
      if (ok) special = [(noted_point_type(nint(point(k)), nint(kind(k)), nint(branch(k)), parameter(k), &
         & cmplx(re(k), im(k), wp)), k=1, size(kind))]
   end subroutine get_special
end module branch_checkpoint
