!> How far a run of branches has come, as numbers that a checkpoint keeps: from them it goes on to the last bit.
module branch_course
   use kinds, only: wp
   use newton_method, only: branch_point_type
   use special_points, only: kinds_of_points
   use branch_results, only: noted_point_type
   implicit none (type, external)
   private
   public :: branch_course_type

   type :: branch_course_type
      !> Number of the branch that is followed, and of its points; the length of the next step.
      integer :: branch = 1, points = 0
      real(wp) :: length = 0
      type(branch_point_type) :: here
      type(noted_point_type), allocatable :: special(:)
      !> Flips from which branches are still to be followed.
      type(branch_point_type), allocatable :: flips(:)
      !> Where and why branches have ended, a line for each; the file has it as a text.
      character(len=:), allocatable :: ends
   contains
      procedure :: packed
      procedure :: unpack_from
   end type branch_course_type

contains

   !> All but the text as numbers.
   function packed(self) result(numbers)
      class(branch_course_type), intent(in) :: self
      real(wp), allocatable :: numbers(:)
      integer :: k
      numbers = [real([self%branch, self%points], wp), self%length, real([size(self%special), size(self%flips)], wp)]
      do k = 1, size(self%special)
         associate (s => self%special(k))
            numbers = [numbers, real([s%point, s%kind, s%branch], wp), s%parameter, s%value%re, s%value%im]
         end associate
      end do
      numbers = [numbers, of_point(self%here)]
      do k = 1, size(self%flips)
         numbers = [numbers, of_point(self%flips(k))]
      end do
   end function packed

   pure function of_point(point) result(numbers)
      type(branch_point_type), intent(in) :: point
      real(wp), allocatable :: numbers(:)
      numbers = [point%parameter, point%arc_length, point%along, real([size(point%place), size(point%tangent), &
         & size(point%growth)], wp), point%place, point%change, point%tangent, point%growth]
   end function of_point

   !> The same from such numbers. `ok` is false where they are none.
   subroutine unpack_from(self, numbers, ok)
      class(branch_course_type), intent(out) :: self
      real(wp), intent(in) :: numbers(:)
      logical, intent(out) :: ok
      integer :: o, k, special, flips
      ok = size(numbers) >= 5
      if (.not. ok) return
      self%branch = nint(numbers(1))
      self%points = nint(numbers(2))
      self%length = numbers(3)
      ok = all(numbers(4:5) >= 0) .and. 6*numbers(4) + numbers(5) <= size(numbers)
      if (.not. ok) return
      special = nint(numbers(4))
      flips = nint(numbers(5))
      allocate (self%special(special), self%flips(flips))
      o = 5
      do k = 1, special
         associate (n => numbers(o + 1:o + 6))
            self%special(k) = noted_point_type(nint(n(1)), nint(n(2)), nint(n(3)), n(4), cmplx(n(5), n(6), wp))
         end associate
         ok = ok .and. self%special(k)%kind >= 1 .and. self%special(k)%kind <= size(kinds_of_points)
         o = o + 6
      end do
      if (ok) call take_point(numbers, o, self%here, ok)
      do k = 1, flips
         if (ok) call take_point(numbers, o, self%flips(k), ok)
      end do
   end subroutine unpack_from

   !> The point behind number o, which moves behind it.
   subroutine take_point(numbers, o, point, ok)
      real(wp), intent(in) :: numbers(:)
      integer, intent(inout) :: o
      type(branch_point_type), intent(out) :: point
      logical, intent(out) :: ok
      integer :: sizes(3)
      ok = o + 6 <= size(numbers)
      if (.not. ok) return
      point%parameter = numbers(o + 1)
      point%arc_length = numbers(o + 2)
      point%along = numbers(o + 3)
      associate (given => numbers(o + 4:o + 6))
         ok = all(given > 0) .and. o + 6 + given(1) + 2*given(2) + given(3) <= size(numbers)
         if (.not. ok) return
         sizes = nint(given)
      end associate
      o = o + 6
      call take(sizes(1), point%place)
      call take(sizes(2), point%change)
      call take(sizes(2), point%tangent)
      call take(sizes(3), point%growth)
   contains
      subroutine take(n, list)
         integer, intent(in) :: n
         real(wp), allocatable, intent(out) :: list(:)
         list = numbers(o + 1:o + n)
         o = o + n
      end subroutine take
   end subroutine take_point
end module branch_course
