!> The conformal contact between its limits: Hertz where the contact is small, a linear spring where ball
!> and socket fit; energy of the tabulated contact.
program test_contact_limits
   use kinds, only: wp, pi
   use text, only: to_text
   use contact_law, only: contact_law_type, contact_point
   use contact_table, only: contact_table_type, new_contact_table
   use paper_bearing, only: paper_law
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   real(wp), parameter :: socket = 13e-3_wp

   if (runs('hertz_limit')) then
      call hertz_limit(15e-6_wp)
      call hertz_limit(1e-3_wp)
   end if
   if (runs('printed_factor')) call printed_factor()
   if (runs('snug_limit')) call snug_limit()
   if (runs('order_of_differences')) call order_of_differences()
   if (runs('stored_energy')) call stored_energy()
   call report()

contains

   !> With the factor 2 pi, a small contact is Hertz's. By (13), F = eta a/(2 k B (n + 1)), and by (14)
   !> a**2 (g dR + C)/dR is Hertz's a**2 2/pi, with g = 2/pi + (a/R2)**2 and C/dR = 1.28/pi ... (a/R2)**3:
   !> the force falls short by pi/4 (a/R2)**2 and terms of the third order, and n -> 1/2 within
   !> 0.24 exp(-15.08 (1 - a/R2)), 1e-7.
   subroutine hertz_limit(difference)
      real(wp), intent(in) :: difference
      class(contact_law_type), allocatable :: fang, hertz
      type(contact_point) :: f, h
      real(wp) :: eta, ratio, deficit
      integer :: k
      fang = paper_law('fang', difference, 2*pi)
      hertz = paper_law('hertz', difference, 2*pi)
      do k = 0, 5
         ! contact radii of 4 to 0.1 hundredths of the socket's
         ratio = 0.04_wp/2**k
         eta = (ratio*socket)**2*difference/(socket*(socket - difference))
         f = fang%at(eta)
         h = hertz%at(eta)
         deficit = 1 - f%force/h%force
         call expect_close(deficit, 0.25_wp*pi*ratio**2, ratio**3 + 3e-7_wp, 'Hertz''s force at a/R2 = ' &
            & //to_text(ratio))
         call expect_close(f%radius/h%radius, 1.0_wp, ratio**2, 'Hertz''s radius at a/R2 = '//to_text(ratio))
         call expect_close(f%peak_pressure/h%peak_pressure, 1.0_wp, ratio**2 + 3e-7_wp, &
            & 'Hertz''s pressure at a/R2 = '//to_text(ratio))
         call expect_close(f%exponent, 0.5_wp, 0.24_wp*exp(-15.08_wp*(1 - ratio)), 'n -> 1/2')
      end do
   end subroutine hertz_limit

   !> The factor scales the pivot deflection and nothing else: with 4 as printed a load sinks 2/pi as deep as
   !> with 2 pi. Bisections end at rounding.
   subroutine printed_factor()
      class(contact_law_type), allocatable :: printed, consistent
      integer :: e
      printed = paper_law('fang', 15e-6_wp)
      consistent = paper_law('fang', 15e-6_wp, 2*pi)
      do e = -3, 6
         call expect_close(printed%pivot_deflection(10.0_wp**e)/consistent%pivot_deflection(10.0_wp**e), 2/pi, &
            & 1e-13_wp, 'printed over consistent factor at 1e'//to_text(e)//' N')
      end do
   end subroutine printed_factor

   !> dR -> 0 at one pivot deflection: the force tends to the linear spring's, its distance falling with dR
   !> itself once g dR is well below C of (16), 2e-6 m here; a tenth for the next order.
   subroutine snug_limit()
      class(contact_law_type), allocatable :: law, snug
      type(contact_point) :: point, limit
      real(wp) :: gap(8:10)
      integer :: e
      snug = paper_law('fang', 0.0_wp)
      limit = snug%at(3e-6_wp)
      do e = 8, 10
         law = paper_law('fang', 10.0_wp**(-e))
         point = law%at(3e-6_wp)
         gap(e) = 1 - point%force/limit%force
         call expect(gap(e) > 0, 'any gap is softer than none')
      end do
      call expect(gap(8) < 1e-2_wp, 'close to the snug limit at dR = 1e-8: '//to_text(gap(8)))
      call expect_close(gap(8)/gap(9), 10.0_wp, 1.0_wp, 'first order in dR')
      call expect_close(gap(9)/gap(10), 10.0_wp, 0.1_wp, 'first order in dR, further down')
      ! the law changes over at dR = 1e-9 R2: no step but the law's own slope there
      law = paper_law('fang', 1.001e-9_wp*socket)
      point = law%at(3e-6_wp)
      call expect_close(point%force/limit%force, 1.0_wp, 1.01_wp*gap(10)*0.13_wp, 'no step where the limit is taken')
   end subroutine snug_limit

   !> A looser fit is softer at every load (the paper's Fig. 4).
   subroutine order_of_differences()
      real(wp), parameter :: differences(*) = [0.0_wp, 1e-6_wp, 15e-6_wp, 30e-6_wp, 100e-6_wp, 1e-3_wp]
      class(contact_law_type), allocatable :: law
      real(wp) :: depth(size(differences))
      integer :: e, k
      do e = 0, 6
         do k = 1, size(differences)
            law = paper_law('fang', differences(k))
            depth(k) = law%pivot_deflection(10.0_wp**e)
         end do
         call expect(all(depth(2:) > depth(:size(depth) - 1)), 'looser is deeper at 1e'//to_text(e)//' N')
      end do
   end subroutine order_of_differences

   !> The work of pressing in, integrated from the table, is Hertz's 2/5 F eta, and 1/2 F eta of a spring.
   subroutine stored_energy()
      class(contact_law_type), allocatable :: hertz, snug
      type(contact_table_type) :: hertz_table, snug_table
      real(wp) :: force, slope, eta
      integer :: k
      hertz = paper_law('hertz', 15e-6_wp)
      snug = paper_law('fang', 0.0_wp)
      hertz_table = new_contact_table(hertz)
      snug_table = new_contact_table(snug)
      do k = 1, 4
         eta = 3e-6_wp*k
         call hertz_table%lookup(eta, force, slope)
         call expect_close(work(hertz_table, eta)/(force*eta), 0.4_wp, 1e-6_wp, 'energy of a Hertz contact')
         call snug_table%lookup(eta, force, slope)
         call expect_close(work(snug_table, eta)/(force*eta), 0.5_wp, 1e-7_wp, 'energy of a spring')
      end do
   end subroutine stored_energy

   !> Midpoint rule in s with eta = s**2 depth: the integrand is at most 2 s**4 F eta, the error
   !> 1/(24*2000**2) of its slope at the end, 8e-8; the table itself is good to 1e-6 where it is not linear.
   real(wp) function work(table, depth)
      type(contact_table_type), intent(in) :: table
      real(wp), intent(in) :: depth
      integer, parameter :: n = 2000
      real(wp) :: s, force, slope
      integer :: k
      work = 0
      do k = 1, n
         s = (k - 0.5_wp)/n
         call table%lookup(s**2*depth, force, slope)
         work = work + force*2*s*depth/n
      end do
   end function work
end program test_contact_limits
