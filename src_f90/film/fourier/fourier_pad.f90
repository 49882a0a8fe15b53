!> One pad of the axial modes at one resolution: its nodes, its modes, and the fields of the last solution
!> (fourier_film).
module fourier_pad
   use kinds, only: wp
   use film_solver, only: film_motion, film_oil
   use film_oils, only: arc_weights
   use pad_gap, only: pad_gap_type, pad_directions
   use axial_modes, only: axial_modes_type, new_axial_modes
   use clipped_quadrature, only: gregory_weights, clipped_weights
   use sommerfeld_nodes, only: place_nodes
   use fourier_passes, only: simd_width, looks
   implicit none (type, external)
   private
   public :: fourier_pad_type, init_pad, set_weights, set_motion
   public :: gauss, middle, point_weights

   !> Points and weights across the half width, over it: Gauss-Legendre's over the root of the distance from the side,
   !> beside which the pressure of an uneven film falls steeply. Behind them those where cavitation is looked for,
   !> without weight: the middle, and towards the side, where a film that diverges at its trailing edge first falls
   !> below the pressure of its edges.
   integer, parameter :: gauss = 8, middle = 9, all_points = gauss + looks
   real(wp), parameter :: half_points(4) = [0.183434642495650_wp, 0.525532409916329_wp, &
      & 0.796666477413627_wp, 0.960289856497536_wp]
   real(wp), parameter :: half_weights(4) = [0.362683783378362_wp, 0.313706645877887_wp, &
      & 0.222381034453374_wp, 0.101228536290376_wp]
   real(wp), parameter :: roots(gauss) = 0.5_wp*(1 + [-half_points, half_points])
   real(wp), parameter :: points(all_points) = [1 - roots**2, 0.0_wp, 0.75_wp, 0.9_wp, 0.95_wp]
   real(wp), parameter :: point_weights(gauss) = roots*[half_weights, half_weights]

   !> One pad. Nodes 0:n run from the trailing to the leading edge at equal steps d of Sommerfeld's variable; film
   !> thickness H, and position e are over the clearance. Modes fill up blocks of ``simd_width``;
   !> idle `simd_width` have c = 0.
   type :: fourier_pad_type
      type(pad_gap_type) :: gap
      type(pad_directions) :: directions
      type(axial_modes_type) :: axial
      integer :: n = 0
      real(wp) :: d, radius
      !> Weights of the quadrature, in steps; whether they are those of a film that is clipped.
      real(wp), allocatable :: weight(:)
      logical :: clipped = .false.
      !> b_k cos(lambda_k Z) at (point, slot), at Gauss's points and where cavitation is looked for, and in the middle;
      !> sums over the modes left out of b_k cos(lambda_k Z)/Lambda_k^2.
      real(wp), allocatable :: across(:, :), look(:, :), at_middle(:)
      real(wp) :: point_tail(all_points)
      !> Factors of dH/dphi and of w_1 sin(phi) + w_2 cos(phi) in s; e; velocity w, m/s.
      real(wp) :: wedge, squeeze, e(2), w(2)
      !> At the nodes: H, sine and cosine of phi, s and s/H^2; 1 - d^2 v/12, d^2 H^2/12 and the scheme's load.
      real(wp), allocatable, dimension(:) :: h, sine, cosine, s, narrow, base, rate, load
      !> Of the oil, and what its uneven viscosity makes of q and s at the nodes (fourier_film): q over pressure and the
      !> root of 12 mu f2, upside down, with which q counts; its weights, where it varies.
      type(film_oil) :: oil
      real(wp), allocatable, dimension(:) :: lift, ease
      type(arc_weights) :: weights
      !> By slot, node and block: a = 1 - d^2 V/12, factors f of the elimination, q.
      real(wp), allocatable :: a(:, :, :), f(:, :, :), q(:, :, :)
      !> What q by (slot, node, block) and -s/H^2 by node count along the width: c and tail(2), less the part of the
      !> width where the film has cavitated, if it has; and what the cavitation pressure counts there.
      real(wp), allocatable :: share(:, :, :), narrow_share(:), floor_share(:)
      logical :: shares_are_stale = .true.
   end type fourier_pad_type

contains

   !> A pad with n cells, n even, and a number of modes: all of them solved, or as many as suffice.
   pure subroutine init_pad(pad, gap, n, modes, all_solved)
      type(fourier_pad_type), intent(out) :: pad
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: n, modes
      logical, intent(in) :: all_solved
      real(wp), allocatable :: profile(:)
      integer :: i
      pad%gap = gap
      pad%directions = gap%directions()
      pad%axial = new_axial_modes(gap, modes, all_solved)
      pad%n = n
      pad%radius = gap%pad_radius()
      associate (blocks => pad%axial%blocks)
         allocate (pad%across(gauss, simd_width*blocks), pad%look(looks, simd_width*blocks))
         do i = 1, all_points
            profile = pad%axial%profile(points(i))
            if (i <= gauss) pad%across(i, :) = profile
            if (i > gauss) pad%look(i - gauss, :) = profile
            if (i == middle) pad%at_middle = profile
            pad%point_tail(i) = pad%axial%left_out(points(i))
         end do
         allocate (pad%weight(0:n), pad%h(0:n), pad%sine(0:n), pad%cosine(0:n), pad%s(0:n), pad%narrow(0:n), &
            & pad%base(0:n), pad%rate(0:n), pad%load(0:n), pad%lift(0:n))
         allocate (pad%ease(0:n), source=1.0_wp)
         allocate (pad%a(simd_width, 0:n, blocks), pad%f(simd_width, 0:n, blocks), pad%q(simd_width, 0:n, blocks))
         allocate (pad%share(simd_width, 0:n, blocks), pad%narrow_share(0:n), pad%floor_share(0:n))
      end associate
      call set_weights(pad, .false.)
   end subroutine init_pad

   !> The quadrature's weights at the nodes, for a film that is clipped or not.
   pure subroutine set_weights(pad, clipped)
      type(fourier_pad_type), intent(inout) :: pad
      logical, intent(in) :: clipped
      pad%clipped = clipped
      if (clipped .or. pad%n < 6) then
         ! the weights of what may be clipped
         call clipped_weights(pad%n, spread(1.0_wp, 1, pad%n + 1), pad%weight)
      else
         ! the layers at the edges are thin: the order of the ends decides
         pad%weight(:) = gregory_weights(pad%n)
      end if
   end subroutine set_weights

   !> Nodes and source at a motion that leaves the film open, with an oil, and a journal speed, rad/s.
   pure subroutine set_motion(pad, motion, oil, speed, along)
      type(fourier_pad_type), intent(inout) :: pad
      type(film_motion), intent(in) :: motion
      type(film_oil), intent(in) :: oil
      !> The arc's span (sommerfeld_nodes).
      real(wp), intent(in) :: speed, along
      associate (gap => pad%gap)
         pad%e = motion%position/gap%machined_clearance
         pad%w = motion%velocity
         pad%d = along/pad%n
         pad%wedge = -6*oil%viscosity*pad%radius*speed*gap%journal_radius/gap%machined_clearance**2
         pad%squeeze = -12*oil%viscosity*pad%radius**2/gap%machined_clearance**3
      end associate
      call place_nodes(pad%n, pad%d, pad%e, pad%directions, pad%h, pad%sine, pad%cosine)
      call set_nodes(pad%n, pad%d, pad%e, [pad%wedge*pad%e(2) + pad%squeeze*pad%w(1), &
         & -pad%wedge*pad%e(1) + pad%squeeze*pad%w(2)], pad%h, pad%sine, pad%cosine, pad%s, pad%narrow, pad%base, &
         & pad%rate, pad%load)
      if (oil%varies) then
         call set_uneven(pad, oil)
      else if (pad%oil%varies) then
         pad%ease(:) = 1
      end if
      pad%lift(:) = pad%h/pad%ease
      pad%oil = oil
   end subroutine set_motion

   !> What uneven viscosity changes at the nodes.
   pure subroutine set_uneven(pad, oil)
      type(fourier_pad_type), intent(inout) :: pad
      type(film_oil), intent(in) :: oil
      call oil%find_weights(pad%gap, pad%sine, pad%cosine, pad%weights)
      associate (w => pad%weights)
         call set_uneven_nodes(pad%n, pad%d, pad%e, pad%w, pad%wedge, pad%squeeze, pad%h, pad%sine, pad%cosine, &
            & w%ease, w%sliding, w%flow_slopes, w%sliding_slopes, pad%ease, pad%s, pad%narrow, pad%base, pad%load)
      end associate
   end subroutine set_uneven

   !> The same from weights at the nodes, with whose ease their own begins.
   pure subroutine set_uneven_nodes(n, d, e, w, wedge, squeeze, h, sine, cosine, of_oil, sliding, p, g, ease, s, &
      & narrow, base, load)
      integer, intent(in) :: n
      real(wp), intent(in) :: d, e(2), w(2), wedge, squeeze
      real(wp), dimension(0:n), intent(in) :: h, sine, cosine, of_oil, sliding
      !> Derivatives of ln(12 mu f2) and of 2 f1.
      real(wp), intent(in) :: p(0:n, 3), g(0:n, 2)
      real(wp), dimension(0:n), intent(inout) :: base, load
      real(wp), dimension(0:n), intent(out) :: ease, s, narrow
      real(wp) :: unit, slope
      integer :: i
      unit = d**2/12
      !$omp simd private(slope)
      do i = 0, n
         slope = e(2)*sine(i) - e(1)*cosine(i)
         base(i) = base(i) - unit*h(i)*(1.5_wp*slope*p(i, 1) + h(i)*(p(i, 2)/2 + p(i, 1)**2/4))
         ease(i) = of_oil(i)
         s(i) = ease(i)*(wedge*(slope*sliding(i) + h(i)*g(i, 1)) + squeeze*(w(1)*sine(i) + w(2)*cosine(i)))
         narrow(i) = s(i)/h(i)**2
      end do
      !$omp simd
      do i = 1, n - 1
         load(i) = unit*(s(i - 1) + 10*s(i) + s(i + 1))
      end do
   end subroutine set_uneven_nodes

   !> What the scheme takes from the film at the nodes.
   pure subroutine set_nodes(n, d, e, source, h, sine, cosine, s, narrow, base, rate, load)
      integer, intent(in) :: n
      !> Step; position; factors of sine and cosine in s; H, sine and cosine.
      real(wp), intent(in) :: d, e(2), source(2), h(0:n), sine(0:n), cosine(0:n)
      real(wp), dimension(0:n), intent(out) :: s, narrow, base, rate, load
      real(wp) :: k, unit
      integer :: i
      k = dot_product(e, e) - 1
      unit = d**2/12
      !$omp simd
      do i = 0, n
         s(i) = source(1)*sine(i) + source(2)*cosine(i)
         rate(i) = unit*h(i)**2
         base(i) = 1 - unit*(k + h(i)*(3 - 2*h(i)))
         narrow(i) = s(i)/h(i)**2
      end do
      load(0) = 0
      load(n) = 0
      !$omp simd
      do i = 1, n - 1
         load(i) = unit*(s(i - 1) + 10*s(i) + s(i + 1))
      end do
   end subroutine set_nodes
end module fourier_pad
