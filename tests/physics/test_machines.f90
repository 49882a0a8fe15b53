!> Machines: an elastic rotor on several bearings against the values of an independent program
!> (docs/theory/machines.md), against a rigid journal, and against itself described in another way.
program test_machines
   use kinds, only: wp, pi, rpm
   use text, only: to_text
   use errors, only: error_type
   use case_inputs, only: case_type
   use equations_of_motion, only: machine_model
   use equilibrium_record, only: equilibrium_type
   use static_model, only: make_static
   use equilibrium, only: bearing_loads
   use force_balance, only: forces, at_stations
   use linear_bearing, only: bearing_coefficients_type
   use rotor_response, only: rotor_response_type, find_rotor_response
   use linear_analysis, only: analyse
   use periodic_orbit, only: periodic_orbit_type
   use machine_cases, only: symmetric_rotor, add_bearing, disc_station
   use machine_orbits, only: stand, stations, close_orbit, over_orbit
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)

   !> Parts of the independent program's values that its printed digits, and its films, leave (rotor.md: statics,
   !> eigenvalues, stiffness and damping 1e-5; else 1e-4; orbits 5e-4).
   real(wp), parameter :: linear_error = 1e-5_wp, response_error = 1e-4_wp, orbit_error = 5e-4_wp

   if (runs('statics')) call statics()
   if (runs('vibrations')) call vibrations()
   if (runs('synchronous')) call synchronous()
   if (runs('jacobian')) call jacobian()
   if (runs('frictionless_orbit')) call frictionless_orbit()
   if (runs('whirl')) call whirl()
   if (runs('three_bearings')) call three_bearings()
   if (runs('descriptions')) call descriptions()
   if (runs('stiff_shaft')) call stiff_shaft()
   if (runs('warm_oil')) call warm_oil('pad')
   if (runs('warm_films')) call warm_oil('film')
   if (runs('thresholds')) call thresholds()
   call report()

contains

   subroutine statics()
      type(machine_model) :: model
      type(equilibrium_type) :: found
      real(wp) :: at(2, 13), loads(2, 2)
      call stand(symmetric_rotor('none', 4100.0_wp, 0.0_wp), model, found)
      at = stations(model, found%rotor)
      loads = bearing_loads(model, found)
      call expect_close(maxval(abs(loads(1, :) + 19620)), 0.0_wp, 19620*linear_error, 'half the weight each')
      call expect_close(at(1, 2), -67.1872_wp, 1e-3_wp, 'y of the journal')
      call expect_close(at(2, 2), 0.023_wp, 1e-3_wp, 'z of the journal')
      call expect_close(at(1, disc_station), -98.0403_wp, 1e-3_wp, 'y of the disc')
      call expect(found%stability%name == 'stable', 'stable')
   end subroutine statics

   subroutine vibrations()
      type(bearing_coefficients_type) :: found
      integer :: b
      type(case_type) :: inputs
      complex(wp), parameter :: published(4) = [(-69.529_wp, 407.877_wp), (-70.074_wp, 408.457_wp), &
         & (-323.722_wp, 388.358_wp), (-379.598_wp, 379.975_wp)]
      integer :: i
      inputs = symmetric_rotor('lugre', 4100.0_wp, 0.0_wp)
      ! six modes a plane
      inputs%rotor%elastic%reduction%frequency = 6000
      call analyse(inputs, 'the machine is analysed', found)
      do b = 1, 2
         call expect_close(found%stiffness(1, 1, 1, 1, b), 582.5918e6_wp, 582.6e6_wp*linear_error, 'K')
         call expect_close(found%damping(1, 1, 1, 1, b), 0.941046e6_wp, 0.94e6_wp*linear_error, 'C')
      end do
      do i = 1, size(published)
         call expect_close(minval(abs(found%modes(1)%eigenvalue - published(i))), 0.0_wp, &
            & linear_error*abs(published(i)), 'free pads: eigenvalue '//to_text(i))
      end do
      call expect_close(minval(abs(found%modes(2)%eigenvalue - (-42.474_wp, 428.004_wp))), 0.0_wp, &
         & linear_error*430, 'stuck pads')
   end subroutine vibrations

   !> Modes on synchronously reduced coefficients, and the whirl under an unbalance.
   subroutine synchronous()
      type(bearing_coefficients_type) :: found
      type(rotor_response_type) :: response
      type(machine_model) :: fine
      type(error_type), allocatable :: error
      real(wp), parameter :: speeds(3) = [3300.0_wp, 4100.0_wp, 5200.0_wp]
      real(wp), parameter :: published(3) = [8.66265_wp, 18.76877_wp, 11.89040_wp]
      integer :: i
      do i = 1, 3
         call analyse(symmetric_rotor('none', speeds(i), 0.02_wp), 'the machine is analysed', found, fine=fine)
         call find_rotor_response(fine, found, response, error)
         call expect_no_error(error, 'the response is found')
         call expect_close(1e6_wp*abs(response%unbalance(1, disc_station, 1)), published(i), &
            & response_error*published(i), '1x of y at '//to_text(speeds(i))//' rpm')
         if (i /= 2) cycle
         call expect_close(minval(abs(response%synchronous(1)%eigenvalue - (-67.842_wp, 413.382_wp))), 0.0_wp, &
            & linear_error*413, 'eigenvalue with synchronously reduced coefficients')
         call counterparts(fine, found%modes(1)%eigenvalue, response)
      end do
   end subroutine synchronous

   !> Modes below twice the speed that vibrate, and the synchronous modes that are the same vibrations: no other is as
   !> much alike.
   subroutine counterparts(model, eigenvalue, response)
      type(machine_model), intent(in) :: model
      complex(wp), intent(in) :: eigenvalue(:)
      type(rotor_response_type), intent(in) :: response
      real(wp) :: alike(size(response%synchronous(1)%eigenvalue))
      integer :: i, k, compared
      compared = 0
      do i = 1, size(eigenvalue)
         associate (own => response%counterpart(i, 1), shape => response%shapes(:, :, i, 1))
            if (.not. (eigenvalue(i)%im > 3*abs(eigenvalue(i)%re) .and. eigenvalue(i)%im < 2*4100*rpm)) cycle
            call expect(own > 0, 'mode '//to_text(i)//' has a counterpart')
            if (own == 0) cycle
            do k = 1, size(alike)
               associate (other => at_stations(model, response%synchronous(1)%shape(:, k)))
                  alike(k) = abs(sum(conjg(shape)*other))**2/(sum(abs(shape)**2)*sum(abs(other)**2))
               end associate
            end do
            call expect(own == maxloc(alike, dim=1, mask=response%synchronous(1)%eigenvalue%im > 0), 'mode ' &
               & //to_text(i)//' is compared with the one that is most like it')
            compared = compared + 1
         end associate
      end do
      call expect(compared >= 2, 'modes are compared')
   end subroutine counterparts

   !> The Jacobian against central differences, with bearings that differ in pads, pivots and friction.
   subroutine jacobian()
      type(case_type) :: inputs
      type(machine_model), target :: model
      type(equilibrium_type) :: found
      real(wp), allocatable :: y(:), rates(:), matrix(:, :), up(:), down(:), moved(:)
      real(wp) :: change
      integer :: i
      logical :: ok
      inputs = symmetric_rotor('bengisu_akay', 4100.0_wp, 0.02_wp)
      inputs%bearings(2)%friction%model = 'lugre'
      inputs%bearings(2)%assembled_clearance(:) = 85e-6_wp
      call add_bearing(inputs, 'middle', 5)
      inputs%bearings(3)%friction%model = 'none'
      inputs%bearings(3)%pads%motion = 'tilting_only'
      inputs%bearings(3)%assembled_clearance(:) = 200e-6_wp
      inputs%bearings(3)%machined_clearance(:) = 250e-6_wp
      call stand(inputs, model, found)
      y = model%static_state(found%rotor, found%pads)
      allocate (rates(model%n), matrix(model%n, model%n), up(model%n), down(model%n))
      ! journals and pads move, each in another way
      y = y + model%scale*1e-4_wp*[(sin(real(i, wp)), i=1, model%n)]
      call model%rhs_and_jacobian(1e-3_wp, y, rates, matrix, ok)
      call expect(ok, 'the model is linearised')
      do i = 1, model%n
         change = 1e-6_wp*model%scale(i)
         moved = y
         moved(i) = y(i) + change
         call model%rhs(1e-3_wp, moved, up, ok)
         moved(i) = y(i) - change
         call model%rhs(1e-3_wp, moved, down, ok)
         associate (differences => (up - down)/(2*change)*model%scale(i)/model%scale, own => &
            & matrix(:, i)*model%scale(i)/model%scale)
            call expect(maxval(abs(differences - own)) <= 1e-4_wp*max(1.0_wp, maxval(abs(own))), 'column '//to_text(i))
         end associate
      end do
   end subroutine jacobian

   subroutine frictionless_orbit()
      type(machine_model) :: model
      type(periodic_orbit_type) :: found
      integer, parameter :: n = 3600
      real(wp) :: path(2, 0:n - 1)
      call close_orbit(symmetric_rotor('none', 4100.0_wp, 0.02_wp), 1e-5_wp, model, found)
      path = over_orbit(model, found, disc_station, n)
      associate (limit => orbit_error*36.7_wp)
         call expect_close(minval(path(1, :)), -114.8298_wp, limit, 'lowest y of the disc')
         call expect_close(maxval(path(1, :)), -78.1092_wp, limit, 'highest y')
         call expect_close(minval(path(2, :)), -18.7561_wp, limit, 'lowest z')
         call expect_close(maxval(path(2, :)), 18.1382_wp, limit, 'highest z')
         call expect_close(norm2(path(:, 0) - [-100.3990_wp, -18.4656_wp]), 0.0_wp, limit, 'at phase 0')
      end associate
      path = over_orbit(model, found, 2, n)
      call expect_close(minval(path(1, :)), -74.7824_wp, orbit_error*18.3_wp, 'lowest y of the journal')
      call expect_close(maxval(path(1, :)), -56.4710_wp, orbit_error*18.3_wp, 'highest y of the journal')
   end subroutine frictionless_orbit

   !> Part of y at the frequency of the shaft, with and without friction.
   subroutine whirl()
      real(wp), parameter :: speeds(3) = [3300.0_wp, 4100.0_wp, 5200.0_wp]
      real(wp), parameter :: free(3) = [8.72335_wp, 18.35041_wp, 11.75074_wp]
      real(wp), parameter :: stuck(3) = [8.64448_wp, 21.13042_wp, 13.46417_wp]
      integer :: i
      do i = 1, 3
         call expect_close(whirl_of('none', speeds(i)), free(i), orbit_error*free(i), &
            & 'frictionless at '//to_text(speeds(i)))
         call expect_close(whirl_of('lugre', speeds(i)), stuck(i), orbit_error*stuck(i), &
            & 'LuGre at '//to_text(speeds(i)))
      end do
   end subroutine whirl

   real(wp) function whirl_of(friction, speed)
      character(len=*), intent(in) :: friction
      real(wp), intent(in) :: speed
      type(machine_model) :: model
      type(periodic_orbit_type) :: found
      integer, parameter :: n = 720
      real(wp) :: path(2, 0:n - 1)
      integer :: k
      call close_orbit(symmetric_rotor(friction, speed, 0.02_wp), 1e-5_wp, model, found)
      path = over_orbit(model, found, disc_station, n)
      whirl_of = 2*abs(sum([(path(1, k)*exp(cmplx(0, -2*pi*k/n, wp)), k=0, n - 1)]))/n
   end function whirl_of

   !> A third bearing in the middle, and one that is raised: all forces are in balance, and the raised bearing bears
   !> more.
   subroutine three_bearings()
      type(case_type) :: inputs
      type(machine_model) :: model, static
      type(equilibrium_type) :: found
      real(wp) :: level(2, 3), raised(2, 3)
      logical :: ok
      inputs = symmetric_rotor('none', 4100.0_wp, 0.0_wp)
      call add_bearing(inputs, 'middle', 6)
      call stand(inputs, model, found)
      level = bearing_loads(model, found)
      inputs%bearings(3)%offset = [20e-6_wp, 0.0_wp]
      call stand(inputs, model, found)
      raised = bearing_loads(model, found)
      call make_static(model, model%point%cavitation, static)
      associate (y => static%static_state(found%rotor, found%pads))
         call static%evaluate(0.0_wp, y, .false., ok)
         call expect(ok, 'the films are solved')
         associate (force => forces(static, 0.0_wp, y))
            call expect(maxval(abs(force(:6))) < 1e-4_wp*4000, 'the journals are in balance')
         end associate
      end associate
      associate (weight => [-4000*9.81_wp, 0.0_wp])
         call expect_close(norm2(sum(level, 2) - weight), 0.0_wp, 1e-6_wp*4e4_wp, 'all loads are the weight')
         call expect_close(norm2(sum(raised, 2) - weight), 0.0_wp, 1e-6_wp*4e4_wp, 'and with the raised one')
      end associate
      call expect(raised(1, 3) < level(1, 3) - 100, 'the raised bearing bears more')
   end subroutine three_bearings

   !> The same rotor described in other ways has the same statics and modes.
   subroutine descriptions()
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: found, other
      type(equilibrium_type) :: static
      inputs = symmetric_rotor('none', 4100.0_wp, 0.0_wp)
      inputs%rotor%elastic%discs(1)%station = 6
      call add_bearing(inputs, 'third', 4)
      inputs%bearings(3)%assembled_clearance(:) = 200e-6_wp
      inputs%bearings(3)%machined_clearance(:) = 250e-6_wp
      call analyse(inputs, 'as it is', found, static)
      call analyse(reordered(inputs), 'bearings in another order, with other names', other)
      call expect_same(found, other, 'order')
      call analyse(turned(inputs), 'from the other end', other)
      call expect_same(found, other, 'other end')

   end subroutine descriptions

   subroutine expect_same(found, other, what)
      type(bearing_coefficients_type), intent(in) :: found, other
      character(len=*), intent(in) :: what
      integer :: i
      do i = 1, 6
         call expect_close(minval(abs(other%modes(1)%eigenvalue - found%modes(1)%eigenvalue(i))), 0.0_wp, &
            & 1e-6_wp*abs(found%modes(1)%eigenvalue(i)), what//': mode '//to_text(i))
      end do
   end subroutine expect_same

   function reordered(inputs) result(other)
      type(case_type), intent(in) :: inputs
      type(case_type) :: other
      integer :: b
      other = inputs
      do b = 1, 3
         other%bearings(b) = inputs%bearings(4 - b)
         other%bearings(b)%name = 'number '//to_text(b)
      end do
   end function reordered

   function turned(inputs) result(other)
      type(case_type), intent(in) :: inputs
      type(case_type) :: other
      integer :: b, n
      other = inputs
      n = size(inputs%rotor%elastic%shaft%length)
      associate (m => other%rotor%elastic)
         m%shaft%length = m%shaft%length(n:1:-1)
         m%shaft%diameter = m%shaft%diameter(n:1:-1)
         m%discs(1)%station = n + 2 - m%discs(1)%station
         m%unbalances(1)%station = n + 2 - m%unbalances(1)%station
         do b = 1, size(other%bearings)
            other%bearings(b)%station = n + 2 - other%bearings(b)%station
         end do
      end associate
   end function turned

   !> A shaft that is a thousand, and ten thousand, times as stiff: the whirl tends to that of a rigid journal of
   !> half the mass and half the unbalance in one bearing, as one over the stiffness.
   subroutine stiff_shaft()
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: rigid, found
      real(wp) :: left(2)
      integer :: k
      inputs = case_type()
      inputs%operation%speed_rpm = 4100
      inputs%operation%final_speed_rpm = 4100
      inputs%bearings(1)%film%cavitation = 'none'
      call analyse(inputs, 'a rigid journal', rigid)
      do k = 1, 2
         inputs = symmetric_rotor('none', 4100.0_wp, 0.0_wp)
         inputs%rotor%elastic%shaft%young_modulus = 2.1e11_wp*1e2_wp*1e1_wp**k
         inputs%rotor%elastic%reduction%frequency = 1e6_wp
         call analyse(inputs, 'a stiff shaft', found)
         associate (limit => rigid%modes(1)%eigenvalue(1))
            left(k) = minval(abs(found%modes(1)%eigenvalue - limit))/abs(limit)
         end associate
      end do
      call expect(left(2) < 1e-3_wp, 'a shaft ten thousand times as stiff: '//to_text(left(2)))
      call expect_close(left(1)/left(2), 10.0_wp, 0.2_wp, 'the difference falls with the stiffness')
   end subroutine stiff_shaft

   !> Warm oil in the bearings of a machine is that of a rigid journal under the same load, in equilibrium and after a
   !> search with converged films.
   subroutine warm_oil(temperatures)
      character(len=*), intent(in) :: temperatures
      type(case_type) :: inputs, alone
      type(bearing_coefficients_type) :: found, rigid
      type(equilibrium_type) :: static, journal
      integer :: i
      alone = case_type()
      alone%operation%speed_rpm = 4100
      alone%operation%final_speed_rpm = 4100
      alone%bearings(1)%film%cavitation = 'none'
      alone%bearings(1)%oil%law = 'walther'
      alone%bearings(1)%oil%grade = 46
      alone%thermal%model = temperatures
      alone%bearings(1)%pads%thickness = alone%bearings(1)%pads%pivot_distance
      inputs = symmetric_rotor('none', 4100.0_wp, 0.0_wp)
      inputs%thermal%model = temperatures
      do i = 1, 2
         inputs%bearings(i)%oil = alone%bearings(1)%oil
         inputs%bearings(i)%pads%thickness = alone%bearings(1)%pads%thickness
      end do
      call analyse(alone, 'a rigid journal', rigid, journal)
      call analyse(inputs, 'a machine', found, static)
      do i = 1, 2
         call expect(all(abs(static%oil(2*i - 1:2*i)%viscosity/journal%oil%viscosity - 1) < 1e-6_wp), 'viscosities')
         call expect_close(found%stiffness(1, 1, 1, 1, i), rigid%stiffness(1, 1, 1, 1, 1), &
            & 1e-5_wp*rigid%stiffness(1, 1, 1, 1, 1), 'stiffness')
      end do
   end subroutine warm_oil

   !> The threshold speed of a machine is where an eigenvalue crosses: analyses on both sides say so.
   subroutine thresholds()
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: found, beside
      integer, parameter :: stuck = 2
      integer :: side
      inputs = symmetric_rotor('lugre', 5000.0_wp, 0.0_wp)
      inputs%coefficients%threshold_up_to_rpm = 12000
      call analyse(inputs, 'with thresholds', found)
      call expect(found%thresholds(stuck) > 5000, 'there is one')
      do side = -1, 1, 2
         inputs = symmetric_rotor('lugre', found%thresholds(stuck)*(1 + 1e-4_wp*side), 0.0_wp)
         call analyse(inputs, 'beside it', beside)
         call expect(maxval(beside%modes(stuck)%eigenvalue%re)*side > 0, 'the sign of the growth')
      end do
   end subroutine thresholds
end program test_machines
