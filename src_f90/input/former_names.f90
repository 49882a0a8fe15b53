!> Names of the input that have changed: what a former variable, word or option is called now.
module former_names
   implicit none (type, external)
   private
   public :: new_name

   !> Each former name with today's, in pairs: 'group%name', 'group%name=word' or '--option'.
   character(len=*), parameter :: names(2, 6) = reshape([character(len=27) :: &
      & 'pivot%penetration_factor', 'pivot%deflection_factor', &
      & 'oil%wall_exchange', 'oil%shaft_nusselt', &
      & 'start%pad_penetration', 'start%pivot_deflection', &
      & 'start%pad_penetration_rate', 'start%pivot_deflection_rate', &
      & 'film%solver=modal', 'fourier', &
      & '--member', '--run'], [2, 6])

contains

   !> " (is called pivot%deflection_factor now)" for a former name; else empty.
   pure function new_name(former) result(text)
      character(len=*), intent(in) :: former
      character(len=:), allocatable :: text
      integer :: k
      text = ''
      do k = 1, size(names, 2)
         if (names(1, k) == former) text = ' (is called '//trim(names(2, k))//' now)'
      end do
   end function new_name
end module former_names
