!> A full film with slopes by weighted functions (docs/theory/film.md, *Slopes*).
!>
!> With phi along the arc and R the pad's radius the pressure obeys
!>    (h^3 p_phi)_phi + R^2 (h^3 p_z)_z = -12 mu R^2 (w + v z).n,   n = (sin phi, cos phi),
!>    w = velocity + k (e_2, -e_1),   v = slope rate + k (gamma_2, -gamma_1),   k = omega R_J/(2 R).
!> With p = h^(-3/2) y this becomes y_phiphi + R^2 y_zz - V y = -12 mu R^2 h^(-3/2) (w + v z).n and
!>    V = 3/2 (c_m - h)/h + 3/4 (h_phi^2 + R^2 h_z^2)/h^2,
!> whose solution is smooth where the film is thin. Galerkin's method with products of bubble functions of phi and z
!> makes of it A q = N u, u = (w, v): a constant matrix, and V in Gauss's points. Forces and moments on the journal are
!> -R N^T q, so that one factor of A gives them and, with the columns of N as adjoints, their derivatives: these are
!> exactly those of the discrete film.
!>
!> A pressure at the leading edge is that of a uniform film there, in closed form, and what the film makes of it.
!> Where the film's law varies (film_law), y has the same weight, and E and K E stand under the slopes of the functions.
module weighted_film
   use kinds, only: wp, pi
   use film_solver, only: film_law_type
   use film_law, only: law_at_nodes
   use pad_gap, only: pad_gap_type, over_arc
   use clipped_quadrature, only: clipped_weights
   use bubble_functions, only: bubble_type, new_bubbles, bubbles_at, pair_of
   use sloped_gap, only: sloped_motion, sloped_response
   implicit none (type, external)
   private
   public :: weighted_film_type, new_weighted_film

   !> Right-hand sides beside the matrix: the four of forces and moments; the fifth of what w and v do not drive.
   integer, parameter :: sides = 5
   !> Vectors that are solved for together: the film, its four adjoints, filled up to SIMD's width.
   integer, parameter :: lanes = 8
   !> Even intervals of the arc on which Guembel's condition clips a pressure, and Gauss's points of the root of the
   !> distance from either side, as fourier_film has them.
   integer, parameter :: clip_cells = 48, clip_points = 8
   !> Step of derivatives by differences, over the clearance.
   real(wp), parameter :: difference = 1e-6_wp

   !> One pad's film with this number of functions.
   type :: weighted_film_type
      private
      type(pad_gap_type) :: gap
      type(bubble_type) :: x, z
      integer :: unknowns = 0, rows = 0
      real(wp) :: radius = 0, middle = 0, half_arc = 0, half_length = 0
      !> At Gauss's points: sin and cos of the angle from the pivot; z, m; weights, rad m, (along, across).
      real(wp), allocatable :: sine(:), cosine(:), across(:), weight(:, :)
      !> Functions along the arc, (point, function), and (function, point) times sine and cosine.
      real(wp), allocatable :: values(:, :), by_sine(:, :), by_cosine(:, :)
      !> The unknown of a function along and one across: those with the last function stand last. Of an element of the
      !> matrix, below the diagonal, its pairs of functions, and the constant part.
      integer, allocatable :: place(:, :), pairs(:, :, :)
      real(wp), allocatable :: constant(:, :)
      !> Pressure of a uniform film per unit at the leading edge, its slopes and second slope along the arc; its
      !> integrals with sine and cosine, m^2.
      real(wp), allocatable :: lift(:, :, :)
      real(wp) :: lifted(2) = 0
      !> Of the leading edge over the others, Pa; integrals of sine and cosine over the arc.
      real(wp) :: rise = 0, over_arc(2) = 0
      !> Of the last film: thickness, m, and its slopes along the arc, m/rad, and along z, by point along the arc; its
      !> h^(-3/2); y; the factor with N^T L^-T below it, and reciprocal pivots.
      real(wp), allocatable :: h(:, :), steep(:, :), lean(:), root(:, :), y(:, :), factor(:, :), per_pivot(:)
      !> Unknowns of film and adjoints, (lane, unknown).
      real(wp), allocatable :: solution(:, :)
      type(sloped_motion) :: motion
      type(law_at_nodes) :: nodes
      !> Whether there is a fifth side; derivatives of forces and moments over u.
      logical :: has_fifth = .false.
      real(wp) :: over_u(4, 4) = 0
      !> Of pressures that are clipped: sine, cosine and functions, (point, -1:function), and the lift, (point, line);
      !> functions across the width, (function, line), z and width of lines, m; what the direct derivatives lose.
      real(wp), allocatable :: clip_values(:, :), clip_lift(:, :), clip_across(:, :), clip_z(:), clip_width(:)
      real(wp) :: lost(4, 4) = 0
      !> Of a law that varies, (along, across, which): E, K E, V, and what else drives the film.
      real(wp), allocatable :: law(:, :, :)
   contains
      procedure :: is_made
      procedure :: evaluate
      procedure :: pressure_at
   end type weighted_film_type

contains

   !> For the film of a gap with these numbers of functions along the arc and across the width.
   pure type(weighted_film_type) function new_weighted_film(gap, along, across) result(self)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: along, across
      real(wp) :: phi
      integer :: q
      self%gap = gap
      self%x = new_bubbles(along, along + 4)
      self%z = new_bubbles(across, across + 3)
      self%unknowns = along*across
      self%rows = 4*((self%unknowns + sides + 3)/4)
      self%radius = gap%pad_radius()
      self%half_arc = 0.5_wp*gap%arc()
      self%half_length = 0.5_wp*gap%axial_length
      self%middle = 0.5_wp*(gap%leading_angle - gap%trailing_angle)
      associate (m => self%x%points, k => self%z%points, n => self%unknowns)
         allocate (self%sine(m), self%cosine(m), self%weight(m, k), self%values(m, along), self%h(m, k), &
            & self%steep(m, k), self%lean(m), self%root(m, k), self%y(m, k), self%factor(self%rows, n), &
            & self%per_pivot(n), self%solution(lanes, n), self%lift(m, k, 4), self%law(m, k, 4))
         self%across = self%half_length*self%z%place
         self%values = transpose(self%x%value)
         self%by_sine = self%x%value
         self%by_cosine = self%x%value
         do q = 1, m
            phi = self%middle + self%half_arc*self%x%place(q)
            self%sine(q) = sin(phi)
            self%cosine(q) = cos(phi)
            self%weight(q, :) = self%half_arc*self%x%weight(q)*self%half_length*self%z%weight
            self%by_sine(:, q) = self%sine(q)*self%x%value(:, q)
            self%by_cosine(:, q) = self%cosine(q)*self%x%value(:, q)
         end do
      end associate
      self%factor = 0
      self%solution = 0
      self%lift = 0
      self%rise = gap%supply_pressure - gap%ambient_pressure
      self%over_arc = over_arc(gap%directions())
      call set_matrix(self)
      if (abs(self%rise) > 0) call set_lift(self)
   end function new_weighted_film

   !> Whether it has been made.
   pure logical function is_made(self)
      class(weighted_film_type), intent(in) :: self
      is_made = self%unknowns > 0
   end function is_made

   !> The order of unknowns, and the matrix of a uniform film.
   pure subroutine set_matrix(self)
      type(weighted_film_type), intent(inout) :: self
      real(wp), dimension(size(self%x%products, 1)) :: mass_x, slope_x
      real(wp), dimension(size(self%z%products, 1)) :: mass_z, slope_z
      integer :: i, j, order(2, self%unknowns), n, a, b
      n = 0
      allocate (self%place(self%x%n, self%z%n))
      associate (inner => (self%x%n - 1)*(self%z%n - 1))
         a = inner
         do j = 1, self%z%n
            do i = 1, self%x%n
               if (i < self%x%n .and. j < self%z%n) then
                  n = n + 1
                  self%place(i, j) = n
               else
                  a = a + 1
                  self%place(i, j) = a
               end if
               order(:, self%place(i, j)) = [i, j]
            end do
         end do
      end associate
      associate (x => self%x, z => self%z, l => self%half_length, half => self%half_arc)
         mass_x = half*matmul(x%products, x%weight)
         slope_x = matmul(x%slope_products, x%weight)/half
         mass_z = l*matmul(z%products, z%weight)
         slope_z = matmul(z%slope_products, z%weight)/l
      end associate
      allocate (self%pairs(2, self%unknowns, self%unknowns), self%constant(self%unknowns, self%unknowns))
      do b = 1, self%unknowns
         do a = 1, self%unknowns
            self%pairs(:, a, b) = pair_of(order(:, a), order(:, b))
            associate (i => self%pairs(1, a, b), k => self%pairs(2, a, b))
               self%constant(a, b) = slope_x(i)*mass_z(k) + self%radius**2*mass_x(i)*slope_z(k)
            end associate
         end do
      end do
   end subroutine set_matrix

   !> The pressure of a uniform film with 1 at the leading edge and 0 at the others.
   pure subroutine set_lift(self)
      type(weighted_film_type), intent(inout) :: self
      !> Terms of the series of its integral, which fall with the third power.
      integer, parameter :: terms = 400
      real(wp) :: lambda, arc, ends(2, 2), slopes(2)
      integer :: q, r, k
      do r = 1, self%z%points
         do q = 1, self%x%points
            self%lift(q, r, :) = lift_at(self, self%half_arc*(1 - self%x%place(q)), self%across(r))
         end do
      end do
      arc = 2*self%half_arc
      associate (gap => self%gap)
         ! n' at the leading and the trailing edge; by parts, with u'' = lambda^2 u
         ends(:, 1) = [cos(gap%leading_angle), -sin(gap%leading_angle)]
         ends(:, 2) = [sin(gap%leading_angle), cos(gap%leading_angle)]
      end associate
      do k = 1, terms
         lambda = (2*k - 1)*pi*self%radius/(2*self%half_length)
         slopes = lambda/tanh(lambda*arc)
         slopes(2) = 0
         if (lambda*arc < 300) slopes(2) = lambda/sinh(lambda*arc)
         self%lifted = self%lifted + 8*2*self%half_length/((2*k - 1)*pi)**2*(slopes(1)*ends(:, 2) - ends(:, 1) &
            & - slopes(2)*[-sin(self%gap%trailing_angle), cos(self%gap%trailing_angle)])/(1 + lambda**2)
      end do
      self%lifted = self%radius*self%lifted
   end subroutine set_lift

   !> It, its slopes along the arc and along z, and its second slope along the arc, at an angle from the leading edge,
   !> rad, and at z, m: that of a strip, 4/pi Re atan(exp(-zeta)), and its images at both ends of the arc.
   pure function lift_at(self, angle, z) result(lift)
      type(weighted_film_type), intent(in) :: self
      real(wp), intent(in) :: angle, z
      real(wp) :: lift(4), unit, period, sign
      complex(wp) :: zeta
      integer :: image
      unit = pi/(2*self%half_length)
      period = 4*self%radius*self%half_arc*unit
      lift = 0
      do image = 0, ceiling(40/period)
         sign = 1
         zeta = cmplx(self%radius*angle*unit + image*period, z*unit, wp)
         lift = lift + strip(zeta, -self%radius*unit)
         zeta = cmplx((image + 1)*period - self%radius*angle*unit, z*unit, wp)
         lift = lift - strip(zeta, self%radius*unit)
      end do
   contains
      pure function strip(zeta, along)
         complex(wp), intent(in) :: zeta
         real(wp), intent(in) :: along
         real(wp) :: strip(4)
         complex(wp) :: small, first
         small = exp(-zeta)
         first = -4/pi*small/(1 + small**2)
         strip(1) = 4/pi*real(atan(small), wp)
         strip(2) = along*real(first, wp)
         strip(3) = -unit*aimag(first)
         strip(4) = -along**2*real(first*(1 - small**2)/(1 + small**2), wp)
      end function strip
   end function lift_at

   !> The film at a motion that leaves it open, with an oil and a journal speed, rad/s.
   subroutine evaluate(self, motion, oil, speed, clips, want_derivatives, response, last_share)
      class(weighted_film_type), intent(inout) :: self
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      !> Whether what lies below the cavitation pressure is taken out of force and moment (Guembel).
      logical, intent(in) :: clips, want_derivatives
      !> Its least thicknesses are set.
      type(sloped_response), intent(inout) :: response
      !> What the last functions along and across add to the power of the film, over it.
      real(wp), intent(out) :: last_share
      real(wp) :: step, moved(4, 4)
      integer :: k
      if (want_derivatives .and. oil%varies) then
         do k = 1, 4
            step = difference*self%gap%machined_clearance/merge(1.0_wp, self%half_length, k <= 2)
            call solve(self, motion%moved(k, step), oil, speed, clips, .false., response, last_share)
            moved(:, k) = [response%film%force, response%moment]/step
         end do
         call solve(self, motion, oil, speed, clips, .true., response, last_share)
         do k = 1, 4
            step = difference*self%gap%machined_clearance/merge(1.0_wp, self%half_length, k <= 2)
            response%derivatives(:, k) = moved(:, k) - [response%film%force, response%moment]/step
         end do
      else
         call solve(self, motion, oil, speed, clips, want_derivatives, response, last_share)
      end if
   end subroutine evaluate

   !> The same; derivatives over position and slope are those of a law that does not vary.
   subroutine solve(self, motion, oil, speed, clips, want_derivatives, response, last_share)
      class(weighted_film_type), intent(inout) :: self
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: clips, want_derivatives
      type(sloped_response), intent(inout) :: response
      real(wp), intent(out) :: last_share
      real(wp) :: u(4), forces(4), scale, k
      self%motion = motion
      k = speed*self%gap%journal_radius/(2*self%radius)
      scale = 12*oil%viscosity*self%radius**2
      associate (e => motion%middle%position, g => motion%slope)
         u = scale*[motion%middle%velocity + k*[e(2), -e(1)], motion%slope_rate + k*[g(2), -g(1)]]
      end associate
      call set_gap(self%x%points, self%z%points, self%gap%machined_clearance, [motion%middle%position, motion%slope], &
         & self%sine, self%cosine, self%across, self%h, self%steep, self%lean, self%root)
      self%has_fifth = abs(self%rise) > 0 .or. oil%varies
      if (oil%varies) call take_law(self, oil, scale*k)
      call assemble(self, oil%varies)
      call factorise(self%rows, self%unknowns, self%factor, self%per_pivot)
      call take_forces(self, u, forces, last_share)
      call back(self%rows, self%unknowns, self%factor, self%per_pivot, self%solution)
      call spread_out(self, 1, self%y)
      call take_pressures(self, response)
      self%lost = 0
      if (clips .and. response%film%min_pressure < self%gap%cavitation_pressure) then
         call clip(self, want_derivatives, forces, response)
      end if
      forces(:2) = forces(:2) - self%rise*self%lifted - self%gap%ambient_pressure*self%radius*2*self%half_length &
         & *self%over_arc
      response%film%force = forces(:2)
      response%moment = forces(3:)
      if (.not. want_derivatives) return
      response%derivatives(:, 5:) = scale*self%over_u
      associate (d => response%derivatives)
         call slopes_of_forces(self, u, d(:, :4))
         d(:, 1) = d(:, 1) - k*d(:, 6)
         d(:, 2) = d(:, 2) + k*d(:, 5)
         d(:, 3) = d(:, 3) - k*d(:, 8)
         d(:, 4) = d(:, 4) + k*d(:, 7)
      end associate
   end subroutine solve

   !> Thickness, its slopes and h^(-3/2) at points.
   pure subroutine set_gap(m, n, clearance, e, sine, cosine, z, h, steep, lean, root)
      integer, intent(in) :: m, n
      real(wp), intent(in) :: clearance, e(4), sine(m), cosine(m), z(n)
      real(wp), intent(out) :: h(m, n), steep(m, n), lean(m), root(m, n)
      integer :: r
      lean = -(e(3)*sine + e(4)*cosine)
      do r = 1, n
         associate (e1 => e(1) + z(r)*e(3), e2 => e(2) + z(r)*e(4))
            h(:, r) = clearance - e1*sine - e2*cosine
            steep(:, r) = e2*sine - e1*cosine
            root(:, r) = 1/(h(:, r)*sqrt(h(:, r)))
         end associate
      end do
   end subroutine set_gap

   !> What a law that varies makes of the equation at the points; `wedge`: 12 mu R^2 k.
   subroutine take_law(self, oil, wedge)
      class(weighted_film_type), intent(inout) :: self
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: wedge
      real(wp), dimension(self%x%points) :: across, power, s, t
      integer :: r
      do r = 1, self%z%points
         call oil%at_nodes(self%gap, self%motion%at(self%across(r)), self%sine, self%cosine, self%nodes)
         across = 1
         power = 0
         if (oil%turns_with_thickness()) then
            across = self%nodes%across
            power = self%nodes%flow_power(:, 0) + self%nodes%across_power(:, 0)
         end if
         associate (h => self%h(:, r), lift => self%lift(:, r, :), flow => self%nodes%flow_slopes(:, 1), &
            & e => self%law(:, r, 1), ke => self%law(:, r, 2))
            s = self%steep(:, r)/h
            t = self%lean/h
            e = 1/self%nodes%inverse_root**2
            ke = self%radius**2*across*e
            self%law(:, r, 3) = 1.5_wp*(e*((self%gap%machined_clearance - h)/h - s**2 + s*flow) + ke*t**2*(power - 1)) &
               & + 2.25_wp*(e*s**2 + ke*t**2)
            self%law(:, r, 4) = wedge*self%root(:, r)*((self%nodes%sliding - 1)*self%steep(:, r) &
               & + self%nodes%sliding_slopes(:, 1)*h) &
               & + self%rise*h**3*self%root(:, r)*(e*(3*s + flow)*lift(:, 2) + ke*(3 + power)*t*lift(:, 3) &
               & + e*(1 - across)*lift(:, 4))
         end associate
      end do
   end subroutine take_law

   !> Matrix and right-hand sides.
   subroutine assemble(self, varies)
      class(weighted_film_type), intent(inout) :: self
      logical, intent(in) :: varies
      real(wp), dimension(self%x%points, self%z%points) :: potential, drive, fifth
      real(wp) :: sums(size(self%x%products, 1), size(self%z%products, 1)), square
      integer :: a, b, q, r
      square = self%radius**2
      do r = 1, self%z%points
         do q = 1, self%x%points
            associate (h => self%h(q, r), w => self%weight(q, r))
               potential(q, r) = w*(1.5_wp*(self%gap%machined_clearance - h)/h + 0.75_wp*(self%steep(q, r)**2 &
                  & + square*self%lean(q)**2)/h**2)
               drive(q, r) = w*self%root(q, r)
            end associate
         end do
      end do
      if (varies) then
         call add_form(self%x%slope_products, self%law(:, :, 1)*self%weight/self%half_arc**2, self%z%products, .true., sums)
         call add_form(self%x%products, self%law(:, :, 2)*self%weight/self%half_length**2, self%z%slope_products, &
            & .false., sums)
         call add_form(self%x%products, self%law(:, :, 3)*self%weight, self%z%products, .false., sums)
         fifth = self%weight*self%law(:, :, 4)
         do b = 1, self%unknowns
            do a = b, self%unknowns
               self%factor(a, b) = sums(self%pairs(1, a, b), self%pairs(2, a, b))
            end do
         end do
      else
         call add_form(self%x%products, potential, self%z%products, .true., sums)
         call gather(size(sums, 1), size(sums, 2), self%rows, self%unknowns, self%pairs, sums, self%constant, self%factor)
         if (self%has_fifth) then
            do r = 1, self%z%points
               fifth(:, r) = 3*self%rise*drive(:, r)*self%h(:, r)**2*(self%steep(:, r)*self%lift(:, r, 2) &
                  & + square*self%lean*self%lift(:, r, 3))
            end do
         end if
      end if
      call add_sides(self, self%x%points, self%z%points, self%z%value, drive, fifth)
   end subroutine assemble

   !> Adds the integrals of a weight, (along, across), times pairs of functions, to sums, (pair along, pair across).
   pure subroutine add_form(along, weight, across, anew, sums)
      real(wp), intent(in), contiguous :: along(:, :), weight(:, :), across(:, :)
      logical, intent(in) :: anew
      real(wp), intent(inout), contiguous :: sums(:, :)
      call add(size(along, 1), size(along, 2), size(across, 1), size(across, 2), along, weight, across, sums)
   contains
      pure subroutine add(m, points, n, lines, along, weight, across, sums)
         integer, intent(in) :: m, points, n, lines
         real(wp), intent(in) :: along(m, points), weight(points, lines), across(n, lines)
         real(wp), intent(inout) :: sums(m, n)
         real(wp) :: line(m)
         integer :: q, r, k
         if (anew) sums = 0
         do r = 1, lines
            line = 0
            do q = 1, points
               line = line + weight(q, r)*along(:, q)
            end do
            do k = 1, n
               sums(:, k) = sums(:, k) + across(k, r)*line
            end do
         end do
      end subroutine add
   end subroutine add_form

   !> The matrix below its diagonal.
   pure subroutine gather(m, n, rows, unknowns, pairs, sums, constant, matrix)
      integer, intent(in) :: m, n, rows, unknowns, pairs(2, unknowns, unknowns)
      real(wp), intent(in) :: sums(m, n), constant(unknowns, unknowns)
      real(wp), intent(inout) :: matrix(rows, unknowns)
      integer :: a, b
      do b = 1, unknowns
         do a = b, unknowns
            matrix(a, b) = constant(a, b) + sums(pairs(1, a, b), pairs(2, a, b))
         end do
      end do
   end subroutine gather

   !> The right-hand sides N^T, and the fifth, below the matrix, from their weights at the points.
   pure subroutine add_sides(self, m, n, across, drive, fifth)
      class(weighted_film_type), intent(inout) :: self
      integer, intent(in) :: m, n
      real(wp), intent(in) :: across(self%z%n, n), drive(m, n), fifth(m, n)
      real(wp), dimension(m) :: even, odd, other
      real(wp), dimension(self%x%n) :: side_1, side_2, side_3, side_4, side_5
      integer :: i, j, q, r
      do j = 1, self%z%n
         even = 0
         odd = 0
         other = 0
         do r = 1, n
            even = even + across(j, r)*drive(:, r)
            odd = odd + (across(j, r)*self%across(r))*drive(:, r)
            if (self%has_fifth) other = other + across(j, r)*fifth(:, r)
         end do
         side_1 = 0
         side_2 = 0
         side_3 = 0
         side_4 = 0
         side_5 = 0
         do q = 1, m
            side_1 = side_1 + even(q)*self%by_sine(:, q)
            side_2 = side_2 + even(q)*self%by_cosine(:, q)
            side_3 = side_3 + odd(q)*self%by_sine(:, q)
            side_4 = side_4 + odd(q)*self%by_cosine(:, q)
            if (self%has_fifth) side_5 = side_5 + other(q)*self%x%value(:, q)
         end do
         do i = 1, self%x%n
            self%factor(self%unknowns + 1:self%unknowns + sides, self%place(i, j)) = &
               & [side_1(i), side_2(i), side_3(i), side_4(i), side_5(i)]
         end do
      end do
   end subroutine add_sides

   !> Cholesky's factor L of a matrix, and below it the right-hand sides times L^-T.
   pure subroutine factorise(rows, n, a, per_pivot)
      integer, intent(in) :: rows, n
      real(wp), intent(inout) :: a(rows, n)
      real(wp), intent(out) :: per_pivot(n)
      integer :: j, k
      do j = 1, n
         do k = 1, j - 1
            a(j:, j) = a(j:, j) - a(j, k)*a(j:, k)
         end do
         per_pivot(j) = 1/sqrt(a(j, j))
         a(j:, j) = per_pivot(j)*a(j:, j)
      end do
   end subroutine factorise

   !> Makes b = L^-T b, by lane.
   pure subroutine back(rows, n, factor, per_pivot, b)
      integer, intent(in) :: rows, n
      real(wp), intent(in) :: factor(rows, n), per_pivot(n)
      real(wp), intent(inout) :: b(lanes, n)
      real(wp) :: x(lanes)
      integer :: j, k
      do j = n, 1, -1
         x = b(:, j)
         do k = j + 1, n
            x = x - factor(k, j)*b(:, k)
         end do
         b(:, j) = per_pivot(j)*x
      end do
   end subroutine back

   !> Makes b = L^-1 b, by lane.
   pure subroutine forth(rows, n, factor, per_pivot, b)
      integer, intent(in) :: rows, n
      real(wp), intent(in) :: factor(rows, n), per_pivot(n)
      real(wp), intent(inout) :: b(lanes, n)
      integer :: j, k
      do j = 1, n
         b(:, j) = per_pivot(j)*b(:, j)
         do k = j + 1, n
            b(:, k) = b(:, k) - factor(k, j)*b(:, j)
         end do
      end do
   end subroutine forth

   !> Forces and moments of what w and v drive, and of the fifth side; the lanes of film and adjoints; derivatives over
   !> u/(12 mu R^2).
   pure subroutine take_forces(self, u, forces, last_share)
      class(weighted_film_type), intent(inout) :: self
      real(wp), intent(in) :: u(4)
      real(wp), intent(out) :: forces(4), last_share
      real(wp) :: power, inner
      integer :: k
      associate (n => self%unknowns, x => self%solution)
         do k = 1, n
            associate (side => self%factor(n + 1:n + sides, k))
               x(2:sides, k) = side(:4)
               x(1, k) = dot_product(u, side(:4))
               if (self%has_fifth) x(1, k) = x(1, k) + side(5)
            end associate
         end do
         forces = -self%radius*matmul(x(2:sides, :), x(1, :))
         self%over_u = -self%radius*matmul(x(2:sides, :), transpose(x(2:sides, :)))
         power = sum(x(1, :)**2)
         inner = sum(x(1, :(self%x%n - 1)*(self%z%n - 1))**2)
         last_share = 0
         if (power > 0) last_share = (power - inner)/power
      end associate
   end subroutine take_forces

   !> y of a lane at the points.
   pure subroutine spread_out(self, lane, y)
      class(weighted_film_type), intent(in) :: self
      integer, intent(in) :: lane
      real(wp), intent(out) :: y(:, :)
      real(wp) :: line(self%x%points)
      integer :: i, j, r
      y = 0
      do j = 1, self%z%n
         line = 0
         do i = 1, self%x%n
            line = line + self%solution(lane, self%place(i, j))*self%values(:, i)
         end do
         do r = 1, self%z%points
            y(:, r) = y(:, r) + self%z%value(j, r)*line
         end do
      end do
   end subroutine spread_out

   !> Derivatives of forces and moments over position and slope but for what u makes, from film and adjoints.
   subroutine slopes_of_forces(self, u, slopes)
      class(weighted_film_type), intent(in) :: self
      real(wp), intent(in) :: u(4)
      real(wp), intent(out) :: slopes(4, 4)
      !> What multiplies an adjoint in the derivatives over h, h_phi and h_z; what does so without an adjoint.
      real(wp), dimension(self%x%points, self%z%points) :: by_h, by_steep, by_lean, direct, y
      real(wp), dimension(self%x%points) :: over_h, over_h_z, over_steep, over_steep_z, over_lean
      real(wp) :: square
      integer :: q, r, a
      square = self%radius**2
      do r = 1, self%z%points
         do q = 1, self%x%points
            associate (h => self%h(q, r), w => self%weight(q, r), y => self%y(q, r), root => self%root(q, r), &
               & steep => self%steep(q, r), lean => self%lean(q), s => self%sine(q), c => self%cosine(q), &
               & z => self%across(r))
               direct(q, r) = -1.5_wp*w*root/h
               by_h(q, r) = direct(q, r)*(u(1)*s + u(2)*c + z*(u(3)*s + u(4)*c)) + 1.5_wp*w*y/h**2 &
                  & *(self%gap%machined_clearance + (steep**2 + square*lean**2)/h)
               by_steep(q, r) = -1.5_wp*w*steep/h**2*y
               by_lean(q, r) = -1.5_wp*w*square*lean/h**2*y
               direct(q, r) = direct(q, r)*y
            end associate
         end do
      end do
      if (abs(self%rise) > 0) call add_lift(self, by_h, by_steep, by_lean)
      do a = 1, 4
         call spread_out(self, a + 1, y)
         over_h = 0
         over_h_z = 0
         over_steep = 0
         over_steep_z = 0
         over_lean = 0
         do r = 1, self%z%points
            associate (z => self%across(r))
               over_h = over_h + by_h(:, r)*y(:, r)
               over_h_z = over_h_z + z*by_h(:, r)*y(:, r)
               over_steep = over_steep + by_steep(:, r)*y(:, r)
               over_steep_z = over_steep_z + z*by_steep(:, r)*y(:, r)
               over_lean = over_lean + by_lean(:, r)*y(:, r)
            end associate
         end do
         associate (s => self%sine, c => self%cosine)
            slopes(a, 1) = dot_product(s, over_h) + dot_product(c, over_steep)
            slopes(a, 2) = dot_product(c, over_h) - dot_product(s, over_steep)
            slopes(a, 3) = dot_product(s, over_h_z + over_lean) + dot_product(c, over_steep_z)
            slopes(a, 4) = dot_product(c, over_h_z + over_lean) - dot_product(s, over_steep_z)
         end associate
      end do
      slopes = self%radius*(slopes + moments_of(self, direct) - self%lost)
   end subroutine slopes_of_forces

   !> Sums over the points of a weight times m m^T, m = (n, z n).
   pure function moments_of(self, weight) result(sums)
      class(weighted_film_type), intent(in) :: self
      real(wp), intent(in) :: weight(:, :)
      real(wp) :: sums(4, 4), line(self%x%points), block(2, 2)
      integer :: k
      do k = 0, 2
         line = matmul(weight, self%across**k)
         block(1, 1) = dot_product(line, self%sine**2)
         block(1, 2) = dot_product(line, self%sine*self%cosine)
         block(2, 2) = dot_product(line, self%cosine**2)
         block(2, 1) = block(1, 2)
         if (k == 0) sums(:2, :2) = block
         if (k == 1) sums(:2, 3:) = block
         if (k == 1) sums(3:, :2) = block
         if (k == 2) sums(3:, 3:) = block
      end do
   end function moments_of

   !> What a pressure at the leading edge adds to what multiplies adjoints.
   pure subroutine add_lift(self, by_h, by_steep, by_lean)
      class(weighted_film_type), intent(in) :: self
      real(wp), intent(inout), dimension(:, :) :: by_h, by_steep, by_lean
      real(wp) :: drive(self%x%points), square
      integer :: r
      square = self%radius**2
      do r = 1, self%z%points
         associate (h => self%h(:, r), lift => self%lift(:, r, :))
            drive = self%rise*self%weight(:, r)*self%root(:, r)*h
            by_h(:, r) = by_h(:, r) + 1.5_wp*drive*(self%steep(:, r)*lift(:, 2) + square*self%lean*lift(:, 3))
            by_steep(:, r) = by_steep(:, r) + 3*drive*h*lift(:, 2)
            by_lean(:, r) = by_lean(:, r) + 3*drive*h*square*lift(:, 3)
         end associate
      end do
   end subroutine add_lift

   !> Least and highest pressure, and where the highest is: from the highest point by Newton's method for the logarithm
   !> of what w and v drive.
   pure subroutine take_pressures(self, response)
      class(weighted_film_type), intent(in) :: self
      type(sloped_response), intent(inout) :: response
      real(wp), dimension(self%x%points, self%z%points) :: p
      integer :: at(2)
      p = self%root*self%y
      if (abs(self%rise) > 0) p = p + self%rise*self%lift(:, :, 1)
      at = maxloc(p)
      associate (film => response%film, gap => self%gap)
         film%min_pressure = min(minval(p) + gap%ambient_pressure, gap%ambient_pressure, gap%supply_pressure)
         film%max_pressure = max(p(at(1), at(2)) + gap%ambient_pressure, gap%ambient_pressure, gap%supply_pressure)
         response%place = [self%x%place(at(1)), self%z%place(at(2))]
         if (self%y(at(1), at(2)) > 0) call climb(self, response%place, film%max_pressure)
         response%place = [self%middle + self%half_arc*response%place(1), self%half_length*response%place(2)]
      end associate
   end subroutine take_pressures

   !> A higher place than this one, on (-1, 1) each, and its pressure.
   pure subroutine climb(self, place, highest)
      class(weighted_film_type), intent(in) :: self
      real(wp), intent(inout) :: place(2), highest
      integer, parameter :: rounds = 3
      real(wp) :: y(0:2, 0:2), h, h_x, h_z, h_xx, h_xz, first(2), second(2, 2), step(2), new(2), p
      integer :: round
      new = place
      do round = 0, rounds
         call jet(self, new, y, h, h_x, h_z, h_xx, h_xz)
         if (.not. y(0, 0) > 0) return
         p = y(0, 0)/(h*sqrt(h)) + self%gap%ambient_pressure
         if (abs(self%rise) > 0) p = p + self%rise*only_value(lift_at(self, self%half_arc*(1 - new(1)), &
            & self%half_length*new(2)))
         if (p > highest) then
            highest = p
            place = new
         end if
         if (round == rounds) return
         first = [y(1, 0), y(0, 1)]/y(0, 0) - 1.5_wp*[h_x, h_z]/h
         second(1, 1) = y(2, 0)/y(0, 0) - (y(1, 0)/y(0, 0))**2 - 1.5_wp*(h_xx/h - (h_x/h)**2)
         second(2, 2) = y(0, 2)/y(0, 0) - (y(0, 1)/y(0, 0))**2 + 1.5_wp*(h_z/h)**2
         second(1, 2) = y(1, 1)/y(0, 0) - y(1, 0)*y(0, 1)/y(0, 0)**2 - 1.5_wp*(h_xz/h - h_x*h_z/h**2)
         associate (determinant => second(1, 1)*second(2, 2) - second(1, 2)**2)
            if (.not. (determinant > 0 .and. second(1, 1) < 0)) return
            step = -[second(2, 2)*first(1) - second(1, 2)*first(2), second(1, 1)*first(2) - second(1, 2)*first(1)] &
               & /determinant
         end associate
         new = min(max(new + step, -0.999_wp), 0.999_wp)
      end do
   contains
      pure real(wp) function only_value(lift)
         real(wp), intent(in) :: lift(4)
         only_value = lift(1)
      end function only_value
   end subroutine climb

   !> y with its derivatives, (order along, order across), and h with its own, at a place on (-1, 1) each.
   pure subroutine jet(self, place, y, h, h_x, h_z, h_xx, h_xz)
      class(weighted_film_type), intent(in) :: self
      real(wp), intent(in) :: place(2)
      real(wp), intent(out) :: y(0:2, 0:2), h, h_x, h_z, h_xx, h_xz
      real(wp) :: along(self%x%n, 0:2), across(self%z%n, 0:2), q(self%x%n, self%z%n), s, c
      integer :: i, j
      call bubbles_at(self%x%n, place(1), along(:, 0), along(:, 1), along(:, 2))
      call bubbles_at(self%z%n, place(2), across(:, 0), across(:, 1), across(:, 2))
      do j = 1, self%z%n
         do i = 1, self%x%n
            q(i, j) = self%solution(1, self%place(i, j))
         end do
      end do
      y = matmul(transpose(along), matmul(q, across))
      s = sin(self%middle + self%half_arc*place(1))
      c = cos(self%middle + self%half_arc*place(1))
      associate (a => self%half_arc, l => self%half_length, g => self%motion%slope, &
         & e => self%motion%middle%position + self%half_length*place(2)*self%motion%slope)
         h = self%gap%machined_clearance - e(1)*s - e(2)*c
         h_x = a*(e(2)*s - e(1)*c)
         h_z = -l*(g(1)*s + g(2)*c)
         h_xx = a**2*(self%gap%machined_clearance - h)
         h_xz = a*l*(g(2)*s - g(1)*c)
      end associate
   end subroutine jet

   !> Takes what lies below the cavitation pressure out of the forces and, where derivatives are wanted, its share out
   !> of the adjoints and of the derivatives over u.
   subroutine clip(self, want_derivatives, forces, response)
      class(weighted_film_type), intent(inout) :: self
      logical, intent(in) :: want_derivatives
      real(wp), intent(inout) :: forces(4)
      type(sloped_response), intent(inout) :: response
      real(wp) :: shares(lanes, self%unknowns), film(self%unknowns), n(2), h, m(4)
      real(wp), dimension(0:clip_cells) :: line, deficit, lost, thickness, sine, cosine
      integer :: a, i, j, k, r
      response%film%max_pressure = max(response%film%max_pressure, self%gap%cavitation_pressure)
      if (.not. allocated(self%clip_values)) call set_clip(self)
      sine = self%clip_values(:, -1)
      cosine = self%clip_values(:, 0)
      shares = 0
      self%lost = 0
      do r = 1, 2*clip_points
         line = 0
         do j = 1, self%z%n
            do i = 1, self%x%n
               line = line + (self%clip_across(j, r)*self%solution(1, self%place(i, j)))*self%clip_values(:, i)
            end do
         end do
         associate (e => self%motion%middle%position + self%clip_z(r)*self%motion%slope)
            thickness = self%gap%machined_clearance - e(1)*sine - e(2)*cosine
         end associate
         deficit = self%gap%cavitation_pressure - self%gap%ambient_pressure - self%rise*self%clip_lift(:, r) &
            & - line/(thickness*sqrt(thickness))
         call clipped_weights(clip_cells, deficit, lost)
         lost = lost*(2*self%half_arc/clip_cells*self%clip_width(r))
         do k = 0, clip_cells
            if (.not. abs(lost(k)) > 0) cycle
            n = [sine(k), cosine(k)]
            m = [n, self%clip_z(r)*n]
            h = thickness(k)
            forces = forces - self%radius*lost(k)*deficit(k)*m
            if (.not. want_derivatives) cycle
            do a = 1, 4
               self%lost(:, a) = self%lost(:, a) - (1.5_wp*lost(k)*line(k)/(h**2*sqrt(h))*m(a))*m
            end do
            do j = 1, self%z%n
               do i = 1, self%x%n
                  shares(:4, self%place(i, j)) = shares(:4, self%place(i, j)) + (lost(k)/(h*sqrt(h)) &
                     & *self%clip_values(k, i)*self%clip_across(j, r))*m
               end do
            end do
         end do
      end do
      if (.not. want_derivatives) return
      film = self%solution(1, :)
      call forth(self%rows, self%unknowns, self%factor, self%per_pivot, shares)
      associate (sides => self%factor(self%unknowns + 1:self%unknowns + 4, :))
         self%solution(2:5, :) = sides - shares(:4, :)
         self%over_u = -self%radius*matmul(self%solution(2:5, :), transpose(sides))
      end associate
      call back(self%rows, self%unknowns, self%factor, self%per_pivot, self%solution)
      self%solution(1, :) = film
   end subroutine clip

   !> What `clip` needs of the points along the arc and of the lines.
   pure subroutine set_clip(self)
      class(weighted_film_type), intent(inout) :: self
      real(wp), dimension(self%x%n) :: value, slope, second
      real(wp), dimension(self%z%n) :: slope_z, second_z
      type(bubble_type) :: root
      real(wp) :: x, lift(4)
      integer :: k, r, side
      associate (lines => 2*clip_points)
         allocate (self%clip_values(0:clip_cells, -1:self%x%n), self%clip_lift(0:clip_cells, lines), &
            & self%clip_across(self%z%n, lines), self%clip_z(lines), self%clip_width(lines))
      end associate
      root = new_bubbles(1, clip_points)
      do r = 1, clip_points
         do side = 0, 1
            associate (s => 0.5_wp*(1 + root%place(r)), line => 2*r - side)
               self%clip_z(line) = self%half_length*(1 - s**2)*(1 - 2*side)
               self%clip_width(line) = self%half_length*s*root%weight(r)
               call bubbles_at(self%z%n, self%clip_z(line)/self%half_length, self%clip_across(:, line), slope_z, second_z)
            end associate
         end do
      end do
      do k = 0, clip_cells
         x = -1 + 2*k/real(clip_cells, wp)
         call bubbles_at(self%x%n, x, value, slope, second)
         associate (phi => self%middle + self%half_arc*x)
            self%clip_values(k, :) = [sin(phi), cos(phi), value]
         end associate
         do r = 1, 2*clip_points
            lift = 0
            if (abs(self%rise) > 0) lift = lift_at(self, self%half_arc*(1 - x), self%clip_z(r))
            self%clip_lift(k, r) = lift(1)
         end do
      end do
   end subroutine set_clip

   !> Pressure of the last film, Pa, at an angle from the pivot, rad, and at z, m, on the pad.
   pure real(wp) function pressure_at(self, phi, z) result(p)
      class(weighted_film_type), intent(in) :: self
      real(wp), intent(in) :: phi, z
      real(wp) :: y(0:2, 0:2), h, slopes(4), lift(4)
      call jet(self, [(phi - self%middle)/self%half_arc, z/self%half_length], y, h, slopes(1), slopes(2), slopes(3), &
         & slopes(4))
      p = self%gap%ambient_pressure + y(0, 0)/(h*sqrt(h))
      if (.not. abs(self%rise) > 0) return
      lift = lift_at(self, self%gap%leading_angle - phi, z)
      p = p + self%rise*lift(1)
   end function pressure_at
end module weighted_film
