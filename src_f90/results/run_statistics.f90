!> What a run cost: a list of figures. Whoever counts one names it, once, in `put`; adding, writing and reading run
!> over the list.
module run_statistics
   use kinds, only: wp, i8
   use hdf5_file, only: hdf5_type
   implicit none (type, external)
   private
   public :: run_statistics_type

   !> A number of things, or seconds.
   type :: figure_type
      character(len=:), allocatable :: name, long_name
      logical :: counts = .true.
      integer(i8) :: count = 0
      real(wp) :: seconds = 0
   end type figure_type

   type :: run_statistics_type
      private
      type(figure_type), allocatable :: figures(:)
   contains
      !> Puts a figure on the list: a count, or s.
      generic :: put => put_count, put_seconds
      !> A figure of the list by its name; 0 where there is none.
      procedure :: count => count_of
      procedure :: seconds => seconds_of
      procedure :: add
      procedure :: write => write_all
      procedure :: read => read_all
      procedure, private :: put_count
      procedure, private :: put_seconds
   end type run_statistics_type

   !> Group of the file.
   character(len=*), parameter :: group = 'statistics'

contains

   subroutine put_count(self, name, value, long_name)
      class(run_statistics_type), intent(inout) :: self
      character(len=*), intent(in) :: name, long_name
      integer(i8), intent(in) :: value
      call append(self, figure_type(name, long_name, counts=.true., count=value))
   end subroutine put_count

   subroutine put_seconds(self, name, value, long_name)
      class(run_statistics_type), intent(inout) :: self
      character(len=*), intent(in) :: name, long_name
      real(wp), intent(in) :: value
      call append(self, figure_type(name, long_name, counts=.false., seconds=value))
   end subroutine put_seconds

   subroutine append(self, figure)
      type(run_statistics_type), intent(inout) :: self
      type(figure_type), intent(in) :: figure
      type(figure_type), allocatable :: longer(:)
      integer :: n
      n = 0
      if (allocated(self%figures)) n = size(self%figures)
      allocate (longer(n + 1))
      if (n > 0) longer(:n) = self%figures
      longer(n + 1) = figure
      call move_alloc(longer, self%figures)
   end subroutine append

   pure integer(i8) function count_of(self, name) result(count)
      class(run_statistics_type), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: k
      count = 0
      if (.not. allocated(self%figures)) return
      do k = 1, size(self%figures)
         if (self%figures(k)%name == name) count = self%figures(k)%count
      end do
   end function count_of

   pure real(wp) function seconds_of(self, name) result(seconds)
      class(run_statistics_type), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: k
      seconds = 0
      if (.not. allocated(self%figures)) return
      do k = 1, size(self%figures)
         if (self%figures(k)%name == name) seconds = self%figures(k)%seconds
      end do
   end function seconds_of

   !> Adds to each figure that of the same name in another list, if it is there.
   subroutine add(self, other)
      class(run_statistics_type), intent(inout) :: self
      class(run_statistics_type), intent(in) :: other
      integer :: k
      do k = 1, size(self%figures)
         associate (figure => self%figures(k))
            figure%count = figure%count + other%count(figure%name)
            figure%seconds = figure%seconds + other%seconds(figure%name)
         end associate
      end do
   end subroutine add

   subroutine write_all(self, file)
      class(run_statistics_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      integer :: k
      if (.not. file%has(group)) call file%make_group(group)
      do k = 1, size(self%figures)
         associate (figure => self%figures(k))
            if (figure%counts) then
               call file%put_count(group//'/'//figure%name, figure%count, figure%long_name)
            else
               call file%put_real(group//'/'//figure%name, figure%seconds, 's', figure%long_name)
            end if
         end associate
      end do
   end subroutine write_all

   !> Gives the figures of the list the values in a file.
   subroutine read_all(self, file)
      class(run_statistics_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer :: k
      do k = 1, size(self%figures)
         associate (figure => self%figures(k))
            if (figure%counts) then
               figure%count = file%get_count(group//'/'//figure%name)
            else
               figure%seconds = file%get_real(group//'/'//figure%name)
            end if
         end associate
      end do
   end subroutine read_all
end module run_statistics
