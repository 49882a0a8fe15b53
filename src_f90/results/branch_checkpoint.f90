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
      integer :: k
      call file%put_count('checkpoint/branch', int(branches%branch, i8), 'number of the branch that is followed')
      call file%put_count('checkpoint/points', int(branches%points, i8), 'its points so far')
      call file%put_real('checkpoint/step', branches%length, '1', 'length of its next step')
      if (size(special) > 0) call file%put_list('checkpoint/special_kinds', real(special%kind, wp), '1', &
         & 'kind of each bifurcation point: number in the list of all kinds', '')
      call put_point(file, 'checkpoint/point', branches, branches%here)
      do k = 1, size(branches%period_doublings)
         call put_point(file, doubling_name(k), branches, branches%period_doublings(k))
      end do
   end subroutine put_branches

   !> The group of a period doubling from which a branch is still to be followed.
   function doubling_name(k) result(name)
      integer, intent(in) :: k
      character(len=:), allocatable :: name
      name = 'checkpoint/flip_'//to_text(k)
   end function doubling_name

   subroutine put_point(file, group, branches, point)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: group
      type(branch_progress_type), intent(in) :: branches
      type(branch_point_type), intent(in) :: point
      character(len=:), allocatable :: units
      integer :: k
      call file%put_real(group//'/value', point%parameter, branches%parameter%unit, branches%parameter%meaning)
      call file%put_real(group//'/arc_length', point%arc_length, '1', 'length of the branch up to the point')
      call file%put_real(group//'/along', point%along, '1', 'length of the step to it')
      call put('change', point%change, '1', 'correction from where the equations were linearised')
      call put('tangent', point%tangent, '1', 'unit tangent of the branch')
      call put('growth', point%growth, '1', 'how far each eigenvalue or multiplier is on the unstable side')
      do k = 1, size(point%place)
         associate (part => point%place(k))
            units = trim(part%units)
            if (units == '') units = branches%parameter%unit
            call put(trim(part%name), part%values, units, trim(part%long_name))
         end associate
      end do
   contains
      subroutine put(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(:)
         if (size(values) > 0) call file%put_list(group//'/'//name, values, units, long_name, '')
      end subroutine put
   end subroutine put_point

   !> The same of branches that are ready to go on. An error where the file holds none of these numbers; `ok` is false
   !> where they cannot be a checkpoint.
   subroutine get_branches(file, path, branches, special, ok, error)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: path
      type(branch_progress_type), intent(inout) :: branches
      type(noted_point_type), allocatable, intent(out) :: special(:)
      logical, intent(out) :: ok
      type(error_type), allocatable, intent(out) :: error
      type(branch_point_type) :: period_doubling
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
      if (ok) call get_point(file, 'checkpoint/point', branches, branches%here, ok)
      if (.not. ok) return
      do while (file%has(doubling_name(size(branches%period_doublings) + 1)))
         call get_point(file, doubling_name(size(branches%period_doublings) + 1), branches, period_doubling, ok)
         if (.not. ok) return
         branches%period_doublings = [branches%period_doublings, period_doubling]
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
      kind = list(file, 'checkpoint/special_kinds')
      point = list(file, 'bifurcations/point')
      branch = list(file, 'bifurcations/branch')
      parameter = list(file, 'bifurcations/parameter')
      re = list(file, 'bifurcations/value_real')
      im = list(file, 'bifurcations/value_imag')
      ok = all([size(point), size(branch), size(parameter), size(re), size(im)] == size(kind))
      if (ok) ok = all(kind >= 1 .and. kind <= size(kinds_of_points)) .and. all(abs([point, branch]) < huge(1))
      if (ok) special = [(noted_point_type(nint(point(k)), nint(kind(k)), nint(branch(k)), parameter(k), &
         & cmplx(re(k), im(k), wp)), k=1, size(kind))]
   end subroutine get_special

   subroutine get_point(file, group, branches, point, ok)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: group
      type(branch_progress_type), intent(in) :: branches
      type(branch_point_type), intent(out) :: point
      logical, intent(out) :: ok
      integer :: k
      point%parameter = file%get_real(group//'/value')
      point%arc_length = file%get_real(group//'/arc_length')
      point%along = file%get_real(group//'/along')
      point%change = list(file, group//'/change')
      point%tangent = list(file, group//'/tangent')
      point%growth = list(file, group//'/growth')
      call branches%problem%get_place(point%place)
      ok = all(ieee_is_finite([point%parameter, point%arc_length, point%along, point%change, point%tangent, &
         & point%growth]))
      do k = 1, size(point%place)
         point%place(k)%values = list(file, group//'/'//trim(point%place(k)%name))
         ok = ok .and. all(ieee_is_finite(point%place(k)%values))
      end do
   end subroutine get_point

   !> A list of a file; empty where it has none of this name, as lists of no numbers are not written.
   function list(file, path)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: path
      real(wp), allocatable :: list(:)
      list = [real(wp) ::]
      if (.not. file%has(path)) return
      deallocate (list)
      allocate (list(file%list_size(path)))
      call file%get_list(path, list)
   end function list
end module branch_checkpoint
