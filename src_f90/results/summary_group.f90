!> The figures of a run in its file: group `summary`, a number each, or one for each pad; and the extremes of
!> all samples, which are among them.
module summary_group
   use kinds, only: wp
   use record, only: record_type
   use bearing_samples, only: bearing_sample
   implicit none (type, external)
   private
   public :: put_figure, figure, pad_figures, has_figure, forget_figures, run_extremes_type

   !> The least film, the highest pressure and the contact of asperities in all samples of a run.
   type :: run_extremes_type
      private
      real(wp) :: film = huge(1.0_wp), pressure = -huge(1.0_wp)
      !> Of each pad: highest force between asperities, N, and samples with such a force.
      real(wp), allocatable :: force(:), touches(:)
      !> Whether asperities may touch.
      logical :: asperities = .false.
   contains
      procedure :: add
      procedure :: write => write_extremes
      procedure :: read => read_extremes
   end type run_extremes_type

   character(len=*), parameter :: group = 'summary'

contains

   !> A number, or one of each pad, or of what else the scale `across` counts.
   subroutine put_figure(file, name, values, units, long_name, across)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: name, units, long_name
      real(wp), intent(in) :: values(..)
      character(len=*), intent(in), optional :: across
      character(len=:), allocatable :: scales
      scales = 'pad'
      if (present(across)) scales = across
      call file%put(group//'/'//name, values, units, long_name, scales)
   end subroutine put_figure

   !> Whether a run has a figure.
   logical function has_figure(file, name)
      class(record_type), intent(in) :: file
      character(len=*), intent(in) :: name
      has_figure = file%has(group//'/'//name)
   end function has_figure

   !> Takes figures away that an earlier part of the run had.
   subroutine forget_figures(file, names)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: names(:)
      integer :: k
      do k = 1, size(names)
         if (has_figure(file, trim(names(k)))) call file%delete(group//'/'//trim(names(k)))
      end do
   end subroutine forget_figures

   !> A number; 0 where there is none.
   real(wp) function figure(file, name)
      class(record_type), intent(in) :: file
      character(len=*), intent(in) :: name
      figure = file%get_real(group//'/'//name)
   end function figure

   !> A number for each pad; 0 where there are none.
   function pad_figures(file, name) result(values)
      class(record_type), intent(in) :: file
      character(len=*), intent(in) :: name
      real(wp), allocatable :: values(:)
      allocate (values(file%list_size('pad')))
      call file%get_list(group//'/'//name, values)
   end function pad_figures

   subroutine add(self, sample)
      class(run_extremes_type), intent(inout) :: self
      type(bearing_sample), intent(in) :: sample
      integer :: i
      if (.not. allocated(self%force)) then
         allocate (self%force(size(sample%loads)), self%touches(size(sample%loads)))
         self%force = 0
         self%touches = 0
      end if
      self%asperities = sample%asperities
      do i = 1, size(sample%loads)
         associate (pad => sample%loads(i))
            self%film = min(self%film, pad%min_film_thickness)
            self%pressure = max(self%pressure, pad%max_pressure)
            self%force(i) = max(self%force(i), pad%asperity_force)
            if (pad%asperity_force > 0) self%touches(i) = self%touches(i) + 1
         end associate
      end do
   end subroutine add

   !> Writes them as figures of a run with this load on the journal, N, and interval between samples, s.
   subroutine write_extremes(self, file, load, interval)
      class(run_extremes_type), intent(in) :: self
      class(record_type), intent(inout) :: file
      real(wp), intent(in) :: load, interval
      call put_figure(file, 'run_min_film_thickness', self%film, 'm', 'minimum film thickness of the whole run')
      call put_figure(file, 'run_max_pressure', self%pressure, 'Pa', 'maximum pressure of the whole run')
      if (.not. self%asperities) return
      call put_figure(file, 'pad_asperity_force', self%force, 'N', 'highest asperity force of the whole run')
      if (load > 0) call put_figure(file, 'pad_asperity_share', self%force/load, '1', &
         & 'highest asperity force of the whole run over the load')
      call put_figure(file, 'pad_asperity_time', self%touches*interval, 's', &
         & 'time of the whole run in which asperities touched')
   end subroutine write_extremes

   !> Goes on from those of a file with samples at this interval, s.
   subroutine read_extremes(self, file, interval)
      class(run_extremes_type), intent(inout) :: self
      class(record_type), intent(in) :: file
      real(wp), intent(in) :: interval
      if (.not. has_figure(file, 'run_min_film_thickness')) return
      self%film = figure(file, 'run_min_film_thickness')
      self%pressure = figure(file, 'run_max_pressure')
      self%asperities = has_figure(file, 'pad_asperity_force')
      self%force = pad_figures(file, 'pad_asperity_force')
      self%touches = anint(pad_figures(file, 'pad_asperity_time')/interval)
   end subroutine read_extremes
end module summary_group
