!> A field that wants what a map makes of its values, and what comes to equilibrium with any of them, or with those
!> alone that are near the last ones.
module mapped_values
   use kinds, only: wp
   use errors, only: error_type, raise, numerics_error
   use equations_of_motion, only: machine_model
   use fixed_point, only: coupled_field, balance_type
   implicit none (type, external)
   private
   public :: mapped_field, near_balance

   !> A linear map, where the last value wants less above 0 and more below; or cosines.
   type, extends(coupled_field) :: mapped_field
      real(wp) :: matrix(4, 4) = 0, constant(4) = [1.0_wp, -2.0_wp, 0.5_wp, 3.0_wp], leap = 0
      logical :: cosines = .false., no_answer = .false.
      integer :: rounds = 0
      !> The largest change of a value from one equilibrium to the next, and the values there.
      real(wp) :: largest_change = 0
      real(wp), allocatable :: last(:)
   contains
      procedure :: wanted
      procedure :: apply
      procedure :: find_wanted
      procedure :: check
      procedure :: explain
   end type mapped_field

   !> Its state is the values of the field. Where they change by more than it reaches it finds no equilibrium, nor where
   !> one is above `highest`.
   type, extends(balance_type) :: near_balance
      type(mapped_field), pointer :: field => null()
      real(wp) :: reach = huge(1.0_wp), highest = huge(1.0_wp)
      integer :: failures = 0
   contains
      procedure :: settle
   end type near_balance

contains

   pure function wanted(self)
      class(mapped_field), intent(in) :: self
      real(wp) :: wanted(4)
      wanted = matmul(self%matrix, self%values) + self%constant
      if (self%cosines) wanted = cos(self%values)
      wanted(4) = wanted(4) - sign(self%leap, self%values(4))
   end function wanted

   subroutine apply(self, model)
      class(mapped_field), intent(inout) :: self
      type(machine_model), intent(inout) :: model
   end subroutine apply

   subroutine find_wanted(self, model, y, wanted, error)
      class(mapped_field), intent(inout) :: self
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      real(wp), intent(out) :: wanted(:)
      type(error_type), allocatable, intent(out) :: error
      wanted = self%wanted()
      if (self%rounds > 0) self%largest_change = max(self%largest_change, maxval(abs(y - self%last)))
      self%last = y
      self%rounds = self%rounds + 1
   end subroutine find_wanted

   subroutine check(self, model, agrees, error)
      class(mapped_field), intent(in) :: self
      type(machine_model), intent(in) :: model
      logical, intent(in) :: agrees
      type(error_type), allocatable, intent(out) :: error
      if (.not. agrees) then
         call raise(error, numerics_error, 'they do not agree')
      else if (self%no_answer) then
         call raise(error, numerics_error, 'they are no answer')
      end if
   end subroutine check

   subroutine explain(self, model, y, first, error)
      class(mapped_field), intent(in) :: self
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      logical, intent(in) :: first
      type(error_type), allocatable, intent(inout) :: error
      error%message = trim(merge('at first', 'later   ', first))//': '//error%message
   end subroutine explain

   subroutine settle(self, last, y, first, final, error)
      class(near_balance), intent(inout) :: self
      real(wp), intent(in) :: last(:)
      real(wp), intent(inout) :: y(:)
      logical, intent(in) :: first, final
      type(error_type), allocatable, intent(out) :: error
      y = self%field%values
      if ((first .or. maxval(abs(y - last)) <= self%reach) .and. maxval(y) <= self%highest) return
      self%failures = self%failures + 1
      call raise(error, numerics_error, 'no equilibrium')
   end subroutine settle
end module mapped_values

!> The fixed point of coupled fields: maps whose fixed points are known, one that would diverge if it were repeated,
!> values that jump, steps that are too long, and what is refused.
program test_fixed_point
   use kinds, only: wp
   use errors, only: error_type
   use linear_algebra, only: dgesv
   use equations_of_motion, only: machine_model
   use fixed_point, only: field_reference, solve_fields, most_rounds
   use mapped_values, only: mapped_field, near_balance
   use check, only: runs, expect, expect_close, expect_no_error, between, report
   implicit none (type, external)
   type(machine_model), target :: model

   if (runs('contraction')) call contraction()
   if (runs('repeated_map_diverges')) call repeated_map_diverges()
   if (runs('behind_a_fold')) call behind_a_fold()
   if (runs('two_fields')) call two_fields()
   if (runs('jump')) call jump()
   if (runs('large_jump')) call large_jump()
   if (runs('longest')) call longest()
   if (runs('shorter')) call shorter()
   if (runs('no_equilibrium')) call no_equilibrium()
   if (runs('no_answer')) call no_answer()
   call report()

contains

   !> Its map has eigenvalues of about -0.5 to -2.
   type(mapped_field) function new_field() result(field)
      integer :: i, k
      field%values = spread(0.0_wp, 1, 4)
      field%agreement = 1e-9_wp
      do i = 1, 4
         field%matrix(i, i) = -0.5_wp*i
         do k = 1, 4
            field%matrix(i, k) = field%matrix(i, k) + between(-0.2_wp, 0.2_wp)
         end do
      end do
   end function new_field

   !> One whose last value is balanced on both sides of a jump alone.
   type(mapped_field) function jumping_field(admitted) result(field)
      real(wp), intent(in) :: admitted
      field = new_field()
      field%matrix(4, :) = 0
      field%constant(4) = 0
      field%leap = 0.5_wp
      field%jump = admitted
      field%parts = 4
   end function jumping_field

   !> Values that agree, with what finds equilibria as this one does.
   subroutine solve(field, balance, error)
      type(mapped_field), intent(inout), target :: field
      type(near_balance), intent(inout) :: balance
      type(error_type), allocatable, intent(out) :: error
      type(field_reference) :: fields(1)
      real(wp) :: y(4)
      y = 0
      fields(1)%field => field
      balance%field => field
      balance%model => model
      call solve_fields(balance, y, fields, error)
      if (.not. allocated(error)) call expect(all(abs(y - field%values) <= 0), 'the state is that of the last values')
   end subroutine solve

   !> x = cos x.
   subroutine contraction()
      type(mapped_field) :: field
      type(near_balance) :: balance
      type(error_type), allocatable :: error
      integer :: i
      field = new_field()
      field%cosines = .true.
      call solve(field, balance, error)
      call expect_no_error(error, 'cosines')
      do i = 1, 4
         call expect_close(field%values(i), 0.739085133215160642_wp, 1e-9_wp, 'fixed point')
      end do
      ! repeated, the map takes about 50
      call expect(field%rounds <= 10, 'few rounds')
   end subroutine contraction

   !> (I - A) x = b.
   subroutine repeated_map_diverges()
      type(mapped_field) :: field
      type(near_balance) :: balance
      type(error_type), allocatable :: error
      real(wp) :: matrix(4, 4), x(4, 1)
      integer :: i, pivots(4), info
      field = new_field()
      call solve(field, balance, error)
      call expect_no_error(error, 'a map that would diverge')
      call expect(field%rounds <= 8, 'few rounds')
      call expect(maxval(abs(field%wanted() - field%values)) <= field%agreement, 'the values agree')
      matrix = -field%matrix
      do i = 1, 4
         matrix(i, i) = matrix(i, i) + 1
      end do
      x(:, 1) = field%constant
      call dgesv(4, 1, matrix, 4, pivots, x, 4, info)
      call expect(maxval(abs(field%values - x(:, 1))) <= 1e-8_wp, 'fixed point')
   end subroutine repeated_map_diverges

   !> Values that run away from their balance, ever faster, come to it where any balance is looked for, and only there.
   subroutine behind_a_fold()
      type(mapped_field) :: field
      type(near_balance) :: balance
      type(error_type), allocatable :: error
      integer :: i, along
      do along = 0, 1
         field = new_field()
         field%matrix = 0
         do i = 1, 4
            field%matrix(i, i) = 3
         end do
         balance%any_balance = along == 1
         call solve(field, balance, error)
         if (along == 0) call expect(allocated(error), 'values that run away are not followed back')
      end do
      call expect_no_error(error, 'along a branch they are')
      call expect(maxval(abs(field%values + 0.5_wp*field%constant)) <= 1e-8_wp, 'fixed point')
   end subroutine behind_a_fold

   !> Both are led to their values at a time, each as close as it says.
   subroutine two_fields()
      type(mapped_field), target :: field(2)
      type(near_balance) :: balance
      type(field_reference) :: fields(2)
      type(error_type), allocatable :: error
      real(wp) :: y(4)
      integer :: i
      y = 0
      do i = 1, 2
         field(i) = new_field()
         fields(i)%field => field(i)
      end do
      field(2)%agreement = 1e-6_wp
      balance%field => field(1)
      balance%model => model
      call solve_fields(balance, y, fields, error)
      call expect_no_error(error, 'two fields')
      do i = 1, 2
         call expect(maxval(abs(field(i)%wanted() - field(i)%values)) <= field(i)%agreement, 'the values agree')
      end do
   end subroutine two_fields

   !> The value that jumps is kept between both sides, and the others agree.
   subroutine jump()
      type(mapped_field) :: field
      type(near_balance) :: balance
      type(error_type), allocatable :: error
      real(wp) :: residual(4)
      field = jumping_field(1.0_wp)
      call solve(field, balance, error)
      call expect_no_error(error, 'a jump')
      residual = field%wanted() - field%values
      call expect(maxval(abs(residual(:3))) <= field%agreement, 'the others agree')
      call expect(abs(residual(4)) > field%agreement .and. abs(residual(4)) <= field%jump, 'it does not')
      call expect(abs(field%values(4)) < field%leap, 'between both sides')
   end subroutine jump

   !> A jump that is larger than admitted does not end.
   subroutine large_jump()
      type(mapped_field) :: field
      type(near_balance) :: balance
      type(error_type), allocatable :: error
      field = jumping_field(0.1_wp)
      call solve(field, balance, error)
      call expect_refusal(error, 'they do not agree')
      call expect(field%rounds == most_rounds, 'after the last round')
      call expect(.not. balance%refused, 'another state may lead further')
   end subroutine large_jump

   !> No round changes a value by more than its longest step.
   subroutine longest()
      type(mapped_field) :: field
      type(near_balance) :: balance
      type(error_type), allocatable :: error
      field = new_field()
      field%longest = 0.1_wp
      call solve(field, balance, error)
      call expect_no_error(error, 'short steps')
      call expect(field%largest_change <= 0.1_wp*(1 + 1e-12_wp), 'none is longer')
      call expect(field%largest_change > 0.099_wp, 'and some are as long')
   end subroutine longest

   !> A step to which no equilibrium follows is made shorter.
   subroutine shorter()
      type(mapped_field) :: field
      type(near_balance) :: balance
      type(error_type), allocatable :: error
      field = new_field()
      field%longest = 1
      balance%reach = 0.3_wp
      call solve(field, balance, error)
      call expect_no_error(error, 'an equilibrium that follows short steps')
      call expect(balance%failures > 0, 'some were too long')
      call expect(maxval(abs(field%wanted() - field%values)) <= field%agreement, 'the values agree')
   end subroutine shorter

   !> Where none follows however short it is, or there is none to begin with, the field says what it knows.
   subroutine no_equilibrium()
      type(mapped_field) :: field
      type(near_balance) :: balance
      type(error_type), allocatable :: error
      field = new_field()
      field%longest = 1
      balance%reach = 1e-3_wp
      call solve(field, balance, error)
      call expect_refusal(error, 'later: no equilibrium')
      field = new_field()
      balance = near_balance(highest=-1.0_wp)
      call solve(field, balance, error)
      call expect_refusal(error, 'at first: no equilibrium')
      call expect(balance%failures == 1, 'it is tried once')
      field = new_field()
      balance = near_balance(highest=-1.0_wp, refused=.true.)
      call solve(field, balance, error)
      call expect_refusal(error, 'no equilibrium')
   end subroutine no_equilibrium

   !> Values that agree may be no answer: then no others are.
   subroutine no_answer()
      type(mapped_field) :: field
      type(near_balance) :: balance
      type(error_type), allocatable :: error
      field = new_field()
      field%no_answer = .true.
      call solve(field, balance, error)
      call expect_refusal(error, 'they are no answer')
      call expect(balance%refused, 'it is final')
   end subroutine no_answer

   subroutine expect_refusal(error, message)
      type(error_type), allocatable, intent(in) :: error
      character(len=*), intent(in) :: message
      call expect(allocated(error), 'an error: '//message)
      if (allocated(error)) call expect(error%message == message, error%message//' is: '//message)
   end subroutine expect_refusal
end program test_fixed_point
