!> What a case must be whose thresholds are to tell what the limit cycles do that begin there.
module threshold_checks
   use errors, only: error_type, require
   use case_inputs, only: case_type
   implicit none (type, external)
   private
   public :: check_threshold_cycles

contains

   subroutine check_threshold_cycles(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      integer :: b
      if (.not. inputs%coefficients%threshold_born) return
      call require(inputs%coefficients%threshold_up_to_rpm > 0, 'coefficients%threshold_born = .true.: needs ' &
         & //'coefficients%threshold_up_to_rpm, the speed in rpm up to which thresholds and their cycles are sought', &
         & error)
      do b = 1, size(inputs%bearings)
         associate (model => inputs%bearings(b)%friction%model)
            call require(model /= 'bengisu_akay', inputs%bearings(b)%label(': ')//'friction%model = '''//model &
               & //''': must be ''none'' or ''lugre'' with coefficients%threshold_born, as pivots at rest hold with ' &
               & //'no stiffness there', error)
         end associate
      end do
   end subroutine check_threshold_cycles
end module threshold_checks
