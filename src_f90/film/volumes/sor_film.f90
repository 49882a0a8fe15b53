!> Film on finite volumes by successive over-relaxation: the solver that the others are checked against.
!>
!> Red-black sweeps over the finite volumes of film_grid, warm-started from the pad's last field.
!>
!> Storage: columns of odd and of even number lie apart, `v(pair, row, parity)`, with a rim of zeros, filled
!> up with idle cells (`whole = 0`) to a multiple of the vector length; so a sweep over one colour vectorises.
module sor_film
   use kinds, only: wp, pi
   use film_solver, only: film_solver_type, film_motion, film_law_type, film_response, film_not_converged, &
      & cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use film_grid, only: film_grid_type, new_film_grid
   use sor_sweeps, only: relax, relative_residual
   implicit none (type, external)
   private
   public :: sor_film_type, sor_options, new_sor_film

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
      type(film_grid_type) :: grid
      real(wp) :: relaxation
      !> Conductances to the neighbours at lower and higher phi and on either side (pair, parity).
      real(wp), allocatable :: before(:, :), after(:, :), beside(:, :)
      !> Reciprocal of the diagonal (pair, row, parity).
      real(wp), allocatable :: per_diagonal(:, :, :)
      !> 1 on the pad's cells, 0 on the rim and the idle ones.
      real(wp), allocatable :: cells(:, :, :)
      !> Right-hand side; pressure; adjoints of the two forces.
      real(wp), allocatable :: source(:, :, :), pressure(:, :, :), adjoint(:, :, :, :)
   end type sor_pad

   type, extends(film_solver_type) :: sor_film_type
      private
      type(sor_options), public :: options
      type(sor_pad), allocatable :: pads(:)
   contains
      procedure :: forget
      procedure :: solve
      procedure :: field_of_pad
      !> Pressure of the last evaluation of a pad, (circumferential, axial half), Pa.
      procedure, public :: pressure_field
   end type sor_film_type

contains

   !> A solver for the films of a bearing's pads; their fields start at zero.
   pure function new_sor_film(gaps, options) result(solver)
      type(pad_gap_type), intent(in) :: gaps(:)
      type(sor_options), intent(in) :: options
      type(sor_film_type) :: solver
      integer :: i
      call solver%set_gaps(gaps, options%cavitation)
      solver%options = options
      allocate (solver%pads(size(gaps)))
      do i = 1, size(gaps)
         call init_pad(solver%pads(i), gaps(i), options)
      end do
   end function new_sor_film

   pure subroutine init_pad(pad, gap, options)
      type(sor_pad), intent(out) :: pad
      type(pad_gap_type), intent(in) :: gap
      type(sor_options), intent(in) :: options
      integer :: nk
      associate (nx => options%circumferential_cells, nz => options%axial_cells)
         pad%grid = new_film_grid(gap, nx, nz)
         pad%relaxation = options%relaxation
         if (.not. pad%relaxation > 0) pad%relaxation = best_relaxation(pad%grid)
         nk = vector_length*((nx/2 + vector_length - 1)/vector_length)
         allocate (pad%before(nk, 2), pad%after(nk, 2), pad%beside(nk, 2), source=0.0_wp)
         allocate (pad%per_diagonal(nk, nz, 2), source=0.0_wp)
         allocate (pad%cells(0:nk + 1, 0:nz + 1, 2), source=0.0_wp)
         allocate (pad%source, pad%pressure, source=pad%cells)
         allocate (pad%adjoint(0:nk + 1, 0:nz + 1, 2, 2), source=0.0_wp)
         pad%cells(1:nx/2, 1:nz, :) = 1
      end associate
   end subroutine init_pad

   !> Young's optimum 2/(1 + sqrt(1 - rho^2)) with the spectral radius rho of Jacobi's iteration for
   !> a uniform film on this grid.
   pure real(wp) function best_relaxation(grid)
      type(film_grid_type), intent(in) :: grid
      real(wp) :: along, across, room
      along = 1/grid%d_phi**2
      across = (grid%gap%pad_radius()/grid%d_z)**2
      room = (along*(1 - cos(pi/grid%columns)) + across*(1 - cos(pi/(2*grid%rows))))/(along + across)
      best_relaxation = 2/(1 + sqrt(room*(2 - room)))
   end function best_relaxation

   pure subroutine forget(self)
      class(sor_film_type), intent(inout) :: self
      integer :: i
      do i = 1, size(self%pads)
         self%pads(i)%pressure = 0
         self%pads(i)%adjoint = 0
      end do
   end subroutine forget

   subroutine field_of_pad(self, i, motion, oil, speed, phi, z, pressure)
      class(sor_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed, phi(:), z(:)
      real(wp), intent(out) :: pressure(:, :)
      type(film_response) :: response
      call self%evaluate_pad(i, motion, oil, speed, .false., response)
      associate (pad => self%pads(i), grid => self%pads(i)%grid)
         pressure = grid%pressure_at(natural(pad%pressure(1:grid%columns/2, 1:grid%rows, :)), self%cavitates(), phi, z)
      end associate
   end subroutine field_of_pad

   subroutine solve(self, i, motion, oil, speed, want_derivatives, response)
      class(sor_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_response), intent(inout) :: response
      real(wp) :: floor
      logical :: ok
      associate (pad => self%pads(i), gap => self%gaps(i))
         call pad%grid%set_motion(motion, oil, speed)
         call set_operator(pad)
         self%counters%volumes = self%counters%volumes + 1
         floor = -huge(floor)
         if (self%condition == cavitation_reynolds) floor = 0
         call iterate(self, pad, pad%source, pad%cells, floor, pad%pressure, response%residual, ok)
         if (ok) then
            floor = -huge(floor)
            if (self%cavitates()) floor = 0
            response%force = pad%grid%force(column_sums(pad, floor))
            associate (edges => [pad%grid%ambient, pad%grid%supply])
               response%min_pressure = gap%cavitation_pressure &
                  & + min(minval(edges), minval(pad%pressure, mask=pad%cells > 0))
               response%max_pressure = gap%cavitation_pressure &
                  & + max(floor, pad%grid%highest(in_middle(pad)))
            end associate
            if (want_derivatives) call add_derivatives(self, pad, response, ok)
         end if
         if (.not. ok) then
            response%status = film_not_converged
            response%max_sweeps = self%options%max_sweeps
            ! fields that did not converge are no start for the next ones
            pad%pressure = 0
            pad%adjoint = 0
         end if
      end associate
   end subroutine solve

   !> The grid's operator and right-hand side, odd and even columns apart.
   pure subroutine set_operator(pad)
      type(sor_pad), intent(inout) :: pad
      real(wp) :: source(pad%grid%columns/2, 2)
      integer :: j
      associate (grid => pad%grid, n => pad%grid%columns, nk => pad%grid%columns/2, nz => pad%grid%rows)
         pad%before(:nk, :) = apart(grid%along(0:n - 1))
         pad%after(:nk, :) = apart(grid%along(1:n))
         pad%beside(:nk, :) = apart(grid%beside)
         associate (around => pad%before(:nk, :) + pad%after(:nk, :), beside => pad%beside(:nk, :))
            do j = 1, nz
               pad%per_diagonal(:nk, j, :) = 1/(around + (grid%inward(j) + grid%outward(j))*beside)
            end do
         end associate
         source = apart(grid%source)
         do j = 1, nz
            pad%source(1:nk, j, :) = source
         end do
         pad%source(1:nk, nz, :) = source + apart(grid%edge_source)
      end associate
   end subroutine set_operator

   !> Sweeps until the residual is within the tolerance; ok is false if the cap comes first.
   subroutine iterate(self, pad, source, whole, floor, field, residual, ok)
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
            & pad%grid%inward, pad%grid%outward, pad%per_diagonal, source, whole, field)
         residual = relative_residual(nk, nz, floor, pad%before, pad%after, pad%beside, pad%grid%inward, &
            & pad%grid%outward, pad%per_diagonal, source, whole, field)
         self%counters%passes = self%counters%passes + sweeps_per_look
         ok = residual <= self%options%tolerance
         if (ok) return
      end do
   end subroutine iterate

   !> Force derivatives by adjoints, on the cells that are film.
   subroutine add_derivatives(self, pad, response, ok)
      class(sor_film_type), intent(inout) :: self
      type(sor_pad), intent(inout) :: pad
      type(film_response), intent(inout) :: response
      logical, intent(out) :: ok
      real(wp) :: weight(pad%grid%columns/2, 2), p(pad%grid%rows, pad%grid%columns), residual
      real(wp) :: weights(pad%grid%columns, 2)
      real(wp), dimension(0:ubound(pad%cells, 1), 0:ubound(pad%cells, 2), 2) :: positive, region
      integer :: m, j
      positive = pad%cells
      if (self%cavitates()) then
         where (.not. pad%pressure > 0) positive = 0
      end if
      ok = .true.
      if (.not. any(positive > 0)) then
         ! nothing left that could change
         pad%adjoint = 0
         return
      end if
      region = pad%cells
      if (self%condition == cavitation_reynolds) region = positive
      associate (grid => pad%grid, nk => pad%grid%columns/2, nz => pad%grid%rows)
         p = natural(pad%pressure(1:nk, 1:nz, :))
         weights = grid%weight()
         do m = 1, 2
            weight = -apart(weights(:, m))
            do j = 1, nz
               pad%source(1:nk, j, :) = weight*positive(1:nk, j, :)
            end do
            pad%adjoint(:, :, :, m) = pad%adjoint(:, :, :, m)*region
            call iterate(self, pad, pad%source, region, -huge(residual), pad%adjoint(:, :, :, m), residual, ok)
            if (.not. ok) return
            response%derivatives(m, :) = grid%derivatives(p, natural(pad%adjoint(1:nk, 1:nz, :, m)))
         end do
      end associate
   end subroutine add_derivatives

   !> Sum over the rows of the pressure, not below the floor, times height, by column, Pa.
   pure function column_sums(pad, floor) result(sums)
      type(sor_pad), intent(in) :: pad
      real(wp), intent(in) :: floor
      real(wp) :: sums(pad%grid%columns), pair(pad%grid%columns/2)
      integer :: parity, j
      do parity = 1, 2
         pair = 0
         do j = 1, pad%grid%rows
            pair = pair + pad%grid%height(j)*max(pad%pressure(1:size(pair), j, parity), floor)
         end do
         sums(parity::2) = pair
      end do
   end function column_sums

   !> Pressure in the middle plane, by column.
   pure function in_middle(pad) result(pressure)
      type(sor_pad), intent(in) :: pad
      real(wp) :: pressure(pad%grid%columns)
      integer :: parity
      do parity = 1, 2
         pressure(parity::2) = matmul(pad%pressure(1:pad%grid%columns/2, 1:pad%grid%rows, parity), pad%grid%to_middle)
      end do
   end function in_middle

   pure function pressure_field(self, i) result(p)
      class(sor_film_type), intent(in) :: self
      integer, intent(in) :: i
      real(wp), allocatable :: p(:, :)
      associate (pad => self%pads(i))
         p = transpose(natural(pad%pressure(1:pad%grid%columns/2, 1:pad%grid%rows, :)))
         if (self%cavitates()) p = max(p, 0.0_wp)
         p = p + pad%grid%gap%cavitation_pressure
      end associate
   end function pressure_field

   !> Natural order to (pair, parity).
   pure function apart(natural_order)
      real(wp), intent(in) :: natural_order(:)
      real(wp) :: apart(size(natural_order)/2, 2)
      apart(:, 1) = natural_order(1::2)
      apart(:, 2) = natural_order(2::2)
   end function apart

   !> (pair, row, parity) to (row, column).
   pure function natural(field)
      real(wp), intent(in) :: field(:, :, :)
      real(wp) :: natural(size(field, 2), 2*size(field, 1))
      natural(:, 1::2) = transpose(field(:, :, 1))
      natural(:, 2::2) = transpose(field(:, :, 2))
   end function natural
end module sor_film
