!> Finite volumes of one pad's film with slopes on its full width, with the condition of Reynolds or without cavitation
!> (weighted_film has the equation, film_grid the volumes of a film without slopes).
!>
!> Columns of equal cells lie along the arc from the leading to the trailing edge, rows across the width, symmetric to
!> the middle plane and narrow at the sides as those of film_grid. Cells are numbered row by row, then column by column:
!> the matrix is a band as wide as there are rows, and its factor stays what it was up to the first column whose cells
!> change.
!>
!> Which cells are cavitated is found as an active set (elimination_film). Derivatives are those of a film that ends
!> between its cells: at its end the pressure leaves zero with a slope of zero, so that a change of the pressure is zero
!> where the film ends, not in the middle of the first cavitated cell. With the ends of cells they would err by the
!> first order of the cells, and moments of yaw, small differences of both halves, by tenths.
module sloped_volumes
   use kinds, only: wp
   use film_solver, only: film_law_type, film_counters, film_not_converged
   use film_law, only: law_at_nodes
   use pad_gap, only: pad_gap_type
   use sloped_gap, only: sloped_motion, sloped_response
   use film_losses, only: film_loss
   implicit none (type, external)
   private
   public :: sloped_volumes_type, new_sloped_volumes

   !> How much the rows' heights change (film_grid).
   real(wp), parameter :: grading = 0.85_wp
   !> Rounds of the active set at most, for each column, and those in which a film that begins full grows far.
   integer, parameter :: rounds_a_column = 2, rounds_of_growth = 4
   !> Pressure over the highest below which a cell counts as empty: rounding must not decide.
   real(wp), parameter :: rounding = 1e-12_wp

   type :: sloped_volumes_type
      private
      type(pad_gap_type) :: gap
      integer :: rows = 0, columns = 0
      real(wp) :: radius = 0
      !> Angles of faces along the arc, from the pivot, rad, 0 (leading edge) to columns; sin and cos there and in the
      !> middles of columns, (2, ..), their integrals over columns, and widths, rad.
      real(wp), allocatable :: angle(:), face(:, :), middle(:, :), integral(:, :), width(:)
      !> Heights of rows, their middles and faces, m; 1 over the distance across faces, 1/m.
      real(wp), allocatable :: height(:), z(:), z_face(:), per_distance(:)
      !> Conductances through faces along, (row, 0:columns), and across, (0:rows, column), m^3, and what drives the film,
      !> (row, column), N m; d ln/dh of the first two, 1/m.
      real(wp), allocatable :: along(:, :), across(:, :), source(:, :), along_turn(:, :), across_turn(:, :)
      !> Film thickness in cells and at faces along, m; S in cells, G at faces and in cells (film_law).
      real(wp), allocatable :: h(:, :), h_face(:, :), shear(:, :), sliding(:, :), sliding_face(:, :)
      !> 12 mu R^2, and that times k.
      real(wp) :: scale = 0, wedge = 0
      !> Cells of the film; pressures above that of cavitation, Pa, with those of the edges around.
      logical, allocatable :: film(:, :)
      real(wp), allocatable :: p(:, :)
      !> The factor L D L^T, (0:rows, cell): D and below it L.
      real(wp), allocatable :: factor(:, :)
   contains
      procedure :: set_motion
      procedure :: evaluate
      procedure :: start_from
      procedure :: drop_tension
      procedure :: losses
      procedure :: pressure_at
   end type sloped_volumes_type

contains

   !> For the film of a gap, with an even number of rows.
   pure type(sloped_volumes_type) function new_sloped_volumes(gap, columns, rows) result(self)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: columns, rows
      integer :: k, half
      real(wp) :: square(rows)
      self%gap = gap
      self%rows = rows
      self%columns = columns
      self%radius = gap%pad_radius()
      allocate (self%angle(0:columns), self%face(2, 0:columns), self%middle(2, columns), self%integral(2, columns), &
         & self%width(columns), self%height(rows), self%z(rows), self%z_face(0:rows), self%per_distance(0:rows))
      allocate (self%along(rows, 0:columns), self%across(0:rows, columns), self%source(rows, columns), &
         & self%along_turn(rows, 0:columns), self%across_turn(0:rows, columns), self%h(rows, columns), &
         & self%h_face(rows, 0:columns))
      allocate (self%shear(rows, columns), self%sliding(rows, columns), self%sliding_face(rows, 0:columns), &
         & source=1.0_wp)
      allocate (self%film(rows, columns), source=.true.)
      allocate (self%p(0:rows + 1, 0:columns + 1), self%factor(0:rows, rows*columns), source=0.0_wp)
      half = rows/2
      do k = 1, half
         self%height(half + k) = 0.5_wp*gap%axial_length/half*(1 + grading*(half + 1 - 2*k)/half)
         self%height(half + 1 - k) = self%height(half + k)
      end do
      self%z_face(half) = 0
      do k = half + 1, rows
         self%z_face(k) = self%z_face(k - 1) + self%height(k)
         self%z_face(rows - k) = -self%z_face(k)
      end do
      self%z = 0.5_wp*(self%z_face(1:) + self%z_face(:rows - 1))
      square = self%z**2 + self%height**2/12
      do k = 1, rows - 1
         if (k /= half) self%per_distance(k) = 2*self%z_face(k)/(square(k + 1) - square(k))
      end do
      self%per_distance(half) = 1/(self%z(half + 1) - self%z(half))
      self%per_distance(rows) = 2*self%z_face(rows)/(self%z_face(rows)**2 - square(rows))
      self%per_distance(0) = self%per_distance(rows)
      self%p(:, 1:columns) = 0
      associate (lowest => gap%cavitation_pressure)
         self%p([0, rows + 1], :) = gap%ambient_pressure - lowest
         self%p(:, 0) = gap%supply_pressure - lowest
         self%p(:, columns + 1) = gap%ambient_pressure - lowest
      end associate
   end function new_sloped_volumes

   !> Columns between these angles from the pivot, rad, from the trailing to the leading edge, and conductances and
   !> sources at a motion, with an oil and a journal speed, rad/s.
   subroutine set_motion(self, angles, motion, oil, speed)
      class(sloped_volumes_type), intent(inout) :: self
      real(wp), intent(in) :: angles(0:)
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      real(wp) :: u(4), k, between(0:self%columns), place(0:self%columns + 1)
      integer :: i, r
      associate (n => self%columns)
         self%angle = angles(n:0:-1)
         self%face(1, :) = sin(self%angle)
         self%face(2, :) = cos(self%angle)
         place = [self%angle(0), 0.5_wp*(self%angle(:n - 1) + self%angle(1:)), self%angle(n)]
         self%middle(1, :) = sin(place(1:n))
         self%middle(2, :) = cos(place(1:n))
         self%width = self%angle(:n - 1) - self%angle(1:)
         self%integral(1, :) = self%face(2, 1:) - self%face(2, :n - 1)
         self%integral(2, :) = self%face(1, :n - 1) - self%face(1, 1:)
         between = place(:n) - place(1:)
         k = speed*self%gap%journal_radius/(2*self%radius)
         self%scale = 12*oil%viscosity*self%radius**2
         self%wedge = self%scale*k
         associate (e => motion%middle%position, g => motion%slope)
            u = self%scale*[motion%middle%velocity + k*[e(2), -e(1)], motion%slope_rate + k*[g(2), -g(1)]]
         end associate
         do i = 0, n
            do r = 1, self%rows
               self%h_face(r, i) = thickness(self, motion, self%face(:, i), self%z(r))
               self%along(r, i) = self%h_face(r, i)**3/between(i)*self%height(r)
               self%along_turn(r, i) = 3/self%h_face(r, i)
               if (i == 0) cycle
               self%h(r, i) = thickness(self, motion, self%middle(:, i), self%z(r))
               self%source(r, i) = self%height(r)*dot_product(u(:2) + self%z(r)*u(3:), self%integral(:, i))
            end do
            if (i == 0) cycle
            do r = 0, self%rows
               associate (h => thickness(self, motion, self%middle(:, i), self%z_face(r)))
                  self%across(r, i) = h**3*self%radius**2*self%width(i)*self%per_distance(r)
                  self%across_turn(r, i) = 3/h
               end associate
            end do
         end do
      end associate
      if (oil%varies) call take_law(self, place, motion, oil)
   end subroutine set_motion

   pure real(wp) function thickness(self, motion, n, z)
      type(sloped_volumes_type), intent(in) :: self
      type(sloped_motion), intent(in) :: motion
      real(wp), intent(in) :: n(2), z
      thickness = self%gap%machined_clearance - dot_product(motion%middle%position + z*motion%slope, n)
   end function thickness

   !> What a law that varies makes of them.
   subroutine take_law(self, place, motion, oil)
      type(sloped_volumes_type), intent(inout) :: self
      real(wp), intent(in) :: place(0:)
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      type(law_at_nodes) :: cells, faces
      integer :: r
      associate (n => self%columns, turns => oil%turns_with_thickness())
         do r = 0, self%rows
            call oil%at_nodes(self%gap, motion%at(self%z_face(r)), self%middle(1, :), self%middle(2, :), cells)
            self%across(r, :) = self%across(r, :)/cells%inverse_root**2
            if (turns) self%across_turn(r, :) = self%across_turn(r, :) &
               & *(1 + (cells%flow_power(:, 0) + cells%across_power(:, 0))/3)
            if (turns) self%across(r, :) = self%across(r, :)*cells%across
            if (r == 0) cycle
            call oil%at_nodes(self%gap, motion%at(self%z(r)), self%face(1, :), self%face(2, :), faces)
            self%along(r, :) = self%along(r, :)/faces%inverse_root**2
            if (turns) self%along_turn(r, :) = self%along_turn(r, :)*(1 + faces%flow_power(:, 0)/3)
            self%sliding_face(r, :) = faces%sliding
            self%sliding(r, :) = cells%sliding
            self%shear(r, :) = oil%shear_weight(self%gap, motion%at(self%z(r)), place(1:n))
            associate (more => (faces%sliding - 1)*self%h_face(r, :))
               self%source(r, :) = self%source(r, :) + self%height(r)*self%wedge*(more(:n) - more(2:))
            end associate
         end do
      end associate
   end subroutine take_law

   !> The film at the motion that has been set; response%film%status tells whether the active set was found.
   subroutine evaluate(self, cavitates, want_derivatives, counters, response)
      class(sloped_volumes_type), intent(inout) :: self
      logical, intent(in) :: cavitates, want_derivatives
      type(film_counters), intent(inout) :: counters
      type(sloped_response), intent(inout) :: response
      integer :: round, first
      logical :: was_full
      logical, allocatable :: held(:, :)
      if (.not. cavitates) then
         allocate (held, source=self%film)
         self%film = .true.
      end if
      was_full = all(self%film)
      first = 1
      do round = 1, rounds_a_column*self%columns
         call factorise(self, first)
         call solve(self, self%source, .true., self%p(1:self%rows, 1:self%columns))
         counters%passes = counters%passes + 1
         if (.not. cavitates) exit
         call update_film(self, was_full .and. round <= rounds_of_growth, first)
         if (first > self%columns) exit
      end do
      if (cavitates .and. first <= self%columns) response%film%status = film_not_converged
      call sum_up(self, response)
      if (want_derivatives) call differentiate(self, cavitates, response)
      ! the next cavitated film begins as the last one ended
      if (.not. cavitates) call move_alloc(held, self%film)
   end subroutine evaluate

   !> Factor of the equations of the cells of the film, from a column on.
   pure subroutine factorise(self, first, more)
      type(sloped_volumes_type), intent(inout) :: self
      integer, intent(in) :: first
      !> Added to the diagonal, (row, column).
      real(wp), intent(in), optional :: more(:, :)
      real(wp) :: column(0:self%rows)
      integer :: i, r
      do i = first, self%columns
         do r = 1, self%rows
            column = 0
            column(0) = 1
            if (self%film(r, i)) then
               column(0) = self%along(r, i - 1) + self%along(r, i) + self%across(r - 1, i) + self%across(r, i)
               if (present(more)) column(0) = column(0) + more(r, i)
               if (r < self%rows) then
                  if (self%film(r + 1, i)) column(1) = -self%across(r, i)
               end if
               if (i < self%columns) then
                  if (self%film(r, i + 1)) column(self%rows) = -self%along(r, i)
               end if
            end if
            call eliminate(self%rows, self%rows*(i - 1) + r, column, self%factor)
         end do
      end do
   end subroutine factorise

   !> Column j of the factor of a band from that of the matrix and the columns before it.
   pure subroutine eliminate(m, j, column, factor)
      integer, intent(in) :: m, j
      real(wp), intent(inout) :: column(0:m), factor(0:m, *)
      real(wp) :: t
      integer :: d
      do d = 1, min(m, j - 1)
         t = factor(d, j - d)*factor(0, j - d)
         if (abs(t) > 0) column(:m - d) = column(:m - d) - t*factor(d:, j - d)
      end do
      factor(0, j) = column(0)
      factor(1:, j) = column(1:)/column(0)
   end subroutine eliminate

   !> The solution for a load of each cell of the film and, if wanted, the pressures of the edges.
   pure subroutine solve(self, load, edges, x)
      type(sloped_volumes_type), intent(in) :: self
      real(wp), intent(in) :: load(:, :)
      logical, intent(in) :: edges
      real(wp), intent(out) :: x(:, :)
      real(wp) :: b(self%rows*(self%columns + 1))
      integer :: j, m
      m = self%rows
      x = merge(load, 0.0_wp, self%film)
      if (edges) then
         associate (n => self%columns, p => self%p)
            x(:, 1) = x(:, 1) + merge(self%along(:, 0)*p(1:m, 0), 0.0_wp, self%film(:, 1))
            x(:, n) = x(:, n) + merge(self%along(:, n)*p(1:m, n + 1), 0.0_wp, self%film(:, n))
            x(1, :) = x(1, :) + merge(self%across(0, :)*p(0, 1:n), 0.0_wp, self%film(1, :))
            x(m, :) = x(m, :) + merge(self%across(m, :)*p(m + 1, 1:n), 0.0_wp, self%film(m, :))
         end associate
      end if
      b(:m*self%columns) = reshape(x, [m*self%columns])
      b(m*self%columns + 1:) = 0
      do j = 1, m*self%columns
         b(j + 1:j + m) = b(j + 1:j + m) - self%factor(1:, j)*b(j)
      end do
      do j = m*self%columns, 1, -1
         b(j) = b(j)/self%factor(0, j) - dot_product(self%factor(1:, j), b(j + 1:j + m))
      end do
      x = reshape(b, shape(x))
   end subroutine solve

   !> What flows into a cell by the pressures around it, less what flows out by its own.
   pure real(wp) function inflow(self, r, i)
      type(sloped_volumes_type), intent(in) :: self
      integer, intent(in) :: r, i
      associate (p => self%p, own => self%p(r, i))
         inflow = self%along(r, i - 1)*(p(r, i - 1) - own) + self%along(r, i)*(p(r, i + 1) - own) &
            & + self%across(r - 1, i)*(p(r - 1, i) - own) + self%across(r, i)*(p(r + 1, i) - own)
      end associate
   end function inflow

   !> Takes cells below the cavitation pressure out of the film, and puts those back that would fill. `grows_far`: what
   !> flows into a cell beyond what fills it is handed on along its row, away from the film (elimination_film). `first`:
   !> the first column that changes, or one beyond the last.
   pure subroutine update_film(self, grows_far, first)
      type(sloped_volumes_type), intent(inout) :: self
      logical, intent(in) :: grows_far
      integer, intent(out) :: first
      real(wp) :: floor, limit, into, surplus
      integer :: i, r, from, to
      logical :: now
      first = self%columns + 1
      associate (p => self%p, n => self%columns)
         floor = -rounding*maxval(p)
         do r = 1, self%rows
            surplus = 0
            ! a film that diverges at the trailing edge ends there
            from = merge(1, n, self%source(r, n) < 0)
            to = n + 1 - from
            do i = from, to, sign(1, to - from)
               if (self%film(r, i)) then
                  now = p(r, i) >= floor
                  surplus = 0
               else
                  limit = -floor*(self%along(r, i - 1) + self%along(r, i) + self%across(r - 1, i) + self%across(r, i))
                  into = inflow(self, r, i) + self%source(r, i) + surplus
                  now = into > limit
                  surplus = 0
                  if (grows_far .and. now) surplus = into
               end if
               if (now .neqv. self%film(r, i)) first = min(first, i)
               self%film(r, i) = now
            end do
         end do
         ! the column before has what joins it to this one
         if (first <= n) first = max(1, first - 1)
         p(1:self%rows, 1:n) = merge(p(1:self%rows, 1:n), 0.0_wp, self%film)
      end associate
   end subroutine update_film

   !> Force, moment and pressures.
   pure subroutine sum_up(self, response)
      type(sloped_volumes_type), intent(in) :: self
      type(sloped_response), intent(inout) :: response
      real(wp) :: even, odd
      integer :: i, at(2)
      associate (p => self%p(1:self%rows, 1:self%columns), lowest => self%gap%cavitation_pressure, &
         & film => response%film)
         film%force = 0
         response%moment = 0
         do i = 1, self%columns
            even = dot_product(self%height, p(:, i)) + lowest*self%gap%axial_length
            odd = dot_product(self%height*self%z, p(:, i))
            film%force = film%force - self%radius*even*self%integral(:, i)
            response%moment = response%moment - self%radius*odd*self%integral(:, i)
         end do
         film%min_pressure = lowest + min(minval(p), self%p(0, 1), self%p(1, 0))
         at = maxloc(p)
         call take_highest(self, at, response)
      end associate
   end subroutine sum_up

   !> The highest pressure, that of the parabolas along and across through the highest cell and its neighbours.
   pure subroutine take_highest(self, at, response)
      type(sloped_volumes_type), intent(in) :: self
      integer, intent(in) :: at(2)
      type(sloped_response), intent(inout) :: response
      real(wp) :: phi(-1:1), z(-1:1), step(2), rise(2)
      associate (r => at(1), i => at(2), p => self%p, lowest => self%gap%cavitation_pressure)
         phi(0) = 0.5_wp*(self%angle(i - 1) + self%angle(i))
         phi(-1) = 0.5_wp*(self%angle(max(i - 2, 0)) + self%angle(i - 1))
         phi(1) = 0.5_wp*(self%angle(i) + self%angle(min(i + 1, self%columns)))
         z(0) = self%z(r)
         z(-1) = -0.5_wp*self%gap%axial_length
         z(1) = -z(-1)
         if (r > 1) z(-1) = self%z(r - 1)
         if (r < self%rows) z(1) = self%z(r + 1)
         call top(phi, p(r, i - 1:i + 1), step(1), rise(1))
         call top(z, p(r - 1:r + 1, i), step(2), rise(2))
         response%place = [phi(0), z(0)] + step
         response%film%max_pressure = lowest + max(p(r, i) + sum(rise), self%p(1, 0), self%p(0, 1))
      end associate
   end subroutine take_highest

   !> Where the parabola through three points has its top, from the second, and how far above it.
   pure subroutine top(x, y, step, rise)
      real(wp), intent(in) :: x(-1:1), y(-1:1)
      real(wp), intent(out) :: step, rise
      real(wp) :: before, after, bend, slope
      before = (y(0) - y(-1))/(x(0) - x(-1))
      after = (y(1) - y(0))/(x(1) - x(0))
      bend = (after - before)/(x(1) - x(-1))
      slope = before + bend*(x(0) - x(-1))
      step = 0
      rise = 0
      if (.not. bend < 0) return
      step = -slope/(2*bend)
      rise = -slope**2/(4*bend)
   end subroutine top

   !> Derivatives of force and moment, by an adjoint for each.
   subroutine differentiate(self, cavitates, response)
      type(sloped_volumes_type), intent(inout) :: self
      logical, intent(in) :: cavitates
      type(sloped_response), intent(inout) :: response
      real(wp) :: more(self%rows, self%columns), load(self%rows, self%columns), adjoint(self%rows, self%columns)
      real(wp) :: power(self%rows)
      integer :: a, i, m
      m = self%rows
      if (cavitates .and. .not. all(self%film)) then
         call find_more(self, more)
         call factorise(self, max(1, findloc(any(more > 0, 1), .true., dim=1)), more)
      end if
      do a = 1, 4
         power = self%radius*self%height
         if (a > 2) power = power*self%z
         do i = 1, self%columns
            load(:, i) = -power*self%integral(merge(1, 2, mod(a, 2) == 1), i)
         end do
         call solve(self, load, .false., adjoint)
         call multiply(self, adjoint, response%derivatives(a, :))
      end do
      associate (d => response%derivatives, k => self%wedge/self%scale)
         d(:, 1) = d(:, 1) - k*d(:, 6)
         d(:, 2) = d(:, 2) + k*d(:, 5)
         d(:, 3) = d(:, 3) - k*d(:, 8)
         d(:, 4) = d(:, 4) + k*d(:, 7)
      end associate
   end subroutine differentiate

   !> Derivatives from an adjoint: those over position and slope but for what w and v make.
   pure subroutine multiply(self, adjoint, d)
      type(sloped_volumes_type), intent(in) :: self
      real(wp), intent(in) :: adjoint(:, :)
      real(wp), intent(out) :: d(8)
      real(wp), allocatable :: a(:, :)
      real(wp), dimension(self%rows) :: over, sliding, even
      real(wp) :: sides(0:self%rows)
      integer :: i, m
      m = self%rows
      d = 0
      allocate (a(0:m + 1, 0:self%columns + 1), source=0.0_wp)
      a(1:m, 1:self%columns) = adjoint
      associate (p => self%p)
         do i = 0, self%columns
            over = self%along(:, i)*self%along_turn(:, i)*(p(1:m, i + 1) - p(1:m, i))*(a(1:m, i + 1) - a(1:m, i))
            ! what slides through a face leaves one cell and drives the next
            sliding = self%wedge*self%height*(self%sliding_face(:, i) - 1)*(a(1:m, i + 1) - a(1:m, i))
            over = over - sliding
            d(1:2) = d(1:2) + sum(over)*self%face(:, i)
            d(3:4) = d(3:4) + dot_product(over, self%z)*self%face(:, i)
            if (i == 0) cycle
            sides = self%across(:, i)*self%across_turn(:, i)*(p(1:, i) - p(:m, i))*(a(1:, i) - a(:m, i))
            d(1:2) = d(1:2) + sum(sides)*self%middle(:, i)
            d(3:4) = d(3:4) + dot_product(sides, self%z_face)*self%middle(:, i)
            even = self%scale*self%height*adjoint(:, i)
            d(5:6) = d(5:6) + sum(even)*self%integral(:, i)
            d(7:8) = d(7:8) + dot_product(even, self%z)*self%integral(:, i)
         end do
      end associate
   end subroutine multiply

   !> What the end of the film adds to the diagonals of cells beside it (volume_equations, boundary_conductance).
   pure subroutine find_more(self, more)
      type(sloped_volumes_type), intent(in) :: self
      real(wp), intent(out) :: more(:, :)
      real(wp) :: filled(0:self%rows + 1, 0:self%columns + 1), width(0:self%columns + 1), height(0:self%rows + 1)
      integer :: i, r
      filled = 1
      width = [0.0_wp, self%width, 0.0_wp]
      height = [0.0_wp, self%height, 0.0_wp]
      do i = 1, self%columns
         do r = 1, self%rows
            if (self%film(r, i)) cycle
            filled(r, i) = 0
            if (self%source(r, i) < 0) filled(r, i) = min(1.0_wp, max(0.0_wp, -inflow(self, r, i)/self%source(r, i)))
         end do
      end do
      more = 0
      do i = 1, self%columns
         do r = 1, self%rows
            if (.not. self%film(r, i)) cycle
            more(r, i) = self%along(r, i - 1)*nearer(width(i), width(i - 1), filled(r, i - 1)) &
               & + self%along(r, i)*nearer(width(i), width(i + 1), filled(r, i + 1)) &
               & + self%across(r - 1, i)*nearer(height(r), height(r - 1), filled(r - 1, i)) &
               & + self%across(r, i)*nearer(height(r), height(r + 1), filled(r + 1, i))
         end do
      end do
   end subroutine find_more

   !> Distance from the middle of a cell to that of its neighbour, over the distance to the end of the film, less 1; 0
   !> where the neighbour is full.
   elemental real(wp) function nearer(own, other, filled)
      real(wp), intent(in) :: own, other, filled
      nearer = 0
      if (filled < 1) nearer = (own + other)/(own + 2*filled*other) - 1
   end function nearer

   !> Lets the next film start as a full one, or from the cells of that on a grid of half as many columns and rows.
   pure subroutine start_from(self, coarse)
      class(sloped_volumes_type), intent(inout) :: self
      type(sloped_volumes_type), intent(in), optional :: coarse
      integer :: i, r
      self%film = .true.
      if (.not. present(coarse)) return
      do i = 1, self%columns
         self%film(:, i) = coarse%film([((r + 1)/2, r=1, self%rows)], (i + 1)/2)
      end do
   end subroutine start_from

   !> Makes the cells of a full film below the cavitation pressure cavitated ones (Guembel).
   pure subroutine drop_tension(self)
      class(sloped_volumes_type), intent(inout) :: self
      self%film = self%p(1:self%rows, 1:self%columns) > 0
   end subroutine drop_tension

   !> Loss and flows of the last film (film_losses), at a speed of the journal's surface, m/s.
   subroutine losses(self, oil, surface, loss)
      class(sloped_volumes_type), intent(inout) :: self
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: surface
      type(film_loss), intent(out) :: loss
      type(sloped_response) :: response
      real(wp), allocatable :: free(:, :)
      integer :: r
      ! across the edge of a film that is clipped the oil flows as in the full one
      free = self%p
      self%p(1:self%rows, 1:self%columns) = merge(self%p(1:self%rows, 1:self%columns), 0.0_wp, self%film)
      call sum_up(self, response)
      loss%force = response%film%force
      do r = 1, self%rows
         call add_row(self, oil, surface, r, free, loss)
      end do
   end subroutine losses

   !> Adds a row of cells, in the order of the flow.
   pure subroutine add_row(self, oil, surface, r, free, loss)
      type(sloped_volumes_type), intent(in) :: self
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: surface
      integer, intent(in) :: r
      !> Pressures before cavitated cells got that of cavitation.
      real(wp), intent(in) :: free(0:, 0:)
      type(film_loss), intent(inout) :: loss
      !> Flows through the last face and on from a cavitated cell, and driven by pressure, m^3/s; drop over a face, Pa.
      real(wp) :: through, carried, driven, drop, unit, shear, arriving
      integer :: i
      logical :: before, after
      unit = self%radius/self%scale
      carried = 0
      before = .false.
      do i = 0, self%columns
         after = .false.
         if (i < self%columns) after = self%film(r, i + 1)
         through = 0.5_wp*surface*self%sliding_face(r, i)*self%h_face(r, i)*self%height(r)
         if (before .or. after) then
            drop = self%p(r, i) - self%p(r, i + 1)
            driven = unit*self%along(r, i)*(free(r, i) - free(r, i + 1))
            loss%pressure = loss%pressure + unit*self%along(r, i)*drop**2
            loss%wedge = loss%wedge - through*drop
            through = through + driven
            if (i > 0 .and. .not. before) loss%unfed = loss%unfed + through - carried
         else if (i > 0) then
            through = carried
         end if
         if (i == 0) loss%inlet = loss%inlet + through
         if (i == self%columns) loss%outlet = loss%outlet + through
         if (i == self%columns) exit
         shear = oil%viscosity*self%shear(r, i + 1)*surface*self%radius*self%width(i + 1)*self%height(r)/self%h(r, i + 1)
         loss%couette = loss%couette + shear*surface
         arriving = 0
         call take_sides(self, r, i + 1, unit, free, arriving, loss)
         if (.not. after) then
            carried = through + arriving
            loss%couette = loss%couette - shear*max(0.0_wp, surface - (through + carried) &
               & /(self%sliding(r, i + 1)*self%h(r, i + 1)*self%height(r)))
         end if
         before = after
      end do
   end subroutine add_row

   !> Heat of the flow across through both faces of a cell, each face once; flow out at the sides; what arrives in a
   !> cavitated cell from the film beside it.
   pure subroutine take_sides(self, r, i, unit, free, arriving, loss)
      type(sloped_volumes_type), intent(in) :: self
      integer, intent(in) :: r, i
      real(wp), intent(in) :: unit, free(0:, 0:)
      real(wp), intent(inout) :: arriving
      type(film_loss), intent(inout) :: loss
      real(wp) :: flow, drop
      integer :: side
      logical :: neighbour
      do side = -1, 1, 2
         associate (next => r + side, face => r + min(side, 0))
            drop = self%p(r, i) - self%p(next, i)
            flow = unit*self%across(face, i)*(free(r, i) - free(next, i))
            neighbour = .false.
            if (next >= 1 .and. next <= self%rows) neighbour = self%film(next, i)
            if (self%film(r, i)) then
               loss%pressure = loss%pressure + merge(0.5_wp, 1.0_wp, neighbour)*unit*self%across(face, i)*drop**2
               if (next < 1 .or. next > self%rows) loss%side = loss%side + flow
            else if (neighbour) then
               arriving = arriving - flow
            end if
         end associate
      end do
   end subroutine take_sides

   !> Pressure of the last film, Pa, at an angle from the pivot, rad, and z, m: linear between the middles of cells and
   !> the edges.
   pure real(wp) function pressure_at(self, phi, z) result(pressure)
      class(sloped_volumes_type), intent(in) :: self
      real(wp), intent(in) :: phi, z
      real(wp) :: places(0:self%columns + 1), lines(0:self%rows + 1), t, s
      integer :: i, r
      associate (n => self%columns, m => self%rows, p => self%p)
         places = [self%angle(0), 0.5_wp*(self%angle(:n - 1) + self%angle(1:)), self%angle(n)]
         lines = [self%z_face(0), self%z, self%z_face(m)]
         i = min(max(count(places >= phi) - 1, 0), n)
         r = min(max(count(lines <= z) - 1, 0), m)
         t = (phi - places(i))/(places(i + 1) - places(i))
         s = (z - lines(r))/(lines(r + 1) - lines(r))
         pressure = self%gap%cavitation_pressure + (1 - t)*((1 - s)*p(r, i) + s*p(r + 1, i)) &
            & + t*((1 - s)*p(r, i + 1) + s*p(r + 1, i + 1))
      end associate
   end function pressure_at
end module sloped_volumes
