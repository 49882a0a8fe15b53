!> The tabulated contact against its law, at the seams of its cells and beyond its ends.
program test_contact_table
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_invalid
   use kinds, only: wp
   use text, only: to_text
   use contact_law, only: contact_law_type, contact_point
   use contact_table, only: contact_table_type, new_contact_table, new_untabulated_contact
   use paper_bearing, only: paper_law
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   !> Ends of the table, m.
   real(wp), parameter :: low_end = 2.0_wp**(-40), high_end = 2.0_wp**(-6)
   real(wp), parameter :: differences(*) = [0.0_wp, 1e-8_wp, 1e-6_wp, 15e-6_wp, 30e-6_wp, 1e-3_wp]
   integer :: i

   do i = 1, size(differences)
      if (runs('one_table')) call one_table('fang', differences(i))
   end do
   if (runs('one_table')) call one_table('hertz', 15e-6_wp)
   call report()

contains

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
      call expect_close(table%penetration(1e3_wp), law%penetration(1e3_wp), 0.0_wp, 'penetration'//what)
      call expect_close(plain%penetration(1e3_wp), law%penetration(1e3_wp), 0.0_wp, 'penetration without table'//what)
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
   !> of the slope, whose terms are 32 times the force over the penetration.
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

   !> No penetration, no force; nor for what is not a number.
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
end program test_contact_table
