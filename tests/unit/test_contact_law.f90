!> Contact laws and their table: limits (Hertz where the contact is small, a linear spring where ball and socket fit),
!> slopes, inverse. That the pressure carries the force is for tests/post/test_library.py.
program test_contact_law
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_invalid
   use kinds, only: wp, pi
   use text, only: to_text
   use contact_law, only: contact_law_type, contact_point, make_contact_law, new_linear_contact, new_rocker_contact
   use paper_bearing, only: paper_law
   use contact_table, only: contact_table_type, new_contact_table, new_untabulated_contact
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   real(wp), parameter :: socket = 13e-3_wp, young(2) = 2.1e11_wp, poisson(2) = 0.3_wp
   !> k1 + k2 of eq (18).
   real(wp), parameter :: k12 = 2*(1 - 0.3_wp**2)/(pi*2.1e11_wp)
   real(wp), parameter :: differences(*) = [1e-7_wp, 1e-6_wp, 15e-6_wp, 30e-6_wp, 1e-3_wp]
   integer :: i
   !> Ends of the table, m.
   real(wp), parameter :: low_end = 2.0_wp**(-40), high_end = 2.0_wp**(-6)
   real(wp), parameter :: tabulated(*) = [0.0_wp, 1e-8_wp, 1e-6_wp, 15e-6_wp, 30e-6_wp, 1e-3_wp]

   if (runs('check_values')) call check_values()
   if (runs('snug_is_linear')) call snug_is_linear()
   if (runs('hertz_closed_form')) call hertz_closed_form()
   if (runs('spring')) call spring()
   if (runs('rocker')) call rocker()
   if (runs('unequal_materials')) call unequal_materials()
   do i = 1, size(differences)
      if (runs('printed_equations')) call printed_equations(differences(i))
      if (runs('slopes')) call slopes('fang', differences(i))
      if (runs('inverse')) call inverse('fang', differences(i))
   end do
   if (runs('slopes')) call slopes('hertz', 15e-6_wp)
   if (runs('inverse')) call inverse('hertz', 15e-6_wp)
   if (runs('slopes')) call slopes('fang', 0.0_wp)
   if (runs('inverse')) call inverse('fang', 0.0_wp)
   if (runs('hertz_limit')) then
      call hertz_limit(15e-6_wp)
      call hertz_limit(1e-3_wp)
   end if
   if (runs('snug_limit')) call snug_limit()
   do i = 1, size(tabulated)
      if (runs('one_table')) call one_table('fang', tabulated(i))
   end do
   if (runs('one_table')) call one_table('hertz', 15e-6_wp)
   call report()

contains

   !> Values of an independent solution, to the digits it gives.
   subroutine check_values()
      class(contact_law_type), allocatable :: law
      type(contact_point) :: point
      real(wp) :: eta
      law = paper_law('fang', 15e-6_wp)
      eta = law%pivot_deflection(1e4_wp)
      point = law%at(eta)
      call expect_close(eta, 5.5191e-6_wp, 0.5e-10_wp, 'pivot deflection at 10 kN, dR = 15 um')
      call expect_close(point%radius/socket, 0.5767_wp, 0.5e-4_wp, 'contact radius at 10 kN, dR = 15 um')
      law = paper_law('fang', 30e-6_wp)
      call expect_close(law%pivot_deflection(1e4_wp), 6.5867e-6_wp, 0.5e-10_wp, 'pivot deflection at 10 kN, dR = 30 um')
   end subroutine check_values

   !> dR = 0: a = R2 at any load, so n = 0.26 and eq (13) with (12) is a line.
   subroutine snug_is_linear()
      class(contact_law_type), allocatable :: law
      type(contact_point) :: point
      real(wp), parameter :: n = 0.26_wp
      real(wp) :: b, stiffness
      integer :: e
      law = paper_law('fang', 0.0_wp)
      b = 0.5_wp*sqrt(pi)*gamma(n + 1)/gamma(n + 1.5_wp)
      stiffness = pi*socket/(4*k12*b*(n + 1))
      do e = -12, -3
         point = law%at(10.0_wp**e)
         ! a gamma function and some products
         call expect_close(point%force*10.0_wp**(-e), stiffness, 1e-13_wp*stiffness, 'force at dR = 0, 1e'//to_text(e))
         call expect_close(point%force*10.0_wp**(-e), 3.3767e9_wp, 0.5e5_wp, 'stiffness at dR = 0, 1e'//to_text(e))
         call expect_close(point%stiffness, stiffness, 1e-13_wp*stiffness, 'slope at dR = 0, 1e'//to_text(e))
         call expect_close(point%radius, socket, 0.0_wp, 'contact over the whole socket, 1e'//to_text(e))
      end do
   end subroutine snug_is_linear

   subroutine hertz_closed_form()
      class(contact_law_type), allocatable :: law
      type(contact_point) :: point
      real(wp) :: modulus, radius, eta
      integer :: e
      law = paper_law('hertz', 15e-6_wp)
      modulus = 1/(pi*k12)
      radius = (socket - 15e-6_wp)*socket/15e-6_wp
      do e = -12, -4
         eta = 3*10.0_wp**e
         point = law%at(eta)
         call expect_close(point%force, 4*modulus/3*sqrt(radius)*eta**1.5_wp, 1e-14_wp*point%force, &
            & 'Hertz force, 3e'//to_text(e))
         call expect_close(point%stiffness, 2*modulus*sqrt(radius*eta), 1e-14_wp*point%stiffness, &
            & 'Hertz stiffness, 3e'//to_text(e))
         call expect_close(point%radius**2, radius*eta, 1e-14_wp*radius*eta, 'Hertz radius, 3e'//to_text(e))
         call expect_close(point%peak_pressure, 2*modulus/pi*sqrt(eta/radius), 1e-14_wp*point%peak_pressure, &
            & 'Hertz pressure, 3e'//to_text(e))
      end do
   end subroutine hertz_closed_form

   !> A spring is one at every deflection, with and without a table.
   subroutine spring()
      type(contact_table_type) :: plain, table
      real(wp), parameter :: stiffness = 5e8_wp
      real(wp) :: x, force, slope
      integer :: e, k
      plain = new_untabulated_contact(new_linear_contact(stiffness, socket, 15e-6_wp))
      table = new_contact_table(plain%law)
      do e = -15, 1
         x = 3*10.0_wp**e
         do k = 1, 2
            if (k == 1) call plain%lookup(x, force, slope)
            if (k == 2) call table%lookup(x, force, slope)
            call expect_close(force, stiffness*x, 1e-13_wp*stiffness*x, 'force of a spring, 3e'//to_text(e))
            call expect_close(slope, stiffness, 1e-12_wp*stiffness, 'its stiffness, 3e'//to_text(e))
         end do
      end do
      call expect_close(plain%law%pivot_deflection(1e4_wp), 2e-5_wp, 1e-14_wp*2e-5_wp, 'deflection of a spring')
   end subroutine spring

   !> A rocker meets the equations as handbook and paper print them, with diameters: the approach to rounding, width and
   !> pressure of Hertz, and the stiffness of Kirk and Reedy within what the rounded 2.15 of steel leaves, 3e-3 in a
   !> logarithm of 4 and more. The approach of two half planes from the contact to the axes (Johnson 1985, eq 4.57)
   !> has 2 ln 2 - 1 where the handbook has 2/3, no more than 6 % of it.
   subroutine rocker()
      class(contact_law_type), allocatable :: law
      type(contact_table_type) :: table
      type(contact_point) :: point, up, down
      real(wp), parameter :: length = 0.05_wp, d1 = 40e-3_wp, d2 = 50e-3_wp, h = 1e-5_wp
      real(wp) :: eta, force, slope, width, modulus, johnson
      integer :: e
      character(len=:), allocatable :: at
      allocate (law, source=new_rocker_contact(length, 0.5_wp*d2, 0.5_wp*(d2 - d1), young, poisson))
      table = new_contact_table(law)
      modulus = young(1)/(1 - poisson(1)**2)
      do e = 0, 6
         at = ' at 1e'//to_text(e)//' N'
         force = 10.0_wp**e
         eta = law%pivot_deflection(force)
         point = law%at(eta)
         width = 2*point%radius
         call expect_close(point%force, force, 1e-12_wp*force, 'inverse of the rocker'//at)
         call expect_close(2*force/(pi*modulus*length)*(2/3.0_wp + log(2*d1/width) + log(2*d2/width)), eta, &
            & 1e-12_wp*eta, 'approach of the handbook'//at)
         call expect_close(point%radius**2, 4*force*d1*d2/(pi*length*modulus*(d2 - d1)), 1e-12_wp*point%radius**2, &
            & 'width of Hertz'//at)
         call expect_close(point%peak_pressure, 2*force/(pi*point%radius*length), 1e-12_wp*point%peak_pressure, &
            & 'pressure of Hertz'//at)
         call expect_close(point%stiffness, 0.5_wp*pi*modulus*length/(log(4*young(1)*length*(d2 - d1) &
            & /(2.15_wp**2*force)) - 1/3.0_wp), 7e-4_wp*point%stiffness, 'stiffness of Kirk and Reedy'//at)
         johnson = 2*force/(pi*modulus*length)*(log(4*d1*d2/point%radius**2) - 1)
         call expect(johnson < eta .and. johnson > 0.94_wp*eta, 'approach of Johnson'//at)
         up = law%at(eta*(1 + h))
         down = law%at(eta*(1 - h))
         call expect_close((up%force - down%force)/(2*h*eta), point%stiffness, 1e-8_wp*point%stiffness, 'slope'//at)
         call table%lookup(eta, force, slope)
         call expect_close(force, point%force, 1e-6_wp*point%force, 'table'//at)
      end do
      ! where the contact is as wide as the rocker's radius a straight line begins
      point = law%at(1e-3_wp)
      up = law%at(2e-3_wp)
      call expect_close(up%force - point%force, 1e-3_wp*point%stiffness, 1e-12_wp*up%force, 'a straight line')
      down = law%at((d2 - d1)*d1/(32*d2)*(2/3.0_wp + log(16*d2/d1))*(1 - 1e-9_wp))
      call expect_close(down%radius, 0.25_wp*d1, 1e-8_wp*d1, 'half as wide as R1')
      call expect_close(down%stiffness, point%stiffness, 1e-8_wp*point%stiffness, 'no step there')
   end subroutine rocker

   !> Only k1 + k2 counts: a rigid ball halves the compliance and doubles the snug stiffness.
   subroutine unequal_materials()
      class(contact_law_type), allocatable :: law, soft
      type(contact_point) :: point, soft_point
      call make_contact_law('fang', socket, 0.0_wp, [2.1e11_wp, 2.1e30_wp], poisson, 4.0_wp, law)
      soft = paper_law('fang', 0.0_wp)
      point = law%at(1e-6_wp)
      soft_point = soft%at(1e-6_wp)
      call expect_close(point%force, 2*soft_point%force, 1e-13_wp*point%force, 'a rigid ball')
      call make_contact_law('fang', socket, 0.0_wp, young, [0.3_wp, 0.0_wp], 4.0_wp, law)
      point = law%at(1e-6_wp)
      call expect_close(point%force, soft_point%force*2*0.91_wp/1.91_wp, 1e-13_wp*point%force, 'two Poisson ratios')
   end subroutine unequal_materials

   !> What the law answers meets eqs (12)-(17) as printed. Rounding alone separates them; the exponent's
   !> factor 15 in (15) and the cube root in (14) amplify it by no more than ten or so.
   subroutine printed_equations(difference)
      real(wp), intent(in) :: difference
      real(wp), parameter :: rounding = 200*epsilon(1.0_wp)
      class(contact_law_type), allocatable :: law
      type(contact_point) :: point
      real(wp) :: eta, a, n, b, c, g, r1, worst(4)
      integer :: e
      law = paper_law('fang', difference)
      r1 = socket - difference
      worst = 0
      do e = -48, -12
         eta = 10.0_wp**(0.25_wp*e)
         point = law%at(eta)
         a = point%radius
         n = point%exponent
         b = 0.5_wp*sqrt(pi)*gamma(n + 1)/gamma(n + 1.5_wp)
         c = 3.8304_wp*b*point%force*k12/(pi*socket)
         g = 2/pi + (a/socket)**2
         worst(1) = max(worst(1), abs(point%peak_pressure/((n + 1)*point%force/(pi*a**2)) - 1))
         worst(2) = max(worst(2), abs(4*k12*b*point%peak_pressure*a/eta - 1))
         worst(3) = max(worst(3), abs((4*b*r1*socket*k12*point%force/(pi*(g*difference + c))*(n + 0.5_wp)*(n + 1)) &
            & **(1/3.0_wp)/a - 1))
         worst(4) = max(worst(4), abs(0.5_wp - 0.24_wp*exp(-15.08_wp*(1 - a/socket)) - n))
      end do
      call expect_close(worst(1), 0.0_wp, rounding, 'eq (12), dR = '//to_text(difference))
      call expect_close(worst(2), 0.0_wp, rounding, 'eq (13), dR = '//to_text(difference))
      call expect_close(worst(3), 0.0_wp, rounding, 'eq (14), dR = '//to_text(difference))
      call expect_close(worst(4), 0.0_wp, rounding, 'eq (15), dR = '//to_text(difference))
   end subroutine printed_equations

   !> Differences with a step h of the pivot deflection: error h**2/6 of the third logarithmic derivative (of
   !> order ten) and rounding 1e-15/h; both below 1e-8 for h = 1e-5.
   subroutine slopes(name, difference)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: difference
      real(wp), parameter :: h = 1e-5_wp
      class(contact_law_type), allocatable :: law
      type(contact_point) :: point, up, down
      real(wp) :: eta, worst
      integer :: e
      law = paper_law(name, difference)
      worst = 0
      do e = -24, -6
         eta = 10.0_wp**(0.5_wp*e)
         point = law%at(eta)
         up = law%at(eta*(1 + h))
         down = law%at(eta*(1 - h))
         worst = max(worst, abs((up%force - down%force)/(2*h*eta*point%stiffness) - 1))
      end do
      call expect_close(worst, 0.0_wp, 1e-8_wp, 'slope of '//name//', dR = '//to_text(difference))
   end subroutine slopes

   !> pivot deflection() inverts at(): the bisection ends at the rounding of ln(eta), 30 epsilon, times the
   !> exponent of the law, at most 1.5 (Hertz) and somewhat more near the transition to the snug limit.
   subroutine inverse(name, difference)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: difference
      class(contact_law_type), allocatable :: law
      type(contact_point) :: point
      real(wp) :: worst
      integer :: e
      law = paper_law(name, difference)
      worst = 0
      do e = -2, 7
         point = law%at(law%pivot_deflection(3*10.0_wp**e))
         worst = max(worst, abs(point%force/(3*10.0_wp**e) - 1))
      end do
      call expect_close(worst, 0.0_wp, 200*epsilon(worst), 'inverse of '//name//', dR = '//to_text(difference))
   end subroutine inverse

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

   subroutine one_table(name, difference)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: difference
      class(contact_law_type), allocatable :: law
      type(contact_table_type) :: table
      character(len=:), allocatable :: what
      law = paper_law(name, difference)
      table = new_contact_table(law)
      what = ' ('//name//', dR = '//to_text(difference)//')'
      call against_law(law, table, what)
      call seams(table, what)
      call below(law, table, what)
      call above(table, what)
      call no_contact(table, what)
      call slope_is_derivative(table, what)
      call without_table(law, table, new_untabulated_contact(law), what)
   end subroutine one_table

   !> Without a table the law answers between the ends, to the bit, and beyond them what the table says there.
   subroutine without_table(law, table, plain, what)
      class(contact_law_type), intent(in) :: law
      type(contact_table_type), intent(in) :: table, plain
      character(len=*), intent(in) :: what
      type(contact_point) :: point
      real(wp) :: x, found(2), expected(2)
      integer :: octave
      do octave = -60, 4
         x = 1.3_wp*2.0_wp**octave
         call plain%lookup(x, found(1), found(2))
         if (x > low_end .and. x < high_end) then
            point = law%at(x)
            expected = [point%force, point%stiffness]
         else
            call table%lookup(x, expected(1), expected(2))
         end if
         call expect_close(maxval(abs(found - expected)), 0.0_wp, 0.0_wp, 'no table at '//to_text(x)//' m'//what)
      end do
   end subroutine without_table

   !> 32 cubic cells an octave: about (1/32)**4/384 = 2.5e-9 of the law's fourth logarithmic derivative,
   !> which is of order one, and of some hundred where contact spreads over the socket: 1e-6 at most.
   !> Slopes lose one order of the cell: 2 sqrt(3)/9 (1/32)**3/24 = 5e-7 times the same.
   subroutine against_law(law, table, what)
      class(contact_law_type), intent(in) :: law
      type(contact_table_type), intent(in) :: table
      character(len=*), intent(in) :: what
      type(contact_point) :: point
      real(wp) :: x, force, slope, worst, worst_slope
      integer :: k
      worst = 0
      worst_slope = 0
      do k = 1, 4000
         call random_number(x)
         x = low_end*(high_end/low_end)**x
         point = law%at(x)
         call table%lookup(x, force, slope)
         worst = max(worst, abs(force/point%force - 1))
         worst_slope = max(worst_slope, abs(slope/point%stiffness - 1))
      end do
      call expect(worst < 1e-6_wp, 'force of the table'//what//': '//to_text(worst))
      call expect(worst_slope < 1e-4_wp, 'slope of the table'//what//': '//to_text(worst_slope))
   end subroutine against_law

   !> From one side of a seam to the other, force and slope change by rounding alone: of the cubic, and
   !> of the slope, whose terms are 32 times the force over the pivot deflection.
   subroutine seams(table, what)
      type(contact_table_type), intent(in) :: table
      character(len=*), intent(in) :: what
      real(wp) :: x, force(2), slope(2), jump, slope_jump
      integer :: octave, k
      jump = 0
      slope_jump = 0
      do octave = -40, -6
         do k = 0, 31
            x = 2.0_wp**octave*(1 + k/32.0_wp)
            if (x > high_end) exit
            call table%lookup(nearest(x, -1.0_wp), force(1), slope(1))
            call table%lookup(x, force(2), slope(2))
            jump = max(jump, abs(force(2)/force(1) - 1))
            slope_jump = max(slope_jump, abs(slope(2)/slope(1) - 1))
         end do
      end do
      call expect_close(jump, 0.0_wp, 20*epsilon(x), 'force across the seams and both ends'//what)
      call expect_close(slope_jump, 0.0_wp, 32*20*epsilon(x), 'slope across the seams and both ends'//what)
   end subroutine seams

   !> Below its low end the table goes on as the power law that the law is there (contact radius small).
   !> The exponent changes by less than 2e-3 over a decade for dR >= 1 um, and not at all for dR = 0.
   subroutine below(law, table, what)
      class(contact_law_type), intent(in) :: law
      type(contact_table_type), intent(in) :: table
      character(len=*), intent(in) :: what
      type(contact_point) :: point
      real(wp) :: force, slope, before, x
      integer :: k
      before = 0
      do k = 0, 40
         x = low_end*10.0_wp**(-20 + 0.5_wp*k)*0.99_wp
         call table%lookup(x, force, slope)
         call expect(force > before .and. slope > 0, 'rising below the table'//what)
         before = force
      end do
      if (law%radius_difference > 0 .and. law%radius_difference < 1e-6_wp) return
      point = law%at(0.1_wp*low_end)
      call table%lookup(0.1_wp*low_end, force, slope)
      call expect_close(force/point%force, 1.0_wp, 5e-3_wp, 'a decade below the table'//what)
   end subroutine below

   !> Above its high end the table is a straight line.
   subroutine above(table, what)
      type(contact_table_type), intent(in) :: table
      character(len=*), intent(in) :: what
      real(wp) :: force(3), slope(3)
      integer :: k
      do k = 1, 3
         call table%lookup(k*high_end, force(k), slope(k))
      end do
      call expect_close(force(3) - force(2), force(2) - force(1), 10*epsilon(force)*force(3), &
         & 'a line above the table'//what)
      call expect_close((force(2) - force(1))/high_end, slope(1), 10*epsilon(force)*force(2)/high_end, &
         & 'slope of that line'//what)
      call expect_close(slope(3), slope(1), 0.0_wp, 'constant slope above the table'//what)
   end subroutine above

   !> No pivot deflection, no force; nor for what is not a number.
   subroutine no_contact(table, what)
      type(contact_table_type), intent(in) :: table
      character(len=*), intent(in) :: what
      real(wp), parameter :: nothing(*) = [0.0_wp, -0.0_wp, -1e-300_wp, -1e-6_wp, -1.0_wp]
      real(wp) :: force, slope
      integer :: k
      do k = 1, size(nothing)
         call table%lookup(nothing(k), force, slope)
         call expect_close(abs(force) + abs(slope), 0.0_wp, 0.0_wp, 'no contact'//what)
      end do
      ! comparing a NaN must not stop the test where traps are on
      call ieee_set_halting_mode(ieee_invalid, .false.)
      call table%lookup(ieee_value(0.0_wp, ieee_quiet_nan), force, slope)
      call expect_close(abs(force) + abs(slope), 0.0_wp, 0.0_wp, 'no contact for NaN'//what)
      call ieee_set_halting_mode(ieee_invalid, .true.)
   end subroutine no_contact

   !> The slope is the derivative of the tabulated force itself: differences within a cell, exact for a
   !> cubic but for h**2/6 of its third derivative (below 1e-8 for a step of 1e-5) and rounding 1e-16/h.
   subroutine slope_is_derivative(table, what)
      type(contact_table_type), intent(in) :: table
      character(len=*), intent(in) :: what
      real(wp), parameter :: h = 1e-5_wp
      real(wp) :: x, up, down, slope, ignored, worst
      integer :: octave
      worst = 0
      do octave = -44, -4
         x = 2.0_wp**octave*(1 + 7.3_wp/32)
         call table%lookup(x*(1 + h), up, ignored)
         call table%lookup(x*(1 - h), down, ignored)
         call table%lookup(x, ignored, slope)
         worst = max(worst, abs((up - down)/(2*h*x*slope) - 1))
      end do
      call expect_close(worst, 0.0_wp, 1e-8_wp, 'the slope is the derivative of the force'//what)
   end subroutine slope_is_derivative
end program test_contact_law
