!> How many cells and modes a film takes (fourier_film): levels of twice the cells and four times the modes each, so
!> that ordinary films take the first.
!>
!> Two numbers of a film tell: the longest cell in lengths of the pad, as the first modes' layers at the sides are as
!> thick as a third of its length; and the pad's length over the distance in which the thin part of the film changes,
!> sqrt((H'/H)^2 + (1 - H)/H) at its thinnest place, up to which the modes are not narrow. The threshold speeds are
!> measured (tests/physics/test_film_accuracy.f90).
module film_resolution
   use kinds, only: wp, pi
   use pad_gap, only: pad_gap_type, pad_directions
   use fourier_pad, only: fourier_pad_type, init_pad
   use fourier_passes, only: simd_width
   implicit none (type, external)
   private
   public :: resolution_type, new_resolution, enough_cells, enough_modes, most_levels, usual_error

   !> Levels at most: in all; of a film with a tolerance above the usual one.
   integer, parameter :: most_levels = 5, loose_levels = 3
   !> The error for which the threshold speeds below hold.
   real(wp), parameter :: usual_error = 1e-4_wp
   !> Cells over the arc's span times the largest H over the pad's length, and the same with the H at a leading edge
   !> under pressure; cells over the span times the largest root of v; modes times the shortest distance, or the
   !> arc's length, over the pad's. For a tolerance the cells go with its power -1/4, the modes with -1/3.
   real(wp), parameter :: cells_by_length = 12, cells_by_layer = 24, cells_by_curvature = 4.5_wp
   real(wp), parameter :: modes_by_slope = 1.5_wp, modes_by_length = 3
   !> Largest (Lambda d)^2/12 of a mode on an even grid of step d where the layer of a pressure at the leading edge has
   !> to be resolved: beyond, the closed form is better than the grid.
   real(wp), parameter :: stiffest_mode = 0.5_wp
   !> And the largest at that edge on the film's own nodes: there the scheme's 1 - d^2 V/12 is 0.
   real(wp), parameter :: stiffest_layer = 1

   type :: resolution_type
      private
      integer :: cells = 0, modes = 0, levels = most_levels
      logical :: follows = .false., floods = .false.
      !> What the threshold speeds are multiplied by.
      real(wp) :: more_cells = 1, more_modes = 1
   contains
      procedure :: level
      procedure :: make_pad
   end type resolution_type

contains

   !> Cells along the arc, even, and modes with which the error of the force of an ordinary film is 1e-4 or less, over
   !> pads of 20 to 120 degrees with lengths of 0.25 to 2 diameters. The measure is a pad's length over its arc: a
   !> narrow film has thin layers along its edges, a wide one takes more modes, most of all where the supply pressure
   !> bends the profile at the leading edge.
   pure integer function enough_cells(gaps)
      type(pad_gap_type), intent(in) :: gaps(:)
      enough_cells = max(24, 2*ceiling(8/minval(aspect(gaps))))
   end function enough_cells

   pure integer function enough_modes(gaps)
      type(pad_gap_type), intent(in) :: gaps(:)
      enough_modes = simd_width*maxval(ceiling(aspect(gaps) &
         & /merge(1.2_wp, 2.5_wp, gaps%supply_pressure > gaps%ambient_pressure)))
   end function enough_modes

   !> Axial length over the length of the arc.
   elemental real(wp) function aspect(gap)
      type(pad_gap_type), intent(in) :: gap
      aspect = gap%axial_length/(gap%pad_radius()*gap%arc())
   end function aspect

   !> A resolution that follows the film, with at least these cells and modes, where a tolerance is given; else these.
   pure function new_resolution(gap, cells, modes, tolerance) result(self)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: cells, modes
      real(wp), intent(in), optional :: tolerance
      type(resolution_type) :: self
      integer :: k
      self%cells = cells
      self%modes = modes
      self%floods = gap%supply_pressure > gap%ambient_pressure
      self%follows = present(tolerance)
      if (self%follows) then
         if (tolerance > usual_error) self%levels = loose_levels
         self%more_cells = (usual_error/tolerance)**0.25_wp
         self%more_modes = (usual_error/tolerance)**(1.0_wp/3)
      end if
      if (self%floods .or. .not. self%follows) then
         self%modes = count([((2*k - 1)*pi <= sqrt(12*stiffest_mode)*aspect(gap)*cells, k=1, modes)])
      end if
   end function new_resolution

   !> The level of a film, 1 to most_levels.
   pure integer function level(self, gap, directions, e, along)
      class(resolution_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(pad_directions), intent(in) :: directions
      !> Position over the clearance; the arc's span (sommerfeld_nodes).
      real(wp), intent(in) :: e(2), along
      real(wp) :: k, distance, edges(2), least, most, width, cells, modes
      level = 1
      if (.not. self%follows) return
      k = dot_product(e, e) - 1
      distance = sqrt(k + 1)
      edges = 1 - [dot_product(e, directions%leading), dot_product(e, directions%trailing)]
      least = minval(edges)
      most = maxval(edges)
      if (dot_product(e, directions%middle) > distance*directions%half(2)) least = 1 - distance
      if (-dot_product(e, directions%middle) > distance*directions%half(2)) most = 1 + distance
      width = gap%axial_length/gap%pad_radius()
      cells = max(cells_by_length*most/width, cells_by_curvature*sqrt(max(0.0_wp, k + 9.0_wp/8)))
      if (self%floods) cells = max(cells, max(cells_by_layer, (2*self%modes - 1)*pi/sqrt(12*stiffest_layer)) &
         & *edges(1)/width)
      cells = self%more_cells*along*cells
      modes = self%more_modes*max(modes_by_length*aspect(gap), &
         & modes_by_slope*width*sqrt(max(0.0_wp, k + least*(3 - 2*least)))/least)
      do while (level < self%levels .and. (cells > self%cells*2**(level - 1) .or. modes > modes_at(self, level)))
         level = level + 1
      end do
   end function level

   pure integer function modes_at(self, level)
      class(resolution_type), intent(in) :: self
      integer, intent(in) :: level
      modes_at = self%modes*merge(2, 4, self%floods)**(level - 1)
   end function modes_at

   !> The pad at a level.
   pure subroutine make_pad(self, gap, level, pad)
      class(resolution_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: level
      type(fourier_pad_type), intent(out) :: pad
      call init_pad(pad, gap, self%cells*2**(level - 1)*merge(2, 1, self%floods .and. level > 1), &
         & modes_at(self, level), .not. self%follows .or. self%floods)
   end subroutine make_pad
end module film_resolution
