!> One pad of the axial modes at one resolution: its nodes, its modes, and the fields of the last solution
!> (fourier_film).
module fourier_pad
   use kinds, only: wp
   use film_solver, only: film_motion, film_law_type
   use film_law, only: law_at_nodes
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
   !> beside which the pressure of a film that is not uniform falls steeply. Behind them those where cavitation is
   !> looked for, without weight: the middle, and towards the side, where a film that diverges at its trailing edge
   !> first falls below the pressure of its edges.
   integer, parameter :: gauss = 8, middle = 9, all_points = gauss + looks
   real(wp), parameter :: half_points(4) = [0.183434642495650_wp, 0.525532409916329_wp, &
      & 0.796666477413627_wp, 0.960289856497536_wp]
   real(wp), parameter :: half_weights(4) = [0.362683783378362_wp, 0.313706645877887_wp, &
      & 0.222381034453374_wp, 0.101228536290376_wp]
   real(wp), parameter :: roots(gauss) = 0.5_wp*(1 + [-half_points, half_points])
   real(wp), parameter :: points(all_points) = [1 - roots**2, 0.0_wp, 0.75_wp, 0.9_wp, 0.95_wp]
   real(wp), parameter :: point_weights(gauss) = roots*[half_weights, half_weights]

   !> What the derivatives of both forces are summed up from (fourier_slopes), by node and component.
   type :: force_adjoints
      !> Derivatives over share q, and over d^2 v/12, d^2 K H^2/12 and d^2 s/12.
      real(wp), allocatable, dimension(:, :) :: along, over_v, over_h2, over_s
      !> Sum over the slots of share q, and the share of H, at the nodes; how these move, d phi/d e.
      real(wp), allocatable :: solved(:), floor_share(:), shift(:, :)
      !> Derivatives over H at the leading edge, as q is there what the pressure is; 1/d d d/d e.
      real(wp) :: boundary(2), stretch(2)
   end type force_adjoints

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
      !> At the nodes: H, sine and cosine of phi, s and s/(K H^2); 1 - d^2 v/12, d^2 K H^2/12 and the scheme's load.
      real(wp), allocatable, dimension(:) :: h, sine, cosine, s, narrow, base, rate, load
      !> What the film's law makes of q and s at the nodes (fourier_film): q over pressure, and the inverse root of the
      !> mobility E, with which q counts. Whether it varies, and turns with the thickness; where it varies the law.
      real(wp), allocatable, dimension(:) :: lift, inverse_root
      logical :: varies = .false., by_thickness = .false.
      type(law_at_nodes) :: law
      !> By slot, node and block: a = 1 - d^2 V/12, factors f of the elimination, q.
      real(wp), allocatable :: a(:, :, :), f(:, :, :), q(:, :, :)
      !> What q by (slot, node, block) and -s/(K H^2) by node count along the width: c and tail(2), less the part of the
      !> width where the film has cavitated, if it has; and what the cavitation pressure counts there.
      real(wp), allocatable :: share(:, :, :), narrow_share(:), floor_share(:)
      logical :: shares_are_stale = .true.
      type(force_adjoints) :: adjoints
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
         allocate (pad%across(gauss, simd_width*blocks), pad%look(looks, simd_width*blocks), &
            & profile(simd_width*blocks))
         do i = 1, all_points
            call pad%axial%across(points(i), profile, pad%point_tail(i))
            if (i <= gauss) pad%across(i, :) = profile
            if (i > gauss) pad%look(i - gauss, :) = profile
            if (i == middle) pad%at_middle = profile
         end do
         allocate (pad%weight(0:n), pad%h(0:n), pad%sine(0:n), pad%cosine(0:n), pad%s(0:n), pad%narrow(0:n), &
            & pad%base(0:n), pad%rate(0:n), pad%load(0:n), pad%lift(0:n))
         allocate (pad%inverse_root(0:n), source=1.0_wp)
         allocate (pad%a(simd_width, 0:n, blocks), pad%f(simd_width, 0:n, blocks), pad%q(simd_width, 0:n, blocks))
         allocate (pad%share(simd_width, 0:n, blocks), pad%narrow_share(0:n), pad%floor_share(0:n))
      end associate
      associate (of => pad%adjoints)
         allocate (of%along(0:n, 2), of%over_v(0:n, 2), of%over_h2(0:n, 2), of%over_s(0:n, 2), of%solved(0:n), &
            & of%floor_share(0:n), of%shift(0:n, 2))
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
      class(film_law_type), intent(in) :: oil
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
      call set_nodes(pad)
      if (oil%varies) then
         call oil%at_nodes(pad%gap, motion, pad%sine, pad%cosine, pad%law)
         pad%by_thickness = oil%turns_with_thickness()
         call set_varied_nodes(pad)
      else if (pad%varies) then
         pad%inverse_root(:) = 1
         pad%by_thickness = .false.
      end if
      pad%varies = oil%varies
      call set_load(pad)
      pad%lift(:) = pad%h/pad%inverse_root
   end subroutine set_motion

   !> What the scheme takes from the film at the nodes, where the law does not vary.
   pure subroutine set_nodes(pad)
      type(fourier_pad_type), intent(inout) :: pad
      real(wp) :: k, unit, source(2)
      integer :: i
      k = dot_product(pad%e, pad%e) - 1
      unit = pad%d**2/12
      ! factors of sine and cosine in s
      source = [pad%wedge*pad%e(2) + pad%squeeze*pad%w(1), -pad%wedge*pad%e(1) + pad%squeeze*pad%w(2)]
      !$omp simd
      do i = 0, pad%n
         pad%s(i) = source(1)*pad%sine(i) + source(2)*pad%cosine(i)
         pad%rate(i) = unit*pad%h(i)**2
         pad%base(i) = 1 - unit*(k + pad%h(i)*(3 - 2*pad%h(i)))
         pad%narrow(i) = pad%s(i)/pad%h(i)**2
      end do
   end subroutine set_nodes

   !> What a law that varies changes at the nodes.
   pure subroutine set_varied_nodes(pad)
      type(fourier_pad_type), intent(inout) :: pad
      real(wp) :: unit, slope, h
      integer :: i
      unit = pad%d**2/12
      associate (of => pad%law, e => pad%e, w => pad%w)
         !$omp simd private(slope, h)
         do i = 0, pad%n
            h = pad%h(i)
            slope = e(2)*pad%sine(i) - e(1)*pad%cosine(i)
            pad%base(i) = pad%base(i) - unit*h*(1.5_wp*slope*of%flow_slopes(i + 1, 1) &
               & + h*(of%flow_slopes(i + 1, 2)/2 + of%flow_slopes(i + 1, 1)**2/4))
            pad%inverse_root(i) = of%inverse_root(i + 1)
            pad%s(i) = of%inverse_root(i + 1)*(pad%wedge*(slope*of%sliding(i + 1) + h*of%sliding_slopes(i + 1, 1)) &
               & + pad%squeeze*(w(1)*pad%sine(i) + w(2)*pad%cosine(i)))
            pad%narrow(i) = pad%s(i)/h**2
         end do
         if (.not. pad%by_thickness) return
         pad%rate(:) = pad%rate*of%across
         pad%narrow(:) = pad%narrow/of%across
      end associate
   end subroutine set_varied_nodes

   !> The scheme's load.
   pure subroutine set_load(pad)
      type(fourier_pad_type), intent(inout) :: pad
      real(wp) :: unit
      integer :: i
      unit = pad%d**2/12
      pad%load(0) = 0
      pad%load(pad%n) = 0
      !$omp simd
      do i = 1, pad%n - 1
         pad%load(i) = unit*(pad%s(i - 1) + 10*pad%s(i) + pad%s(i + 1))
      end do
   end subroutine set_load
end module fourier_pad
