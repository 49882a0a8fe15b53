!> The values of an assignment, checked against what its variable allows. The message names file, line, group,
!> variable, value and what is allowed.
module assigned_values
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use text, only: to_text, lower_case, shortened, replaced, whole_number, is_utf8
   use errors, only: error_type, raise, input_error
   use assignments, only: assignment_type, token_type, assignment_text, study_group, is_special, read_number
   use case_groups, only: unset
   use other_units, only: in_other_units
   use variable_table, only: variable_type
   use variable_names, only: meant_word
   implicit none (type, external)
   private
   public :: read_word, read_reals, refuse_values

   !> Longest text in a case, bytes.
   integer, parameter :: longest_text = 1000

contains

   !> The one text of an assignment; a word out of several is in lower case, without blanks around it. A shell has
   !> taken the quotes of --set away, so a bare word is a text there.
   subroutine read_word(a, v, word, error)
      type(assignment_type), intent(in) :: a
      type(variable_type), intent(in) :: v
      character(len=:), allocatable, intent(out) :: word
      type(error_type), allocatable, intent(out) :: error
      word = a%values(1)%text
      if (v%choices /= '') word = lower_case(trim(adjustl(word)))
      if (size(a%values) > 1 .and. v%choices == '') then
         call refuse_values(a, 'takes one text, in quotes where it has blanks or commas', error)
      else if (size(a%values) > 1 .or. a%subscript > 0) then
         call refuse_values(a, 'takes one text'//several_runs(a), error)
      else if (v%choices /= '' .and. .not. is_choice(word, v%choices)) then
         call refuse_values(a, 'must be one of '''//replaced(v%choices, ' ', ''', ''')//'''' &
            & //meant_word(word, v%choices, a%group//'%'//a%name//'='), error)
      else if (v%choices == '' .and. .not. (a%values(1)%quoted .or. a%overrides)) then
         call refuse_values(a, 'text must stand in quotes', error)
      else if (len(word) > longest_text) then
         call raise(error, input_error, a%origin//': '//a%group//'%'//a%name//': '//to_text(len(word)) &
            & //' characters; a text has at most '//to_text(longest_text))
      else if (.not. is_utf8(word)) then
         call refuse_values(a, 'must be UTF-8 text', error)
      end if
   end subroutine read_word

   !> The values of an assignment as reals, each within the range; at most as many as the variable takes up to the last
   !> element.
   subroutine read_reals(a, v, values, error)
      type(assignment_type), intent(in) :: a
      type(variable_type), intent(in) :: v
      real(wp), allocatable, intent(out) :: values(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: x
      integer :: i, repeat
      allocate (values(0))
      if (v%most == 1 .and. is_number_with_comma(a)) then
         call refuse_values(a, 'takes one value; a decimal has a point ('//a%values(1)%text//'.'//a%values(2)%text &
            & //'), and thousands have no comma ('//a%values(1)%text//a%values(2)%text//')', error)
         return
      end if
      do i = 1, size(a%values)
         call read_real(a, a%values(i), v, x, repeat, error)
         if (allocated(error)) return
         if (max(1, a%subscript) - 1 + size(values) + repeat > v%most) then
            if (v%most == 1 .and. size(a%values) > 1) then
               call refuse_values(a, 'takes one value'//several_runs(a), error)
            else
               call refuse_values(a, 'at most '//to_text(v%most)//' values', error)
            end if
            return
         end if
         values = [values, spread(x, 1, repeat)]
      end do
   end subroutine read_reals

   !> Whether two values are digits, the second with 0 before others or three of them: 9,000 or 0,019.
   pure logical function is_number_with_comma(a) result(is)
      type(assignment_type), intent(in) :: a
      is = size(a%values) == 2
      if (.not. is) return
      associate (first => a%values(1)%text, second => a%values(2)%text)
         is = first /= '' .and. len(second) > 1 .and. verify(first//second, '0123456789') == 0
         if (is) is = len(second) == 3 .or. second(1:1) == '0'
      end associate
   end function is_number_with_comma

   !> One value of an assignment and how often it stands there: `repeat*value`. Of what a case may leave out and what is
   !> never below 0, the value -1 says that it is not set.
   subroutine read_real(a, token, v, x, repeat, error)
      type(assignment_type), intent(in) :: a
      type(token_type), intent(in) :: token
      type(variable_type), intent(in) :: v
      real(wp), intent(out) :: x
      integer, intent(out) :: repeat
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: digits
      integer :: star
      logical :: repeat_ok, ok
      digits = lower_case(token%text)
      star = index(digits, '*')
      repeat = 1
      repeat_ok = .true.
      if (star > 0) then
         repeat = whole_number(digits(:star - 1))
         repeat_ok = repeat > 0 .and. repeat < 1000000
         digits = digits(star + 1:)
      end if
      x = 0
      if (.not. token%quoted .and. is_special(digits)) then
         call refuse_values(a, 'must be finite, '//v%allowed(), error)
         return
      end if
      call read_number(digits, x, ok)
      if (index(token%text, ':') > 0 .and. .not. token%quoted) then
         call refuse_values(a, 'must be a number, '//v%allowed()//several_runs(a), error)
      else if (.not. repeat_ok .or. token%quoted .or. .not. ok) then
         call refuse_values(a, 'must be a number, '//v%allowed(), error)
      else if (.not. ieee_is_finite(x)) then
         call refuse_values(a, 'must be finite, '//v%allowed(), error)
      else if (v%may_be_unset .and. v%low >= 0 .and. abs(x + 1) <= 0) then
         x = unset
      else if (x < v%low .or. x > v%high) then
         call refuse_values(a, 'must be '//v%allowed()//in_other_units(x, a%group//'%'//a%name, v%unit, v%low, &
            & v%high), error)
      end if
   end subroutine read_real

   !> How to write what has several values or a range, where one value is expected: a run for each of them.
   pure function several_runs(a) result(text)
      type(assignment_type), intent(in) :: a
      character(len=:), allocatable :: text
      text = '; for one run of each value: '//study_group//'%'//shortened(assignment_text(a))
   end function several_runs

   !> "case.nml line 3: rotor%mass = -1: must be ...".
   subroutine refuse_values(a, reason, error)
      type(assignment_type), intent(in) :: a
      character(len=*), intent(in) :: reason
      type(error_type), allocatable, intent(inout) :: error
      call raise(error, input_error, a%origin//': '//assignment_text(a)//': '//reason)
   end subroutine refuse_values

   !> True for one of the words that `choices` lists, separated by blanks.
   pure logical function is_choice(word, choices)
      character(len=*), intent(in) :: word, choices
      is_choice = scan(word, ' ') == 0 .and. index(' '//choices//' ', ' '//word//' ') > 0
   end function is_choice
end module assigned_values
