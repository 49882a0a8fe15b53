!> Poincare points and extremes of each revolution against closed forms of the motion, which the samples miss.
program test_revolution_figures
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp, i8, pi
   use text, only: to_text
   use errors, only: error_type
   use case_inputs, only: case_type
   use run_file, only: run_file_type
   use bearing_file, only: bearing_file_type, new_bearing_file
   use march_figures, only: put_revolutions
   use input_cases, only: case_of
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)
   !> Angles of hundreds of radians, and sums of four terms of order one.
   real(wp), parameter :: rounding = 1000*epsilon(1.0_wp)
   character(len=*), parameter :: march = "&operation speed_rpm=60, duration=40 / &output keep='summary' / "
   integer, parameter :: pads = 2

   if (runs('points')) call points()
   if (runs('order')) call order()
   if (runs('run_up')) call run_up()
   if (runs('extremes')) call extremes()
   if (runs('most')) call most()
   if (runs('ends')) call ends()
   if (runs('less_than_one')) call less_than_one()
   if (runs('fixed_pads')) call fixed_pads()
   call report()

contains

   !> A motion with the period of two revolutions: y, z and the tilt of the k-th pad at an angle of the shaft.
   pure function motion(angle) result(values)
      real(wp), intent(in) :: angle
      real(wp) :: values(2 + pads)
      integer :: k
      values = [sin(angle/2 + 0.3_wp), cos(angle), (k*sin(angle/2 + k), k=1, pads)]
   end function motion

   !> The figures of samples at these angles.
   subroutine make(text, angle, most, file)
      character(len=*), intent(in) :: text
      real(wp), intent(in) :: angle(:)
      integer, intent(in) :: most
      type(run_file_type), intent(out), target :: file
      type(bearing_file_type) :: bearing
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      real(wp) :: values(2 + pads)
      integer :: i, width
      inputs = case_of(text)
      width = merge(2 + pads, 2, inputs%bearings(1)%tilting())
      file%filed = .false.
      call file%start(inputs, error)
      call expect_no_error(error, 'a run')
      call file%begin_series('time', size(angle, kind=i8))
      call file%hdf5%declare('shaft_angle', 1, 'rad', 'angle', '')
      call file%hdf5%declare('journal_y', 1, 'm', 'y', '')
      call file%hdf5%declare('journal_z', 1, 'm', 'z', '')
      if (inputs%bearings(1)%tilting()) call file%hdf5%declare('pad_tilt', pads, 'rad', 'tilt', 'pad')
      do i = 1, size(angle)
         values = motion(angle(i))
         call file%hdf5%add([angle(i), values(:width)])
      end do
      bearing = new_bearing_file(file, inputs%bearings(1))
      call put_revolutions(bearing, inputs%bearings(1)%tilting(), size(angle), most)
   end subroutine make

   !> A list, as many values for each revolution as it has.
   function list(file, name) result(values)
      type(run_file_type), intent(in) :: file
      character(len=*), intent(in) :: name
      real(wp), allocatable :: values(:)
      values = file%get_all(name)
   end function list

   !> The points lie on the motion at the multiples of 2 pi from the first, within a tolerance.
   subroutine expect_points(file, first, last, tolerance, what)
      type(run_file_type), intent(in) :: file
      integer, intent(in) :: first, last
      real(wp), intent(in) :: tolerance
      character(len=*), intent(in) :: what
      real(wp) :: y(last - first + 1), z(last - first + 1), tilt(pads, last - first + 1), expected(2 + pads)
      integer :: k, i
      call expect(file%list_size('by_revolution/poincare_y') == size(y), what//': how many')
      if (file%list_size('by_revolution/poincare_y') /= size(y)) return
      y = list(file, 'by_revolution/poincare_y')
      z = list(file, 'by_revolution/poincare_z')
      tilt = reshape(list(file, 'by_revolution/poincare_tilt'), shape(tilt))
      call expect(all(abs(list(file, 'revolution') - [(k, k=first - last, 0)]) <= 0), what//': their numbers')
      do k = first, last
         expected = motion(2*pi*k)
         ! a pad's tilt is as many times as large
         call expect(all(abs([y(k - first + 1), z(k - first + 1), tilt(:, k - first + 1)] - expected) &
            & <= tolerance*[1, 1, (i, i=1, pads)]), what//': point '//to_text(k))
      end do
   end subroutine expect_points

   !> n samples a revolution from this angle on, over as many revolutions.
   pure function even(from, revolutions, n) result(angle)
      real(wp), intent(in) :: from, revolutions
      integer, intent(in) :: n
      real(wp) :: angle(1 + nint(revolutions*n))
      integer :: i
      angle = [(from + 2*pi*i/n, i=0, size(angle) - 1)]
   end function even

   !> What the error of a cubic through four even samples is at most, between the middle two, and at an end, for
   !> motions whose fourth derivative is 1 at most.
   pure real(wp) function of_cubic(n, at_end)
      integer, intent(in) :: n
      logical, intent(in) :: at_end
      of_cubic = merge(1.0_wp, 9.0_wp/16, at_end)/24*(2*pi/n)**4
   end function of_cubic

   !> Samples at the points have their values; between samples they follow to the fourth order.
   subroutine points()
      type(run_file_type) :: file
      call make(march, even(0.0_wp, 6.0_wp, 36), 50, file)
      call expect_points(file, 0, 6, rounding, 'at samples')
      call make(march, even(2*pi*7, 6.0_wp, 36), 50, file)
      call expect_points(file, 7, 13, rounding, 'at later samples')
      call make(march, even(-0.5_wp, 6.7_wp, 36), 50, file)
      call expect_points(file, 0, 6, of_cubic(36, .false.), 'between samples')
      ! the first point lies between the first two samples
      call make(march, even(-0.03_wp, 6.7_wp, 36), 50, file)
      call expect_points(file, 0, 6, of_cubic(36, .true.), 'at an end')
   end subroutine points

   !> In the middle between two samples the error is its first term, 9/16 h^4/24 of the fourth derivative, and what is
   !> beyond it is of the order h^2 of that.
   subroutine order()
      type(run_file_type) :: file
      real(wp) :: y(3), expected(2 + pads)
      integer :: n, k
      do n = 40, 80, 40
         call make(march, even(-pi/n - 2*pi/5, 2.9_wp, n), 3, file)
         y = list(file, 'by_revolution/poincare_y')
         do k = 0, 2
            expected = motion(2*pi*k)
            call expect_close((expected(1) - y(k + 1))/(of_cubic(n, .false.)*expected(1)/16), 1.0_wp, (2*pi/n)**2, &
               & to_text(n)//' samples, point '//to_text(k))
         end do
      end do
   end subroutine order

   !> Even times of a shaft that gets faster: the samples lie further and further apart.
   subroutine run_up()
      type(run_file_type) :: file
      real(wp) :: angle(400)
      integer :: i
      angle = [(-1 + 0.05_wp*i + 1e-4_wp*i**2, i=0, 399)]
      call make(march, angle, 50, file)
      call expect_points(file, 0, 5, maxval(angle(2:) - angle(:399))**4/24, 'a run-up')
   end subroutine run_up

   !> Of the revolutions before the last sample: sines of half the angle, by their closed form.
   subroutine extremes()
      integer, parameter :: n = 60
      real(wp), parameter :: start = 0.4_wp
      type(run_file_type) :: file
      real(wp) :: low(6), high(6), from
      integer :: k
      ! from 0.4 to 0.4 + 12 pi: six whole revolutions, and six points
      call make(march, even(start, 6.0_wp, n), 50, file)
      low = list(file, 'by_revolution/lowest_y')
      high = list(file, 'by_revolution/highest_y')
      do k = 1, 6
         ! half the angle goes from here on by pi, and the sine has its crest in it, or its trough
         from = start/2 + 0.3_wp + pi*(k - 1)
         if (mod(k, 2) == 1) then
            ! samples miss the crest by half their distance
            call expect(high(k) <= 1 .and. high(k) >= cos(pi/n/2), 'the crest of revolution '//to_text(k))
            ! the revolution begins at a sample and ends before the next begins
            call expect(low(k) >= sin(from + pi) - rounding .and. low(k) <= sin(from + pi) + pi/n + rounding, &
               & 'the end of revolution '//to_text(k))
         else
            call expect(low(k) >= -1 .and. low(k) <= -cos(pi/n/2), 'the trough of revolution '//to_text(k))
            call expect(high(k) <= sin(from + pi) + rounding .and. high(k) >= sin(from + pi) - pi/n - rounding, &
               & 'the end of revolution '//to_text(k))
         end if
      end do
      ! a cosine has both in each, at samples or within half their distance
      low = list(file, 'by_revolution/lowest_z')
      high = list(file, 'by_revolution/highest_z')
      call expect(all(low <= -cos(pi/n)) .and. all(high >= cos(pi/n)) .and. all(abs([low, high]) <= 1), 'z')
   end subroutine extremes

   !> No more revolutions than are asked for, the last ones.
   subroutine most()
      type(run_file_type) :: file
      call make(march, even(0.0_wp, 9.0_wp, 36), 4, file)
      call expect_points(file, 6, 9, rounding, 'the last four')
      call expect(all(.not. ieee_is_nan(list(file, 'by_revolution/lowest_y'))), 'each has its extremes')
   end subroutine most

   !> Rounding at the ends costs no point; with one more point than revolutions the first has no extremes.
   subroutine ends()
      type(run_file_type) :: file
      real(wp) :: angle(109), low(4)
      angle = even(0.0_wp, 3.0_wp, 36)
      angle(1) = 1e-12_wp
      angle(109) = 6*pi - 1e-12_wp
      call make(march, angle, 50, file)
      call expect_points(file, 0, 3, 1e-11_wp, 'both ends')
      low = list(file, 'by_revolution/lowest_z')
      call expect(all(ieee_is_nan(low) .eqv. [.true., .false., .false., .false.]), 'three revolutions')
   end subroutine ends

   !> Between two points there is none; around one there is no whole revolution.
   subroutine less_than_one()
      type(run_file_type) :: file
      real(wp) :: low(1)
      call make(march, even(0.1_wp, 0.9_wp, 36), 50, file)
      call expect(.not. file%record_type%has('by_revolution/poincare_y'), 'no point')
      call expect(.not. file%record_type%has('revolution'), 'no revolution')
      call make(march, even(-0.5_wp, 0.9_wp, 36), 50, file)
      call expect_points(file, 0, 0, of_cubic(36, .false.), 'a point')
      low = list(file, 'by_revolution/lowest_y')
      call expect(ieee_is_nan(low(1)), 'without extremes')
   end subroutine less_than_one

   !> Pads that do not tilt have none of these.
   subroutine fixed_pads()
      type(run_file_type) :: file
      call make(march//"&pads motion='fixed' / &friction model='none' / ", even(0.0_wp, 2.0_wp, 36), 50, file)
      call expect(file%list_size('by_revolution/poincare_y') == 3, 'the journal has its points')
      call expect(.not. file%record_type%has('by_revolution/poincare_tilt'), 'no tilt')
   end subroutine fixed_pads
end program test_revolution_figures
