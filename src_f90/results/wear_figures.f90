!> Wear of the pivots in the last revolution of a march, by Archard's law: the worn volume is the wear coefficient times
!> the integral of the pivot load over the distance slid.
module wear_figures
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp, pi
   use case_groups, only: pivot_type
   use contact_law, only: contact_law_type, contact_point
   use factories, only: make_law
   use loops, only: integral_over_way
   use bearing_file, only: bearing_file_type
   use summary_group, only: put_figure
   implicit none (type, external)
   private
   public :: put_wear

contains

   !> The rates at which the pivots wear in the last samples, at these times, s: volume, and depth over the area of the
   !> contact under the mean pivot load. What LuGre's bristles give back is not slid.
   subroutine put_wear(file, pivot, time)
      type(bearing_file_type), intent(inout) :: file
      type(pivot_type), intent(in) :: pivot
      real(wp), intent(in) :: time(:)
      real(wp), allocatable :: tilt(:, :), load(:, :), bristle(:, :)
      real(wp), dimension(size(pivot%socket_radius)) :: volume, depth
      class(contact_law_type), allocatable :: law
      type(contact_point) :: contact
      integer :: i
      call file%last_samples('pad_tilt', size(time), tilt)
      call file%last_samples('pivot_load', size(time), load)
      allocate (bristle, source=0*tilt)
      if (file%has('bristle_deflection')) call file%last_samples('bristle_deflection', size(time), bristle)
      associate (lasted => time(size(time)) - time(1))
         do i = 1, size(volume)
            volume(i) = pivot%wear_coefficient*integral_over_way((pivot%socket_radius(i) &
               & - pivot%radius_difference(i))*tilt(i, :) - bristle(i, :), load(i, :))/lasted
            depth(i) = 0
            if (.not. volume(i) > 0) cycle
            call make_law(pivot, i, law)
            contact = law%at(law%pivot_deflection(sum(load(i, :))/size(time)))
            ! a measured law does not tell the radius
            depth(i) = ieee_value(0.0_wp, ieee_quiet_nan)
            if (contact%radius > 0) depth(i) = volume(i)/(pi*contact%radius**2)
         end do
      end associate
      call put_figure(file, 'pad_wear_rate', volume, 'm^3/s', 'worn volume of the pivot in a second')
      call put_figure(file, 'pad_wear_depth_rate', depth, 'm/s', 'depth worn off the pivot in a second')
   end subroutine put_wear
end module wear_figures
