!> Normal force of a pivot as it was measured: points of force over pivot deflection, and between them the monotone
!> cubic of Fritsch and Carlson (SIAM J. Numerical Analysis 17, 1980) through their logarithms, in which contact laws
!> are nearly straight.
module measured_contact
   use kinds, only: wp
   use contact_law, only: contact_law_type, contact_point
   implicit none (type, external)
   private
   public :: new_measured_contact

   !> ln(eta) and ln(F) of the points, and the slopes there.
   type, extends(contact_law_type) :: measured_contact_type
      real(wp), allocatable :: x(:), y(:), slope(:)
   contains
      procedure :: at => measured_at
   end type measured_contact_type

   !> ln of a force that is none, N.
   real(wp), parameter :: none = -600

contains

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
      integer :: low, high, middle
      associate (n => size(self%x))
         x = log(pivot_deflection)
         if (x >= self%x(n)) then
            point%stiffness = self%slope(n)*exp(self%y(n) - self%x(n))
            point%force = exp(self%y(n)) + point%stiffness*(pivot_deflection - exp(self%x(n)))
            return
         end if
         low = 1
         high = n
      end associate
      do while (high - low > 1)
         middle = (low + high)/2
         if (x < self%x(middle)) then
            high = middle
         else
            low = middle
         end if
      end do
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
end module measured_contact
