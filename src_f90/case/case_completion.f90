!> What a case may leave out, because it follows from other variables: final speed, pad clearance, law of the oil,
!> and mass, inertia and centre of gravity of the pads.
module case_completion
   use kinds, only: wp, degree
   use text, only: to_text
   use errors, only: error_type, raise, input_error
   use case_inputs, only: case_type, unset, is_set, mass_range, inertia_range, centre_range, &
      & clearance_range
   use oil_completion, only: complete_oil
   use annular_sector, only: annular_sector_type, new_annular_sector
   implicit none (type, external)
   private
   public :: leave_out, complete_case

   !> Density of steel, kg/m^3.
   real(wp), parameter :: steel = 7850

contains

   !> Leaves out what `complete_case` can find.
   pure subroutine leave_out(inputs)
      type(case_type), intent(inout) :: inputs
      inputs%operation%final_speed_rpm = -1
      inputs%bearing%machined_clearance = unset
      inputs%bearing%viscosity = unset
      inputs%oil%law = ''
      associate (pads => inputs%pads)
         pads%mass(:) = unset
         pads%inertia(:) = unset
         pads%centre_tangential(:) = unset
         pads%centre_radial(:) = unset
      end associate
   end subroutine leave_out

   !> Finds what is left out; afterwards only the variables from which it follows are unset.
   subroutine complete_case(inputs, error)
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      call inputs%set_final_speed()
      call set_clearance(inputs, error)
      if (.not. allocated(error)) call complete_oil(inputs, error)
      do i = 1, inputs%pad_count()
         if (allocated(error)) return
         call set_pad(inputs, i, error)
      end do
   end subroutine complete_case

   !> The pad clearance: as given, by the preload, or the paper's.
   subroutine set_clearance(inputs, error)
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: paper
      associate (b => inputs%bearing)
         if (is_set(b%preload) .and. is_set(b%machined_clearance)) then
            call raise(error, input_error, 'bearing%preload = '//to_text(b%preload)//': bearing%machined_clearance = ' &
               & //to_text(b%machined_clearance)//' is given too; give one of them')
         else if (is_set(b%preload)) then
            b%machined_clearance = b%assembled_clearance/(1 - b%preload)
            associate (ratio => b%machined_clearance/b%journal_radius)
               if (ratio < clearance_range(1) .or. ratio > clearance_range(2)) call raise(error, input_error, &
                  & 'bearing%preload = '//to_text(b%preload)//': gives bearing%machined_clearance = ' &
                  & //to_text(b%machined_clearance)//' with bearing%assembled_clearance = ' &
                  & //to_text(b%assembled_clearance)//'; it must be '//to_text(clearance_range(1))//' to ' &
                  & //to_text(clearance_range(2))//' of bearing%journal_radius = '//to_text(b%journal_radius) &
                  & //' (all in m)')
            end associate
         else if (.not. is_set(b%machined_clearance)) then
            paper = case_type()
            b%machined_clearance = paper%bearing%machined_clearance
         end if
         b%preload = unset
      end associate
   end subroutine set_clearance

   !> What is left out of a pad's mass, inertia and centre of gravity: that of the paper's pads if it has their size and
   !> neither density nor thickness is given, else that of an annular sector.
   subroutine set_pad(inputs, i, error)
      type(case_type), intent(inout) :: inputs
      integer, intent(in) :: i
      type(error_type), allocatable, intent(out) :: error
      type(annular_sector_type) :: sector
      type(case_type) :: paper
      paper = case_type()
      associate (p => inputs%pads, q => paper%pads)
         call refuse_surplus(inputs, i, error)
         if (allocated(error)) return
         if (.not. inputs%tilting()) then
            ! fixed pads need no masses
         else if (has_size_of(inputs, i, paper) .and. .not. (is_set(p%density(i)) .or. is_set(p%thickness(i)))) then
            call fill(p%mass(i), q%mass(1))
            call fill(p%inertia(i), q%inertia(1))
            call fill(p%centre_tangential(i), q%centre_tangential(1))
            call fill(p%centre_radial(i), q%centre_radial(1))
         else
            call fill(p%thickness(i), p%pivot_distance(i))
            call fill(p%density(i), steel)
            sector = new_annular_sector(inputs%bearing%journal_radius + inputs%bearing%machined_clearance, &
               & p%thickness(i), p%pivot_ratio(i)*p%arc_deg(i)*degree, (1 - p%pivot_ratio(i))*p%arc_deg(i)*degree, &
               & inputs%bearing%axial_length, p%pivot_distance(i))
            call fill(p%mass(i), p%density(i)*sector%volume)
            call fill(p%inertia(i), p%mass(i)*sector%squared_radius)
            call fill(p%centre_tangential(i), sector%centre_tangential)
            call fill(p%centre_radial(i), sector%centre_radial)
            call require('mass', p%mass(i), mass_range, error)
            call require('inertia', p%inertia(i), inertia_range, error)
            call require('centre_tangential', p%centre_tangential(i), centre_range, error)
            call require('centre_radial', p%centre_radial(i), centre_range, error)
         end if
         p%density(i) = unset
         p%thickness(i) = unset
      end associate
   end subroutine set_pad

   !> Refuses a density or thickness that nothing would follow from.
   subroutine refuse_surplus(inputs, i, error)
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: i
      type(error_type), allocatable, intent(out) :: error
      associate (p => inputs%pads)
         if (is_set(p%density(i)) .and. is_set(p%mass(i))) then
            call raise(error, input_error, 'pads%density = '//to_text(p%density(i))//': pads%mass = ' &
               & //to_text(p%mass(i))//' is given too; give one of them (pad '//to_text(i)//')')
         else if (is_set(p%thickness(i)) .and. is_set(p%mass(i)) .and. is_set(p%inertia(i)) &
            & .and. is_set(p%centre_tangential(i)) .and. is_set(p%centre_radial(i))) then
            call raise(error, input_error, 'pads%thickness = '//to_text(p%thickness(i))//': has no effect where ' &
               & //'mass, inertia, centre_tangential and centre_radial are given (pad '//to_text(i)//')')
         end if
      end associate
   end subroutine refuse_surplus

   !> True where a pad has the size of the paper's, clearances apart.
   pure logical function has_size_of(inputs, i, paper)
      type(case_type), intent(in) :: inputs, paper
      integer, intent(in) :: i
      has_size_of = all(abs(size_of(inputs, i) - size_of(paper, 1)) <= 0)
   end function has_size_of

   pure function size_of(inputs, i)
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: i
      real(wp) :: size_of(5)
      associate (b => inputs%bearing, p => inputs%pads)
         size_of = [b%journal_radius, b%axial_length, p%arc_deg(i), p%pivot_ratio(i), p%pivot_distance(i)]
      end associate
   end function size_of

   pure subroutine fill(x, value)
      real(wp), intent(inout) :: x
      real(wp), intent(in) :: value
      if (.not. is_set(x)) x = value
   end subroutine fill

   !> Refuses what the input would not allow if it were given.
   subroutine require(name, value, range, error)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: value, range(2)
      type(error_type), allocatable, intent(inout) :: error
      if (allocated(error) .or. value >= range(1) .and. value <= range(2)) return
      call raise(error, input_error, 'pads%'//name//' = '//to_text(value)//', from the size of the pad: must be ' &
         & //to_text(range(1))//' to '//to_text(range(2)))
   end subroutine require
end module case_completion
