!> A field that wants what a linear map makes of its values.
module linear_map
   use kinds, only: wp
   use errors, only: error_type
   use equations_of_motion, only: machine_model
   use fixed_point, only: coupled_field
   implicit none (type, external)
   private
   public :: linear_field, wanted_of

   !> The last value wants less above 0 and more below.
   type, extends(coupled_field) :: linear_field
      real(wp) :: matrix(4, 4) = 0, constant(4) = [1.0_wp, -2.0_wp, 0.5_wp, 3.0_wp], leap = 0
   contains
      procedure :: apply => apply_nothing
      procedure :: find_wanted => find_linear
      procedure :: check => check_nothing
   end type linear_field

contains

   pure function wanted_of(field) result(wanted)
      class(linear_field), intent(in) :: field
      real(wp) :: wanted(4)
      wanted = matmul(field%matrix, field%values) + field%constant
      wanted(4) = wanted(4) - sign(field%leap, field%values(4))
   end function wanted_of

   subroutine apply_nothing(self, model)
      class(linear_field), intent(inout) :: self
      type(machine_model), intent(inout) :: model
   end subroutine apply_nothing

   subroutine find_linear(self, model, y, wanted, error)
      class(linear_field), intent(inout) :: self
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      real(wp), intent(out) :: wanted(:)
      type(error_type), allocatable, intent(out) :: error
      wanted = wanted_of(self)
   end subroutine find_linear

   subroutine check_nothing(self, model, agrees, error)
      class(linear_field), intent(in) :: self
      type(machine_model), intent(in) :: model
      logical, intent(in) :: agrees
      type(error_type), allocatable, intent(out) :: error
   end subroutine check_nothing
end module linear_map

!> The rounds of a fixed point: a map that would diverge if it were repeated, values that jump, and steps that are too
!> long.
program test_fixed_point
   use kinds, only: wp
   use fixed_point, only: mixer_type, most_rounds
   use linear_map, only: linear_field, wanted_of
   use check, only: runs, expect, between, report
   implicit none (type, external)

   if (runs('divergent')) call divergent()
   if (runs('jump')) call jump()
   if (runs('large_jump')) call large_jump()
   if (runs('longest')) call longest()
   call report()

contains

   !> Its map has eigenvalues of about -0.5 to -2.
   type(linear_field) function new_field() result(field)
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
   type(linear_field) function jumping_field(admitted) result(field)
      real(wp), intent(in) :: admitted
      field = new_field()
      field%matrix(4, :) = 0
      field%constant(4) = 0
      field%leap = 0.5_wp
      field%jump = admitted
      field%parts = 4
   end function jumping_field

   !> Rounds until the values agree, or the last one.
   subroutine solve(field, mixer)
      type(linear_field), intent(inout) :: field
      type(mixer_type), intent(out) :: mixer
      real(wp) :: y(1)
      y = 0
      call mixer%begin(field)
      do while (.not. mixer%agrees .and. mixer%rounds < most_rounds)
         call mixer%next(field%values, wanted_of(field), y)
      end do
   end subroutine solve

   !> It ends after few rounds.
   subroutine divergent()
      type(linear_field) :: field
      type(mixer_type) :: mixer
      field = new_field()
      call solve(field, mixer)
      call expect(mixer%agrees .and. mixer%rounds <= 8, 'few rounds')
      call expect(maxval(abs(wanted_of(field) - field%values)) <= field%agreement, 'fixed point')
   end subroutine divergent

   !> The value that jumps is kept between both sides, and the others agree.
   subroutine jump()
      type(linear_field) :: field
      type(mixer_type) :: mixer
      real(wp) :: residual(4)
      field = jumping_field(1.0_wp)
      call solve(field, mixer)
      call expect(mixer%agrees, 'it ends')
      residual = wanted_of(field) - field%values
      call expect(maxval(abs(residual(:3))) <= field%agreement, 'the others agree')
      call expect(abs(residual(4)) > field%agreement .and. abs(residual(4)) <= field%jump, 'it does not')
      call expect(abs(field%values(4)) < field%leap, 'between both sides')
   end subroutine jump

   !> A jump that is larger than admitted does not end.
   subroutine large_jump()
      type(linear_field) :: field
      type(mixer_type) :: mixer
      field = jumping_field(0.1_wp)
      call solve(field, mixer)
      call expect(.not. mixer%agrees .and. mixer%rounds == most_rounds, 'it does not end')
   end subroutine large_jump

   !> No round changes a value by more than its longest step.
   subroutine longest()
      type(linear_field) :: field
      type(mixer_type) :: mixer
      real(wp) :: y(1), before(4)
      field = new_field()
      field%longest = 0.1_wp
      y = 0
      call mixer%begin(field)
      do while (.not. mixer%agrees .and. mixer%rounds < most_rounds)
         before = field%values
         call mixer%next(field%values, wanted_of(field), y)
         call expect(maxval(abs(field%values - before)) <= 0.1_wp*(1 + 1e-12_wp), 'step')
      end do
      call expect(mixer%agrees, 'it ends')
   end subroutine longest
end program test_fixed_point
