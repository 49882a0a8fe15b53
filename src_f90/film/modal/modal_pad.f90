!> One pad of the axial modes: its grid along the arc, its modes and what they leave out, and the fields of the last
!> solution (modal_film).
module modal_pad
   use kinds, only: wp, pi
   use pad_gap, only: pad_gap_type, pad_directions
   use clipped_quadrature, only: gregory_weights, clipped_weights
   use modal_field, only: axial_profile, left_out
   use modal_sweeps, only: lanes, looks
   implicit none (type, external)
   private
   public :: modal_pad_type, init_pad, set_weights, enough_cells, enough_modes
   public :: gauss, middle, point_weights

   !> Largest (Lambda d)^2/12 of a mode on a grid of step d: beyond, its edge layer is thinner than a cell,
   !> and the closed form is better than the grid.
   real(wp), parameter :: stiffest_mode = 0.5_wp
   !> Gauss-Legendre points and weights across the half width, over it. Behind them those where rupture is
   !> looked for, without weight: the middle, and towards the side, where a film that diverges at its trailing
   !> edge first falls below the pressure of its edges.
   integer, parameter :: gauss = 8, middle = 9, all_points = gauss + looks
   real(wp), parameter :: half_points(4) = [0.183434642495650_wp, 0.525532409916329_wp, &
      & 0.796666477413627_wp, 0.960289856497536_wp]
   real(wp), parameter :: half_weights(4) = [0.362683783378362_wp, 0.313706645877887_wp, &
      & 0.222381034453374_wp, 0.101228536290376_wp]
   real(wp), parameter :: points(all_points) = [0.5_wp*(1 + [-half_points, half_points]), &
      & 0.0_wp, 0.75_wp, 0.9_wp, 0.95_wp]
   real(wp), parameter :: point_weights(gauss) = 0.5_wp*[half_weights, half_weights]
   !> Sums over the odd numbers m of 1/m^3, 1/m^4, 1/m^5: 7/8 zeta(3), pi^4/96, 31/32 zeta(5).
   real(wp), parameter :: odd_sums(3) = [7*1.2020569031595943_wp/8, pi**4/96, 31*1.0369277551433699_wp/32]

   !> One pad: grid, modes, and the last solution. Nodes 0:n run from the trailing to the leading edge;
   !> `d` is their distance, rad. Modes fill up blocks of `lanes`; idle lanes have c = 0.
   type :: modal_pad_type
      type(pad_gap_type) :: gap
      type(pad_directions) :: directions
      integer :: n, modes, blocks
      real(wp) :: d, radius
      !> Sine, cosine and weight of the quadrature at the nodes; the weight times either.
      real(wp), allocatable :: sine(:), cosine(:), weight(:), along(:), outward(:)
      !> By lane: c_k = (L/2) b_k^2; (Lambda_k d)^2/12; b_k; and b_k cos(lambda_k Z) at (point, lane), at
      !> Gauss's points and where rupture is looked for.
      real(wp), allocatable :: c(:), stiffness(:), at_middle(:), across(:, :), look(:, :)
      !> Sums over the modes left out of c_k/Lambda_k^j, j = 1, 2, 3, and of b_k cos(lambda_k Z)/Lambda_k^2.
      real(wp) :: tail(3), point_tail(all_points)
      !> At the nodes: film thickness, its derivative over phi, 1/g, v, r, s.
      real(wp), allocatable :: h(:), h_slope(:), per_g(:), v(:), r(:), s(:)
      !> By lane, node and block: a = 1 - d^2 V/12, factors f of the elimination, q.
      real(wp), allocatable :: a(:, :, :), f(:, :, :), q(:, :, :)
      !> What q/g by (lane, node, block) and -r/h^3 by node count along the width: c and tail(2), less the
      !> part of the width where the film has ruptured, if it has.
      real(wp), allocatable :: share(:, :, :), narrow_share(:)
      logical :: shares_are_stale = .true.
   end type modal_pad_type

contains

   !> Cells along the arc, even, and modes with which the error of the force is 1e-4 or less, over pads of 20 to
   !> 120 degrees with lengths of 0.25 to 2 diameters (tests/physics/test_film_accuracy.f90). The measure is a
   !> pad's length over its arc: a narrow film has thin layers along its edges, a wide one takes more modes,
   !> most of all where the supply pressure bends the profile at the leading edge.
   pure integer function enough_cells(gaps)
      type(pad_gap_type), intent(in) :: gaps(:)
      enough_cells = max(24, 2*ceiling(8/minval(aspect(gaps))))
   end function enough_cells

   pure integer function enough_modes(gaps)
      type(pad_gap_type), intent(in) :: gaps(:)
      enough_modes = lanes*maxval(ceiling(aspect(gaps) &
         & /merge(1.2_wp, 2.5_wp, gaps%supply_pressure > gaps%ambient_pressure)))
   end function enough_modes

   !> Axial length over the length of the arc.
   elemental real(wp) function aspect(gap)
      type(pad_gap_type), intent(in) :: gap
      aspect = gap%axial_length/(gap%pad_radius()*gap%arc())
   end function aspect

   pure subroutine init_pad(pad, gap, n, most)
      type(modal_pad_type), intent(out) :: pad
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: n, most
      real(wp) :: phi(0:n), lambda(most), unit, profile(all_points)
      integer :: i, k
      pad%gap = gap
      pad%directions = gap%directions()
      pad%n = n
      pad%radius = gap%pad_radius()
      pad%d = gap%arc()/n
      unit = gap%axial_length/(pi*pad%radius)
      lambda = [((2*k - 1)/unit, k=1, most)]
      pad%modes = count((lambda*pad%d)**2/12 <= stiffest_mode)
      pad%blocks = (pad%modes + lanes - 1)/lanes
      allocate (pad%c(lanes*pad%blocks), pad%stiffness(lanes*pad%blocks), source=0.0_wp)
      allocate (pad%across(gauss, lanes*pad%blocks), source=0.0_wp)
      allocate (pad%at_middle(lanes*pad%blocks), pad%look(looks, lanes*pad%blocks), source=0.0_wp)
      pad%tail = 8*gap%axial_length/pi**2*odd_sums*[unit, unit**2, unit**3]
      pad%point_tail = left_out(gap, pad%modes, points)
      do k = 1, pad%modes
         pad%c(k) = 8*gap%axial_length/((2*k - 1)*pi)**2
         pad%stiffness(k) = (lambda(k)*pad%d)**2/12
         profile = axial_profile(k, points)
         pad%across(:, k) = profile(:gauss)
         pad%at_middle(k) = profile(middle)
         pad%look(:, k) = profile(gauss + 1:)
         pad%tail = pad%tail - pad%c(k)/[lambda(k), lambda(k)**2, lambda(k)**3]
      end do
      phi = [(i*pad%d - gap%trailing_angle, i=0, n)]
      allocate (pad%sine(0:n), pad%cosine(0:n), pad%weight(0:n), pad%along(0:n), pad%outward(0:n))
      pad%sine(:) = sin(phi)
      pad%cosine(:) = cos(phi)
      allocate (pad%h(0:n), pad%h_slope(0:n), pad%per_g(0:n), pad%v(0:n), pad%r(0:n), pad%s(0:n))
      allocate (pad%a(lanes, 0:n, pad%blocks), pad%f(lanes, 0:n, pad%blocks), pad%q(lanes, 0:n, pad%blocks))
      allocate (pad%share(lanes, 0:n, pad%blocks), pad%narrow_share(0:n))
   end subroutine init_pad

   !> The quadrature's weights at the nodes, for a film that is clipped or not.
   pure subroutine set_weights(pad, clipped)
      type(modal_pad_type), intent(inout) :: pad
      logical, intent(in) :: clipped
      if (clipped .or. pad%n < 6) then
         ! the weights of what may be clipped
         call clipped_weights(pad%n, spread(1.0_wp, 1, pad%n + 1), pad%weight)
      else
         ! the layers at the edges are thin: the order of the ends decides
         pad%weight(:) = gregory_weights(pad%n)
      end if
      pad%weight = pad%d*pad%weight
      pad%along(:) = pad%weight*pad%sine
      pad%outward(:) = pad%weight*pad%cosine
   end subroutine set_weights
end module modal_pad
