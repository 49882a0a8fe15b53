!> Finite volumes of one pad's film with slopes on its full width, of any oil, between any pressures, with any condition
!> of cavitation (weighted_film has the equation, film_grid the volumes of a film without slopes).
!>
!> Columns of cells lie along the arc from the leading to the trailing edge, rows across the width, narrow at the sides
!> as those of film_grid. Columns are eliminated from the leading edge on, each by the inverse of a small dense block,
!> which stays what it was up to the first column whose cells change.
!>
!> Which cells are cavitated by the condition of Reynolds is found as an active set (elimination_film). Derivatives are
!> those of a film that ends between its cells: there the pressure leaves zero with a slope of zero, so that a change of
!> the pressure is zero where the film ends, not in the middle of the first cavitated cell. With the ends of cells they
!> would err by the first order of the cells, and moments of yaw, small differences of both halves, by tenths.
module sloped_volumes
   use kinds, only: wp
   use film_solver, only: film_law_type, film_counters, film_not_converged, cavitation_none, cavitation_gumbel, &
      & cavitation_reynolds
   use film_law, only: law_at_nodes
   use column_elimination, only: invert
   use linear_algebra, only: padded, apply
   use film_losses, only: film_loss
   use pad_gap, only: pad_gap_type
   use sloped_gap, only: sloped_motion, sloped_response, driving_velocity, add_rotation, find_highest
   implicit none (type, external)
   private
   public :: sloped_volumes_type, new_sloped_volumes, end_between, solve, flow_into

   !> How much the rows' heights change (film_grid).
   real(wp), parameter :: grading = 0.85_wp
   !> Rounds of the active set at most, for each column, and those in which a film that begins full grows far.
   integer, parameter :: rounds_a_column = 2, rounds_of_growth = 4
   !> Pressure over the highest below which a cell counts as empty: rounding must not decide.
   real(wp), parameter :: rounding = 1e-12_wp

   type :: sloped_volumes_type
      type(pad_gap_type) :: gap
      !> 0 before it is made.
      integer :: rows = 0
      integer :: columns
      real(wp) :: radius
      !> Angles from the pivot, rad: of the edges and the middles of columns (0:columns + 1), and of faces (0:columns);
      !> sin and cos of faces, middles, and their integrals over columns, (2, ..).
      real(wp), allocatable :: angle(:), at_face(:), face(:, :), middle(:, :), integral(:, :)
      !> Heights of rows; z of the edges and the middles of rows (0:rows + 1), and of faces (0:rows), m; 1 over the
      !> distance across faces, 1/m.
      real(wp), allocatable :: height(:), z(:), z_face(:), per_distance(:)
      !> Conductances through faces along, (row, 0:columns), and across, (0:rows, column), m^3, and what drives the
      !> film, (row, column), N m; d ln/dh of the first two, 1/m.
      real(wp), allocatable :: along(:, :), across(:, :), source(:, :), along_turn(:, :), across_turn(:, :)
      !> Film thickness in cells and at faces along, m; S in cells, G in cells and at faces (film_law).
      real(wp), allocatable :: h(:, :), h_face(:, :), shear(:, :), sliding(:, :), sliding_face(:, :)
      !> Journal speed, rad/s; 12 mu R^2, and that times k (weighted_film).
      real(wp) :: speed = 0, scale = 0, wedge = 0
      !> Cells of the film: 1, others 0; pressures above that of cavitation, Pa, with those of the edges around.
      real(wp), allocatable :: film(:, :), p(:, :)
      !> Inverses of the blocks of columns, (padded row, row, column); the columns in which they hold, for which cells.
      real(wp), allocatable :: inverse(:, :, :), factored(:, :)
      integer :: valid = 0
   contains
      procedure :: set_motion
      procedure :: evaluate
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
      associate (m => rows, n => columns)
         allocate (self%height(m), self%z(0:m + 1), self%z_face(0:m), self%per_distance(0:m), self%integral(2, n), &
            & self%middle(2, n), self%face(2, 0:n), self%angle(0:n + 1), self%at_face(0:n))
         allocate (self%along(m, 0:n), self%across(0:m, n), self%source(m, n), self%along_turn(m, 0:n), &
            & self%across_turn(0:m, n), self%h(m, n), self%h_face(m, 0:n))
         allocate (self%shear(m, n), self%sliding(m, n), self%sliding_face(m, 0:n), self%film(m, n), source=1.0_wp)
         allocate (self%p(0:m + 1, 0:n + 1), self%inverse(padded(m), m, n), self%factored(m, n), source=0.0_wp)
      end associate
      half = rows/2
      self%z_face(half) = 0
      do k = 1, half
         self%height(half + k) = 0.5_wp*gap%axial_length/half*(1 + grading*(half + 1 - 2*k)/half)
         self%height(half + 1 - k) = self%height(half + k)
         self%z_face(half + k) = self%z_face(half + k - 1) + self%height(half + k)
         self%z_face(half - k) = -self%z_face(half + k)
      end do
      self%z = [self%z_face(0), 0.5_wp*(self%z_face(1:) + self%z_face(:rows - 1)), self%z_face(rows)]
      square = self%z(1:rows)**2 + self%height**2/12
      do k = 1, rows - 1
         if (k /= half) self%per_distance(k) = 2*self%z_face(k)/(square(k + 1) - square(k))
      end do
      self%per_distance(half) = 1/(self%z(half + 1) - self%z(half))
      self%per_distance(rows) = 2*self%z_face(rows)/(self%z_face(rows)**2 - square(rows))
      self%per_distance(0) = self%per_distance(rows)
      self%p(:, 0) = gap%supply_pressure - gap%cavitation_pressure
      self%p(:, columns + 1) = gap%ambient_pressure - gap%cavitation_pressure
      self%p([0, rows + 1], 1:columns) = gap%ambient_pressure - gap%cavitation_pressure
   end function new_sloped_volumes

   !> Columns between these angles from the pivot, rad, from the trailing to the leading edge, and conductances and
   !> sources at a motion, with an oil and a journal speed, rad/s.
   subroutine set_motion(self, angles, motion, oil, speed)
      class(sloped_volumes_type), intent(inout) :: self
      real(wp), intent(in) :: angles(0:)
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      real(wp) :: u(4), e(0:self%rows, 2)
      integer :: i
      self%speed = speed
      self%scale = 12*oil%viscosity*self%radius**2
      self%wedge = 0.5_wp*self%scale*speed*self%gap%journal_radius/self%radius
      self%valid = 0
      u = self%scale*driving_velocity(self%gap, motion, speed)
      associate (n => self%columns, m => self%rows, c => self%gap%machined_clearance, z => self%z(1:self%rows), &
         & x => self%at_face, place => self%angle)
         x = angles(n:0:-1)
         place = [x(0), 0.5_wp*(x(:n - 1) + x(1:)), x(n)]
         self%face(1, :) = sin(x)
         self%face(2, :) = cos(x)
         self%middle(1, :) = sin(place(1:n))
         self%middle(2, :) = cos(place(1:n))
         self%integral(1, :) = self%face(2, 1:) - self%face(2, :n - 1)
         self%integral(2, :) = self%face(1, :n - 1) - self%face(1, 1:)
         do i = 0, n
            self%h_face(:, i) = c - self%face(1, i)*(motion%middle%position(1) + z*motion%slope(1)) &
               & - self%face(2, i)*(motion%middle%position(2) + z*motion%slope(2))
            self%along(:, i) = self%h_face(:, i)**3*self%height/(place(i) - place(i + 1))
            self%along_turn(:, i) = 3/self%h_face(:, i)
         end do
         e(:, 1) = motion%middle%position(1) + self%z_face*motion%slope(1)
         e(:, 2) = motion%middle%position(2) + self%z_face*motion%slope(2)
         do i = 1, n
            associate (h => c - self%middle(1, i)*e(:, 1) - self%middle(2, i)*e(:, 2))
               self%h(:, i) = 0.5_wp*(h(:m) + h(2:))
               self%across(:, i) = h**3*(self%radius**2*(x(i - 1) - x(i)))*self%per_distance
               self%across_turn(:, i) = 3/h
            end associate
            self%source(:, i) = self%height*((u(1) + z*u(3))*self%integral(1, i) + (u(2) + z*u(4))*self%integral(2, i))
         end do
      end associate
      if (oil%varies) call take_law(self, motion, oil)
   end subroutine set_motion

   !> What a law that varies makes of them.
   subroutine take_law(self, motion, oil)
      class(sloped_volumes_type), intent(inout) :: self
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      type(law_at_nodes) :: cells, faces
      integer :: r
      associate (n => self%columns, turns => oil%turns_with_thickness())
         do r = 0, self%rows
            call oil%at_nodes(self%gap, motion%at(self%z_face(r)), self%middle(1, :), self%middle(2, :), cells)
            self%across(r, :) = self%across(r, :)/cells%inverse_root**2
            if (turns) self%across(r, :) = self%across(r, :)*cells%across
            if (turns) self%across_turn(r, :) = self%across_turn(r, :) &
               & *(1 + (cells%flow_power(:, 0) + cells%across_power(:, 0))/3)
            if (r == 0) cycle
            call oil%at_nodes(self%gap, motion%at(self%z(r)), self%face(1, :), self%face(2, :), faces)
            self%along(r, :) = self%along(r, :)/faces%inverse_root**2
            if (turns) self%along_turn(r, :) = self%along_turn(r, :)*(1 + faces%flow_power(:, 0)/3)
            self%sliding_face(r, :) = faces%sliding
            self%sliding(r, :) = cells%sliding
            self%shear(r, :) = oil%shear_weight(self%gap, motion%at(self%z(r)), self%angle(1:n))
            associate (more => (faces%sliding - 1)*self%h_face(r, :))
               self%source(r, :) = self%source(r, :) + self%wedge*self%height(r)*(more(:n) - more(2:))
            end associate
         end do
      end associate
   end subroutine take_law

   !> The film at the motion that has been set, with a condition of cavitation: Reynolds' from its last film.
   subroutine evaluate(self, condition, want_derivatives, counters, response)
      class(sloped_volumes_type), intent(inout) :: self
      integer, intent(in) :: condition
      logical, intent(in) :: want_derivatives
      type(film_counters), intent(inout) :: counters
      type(sloped_response), intent(inout) :: response
      real(wp) :: before(self%rows, self%columns)
      integer :: round
      logical :: was_full, changes
      before = self%film
      if (condition /= cavitation_reynolds) self%film = 1
      was_full = all(self%film > 0)
      do round = 1, rounds_a_column*self%columns
         call factorise(self)
         call solve_film(self)
         counters%passes = counters%passes + 1
         changes = .false.
         if (condition == cavitation_reynolds) call update_film(self, was_full .and. round <= rounds_of_growth, changes)
         if (.not. changes) exit
      end do
      if (changes) response%film%status = film_not_converged
      if (condition == cavitation_gumbel) self%film = merge(1.0_wp, 0.0_wp, self%p(1:self%rows, 1:self%columns) > 0)
      call sum_up(self, response)
      if (want_derivatives) call differentiate(self, condition, response)
      if (condition == cavitation_none) self%film = before
   end subroutine evaluate

   !> Inverses of the blocks of columns of the cells of the film, from the first that has changed on.
   pure subroutine factorise(self, more)
      type(sloped_volumes_type), intent(inout) :: self
      !> Added to the diagonal, (row, column); the inverses do not hold for others then.
      real(wp), intent(in), optional :: more(:, :)
      real(wp) :: mask(size(self%inverse, 1))
      integer :: first, i, r
      associate (film => self%film, m => self%rows, n => self%columns)
         do first = 1, self%valid
            if (any(abs(film(:, first) - self%factored(:, first)) > 0)) exit
            if (present(more)) then
               if (any(more(:, first) > 0)) exit
            end if
         end do
         mask = 0
         do i = first, n
            associate (block => self%inverse(:, :, i), join => self%along(:, i - 1))
               block = 0
               do r = 1, m
                  if (i > 1) block(:m, r) = -join(r)*join*self%inverse(:m, r, i - 1)
                  block(r, r) = block(r, r) + join(r) + self%along(r, i) + self%across(r - 1, i) + self%across(r, i)
                  if (present(more)) block(r, r) = block(r, r) + more(r, i)
                  if (r > 1) block(r - 1, r) = block(r - 1, r) - self%across(r - 1, i)
                  if (r < m) block(r + 1, r) = block(r + 1, r) - self%across(r, i)
               end do
               mask(:m) = film(:, i)
               call invert(size(mask), m, mask, block)
            end associate
         end do
         self%factored = film
         self%valid = merge(0, n, present(more))
      end associate
   end subroutine factorise

   !> The solution for a load of all cells in its place, (padded row, column).
   pure subroutine solve(self, b)
      type(sloped_volumes_type), intent(in) :: self
      real(wp), intent(inout) :: b(:, :)
      integer :: i
      associate (m => self%rows, n => self%columns, padded_rows => size(b, 1))
         do i = 1, n
            if (i > 1) b(:m, i) = b(:m, i) + self%along(:, i - 1)*b(:m, i - 1)
            b(:, i) = apply(padded_rows, m, self%inverse(:, :, i), b(:m, i))
         end do
         do i = n - 1, 1, -1
            b(:, i) = b(:, i) + apply(padded_rows, m, self%inverse(:, :, i), self%along(:, i)*b(:m, i + 1))
         end do
      end associate
   end subroutine solve

   !> The pressures of the cells of the film.
   pure subroutine solve_film(self)
      type(sloped_volumes_type), intent(inout) :: self
      real(wp) :: b(size(self%inverse, 1), self%columns)
      associate (m => self%rows, n => self%columns, p => self%p)
         b(:m, :) = self%source
         b(:m, 1) = b(:m, 1) + self%along(:, 0)*p(1:m, 0)
         b(:m, n) = b(:m, n) + self%along(:, n)*p(1:m, n + 1)
         b(1, :) = b(1, :) + self%across(0, :)*p(0, 1:n)
         b(m, :) = b(m, :) + self%across(m, :)*p(m + 1, 1:n)
         call solve(self, b)
         p(1:m, 1:n) = b(:m, :)
      end associate
   end subroutine solve_film

   !> What flows into the cells of a column by the pressures around them, less what flows out by their own.
   pure function inflow(self, i)
      type(sloped_volumes_type), intent(in) :: self
      integer, intent(in) :: i
      real(wp) :: inflow(self%rows)
      inflow = flow_into(self%p(:, i - 1:i + 1), self%along(:, i - 1:i), self%across(:, i))
   end function inflow

   !> The same by pressures of a column, p(:, 2), and of those beside it, with the edges around, through faces with
   !> these conductances: along, (row, side), and across.
   pure function flow_into(p, along, across) result(inflow)
      real(wp), intent(in) :: p(0:, :), along(:, :), across(0:)
      real(wp) :: inflow(size(along, 1))
      associate (m => size(along, 1))
         inflow = along(:, 1)*(p(1:m, 1) - p(1:m, 2)) + along(:, 2)*(p(1:m, 3) - p(1:m, 2)) &
            & + across(:m - 1)*(p(:m - 1, 2) - p(1:m, 2)) + across(1:)*(p(2:, 2) - p(1:m, 2))
      end associate
   end function flow_into

   !> Takes cells below the cavitation pressure out of the film, and puts those back that would fill. `grows_far`: what
   !> flows into a cell beyond what fills it is handed on along its row, away from the film (elimination_film).
   pure subroutine update_film(self, grows_far, changes)
      type(sloped_volumes_type), intent(inout) :: self
      logical, intent(in) :: grows_far
      logical, intent(out) :: changes
      real(wp), dimension(self%rows) :: into, surplus, now
      real(wp) :: floor
      integer :: i, from
      changes = .false.
      surplus = 0
      floor = -rounding*maxval(self%p)
      associate (p => self%p(1:self%rows, 1:self%columns), film => self%film, n => self%columns)
         ! a film that diverges at the trailing edge ends there
         from = merge(1, n, sum(self%source(:, n)) < 0)
         do i = from, n + 1 - from, sign(1, n + 1 - 2*from)
            if (all(film(:, i) > 0 .and. p(:, i) >= floor)) then
               surplus = 0
               cycle
            end if
            into = inflow(self, i) + self%source(:, i) + surplus
            now = merge(merge(1.0_wp, 0.0_wp, p(:, i) >= floor), merge(1.0_wp, 0.0_wp, &
               & into > -floor*(self%along(:, i - 1) + self%along(:, i))), film(:, i) > 0)
            surplus = 0
            if (grows_far) surplus = merge(into, 0.0_wp, now > film(:, i))
            changes = changes .or. any(abs(now - film(:, i)) > 0)
            film(:, i) = now
         end do
      end associate
   end subroutine update_film

   !> Force, moment and pressures.
   pure subroutine sum_up(self, response)
      type(sloped_volumes_type), intent(in) :: self
      type(sloped_response), intent(inout) :: response
      real(wp) :: held(self%rows)
      integer :: i
      associate (p => self%p, m => self%rows, n => self%columns, lowest => self%gap%cavitation_pressure, &
         & film => response%film)
         film%force = 0
         response%moment = 0
         do i = 1, n
            held = self%film(:, i)*p(1:m, i)
            film%force = film%force - self%radius*(dot_product(self%height, held) + lowest*self%gap%axial_length) &
               & *self%integral(:, i)
            response%moment = response%moment - self%radius*dot_product(self%height*self%z(1:m), held) &
               & *self%integral(:, i)
         end do
         film%min_pressure = lowest + minval(p)
         call find_highest(self%angle, self%z, transpose(p), film%max_pressure, response%place)
         film%max_pressure = lowest + max(film%max_pressure, 0.0_wp)
      end associate
   end subroutine sum_up

   !> Derivatives of force and moment, by an adjoint for each.
   pure subroutine differentiate(self, condition, response)
      type(sloped_volumes_type), intent(inout) :: self
      integer, intent(in) :: condition
      type(sloped_response), intent(inout) :: response
      real(wp) :: b(size(self%inverse, 1), self%columns, 4)
      integer :: i, k
      call end_between(self, condition)
      associate (m => self%rows)
         do i = 1, self%columns
            do k = 1, 2
               b(:m, i, k) = -self%radius*self%integral(k, i)*self%height*self%film(:, i)
               b(:m, i, k + 2) = self%z(1:m)*b(:m, i, k)
            end do
         end do
      end associate
      do k = 1, 4
         call solve(self, b(:, :, k))
      end do
      call multiply(self, b, response%derivatives)
      call add_rotation(self%gap, self%speed, response%derivatives)
   end subroutine differentiate

   !> Makes the blocks those of changes of the pressure in a film that ends between its cells.
   pure subroutine end_between(self, condition)
      type(sloped_volumes_type), intent(inout) :: self
      integer, intent(in) :: condition
      real(wp) :: more(self%rows, self%columns)
      if (condition /= cavitation_reynolds .or. all(self%film > 0)) return
      call find_more(self, more)
      call factorise(self, more)
   end subroutine end_between

   !> Derivatives at constant (w, v) from the adjoints, (padded row, column, force): those of conductances, of what
   !> slides through faces, and of sources.
   pure subroutine multiply(self, adjoint, d)
      type(sloped_volumes_type), intent(in) :: self
      real(wp), intent(in) :: adjoint(:, :, :)
      real(wp), intent(out) :: d(4, 8)
      real(wp) :: a(4, 0:self%rows + 1, 0:self%columns + 1), drop, even(4), odd(4)
      integer :: i, r
      a = 0
      do i = 1, 4
         a(i, 1:self%rows, 1:self%columns) = adjoint(:self%rows, :, i)
      end do
      d = 0
      associate (p => self%p, z => self%z)
         do i = 0, self%columns
            even = 0
            odd = 0
            do r = 1, self%rows
               drop = self%along(r, i)*self%along_turn(r, i)*(p(r, i + 1) - p(r, i)) &
                  & - self%wedge*self%height(r)*(self%sliding_face(r, i) - 1)
               even = even + drop*(a(:, r, i + 1) - a(:, r, i))
               odd = odd + z(r)*drop*(a(:, r, i + 1) - a(:, r, i))
            end do
            call add(even, odd, self%face(:, i), d(:, :4))
            if (i == 0) cycle
            even = 0
            odd = 0
            do r = 0, self%rows
               drop = self%across(r, i)*self%across_turn(r, i)*(p(r + 1, i) - p(r, i))
               even = even + drop*(a(:, r + 1, i) - a(:, r, i))
               odd = odd + self%z_face(r)*drop*(a(:, r + 1, i) - a(:, r, i))
            end do
            call add(even, odd, self%middle(:, i), d(:, :4))
            even = 0
            odd = 0
            do r = 1, self%rows
               even = even + self%height(r)*a(:, r, i)
               odd = odd + self%height(r)*z(r)*a(:, r, i)
            end do
            call add(self%scale*even, self%scale*odd, self%integral(:, i), d(:, 5:))
         end do
      end associate
   contains
      pure subroutine add(even, odd, n, d)
         real(wp), intent(in) :: even(4), odd(4), n(2)
         real(wp), intent(inout) :: d(4, 4)
         d(:, 1) = d(:, 1) + n(1)*even
         d(:, 2) = d(:, 2) + n(2)*even
         d(:, 3) = d(:, 3) + n(1)*odd
         d(:, 4) = d(:, 4) + n(2)*odd
      end subroutine add
   end subroutine multiply

   !> What the end of the film adds to the diagonals of cells beside it (volume_equations, boundary_conductance).
   pure subroutine find_more(self, more)
      type(sloped_volumes_type), intent(in) :: self
      real(wp), intent(out) :: more(:, :)
      real(wp) :: filled(0:self%rows + 1, 0:self%columns + 1), width(0:self%columns + 1), height(0:self%rows + 1)
      integer :: i, r
      associate (m => self%rows, n => self%columns)
         width = [0.0_wp, self%at_face(:n - 1) - self%at_face(1:), 0.0_wp]
         height = [0.0_wp, self%height, 0.0_wp]
         filled = 1
         more = 0
         do i = 1, n
            where (.not. self%film(:, i) > 0) filled(1:m, i) = min(1.0_wp, max(0.0_wp, -inflow(self, i) &
               & /min(self%source(:, i), -tiny(1.0_wp))))
         end do
         do i = 1, n
            do r = 1, m
               if (self%film(r, i) > 0) more(r, i) &
                  & = self%along(r, i - 1)*nearer(width(i), width(i - 1), filled(r, i - 1)) &
                  & + self%along(r, i)*nearer(width(i), width(i + 1), filled(r, i + 1)) &
                  & + self%across(r - 1, i)*nearer(height(r), height(r - 1), filled(r - 1, i)) &
                  & + self%across(r, i)*nearer(height(r), height(r + 1), filled(r + 1, i))
            end do
         end do
      end associate
   contains
      elemental real(wp) function nearer(own, other, filled)
         real(wp), intent(in) :: own, other, filled
         nearer = 0
         if (filled < 1) nearer = (own + other)/(own + 2*filled*other) - 1
      end function nearer
   end subroutine find_more

   !> Loss and flows of the last film.
   pure subroutine losses(self, oil, loss)
      class(sloped_volumes_type), intent(inout) :: self
      class(film_law_type), intent(in) :: oil
      type(film_loss), intent(out) :: loss
      type(sloped_response) :: response
      real(wp) :: free(0:self%rows + 1, 0:self%columns + 1)
      integer :: r
      call sum_up(self, response)
      loss%force = response%film%force
      ! across the edge of a film that is clipped the oil flows as in the full one
      free = self%p
      self%p(1:self%rows, 1:self%columns) = self%film*self%p(1:self%rows, 1:self%columns)
      do r = 1, self%rows
         call add_row(self, oil, self%speed*self%gap%journal_radius, r, free, loss)
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
         if (i < self%columns) after = self%film(r, i + 1) > 0
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
         shear = oil%viscosity*self%shear(r, i + 1)*surface*self%radius*(self%at_face(i) - self%at_face(i + 1)) &
            & *self%height(r)/self%h(r, i + 1)
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
            if (next >= 1 .and. next <= self%rows) neighbour = self%film(next, i) > 0
            if (self%film(r, i) > 0) then
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
      real(wp) :: t, s
      integer :: i, r
      associate (n => self%columns, m => self%rows, p => self%p, x => self%angle, lines => self%z)
         i = min(max(count(x >= phi) - 1, 0), n)
         r = min(max(count(lines <= z) - 1, 0), m)
         t = (phi - x(i))/(x(i + 1) - x(i))
         s = (z - lines(r))/(lines(r + 1) - lines(r))
         pressure = self%gap%cavitation_pressure + (1 - t)*((1 - s)*p(r, i) + s*p(r + 1, i)) &
            & + t*((1 - s)*p(r, i + 1) + s*p(r + 1, i + 1))
      end associate
   end function pressure_at
end module sloped_volumes
