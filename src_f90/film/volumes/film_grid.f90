!> Finite volumes of one pad's film on half the axial width (the film is symmetric).
!>
!> With phi for X = R phi, and everything times R**2, the Reynolds equation is
!>
!>    d/dphi(h^3 dp/dphi) + R^2 h^3 d2p/dZ2 = R^2 (-6 mu omega R_J/R dh/dphi + 12 mu dh/dt).
!>
!> Columns of cells lie along the arc from the trailing to the leading edge, rows from the middle plane to
!> the side, ever lower, as the film ruptures first and pressure bends most beside the edges. The equation of a
!> cell is that of the mean pressure in it, divided by its height. Pressures are those above the cavitation
!> pressure. Fields are (row, column).
module film_grid
   use kinds, only: wp
   use film_solver, only: film_motion
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
      !> Angular and mean axial size of a cell, rad and m; heights of the rows over their mean.
      real(wp) :: d_phi, d_z
      real(wp), allocatable :: height(:)
      !> Conductances of a row towards the middle plane and towards the side, over those of uniform rows and its
      !> height: so chosen that the parabola of a narrow pad comes out exactly.
      real(wp), allocatable :: inward(:), outward(:)
      !> Mean in a row of the squared distance from the middle plane over half the width.
      real(wp), allocatable :: square(:)
      !> Pressure at the leading edge and at the other edges, Pa.
      real(wp) :: supply, ambient
      !> Sine and cosine at the cell centres and at the cell faces (0:columns).
      real(wp), allocatable :: sin_cell(:), cos_cell(:), sin_face(:), cos_face(:)
      !> Film thickness at the same points, m.
      real(wp), allocatable :: h_cell(:), h_face(:)
      !> Conductances through the faces along the arc (0:columns), and between uniform rows of a column.
      real(wp), allocatable :: along(:), beside(:)
      !> Right-hand side of a column: in every row, and what the side adds in the edge row.
      real(wp), allocatable :: source(:), edge_source(:)
   contains
      procedure :: set_motion
      procedure :: force
      procedure :: weight
      procedure :: derivatives
      procedure :: pressure_at
   end type film_grid_type

contains

   !> A grid of so many cells along the arc and along half the width.
   pure function new_film_grid(gap, columns, rows) result(grid)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: columns, rows
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
      grid%square = square/rows**2
      grid%inward = conductance(:rows - 1)/grid%height
      grid%outward = conductance(1:)/grid%height
      grid%supply = gap%supply_pressure - gap%cavitation_pressure
      grid%ambient = gap%ambient_pressure - gap%cavitation_pressure
      grid%sin_cell = [(sin((i - 0.5_wp)*grid%d_phi - gap%trailing_angle), i=1, columns)]
      grid%cos_cell = [(cos((i - 0.5_wp)*grid%d_phi - gap%trailing_angle), i=1, columns)]
      allocate (grid%sin_face(0:columns), grid%cos_face(0:columns), grid%h_face(0:columns), grid%along(0:columns))
      grid%sin_face(:) = [(sin(i*grid%d_phi - gap%trailing_angle), i=0, columns)]
      grid%cos_face(:) = [(cos(i*grid%d_phi - gap%trailing_angle), i=0, columns)]
      allocate (grid%h_cell(columns), grid%beside(columns), grid%source(columns), grid%edge_source(columns))
   end function new_film_grid

   !> Film thickness, conductances and right-hand side at a motion and a journal speed, rad/s.
   pure subroutine set_motion(self, motion, speed)
      class(film_grid_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      associate (n => self%columns)
         self%h_cell(:) = self%gap%thickness(motion, self%sin_cell, self%cos_cell)
         self%h_face(:) = self%gap%thickness(motion, self%sin_face, self%cos_face)
         self%along(:) = self%h_face**3/self%d_phi**2
         ! the boundary lies half a cell away
         self%along(0) = 2*self%along(0)
         self%along(n) = 2*self%along(n)
         self%beside(:) = self%h_cell**3*(self%gap%pad_radius()/self%d_z)**2
         self%source(:) = wedge(self, speed)*(self%h_face(1:n) - self%h_face(0:n - 1)) &
            & - squeeze(self)*(motion%velocity(1)*self%sin_cell + motion%velocity(2)*self%cos_cell)
         self%source(1) = self%source(1) - self%along(0)*self%ambient
         self%source(n) = self%source(n) - self%along(n)*self%supply
         self%edge_source(:) = -self%outward(self%rows)*self%beside*self%ambient
      end associate
   end subroutine set_motion

   !> Factor of the difference of h over a cell in the right-hand side.
   pure real(wp) function wedge(self, speed)
      class(film_grid_type), intent(in) :: self
      real(wp), intent(in) :: speed
      wedge = -6*self%gap%viscosity*speed*self%gap%journal_radius*self%gap%pad_radius()/self%d_phi
   end function wedge

   !> Factor of dh/dt in the right-hand side.
   pure real(wp) function squeeze(self)
      class(film_grid_type), intent(in) :: self
      squeeze = 12*self%gap%viscosity*self%gap%pad_radius()**2
   end function squeeze

   !> What a row of mean height counts in the two forces, (column, force), m^2: area of two mirrored cells, in
   !> that direction.
   pure function weight(self)
      class(film_grid_type), intent(in) :: self
      real(wp) :: weight(self%columns, 2)
      associate (area => 2*self%gap%pad_radius()*self%d_phi*self%d_z)
         weight(:, 1) = area*self%sin_cell
         weight(:, 2) = area*self%cos_cell
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
   !> a = 0 where the film has ruptured; then dF = a . (ds + dL p), and a . dL p is a sum over faces, with
   !> differences of a and p over each.
   pure function derivatives(self, speed, p, a)
      class(film_grid_type), intent(in) :: self
      real(wp), intent(in) :: speed
      !> Pressure and adjoint, (row, column).
      real(wp), intent(in) :: p(:, :), a(:, :)
      real(wp) :: derivatives(4)
      real(wp), dimension(0:self%columns) :: over_face
      real(wp), dimension(self%columns) :: over_side, total
      real(wp) :: between(self%rows)
      real(wp) :: radius_over_d_z
      integer :: i
      radius_over_d_z = self%gap%pad_radius()/self%d_z
      associate (n => self%columns, rows => self%rows, height => self%height)
         between = self%outward*height
         over_face(0) = 2*sum(height*(p(:rows, 1) - self%ambient)*a(:rows, 1))
         over_face(n) = 2*sum(height*(p(:rows, n) - self%supply)*a(:rows, n))
         do i = 1, n
            if (i < n) over_face(i) = sum(height*(p(:rows, i + 1) - p(:rows, i))*(a(:rows, i + 1) - a(:rows, i)))
            over_side(i) = sum(between(:rows - 1)*(p(2:rows, i) - p(:rows - 1, i))*(a(2:rows, i) - a(:rows - 1, i))) &
               & + between(rows)*(p(rows, i) - self%ambient)*a(rows, i)
            total(i) = sum(height*a(:rows, i))
         end do
         over_face = over_face*3*self%h_face**2/self%d_phi**2
         over_side = over_side*3*(self%h_cell*radius_over_d_z)**2
         derivatives(1) = over_position(self%sin_face, self%sin_cell)
         derivatives(2) = over_position(self%cos_face, self%cos_cell)
         derivatives(3) = -squeeze(self)*dot_product(self%sin_cell, total)
         derivatives(4) = -squeeze(self)*dot_product(self%cos_cell, total)
      end associate
   contains
      !> Derivative over e_y' (sines) or e_z' (cosines): dh = -sin(phi) de_y' - cos(phi) de_z'.
      pure real(wp) function over_position(at_face, at_cell)
         real(wp), intent(in) :: at_face(0:), at_cell(:)
         over_position = -dot_product(wedge(self, speed)*(at_face(1:) - at_face(:self%columns - 1)), total) &
            & - dot_product(at_face, over_face) - dot_product(at_cell, over_side)
      end function over_position
   end function derivatives

   !> Pressure, Pa, (axial position, angle), from that of the cells: linear over phi between their centres and the
   !> edges, linear over Z^2 across the width, where a cell's mean stands at the mean of Z^2 in its row. So the
   !> parabola across a narrow pad comes out exactly.
   pure function pressure_at(self, p, floor, phi, z) result(pressure)
      class(film_grid_type), intent(in) :: self
      !> Mean pressures, (row, column), and the pressure below which none falls, above the cavitation pressure, Pa.
      real(wp), intent(in) :: p(:, :), floor
      !> Angles from the pivot, rad, and distances from the middle plane, m, within the pad.
      real(wp), intent(in) :: phi(:), z(:)
      real(wp) :: pressure(size(z), size(phi))
      real(wp) :: line(self%rows + 1), square(self%rows + 1), before(self%rows), after(self%rows), x, t
      integer :: i, j, k
      associate (n => self%columns, rows => self%rows)
         square = [self%square, 1.0_wp]
         do j = 1, size(phi)
            ! cell centres at 1, 2, ..., n; edges at 1/2 and n + 1/2
            x = (phi(j) + self%gap%trailing_angle)/self%d_phi + 0.5_wp
            i = min(max(int(x), 0), n)
            before = self%ambient
            after = self%supply
            t = x - i
            if (i > 0) then
               before = p(:rows, i)
            else
               t = 2*t - 1
            end if
            if (i < n) then
               after = p(:rows, i + 1)
            else
               t = 2*t
            end if
            line(:rows) = (1 - t)*before + t*after
            line(rows + 1) = self%ambient
            do k = 1, size(z)
               associate (q => (2*z(k)/self%gap%axial_length)**2)
                  i = min(max(count(square <= q), 1), rows)
                  t = (q - square(i))/(square(i + 1) - square(i))
                  pressure(k, j) = max(floor, (1 - t)*line(i) + t*line(i + 1))
               end associate
            end do
         end do
         pressure = pressure + self%gap%cavitation_pressure
      end associate
   end function pressure_at
end module film_grid
