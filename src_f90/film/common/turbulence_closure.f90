!> How much more than a laminar film a turbulent one resists pressure and sliding, over its Reynolds number
!> (docs/theory/turbulence.md):
!>    (h^3/(mu kx) p_x)_x + (h^3/(mu kz) p_z)_z = U/2 h_x + h_t,   shear kf mu U/h,   Re = rho U h/mu,
!> 12, 12 and 1 in a laminar film. Tabulated are ln(12/kx), ln(kx/kz) and ln kf over ln Re.
!>
!> `ng_pan`: the eddies of Reichardt's law in the shear that sliding makes (Ng and Pan, J. Basic Eng. 87 (1965) 675;
!> Elrod and Ng, J. Lubr. Technol. 89 (1967) 346), integrated across the film; the others are fits over Re.
module turbulence_closure
   use kinds, only: wp, pi
   use linear_algebra, only: solve
   use rising_numbers, only: number_up_to
   implicit none (type, external)
   private
   public :: closure_type, new_closure, steepest, closure_factors, along, across, shear, eddy_factors, &
      & eddy_conduction, closures, wall_law_type, new_wall_law

   !> The factors: ln(12/kx), ln(kx/kz), ln kf.
   integer, parameter :: along = 1, across = 2, shear = 3, factors = 3
   !> Names of the closures, numbered so.
   character(len=*), parameter :: closures(*) = [character(len=14) :: 'ng_pan', 'ng_pan_fit', 'constantinescu', 'hirs']
   !> Reynolds number up to which the factors are tabulated: a hundred times that of the fastest large bearings.
   real(wp), parameter :: largest_reynolds = 1e7_wp
   !> Degree of the polynomials, over cells at most this wide in ln Re: they leave 1e-10 (test_turbulent_film).
   integer, parameter :: degree = 9
   real(wp), parameter :: widest_cell = 0.35_wp
   integer, parameter :: least_cells = 12
   !> Of the wall's law: von Karman's constant, and the thickness of the sublayer in wall units (Ng and Pan).
   real(wp), parameter :: karman = 0.4_wp, sublayer = 10.7_wp
   !> Of the fits, by closure from the second on: factor and power of Re in kx, kz and kf.
   real(wp), parameter :: fit(2, factors, 2:4) = reshape([ &
      & 0.0136_wp, 0.9_wp, 0.0043_wp, 0.96_wp, 0.0012_wp, 0.94_wp, &
      & 0.026_wp, 0.8265_wp, 0.0198_wp, 0.741_wp, 0.0023_wp, 0.855_wp, &
      & 0.0687_wp, 0.75_wp, 0.0392_wp, 0.75_wp, 0.066_wp*2**(-2.75_wp), 0.75_wp], [2, factors, 3])
   integer, parameter :: ng_pan = 1, hirs = 4
   !> Points across half of a film, in a variable in which the eddies are smooth: the factors are those of another
   !> program to all of its six decimals (test_turbulent_film).
   integer, parameter :: points = 48

   !> Points across half of a film, and what Newton's method for its thickness in wall units begins with, ln h+.
   type :: wall_law_type
      real(wp) :: u(points), weight(points), log_h = 1
   contains
      procedure :: find_eddies
      procedure :: eddies_at
   end type wall_law_type

   type :: closure_type
      !> Number of the closure; Reynolds numbers below which a film is laminar and above which it is turbulent.
      integer :: kind = 0
      real(wp) :: laminar_below = 0, turbulent_above = 0
      !> Bounds of the cells, ln Re, one more than cells; polynomials over the place in the cell from -1 to 1,
      !> (0:degree, factor, cell).
      real(wp), allocatable, private :: bounds(:), polynomials(:, :, :)
   contains
      procedure :: is_that_of
      procedure :: at
      procedure :: value_of
      procedure :: turbulent_share
   end type closure_type

   !> Factors and their first three derivatives over ln Re, (order from 0, factor).
   type :: closure_factors
      real(wp) :: value(0:3, factors) = 0
   end type closure_factors

contains

   !> The closure of this name (closures), with a transition between these Reynolds numbers.
   function new_closure(name, laminar_below, turbulent_above) result(closure)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: laminar_below, turbulent_above
      type(closure_type) :: closure
      real(wp) :: nodes(0:degree), matrix(0:degree, 0:degree), values(0:degree, factors)
      type(wall_law_type) :: wall
      integer :: i, j, n
      logical :: ok
      closure%kind = findloc(closures, name, dim=1)
      closure%laminar_below = laminar_below
      closure%turbulent_above = turbulent_above
      closure%bounds = cell_bounds(closure%kind, log([laminar_below, turbulent_above, largest_reynolds]))
      n = size(closure%bounds) - 1
      wall = new_wall_law()
      allocate (closure%polynomials(0:degree, factors, n))
      ! Chebyshev's points, both ends among them
      nodes = [(-cos(i*pi/degree), i=0, degree)]
      do j = 0, degree
         matrix(:, j) = nodes**j
      end do
      do i = 1, n
         associate (from => closure%bounds(i), to => closure%bounds(i + 1))
            do j = 0, degree
               values(j, :) = logarithms(closure, wall, exp(from + (to - from)*(1 + nodes(j))/2))
            end do
         end associate
         ! of Chebyshev's points the matrix is never singular
         call solve(degree + 1, factors, matrix, values, ok)
         closure%polynomials(:, :, i) = values
      end do
   end function new_closure

   !> Whether it is the closure of this name and this transition.
   pure logical function is_that_of(self, name, laminar_below, turbulent_above)
      class(closure_type), intent(in) :: self
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: laminar_below, turbulent_above
      is_that_of = closures(self%kind) == name .and. .not. any(abs([self%laminar_below - laminar_below, &
         & self%turbulent_above - turbulent_above]) > 0)
   end function is_that_of

   !> Bounds of cells, ln Re, between those of the transition and of the table, and at the bends of Hirs' law.
   pure function cell_bounds(kind, ends) result(bounds)
      integer, intent(in) :: kind
      real(wp), intent(in) :: ends(3)
      real(wp), allocatable :: bounds(:), bends(:)
      integer :: i, k, n
      bends = ends
      if (kind == hirs) then
         do k = 1, factors
            associate (bend => log(merge(1.0_wp, 12.0_wp, k == shear)/fit(1, k, hirs))/fit(2, k, hirs))
               if (all(abs(bends - bend) > 1e-9_wp) .and. bend > ends(1)) bends = [pack(bends, bends < bend), bend, &
                  & pack(bends, bends > bend)]
            end associate
         end do
      end if
      bounds = bends(:1)
      do k = 2, size(bends)
         n = max(merge(least_cells, 1, bends(k) <= ends(2)), ceiling((bends(k) - bends(k - 1))/widest_cell))
         bounds = [bounds, [(bends(k - 1) + (bends(k) - bends(k - 1))*i/n, i=1, n)]]
      end do
   end function cell_bounds

   !> The factors at a Reynolds number, with their derivatives over its logarithm; 0 where the film is laminar. Above
   !> the table they go on as powers of Re.
   elemental function at(self, log_reynolds) result(found)
      class(closure_type), intent(in) :: self
      real(wp), intent(in) :: log_reynolds
      type(closure_factors) :: found
      real(wp) :: x, unit, beyond
      integer :: cell, k
      if (log_reynolds <= self%bounds(1)) return
      call find_place(self, log_reynolds, cell, unit, x, beyond)
      do k = 1, factors
         found%value(:, k) = horner(self%polynomials(:, k, cell), x)*[1.0_wp, unit, unit**2, unit**3]
      end do
      if (beyond > 0) then
         found%value(0, :) = found%value(0, :) + beyond*found%value(1, :)
         found%value(2:, :) = 0
      end if
   end function at

   !> The same of one factor, without derivatives.
   elemental real(wp) function value_of(self, factor, log_reynolds) result(value)
      class(closure_type), intent(in) :: self
      integer, intent(in) :: factor
      real(wp), intent(in) :: log_reynolds
      type(closure_factors) :: all_of_them
      real(wp) :: x, unit, beyond
      integer :: cell, j
      value = 0
      if (log_reynolds <= self%bounds(1)) return
      call find_place(self, log_reynolds, cell, unit, x, beyond)
      if (beyond > 0) then
         all_of_them = self%at(log_reynolds)
         value = all_of_them%value(0, factor)
         return
      end if
      do j = degree, 0, -1
         value = value*x + self%polynomials(j, factor, cell)
      end do
   end function value_of

   !> The cell of a Reynolds number and the place in it, with the derivative of the place over ln Re, and how far beyond
   !> the last cell ln Re is.
   pure subroutine find_place(self, log_reynolds, cell, unit, x, beyond)
      class(closure_type), intent(in) :: self
      real(wp), intent(in) :: log_reynolds
      integer, intent(out) :: cell
      real(wp), intent(out) :: unit, x, beyond
      integer :: n
      n = size(self%bounds)
      cell = min(number_up_to(self%bounds, log_reynolds), n - 1)
      beyond = max(log_reynolds - self%bounds(n), 0.0_wp)
      unit = 2/(self%bounds(cell + 1) - self%bounds(cell))
      x = unit*(log_reynolds - beyond - self%bounds(cell)) - 1
   end subroutine find_place

   !> The largest power of the Reynolds number with which the resistance to a pressure grows in the transition of a
   !> closure: d ln kx/d ln Re, by differences of it.
   real(wp) function steepest(name, laminar_below, turbulent_above)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: laminar_below, turbulent_above
      integer, parameter :: places = 60
      type(closure_type) :: closure
      type(wall_law_type) :: wall
      real(wp) :: mobility(factors, 0:places)
      integer :: i
      closure%kind = findloc(closures, name, dim=1)
      closure%laminar_below = laminar_below
      closure%turbulent_above = turbulent_above
      wall = new_wall_law()
      associate (step => log(turbulent_above/laminar_below)/places)
         do i = 0, places
            mobility(:, i) = logarithms(closure, wall, laminar_below*exp(i*step))
         end do
         steepest = maxval(mobility(along, :places - 1) - mobility(along, 1:))/step
      end associate
   end function steepest

   !> A polynomial and its first three derivatives.
   pure function horner(coefficients, x) result(value)
      real(wp), intent(in) :: coefficients(0:), x
      real(wp) :: value(0:3)
      integer :: j
      value = 0
      do j = ubound(coefficients, 1), 0, -1
         value(3) = value(3)*x + value(2)
         value(2) = value(2)*x + value(1)
         value(1) = value(1)*x + value(0)
         value(0) = value(0)*x + coefficients(j)
      end do
      value(2) = 2*value(2)
      value(3) = 6*value(3)
   end function horner

   !> ln(12/kx), ln(kx/kz) and ln kf.
   function logarithms(closure, wall, reynolds)
      type(closure_type), intent(in) :: closure
      type(wall_law_type), intent(inout) :: wall
      real(wp), intent(in) :: reynolds
      real(wp) :: logarithms(factors), k(factors), share
      share = turbulent_share(closure, reynolds)
      if (closure%kind == ng_pan) then
         k = eddy_factors(wall, reynolds, share)
      else
         k = [12.0_wp, 12.0_wp, 1.0_wp]
         associate (more => fit(1, :, closure%kind)*reynolds**fit(2, :, closure%kind))
            if (closure%kind == hirs) then
               k = k + share*(max(k, more) - k)
            else
               k = k + share*more
            end if
         end associate
      end if
      logarithms = [log(12/k(along)), log(k(along)/k(across)), log(k(shear))]
   end function logarithms

   !> w, from 0 in a laminar film to 1 in a turbulent one, with four continuous derivatives.
   elemental real(wp) function turbulent_share(closure, reynolds) result(w)
      class(closure_type), intent(in) :: closure
      real(wp), intent(in) :: reynolds
      real(wp) :: s
      s = min(max((reynolds - closure%laminar_below)/(closure%turbulent_above - closure%laminar_below), 0.0_wp), 1.0_wp)
      w = s**5*(126 - s*(420 - s*(540 - s*(315 - s*70))))
   end function turbulent_share

   !> kx, kz and kf of Ng and Pan's eddies, of which this share is there.
   function eddy_factors(wall, reynolds, share) result(k)
      type(wall_law_type), intent(inout) :: wall
      real(wp), intent(in) :: reynolds, share
      real(wp) :: k(factors), eta(points), weight(points), eddies(points), slopes(points)
      call wall%find_eddies(reynolds, eta, weight, eddies, slopes)
      associate (f => 1 + share*eddies, g => share*slopes/2)
         k = 1/[2*sum(weight*(0.5_wp - eta)**2*(1 - g/f)/f), 2*sum(weight*(0.5_wp - eta)**2/f), 2*sum(weight/f)]
      end associate
   end function eddy_factors

   !> How much more heat than by conduction alone goes from wall to wall, where this share of the eddies is there and
   !> the Prandtl number of the oil over that of the eddies is given.
   function eddy_conduction(wall, reynolds, share, prandtl_ratio) result(factor)
      type(wall_law_type), intent(inout) :: wall
      real(wp), intent(in) :: reynolds, share, prandtl_ratio
      real(wp) :: factor, eta(points), weight(points), eddies(points), slopes(points)
      call wall%find_eddies(reynolds, eta, weight, eddies, slopes)
      factor = 1/(2*sum(weight/(1 + share*prandtl_ratio*eddies)))
   end function eddy_conduction

   !> Points across half of a film for eddies at any Reynolds number.
   pure type(wall_law_type) function new_wall_law() result(wall)
      real(wp) :: root, p(0:points), slope
      integer :: i, k, iteration
      ! Gauss-Legendre's, from 0 to 1
      do i = 1, points
         root = cos(pi*(i - 0.25_wp)/(points + 0.5_wp))
         do iteration = 1, 10
            p(0:1) = [1.0_wp, root]
            do k = 2, points
               p(k) = ((2*k - 1)*root*p(k - 1) - (k - 1)*p(k - 2))/k
            end do
            slope = points*(root*p(points) - p(points - 1))/(root**2 - 1)
            root = root - p(points)/slope
         end do
         wall%u(i) = 0.5_wp*(1 - root)
         wall%weight(i) = 1/((1 - root**2)*slope**2)
      end do
   end function new_wall_law

   !> Eddy viscosity over that of the oil, eps, and its slope y d eps/dy over the distance y from the wall, at points
   !> across half of the film, in parts of its thickness, with weights whose sum is 1/2. The film's thickness in wall
   !> units h+ is where h+^2 int 1/(1 + eps) = Re, the shear of sliding.
   subroutine find_eddies(self, reynolds, eta, weight, eddies, slopes)
      class(wall_law_type), intent(inout) :: self
      real(wp), intent(in) :: reynolds
      real(wp), dimension(points), intent(out) :: eta, weight, eddies, slopes
      real(wp), dimension(points) :: y, curved
      real(wp) :: last, change, resistance
      integer :: i
      ! Newton's method; the shear grows with the thickness, so that it ends
      do i = 1, 50
         ! the distance from the wall is that of the sublayer times sinh of u
         last = asinh(exp(self%log_h)/(2*sublayer))
         curved = exp(last*self%u)
         y = sublayer*(curved - 1/curved)/2
         weight = sublayer*(curved + 1/curved)/2*last*self%weight*exp(-self%log_h)
         eddies = tanh(y/sublayer)
         slopes = karman*y*eddies**2
         eddies = karman*(y - sublayer*eddies)
         resistance = 2*sum(weight/(1 + eddies))
         change = (log(reynolds/resistance) - 2*self%log_h)/(2 - 2*sum(weight*slopes/(1 + eddies)**2)/resistance)
         if (abs(change) < 1e-13_wp*max(1.0_wp, abs(self%log_h))) exit
         self%log_h = self%log_h + change
      end do
      eta = y*exp(-self%log_h)
   end subroutine find_eddies

   !> The same eddy viscosity at places across the film, from 0 to 1.
   function eddies_at(self, reynolds, places) result(eddies)
      class(wall_law_type), intent(inout) :: self
      real(wp), intent(in) :: reynolds, places(:)
      real(wp) :: eddies(size(places)), y(size(places))
      real(wp), dimension(points) :: eta, weight, inner, slopes
      call self%find_eddies(reynolds, eta, weight, inner, slopes)
      y = min(places, 1 - places)*exp(self%log_h)
      eddies = karman*(y - sublayer*tanh(y/sublayer))
   end function eddies_at
end module turbulence_closure
