!> Film by successive over-relaxation: the reference solver, and the one that knows cavitation.
!>
!> Finite volumes on half the axial width (the film is symmetric), red-black sweeps warm-started
!> from the pad's last field. With phi for X = R phi, and everything times R**2, the equation is
!>
!>    d/dphi(h^3 dp/dphi) + R^2 h^3 d2p/dZ2 = R^2 (-6 mu omega R_J/R dh/dphi + 12 mu dh/dt).
!>
!> Fields hold the pressure above the cavitation pressure. Storage: cells of odd and of even
!> circumferential number lie apart, `v(pair, row, parity)`, with a rim of zeros, filled up with idle
!> cells (`whole = 0`) to a multiple of the vector length; so a sweep over one colour vectorises.
module sor_film
   use kinds, only: wp, pi
   use film_solver, only: film_solver_type, film_motion, film_response, film_closed, film_not_converged
   use pad_film, only: pad_film_type
   use sor_sweeps, only: relax, relative_residual
   implicit none (type, external)
   private
   public :: sor_film_type, sor_options, new_sor_film
   public :: cavitation_none, cavitation_gumbel, cavitation_reynolds

   !> Film rupture: none; pressures below p_cav dropped after the solution; projected in the solution.
   integer, parameter :: cavitation_none = 0, cavitation_gumbel = 1, cavitation_reynolds = 2

   !> Pairs in a row are filled up to a multiple of this.
   integer, parameter :: vector_length = 8
   !> Sweeps between two looks at the residual.
   integer, parameter :: sweeps_per_look = 4

   type :: sor_options
      !> Cells along the arc (even) and along half the width.
      integer :: circumferential_cells = 60, axial_cells = 15
      !> Relaxation factor below 2; 0: the optimum of the grid.
      real(wp) :: relaxation = 0
      !> Residual over source, root mean square over the cells, each over its diagonal.
      real(wp) :: tolerance = 1e-6_wp
      integer :: max_sweeps = 5000
      integer :: cavitation = cavitation_reynolds
   end type sor_options

   !> One pad: grid, operator, and the last fields, from which the next solution starts.
   type :: sor_pad
      type(pad_film_type) :: film
      !> Angular and axial size of a cell, rad and m.
      real(wp) :: d_phi, d_z
      !> Conductance from an edge row to the pad's side over that between rows: 2 for half a cell, more
      !> because the profile bends; so chosen that the parabola of a narrow pad comes out exactly.
      real(wp) :: edge
      !> Pressure at the leading edge and at the other edges, above the cavitation pressure, Pa.
      real(wp) :: supply, ambient
      real(wp) :: relaxation
      !> Sine and cosine at the cell centres and at the cell faces (0:n).
      real(wp), allocatable :: sin_cell(:), cos_cell(:), sin_face(:), cos_face(:)
      !> Film thickness at the same places, m.
      real(wp), allocatable :: h_cell(:), h_face(:)
      !> Conductances to the neighbours at lower and higher phi and on either side (pair, parity).
      real(wp), allocatable :: before(:, :), after(:, :), beside(:, :)
      !> Reciprocal of the diagonal (pair, 1 middle row | 2 inner | 3 edge row, parity).
      real(wp), allocatable :: per_diagonal(:, :, :)
      !> 1 on the pad's cells, 0 on the rim and the idle ones.
      real(wp), allocatable :: cells(:, :, :)
      !> Right-hand side; pressure; adjoints of the two forces.
      real(wp), allocatable :: source(:, :, :), pressure(:, :, :), adjoint(:, :, :, :)
   end type sor_pad

   type, extends(film_solver_type) :: sor_film_type
      private
      type(sor_options) :: options
      type(sor_pad), allocatable :: pads(:)
   contains
      procedure :: evaluate => evaluate_all
      !> One pad only.
      procedure, public :: evaluate_pad
      !> Pressure of the last evaluation of a pad, (circumferential, axial half), Pa.
      procedure, public :: pressure_field
   end type sor_film_type

contains

   !> A solver for the films of a bearing's pads; their fields start at zero.
   pure function new_sor_film(films, options) result(solver)
      type(pad_film_type), intent(in) :: films(:)
      type(sor_options), intent(in) :: options
      type(sor_film_type) :: solver
      integer :: i
      solver%options = options
      allocate (solver%pads(size(films)))
      do i = 1, size(films)
         call init_pad(solver%pads(i), films(i), options)
      end do
   end function new_sor_film

   pure subroutine init_pad(pad, film, options)
      type(sor_pad), intent(out) :: pad
      type(pad_film_type), intent(in) :: film
      type(sor_options), intent(in) :: options
      integer :: i, nk
      associate (nx => options%circumferential_cells, nz => options%axial_cells)
         pad%film = film
         pad%supply = film%supply_pressure - film%cavitation_pressure
         pad%ambient = film%ambient_pressure - film%cavitation_pressure
         pad%d_phi = film%arc()/nx
         pad%d_z = film%axial_length/(2*nz)
         pad%edge = 2/(1 - 1/(3.0_wp*nz))
         pad%relaxation = options%relaxation
         if (.not. pad%relaxation > 0) pad%relaxation = best_relaxation(pad, nx, nz)
         pad%sin_cell = [(sin((i - 0.5_wp)*pad%d_phi - film%trailing_angle), i=1, nx)]
         pad%cos_cell = [(cos((i - 0.5_wp)*pad%d_phi - film%trailing_angle), i=1, nx)]
         allocate (pad%sin_face(0:nx), pad%cos_face(0:nx), pad%h_face(0:nx), pad%h_cell(nx))
         pad%sin_face(:) = [(sin(i*pad%d_phi - film%trailing_angle), i=0, nx)]
         pad%cos_face(:) = [(cos(i*pad%d_phi - film%trailing_angle), i=0, nx)]
         nk = vector_length*((nx/2 + vector_length - 1)/vector_length)
         allocate (pad%before(nk, 2), pad%after(nk, 2), pad%beside(nk, 2), source=0.0_wp)
         allocate (pad%per_diagonal(nk, 3, 2), source=0.0_wp)
         allocate (pad%cells(0:nk + 1, 0:nz + 1, 2), source=0.0_wp)
         allocate (pad%source, pad%pressure, source=pad%cells)
         allocate (pad%adjoint(0:nk + 1, 0:nz + 1, 2, 2), source=0.0_wp)
         pad%cells(1:nx/2, 1:nz, :) = 1
      end associate
   end subroutine init_pad

   !> Young's optimum 2/(1 + sqrt(1 - rho^2)) with the spectral radius rho of Jacobi's iteration for
   !> a uniform film on this grid.
   pure function best_relaxation(pad, nx, nz) result(relaxation)
      type(sor_pad), intent(in) :: pad
      integer, intent(in) :: nx, nz
      real(wp) :: relaxation, along, across, gap
      along = 1/pad%d_phi**2
      across = (pad%film%pad_radius()/pad%d_z)**2
      gap = (along*(1 - cos(pi/nx)) + across*(1 - cos(pi/(2*nz))))/(along + across)
      relaxation = 2/(1 + sqrt(gap*(2 - gap)))
   end function best_relaxation

   subroutine evaluate_all(self, motion, speed, want_slopes, response)
      class(sor_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_slopes
      type(film_response), intent(out) :: response(:)
      integer :: i
      do i = 1, size(self%pads)
         call self%evaluate_pad(i, motion(i), speed, want_slopes, response(i))
      end do
   end subroutine evaluate_all

   subroutine evaluate_pad(self, i, motion, speed, want_slopes, response)
      class(sor_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_slopes
      type(film_response), intent(out) :: response
      real(wp) :: floor
      real(wp), allocatable :: column(:)
      logical :: ok

      associate (pad => self%pads(i))
         response%min_film = pad%film%least_thickness(motion)
         if (.not. response%min_film > 0) then
            response%status = film_closed
            return
         end if
         call set_operator(pad, motion)
         call set_source(pad, motion, speed)
         self%counters%sor = self%counters%sor + 1
         floor = -huge(floor)
         if (self%options%cavitation == cavitation_reynolds) floor = 0
         call solve(self, pad, pad%source, pad%cells, floor, pad%pressure, response%residual, ok)
         if (ok) then
            floor = -huge(floor)
            if (self%options%cavitation /= cavitation_none) floor = 0
            column = column_sums(pad, floor)
            response%force = -force_weight(pad)*[dot_product(pad%sin_cell, column), &
               & dot_product(pad%cos_cell, column)]
            response%min_pressure = pad%film%cavitation_pressure + minval(pad%pressure, mask=pad%cells > 0)
            response%max_pressure = pad%film%cavitation_pressure &
               & + max(floor, maxval(pad%pressure, mask=pad%cells > 0))
            if (want_slopes) call add_slopes(self, pad, speed, response, ok)
         end if
         if (.not. ok) then
            response%status = film_not_converged
            ! fields that did not converge are no start for the next ones
            pad%pressure = 0
            pad%adjoint = 0
         end if
      end associate
   end subroutine evaluate_pad

   !> Area of two mirrored cells, m^2: what a cell's pressure counts in the force.
   pure real(wp) function force_weight(pad)
      type(sor_pad), intent(in) :: pad
      force_weight = 2*pad%film%pad_radius()*pad%d_phi*pad%d_z
   end function force_weight

   !> Conductances and diagonal at a motion.
   pure subroutine set_operator(pad, motion)
      type(sor_pad), intent(inout) :: pad
      type(film_motion), intent(in) :: motion
      real(wp) :: face(0:size(pad%h_cell))
      integer :: n, nk
      n = size(pad%h_cell)
      nk = n/2
      pad%h_cell = pad%film%thickness(motion, pad%sin_cell, pad%cos_cell)
      pad%h_face = pad%film%thickness(motion, pad%sin_face, pad%cos_face)
      face = pad%h_face**3/pad%d_phi**2
      ! the boundary lies half a cell away
      face(0) = 2*face(0)
      face(n) = 2*face(n)
      pad%before(:nk, :) = apart(face(0:n - 1))
      pad%after(:nk, :) = apart(face(1:n))
      pad%beside(:nk, :) = apart(pad%h_cell**3*(pad%film%pad_radius()/pad%d_z)**2)
      associate (around => pad%before(:nk, :) + pad%after(:nk, :), beside => pad%beside(:nk, :))
         pad%per_diagonal(:nk, 1, :) = 1/(around + beside)
         pad%per_diagonal(:nk, 2, :) = 1/(around + 2*beside)
         pad%per_diagonal(:nk, 3, :) = 1/(around + (1 + pad%edge)*beside)
      end associate
   end subroutine set_operator

   !> Wedge, squeeze and boundary pressures.
   pure subroutine set_source(pad, motion, speed)
      type(sor_pad), intent(inout) :: pad
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      real(wp) :: b(size(pad%h_cell)/2, 2)
      integer :: n, nk, nz, j
      n = size(pad%h_cell)
      nk = n/2
      nz = ubound(pad%source, 2) - 1
      b = apart(wedge(pad, speed)*(pad%h_face(1:n) - pad%h_face(0:n - 1)) &
         & - squeeze(pad)*(motion%velocity(1)*pad%sin_cell + motion%velocity(2)*pad%cos_cell))
      b(1, 1) = b(1, 1) - pad%before(1, 1)*pad%ambient
      b(nk, 2) = b(nk, 2) - pad%after(nk, 2)*pad%supply
      do j = 1, nz - 1
         pad%source(1:nk, j, :) = b
      end do
      pad%source(1:nk, nz, :) = b - pad%edge*pad%beside(1:nk, :)*pad%ambient
   end subroutine set_source

   !> Factor of the difference of h over a cell in the right-hand side.
   pure real(wp) function wedge(pad, speed)
      type(sor_pad), intent(in) :: pad
      real(wp), intent(in) :: speed
      wedge = -6*pad%film%viscosity*speed*pad%film%journal_radius*pad%film%pad_radius()/pad%d_phi
   end function wedge

   !> Factor of dh/dt in the right-hand side.
   pure real(wp) function squeeze(pad)
      type(sor_pad), intent(in) :: pad
      squeeze = 12*pad%film%viscosity*pad%film%pad_radius()**2
   end function squeeze

   !> Sweeps until the residual is within the tolerance; ok is false if the cap comes first.
   subroutine solve(self, pad, source, whole, floor, field, residual, ok)
      class(sor_film_type), intent(inout) :: self
      type(sor_pad), intent(in) :: pad
      !> Right-hand side; cells in the solution.
      real(wp), intent(in), contiguous :: source(0:, 0:, :), whole(0:, 0:, :)
      real(wp), intent(in) :: floor
      real(wp), intent(inout), contiguous :: field(0:, 0:, :)
      real(wp), intent(out) :: residual
      logical, intent(out) :: ok
      integer :: nk, nz, sweeps
      nk = ubound(field, 1) - 1
      nz = ubound(field, 2) - 1
      do sweeps = sweeps_per_look, self%options%max_sweeps + sweeps_per_look - 1, sweeps_per_look
         call relax(nk, nz, sweeps_per_look, pad%relaxation, floor, pad%before, pad%after, pad%beside, &
            & pad%per_diagonal, source, whole, field)
         residual = relative_residual(nk, nz, floor, pad%before, pad%after, pad%beside, pad%per_diagonal, &
            & source, whole, field)
         self%counters%sweeps = self%counters%sweeps + sweeps_per_look
         ok = residual <= self%options%tolerance
         if (ok) return
      end do
   end subroutine solve

   !> Force derivatives by adjoints. With L p = b and F = g . p, let L a = g on the whole film; then
   !> dF = a . (db - dL p), and a . dL p is a sum over faces, with differences of a and p over each.
   subroutine add_slopes(self, pad, speed, response, ok)
      class(sor_film_type), intent(inout) :: self
      type(sor_pad), intent(inout) :: pad
      real(wp), intent(in) :: speed
      type(film_response), intent(inout) :: response
      logical, intent(out) :: ok
      real(wp), dimension(size(pad%h_cell), ubound(pad%cells, 2) - 1) :: p, a
      real(wp), dimension(0:size(pad%h_cell)) :: d_face, over_face
      real(wp), dimension(size(pad%h_cell)) :: d_side, over_side, total
      real(wp) :: weight(size(pad%h_cell)/2, 2), residual
      real(wp) :: positive(0:ubound(pad%cells, 1), 0:ubound(pad%cells, 2), 2)
      integer :: m, j, n, nk, nz

      n = size(p, 1)
      nk = n/2
      nz = size(p, 2)
      positive = pad%cells
      if (self%options%cavitation /= cavitation_none) then
         where (.not. pad%pressure > 0) positive = 0
      end if
      ok = .true.
      if (.not. any(positive > 0)) then
         ! nothing left that could change
         pad%adjoint = 0
         return
      end if
      d_face = 3*pad%h_face**2/pad%d_phi**2
      d_face(0) = 2*d_face(0)
      d_face(n) = 2*d_face(n)
      d_side = 3*pad%h_cell**2*(pad%film%pad_radius()/pad%d_z)**2
      p = natural(pad%pressure(1:nk, 1:nz, :))
      do m = 1, 2
         if (m == 1) weight = -force_weight(pad)*apart(pad%sin_cell)
         if (m == 2) weight = -force_weight(pad)*apart(pad%cos_cell)
         do j = 1, nz
            pad%source(1:nk, j, :) = weight*positive(1:nk, j, :)
         end do
         if (self%options%cavitation == cavitation_reynolds) then
            pad%adjoint(:, :, :, m) = pad%adjoint(:, :, :, m)*positive
            call solve(self, pad, pad%source, positive, -huge(residual), pad%adjoint(:, :, :, m), residual, ok)
         else
            call solve(self, pad, pad%source, pad%cells, -huge(residual), pad%adjoint(:, :, :, m), residual, ok)
         end if
         if (.not. ok) return
         a = natural(pad%adjoint(1:nk, 1:nz, :, m))
         over_face = [sum((p(1, :) - pad%ambient)*a(1, :)), &
            & sum((p(2:, :) - p(:n - 1, :))*(a(2:, :) - a(:n - 1, :)), dim=2), &
            & sum((p(n, :) - pad%supply)*a(n, :))]
         over_side = sum((p(:, 2:) - p(:, :nz - 1))*(a(:, 2:) - a(:, :nz - 1)), dim=2) &
            & + pad%edge*(p(:, nz) - pad%ambient)*a(:, nz)
         total = sum(a, dim=2)
         response%slope(m, 1) = over_position(pad%sin_face, pad%sin_cell)
         response%slope(m, 2) = over_position(pad%cos_face, pad%cos_cell)
         response%slope(m, 3) = -squeeze(pad)*dot_product(pad%sin_cell, total)
         response%slope(m, 4) = -squeeze(pad)*dot_product(pad%cos_cell, total)
      end do
   contains
      !> Slope over e_y' (sines) or e_z' (cosines): dh = -sin(phi) de_y' - cos(phi) de_z'.
      pure real(wp) function over_position(at_face, at_cell)
         real(wp), intent(in) :: at_face(0:), at_cell(:)
         over_position = -dot_product(wedge(pad, speed)*(at_face(1:) - at_face(:n - 1)), total) &
            & - dot_product(d_face*at_face, over_face) - dot_product(d_side*at_cell, over_side)
      end function over_position
   end subroutine add_slopes

   !> Sum over the axial rows of the pressure, not below the floor, in natural order, Pa.
   pure function column_sums(pad, floor) result(sums)
      type(sor_pad), intent(in) :: pad
      real(wp), intent(in) :: floor
      real(wp) :: sums(size(pad%h_cell)), pair(size(pad%h_cell)/2)
      integer :: parity, j
      do parity = 1, 2
         pair = 0
         do j = 1, ubound(pad%pressure, 2) - 1
            pair = pair + max(pad%pressure(1:size(pair), j, parity), floor)
         end do
         sums(parity::2) = pair + pad%film%cavitation_pressure*(ubound(pad%pressure, 2) - 1)
      end do
   end function column_sums

   pure function pressure_field(self, i) result(p)
      class(sor_film_type), intent(in) :: self
      integer, intent(in) :: i
      real(wp), allocatable :: p(:, :)
      associate (pad => self%pads(i))
         p = natural(pad%pressure(1:size(pad%h_cell)/2, 1:ubound(pad%pressure, 2) - 1, :))
         if (self%options%cavitation /= cavitation_none) p = max(p, 0.0_wp)
         p = p + pad%film%cavitation_pressure
      end associate
   end function pressure_field

   !> Natural order to (pair, parity).
   pure function apart(natural_order)
      real(wp), intent(in) :: natural_order(:)
      real(wp) :: apart(size(natural_order)/2, 2)
      apart(:, 1) = natural_order(1::2)
      apart(:, 2) = natural_order(2::2)
   end function apart

   !> (pair, row, parity) to natural order.
   pure function natural(field)
      real(wp), intent(in) :: field(:, :, :)
      real(wp) :: natural(2*size(field, 1), size(field, 2))
      natural(1::2, :) = field(:, :, 1)
      natural(2::2, :) = field(:, :, 2)
   end function natural
end module sor_film
