!> Films of a model against closely solved ones: what the differences are, what a pad carries, films that cannot be
!> solved, and what a file says of them.
program test_film_comparison
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp, i8
   use text, only: to_text
   use state_layout, only: pad_state
   use equations_of_motion, only: machine_model, new_machine_model
   use film_comparison, only: film_comparison_type, film_difference, new_film_comparison
   use verification, only: sample_of
   use verification_results, only: put_verification, states_figure
   use record, only: record_type
   use summary_group, only: figure, pad_figures, has_figure
   use input_cases, only: case_of
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   !> Four pads that tilt, of which the first two are loaded, each of 4 kg.
   integer, parameter :: loaded = 2
   !> Beside their equilibrium: journal, m, and tilts, rad.
   real(wp), parameter :: journal(2) = [-50e-6_wp, 2e-6_wp], tilts(4) = 1e-3_wp*[-0.2_wp, 1.0_wp, -0.6_wp, 0.6_wp]
   character(len=*), parameter :: four = '&pads pivot_angle_deg = -45, 225, 45, 135, mass = 4, inertia = 4e-3 / '

   if (runs('of_second_order')) call of_second_order()
   if (runs('wide_arcs')) call wide_arcs()
   if (runs('carried')) call carried()
   if (runs('closed')) call closed()
   if (runs('spread')) call spread_over_run()
   if (runs('in_a_record')) call in_a_record()
   call report()

contains

   !> The differences of a case's films with the journal here, m, pads with these tilts, rad, and all at rest.
   subroutine compare(text, journal, tilt, found)
      character(len=*), intent(in) :: text
      real(wp), intent(in) :: journal(2), tilt(:)
      type(film_difference), allocatable, intent(out) :: found(:)
      type(machine_model) :: model
      type(film_comparison_type) :: comparison
      integer :: i
      model = new_machine_model(case_of(text))
      comparison = new_film_comparison(model)
      allocate (found(model%layout%pads))
      call comparison%compare(model, 0.0_wp, model%static_state(journal, &
         & [(pad_state(tilt(i)), i=1, size(tilt))]), found)
   end subroutine compare

   !> Over-relaxation, which the closely solved films share nothing with, approaches them with the square of its cells:
   !> half as long ones leave a quarter, but for a tenth by the orders above, and by cells that cavitate one by one.
   subroutine of_second_order()
      type(film_difference), allocatable :: coarse(:), fine(:)
      character(len=*), parameter :: conditions(2) = [character(len=8) :: 'none', 'reynolds']
      real(wp) :: force, pressure
      integer :: i, k
      do k = 1, size(conditions)
         call compare(four//sor(60, 16, trim(conditions(k))), journal, tilts, coarse)
         call compare(four//sor(120, 32, trim(conditions(k))), journal, tilts, fine)
         do i = 1, loaded
            force = coarse(i)%force/fine(i)%force
            pressure = coarse(i)%pressure/fine(i)%pressure
            call expect_close(force, 4.0_wp, 0.4_wp, trim(conditions(k))//', force of pad '//to_text(i)//': ' &
               & //to_text(force))
            call expect_close(pressure, 4.0_wp, 0.8_wp, trim(conditions(k))//', pressure of pad '//to_text(i)//': ' &
               & //to_text(pressure))
            call expect(fine(i)%left < 0.1_wp*fine(i)%force, 'and the closely solved one is ten times closer')
         end do
      end do
   end subroutine of_second_order

   function sor(cells, rows, condition)
      integer, intent(in) :: cells, rows
      character(len=*), intent(in) :: condition
      character(len=:), allocatable :: sor
      sor = '&film solver = ''sor'', tolerance = 1e-9, max_sweeps = 100000, circumferential_cells = '//to_text(cells) &
         & //', axial_cells = '//to_text(rows)//', cavitation = '''//condition//''' /'
   end function sor

   !> Converged films of pads of wide arcs are solved on more volumes than the films of a march without tables; those
   !> of tables are as close as their second solution.
   subroutine wide_arcs()
      character(len=*), parameter :: two = '&pads motion = ''fixed'', pivot_angle_deg = -90, 90, arc_deg = 160 / '
      type(film_difference), allocatable :: found(:), tables(:)
      call compare(two//'&film solver = ''direct'' /', [-50e-6_wp, 20e-6_wp], [0.0_wp, 0.0_wp], found)
      call expect(all(found%force > 0 .and. found%left > 0), 'other volumes')
      call expect(all(found%left < found%force), 'closer than those of a march')
      call compare(two, [-50e-6_wp, 20e-6_wp], [0.0_wp, 0.0_wp], tables)
      call expect(all(tables%force < found%force), 'tables are closer')
   end subroutine wide_arcs

   !> What a pad carries; where its film has gone, as it diverges all along, a thousandth of its weight, or, of a fixed
   !> pad, of the load.
   subroutine carried()
      type(film_difference), allocatable :: found(:)
      call compare(four, journal, [tilts(:2), -1e-3_wp, tilts(4)], found)
      call expect(all(found(:loaded)%carried > 1e3_wp), 'loaded pads carry the force of their films')
      call expect_close(found(3)%carried, 1e-3_wp*4*9.81_wp, 1e-9_wp, 'of its weight')
      call compare('&pads motion = ''fixed'', pivot_angle_deg = -60, 60, arc_deg = 40 /', [-20e-6_wp, 60e-6_wp], &
         & [0.0_wp, 0.0_wp], found)
      call expect_close(found(1)%carried, 1e-3_wp*2000*9.81_wp, 1e-6_wp, 'of the load')
      call expect(found(2)%carried > 1e3_wp, 'a fixed pad carries the force of its film')
   end subroutine carried

   !> A film that cannot be solved is named; the others are compared.
   subroutine closed()
      type(film_difference), allocatable :: found(:)
      call compare(four, [-80e-6_wp, 80e-6_wp], 0*tilts, found)
      call expect(index(found(1)%refusal, 'film of pad 1 closed') > 0, 'named: '//found(1)%refusal)
      call expect(found(4)%refusal == '', 'not named: '//found(4)%refusal)
      call expect(found(4)%carried > 0, 'compared')
   end subroutine closed

   !> One state in each stretch of the run; at all angles of the shaft: multiples of the golden ratio leave no gap of
   !> more than 1.9 over their number (three-gap theorem), to which comes a sample of 1/360.
   subroutine spread_over_run()
      integer, parameter :: numbers(5) = [1, 7, 10, 50, 300]
      integer(i8), parameter :: samples(5) = [300_i8, 8001_i8, 55*3600_i8, 78001_i8, 78001_i8]
      integer(i8) :: sample
      logical :: met(0:359)
      integer :: i, k, gap, longest
      do i = 1, size(numbers)
         associate (n => numbers(i))
            met = .false.
            do k = 1, n
               sample = sample_of(k, n, samples(i), size(met))
               call expect(sample >= (k - 1)*samples(i)/n .and. sample < k*samples(i)/n, 'in its stretch')
               met(modulo(sample, size(met, kind=i8))) = .true.
            end do
         end associate
         gap = 0
         longest = 0
         do k = 0, 2*size(met) - 1
            gap = merge(1, gap + 1, met(modulo(k, size(met))))
            longest = max(longest, gap)
         end do
         call expect(numbers(i) == 1 .or. longest <= 360*1.9_wp/numbers(i) + 1, 'angles of '//to_text(numbers(i)) &
            & //' states: '//to_text(longest))
      end do
      do k = 1, 5
         call expect(sample_of(k, 5, 5_i8, 360) == k - 1, 'all samples')
      end do
   end subroutine spread_over_run

   !> Median, largest with its time, films that could not be compared; the same in words.
   subroutine in_a_record()
      type(film_difference) :: found(2, 4)
      type(record_type) :: file
      character(len=:), allocatable :: lines, attribute
      real(wp), allocatable :: values(:)
      real(wp), parameter :: forces(4) = [3.0_wp, 1.0_wp, 8.0_wp, 2.0_wp]
      integer :: k
      do k = 1, 4
         found(1, k) = film_difference(carried=10.0_wp, force=forces(k), left=0.1_wp*k, &
            & highest_pressure=100.0_wp, pressure=real(k, wp), refusal='')
         found(2, k) = film_difference(refusal='the film of pad 2 closed')
      end do
      found(1, 2)%refusal = 'the film of pad 1 did not converge'
      call file%put('pad', [1.0_wp, 2.0_wp], '1', 'pad', 'pad')
      call put_verification(file, [0.1_wp, 0.2_wp, 0.3_wp, 0.4_wp], found, 20.0_wp, lines)
      call expect_close(figure(file, states_figure), 4.0_wp, 0.0_wp, 'states')
      call expect_pad(file, 0.3_wp, 'pad_film_error')
      call expect_pad(file, 0.8_wp, 'pad_film_error_max')
      call expect_pad(file, 0.3_wp, 'pad_film_error_time')
      call expect_pad(file, 0.4_wp, 'pad_film_error_of_load')
      call expect_pad(file, 0.04_wp, 'pad_film_error_pressure')
      call expect_pad(file, 0.04_wp, 'pad_film_error_left')
      values = pad_figures(file, 'pad_film_error_unknown')
      call expect(all(abs(values - [1, 4]) <= 0), 'not compared')
      call file%get_text('verification', attribute)
      call expect(attribute == lines, 'as printed')
      call expect(lines == 'films in 4 states against closely solved ones: difference of the force over what the pad ' &
         & //'carries'//achar(10)//'pad 1: median 0.3, largest 0.8 at t = 0.3 s, of the load 0.4; of the maximum ' &
         & //'pressure 0.04; estimated error of the closely solved films 0.04; 1 of 4 films could not be compared: ' &
         & //'at t = 0.2 s the film of pad 1 did not converge'//achar(10)//'pad 2: 4 of 4 films could not be ' &
         & //'compared: at t = 0.1 s the film of pad 2 closed', 'in words: '//lines)
      call file%clear()
      call file%put('pad', [1.0_wp, 2.0_wp], '1', 'pad', 'pad')
      call put_verification(file, [real(wp) ::], found(:, 1:1), 0.0_wp, lines)
      call expect(.not. has_figure(file, 'pad_film_error_time'), 'an equilibrium has no time')
      call expect(.not. has_figure(file, 'pad_film_error_of_load'), 'no load, nothing over it')
   end subroutine in_a_record

   !> What pad 1 must have; pad 2 has no number.
   subroutine expect_pad(file, expected, name)
      type(record_type), intent(inout) :: file
      real(wp), intent(in) :: expected
      character(len=*), intent(in) :: name
      real(wp), allocatable :: values(:)
      values = pad_figures(file, name)
      call expect_close(values(1), expected, 1e-12_wp, name)
      call expect(ieee_is_nan(values(2)), name//': no number where nothing was compared')
   end subroutine expect_pad
end program test_film_comparison
