!> To which side of a Hopf point its small limit cycles lie: the sign of the first Lyapunov coefficient (Kuznetsov,
!> Elements of Applied Bifurcation Theory, 3.5 and 5.4), with differences of the rates for their second and third
!> derivatives.
module first_lyapunov
   use kinds, only: wp
   use linear_algebra, only: find_eigenvalues, solve, solve_complex, identity
   use ode_model, only: ode_model_type
   implicit none (type, external)
   private
   public :: first_lyapunov_coefficient

   !> Longest change of a state in a difference, over its scale. Of a lemon bore on volumes with Reynolds' condition,
   !> whose force leaps, the coefficient keeps a tenth of itself in noise; with half the change it is lost.
   real(wp), parameter :: longest = 0.01_wp

contains

   !> The vibration of this eigenvalue, 1/s, about the place of rest y: below 0 where its cycles lie on the unstable
   !> side, and 0 where that is not found. Extrapolated to differences of no length.
   real(wp) function first_lyapunov_coefficient(model, y, scale, eigenvalue) result(coefficient)
      class(ode_model_type), intent(inout) :: model
      real(wp), intent(in) :: y(:), scale(:)
      complex(wp), intent(in) :: eigenvalue
      real(wp), dimension(size(y)) :: rates
      real(wp) :: matrix(size(y), size(y)), h, twice
      complex(wp), dimension(size(y)) :: q, p
      integer :: n
      logical :: ok
      coefficient = 0
      n = size(y)
      call model%rhs_and_jacobian(0.0_wp, y, rates, matrix, ok)
      if (.not. ok) return
      rates = rates/scale
      matrix = matrix*spread(scale, 1, n)/spread(scale, 2, n)
      call find_vibration(matrix, eigenvalue, q, ok)
      if (ok) call find_vibration(transpose(matrix), conjg(eigenvalue), p, ok)
      if (.not. ok) return
      q = q/maxval(abs(q))
      p = p/conjg(dot_product(p, q))
      h = 2*longest
      call find_coefficient(twice)
      h = longest
      call find_coefficient(coefficient)
      coefficient = coefficient + (coefficient - twice)/3
      if (.not. ok) coefficient = 0
   contains
      !> That of differences of this length; `ok` becomes false where it is not found.
      subroutine find_coefficient(of_h)
         real(wp), intent(out) :: of_h
         real(wp), dimension(n) :: aa, bb, aaa, bbb, plus, minus
         real(wp) :: copy(n, n), even(n, 1)
         complex(wp) :: total(n), shifted(n, n), double(n, 1)
         logical :: solved(2)
         associate (a => q%re, b => q%im)
            aa = second(a)
            bb = second(b)
            aaa = third(a)
            bbb = third(b)
            plus = third(a + b)
            minus = third(a - b)
            copy = matrix
            even(:, 1) = aa + bb
            call solve(n, 1, copy, even, solved(1))
            double(:, 1) = cmplx(aa - bb, 2*mixed(a, b), wp)
            shifted = cmplx(0, 2*eigenvalue%im, wp)*identity(n) - matrix
            call solve_complex(n, 1, shifted, double, solved(2))
            ok = ok .and. all(solved)
            of_h = 0
            if (.not. ok) return
            ! the third derivative along q twice and its conjugate, and what the vibration's second harmonic and mean
            ! add to it
            total = cmplx(aaa + ((plus + minus)/2 - aaa)/3, bbb + ((plus - minus)/2 - bbb)/3, wp)
            total = total - 2*cmplx(mixed(a, even(:, 1)), mixed(b, even(:, 1)), wp)
            associate (c => double(:, 1)%re, d => double(:, 1)%im)
               total = total + cmplx(mixed(a, c) + mixed(b, d), mixed(a, d) - mixed(b, c), wp)
            end associate
         end associate
         of_h = real(dot_product(p, total), wp)/abs(eigenvalue%im)
      end subroutine find_coefficient

      !> The rates at a change of the state, over the scales.
      function rates_at(change)
         real(wp), intent(in) :: change(:)
         real(wp) :: rates_at(n)
         logical :: there
         call model%rhs(0.0_wp, y + scale*change, rates_at, there)
         rates_at = rates_at/scale
         ok = ok .and. there
      end function rates_at

      !> Derivatives twice and three times along a direction, and along two.
      function second(u)
         real(wp), intent(in) :: u(:)
         real(wp) :: second(n), step
         step = h/max(maxval(abs(u)), tiny(h))
         second = (rates_at(step*u) + rates_at(-step*u) - 2*rates)/step**2
      end function second

      function third(u)
         real(wp), intent(in) :: u(:)
         real(wp) :: third(n), step
         step = h/max(maxval(abs(u)), tiny(h))
         third = (rates_at(2*step*u) - 2*rates_at(step*u) + 2*rates_at(-step*u) - rates_at(-2*step*u))/(2*step**3)
      end function third

      function mixed(u, v)
         real(wp), intent(in) :: u(:), v(:)
         real(wp) :: mixed(n), ratio
         ! both as large
         ratio = maxval(abs(u))/max(maxval(abs(v)), tiny(h))
         mixed = (second(u + ratio*v) - second(u - ratio*v))/(4*ratio)
      end function mixed
   end function first_lyapunov_coefficient

   !> The eigenvector of a matrix whose eigenvalue is next to this one.
   subroutine find_vibration(matrix, eigenvalue, vector, ok)
      real(wp), intent(in) :: matrix(:, :)
      complex(wp), intent(in) :: eigenvalue
      complex(wp), intent(out) :: vector(:)
      logical, intent(out) :: ok
      complex(wp) :: values(size(vector)), vectors(size(vector), size(vector))
      call find_eigenvalues(matrix, values, ok, vectors)
      if (ok) vector = vectors(:, minloc(abs(values - eigenvalue), dim=1))
   end subroutine find_vibration
end module first_lyapunov
