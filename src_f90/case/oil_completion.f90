!> The law of the oil's viscosity: which one a case means, and whether it has the numbers that this one needs and no
!> others.
module oil_completion
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, require
   use case_inputs, only: case_type, oil_type, is_set, temperature_range, viscosity_range
   use oil_properties, only: reference_viscosity, density, grades
   implicit none (type, external)
   private
   public :: complete_oil

contains

   !> Finds the law where it is left out, checks its numbers, and gives the constant law the paper's viscosity.
   subroutine complete_oil(inputs, error)
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: paper
      associate (b => inputs%bearing, oil => inputs%oil)
         if (oil%law == '') oil%law = meant_law(oil)
         call refuse_surplus(inputs, error)
         select case (oil%law)
         case ('constant')
            paper = case_type()
            if (.not. is_set(b%viscosity)) b%viscosity = paper%bearing%viscosity
            return
         case ('walther')
            call check_walther(oil, error)
         case default
            call require(is_set(oil%reference_viscosity) .and. is_set(oil%temperature_exponent), 'oil%law = ' &
               & //'''exponential'': needs oil%reference_viscosity and oil%temperature_exponent', error)
         end select
         if (allocated(error)) return
         associate (mu => reference_viscosity(inputs))
            call require(mu >= viscosity_range(1) .and. mu <= viscosity_range(2), 'oil%supply_temperature = ' &
               & //to_text(oil%supply_temperature)//': the oil''s viscosity there is '//to_text(mu) &
               & //' Pa s; must be '//to_text(viscosity_range(1))//' to '//to_text(viscosity_range(2)), error)
         end associate
      end associate
   end subroutine complete_oil

   !> The law whose numbers are given.
   pure function meant_law(oil) result(law)
      type(oil_type), intent(in) :: oil
      character(len=:), allocatable :: law
      if (oil%grade /= 0 .or. any(is_set(oil%kinematic_viscosity))) then
         law = 'walther'
      else if (is_set(oil%reference_viscosity) .or. is_set(oil%temperature_exponent)) then
         law = 'exponential'
      else
         law = 'constant'
      end if
   end function meant_law

   !> Refuses what tells that another law is meant; numbers that merely have no effect may stand.
   subroutine refuse_surplus(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      associate (oil => inputs%oil)
         call only_of('constant', 'bearing%viscosity', inputs%bearing%viscosity, is_set(inputs%bearing%viscosity))
         call only_of('walther', 'oil%grade', real(oil%grade, wp), oil%grade /= 0)
         call only_of('walther', 'oil%kinematic_viscosity', maxval(oil%kinematic_viscosity), &
            & any(is_set(oil%kinematic_viscosity)))
         call only_of('exponential', 'oil%reference_viscosity', oil%reference_viscosity, &
            & is_set(oil%reference_viscosity))
         call only_of('exponential', 'oil%temperature_exponent', oil%temperature_exponent, &
            & is_set(oil%temperature_exponent))
      end associate
   contains
      subroutine only_of(law, name, value, given)
         character(len=*), intent(in) :: law, name
         real(wp), intent(in) :: value
         logical, intent(in) :: given
         if (.not. given .or. inputs%oil%law == law) return
         call require(.false., name//' = '//to_text(value)//': belongs to oil%law = '''//law &
            & //''', but this case has oil%law = '''//inputs%oil%law//'''; take it out of the case', error)
      end subroutine only_of
   end subroutine refuse_surplus

   subroutine check_walther(oil, error)
      type(oil_type), intent(in) :: oil
      type(error_type), allocatable, intent(inout) :: error
      type(oil_type) :: default
      associate (nu => oil%kinematic_viscosity, t => oil%at_temperature)
         if (oil%grade /= 0) then
            call require(any(grades == oil%grade), 'oil%grade = '//to_text(oil%grade)//': must be one of the ISO ' &
               & //'viscosity grades '//grade_list(), error)
            call require(.not. any(is_set(nu)), 'oil%grade = '//to_text(oil%grade)//': oil%kinematic_viscosity = ' &
               & //to_text(maxval(nu))//' is given too; give one of them', error)
            call require(all(abs(t - default%at_temperature) <= 0), 'oil%at_temperature = '//to_text(t(1))//', ' &
               & //to_text(t(2))//': a grade has its two points at 40 and 100 C; leave it out', error)
         else
            call require(all(is_set(nu)), 'oil%law = ''walther'': needs oil%grade, or two values of ' &
               & //'oil%kinematic_viscosity', error)
            call require(t(2) > t(1), 'oil%at_temperature = '//to_text(t(1))//', '//to_text(t(2)) &
               & //': the second must be above the first', error)
            call require(nu(2) <= nu(1), 'oil%kinematic_viscosity = '//to_text(nu(1))//', '//to_text(nu(2)) &
               & //': must not rise with the temperature', error)
         end if
      end associate
      call require(density(oil, temperature_range(2)) > 0, 'oil%density_slope = '//to_text(oil%density_slope) &
         & //': the density must be above 0 up to '//to_text(temperature_range(2))//' C', error)
   end subroutine check_walther

   !> "10, 15, 22, ... 3200".
   pure function grade_list() result(list)
      character(len=:), allocatable :: list
      integer :: i
      list = to_text(grades(1))
      do i = 2, size(grades)
         list = list//', '//to_text(grades(i))
      end do
   end function grade_list
end module oil_completion
