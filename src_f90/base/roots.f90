!> A root of a function of one variable on an interval: false position, where the value at an end that stays is halved,
!> so that this end is soon replaced too (the Illinois method; Dowell and Jarratt, BIT 11, 1971).
module roots
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: root_bracket

   !> Two places between which a function changes its sign: the one that stays and the one found last.
   type :: root_bracket
      real(wp) :: place(2) = 0, value(2) = 0
   contains
      procedure :: estimate
      procedure :: narrow
      procedure :: width
   end type root_bracket

contains

   !> Where the root would be if the function were linear.
   pure real(wp) function estimate(self)
      class(root_bracket), intent(in) :: self
      associate (x => self%place, f => self%value)
         estimate = (x(1)*f(2) - x(2)*f(1))/(f(2) - f(1))
      end associate
   end function estimate

   !> Takes in a place between the two, with the function's value there.
   pure subroutine narrow(self, place, value)
      class(root_bracket), intent(inout) :: self
      real(wp), intent(in) :: place, value
      if (value > 0 .neqv. self%value(2) > 0) then
         self%place(1) = self%place(2)
         self%value(1) = self%value(2)
      else
         self%value(1) = 0.5_wp*self%value(1)
      end if
      self%place(2) = place
      self%value(2) = value
   end subroutine narrow

   !> Distance between the two places.
   pure real(wp) function width(self)
      class(root_bracket), intent(in) :: self
      width = abs(self%place(2) - self%place(1))
   end function width
end module roots
