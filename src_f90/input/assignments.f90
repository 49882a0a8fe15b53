!> Assignments of namelist text, and their texts in messages.
module assignments
   use text, only: to_text, shortened
   implicit none (type, external)
   private
   public :: namelist_type, assignment_type, token_type
   public :: put_assignment, undoes, assignment_text, target_text, value_text, study_group

   !> The group of a study. Its variables are those of other groups, `group%name = values`, with one value for each run.
   character(len=*), parameter :: study_group = 'sweep'

   !> One value; `repeat*value` stands for several of them.
   type :: token_type
      character(len=:), allocatable :: text
      logical :: quoted = .false.
   end type token_type

   !> `group%name(subscript) = values`, and where it was found: "case.nml line 3" or "--set".
   type :: assignment_type
      character(len=:), allocatable :: group, name, origin
      !> First element that the values go to; 0 where no subscript is given.
      integer :: subscript = 0
      !> True for an assignment of --set or of a run of a study: it may set an element that the file sets too.
      logical :: overrides = .false.
      type(token_type), allocatable :: values(:)
   end type assignment_type

   type :: namelist_type
      character(len=:), allocatable :: file
      !> Groups in their order, and where they start.
      type(assignment_type), allocatable :: groups(:)
      type(assignment_type), allocatable :: assignments(:)
   end type namelist_type

contains

   !> Adds an assignment and removes those that it replaces. It comes last; only that of a study takes the position of
   !> the first one that it replaces, as the order of swept variables is the order of the runs.
   subroutine put_assignment(new, parsed)
      type(assignment_type), intent(in) :: new
      type(namelist_type), intent(inout) :: parsed
      type(assignment_type), allocatable :: together(:)
      logical, allocatable :: keep(:)
      integer :: at, i, k
      keep = [(.not. replaces(new, parsed%assignments(i)), i=1, size(parsed%assignments))]
      at = size(keep) + 1
      if (new%group == study_group) at = findloc([keep, .false.], .false., dim=1)
      ! one by one, as the compiler forgets to free what a constructor with pack copies
      allocate (together(count(keep) + 1))
      k = 0
      do i = 1, size(keep) + 1
         if (i == at) then
            k = k + 1
            together(k) = new
         end if
         if (i > size(keep)) exit
         if (.not. keep(i)) cycle
         k = k + 1
         together(k) = parsed%assignments(i)
      end do
      call move_alloc(together, parsed%assignments)
   end subroutine put_assignment

   !> True where the new assignment would undo all of an earlier one.
   pure logical function undoes(new, earlier)
      type(assignment_type), intent(in) :: new, earlier
      undoes = new%group == earlier%group .and. new%name == earlier%name &
         & .and. (new%subscript == 0 .or. new%subscript == earlier%subscript)
   end function undoes

   !> True where it also sets all that the earlier one set: an element does not replace a list that starts there.
   pure logical function replaces(new, earlier)
      type(assignment_type), intent(in) :: new, earlier
      replaces = undoes(new, earlier)
      if (new%subscript == 0 .or. new%group == study_group) return
      replaces = replaces .and. size(earlier%values) == 1 .and. index(earlier%values(1)%text, '*') == 0
   end function replaces

   !> "rotor%mass = -1", with at most four values, for messages.
   pure function assignment_text(a) result(text)
      type(assignment_type), intent(in) :: a
      character(len=:), allocatable :: text
      integer :: i
      text = target_text(a)//' = '
      do i = 1, min(4, size(a%values))
         if (i > 1) text = text//', '
         text = text//shortened(value_text(a%values(i)))
      end do
      if (size(a%values) > 4) text = text//', ... ('//to_text(size(a%values))//' values)'
   end function assignment_text

   !> "pads%mass(2)".
   pure function target_text(a) result(text)
      type(assignment_type), intent(in) :: a
      character(len=:), allocatable :: text
      text = a%group//'%'//a%name
      if (a%subscript > 0) text = text//'('//to_text(a%subscript)//')'
   end function target_text

   !> A value as a case has it: a text in quotes, and quotes within the text doubled.
   pure function value_text(token) result(text)
      type(token_type), intent(in) :: token
      character(len=:), allocatable :: text
      integer :: i
      text = token%text
      if (.not. token%quoted) return
      text = ''''
      do i = 1, len(token%text)
         text = text//token%text(i:i)
         if (token%text(i:i) == '''') text = text//''''
      end do
      text = text//''''
   end function value_text
end module assignments
