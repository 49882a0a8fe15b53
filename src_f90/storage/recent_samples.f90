!> The last samples of a run, and its first one, in memory: what the figures of a run need that keeps no series.
module recent_samples
   use kinds, only: wp, i8
   implicit none (type, external)
   private
   public :: recent_samples_type

   type :: series_type
      character(len=:), allocatable :: name
      !> Values of a sample before its own; its own.
      integer :: before = 0, width = 0
   end type series_type

   type :: recent_samples_type
      private
      type(series_type), allocatable :: series(:)
      !> Of the first sample (:, 0), and the last ones, each at its number modulo their number (:, 1:).
      real(wp), allocatable :: values(:, :)
      integer :: room = 0
      integer(i8) :: count = 0
   contains
      procedure :: begin
      procedure :: declare
      procedure :: is_declared
      procedure :: has
      procedure :: add
      !> Number of the first sample, from 0, from which on all are there.
      procedure :: first
      procedure :: part
   end type recent_samples_type

contains

   !> Series follow, of which this number of samples is kept.
   subroutine begin(self, room)
      class(recent_samples_type), intent(inout) :: self
      integer, intent(in) :: room
      if (allocated(self%values)) deallocate (self%values)
      self%series = [series_type ::]
      self%room = max(1, room)
      self%count = 0
   end subroutine begin

   !> A series with this number of values a sample; all before the first sample.
   subroutine declare(self, name, width)
      class(recent_samples_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: width
      self%series = [self%series, series_type(name, sum(self%series%width), width)]
   end subroutine declare

   pure logical function is_declared(self)
      class(recent_samples_type), intent(in) :: self
      is_declared = size(self%series) > 0
   end function is_declared

   pure logical function has(self, name)
      class(recent_samples_type), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: k
      has = .false.
      if (.not. allocated(self%series)) return
      do k = 1, size(self%series)
         if (self%series(k)%name == name) has = .true.
      end do
   end function has

   !> A sample: the values of all series, in the order in which they were declared.
   subroutine add(self, values)
      class(recent_samples_type), intent(inout) :: self
      real(wp), intent(in) :: values(:)
      if (.not. allocated(self%values)) then
         allocate (self%values(size(values), 0:self%room))
         self%values(:, 0) = values
      end if
      self%values(:, 1 + int(modulo(self%count, int(self%room, i8)))) = values
      self%count = self%count + 1
   end subroutine add

   pure integer(i8) function first(self)
      class(recent_samples_type), intent(in) :: self
      first = max(0_i8, self%count - self%room)
   end function first

   !> The n samples of a series behind the first `skip` ones, (width, n): all kept, or the first one alone.
   subroutine part(self, name, skip, n, values)
      class(recent_samples_type), intent(in) :: self
      character(len=*), intent(in) :: name
      integer(i8), intent(in) :: skip
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      integer :: k, i
      do k = 1, size(self%series)
         if (self%series(k)%name == name) exit
      end do
      associate (own => self%series(k))
         allocate (values(own%width, n))
         do i = 1, n
            associate (place => merge(0, 1 + int(modulo(skip + i - 1, int(self%room, i8))), skip + i == 1))
               values(:, i) = self%values(own%before + 1:own%before + own%width, place)
            end associate
         end do
      end associate
   end subroutine part
end module recent_samples
