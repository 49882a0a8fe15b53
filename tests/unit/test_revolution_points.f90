!> Points once a revolution of motions whose rotation number is known.
program test_revolution_points
   use kinds, only: wp, pi
   use revolution_points, only: revolution_points_type, describe_points, amplitude_at, agreement, disagreement, &
      & steady_ring
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   !> Turns in a revolution that no fraction is near to, and the clearance.
   real(wp), parameter :: golden = 0.6180339887498949_wp, clearance = 1

   if (runs('torus')) call torus()
   if (runs('slow')) call slow()
   if (runs('backward')) call backward()
   if (runs('locked')) call locked()
   if (runs('repeats')) call repeats()
   if (runs('twice')) call twice()
   if (runs('spiral')) call spiral()
   if (runs('chaos')) call chaos()
   if (runs('amplitude')) call amplitude()
   call report()

contains

   !> What n points say whose angle goes on by this part of a turn: on an ellipse with a dent, away from the origin.
   function ring(turns, n, decay, winds) result(found)
      real(wp), intent(in) :: turns
      integer, intent(in) :: n
      real(wp), intent(in), optional :: decay
      integer, intent(in), optional :: winds
      type(revolution_points_type) :: found
      complex(wp) :: points(n), along
      integer :: k
      do k = 1, n
         along = exp(cmplx(0, 2*pi*turns*k, wp))
         points(k) = 0.1_wp*along + 0.03_wp*conjg(along) + 0.01_wp*along**2
         if (present(winds)) points(k) = 0.1_wp*along**winds*(1 + 0.6_wp*along%re)
         if (present(decay)) points(k) = points(k)*decay**k
         points(k) = points(k) + (0.4_wp, -0.2_wp)
      end do
      found = describe_points(points%re, points%im, clearance, 1.0_wp)
   end function ring

   subroutine torus()
      type(revolution_points_type) :: found
      found = ring(golden, 500)
      call expect(found%on_torus .and. found%repeats_after == 0, 'a torus')
      call expect_close(found%rotation, golden, 1e-9_wp, 'its rotation number')
      found = ring(golden, 40)
      call expect(found%difference > agreement .and. .not. found%on_torus, 'few points leave it open')
   end subroutine torus

   !> Turns near to whole ones count from where they begin.
   subroutine slow()
      type(revolution_points_type) :: found
      found = ring(-0.0123456_wp, 2000)
      call expect(found%on_torus, 'a slow torus')
      call expect_close(found%rotation, 1 - 0.0123456_wp, 1e-8_wp, 'its rotation number')
   end subroutine slow

   !> In a bearing whose shaft turns the other way.
   subroutine backward()
      type(revolution_points_type) :: found
      real(wp) :: angle(300)
      integer :: k
      angle = [(2*pi*golden*k, k=1, size(angle))]
      found = describe_points(cos(angle), -sin(angle), clearance, -1.0_wp)
      call expect_close(found%rotation, golden, 1e-9_wp, 'in the sense of the shaft')
   end subroutine backward

   subroutine locked()
      type(revolution_points_type) :: found
      found = ring(3/7.0_wp, 100)
      call expect(found%repeats_after == 7 .and. .not. found%on_torus, 'it repeats after seven revolutions')
      call expect_close(found%rotation, 3/7.0_wp, 1e-7_wp, 'its rotation number')
      found = ring(3/7.0_wp + 0.5_wp*agreement, 4000)
      call expect(found%repeats_after == 7, 'so near to it that it is the same')
   end subroutine locked

   subroutine repeats()
      type(revolution_points_type) :: found
      found = ring(golden, 200, decay=0.9_wp)
      call expect(found%repeats_after == 1, 'it has come to an orbit')
   end subroutine repeats

   !> The angle of a section that winds twice about its centre tells nothing.
   subroutine twice()
      type(revolution_points_type) :: found
      found = ring(golden, 500, winds=2)
      call expect(found%rotation < 0 .and. .not. found%on_torus .and. found%repeats_after == 0, 'no rotation number')
      call expect(found%growth < steady_ring, 'but a ring that stays')
   end subroutine twice

   !> What decays slowly turns as evenly as a torus.
   subroutine spiral()
      type(revolution_points_type) :: found
      found = ring(golden, 500, decay=0.9998_wp)
      call expect(found%difference < disagreement .and. found%growth > steady_ring, 'it shows by its size alone')
      call expect(.not. found%on_torus, 'no torus')
   end subroutine spiral

   !> Henon's map.
   subroutine chaos()
      type(revolution_points_type) :: found
      real(wp) :: x(500), y(500)
      integer :: k
      x(1) = 0.1_wp
      y(1) = 0.1_wp
      do k = 2, size(x)
         x(k) = 1 - 1.4_wp*x(k - 1)**2 + y(k - 1)
         y(k) = 0.3_wp*x(k - 1)
      end do
      found = describe_points(x, y, clearance, 1.0_wp)
      call expect(found%repeats_after == 0 .and. .not. found%on_torus, 'neither torus nor orbit')
      call expect(found%rotation < 0 .or. found%difference > disagreement, 'no rotation number')
   end subroutine chaos

   subroutine amplitude()
      real(wp) :: angle(6001), values(6001)
      integer :: k
      angle = [(2*pi*k/60, k=0, 6000)]
      values = 3 + 0.5_wp*cos(angle) + 0.2_wp*cos(golden*angle + 1) + 0.01_wp*sin((1 - golden)*angle)
      call expect_close(amplitude_at(golden, angle, values), 0.2_wp, 1e-7_wp, 'the second frequency')
      call expect_close(amplitude_at(1 - golden, angle, values), 0.01_wp, 1e-7_wp, 'its sideband')
   end subroutine amplitude
end program test_revolution_points
