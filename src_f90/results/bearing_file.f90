!> The results of one bearing in the file of a run: of a bearing of a machine in its group, `bearings/NAME`, and at the
!> root where a rigid journal turns in one bearing. What writes the results of a bearing knows no difference.
module bearing_file
   use kinds, only: wp, i8, pi
   use case_groups, only: bearing_type
   use record, only: record_type
   use run_file, only: run_file_type
   use machine_results, only: bearing_group
   implicit none (type, external)
   private
   public :: bearing_file_type, new_bearing_file

   !> The results of a bearing, named as those of one bearing are. Its series are its own and those of the whole machine
   !> (time, shaft angle, speed).
   type, extends(record_type) :: bearing_file_type
      class(run_file_type), pointer, private :: run => null()
      !> Before each name: empty, or the group with a slash at its end.
      character(len=:), allocatable, private :: prefix
   contains
      procedure :: put
      procedure :: put_text
      procedure :: has => has_result
      procedure :: get_real
      procedure :: get_list
      procedure :: list_size
      procedure :: get_text
      procedure :: samples
      procedure :: declare
      procedure :: last_samples
      procedure :: part_of_samples
      procedure :: sampled_revolutions
      procedure :: last_revolutions
   end type bearing_file_type

contains

   !> The results of a bearing in those of its run, as long as that lives.
   function new_bearing_file(run, bearing) result(part)
      class(run_file_type), intent(in), target :: run
      type(bearing_type), intent(in) :: bearing
      type(bearing_file_type) :: part
      part%run => run
      part%prefix = bearing_group(bearing)
   end function new_bearing_file

   subroutine put(self, path, kind, values, extents, units, long_name, scales, texts)
      class(bearing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path, units, long_name, scales, texts
      integer, intent(in) :: kind, extents(:)
      real(wp), intent(in) :: values(:)
      if (self%prefix == '') then
         call self%run%put(path, kind, values, extents, units, long_name, scales, texts)
      else
         call self%run%put(self%prefix//path, kind, values, extents, units, long_name, &
            & each_with(self%prefix, scales), texts)
      end if
   end subroutine put

   !> Names, separated by blanks, each behind a prefix.
   pure function each_with(prefix, names) result(prefixed)
      character(len=*), intent(in) :: prefix, names
      character(len=:), allocatable :: prefixed
      integer :: i
      prefixed = ''
      do i = 1, len_trim(names)
         if (i == 1) then
            prefixed = prefix
         else if (names(i - 1:i - 1) == ' ') then
            prefixed = prefixed//prefix
         end if
         prefixed = prefixed//names(i:i)
      end do
   end function each_with

   subroutine put_text(self, name, text)
      class(bearing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name, text
      call self%run%put_text(self%prefix//name, text)
   end subroutine put_text

   logical function has_result(self, path)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: path
      has_result = self%run%has(self%prefix//path)
   end function has_result

   pure real(wp) function get_real(self, path)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: path
      get_real = self%run%get_real(self%prefix//path)
   end function get_real

   subroutine get_list(self, path, values)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: path
      real(wp), intent(out) :: values(:)
      call self%run%get_list(self%prefix//path, values)
   end subroutine get_list

   pure integer function list_size(self, path)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: path
      list_size = self%run%list_size(self%prefix//path)
   end function list_size

   subroutine get_text(self, name, text)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable, intent(out) :: text
      call self%run%get_text(self%prefix//name, text)
   end subroutine get_text

   !> Samples added, also before the run was resumed.
   pure integer(i8) function samples(self)
      class(bearing_file_type), intent(in) :: self
      samples = self%run%samples
   end function samples

   !> A series of this number of values over the axis, or, where `across` names a scale of the bearing, over both.
   subroutine declare(self, name, width, across, units, long_name)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: name, across, units, long_name
      integer, intent(in) :: width
      call self%run%declare(self%prefix//name, width, each_with(self%prefix, across), units, long_name)
   end subroutine declare

   !> The last n samples of a series, (width, n); n at most those that are kept.
   subroutine last_samples(self, name, n, values)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      call self%run%last_samples(series(self, name), n, values)
   end subroutine last_samples

   !> The n samples of a series behind the first `skip` ones, (width, n): all kept, or the first one alone.
   subroutine part_of_samples(self, name, skip, n, values)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: name
      integer(i8), intent(in) :: skip
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      call self%run%part_of_samples(series(self, name), skip, n, values)
   end subroutine part_of_samples

   !> Revolutions from the first sample to the last.
   real(wp) function sampled_revolutions(self) result(revolutions)
      class(bearing_file_type), intent(in) :: self
      real(wp), allocatable :: first(:, :), last(:, :)
      call self%part_of_samples('shaft_angle', 0_i8, 1, first)
      call self%last_samples('shaft_angle', 1, last)
      revolutions = (last(1, 1) - first(1, 1))/(2*pi)
   end function sampled_revolutions

   !> Samples of the last `count` revolutions, both ends included; all where there are fewer.
   integer function last_revolutions(self, count) result(n)
      class(bearing_file_type), intent(in) :: self
      integer, intent(in) :: count
      real(wp), allocatable :: angle(:, :)
      real(wp) :: start
      integer(i8) :: low, high, middle
      high = self%samples() - 1
      low = self%run%first_sample()
      if (high > low) then
         call self%last_samples('shaft_angle', 2, angle)
         ! half a sample more, so that rounding loses none
         start = angle(1, 2) - 2*pi*count - 0.5_wp*(angle(1, 2) - angle(1, 1))
         do while (low < high)
            middle = (low + high)/2
            call self%part_of_samples('shaft_angle', middle, 1, angle)
            if (angle(1, 1) < start) then
               low = middle + 1
            else
               high = middle
            end if
         end do
      end if
      n = int(self%samples() - low)
   end function last_revolutions

   !> The name of a series in the file: that of the bearing, or of the whole machine.
   function series(self, name)
      class(bearing_file_type), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: series
      series = name
      if (self%prefix == '') return
      if (self%run%has(self%prefix//name)) series = self%prefix//name
   end function series
end module bearing_file
