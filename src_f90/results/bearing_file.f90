!> The results of one bearing in the file of a run: of a bearing of a machine in its group, `bearings/NAME`, and at the
!> root where a rigid journal turns in one bearing. What writes the results of a bearing knows no difference.
module bearing_file
   use kinds, only: wp
   use text, only: replaced
   use case_groups, only: bearing_type
   use record, only: record_type
   use run_file, only: run_file_type
   use machine_results, only: bearing_group
   implicit none (type, external)
   private
   public :: bearing_file_type, new_bearing_file

   !> The results of a bearing, named as those of one bearing are.
   type, extends(record_type) :: bearing_file_type
      !> Those of the whole run.
      class(run_file_type), pointer :: run => null()
      !> Before each name: empty, or the group with a slash at its end.
      character(len=:), allocatable, private :: prefix
   contains
      procedure :: put_dataset
      procedure :: has
      procedure :: get_all
      procedure :: delete
      !> Series: the bearing's own and those of the whole machine (time, shaft angle, speed).
      procedure :: declare
      procedure :: has_series
      procedure :: last_samples
   end type bearing_file_type

contains

   !> The results of a bearing, or without it all, in those of a run, as long as that lives.
   function new_bearing_file(run, bearing) result(part)
      class(run_file_type), intent(in), target :: run
      type(bearing_type), intent(in), optional :: bearing
      type(bearing_file_type) :: part
      part%run => run
      part%prefix = ''
      if (present(bearing)) part%prefix = bearing_group(bearing)
   end function new_bearing_file

   subroutine put_dataset(self, path, kind, values, extents, units, long_name, scales, texts)
      class(bearing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path, units, long_name, scales, texts
      integer, intent(in) :: kind, extents(:)
      real(wp), intent(in) :: values(:)
      call self%run%put_dataset(self%prefix//path, kind, values, extents, units, long_name, &
         & each_with(self%prefix, scales), texts)
   end subroutine put_dataset

   !> Names, separated by blanks, each behind a prefix.
   pure function each_with(prefix, names) result(prefixed)
      character(len=*), intent(in) :: prefix, names
      character(len=:), allocatable :: prefixed
      prefixed = names
      if (prefix /= '' .and. names /= '') prefixed = prefix//replaced(trim(names), ' ', ' '//prefix)
   end function each_with

   logical function has(self, path)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: path
      has = self%run%has(self%prefix//path)
   end function has

   pure function get_all(self, path) result(values)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: path
      real(wp), allocatable :: values(:)
      values = self%run%get_all(self%prefix//path)
   end function get_all

   subroutine delete(self, path)
      class(bearing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      call self%run%delete(self%prefix//path)
   end subroutine delete

   !> A series of this number of values over the axis, or, where `across` names a scale of the bearing, over both.
   subroutine declare(self, name, width, units, long_name, across)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: name, units, long_name, across
      integer, intent(in) :: width
      call self%run%hdf5%declare(self%prefix//name, width, units, long_name, each_with(self%prefix, across))
   end subroutine declare

   logical function has_series(self, name)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: name
      has_series = self%run%hdf5%has_series(self%prefix//name)
   end function has_series

   !> The last n samples of a series of the bearing or of the whole machine, (width, n); n at most those that are kept.
   subroutine last_samples(self, name, n, values)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      if (self%has_series(name)) then
         call self%run%hdf5%last_samples(self%prefix//name, n, values)
      else
         call self%run%hdf5%last_samples(name, n, values)
      end if
   end subroutine last_samples
end module bearing_file
