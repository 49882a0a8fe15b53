!> Contact from measured points: laws given as points come back, what rises stays rising, slopes are derivatives.
program test_measured_contact
   use kinds, only: wp
   use text, only: to_text
   use contact_law, only: contact_law_type, contact_point, new_measured_contact
   use paper_bearing, only: paper_law
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   !> Where points are taken, m.
   real(wp), parameter :: lowest = 1e-8_wp, highest = 1e-4_wp

   if (runs('fang')) call fang()
   if (runs('power')) call power()
   if (runs('steps')) call steps()
   if (runs('ends')) call ends()
   call report()

contains

   !> This number of points of Fang's law, at equal steps of the logarithm.
   function points_of(law, n) result(points)
      class(contact_law_type), intent(in) :: law
      integer, intent(in) :: n
      real(wp) :: points(2, n)
      type(contact_point) :: point
      integer :: i
      do i = 1, n
         points(1, i) = lowest*(highest/lowest)**(real(i - 1, wp)/(n - 1))
         point = law%at(points(1, i))
         points(2, i) = point%force
      end do
   end function points_of

   !> Largest error of the force between the points, over the force.
   real(wp) function error_of(law, n)
      class(contact_law_type), intent(in) :: law
      integer, intent(in) :: n
      class(contact_law_type), allocatable :: measured
      type(contact_point) :: found, true
      real(wp) :: eta
      integer :: i
      allocate (measured, source=new_measured_contact(points_of(law, n), 13e-3_wp, 15e-6_wp))
      error_of = 0
      do i = 1, 3000
         eta = lowest*(highest/lowest)**((i - 0.5_wp)/3000)
         found = measured%at(eta)
         true = law%at(eta)
         error_of = max(error_of, abs(found%force/true%force - 1))
      end do
   end function error_of

   !> Fang's law from 200 points in a decade; slopes are those of parabolas, so that the error is of the third order.
   subroutine fang()
      real(wp) :: coarse, fine
      class(contact_law_type), allocatable :: law
      law = paper_law('fang', 15e-6_wp)
      coarse = error_of(law, 401)
      fine = error_of(law, 801)
      call expect(fine < 1e-6_wp, 'Fang''s law: '//to_text(fine))
      call expect(coarse/fine > 6, 'of the third order: '//to_text(coarse/fine))
   end subroutine fang

   !> Three points of a power law tell all of it, also below them.
   subroutine power()
      class(contact_law_type), allocatable :: measured
      type(contact_point) :: point
      real(wp), parameter :: eta(3) = [1e-6_wp, 3e-6_wp, 2e-5_wp], places(4) = [1e-9_wp, 2e-6_wp, 1e-5_wp, 2e-5_wp]
      integer :: i
      allocate (measured, source=new_measured_contact(reshape([(eta(i), 1e12_wp*eta(i)**1.5_wp, i=1, 3)], [2, 3]), &
         & 13e-3_wp, 15e-6_wp))
      do i = 1, size(places)
         associate (force => 1e12_wp*places(i)**1.5_wp)
            point = measured%at(places(i))
            call expect_close(point%force, force, 1e-12_wp*force, 'force at '//to_text(places(i)))
            call expect_close(point%stiffness, 1.5_wp*force/places(i), 1e-12_wp*force/places(i), 'stiffness')
            call expect_close(measured%pivot_deflection(force), places(i), 1e-9_wp*places(i), 'pivot deflection')
         end associate
      end do
   end subroutine power

   !> Points with steps and flat stretches: between two of them the force never leaves theirs, and its slope, never
   !> negative, is the derivative.
   subroutine steps()
      class(contact_law_type), allocatable :: measured
      type(contact_point) :: point, up, down
      real(wp), parameter :: eta(6) = [1e-6_wp, 2e-6_wp, 3e-6_wp, 4e-6_wp, 5e-6_wp, 9e-6_wp], &
         & force(6) = [1.0_wp, 1.01_wp, 1e3_wp, 1.001e3_wp, 1.1e3_wp, 9e3_wp], h = 1e-6_wp
      real(wp) :: x
      integer :: i, k
      allocate (measured, source=new_measured_contact(reshape([(eta(i), force(i), i=1, 6)], [2, 6]), 13e-3_wp, &
         & 15e-6_wp))
      do i = 1, 5
         do k = 1, 99
            x = eta(i) + k*(eta(i + 1) - eta(i))/100
            point = measured%at(x)
            up = measured%at(x*(1 + h))
            down = measured%at(x*(1 - h))
            call expect(point%force >= force(i)*(1 - 1e-12_wp) .and. point%force <= force(i + 1)*(1 + 1e-12_wp), &
               & 'no overshoot at '//to_text(x))
            call expect(point%stiffness >= 0, 'it does not fall at '//to_text(x))
            ! h**2/6 of the third derivative, over the steep step's slope, and rounding
            call expect_close((up%force - down%force)/(2*h*x), point%stiffness, 1e-8_wp*point%stiffness &
               & + 1e-9_wp*point%force/x, 'slope at '//to_text(x))
         end do
      end do
   end subroutine steps

   !> Two points are enough; above the last the law is a straight line, and far below the first there is a number.
   subroutine ends()
      class(contact_law_type), allocatable :: measured
      type(contact_point) :: last, beyond, low
      allocate (measured, source=new_measured_contact(reshape([1e-6_wp, 1e2_wp, 2e-6_wp, 1e6_wp], [2, 2]), 13e-3_wp, &
         & 15e-6_wp))
      last = measured%at(2e-6_wp)
      beyond = measured%at(6e-6_wp)
      call expect_close(beyond%force, last%force + 4e-6_wp*last%stiffness, 1e-9_wp*beyond%force, 'a line')
      call expect_close(beyond%stiffness, last%stiffness, 1e-12_wp*last%stiffness, 'its slope')
      low = measured%at(1e-300_wp)
      call expect(low%force > 0 .and. low%force < 1e-200_wp, 'nearly nothing')
   end subroutine ends
end program test_measured_contact
