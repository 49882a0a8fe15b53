!> Machines that must move alike, however they are described; limits in which they become something simpler; the energy
!> of a closed orbit; response in the square of a small unbalance.
program test_machine_invariants
   use kinds, only: wp, pi
   use text, only: to_text
   use errors, only: error_type
   use case_inputs, only: case_type
   use tilting_pad_bearing, only: pad_sample
   use state_layout, only: pad_state, tilt, pivot_deflection
   use equations_of_motion, only: machine_model
   use equilibrium_record, only: equilibrium_type
   use equilibrium, only: bearing_loads
   use linear_bearing, only: bearing_coefficients_type
   use rotor_response, only: rotor_response_type, find_rotor_response
   use linear_analysis, only: analyse
   use periodic_orbit, only: periodic_orbit_type
   use machine_cases, only: symmetric_rotor, disc_station
   use machine_orbits, only: stand, close_orbit, over_orbit, orbit_state
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)

   !> Tolerance of orbits, over the scale of each state, and how close two orbits of the same motion are: each errs by
   !> some tolerances.
   real(wp), parameter :: tolerance = 1e-6_wp, alike = 2e-5_wp
   !> Phases at which orbits are compared.
   integer, parameter :: n = 72

   if (runs('order')) call order()
   if (runs('phases')) call phases()
   if (runs('offsets')) call offsets()
   if (runs('added_stations')) call added_stations()
   if (runs('stiff_shaft')) call stiff_shaft()
   if (runs('stiff_support')) call stiff_support()
   if (runs('weights')) call weights()
   if (runs('energy')) call energy()
   if (runs('small_unbalance')) call small_unbalance()
   call report()

contains

   !> A rotor without any symmetry: disc off the middle, bearings that differ in clearance and friction, one on a
   !> support.
   type(case_type) function uneven_rotor() result(inputs)
      inputs = symmetric_rotor('lugre', 4100.0_wp, 0.02_wp)
      inputs%rotor%elastic%discs(1)%station = 6
      inputs%rotor%elastic%unbalances(1)%station = 6
      associate (b => inputs%bearings(2))
         b%friction%model = 'none'
         b%assembled_clearance(:) = 100e-6_wp
         b%machined_clearance(:) = 125e-6_wp
         allocate (b%support)
         b%support%mass = 400
         b%support%stiffness = [1.5e9_wp, 8e8_wp]
         b%support%damping = [2e5_wp, 1e5_wp]
      end associate
   end function uneven_rotor

   !> y and z of a station over the orbit of a case, um.
   function path_of(inputs, station) result(path)
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: station
      real(wp) :: path(2, 0:n - 1)
      type(machine_model) :: model
      type(periodic_orbit_type) :: found
      call close_orbit(inputs, tolerance, model, found)
      path = over_orbit(model, found, station, n)
   end function path_of

   !> That of the uneven rotor's disc, sought once for all cases.
   function uneven_path() result(path)
      real(wp) :: path(2, 0:n - 1)
      real(wp), allocatable, save :: found(:, :)
      if (.not. allocated(found)) found = path_of(uneven_rotor(), 6)
      path = found
   end function uneven_path

   !> Expects that two paths, um, are the same but for errors of orbits.
   subroutine expect_alike(path, other, what)
      real(wp), intent(in) :: path(:, :), other(:, :)
      character(len=*), intent(in) :: what
      associate (size_of => maxval(maxval(path, 2) - minval(path, 2)), far => maxval(abs(path - other)))
         call expect(far < alike*size_of, what//': '//to_text(far)//' of '//to_text(size_of)//' um')
      end associate
   end subroutine expect_alike

   !> Bearings in another order with other names; stations counted from the other end.
   subroutine order()
      type(case_type) :: inputs, other
      real(wp) :: path(2, 0:n - 1)
      integer :: sections
      inputs = uneven_rotor()
      path = uneven_path()
      other = inputs
      other%bearings(1) = inputs%bearings(2)
      other%bearings(2) = inputs%bearings(1)
      other%bearings(1)%name = 'one'
      other%bearings(2)%name = 'two'
      call expect_alike(path, path_of(other, 6), 'bearings in another order')
      other = inputs
      sections = size(inputs%rotor%elastic%shaft%length)
      associate (m => other%rotor%elastic)
         m%shaft%length = m%shaft%length(sections:1:-1)
         m%shaft%diameter = m%shaft%diameter(sections:1:-1)
         m%discs%station = sections + 2 - m%discs%station
         m%unbalances%station = sections + 2 - m%unbalances%station
         other%bearings%station = sections + 2 - other%bearings%station
      end associate
      call expect_alike(path, path_of(other, sections + 2 - 6), 'stations from the other end')
   end subroutine order

   !> Two unbalances at +-60 degrees are one at 0; all of them turned by a quarter, the motion comes a quarter of a
   !> revolution earlier.
   subroutine phases()
      type(case_type) :: inputs
      real(wp) :: path(2, 0:n - 1), turned(2, 0:n - 1)
      inputs = uneven_rotor()
      path = uneven_path()
      inputs%rotor%elastic%unbalances = spread(inputs%rotor%elastic%unbalances(1), 1, 2)
      inputs%rotor%elastic%unbalances%angle_deg = [60.0_wp, -60.0_wp]
      call expect_alike(path, path_of(inputs, 6), 'two unbalances')
      inputs%rotor%elastic%unbalances%angle_deg = [150.0_wp, 30.0_wp]
      turned = path_of(inputs, 6)
      call expect_alike(path, cshift(turned, -n/4, dim=2), 'turned by a quarter')
   end subroutine phases

   !> All bearings offset alike: the shaft is elsewhere and moves as before.
   subroutine offsets()
      type(case_type) :: inputs
      real(wp) :: path(2, 0:n - 1), moved(2, 0:n - 1)
      real(wp), parameter :: offset(2) = [300e-6_wp, -200e-6_wp]
      integer :: b
      inputs = uneven_rotor()
      path = uneven_path()
      do b = 1, 2
         inputs%bearings(b)%offset = offset
      end do
      moved = path_of(inputs, 6)
      call expect_alike(path, moved - spread(1e6_wp*offset, 2, n), 'offset alike')
   end subroutine offsets

   !> Every section divided in two, and in four: deflections stay, and eigenvalues change by an error of the mesh that
   !> falls with the square of the sections' lengths, as shear and rotary inertia matter here.
   subroutine added_stations()
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: found(3)
      type(equilibrium_type) :: static(3)
      real(wp) :: change(2)
      integer :: i, k
      inputs = symmetric_rotor('none', 4100.0_wp, 0.02_wp)
      inputs%rotor%elastic%discs(1)%station = 6
      ! the same modes for all meshes
      inputs%rotor%elastic%reduction%frequency = 4000
      do k = 1, 3
         call analyse(inputs, 'the machine is analysed', found(k), static(k))
         call divide(inputs)
      end do
      call expect(maxval(abs(static(2)%rotor(:4) - static(1)%rotor(:4))) < 1e-12_wp, 'the journals stay')
      do k = 1, 2
         change(k) = 0
         do i = 1, size(found(k)%modes(1)%eigenvalue)
            associate (value => found(k)%modes(1)%eigenvalue(i))
               if (value%im < 100 .or. value%im > 2000) cycle
               change(k) = max(change(k), minval(abs(found(k + 1)%modes(1)%eigenvalue - value))/abs(value))
            end associate
         end do
      end do
      call expect(change(1) < 2e-4_wp, 'the error of the mesh: '//to_text(change(1)))
      associate (fall => change(1)/change(2))
         call expect(fall > 3.5_wp, 'it falls with the square of the sections: '//to_text(fall))
      end associate
   end subroutine added_stations

   subroutine divide(inputs)
      type(case_type), intent(inout) :: inputs
      integer :: i
      associate (m => inputs%rotor%elastic)
         associate (twice => [(i, i, i=1, size(m%shaft%length))])
            m%shaft%diameter = m%shaft%diameter(twice)
            m%shaft%bore = m%shaft%bore(twice)
            m%shaft%length = m%shaft%length(twice)/2
         end associate
         m%discs%station = 2*m%discs%station - 1
         m%unbalances%station = 2*m%unbalances%station - 1
         inputs%bearings%station = 2*inputs%bearings%station - 1
      end associate
   end subroutine divide

   !> A stiff shaft on two bearings that are alike moves as a rigid journal of half its mass and half its unbalance,
   !> with LuGre friction too; what is left falls as one over the stiffness.
   subroutine stiff_shaft()
      type(case_type) :: inputs
      type(machine_model) :: model
      type(periodic_orbit_type) :: found
      real(wp) :: rigid(2, 0:n - 1), path(2, 0:n - 1), y(200), left(2)
      integer :: k, i
      inputs = case_type()
      inputs%operation%speed_rpm = 4100
      inputs%operation%final_speed_rpm = 4100
      inputs%bearings(1)%film%cavitation = 'none'
      inputs%bearings(1)%friction%model = 'lugre'
      inputs%rotor%mass = 2000
      inputs%rotor%unbalance = 0.01_wp
      call close_orbit(inputs, tolerance, model, found)
      do i = 0, n - 1
         y(:model%n) = orbit_state(model, found, i, n)
         rigid(:, i) = 1e6_wp*y(:2)
      end do
      do k = 1, 2
         inputs = symmetric_rotor('lugre', 4100.0_wp, 0.02_wp)
         inputs%rotor%elastic%shaft%young_modulus = 2.1e11_wp*1e2_wp*1e1_wp**k
         ! the same modes of either
         inputs%rotor%elastic%reduction%frequency = 2000*sqrt(1e2_wp*1e1_wp**k)
         path = path_of(inputs, 2)
         left(k) = maxval(abs(path - rigid))/maxval(maxval(rigid, 2) - minval(rigid, 2))
      end do
      call expect(left(2) < 2e-3_wp, 'a shaft ten thousand times as stiff: '//to_text(left(2)))
      call expect_close(left(1)/left(2), 10.0_wp, 0.5_wp, 'the difference falls with the stiffness')
   end subroutine stiff_shaft

   !> A very stiff support is as none; what is left falls as one over its stiffness.
   subroutine stiff_support()
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: ground, found
      real(wp) :: left(2)
      integer :: k, i
      inputs = uneven_rotor()
      deallocate (inputs%bearings(2)%support)
      call analyse(inputs, 'on the ground', ground)
      do k = 1, 2
         inputs = uneven_rotor()
         inputs%bearings(2)%support%stiffness = 1e12_wp*1e1_wp**k
         call analyse(inputs, 'on a stiff support', found)
         left(k) = maxval([(minval(abs(found%modes(1)%eigenvalue - ground%modes(1)%eigenvalue(i))) &
            & /abs(ground%modes(1)%eigenvalue(i)), i=1, 4)])
      end do
      call expect(left(2) < 1e-4_wp, 'a support of 1e14 N/m: '//to_text(left(2)))
      call expect_close(left(1)/left(2), 10.0_wp, 0.2_wp, 'the difference falls with the stiffness')
   end subroutine stiff_support

   !> Static loads and heavy pads whose centres of gravity lie aside: both bearings stand as a rigid journal does under
   !> half the load, as a shaft bends without changing how two bearings share it.
   subroutine weights()
      type(case_type) :: inputs, alone
      type(machine_model) :: model
      type(equilibrium_type) :: found, rigid, light
      real(wp), parameter :: load(2) = [3000.0_wp, -1000.0_wp], mass(2) = [30.0_wp, 50.0_wp], &
         & aside(2) = [8e-3_wp, -5e-3_wp]
      real(wp) :: loads(2, 2)
      integer :: b
      alone = case_type()
      alone%operation%speed_rpm = 4100
      alone%operation%final_speed_rpm = 4100
      alone%bearings(1)%film%cavitation = 'none'
      alone%rotor%mass = 2000
      alone%rotor%static_load = load/2
      call stand(alone, model, light)
      alone%bearings(1)%pads%mass = mass
      alone%bearings(1)%pads%inertia = mass*1e-2_wp
      alone%bearings(1)%pads%centre_tangential = aside
      call stand(alone, model, rigid)
      call expect(maxval(abs(rigid%pads%x(tilt) - light%pads%x(tilt))) > 1e-3_wp*maxval(abs(light%pads%x(tilt))), &
         & 'the weight of pads matters')
      inputs = symmetric_rotor('none', 4100.0_wp, 0.0_wp)
      do b = 1, 2
         inputs%bearings(b)%pads%mass = mass
         inputs%bearings(b)%pads%inertia = mass*1e-2_wp
         inputs%bearings(b)%pads%centre_tangential = aside
      end do
      deallocate (inputs%rotor%elastic%loads)
      allocate (inputs%rotor%elastic%loads(2))
      inputs%rotor%elastic%loads%station = [5, 9]
      do b = 1, 2
         inputs%rotor%elastic%loads(b)%force = load/2
      end do
      call stand(inputs, model, found)
      loads = bearing_loads(model, found)
      do b = 1, 2
         call expect_close(norm2(loads(:, b) - [load(1)/2 - 2000*9.81_wp, load(2)/2]), 0.0_wp, 1e-5_wp*2e4_wp, 'load')
         call expect(maxval(abs(found%rotor(2*b - 1:2*b) - rigid%rotor)) < 1e-6_wp*maxval(abs(rigid%rotor)), 'journal')
         call expect(maxval(abs(found%pads(2*b - 1:2*b)%x(tilt) - rigid%pads%x(tilt))) &
            & < 1e-6_wp*maxval(abs(rigid%pads%x(tilt))), 'tilts')
      end do
   end subroutine weights

   !> Over a revolution of a closed orbit the unbalance does the work that films, pivots, supports and the damping of
   !> high modes take: to the tolerance of the work that flows.
   subroutine energy()
      real(wp) :: work(5), flow, left(2)
      integer :: k
      do k = 1, 2
         call balance(1e-3_wp*1e-2_wp**k, work, flow)
         left(k) = abs(sum(work))/flow
         call expect(left(k) < 1e-3_wp*1e-2_wp**k, 'energy: '//to_text(left(k))//' of '//to_text(flow)//' J')
      end do
      call expect(work(1) > 0, 'the unbalance drives: '//to_text(work(1))//' J')
      call expect(work(3) < 0, 'friction takes: '//to_text(work(3))//' J')
      call expect(work(5) < 0, 'supports and damped modes take: '//to_text(work(5))//' J')
      call expect(minval(abs(work([1, 2, 3, 5]))) > 100*abs(sum(work)), 'each of them counts in the balance')
   end subroutine energy

   !> Work of each of `powers` over an orbit closed at a tolerance, J, and the sum of its amounts.
   subroutine balance(tolerance, work, flow)
      real(wp), intent(in) :: tolerance
      real(wp), intent(out) :: work(5), flow
      integer, parameter :: phases = 4320
      type(machine_model) :: model
      type(periodic_orbit_type) :: found
      real(wp) :: power(5), y(200)
      integer :: k
      logical :: ok, all_ok
      call close_orbit(uneven_rotor(), tolerance, model, found)
      work = 0
      flow = 0
      all_ok = .true.
      do k = 0, phases - 1
         associate (t => found%period*k/phases, state => y(:model%n))
            state = orbit_state(model, found, k, phases)
            call model%evaluate(t, state, .false., ok)
            all_ok = all_ok .and. ok
            power = powers(model, t, state)
            work = work + power*found%period/phases
            flow = flow + sum(abs(power))*found%period/phases
         end associate
      end do
      call expect(all_ok, 'the bearings are evaluated')
   end subroutine balance

   !> Power, W, of the unbalances, of films on journals and pads, of friction, of what eqs (3)-(4) hold beside a
   !> potential, and of dampers, in the state evaluated last.
   function powers(model, t, y) result(power)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: t, y(:)
      real(wp) :: power(5), a, film(2)
      real(wp), dimension(model%rotor%positions, model%rotor%positions) :: over_positions, over_rates
      type(pad_sample), allocatable :: films(:)
      type(pad_state), allocatable :: pads(:)
      integer :: b, i
      associate (m => model%rotor%positions)
         associate (rates => y(m + 1:2*m))
            power = 0
            power(1) = unbalance_power(model, t, rates)
            call model%rotor%force_derivatives(model%point%speed(t), over_positions, over_rates)
            power(5) = dot_product(rates, matmul(over_rates, rates))
            do b = 1, size(model%bearings)
               films = model%bearings(b)%sampled()
               pads = model%layout%elements(b)%pad_states(y)
               do i = 1, size(pads)
                  associate (pad => model%bearings(b)%pads(i), force => films(i)%film_force, &
                     & rate => pads(i)%v(tilt), depth_rate => pads(i)%v(pivot_deflection))
                     a = pad%position%angle - pads(i)%x(tilt)
                     film = [cos(a)*force(1) + sin(a)*force(2), -sin(a)*force(1) + cos(a)*force(2)]
                     power(2) = power(2) + dot_product(film, rates(2*b - 1:2*b)) &
                        & - force(1)*pad%position%centre_distance*rate - force(2)*depth_rate
                     power(3) = power(3) - films(i)%friction_moment*rate
                     power(4) = power(4) + (pad%mass*pad%centre_radial*rate**2 - pad%weight*sin(a))*depth_rate
                  end associate
               end do
            end do
         end associate
      end associate
   end function powers

   !> Power of the unbalances on the velocities of their stations, W.
   real(wp) function unbalance_power(model, t, rates) result(power)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: t, rates(:)
      real(wp) :: velocity(2, model%rotor%stations), at_rest(model%rotor%states), phase
      integer :: k
      at_rest = 0
      velocity = model%rotor%station_displacements([rates, 0*rates]) - model%rotor%station_displacements(at_rest)
      power = 0
      do k = 1, size(model%inputs%rotor%elastic%unbalances)
         associate (u => model%inputs%rotor%elastic%unbalances(k))
            phase = model%point%shaft_angle(t) + u%angle_deg*pi/180
            power = power + u%moment*model%point%speed(t)**2 &
               & *dot_product(velocity(:, u%station), [cos(phase), sin(phase)])
         end associate
      end do
   end function unbalance_power

   !> What a small unbalance does beyond the linear response grows as its square: 7e-4 of it at 2e-3 kg m in an
   !> independent program.
   subroutine small_unbalance()
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: linear
      type(rotor_response_type) :: response
      type(machine_model) :: model
      type(error_type), allocatable :: error
      real(wp), parameter :: unbalances(3) = [1e-3_wp, 2e-3_wp, 4e-3_wp]
      real(wp) :: beyond(3)
      complex(wp) :: whirl
      integer :: k
      do k = 1, 3
         inputs = symmetric_rotor('none', 4100.0_wp, unbalances(k))
         ! which motions have and the linear response has not
         inputs%rotor%elastic%reduction%damping_ratio = 0.01_wp
         call analyse(inputs, 'the machine is analysed', linear, fine=model)
         call find_rotor_response(model, linear, response, error)
         call expect_no_error(error, 'the response is found')
         whirl = whirl_of(inputs)
         beyond(k) = abs(whirl - response%unbalance(1, disc_station, 1)*1e6_wp)/abs(whirl)
      end do
      call expect_close(beyond(2), 7e-4_wp, 0.5e-4_wp, 'at 2e-3 kg m')
      call expect_close(beyond(2)/beyond(1), 4.0_wp, 0.1_wp, 'the square of the unbalance')
      call expect_close(beyond(3)/beyond(2), 4.0_wp, 0.1_wp, 'the square of the unbalance')
   end subroutine small_unbalance

   !> y of the disc at the frequency of the shaft, um.
   complex(wp) function whirl_of(inputs)
      type(case_type), intent(in) :: inputs
      type(machine_model) :: model
      type(periodic_orbit_type) :: found
      real(wp) :: path(2, 0:n - 1)
      integer :: k
      call close_orbit(inputs, 1e-8_wp, model, found)
      path = over_orbit(model, found, disc_station, n)
      whirl_of = 2*sum([(path(1, k)*exp(cmplx(0, -2*pi*k/n, wp)), k=0, n - 1)])/n
   end function whirl_of
end program test_machine_invariants
