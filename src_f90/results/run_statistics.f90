!> What a run cost: a list of figures. Whoever counts one names it, once, in `put`; adding, writing and reading run
!> over the list.
module run_statistics
   use kinds, only: wp, i8
   use record, only: record_type
   implicit none (type, external)
   private
   public :: run_statistics_type

   !> A number of things, or seconds.
   type :: figure_type
      character(len=:), allocatable :: name, long_name
      logical :: counts = .true.
      real(wp) :: value = 0
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
      call append(self, figure_type(name, long_name, .true., real(value, wp)))
   end subroutine put_count

   subroutine put_seconds(self, name, value, long_name)
      class(run_statistics_type), intent(inout) :: self
      character(len=*), intent(in) :: name, long_name
      real(wp), intent(in) :: value
      call append(self, figure_type(name, long_name, .false., value))
   end subroutine put_seconds

   subroutine append(self, figure)
      type(run_statistics_type), intent(inout) :: self
      type(figure_type), intent(in) :: figure
      if (.not. allocated(self%figures)) allocate (self%figures(0))
      self%figures = [self%figures, figure]
   end subroutine append

   pure integer(i8) function count_of(self, name) result(count)
      class(run_statistics_type), intent(in) :: self
      character(len=*), intent(in) :: name
      count = nint(self%seconds(name), i8)
   end function count_of

   pure real(wp) function seconds_of(self, name) result(value)
      class(run_statistics_type), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: k
      value = 0
      if (.not. allocated(self%figures)) return
      do k = 1, size(self%figures)
         if (self%figures(k)%name == name) value = self%figures(k)%value
      end do
   end function seconds_of

   !> Adds to each figure that of the same name in another list, if it is there.
   subroutine add(self, other)
      class(run_statistics_type), intent(inout) :: self
      class(run_statistics_type), intent(in) :: other
      integer :: k
      do k = 1, size(self%figures)
         self%figures(k)%value = self%figures(k)%value + other%seconds(self%figures(k)%name)
      end do
   end subroutine add

   subroutine write_all(self, file)
      class(run_statistics_type), intent(in) :: self
      class(record_type), intent(inout) :: file
      integer :: k
      do k = 1, size(self%figures)
         associate (figure => self%figures(k), path => group//'/'//self%figures(k)%name)
            if (figure%counts) then
               call file%put_count(path, nint(figure%value, i8), figure%long_name)
            else
               call file%put_real(path, figure%value, 's', figure%long_name)
            end if
         end associate
      end do
   end subroutine write_all

   !> Gives the figures of the list the values in a file.
   subroutine read_all(self, file)
      class(run_statistics_type), intent(inout) :: self
      class(record_type), intent(inout) :: file
      integer :: k
      do k = 1, size(self%figures)
         associate (figure => self%figures(k), path => group//'/'//self%figures(k)%name)
            figure%value = file%get_real(path)
         end associate
      end do
   end subroutine read_all
end module run_statistics
