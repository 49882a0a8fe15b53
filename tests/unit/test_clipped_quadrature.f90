!> Integrals over the positive part of a function: order, weights as slopes, no jumps as the crossing moves.
program test_clipped_quadrature
   use kinds, only: wp, pi
   use text, only: to_text
   use clipped_quadrature, only: gregory_weights, clipped_weights
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   if (runs('exact_for_cubics')) call exact_for_cubics()
   if (runs('order')) call order()
   if (runs('gregory')) call gregory()
   if (runs('weights_are_slopes')) call weights_are_slopes()
   if (runs('no_jumps')) call no_jumps()
   if (runs('nothing_positive')) call nothing_positive()
   call report()

contains

   !> The integral of max(f, 0) over nodes a step d apart.
   pure real(wp) function integral(f, d)
      real(wp), intent(in) :: f(:), d
      real(wp) :: weights(size(f))
      call clipped_weights(size(f) - 1, f, weights)
      integral = d*dot_product(weights, f)
   end function integral

   !> Cubics on the whole line are integrated exactly.
   subroutine exact_for_cubics()
      integer :: i, n
      do n = 3, 7
         call expect_close(integral([(1 + real(i, wp) + real(i, wp)**3, i=0, n)], 1.0_wp), &
            & n + n**2/2.0_wp + n**4/4.0_wp, 1e-12_wp*n**4, 'a cubic over '//to_text(n))
      end do
   end subroutine exact_for_cubics

   !> sin x - c over (0, pi), with x_c = asin c twice cos x_c - c (pi/2 - x_c). A cell integrates its cubic; the
   !> error of the formula is 11/720 d^5 of the fourth derivative, at most, in each.
   subroutine order()
      real(wp), parameter :: levels(3) = [0.1_wp, 0.45_wp, 0.83_wp]
      real(wp) :: exact, error
      integer :: k, i, n
      do k = 1, size(levels)
         associate (c => levels(k))
            exact = 2*(cos(asin(c)) - c*(pi/2 - asin(c)))
            n = 10
            do while (n <= 320)
               error = abs(integral([(sin(i*pi/n) - c, i=0, n)], pi/n) - exact)
               call expect(error < 11*pi/720*(pi/n)**4, 'error '//to_text(error)//' with '//to_text(n)//' cells')
               n = 2*n
            end do
         end associate
      end do
   end subroutine order

   !> Exact for powers up to the sixth, on lines as short as the formula.
   subroutine gregory()
      integer :: i, n, k
      do n = 6, 30, 4
         do k = 0, 6
            call expect_close(sum(gregory_weights(n)*[((real(i, wp)/n)**k, i=0, n)])/n, 1.0_wp/(k + 1), 1e-14_wp, &
               & 'power '//to_text(k)//' on '//to_text(n)//' cells')
         end do
      end do
   end subroutine gregory

   !> A change of f changes the integral by weights times the change: what is left is of the second order in
   !> the change, and in the error of the crossing.
   subroutine weights_are_slopes()
      integer, parameter :: n = 12
      real(wp), parameter :: h = 1e-6_wp
      real(wp) :: f(0:n), up(0:n), down(0:n), weights(0:n)
      integer :: i, j
      f = [(sin(i*pi/n) - 0.4_wp, i=0, n)]
      call clipped_weights(n, f, weights)
      do j = 0, n
         up = f
         up(j) = up(j) + h
         down = f
         down(j) = down(j) - h
         call expect_close((integral(up, 1.0_wp) - integral(down, 1.0_wp))/(2*h), weights(j), 1e-6_wp, &
            & 'slope over node '//to_text(j))
      end do
   end subroutine weights_are_slopes

   !> As the level moves through the nodes by 1e-4 the integral falls by at most 1e-4 times the length.
   subroutine no_jumps()
      integer, parameter :: n = 12, steps = 10000
      real(wp) :: now, before, largest, least
      integer :: i, k
      largest = 0
      least = 0
      before = integral([(sin(i*pi/n), i=0, n)], pi/n)
      do k = 1, steps
         now = integral([(sin(i*pi/n) - real(k, wp)/steps, i=0, n)], pi/n)
         largest = max(largest, before - now)
         least = min(least, before - now)
         before = now
      end do
      call expect(largest <= 1.001_wp*pi/steps, 'largest step '//to_text(largest))
      call expect(least >= -1e-2_wp*pi/steps, 'it rises nowhere by more than 1 % of that, by '//to_text(least))
      call expect_close(before, 0.0_wp, 1e-12_wp, 'nothing at the top')
   end subroutine no_jumps

   subroutine nothing_positive()
      call expect_close(integral([-1.0_wp, -2.0_wp, -1.0_wp, 0.0_wp, 0.0_wp], 1.0_wp), 0.0_wp, 0.0_wp, 'nothing')
   end subroutine nothing_positive
end program test_clipped_quadrature
