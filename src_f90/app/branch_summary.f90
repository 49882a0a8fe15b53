!> What a run prints of its branches: bifurcation points as they are found, and at the end all of it.
module branch_summary
   use kinds, only: wp
   use text, only: to_text, fixed_text
   use case_inputs, only: case_type
   use bifurcations, only: bifurcation_type
   use run_file, only: run_file_type
   use bearing_file, only: bearing_file_type, new_bearing_file
   implicit none (type, external)
   private
   public :: print_bifurcation, print_branch, branch_end

contains

   !> A bifurcation point, found between two points.
   subroutine print_bifurcation(special, parameter, warm)
      type(bifurcation_type), intent(in) :: special
      character(len=*), intent(in) :: parameter
      !> Whether the oil has temperatures.
      logical, intent(in) :: warm
      associate (value => special%value)
         print '(a)', '  '//trim(special%kind)//' at '//parameter//' = '//precise(special%point%parameter)//', ' &
            & //fixed_text(value%re, 4)//merge(' + ', ' - ', value%im >= 0)//fixed_text(abs(value%im), 4)//' i' &
            & //frozen(warm)
      end associate
   end subroutine print_bifurcation

   !> Ten significant digits.
   function precise(x) result(digits)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: digits
      character(len=24) :: buffer
      write (buffer, '(ss,g0.10)') x
      digits = trim(buffer)
   end function precise

   !> The line that says where and why a branch ended.
   function branch_end(branch, parameter, value, reason) result(line)
      integer, intent(in) :: branch
      character(len=*), intent(in) :: parameter, reason
      real(wp), intent(in) :: value
      character(len=:), allocatable :: line
      line = 'branch '//to_text(branch)//' ends at '//parameter//' = '//precise(value)//': '//reason
   end function branch_end

   !> All branches: points, those that are stable, what warm oil does, and their ends.
   subroutine print_branch(file, inputs, parameter, warm)
      type(run_file_type), intent(inout), target :: file
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: parameter
      logical, intent(in) :: warm
      real(wp), allocatable, dimension(:, :) :: branch, stable, value
      character(len=:), allocatable :: ends
      integer :: k, b
      call file%hdf5%last_samples('branch', int(file%hdf5%samples), branch)
      call file%hdf5%last_samples('stable', int(file%hdf5%samples), stable)
      call file%hdf5%last_samples('parameter', int(file%hdf5%samples), value)
      do k = 1, nint(maxval(branch))
         associate (own => nint(branch(1, :)) == k)
            print '(a)', 'branch '//to_text(k)//': '//to_text(count(own))//' points, '//parameter//' from ' &
               & //precise(minval(value(1, :), mask=own))//' to '//precise(maxval(value(1, :), mask=own))//', ' &
               & //to_text(count(own .and. stable(1, :) > 0))//' of them stable' &
               & //frozen(warm)
            do b = 1, merge(size(inputs%bearings), 0, warm)
               call print_oil(new_bearing_file(file, inputs%bearings(b)), inputs%bearings(b)%label(', ')//'pad ', own)
            end do
         end associate
      end do
      call file%get_text('branch_ends', ends)
      print '(a)', ends
   end subroutine print_branch

   !> What stability stands for where the oil has temperatures.
   pure function frozen(warm) result(text)
      logical, intent(in) :: warm
      character(len=:), allocatable :: text
      text = ''
      if (warm) text = ' at frozen viscosity'
   end function frozen

   !> The range of the temperatures and viscosity of each pad of a bearing over the points of a branch.
   subroutine print_oil(file, title, own)
      type(bearing_file_type), intent(in) :: file
      character(len=*), intent(in) :: title
      logical, intent(in) :: own(:)
      real(wp), allocatable, dimension(:, :) :: mean, highest, viscosity
      integer :: i
      call file%last_samples('mean_temperature', size(own), mean)
      call file%last_samples('maximum_temperature', size(own), highest)
      call file%last_samples('viscosity', size(own), viscosity)
      do i = 1, size(mean, 1)
         print '(a)', '  '//title//to_text(i)//': mean '//span(mean(i, :), 1)//' C, ' &
            & //span(1e3_wp*viscosity(i, :), 2)//' mPa s, pad at most ' &
            & //fixed_text(maxval(highest(i, :), mask=own), 1)//' C'
      end do
   contains
      !> "lowest to highest", with this number of decimals.
      function span(values, decimals) result(text)
         real(wp), intent(in) :: values(:)
         integer, intent(in) :: decimals
         character(len=:), allocatable :: text
         text = fixed_text(minval(values, mask=own), decimals)//' to '//fixed_text(maxval(values, mask=own), decimals)
      end function span
   end subroutine print_oil
end module branch_summary
