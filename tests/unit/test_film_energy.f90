!> Temperatures in films: profiles across against closed forms, streams against losses and flows found otherwise, the
!> energy equation against heat that is only conducted, only carried, and balanced.
program test_film_energy
   use kinds, only: wp
   use film_solver, only: film_motion, film_oil, cavitation_reynolds
   use film_losses, only: film_losses_type, film_loss, new_film_losses
   use elimination_film, only: elimination_film_type
   use film_streams, only: film_stream, new_stream_volumes, find_stream
   use film_energy, only: film_profile, layer_faces, new_profile, fitted_oil, film_heat_type, solid_layers, &
      & by_nothing, by_inlet, by_shaft, pad_heat, solve_energy
   use film_eddies, only: with_eddies
   use turbulence_closure, only: closure_type, new_closure, closure_factors, along, shear, wall_law_type, &
      & new_wall_law, eddy_conduction
   use case_groups, only: oil_type
   use paper_bearing, only: offset_pad, paper_oil, speed, clearance
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   integer, parameter :: layers = 12, stations = 40
   !> J/(m^3 K), W/(m K), m, W/(m^2 K), C.
   type(film_heat_type), parameter :: usual = film_heat_type(1.7e6_wp, 0.13_wp, 50.0_wp, 50e-3_wp, 14e-3_wp, &
      & 100.0_wp, 40.0_wp)
   !> A loaded film, and one that cavitates.
   type(film_motion), parameter :: loaded = film_motion(clearance*[-0.25_wp, 0.35_wp]), &
      & diverging = film_motion(clearance*[0.05_wp, 0.4_wp])

   if (runs('even_profile')) call even_profile()
   if (runs('two_layers')) call two_layers()
   if (runs('fit')) call fit()
   if (runs('eddies')) call eddies()
   if (runs('streams')) call streams()
   if (runs('conducted')) call conducted()
   if (runs('carried')) call carried()
   if (runs('one_temperature')) call one_temperature()
   if (runs('balance')) call balance()
   call report()

contains

   type(film_heat_type) function heat_of(n) result(heat)
      integer, intent(in) :: n
      heat = usual
      heat%zeta = layer_faces(n)
   end function heat_of

   !> Of one viscosity: u = U zeta, and the parabola of pressure.
   subroutine even_profile()
      type(film_profile) :: profile
      real(wp) :: zeta(0:layers)
      zeta = layer_faces(layers)
      profile = new_profile(zeta, spread(50.0_wp, 1, layers))
      call expect_close(profile%f0, 0.02_wp, 1e-16_wp, 'f0')
      call expect_close(profile%f1, 0.5_wp, 1e-15_wp, 'f1')
      call expect_close(profile%f2, 50/12.0_wp, 1e-13_wp, 'f2')
      call expect(maxval(abs(profile%sliding - zeta**2/2)) < 1e-15_wp, 'below each face, by sliding')
      call expect(maxval(abs(profile%driven - 50*(zeta**2/4 - zeta**3/6))) < 1e-13_wp, 'and by pressure')
      call sums(profile)
   end subroutine even_profile

   !> Oil of one viscosity with eddies: the shear, mobility and conduction of the closure; without them the profile is
   !> the laminar one.
   subroutine eddies()
      type(film_profile) :: laminar(2), profiles(2)
      type(oil_type) :: oil
      type(wall_law_type) :: wall
      type(closure_type) :: closure
      type(closure_factors) :: of
      integer, parameter :: n = 48
      real(wp), parameter :: viscosity = 0.01_wp, surface_speed = 90, reynolds(2) = [3000.0_wp, 400.0_wp]
      real(wp) :: zeta(0:n)
      zeta = layer_faces(n)
      laminar(1) = new_profile(zeta, spread(1/viscosity, 1, n))
      laminar(2) = laminar(1)
      closure = new_closure('ng_pan', 500.0_wp, 1000.0_wp)
      profiles = with_eddies(closure, oil, zeta, reynolds*viscosity/(oil%density*surface_speed), surface_speed, laminar)
      of = closure%at(log(reynolds(1)))
      call expect_close(sum(profiles(1)%shear), profiles(1)%f0, 1e-12_wp, 'shear')
      call expect_close(sum(profiles(1)%pressure), profiles(1)%f2, 1e-11_wp, 'pressure')
      call expect_close(profiles(1)%f0, viscosity*exp(of%value(0, shear)), 1e-12_wp, 'f0')
      call expect_close(profiles(1)%driven(n), exp(of%value(0, along))/(12*viscosity), 1e-11_wp, 'f2')
      wall = new_wall_law()
      associate (factor => eddy_conduction(wall, reynolds(1), 1.0_wp, oil%specific_heat*viscosity/(oil%conductivity &
            & *oil%turbulent_prandtl)))
         ! two points of Gauss in each half of a layer
         call expect_close(1/sum(1/profiles(1)%conduction), oil%conductivity*factor, 1e-4_wp*oil%conductivity*factor, &
            & 'conduction')
      end associate
      call expect(.not. allocated(profiles(2)%conduction), 'laminar')
      call expect(.not. any(abs(profiles(2)%driven - laminar(2)%driven) > 0), 'laminar')
   end subroutine eddies

   !> What is in the layers adds up.
   subroutine sums(profile)
      type(film_profile), intent(in) :: profile
      call expect_close(sum(profile%shear), profile%f0, 1e-14_wp*profile%f0, 'shear')
      call expect_close(sum(profile%pressure), profile%f2, 1e-13_wp*profile%f2, 'pressure')
      call expect(abs(sum(profile%mixed)) < 1e-14_wp*maxval(abs(profile%mixed)), 'mixed')
   end subroutine sums

   !> Thin oil beside the pad, thick oil beside the journal: J_n by hand.
   subroutine two_layers()
      type(film_profile) :: profile
      real(wp), parameter :: thin = 100, thick = 25
      real(wp) :: fluidity(layers), j0, j1, j2
      fluidity(:layers/2) = thin
      fluidity(layers/2 + 1:) = thick
      profile = new_profile(layer_faces(layers), fluidity)
      j0 = (thin + thick)/2
      j1 = (thin + 3*thick)/8
      j2 = (thin + 7*thick)/24
      call expect_close(profile%f0, 1/j0, 1e-15_wp, 'f0')
      call expect_close(profile%f1, 1 - j1/j0, 1e-14_wp, 'f1')
      call expect_close(profile%f2, j2 - j1**2/j0, 1e-13_wp, 'f2')
      call sums(profile)
   end subroutine two_layers

   !> Weights that are polynomials come out exactly.
   subroutine fit()
      type(film_profile) :: profiles(stations)
      type(film_oil) :: oil
      real(wp) :: x(stations)
      integer :: i
      x = [((2*i - 1.0_wp)/stations - 1, i=1, stations)]
      profiles%f0 = 0.03_wp*exp(0.1_wp - 0.4_wp*x + 0.03_wp*x**4)
      profiles%f1 = 0.5_wp + 0.02_wp*x**3
      profiles%f2 = exp(-0.2_wp + 0.5_wp*x**2)/(12*0.03_wp)
      oil = fitted_oil(0.03_wp, profiles)
      call expect(oil%varies, 'uneven')
      call expect(maxval(abs(oil%shear - [0.1_wp, -0.4_wp, 0.0_wp, 0.0_wp, 0.03_wp])) < 1e-12_wp, 'f0')
      call expect(maxval(abs(oil%sliding - [0.5_wp, 0.0_wp, 0.0_wp, 0.02_wp, 0.0_wp])) < 1e-12_wp, 'f1')
      call expect(maxval(abs(oil%flow - [-0.2_wp, 0.0_wp, 0.5_wp, 0.0_wp, 0.0_wp])) < 1e-12_wp, 'f2')
   end subroutine fit

   !> Flows and heat of the streams against those of film_losses, within the error of these volumes.
   subroutine streams()
      call stream_of(loaded, 2e-3_wp)
      call stream_of(diverging, 5e-3_wp)
   end subroutine streams

   subroutine stream_of(motion, tolerance)
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: tolerance
      type(film_losses_type) :: losses
      type(film_loss) :: loss
      type(film_stream) :: stream
      type(elimination_film_type) :: volumes
      logical :: ok
      losses = new_film_losses(offset_pad(), cavitation_reynolds)
      call losses%find(motion, paper_oil, speed, loss)
      volumes = new_stream_volumes(offset_pad(), stations)
      call find_stream(volumes, cavitation_reynolds, motion, paper_oil, speed, stations, stream, ok)
      call expect(ok, 'found')
      call expect_close(stream%flow(0), loss%inlet, tolerance*loss%inlet, 'in')
      call expect_close(stream%flow(stations), loss%outlet, tolerance*loss%inlet, 'out')
      call expect_close(sum(stream%pressure_heat), loss%pressure, tolerance*(loss%pressure + loss%couette), 'heat')
      associate (surface => speed*offset_pad_radius())
         call expect_close(sum(paper_oil%viscosity*surface**2*stream%filled/stream%h)*stream%step*stream%width, &
            & loss%couette, tolerance*loss%couette, 'shear of sliding')
      end associate
   end subroutine stream_of

   real(wp) function offset_pad_radius() result(radius)
      associate (gap => offset_pad())
         radius = gap%journal_radius
      end associate
   end function offset_pad_radius

   !> A film in which nothing moves: heat goes from the shaft through film and pad to its back, in a row of resistances,
   !> that of the pad a ring's.
   subroutine conducted()
      type(film_stream) :: stream
      type(film_heat_type) :: heat
      type(film_profile) :: profiles(1)
      type(pad_heat) :: found
      real(wp), parameter :: h = 50e-6_wp, shaft = 70
      real(wp) :: flux
      heat = heat_of(layers)
      ! ends take heat, too, but little of a long station
      stream = even_stream(1, 10.0_wp, h, 0.0_wp)
      profiles(1) = new_profile(heat%zeta, spread(50.0_wp, 1, layers))
      call solve_energy(heat, stream, profiles, 0.0_wp, found)
      call expect(found%solved, 'solved')
      associate (bore => heat%radius, back => heat%radius + heat%thickness)
         flux = (shaft - heat%back_temperature)/(h/heat%conductivity + bore*log(back/bore)/heat%pad_conductivity &
            & + bore/back/heat%back_coefficient)
      end associate
      associate (to_shaft => found%to_shaft(by_nothing) + shaft*found%to_shaft(by_shaft))
         ! both ends take as much more as their area is to that of the back
         call expect_close(-to_shaft, flux*stream%step*stream%width, 2*heat%thickness/stream%step*flux*stream%step &
            & *stream%width, 'through film and pad')
         call expect_close(-to_shaft, found%to_back(by_nothing) + shaft*found%to_back(by_shaft), &
            & 1e-9_wp*abs(to_shaft), 'what goes in comes out')
      end associate
   end subroutine conducted

   !> Walls that take no heat: the oil takes all of it.
   subroutine carried()
      type(film_stream) :: stream
      type(film_heat_type) :: heat
      type(film_profile) :: profiles(stations)
      type(pad_heat) :: found
      integer :: i
      heat = heat_of(layers)
      heat%conductivity = 1e-12_wp
      heat%back_coefficient = 0
      stream = even_stream(stations, 1.5e-3_wp, 100e-6_wp, 30.0_wp)
      do i = 1, stations
         profiles(i) = new_profile(heat%zeta, spread(50.0_wp, 1, layers))
      end do
      call solve_energy(heat, stream, profiles, 30.0_wp, found)
      call expect_close(found%made, 0.02_wp*30**2/100e-6_wp*stations*stream%step*stream%width, 1e-9_wp*found%made, &
         & 'heat of sliding')
      associate (out => found%outlet(by_nothing) + 45*found%outlet(by_inlet) + 60*found%outlet(by_shaft))
         call expect_close(out, 45 + found%made/(heat%capacity*stream%flow(0)), 1e-6_wp, 'warming')
      end associate
   end subroutine carried

   !> A film of even thickness, m, without pressure, 0.1 m wide, of stations of this length, m, at a surface speed, m/s.
   type(film_stream) function even_stream(n, step, h, surface_speed) result(stream)
      integer, intent(in) :: n
      real(wp), intent(in) :: step, h, surface_speed
      stream%step = step
      stream%width = 0.1_wp
      allocate (stream%flow(0:n), source=surface_speed*h*stream%width/2)
      allocate (stream%h_face(0:n), stream%h(n), source=h)
      allocate (stream%filled_face(0:n), stream%filled(n), source=1.0_wp)
      allocate (stream%pressure_heat(n), source=0.0_wp)
   end function even_stream

   !> The stream and the profiles of a film with uneven viscosity that flows back at its leading edge.
   subroutine uneven_film(heat, stream, profiles)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(out) :: stream
      type(film_profile), intent(out) :: profiles(stations)
      type(film_oil) :: oil
      type(elimination_film_type) :: volumes
      logical :: ok
      integer :: i, j
      do i = 1, stations
         profiles(i) = new_profile(heat%zeta, [(50 + i*(1 - real(j, wp)/layers), j=1, layers)])
      end do
      oil = fitted_oil(0.02_wp, profiles)
      volumes = new_stream_volumes(offset_pad(), stations)
      call find_stream(volumes, cavitation_reynolds, film_motion(clearance*[-0.85_wp, 0.5_wp]), oil, speed, &
         & stations, stream, ok)
      call expect(ok, 'film')
   end subroutine uneven_film

   !> Inlet, shaft and back at one temperature, and no heat made: so is all, wherever the oil flows.
   subroutine one_temperature()
      type(film_heat_type) :: heat
      type(film_stream) :: stream
      type(film_profile) :: profiles(stations)
      type(pad_heat) :: found
      heat = heat_of(layers)
      heat%back_coefficient = 0
      call uneven_film(heat, stream, profiles)
      call solve_energy(heat, stream, profiles, speed*offset_pad_radius(), found)
      call expect(found%back_flow > 0, 'some oil flows back')
      call expect(maxval(abs(found%field(:, :, by_inlet) + found%field(:, :, by_shaft) - 1)) < 1e-9_wp, 'fields')
      call expect(abs(found%outlet(by_inlet) + found%outlet(by_shaft) - 1) < 1e-9_wp, 'outlet')
      call expect(abs(found%back(by_inlet) + found%back(by_shaft) - 1) < 1e-9_wp, 'back')
   end subroutine one_temperature

   !> What is made leaves with the oil, to the shaft and out of the back: with oil that leaves at the sides where it is.
   subroutine balance()
      type(film_heat_type) :: heat
      type(film_stream) :: stream
      type(film_profile) :: profiles(stations)
      type(pad_heat) :: found
      real(wp), parameter :: inlet = 45, shaft = 60
      real(wp) :: field(solid_layers + layers, stations), left, parts(3), out_flow
      integer :: i, j
      heat = heat_of(layers)
      call uneven_film(heat, stream, profiles)
      call solve_energy(heat, stream, profiles, speed*offset_pad_radius(), found)
      parts = [1.0_wp, inlet, shaft]
      field = found%field(:, :, by_nothing) + inlet*found%field(:, :, by_inlet) + shaft*found%field(:, :, by_shaft)
      left = dot_product(found%to_shaft + found%to_back, parts)
      do i = 1, stations
         do j = 1, layers
            left = left + heat%capacity*(stream%flow(i - 1) - stream%flow(i))*(profiles(i)%driven(j) &
               & - profiles(i)%driven(j - 1))/profiles(i)%f2*field(solid_layers + j, i)
         end do
      end do
      out_flow = stream%flow(stations)
      left = left + heat%capacity*(out_flow*dot_product(found%outlet, parts) &
         & + found%back_flow*dot_product(found%back, parts) - (stream%flow(0) + found%back_flow)*inlet)
      call expect_close(left, found%made, 1e-9_wp*found%made, 'balance')
   end subroutine balance
end program test_film_energy
