!> Normal force of a pivot over its deflection: closed forms of a ball in a socket, a rocker, a spring, measured points.
!>
!> Fang's conformal law (Dyk et al. 2023, eqs (11)-(18)) is explicit once the projected contact
!> radius `a` is chosen: `n(a)`, `B(n)`, `g(a)`; then eq (14) with (16) is linear in the force.
!> Hertz's law is the usual non-conformal one.
module contact_law
   use kinds, only: wp, pi
   use rising_numbers, only: number_up_to
   implicit none (type, external)
   private
   public :: contact_law_type, contact_point, make_contact_law, new_measured_contact, new_linear_contact, &
      & new_rocker_contact

   !> State of the contact at one pivot deflection.
   type :: contact_point
      !> Normal force, N, and its derivative over the pivot deflection, N/m.
      real(wp) :: force = 0, stiffness = 0
      !> Projected contact radius, of a rocker half of the width, m; exponent of the pressure distribution (11);
      !> its peak (12), Pa.
      real(wp) :: radius = 0, exponent = 0.5_wp, peak_pressure = 0
   contains
      procedure :: pressure
   end type contact_point

   !> A law for one ball-and-socket pivot.
   type, abstract :: contact_law_type
      !> Socket radius R2 and radius difference dR = R2 - R1, m.
      real(wp) :: socket_radius, radius_difference
      !> k1 + k2 of eq (18), 1/Pa.
      real(wp) :: compliance
   contains
      !> The contact at a pivot deflection > 0, m.
      procedure(at_deflection), deferred :: at
      !> Pivot deflection, m, that carries a force, N.
      procedure :: pivot_deflection
   end type contact_law_type

   abstract interface
      pure function at_deflection(self, pivot_deflection) result(point)
         import :: contact_law_type, contact_point, wp
         class(contact_law_type), intent(in) :: self
         real(wp), intent(in) :: pivot_deflection
         type(contact_point) :: point
      end function at_deflection
   end interface

   !> Fang's conformal law; in its limit dR = 0 contact is over the whole socket, a linear spring.
   type, extends(contact_law_type) :: fang_law
      !> 4 in eq (13); 2 pi agrees with Hertz's approach.
      real(wp) :: deflection_factor
   contains
      procedure :: at => fang_at
   end type fang_law

   !> Hertz: F = 4/3 E* sqrt(R1 R2 / dR) eta^(3/2).
   type, extends(contact_law_type) :: hertz_law
   contains
      procedure :: at => hertz_at
   end type hertz_law

   !> dR / R2 below which the limit dR = 0 is taken.
   real(wp), parameter :: snug_ratio = 1e-9_wp
   !> Constant of eq (16); equals 4 (n + 1/2)(n + 1) at a = R2, so that dR = 0 gives a = R2.
   real(wp), parameter :: fang_constant = 3.8304_wp
   !> Of the approach of cylinders (Young and Budynas, Roark's Formulas for Stress and Strain, line contact).
   real(wp), parameter :: handbook = 2/3.0_wp
   !> Step of Newton's, relative, after which the next one would by its order be rounding.
   real(wp), parameter :: small_step = 1e-10_wp

   !> ln(eta) and ln(F) of the points, and the slopes there.
   type, extends(contact_law_type) :: measured_contact_type
      real(wp), allocatable :: x(:), y(:), slope(:)
   contains
      procedure :: at => measured_at
   end type measured_contact_type

   !> A cylinder of radius R1 in one of radius R2, along a line.
   type, extends(contact_law_type) :: rocker_contact_type
      !> m
      real(wp) :: length
      !> Pivot deflection at which the contact is as wide as R1, m: from there on the law is a straight line.
      real(wp) :: deepest = huge(1.0_wp)
   contains
      procedure :: at => rocker_at
   end type rocker_contact_type

   !> A spring: F = stiffness eta.
   type, extends(contact_law_type) :: linear_contact_type
      !> N/m.
      real(wp) :: stiffness
   contains
      procedure :: at => linear_at
   end type linear_contact_type

   !> ln of a force that is none, N.
   real(wp), parameter :: none = -600

contains

   !> The law called `name` ('fang' or 'hertz'; hertz needs dR > 0). No function: gfortran never frees the result of one
   !> whose type is chosen within.
   subroutine make_contact_law(name, socket_radius, radius_difference, young_modulus, &
      & poisson_ratio, deflection_factor, law)
      character(len=*), intent(in) :: name
      !> R2 and dR, m.
      real(wp), intent(in) :: socket_radius, radius_difference
      !> Of ball and socket; Pa and 1.
      real(wp), intent(in) :: young_modulus(2), poisson_ratio(2)
      !> Factor of eq (13).
      real(wp), intent(in) :: deflection_factor
      class(contact_law_type), allocatable, intent(out) :: law
      real(wp) :: compliance
      compliance = compliance_of(young_modulus, poisson_ratio)
      if (name == 'hertz') then
         law = hertz_law(socket_radius, radius_difference, compliance)
      else
         law = fang_law(socket_radius, radius_difference, compliance, deflection_factor)
      end if
   end subroutine make_contact_law

   !> k1 + k2 of eq (18).
   pure real(wp) function compliance_of(young_modulus, poisson_ratio) result(compliance)
      real(wp), intent(in) :: young_modulus(2), poisson_ratio(2)
      compliance = sum((1 - poisson_ratio**2)/(pi*young_modulus))
   end function compliance_of

   pure function hertz_at(self, pivot_deflection) result(point)
      class(hertz_law), intent(in) :: self
      real(wp), intent(in) :: pivot_deflection
      type(contact_point) :: point
      real(wp) :: effective_radius
      effective_radius = (self%socket_radius - self%radius_difference)*self%socket_radius &
         & /self%radius_difference
      point%force = 4/(3*pi*self%compliance)*sqrt(effective_radius*pivot_deflection)*pivot_deflection
      point%stiffness = 1.5_wp*point%force/pivot_deflection
      point%radius = sqrt(effective_radius*pivot_deflection)
      point%peak_pressure = 1.5_wp*point%force/(pi*point%radius**2)
   end function hertz_at

   !> The law of a rocker whose contact has this length, m; values of rocker and bore.
   pure type(rocker_contact_type) function new_rocker_contact(length, socket_radius, radius_difference, &
      & young_modulus, poisson_ratio) result(law)
      real(wp), intent(in) :: length, socket_radius, radius_difference, young_modulus(2), poisson_ratio(2)
      real(wp) :: ratio
      law = rocker_contact_type(socket_radius, radius_difference, compliance_of(young_modulus, poisson_ratio), length)
      ratio = 16*socket_radius/(socket_radius - radius_difference)
      law%deepest = radius_difference/ratio*(handbook + log(ratio))
   end function new_rocker_contact

   !> eta = x (2/3 + ln(dR/x)) with x = F (k1 + k2)/L, the handbook's approach of two cylinders in line contact: with
   !> q = eta/x it is q - ln q = 2/3 + ln(dR/eta), convex over q > 1, for which Newton's steps come from above. Width
   !> and pressure are those of Hertz.
   pure function rocker_at(self, pivot_deflection) result(point)
      class(rocker_contact_type), intent(in) :: self
      real(wp), intent(in) :: pivot_deflection
      type(contact_point) :: point
      real(wp) :: eta, at, q, change
      integer :: i
      eta = min(pivot_deflection, self%deepest)
      at = handbook + log(self%radius_difference/eta)
      q = at + log(at)
      do i = 1, 100
         change = (q - log(q) - at)*q/(q - 1)
         q = q - change
         if (abs(change) <= small_step*q) exit
      end do
      associate (x => eta/q, r1 => self%socket_radius - self%radius_difference)
         point%stiffness = self%length/(self%compliance*(q - 1))
         point%force = self%length*x/self%compliance + point%stiffness*(pivot_deflection - eta)
         point%radius = 2*sqrt(x*r1*self%socket_radius/self%radius_difference)
         point%peak_pressure = 2*point%force/(pi*point%radius*self%length)
      end associate
   end function rocker_at

   !> The law of a spring, N/m; radius and pressure of the contact are not known.
   pure type(linear_contact_type) function new_linear_contact(stiffness, socket_radius, radius_difference) result(law)
      real(wp), intent(in) :: stiffness, socket_radius, radius_difference
      law = linear_contact_type(socket_radius, radius_difference, 0.0_wp, stiffness)
   end function new_linear_contact

   pure function linear_at(self, pivot_deflection) result(point)
      class(linear_contact_type), intent(in) :: self
      real(wp), intent(in) :: pivot_deflection
      type(contact_point) :: point
      point%force = self%stiffness*pivot_deflection
      point%stiffness = self%stiffness
   end function linear_at

   !> Finds the contact radius of a pivot deflection by safeguarded Newton steps on ln(eta), which is monotone and
   !> nearly straight over ln(a), then takes the force from eq (13), which is well conditioned.
   pure function fang_at(self, pivot_deflection) result(point)
      class(fang_law), intent(in) :: self
      real(wp), intent(in) :: pivot_deflection
      type(contact_point) :: point
      real(wp) :: a, change, low, high, log_eta, d_log_eta, d_log_force
      integer :: i
      if (self%radius_difference <= snug_ratio*self%socket_radius) then
         point = force_over_radius(self, self%socket_radius, pivot_deflection)
         point%stiffness = point%force/pivot_deflection
         return
      end if
      low = 0
      high = self%socket_radius
      ! Hertz's, of whom this is the limit for a light contact
      a = min(0.5_wp*high, sqrt((high - self%radius_difference)*high/self%radius_difference*pivot_deflection))
      do i = 1, 200
         call radius_curve(self, a, log_eta, d_log_eta, d_log_force)
         if (log_eta > log(pivot_deflection)) then
            high = a
         else
            low = a
         end if
         ! beyond the unbounded force of eq (14) the derivative says nothing
         change = -huge(a)
         if (log_eta < huge(a)) change = (log(pivot_deflection) - log_eta)/(d_log_eta*a)
         call newton_step(change, low, high, a)
         if (abs(change) <= small_step) exit
      end do
      call radius_curve(self, a, log_eta, d_log_eta, d_log_force)
      point = force_over_radius(self, a, pivot_deflection)
      point%stiffness = point%force/pivot_deflection*d_log_force/d_log_eta
   end function fang_at

   !> Changes x > 0 by a step of ln(x), or where that leaves low to high, halves the interval.
   pure subroutine newton_step(change, low, high, x)
      real(wp), intent(in) :: change, low, high
      real(wp), intent(inout) :: x
      real(wp) :: next
      next = x*exp(change)
      if (abs(change) > small_step .and. (next <= low .or. next >= high)) next = 0.5_wp*(low + high)
      x = next
   end subroutine newton_step

   !> Eqs (12), (13), (15), (16) solved for the force at a contact radius and a pivot deflection.
   pure function force_over_radius(self, a, pivot_deflection) result(point)
      class(fang_law), intent(in) :: self
      real(wp), intent(in) :: a, pivot_deflection
      type(contact_point) :: point
      point%radius = a
      point%exponent = pressure_exponent(a/self%socket_radius)
      point%peak_pressure = pivot_deflection/(self%deflection_factor*self%compliance*exp(log_b(point%exponent))*a)
      point%force = point%peak_pressure*pi*a**2/(point%exponent + 1)
   end function force_over_radius

   !> ln(eta) at contact radius a, and the derivatives over a of ln(eta) and of ln(F).
   !> Beyond the radius where the force of eq (14) grows without bound, ln(eta) is huge.
   pure subroutine radius_curve(self, a, log_eta, d_log_eta, d_log_force)
      class(fang_law), intent(in) :: self
      real(wp), intent(in) :: a
      real(wp), intent(out) :: log_eta, d_log_eta, d_log_force
      real(wp) :: r1, r2, n, dn, ln_b, dlog_b, g, room, d_room, log_force
      r2 = self%socket_radius
      r1 = r2 - self%radius_difference
      n = pressure_exponent(a/r2)
      dn = (n - 0.5_wp)*15.08_wp/r2
      ln_b = log_b(n)
      dlog_b = dn*log_b_derivative(n)
      g = 2/pi + (a/r2)**2
      room = 4*r1*r2*(n + 0.5_wp)*(n + 1) - fang_constant*a**3/r2
      if (room <= 0) then
         log_eta = huge(a)
         d_log_eta = 1
         d_log_force = 1
         return
      end if
      d_room = 4*r1*r2*(2*n + 1.5_wp)*dn - 3*fang_constant*a**2/r2
      log_force = log(a**3*pi*g*self%radius_difference/(self%compliance*room)) - ln_b
      d_log_force = 3/a + 2*a/(r2**2*g) - d_room/room - dlog_b
      log_eta = log(self%deflection_factor*self%compliance*(n + 1)/(pi*a)) + ln_b + log_force
      d_log_eta = dlog_b + dn/(n + 1) + d_log_force - 1/a
   end subroutine radius_curve

   !> Eq (15).
   pure function pressure_exponent(radius_ratio) result(n)
      real(wp), intent(in) :: radius_ratio
      real(wp) :: n
      n = 0.5_wp - 0.24_wp*exp(-15.08_wp*(1 - radius_ratio))
   end function pressure_exponent

   !> ln B(n) of eq (16).
   pure function log_b(n)
      real(wp), intent(in) :: n
      real(wp) :: log_b
      log_b = log(sqrt(pi)/2) + log_gamma(n + 1) - log_gamma(n + 1.5_wp)
   end function log_b

   !> d ln B / dn.
   pure function log_b_derivative(n) result(derivative)
      real(wp), intent(in) :: n
      real(wp) :: derivative
      derivative = digamma(n + 1) - digamma(n + 1.5_wp)
   end function log_b_derivative

   !> Derivative of ln(Gamma) over x > 0: its recurrence up to 10, there its asymptotic series to rounding (Abramowitz
   !> and Stegun 1964, 6.3.5 and 6.3.18).
   pure function digamma(x)
      real(wp), intent(in) :: x
      real(wp) :: digamma, z, w
      digamma = 0
      z = x
      do while (z < 10)
         digamma = digamma - 1/z
         z = z + 1
      end do
      w = 1/z**2
      digamma = digamma + log(z) - 0.5_wp/z &
         & - w*(1/12.0_wp - w*(1/120.0_wp - w*(1/252.0_wp - w*(1/240.0_wp - w*(1/132.0_wp - w*691/32760)))))
   end function digamma

   !> Contact pressure (11), Pa, at a distance from the contact's axis, m, projected along it as the radius is.
   elemental real(wp) function pressure(self, r)
      class(contact_point), intent(in) :: self
      real(wp), intent(in) :: r
      pressure = 0
      if (abs(r) < self%radius) pressure = self%peak_pressure*(1 - (r/self%radius)**2)**self%exponent
   end function pressure

   !> Pivot deflection, m, that carries a force > 0, N, by safeguarded Newton steps on ln(F) over ln(eta).
   pure function pivot_deflection(self, force) result(eta)
      class(contact_law_type), intent(in) :: self
      real(wp), intent(in) :: force
      real(wp) :: eta, change, low, high
      type(contact_point) :: point
      integer :: i
      low = 1e-15_wp
      high = self%socket_radius
      eta = 1e-3_wp*high
      do i = 1, 100
         point = self%at(eta)
         if (point%force > force) then
            high = eta
         else
            low = eta
         end if
         change = (log(force) - log(point%force))*point%force/(point%stiffness*eta)
         call newton_step(change, low, high, eta)
         if (abs(change) <= small_step) exit
      end do
   end function pivot_deflection

   ! Normal force of a pivot as it was measured: points of force over pivot deflection, and between them the monotone
   ! cubic of Fritsch and Carlson (SIAM J. Numerical Analysis 17, 1980) through their logarithms, in which contact laws
   ! are nearly straight.

   !> The law through points (deflection, force), m and N, (2, point): two or more, both positive and rising. Below the
   !> first point it is the power law of the slope there, above the last one a straight line.
   pure function new_measured_contact(points, socket_radius, radius_difference) result(law)
      real(wp), intent(in) :: points(:, :), socket_radius, radius_difference
      type(measured_contact_type) :: law
      law%socket_radius = socket_radius
      law%radius_difference = radius_difference
      law%compliance = 0
      law%x = log(points(1, :))
      law%y = log(points(2, :))
      law%slope = monotone_slopes(law%x, law%y)
   end function new_measured_contact

   !> Slopes of the parabolas through three points each, limited so that the cubics between two points rise.
   pure function monotone_slopes(x, y) result(d)
      real(wp), intent(in) :: x(:), y(:)
      real(wp) :: d(size(x)), h(size(x) - 1), s(size(x) - 1), length
      integer :: i, n
      n = size(x)
      h = x(2:) - x(:n - 1)
      s = (y(2:) - y(:n - 1))/h
      d = s(1)
      if (n > 2) then
         d(2:n - 1) = (h(2:)*s(:n - 2) + h(:n - 2)*s(2:))/(h(:n - 2) + h(2:))
         d(1) = s(1) + (s(1) - s(2))*h(1)/(h(1) + h(2))
         d(n) = s(n - 1) + (s(n - 1) - s(n - 2))*h(n - 1)/(h(n - 1) + h(n - 2))
         if (.not. d(1) > 0) d(1) = s(1)
         if (.not. d(n) > 0) d(n) = s(n - 1)
      end if
      do i = 1, n - 1
         length = norm2(d(i:i + 1))/s(i)
         if (length > 3) d(i:i + 1) = d(i:i + 1)*3/length
      end do
   end function monotone_slopes

   !> Force and stiffness at a pivot deflection > 0, m; radius and pressure of the contact are not known.
   pure function measured_at(self, pivot_deflection) result(point)
      class(measured_contact_type), intent(in) :: self
      real(wp), intent(in) :: pivot_deflection
      type(contact_point) :: point
      real(wp) :: x, y, slope, t, width, rise
      integer :: low, high
      associate (n => size(self%x))
         x = log(pivot_deflection)
         if (x >= self%x(n)) then
            point%stiffness = self%slope(n)*exp(self%y(n) - self%x(n))
            point%force = exp(self%y(n)) + point%stiffness*(pivot_deflection - exp(self%x(n)))
            return
         end if
      end associate
      low = max(1, number_up_to(self%x, x))
      high = low + 1
      width = self%x(high) - self%x(low)
      rise = self%y(high) - self%y(low)
      t = max(0.0_wp, x - self%x(low))/width
      associate (first => self%slope(low)*width, last => self%slope(high)*width)
         y = self%y(low) + t*(first + t*(3*rise - 2*first - last + t*(first + last - 2*rise)))
         slope = (first + t*(2*(3*rise - 2*first - last) + t*3*(first + last - 2*rise)))/width
      end associate
      if (x < self%x(1)) y = max(none, y + slope*(x - self%x(1)))
      point%force = exp(y)
      point%stiffness = slope*point%force/pivot_deflection
   end function measured_at
end module contact_law
