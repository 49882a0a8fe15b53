!> The values of a varied variable: single values, and the numbers of ranges.
module varied_values
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, i8
   use text, only: to_text, exact_text, lower_case, shortened
   use errors, only: error_type, raise, add_context, input_error
   use assignments, only: token_type, value_text, read_number
   implicit none (type, external)
   private
   public :: varied_values_type, read_varied_values

   !> Most values of a range.
   integer, parameter :: most_values = 1000000
   !> Part of a stride by which the last value of a range may miss its end.
   real(wp), parameter :: rounding = 1e-6_wp
   !> Numbers of a range are 0 or between these in size, so that nothing overflows on the way.
   real(wp), parameter :: smallest = 1e-100_wp, largest = 1e100_wp

   !> A single value, or the numbers of a range.
   type :: piece_type
      type(token_type) :: token
      integer :: count = 1
      logical :: is_range = .false., geometric = .false.
      !> Stride, or factor where the range is geometric.
      real(wp) :: first = 0, step = 0
   end type piece_type

   type :: varied_values_type
      private
      type(piece_type), allocatable :: pieces(:)
   contains
      procedure :: count => value_count
      procedure :: value
      procedure :: number => number_of_value
      procedure :: text => values_text
   end type varied_values_type

contains

   !> The values of an assignment; `name`, what is assigned, is for messages.
   subroutine read_varied_values(tokens, name, values, error)
      type(token_type), intent(in) :: tokens(:)
      character(len=*), intent(in) :: name
      type(varied_values_type), intent(out) :: values
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      allocate (values%pieces(size(tokens)))
      do i = 1, size(tokens)
         call read_piece(tokens(i), values%pieces(i), error)
         call add_context(error, name//' = '//shortened(value_text(tokens(i))))
         if (allocated(error)) return
      end do
   end subroutine read_varied_values

   !> A value, first:last:stride or first:last:*factor.
   subroutine read_piece(token, piece, error)
      type(token_type), intent(in) :: token
      type(piece_type), intent(out) :: piece
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: parts(:), word
      real(wp) :: numbers(3)
      integer :: first, second, i
      logical :: ok
      piece%token = token
      first = index(token%text, ':')
      if (token%quoted .or. first == 0) then
         if (.not. token%quoted .and. index(token%text, '*') > 0) call raise(error, input_error, &
            & 'n*value is not for a study, where each value is a run''s; a range is first:last:*factor')
         return
      end if
      piece%is_range = .true.
      second = first + index(token%text(first + 1:), ':')
      parts = [character(len=len(token%text)) :: token%text(:first - 1), token%text(first + 1:second - 1), &
         & token%text(second + 1:)]
      piece%geometric = parts(3) (1:1) == '*'
      if (piece%geometric) parts(3) = parts(3) (2:)
      do i = 1, 3
         word = lower_case(trim(parts(i)))
         call read_number(word, numbers(i), ok)
         if (.not. ok .or. second == first) then
            call raise(error, input_error, 'a range is first:last:stride or first:last:*factor, of numbers')
            return
         else if (.not. ieee_is_finite(numbers(i)) .or. abs(numbers(i)) > largest &
            & .or. abs(numbers(i)) > 0 .and. abs(numbers(i)) < smallest) then
            call raise(error, input_error, 'numbers of a range must be 1e-100 to 1e100 in size, or 0')
            return
         end if
      end do
      piece%first = numbers(1)
      piece%step = numbers(3)
      call count_steps(numbers(2), piece, error)
   end subroutine read_piece

   !> How many values a range has whose first value, and stride or factor, are known.
   subroutine count_steps(last, piece, error)
      real(wp), intent(in) :: last
      type(piece_type), intent(inout) :: piece
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: steps
      if (piece%geometric) then
         if (.not. piece%first*sign(1.0_wp, last) > 0 .or. .not. abs(last) > 0) then
            call raise(error, input_error, 'first and last must be of one sign, and not 0, for a factor')
         else if (piece%step <= 0 .or. .not. abs(piece%step - 1) > 0) then
            call raise(error, input_error, 'the factor must be > 0, and not 1')
         else if ((abs(last) - abs(piece%first))*(piece%step - 1) < 0) then
            call raise(error, input_error, 'from first the factor leads away from last; it must be ' &
               & //trim(merge('> 1', '< 1', piece%step < 1)))
         else
            steps = log(last/piece%first)/log(piece%step)
         end if
      else if (.not. abs(piece%step) > 0) then
         call raise(error, input_error, 'the stride must not be 0')
      else if ((last - piece%first)*piece%step < 0) then
         call raise(error, input_error, 'from first the stride leads away from last; it must be ' &
            & //trim(merge('> 0', '< 0', piece%step < 0)))
      else
         steps = (last - piece%first)/piece%step
      end if
      if (allocated(error)) return
      if (steps >= most_values) then
         call raise(error, input_error, 'more than '//to_text(most_values)//' values')
      else
         piece%count = 1 + floor(steps + rounding)
      end if
   end subroutine count_steps

   pure integer function value_count(self)
      class(varied_values_type), intent(in) :: self
      value_count = sum(self%pieces%count)
   end function value_count

   !> The n-th value.
   subroutine value(self, n, token)
      class(varied_values_type), intent(in) :: self
      integer, intent(in) :: n
      type(token_type), intent(out) :: token
      real(wp) :: x
      integer :: i, before
      call find_piece(self, n, i, before)
      token = self%pieces(i)%token
      if (.not. self%pieces(i)%is_range) return
      x = number_in_range(self%pieces(i), n - before - 1)
      token%text = exact_text(x)
      ! whole numbers without an exponent, as variables that take only these want them
      if (.not. abs(x - anint(x)) > 0 .and. abs(x) < 1e15_wp) token%text = to_text(nint(x, i8))
   end subroutine value

   !> The same as a number, to the last bit; `ok` is false where it is none. A range needs no text for this.
   subroutine number_of_value(self, n, x, ok)
      class(varied_values_type), intent(in) :: self
      integer, intent(in) :: n
      real(wp), intent(out) :: x
      logical, intent(out) :: ok
      integer :: i, before
      call find_piece(self, n, i, before)
      if (self%pieces(i)%is_range) then
         x = number_in_range(self%pieces(i), n - before - 1)
         ok = .true.
      else
         call read_number(lower_case(self%pieces(i)%token%text), x, ok)
      end if
   end subroutine number_of_value

   !> Which piece has the n-th value, and how many values come before that piece.
   pure subroutine find_piece(self, n, i, before)
      class(varied_values_type), intent(in) :: self
      integer, intent(in) :: n
      integer, intent(out) :: i, before
      before = 0
      do i = 1, size(self%pieces)
         if (n <= before + self%pieces(i)%count) exit
         before = before + self%pieces(i)%count
      end do
   end subroutine find_piece

   !> The number this many steps from the first of a range.
   real(wp) function number_in_range(piece, steps) result(x)
      type(piece_type), intent(in) :: piece
      integer, intent(in) :: steps
      ! a product rounded by itself, not as part of a fused addition: the same bits on every machine
      real(wp), volatile :: product
      if (piece%geometric) then
         ! a real exponent, as repeated products would round at every step
         x = piece%first*piece%step**real(steps, wp)
      else
         product = steps*piece%step
         x = piece%first + product
      end if
   end function number_in_range

   !> All values as the case has them.
   pure function values_text(self) result(text)
      class(varied_values_type), intent(in) :: self
      character(len=:), allocatable :: text
      integer :: i
      text = value_text(self%pieces(1)%token)
      do i = 2, size(self%pieces)
         text = text//', '//value_text(self%pieces(i)%token)
      end do
   end function values_text
end module varied_values
