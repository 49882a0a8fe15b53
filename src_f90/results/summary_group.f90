!> The figures of a run in its file: group `summary`, a number each, or one for each pad.
module summary_group
   use kinds, only: wp
   use hdf5_file, only: hdf5_type
   implicit none (type, external)
   private
   public :: put_figure, figure, pad_figures, has_figure

   interface put_figure
      module procedure :: put_number
      module procedure :: put_list
   end interface put_figure

   character(len=*), parameter :: group = 'summary'

contains

   subroutine put_number(file, name, value, units, long_name)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name, units, long_name
      real(wp), intent(in) :: value
      if (.not. file%has(group)) call file%make_group(group)
      call file%put_real(group//'/'//name, value, units, long_name)
   end subroutine put_number

   !> Of each pad, or of what else the scale `across` counts.
   subroutine put_list(file, name, values, units, long_name, across)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name, units, long_name
      real(wp), intent(in) :: values(:)
      character(len=*), intent(in), optional :: across
      if (.not. file%has(group)) call file%make_group(group)
      if (present(across)) then
         call file%put_list(group//'/'//name, values, units, long_name, across)
      else
         call file%put_list(group//'/'//name, values, units, long_name, 'pad')
      end if
   end subroutine put_list

   !> Whether a run has a figure.
   logical function has_figure(file, name)
      class(hdf5_type), intent(in) :: file
      character(len=*), intent(in) :: name
      has_figure = file%has(group//'/'//name)
   end function has_figure

   !> A number; 0 where there is none.
   real(wp) function figure(file, name)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      figure = 0
      if (has_figure(file, name)) figure = file%get_real(group//'/'//name)
   end function figure

   !> A number for each pad; 0 where there are none.
   function pad_figures(file, name) result(values)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      real(wp), allocatable :: values(:)
      allocate (values(file%list_size('pad')), source=0.0_wp)
      if (has_figure(file, name)) call file%get_list(group//'/'//name, values)
   end function pad_figures
end module summary_group
