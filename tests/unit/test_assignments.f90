!> Assignments: which replaces which, in what order they stand, what they are called.
program test_assignments
   use assignments, only: namelist_type, assignment_type, token_type, put_assignment, undoes, assignment_text, &
      & target_text, value_text
   use check, only: runs, expect, report
   implicit none (type, external)

   if (runs('one_undoes_another')) call one_undoes_another()
   if (runs('order')) call order()
   if (runs('elements_stay')) call elements_stay()
   if (runs('sweeps_keep_their_order')) call sweeps_keep_their_order()
   if (runs('texts')) call texts()
   call report()

contains

   !> An assignment of unquoted values, separated by blanks.
   function assigned(group, name, subscript, values) result(a)
      character(len=*), intent(in) :: group, name, values
      integer, intent(in) :: subscript
      type(assignment_type) :: a
      type(token_type) :: token
      character(len=:), allocatable :: rest
      integer :: blank
      a%group = group
      a%name = name
      a%subscript = subscript
      a%origin = 'here'
      allocate (a%values(0))
      rest = values//' '
      do while (rest /= '')
         blank = index(rest, ' ')
         token%text = rest(:blank - 1)
         a%values = [a%values, token]
         rest = rest(blank + 1:)
      end do
   end function assigned

   !> Puts one after another; all of them as text, with bars between them.
   function put(these) result(text)
      type(assignment_type), intent(in) :: these(:)
      character(len=:), allocatable :: text
      type(namelist_type) :: parsed
      integer :: i
      allocate (parsed%groups(0), parsed%assignments(0))
      do i = 1, size(these)
         call put_assignment(these(i), parsed)
      end do
      text = ''
      do i = 1, size(parsed%assignments)
         text = text//assignment_text(parsed%assignments(i))//'|'
      end do
   end function put

   subroutine expect_text(found, expected)
      character(len=*), intent(in) :: found, expected
      call expect(found == expected .and. len(found) == len(expected), expected//' came out as '//found)
   end subroutine expect_text

   subroutine one_undoes_another()
      type(assignment_type) :: whole, second, third
      whole = assigned('pads', 'mass', 0, '1 2 3')
      second = assigned('pads', 'mass', 2, '4')
      third = assigned('pads', 'mass', 3, '5')
      call expect(undoes(whole, second) .and. undoes(whole, whole), 'the whole undoes an element, and the whole')
      call expect(.not. undoes(second, whole), 'an element does not undo the whole')
      call expect(undoes(second, second) .and. .not. undoes(second, third), 'an element undoes itself alone')
      call expect(.not. undoes(whole, assigned('rotor', 'mass', 0, '1')), 'a variable of another group')
      call expect(.not. undoes(whole, assigned('pads', 'inertia', 0, '1')), 'another variable of the group')
   end subroutine one_undoes_another

   !> What comes later stands behind all others; what it replaces is gone.
   subroutine order()
      call expect_text(put([assigned('a', 'x', 0, '1'), assigned('b', 'y', 0, '2'), assigned('a', 'x', 0, '3')]), &
         & 'b%y = 2|a%x = 3|')
      call expect_text(put([assigned('a', 'x', 2, '1'), assigned('a', 'x', 1, '2'), assigned('a', 'x', 0, '3 4')]), &
         & 'a%x = 3, 4|')
      call expect_text(put([assigned('a', 'x', 2, '1'), assigned('a', 'x', 2, '3')]), 'a%x(2) = 3|')
   end subroutine order

   !> An element replaces one value, but not a list that starts there.
   subroutine elements_stay()
      call expect_text(put([assigned('a', 'x', 2, '1 5'), assigned('a', 'x', 2, '3')]), 'a%x(2) = 1, 5|a%x(2) = 3|')
      call expect_text(put([assigned('a', 'x', 2, '2*1'), assigned('a', 'x', 2, '3')]), 'a%x(2) = 2*1|a%x(2) = 3|')
      call expect_text(put([assigned('a', 'x', 0, '1 5'), assigned('a', 'x', 1, '3')]), 'a%x = 1, 5|a%x(1) = 3|')
   end subroutine elements_stay

   !> Their order is that of the members.
   subroutine sweeps_keep_their_order()
      call expect_text(put([assigned('sweep', 'a%x', 0, '1 2'), assigned('sweep', 'a%y', 0, '3'), &
         & assigned('sweep', 'a%x', 0, '4 5 6')]), 'sweep%a%x = 4, 5, 6|sweep%a%y = 3|')
      call expect_text(put([assigned('sweep', 'a%y', 0, '3'), assigned('sweep', 'a%x', 0, '4')]), &
         & 'sweep%a%y = 3|sweep%a%x = 4|')
      call expect_text(put([assigned('sweep', 'a%y', 2, '3 4'), assigned('sweep', 'a%y', 2, '5')]), 'sweep%a%y(2) = 5|')
   end subroutine sweeps_keep_their_order

   subroutine texts()
      call expect_text(target_text(assigned('pads', 'mass', 0, '1')), 'pads%mass')
      call expect_text(target_text(assigned('pads', 'mass', 12, '1')), 'pads%mass(12)')
      call expect_text(assignment_text(assigned('a', 'x', 0, '1 2 3 4')), 'a%x = 1, 2, 3, 4')
      call expect_text(assignment_text(assigned('a', 'x', 3, '1 2 3 4 5')), 'a%x(3) = 1, 2, 3, 4, ... (5 values)')
      call expect(len(assignment_text(assigned('a', 'x', 0, repeat('1', 10000)))) < 200, 'a long value is cut')
      call expect_text(value_text(token_type('it''s', quoted=.true.)), '''it''''s''')
      call expect_text(value_text(token_type('it''s', quoted=.false.)), 'it''s')
      call expect_text(value_text(token_type('', quoted=.true.)), '''''')
   end subroutine texts
end program test_assignments
