!> A full film with slopes of oil of one viscosity between equal pressures, by weighted functions
!> (docs/theory/pitch_and_yaw.md).
!>
!> With phi along the arc and R the pad's radius the pressure above that of the edges obeys
!>    (h^3 p_phi)_phi + R^2 (h^3 p_z)_z = -12 mu R^2 (w + v z).n,   n = (sin phi, cos phi),
!>    w = velocity + k (e_2, -e_1),   v = slope rate + k (gamma_2, -gamma_1),   k = omega R_J/(2 R).
!> With p = h^(-3/2) y this becomes y_phiphi + R^2 y_zz - V y = -12 mu R^2 h^(-3/2) (w + v z).n and
!>    V = 3/2 (c_m - h)/h + 3/4 (h_phi^2 + R^2 h_z^2)/h^2,
!> whose solution is smooth where the film is thin. Galerkin's method with products of bubble functions of phi and z
!> makes of it A q = N u, u = 12 mu R^2 (w, v): a constant matrix, and V in Gauss's points. Forces and moments on the
!> journal are -R N^T q, so that one factor of A gives them and, with the columns of N as adjoints, their derivatives:
!> exactly those of the discrete film.
module weighted_film
   use kinds, only: wp
   use pad_gap, only: pad_gap_type, over_arc
   use bubble_functions, only: bubble_type, new_bubbles, bubbles_at, pair_of
   use sloped_gap, only: sloped_motion, sloped_response, driving_velocity, add_rotation, find_highest
   implicit none (type, external)
   private
   public :: weighted_film_type, new_weighted_film

   !> Forces and moments; vectors that are solved for together: the film, an adjoint for each of these, and others to
   !> fill SIMD's width.
   integer, parameter :: forces = 4, vectors = 8, width = 4

   !> One pad's film with a number of functions.
   type :: weighted_film_type
      private
      type(pad_gap_type) :: gap
      !> Functions along the arc and across the width; products of two of the latter count with those of the former.
      type(bubble_type) :: x, z
      !> 0 before it is made.
      integer, public :: unknowns = 0
      integer :: rows = 0
      real(wp) :: radius = 0, middle = 0, half_arc = 0, half_length = 0
      !> Integral of the pressure at the edges with sine and cosine, N/m.
      real(wp) :: around(2) = 0
      !> At Gauss's points: sin and cos of the angle from the pivot; z, m; weights, rad m, (along, across).
      real(wp), allocatable :: sine(:), cosine(:), across(:), weight(:, :)
      !> Functions along the arc times sine, then times cosine, (function, point).
      real(wp), allocatable :: outward(:, :)
      !> The unknown of a function along and one across: those with a last function stand last.
      integer, allocatable :: place(:, :)
      !> Of an element of the matrix, below the diagonal, its pairs of functions, and its part without V.
      integer, allocatable :: pairs(:, :)
      real(wp), allocatable :: constant(:, :)
      !> Of the last film: thickness, m, its slopes along the arc, m/rad, and along z, and h^(-3/2); y and adjoints,
      !> (along, across, vector); the factor with N^T L^-T below it, and reciprocal pivots; unknowns by vector.
      real(wp), allocatable :: h(:, :), steep(:, :), lean(:), root(:, :), y(:, :, :), factor(:, :), per_pivot(:), &
         & solution(:, :)
   contains
      procedure :: evaluate
      procedure :: pressure_at
   end type weighted_film_type

contains

   !> For the film of a gap with these numbers of functions along the arc and across the width.
   pure type(weighted_film_type) function new_weighted_film(gap, along, across) result(self)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: along, across
      self%gap = gap
      self%x = new_bubbles(along, along + 4)
      self%z = new_bubbles(across, across + 3)
      self%unknowns = along*across
      self%rows = width*((self%unknowns + forces + width - 1)/width)
      self%radius = gap%pad_radius()
      self%around = gap%ambient_pressure*gap%axial_length*over_arc(gap%directions())
      self%half_arc = 0.5_wp*gap%arc()
      self%half_length = 0.5_wp*gap%axial_length
      self%middle = 0.5_wp*(gap%leading_angle - gap%trailing_angle)
      self%sine = sin(self%middle + self%half_arc*self%x%place)
      self%cosine = cos(self%middle + self%half_arc*self%x%place)
      self%across = self%half_length*self%z%place
      associate (m => self%x%points, k => self%z%points, n => self%unknowns)
         self%weight = self%half_arc*self%half_length*spread(self%x%weight, 2, k)*spread(self%z%weight, 1, m)
         allocate (self%h(m, k), self%steep(m, k), self%lean(m), self%root(m, k), self%y(m, k, vectors), &
            & self%factor(self%rows, n), self%per_pivot(n), self%solution(vectors, n), self%outward(2*along, m), &
            & source=0.0_wp)
         self%outward(:along, :) = self%x%value*spread(self%sine, 1, along)
         self%outward(along + 1:, :) = self%x%value*spread(self%cosine, 1, along)
      end associate
      call set_matrix(self)
   end function new_weighted_film

   !> The order of unknowns, and the matrix of a uniform film.
   pure subroutine set_matrix(self)
      type(weighted_film_type), intent(inout) :: self
      real(wp), dimension(size(self%x%products, 1)) :: mass_x, slope_x
      real(wp), dimension(size(self%z%products, 1)) :: mass_z, slope_z
      integer :: order(2, self%unknowns), i, j, a, b, n
      logical :: last
      n = 0
      allocate (self%place(self%x%n, self%z%n))
      do a = 0, 1
         do j = 1, self%z%n
            do i = 1, self%x%n
               last = i == self%x%n .or. j == self%z%n
               if (last .neqv. a == 1) cycle
               n = n + 1
               self%place(i, j) = n
               order(:, n) = [i, j]
            end do
         end do
      end do
      mass_x = self%half_arc*matmul(self%x%products, self%x%weight)
      slope_x = matmul(self%x%slope_products, self%x%weight)/self%half_arc
      mass_z = self%half_length*matmul(self%z%products, self%z%weight)
      slope_z = matmul(self%z%slope_products, self%z%weight)/self%half_length
      allocate (self%pairs(n, n), self%constant(n, n))
      do b = 1, n
         do a = 1, n
            associate (i => pair_of(order(1, a), order(1, b)), k => pair_of(order(2, a), order(2, b)))
               self%pairs(a, b) = i + size(mass_x)*(k - 1)
               self%constant(a, b) = slope_x(i)*mass_z(k) + self%radius**2*mass_x(i)*slope_z(k)
            end associate
         end do
      end do
   end subroutine set_matrix

   !> The film at a motion that leaves it open, with oil of a viscosity, Pa s, and a journal speed, rad/s.
   pure subroutine evaluate(self, motion, viscosity, speed, want_derivatives, response, last_share)
      class(weighted_film_type), intent(inout) :: self
      type(sloped_motion), intent(in) :: motion
      real(wp), intent(in) :: viscosity, speed
      logical, intent(in) :: want_derivatives
      !> Its least thicknesses are set.
      type(sloped_response), intent(inout) :: response
      !> What the last functions along and across add to the power of the film, over it.
      real(wp), intent(out) :: last_share
      real(wp) :: u(forces), scale, over_u(forces, forces), pushed(forces), inner, power
      real(wp) :: potential(self%x%points, self%z%points), drive(self%x%points, 2, self%z%points), &
         & sums(size(self%x%products, 1), size(self%z%products, 1))
      integer :: a
      associate (n => self%unknowns, m => self%x%points, k => self%z%points, x => self%solution, &
         & sides => self%factor(self%unknowns + 1:self%unknowns + forces, :))
         scale = 12*viscosity*self%radius**2
         u = scale*driving_velocity(self%gap, motion, speed)
         call set_gap(m, k, self%gap%machined_clearance, self%radius**2, [motion%middle%position, motion%slope], &
            & self%sine, self%cosine, self%across, self%weight, self%h, self%steep, self%lean, self%root, potential, &
            & drive)
         call integrate(size(sums, 1), m, size(sums, 2), k, self%x%products, potential, self%z%products, sums)
         call assemble(self%rows, n, m, k, self%x%n, self%z%n, self%place, self%pairs, sums, self%constant, &
            & self%outward, self%z%value, drive, self%factor)
         call factorise(self%rows, n, self%factor, self%per_pivot)
         inner = 0
         power = 0
         pushed = [self%around, 0.0_wp, 0.0_wp]
         do a = 1, n
            if (a == (self%x%n - 1)*(self%z%n - 1) + 1) inner = power
            x(2:forces + 1, a) = sides(:, a)
            x(1, a) = u(1)*sides(1, a) + u(2)*sides(2, a) + u(3)*sides(3, a) + u(4)*sides(4, a)
            pushed = pushed + x(1, a)*sides(:, a)
            power = power + x(1, a)**2
         end do
         response%film%force = -self%radius*pushed(:2)
         response%moment = -self%radius*pushed(3:)
         last_share = 0
         if (power > 0) last_share = (power - inner)/power
         if (want_derivatives) over_u = -self%radius*scale*matmul(sides, transpose(sides))
         call back(self%rows, n, self%factor, self%per_pivot, x)
         do a = 1, merge(forces + 1, 1, want_derivatives)
            call spread_out(n, m, k, self%x%n, self%z%n, a, self%place, x, self%x%by_point, self%z%value, &
               & self%y(:, :, a))
         end do
         call take_pressures(self, motion, response)
         if (.not. want_derivatives) return
         response%derivatives(:, 5:) = over_u
         call slopes_of_forces(self, u, response%derivatives(:, :4))
         call add_rotation(self%gap, speed, response%derivatives)
      end associate
   end subroutine evaluate

   !> Thickness, its slopes and h^(-3/2) at points, and what stands under pairs of functions and in N without n.
   pure subroutine set_gap(m, n, clearance, square, e, sine, cosine, z, weight, h, steep, lean, root, potential, drive)
      integer, intent(in) :: m, n
      real(wp), intent(in) :: clearance, square, e(4), sine(m), cosine(m), z(n), weight(m, n)
      real(wp), intent(out) :: lean(m), drive(m, 2, n)
      real(wp), intent(out), dimension(m, n) :: h, steep, root, potential
      real(wp) :: e1, e2, per_h
      integer :: q, r
      lean = -(e(3)*sine + e(4)*cosine)
      do r = 1, n
         e1 = e(1) + z(r)*e(3)
         e2 = e(2) + z(r)*e(4)
         !$omp simd private(per_h)
         do q = 1, m
            h(q, r) = clearance - e1*sine(q) - e2*cosine(q)
            steep(q, r) = e2*sine(q) - e1*cosine(q)
            per_h = 1/h(q, r)
            root(q, r) = per_h*sqrt(per_h)
            potential(q, r) = weight(q, r)*(1.5_wp*(clearance*per_h - 1) + 0.75_wp*(steep(q, r)**2 &
               & + square*lean(q)**2)*per_h**2)
            drive(q, 1, r) = weight(q, r)*root(q, r)
            drive(q, 2, r) = z(r)*drive(q, 1, r)
         end do
      end do
   end subroutine set_gap

   !> Integrals of a weight times pairs of functions, (pair along, pair across), from both at points.
   pure subroutine integrate(pairs, m, pairs_across, n, along, weight, across, sums)
      integer, intent(in) :: pairs, m, pairs_across, n
      real(wp), intent(in) :: along(pairs, m), weight(m, n), across(pairs_across, n)
      real(wp), intent(out) :: sums(pairs, pairs_across)
      real(wp) :: line(pairs)
      integer :: j, q, r
      sums = 0
      do r = 1, n
         line = 0
         do q = 1, m
            line = line + weight(q, r)*along(:, q)
         end do
         do j = 1, pairs_across
            sums(:, j) = sums(:, j) + across(j, r)*line
         end do
      end do
   end subroutine integrate

   !> The matrix below its diagonal, and N^T below that, with `drive` as it stands in N, without and with z.
   pure subroutine assemble(rows, unknowns, m, n, along, across, place, pairs, sums, constant, outward, value_z, &
      & drive, a)
      integer, intent(in) :: rows, unknowns, m, n, along, across, place(along, across), pairs(unknowns, unknowns)
      real(wp), intent(in) :: sums(*), constant(unknowns, unknowns), outward(2*along, m), value_z(across, n), &
         & drive(m, 2, n)
      real(wp), intent(inout) :: a(rows, unknowns)
      real(wp) :: line(m, 2), sides(2*along, 2)
      integer :: i, j, q, r
      do j = 1, unknowns
         do i = first_row(j), unknowns
            a(i, j) = constant(i, j) + sums(pairs(i, j))
         end do
      end do
      do j = 1, across
         line = 0
         do r = 1, n
            line = line + value_z(j, r)*drive(:, :, r)
         end do
         sides = 0
         do q = 1, m
            !$omp simd
            do i = 1, 2*along
               sides(i, 1) = sides(i, 1) + line(q, 1)*outward(i, q)
               sides(i, 2) = sides(i, 2) + line(q, 2)*outward(i, q)
            end do
         end do
         do i = 1, along
            a(unknowns + 1:unknowns + forces, place(i, j)) = [sides([i, along + i], 1), sides([i, along + i], 2)]
         end do
      end do
   end subroutine assemble

   !> Cholesky's factor L of a matrix, and below it the right-hand sides times L^-T. Rows are a multiple of SIMD's
   !> width, and columns begin at one, above the diagonal, with what nothing uses.
   pure subroutine factorise(rows, n, a, per_pivot)
      integer, intent(in) :: rows, n
      real(wp), intent(inout) :: a(rows, n)
      real(wp), intent(out) :: per_pivot(n)
      integer :: i, j, k
      do j = 1, n
         do k = 1, j - 1, 2
            if (k == j - 1) then
               !$omp simd
               do i = first_row(j), rows
                  a(i, j) = a(i, j) - a(j, k)*a(i, k)
               end do
            else
               associate (one => a(j, k), two => a(j, k + 1))
                  !$omp simd
                  do i = first_row(j), rows
                     a(i, j) = a(i, j) - one*a(i, k) - two*a(i, k + 1)
                  end do
               end associate
            end if
         end do
         per_pivot(j) = 1/sqrt(a(j, j))
         !$omp simd
         do i = first_row(j), rows
            a(i, j) = per_pivot(j)*a(i, j)
         end do
      end do
   end subroutine factorise

   pure integer function first_row(j)
      integer, intent(in) :: j
      first_row = width*((j - 1)/width) + 1
   end function first_row

   !> Makes b = L^-T b, by vector.
   pure subroutine back(rows, n, factor, per_pivot, b)
      integer, intent(in) :: rows, n
      real(wp), intent(in) :: factor(rows, n), per_pivot(n)
      real(wp), intent(inout) :: b(vectors, n)
      real(wp) :: x(vectors)
      integer :: j, k, l
      do j = n, 1, -1
         x = b(:, j)
         do k = j + 1, n
            !$omp simd
            do l = 1, vectors
               x(l) = x(l) - factor(k, j)*b(l, k)
            end do
         end do
         b(:, j) = per_pivot(j)*x
      end do
   end subroutine back

   !> y at the points from the unknowns of a vector.
   pure subroutine spread_out(unknowns, m, n, along, across, vector, place, solution, value_x, value_z, y)
      integer, intent(in) :: unknowns, m, n, along, across, vector, place(along, across)
      real(wp), intent(in) :: solution(vectors, unknowns), value_x(m, along), value_z(across, n)
      real(wp), intent(out) :: y(m, n)
      real(wp) :: line(m)
      integer :: i, j, r
      y = 0
      do j = 1, across
         line = 0
         do i = 1, along
            line = line + solution(vector, place(i, j))*value_x(:, i)
         end do
         do r = 1, n
            y(:, r) = y(:, r) + value_z(j, r)*line
         end do
      end do
   end subroutine spread_out

   !> Derivatives of forces and moments over position and slope but for what u makes, from film and adjoints.
   pure subroutine slopes_of_forces(self, u, slopes)
      class(weighted_film_type), intent(in) :: self
      real(wp), intent(in) :: u(forces)
      real(wp), intent(out) :: slopes(forces, 4)
      !> What multiplies an adjoint in the derivatives over h, h_phi and h_z; what stands there without one.
      real(wp), dimension(self%x%points) :: by_h, by_steep, by_lean, direct
      !> Of each force over h, h_phi and h_z, by point along the arc, summed over z, and the first two times z.
      real(wp), dimension(self%x%points, forces, 2) :: over_h, over_steep
      real(wp) :: over_lean(self%x%points, forces), square
      integer :: r, a
      square = self%radius**2
      over_h = 0
      over_steep = 0
      over_lean = 0
      do r = 1, self%z%points
         associate (h => self%h(:, r), w => self%weight(:, r), y => self%y(:, r, :), steep => self%steep(:, r), &
            & lean => self%lean, s => self%sine, c => self%cosine, z => self%across(r))
            direct = -1.5_wp*w*self%root(:, r)/h
            by_steep = -1.5_wp*w*y(:, 1)/h**2
            by_h = direct*((u(1) + z*u(3))*s + (u(2) + z*u(4))*c) - by_steep*(self%gap%machined_clearance &
               & + (steep**2 + square*lean**2)/h)
            by_lean = square*lean*by_steep
            by_steep = steep*by_steep
            direct = direct*y(:, 1)
            do a = 1, forces
               over_h(:, a, 1) = over_h(:, a, 1) + by_h*y(:, a + 1)
               over_h(:, a, 2) = over_h(:, a, 2) + z*by_h*y(:, a + 1)
               over_steep(:, a, 1) = over_steep(:, a, 1) + by_steep*y(:, a + 1)
               over_steep(:, a, 2) = over_steep(:, a, 2) + z*by_steep*y(:, a + 1)
               over_lean(:, a) = over_lean(:, a) + by_lean*y(:, a + 1)
            end do
            over_h(:, 1, 1) = over_h(:, 1, 1) + direct*s
            over_h(:, 2, 1) = over_h(:, 2, 1) + direct*c
            over_h(:, 3, 1) = over_h(:, 3, 1) + z*direct*s
            over_h(:, 4, 1) = over_h(:, 4, 1) + z*direct*c
            over_h(:, 1, 2) = over_h(:, 1, 2) + z*direct*s
            over_h(:, 2, 2) = over_h(:, 2, 2) + z*direct*c
            over_h(:, 3, 2) = over_h(:, 3, 2) + z**2*direct*s
            over_h(:, 4, 2) = over_h(:, 4, 2) + z**2*direct*c
         end associate
      end do
      associate (s => self%radius*self%sine, c => self%radius*self%cosine)
         slopes(:, 1) = matmul(s, over_h(:, :, 1)) + matmul(c, over_steep(:, :, 1))
         slopes(:, 2) = matmul(c, over_h(:, :, 1)) - matmul(s, over_steep(:, :, 1))
         slopes(:, 3) = matmul(s, over_h(:, :, 2) + over_lean) + matmul(c, over_steep(:, :, 2))
         slopes(:, 4) = matmul(c, over_h(:, :, 2) + over_lean) - matmul(s, over_steep(:, :, 2))
      end associate
   end subroutine slopes_of_forces

   !> Least and highest pressure, and where the highest is; the pressure at the edges counts in the force.
   pure subroutine take_pressures(self, motion, response)
      class(weighted_film_type), intent(in) :: self
      type(sloped_motion), intent(in) :: motion
      type(sloped_response), intent(inout) :: response
      real(wp) :: p(0:self%x%points + 1, 0:self%z%points + 1), phi(0:self%x%points + 1), z(0:self%z%points + 1), highest
      associate (m => self%x%points, n => self%z%points, film => response%film, edge => self%gap%ambient_pressure)
         p = 0
         p(1:m, 1:n) = self%root*self%y(:, :, 1)
         phi = self%middle + self%half_arc*[-1.0_wp, self%x%place, 1.0_wp]
         z = self%half_length*[-1.0_wp, self%z%place, 1.0_wp]
         call find_highest(phi, z, p, highest, response%place)
         film%min_pressure = edge + minval(p)
         film%max_pressure = edge
         if (highest > 0) film%max_pressure = self%pressure_at(motion, response%place(1), response%place(2))
      end associate
   end subroutine take_pressures

   !> Pressure of the last film, Pa, at an angle from the pivot, rad, and at z, m, on the pad.
   pure real(wp) function pressure_at(self, motion, phi, z) result(p)
      class(weighted_film_type), intent(in) :: self
      !> That of the last film.
      type(sloped_motion), intent(in) :: motion
      real(wp), intent(in) :: phi, z
      real(wp) :: along(self%x%n, 3), across(self%z%n, 3), h
      integer :: j
      call bubbles_at(self%x%n, (phi - self%middle)/self%half_arc, along(:, 1), along(:, 2), along(:, 3))
      call bubbles_at(self%z%n, z/self%half_length, across(:, 1), across(:, 2), across(:, 3))
      h = self%gap%thickness(motion%at(z), sin(phi), cos(phi))
      p = 0
      do j = 1, self%z%n
         p = p + across(j, 1)*dot_product(along(:, 1), self%solution(1, self%place(:, j)))
      end do
      p = self%gap%ambient_pressure + p/(h*sqrt(h))
   end function pressure_at
end module weighted_film
