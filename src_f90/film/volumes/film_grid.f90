!> Finite volumes of one pad's film on half the axial width (the film is symmetric).
!>
!> With phi for X = R phi, and everything times R**2, the Reynolds equation is
!>
!>    d/dphi(E h^3 dp/dphi) + R^2 E h^3 d2p/dZ2 = R^2 (-6 mu omega R_J/R d(G h)/dphi + 12 mu dh/dt),
!>
!> with E, K E across the film, and G those of the film's law (film_law); all are 1 where it does not vary.
!>
!> Columns of cells lie along the arc from the trailing to the leading edge, rows from the middle plane to
!> the side, ever lower, as the film cavitates first and pressure bends most beside the edges. The equation of a
!> cell is that of the mean pressure in it, divided by its height. Pressures are those above the cavitation
!> pressure. Fields are (row, column).
module film_grid
   use kinds, only: wp
   use linear_algebra, only: solve_2x2
   use film_solver, only: film_motion, film_law_type
   use film_law, only: law_at_nodes, most_numbers
   use pad_gap, only: pad_gap_type, pad_directions
   implicit none (type, external)
   private
   public :: film_grid_type, new_film_grid

   !> How much the rows' heights change, linearly: from 1 and this to 1 less this, over their mean. With uniform
   !> rows it takes three times as many to come as close (docs/benchmarks.md has the errors of this grid).
   real(wp), parameter :: grading = 0.85_wp

   type :: film_grid_type
      type(pad_gap_type) :: gap
      type(pad_directions) :: directions
      integer :: columns, rows
      !> Mean angular and axial size of a cell, rad and m; widths of the columns and heights of the rows over these.
      real(wp) :: d_phi, d_z
      real(wp), allocatable :: width(:), height(:)
      !> Angles from the pivot of the trailing edge, the middles of the columns and the leading edge (0:columns + 1).
      real(wp), allocatable :: middle(:)
      !> Distances between these over the mean size of a cell, by face (0:columns).
      real(wp), allocatable :: between(:)
      !> Conductances of a row towards the middle plane and towards the side, over those of uniform rows and its
      !> height: so chosen that the parabola of a narrow pad comes out exactly.
      real(wp), allocatable :: inward(:), outward(:)
      !> What the pressures of the rows count for that in the middle plane.
      real(wp), allocatable :: to_middle(:)
      !> Pressure at the leading edge and at the other edges, Pa.
      real(wp) :: supply, ambient
      !> Sine, cosine and film thickness, m, at the cell centres and at the cell faces (0:columns).
      real(wp), allocatable :: sin_cell(:), cos_cell(:), sin_face(:), cos_face(:), h_cell(:), h_face(:)
      !> E at the faces, K E at the cells, G and S at the same points; where they turn with the thickness, the
      !> derivatives of ln E and ln(K E) over ln h.
      real(wp), allocatable :: mobility_face(:), mobility_cell(:), sliding_face(:), sliding_cell(:), shear_cell(:)
      real(wp), allocatable :: power_face(:), power_cell(:)
      !> The law whose they are: whether it varies, its numbers, and how it was at the cells and faces.
      logical, private :: varies = .false.
      real(wp), private :: numbers(most_numbers) = 0
      type(law_at_nodes), private :: at_cell, at_face
      !> Conductances through the faces along the arc (0:columns), and between uniform rows of a column.
      real(wp), allocatable :: along(:), beside(:)
      !> Factors of the difference of h over a cell and of dh/dt in the right-hand side.
      real(wp) :: wedge, squeeze
      !> Right-hand side of a column: in every row, and what the side adds in the edge row.
      real(wp), allocatable :: source(:), edge_source(:)
   contains
      procedure :: place_columns
      procedure :: set_motion
      procedure :: force
      procedure :: weight
      procedure :: derivatives
      procedure :: derivatives_of_products
      procedure :: pressure_at
      procedure :: highest
   end type film_grid_type

contains

   !> A grid with this number of cells along the arc and along half the width; of equal columns, or with these angles
   !> from the pivot, rad, (0:columns), from the trailing to the leading edge, between them.
   pure function new_film_grid(gap, columns, rows, angles) result(grid)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: columns, rows
      real(wp), intent(in), optional :: angles(0:)
      type(film_grid_type) :: grid
      !> Faces between the rows over their mean height; mean of the square from the middle plane in a row.
      real(wp) :: face(0:rows), square(rows), conductance(0:rows)
      integer :: i
      grid%gap = gap
      grid%directions = gap%directions()
      grid%columns = columns
      grid%rows = rows
      grid%d_phi = gap%arc()/columns
      grid%d_z = gap%axial_length/(2*rows)
      face = [(i*(1 + grading - grading*i/rows), i=0, rows)]
      grid%height = face(1:) - face(:rows - 1)
      square = (face(:rows - 1)**2 + face(:rows - 1)*face(1:) + face(1:)**2)/3
      conductance(0) = 0
      conductance(1:rows - 1) = 2*face(1:rows - 1)/(square(2:) - square(:rows - 1))
      conductance(rows) = 2*face(rows)/(face(rows)**2 - square(rows))
      grid%inward = conductance(:rows - 1)/grid%height
      grid%outward = conductance(1:)/grid%height
      grid%to_middle = middle_shares(face)
      grid%supply = gap%supply_pressure - gap%cavitation_pressure
      grid%ambient = gap%ambient_pressure - gap%cavitation_pressure
      allocate (grid%width(columns), grid%middle(0:columns + 1), grid%between(0:columns), grid%along(0:columns))
      allocate (grid%sin_cell(columns), grid%cos_cell(columns), grid%sin_face(0:columns), grid%cos_face(0:columns))
      allocate (grid%h_cell(columns), grid%beside(columns), grid%source(columns), grid%edge_source(columns))
      allocate (grid%mobility_cell(columns), grid%sliding_cell(columns), grid%shear_cell(columns))
      allocate (grid%h_face(0:columns), grid%mobility_face(0:columns), grid%sliding_face(0:columns))
      if (present(angles)) then
         call grid%place_columns(angles)
      else
         call grid%place_columns([(i*grid%d_phi - gap%trailing_angle, i=0, columns)])
         ! to the last bit
         grid%width(:) = 1
         grid%between(1:columns - 1) = 1
      end if
   end function new_film_grid

   !> Places the columns between these angles from the pivot, rad, (0:columns), from the trailing to the leading edge.
   pure subroutine place_columns(self, angles)
      class(film_grid_type), intent(inout) :: self
      real(wp), intent(in) :: angles(0:)
      real(wp) :: middle(0:size(angles))
      associate (n => self%columns)
         middle = [-self%gap%trailing_angle, 0.5_wp*(angles(:n - 1) + angles(1:)), self%gap%leading_angle]
         self%middle(:) = middle
         self%width(:) = (angles(1:) - angles(:n - 1))/self%d_phi
         self%between(1:n - 1) = (middle(2:n) - middle(1:n - 1))/self%d_phi
         ! the boundary lies half a cell away
         self%between(0) = 0.5_wp*self%width(1)
         self%between(n) = 0.5_wp*self%width(n)
         self%sin_cell(:) = sin(middle(1:n))
         self%cos_cell(:) = cos(middle(1:n))
      end associate
      self%sin_face(:) = sin(angles)
      self%cos_face(:) = cos(angles)
      ! no law has been there
      self%varies = .false.
      self%numbers = 0
      if (allocated(self%power_face)) deallocate (self%power_face, self%power_cell)
      self%mobility_cell(:) = 1
      self%sliding_cell(:) = 1
      self%shear_cell(:) = 1
      self%mobility_face(:) = 1
      self%sliding_face(:) = 1
   end subroutine place_columns

   !> Shares of the rows' means in the value at 0 of the even polynomial, of the fourth degree, with the means of the
   !> first three rows between these faces; of a parabola between two.
   pure function middle_shares(face) result(shares)
      real(wp), intent(in) :: face(0:)
      real(wp) :: shares(ubound(face, 1)), square(3), fourth(3)
      integer :: n
      n = min(3, size(shares))
      shares = 0
      square(:n) = (face(1:n)**3 - face(:n - 1)**3)/(3*(face(1:n) - face(:n - 1)))
      fourth(:n) = (face(1:n)**5 - face(:n - 1)**5)/(5*(face(1:n) - face(:n - 1)))
      if (n == 2) shares(2) = -square(1)/(square(2) - square(1))
      if (n == 3) shares(2:3) = solve_2x2(reshape([square(2:) - square(1), fourth(2:) - fourth(1)], [2, 2], &
         & order=[2, 1]), -[square(1), fourth(1)])
      shares(1) = 1 - sum(shares(2:))
   end function middle_shares

   !> Film thickness, conductances and right-hand side at a motion, with an oil, and a journal speed, rad/s.
   pure subroutine set_motion(self, motion, oil, speed)
      class(film_grid_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      associate (n => self%columns)
         self%wedge = -6*oil%viscosity*speed*self%gap%journal_radius*self%gap%pad_radius()/self%d_phi
         self%squeeze = 12*oil%viscosity*self%gap%pad_radius()**2
         self%h_cell(:) = self%gap%thickness(motion, self%sin_cell, self%cos_cell)
         self%h_face(:) = self%gap%thickness(motion, self%sin_face, self%cos_face)
         if (oil%varies .or. self%varies) call take_law(self, motion, oil)
         self%along(:) = self%mobility_face*self%h_face**3/(self%d_phi**2*self%between)
         self%beside(:) = self%mobility_cell*self%width*self%h_cell**3*(self%gap%pad_radius()/self%d_z)**2
         self%source(:) = self%wedge*(self%sliding_face(1:n)*self%h_face(1:n) &
            & - self%sliding_face(0:n - 1)*self%h_face(0:n - 1)) &
            & - self%squeeze*self%width*(motion%velocity(1)*self%sin_cell + motion%velocity(2)*self%cos_cell)
         self%source(1) = self%source(1) - self%along(0)*self%ambient
         self%source(n) = self%source(n) - self%along(n)*self%supply
         self%edge_source(:) = -self%outward(self%rows)*self%beside*self%ambient
      end associate
   end subroutine set_motion

   !> What a law makes of the equation at the cells and faces, unless it is the last one and knows the place alone.
   pure subroutine take_law(grid, motion, oil)
      class(film_grid_type), intent(inout) :: grid
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      if (oil%has_numbers(grid%numbers) .and. .not. oil%turns_with_thickness()) return
      grid%varies = oil%varies
      grid%numbers = oil%numbers()
      associate (cell => grid%at_cell, face => grid%at_face)
         call oil%at_nodes(grid%gap, motion, grid%sin_cell, grid%cos_cell, cell)
         call oil%at_nodes(grid%gap, motion, grid%sin_face, grid%cos_face, face)
         grid%mobility_cell(:) = 1/cell%inverse_root**2
         grid%sliding_cell(:) = cell%sliding
         grid%shear_cell(:) = oil%shear_weight(grid%gap, motion, grid%middle(1:grid%columns))
         grid%mobility_face(:) = 1/face%inverse_root**2
         grid%sliding_face(:) = face%sliding
         if (allocated(grid%power_face)) deallocate (grid%power_face, grid%power_cell)
         if (.not. oil%turns_with_thickness()) return
         grid%mobility_cell(:) = grid%mobility_cell*cell%across
         allocate (grid%power_face(0:grid%columns), source=face%flow_power(:, 0))
         grid%power_cell = cell%flow_power(:, 0) + cell%across_power(:, 0)
      end associate
   end subroutine take_law

   !> What a row of mean height counts in the two forces, (column, force), m^2: area of two mirrored cells, in
   !> that direction.
   pure function weight(self)
      class(film_grid_type), intent(in) :: self
      real(wp) :: weight(self%columns, 2)
      associate (area => 2*self%gap%pad_radius()*self%d_phi*self%d_z)
         weight(:, 1) = area*self%width*self%sin_cell
         weight(:, 2) = area*self%width*self%cos_cell
      end associate
   end function weight

   !> Force on the journal in the pad frame, N, of the pressure times height summed over the rows of each column.
   pure function force(self, column_sums)
      class(film_grid_type), intent(in) :: self
      real(wp), intent(in) :: column_sums(:)
      real(wp) :: force(2)
      associate (sums => column_sums + self%gap%cavitation_pressure*self%rows)
         force = -matmul(sums, self%weight())
      end associate
   end function force

   !> Derivatives of a force over position and velocity by its adjoint. With L p = -s and F = g . p, let L a = -g,
   !> a = 0 where the film has cavitated; then dF = a . (ds + dL p), and a . dL p is a sum over faces, with
   !> differences of a and p over each.
   pure function derivatives(self, p, a)
      class(film_grid_type), intent(in) :: self
      !> Pressure and adjoint, (row, column).
      real(wp), intent(in) :: p(:, :), a(:, :)
      real(wp) :: derivatives(4)
      real(wp), dimension(0:self%columns) :: over_face
      real(wp), dimension(self%columns) :: over_side, total
      real(wp) :: between(self%rows)
      integer :: i
      associate (n => self%columns, rows => self%rows, height => self%height)
         between = self%outward*height
         over_face(0) = sum(height*(p(:rows, 1) - self%ambient)*a(:rows, 1))
         over_face(n) = sum(height*(p(:rows, n) - self%supply)*a(:rows, n))
         do i = 1, n
            if (i < n) over_face(i) = sum(height*(p(:rows, i + 1) - p(:rows, i))*(a(:rows, i + 1) - a(:rows, i)))
            over_side(i) = sum(between(:rows - 1)*(p(2:rows, i) - p(:rows - 1, i))*(a(2:rows, i) - a(:rows - 1, i))) &
               & + between(rows)*(p(rows, i) - self%ambient)*a(rows, i)
            total(i) = sum(height*a(:rows, i))
         end do
      end associate
      derivatives = self%derivatives_of_products(over_face, over_side, total)
   end function derivatives

   !> The same from products of p and a, summed over the rows and weighted by their heights: of their differences over
   !> each face along the arc; of those over the faces between the rows of a column, times `outward`; and a's own sums.
   pure function derivatives_of_products(self, along, across, total) result(derivatives)
      class(film_grid_type), intent(in) :: self
      real(wp), intent(in) :: along(0:), across(:), total(:)
      real(wp) :: derivatives(4)
      real(wp) :: over_face(0:self%columns), over_side(self%columns)
      over_face = along*3*self%mobility_face*self%h_face**2/(self%d_phi**2*self%between)
      over_side = across*3*self%mobility_cell*self%width*(self%h_cell*(self%gap%pad_radius()/self%d_z))**2
      if (allocated(self%power_face)) then
         over_face = over_face*(1 + self%power_face/3)
         over_side = over_side*(1 + self%power_cell/3)
      end if
      derivatives(1) = over_position(self%sin_face, self%sin_cell)
      derivatives(2) = over_position(self%cos_face, self%cos_cell)
      derivatives(3) = -self%squeeze*dot_product(self%width*self%sin_cell, total)
      derivatives(4) = -self%squeeze*dot_product(self%width*self%cos_cell, total)
   contains
      !> Derivative over e_y' (sines) or e_z' (cosines): dh = -sin(phi) de_y' - cos(phi) de_z'.
      pure real(wp) function over_position(at_face, at_cell)
         real(wp), intent(in) :: at_face(0:), at_cell(:)
         over_position = -dot_product(self%wedge*(self%sliding_face(1:)*at_face(1:) &
            & - self%sliding_face(:self%columns - 1)*at_face(:self%columns - 1)), total) &
            & - dot_product(at_face, over_face) - dot_product(at_cell, over_side)
      end function over_position
   end function derivatives_of_products

   !> Pressure, Pa, (axial position, angle), from that of the cells: along the arc and across the width parabolas that
   !> meet smoothly, one for each cell, whose mean is the cell's pressure. So the integral of the field is the force,
   !> and the parabola across a narrow pad comes out exactly.
   pure function pressure_at(self, p, cavitates, phi, z) result(pressure)
      class(film_grid_type), intent(in) :: self
      !> Mean pressures above the cavitation pressure, (row, column), Pa.
      real(wp), intent(in) :: p(:, :)
      !> Whether none falls below the cavitation pressure.
      logical, intent(in) :: cavitates
      !> Angles from the pivot, rad, and distances from the middle plane, m, within the pad.
      real(wp), intent(in) :: phi(:), z(:)
      real(wp) :: pressure(size(z), size(phi))
      real(wp), allocatable :: mean(:, :), at_face(:, :)
      real(wp) :: line(self%rows), ends(0:self%rows), t
      integer :: i, j, k
      associate (rows => self%rows)
         allocate (at_face(0:self%columns, rows))
         mean = p(:rows, :self%columns)
         if (cavitates) mean = max(mean, 0.0_wp)
         do k = 1, rows
            at_face(:, k) = between_means(self%width, mean(k, :), cavitates, self%supply, self%ambient)
         end do
         do j = 1, size(phi)
            call find(self%width, (phi(j) + self%gap%trailing_angle)/self%d_phi, i, t)
            line = parabola(at_face(i - 1, :), mean(:, i), at_face(i, :), t)
            ends = between_means(self%height, line, cavitates, self%ambient)
            do k = 1, size(z)
               call find(self%height, abs(z(k))/self%d_z, i, t)
               pressure(k, j) = parabola(ends(i - 1), line(i), ends(i), t)
            end do
         end do
         if (cavitates) pressure = max(pressure, 0.0_wp)
         pressure = pressure + self%gap%cavitation_pressure
      end associate
   end function pressure_at

   !> Highest pressure above that of cavitation, Pa, in the middle plane and at the edges, from the columns' means in
   !> that plane: of the parabola with the means of three columns, the highest one in their middle.
   pure real(wp) function highest(self, mean)
      class(film_grid_type), intent(in) :: self
      real(wp), intent(in) :: mean(:)
      real(wp) :: first, bend, x
      integer :: i
      highest = max(maxval(mean), self%ambient, self%supply)
      if (self%columns < 3) return
      i = min(max(maxloc(mean, 1), 2), self%columns - 1)
      associate (m => mean(i - 1:i + 1), w => self%width(i - 1:i + 1))
         first = (m(2) - m(1))/(w(1) + w(2))
         bend = ((m(3) - m(2))/(w(2) + w(3)) - first)/sum(w)
         if (.not. bend < 0) return
         x = min(max((2*w(1) + w(2) - first/bend)/3, 0.0_wp), sum(w))
         highest = max(highest, m(1) + first*(2*x - w(1)) + bend*(3*x**2 - 2*x*(2*w(1) + w(2)) + w(1)*(w(1) + w(2))))
      end associate
   end function highest

   !> The interval, of these widths, in which a place lies, and where in it, from 0 to 1.
   pure subroutine find(width, place, i, t)
      real(wp), intent(in) :: width(:), place
      integer, intent(out) :: i
      real(wp), intent(out) :: t
      real(wp) :: rest
      rest = place
      do i = 1, size(width) - 1
         if (rest < width(i)) exit
         rest = rest - width(i)
      end do
      t = min(max(rest/width(i), 0.0_wp), 1.0_wp)
   end subroutine find

   !> The parabola with these values at both ends, 0 and 1, and this mean.
   elemental real(wp) function parabola(first, mean, last, t)
      real(wp), intent(in) :: first, mean, last, t
      parabola = (1 - t)*(1 - 3*t)*first + 6*t*(1 - t)*mean + t*(3*t - 2)*last
   end function parabola

   !> Values at the ends (0:n) of intervals of these widths, so that the parabolas with these means meet smoothly: the
   !> slopes of the cubic spline through the integral. The last one is given; without `first` the first parabola is
   !> level there. In a film that cavitates they are so limited that no parabola falls below 0.
   pure function between_means(width, mean, cavitates, last, first) result(values)
      real(wp), intent(in) :: width(:), mean(:)
      logical, intent(in) :: cavitates
      real(wp), intent(in) :: last
      real(wp), intent(in), optional :: first
      real(wp) :: values(0:size(mean)), following(0:size(mean)), pivot
      integer :: i
      associate (n => size(mean))
         values(0) = 1.5_wp*mean(1)
         following(0) = 0.5_wp
         if (present(first)) then
            values(0) = first
            following(0) = 0
         end if
         do i = 1, n - 1
            pivot = (2 - following(i - 1))/width(i) + 2/width(i + 1)
            following(i) = 1/(width(i + 1)*pivot)
            values(i) = (3*(mean(i)/width(i) + mean(i + 1)/width(i + 1)) - values(i - 1)/width(i))/pivot
         end do
         values(n) = last
         do i = n - 1, 0, -1
            values(i) = values(i) - following(i)*values(i + 1)
         end do
         if (.not. cavitates) return
         values(1:n - 1) = max(0.0_wp, min(values(1:n - 1), 3*mean(:n - 1), 3*mean(2:)))
         if (.not. present(first)) values(0) = max(0.0_wp, min(values(0), 3*mean(1)))
      end associate
   end function between_means
end module film_grid
