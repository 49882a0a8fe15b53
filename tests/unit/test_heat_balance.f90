!> Temperatures of the oil from losses and flows: limits, sums, and the way along a film, integrated.
program test_heat_balance
   use kinds, only: wp, degree
   use case_inputs, only: case_type
   use oil_properties, only: viscosity
   use bearing_losses, only: pad_loss
   use heat_balance, only: heat_balance_type, oil_temperatures_type, new_heat_balance
   use input_cases, only: case_of
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   !> rad/s; Pa s.
   real(wp), parameter :: speed = 500, films(4) = [0.03_wp, 0.02_wp, 0.025_wp, 0.015_wp]

   if (runs('along_a_film')) call along_a_film()
   if (runs('adiabatic')) call adiabatic()
   if (runs('energy')) call energy()
   if (runs('carry_over')) call carry_over()
   if (runs('order_of_pads')) call order_of_pads()
   if (runs('viscosities')) call viscosities()
   if (runs('no_fresh_oil')) call no_fresh_oil()
   if (runs('standing_oil')) call standing_oil()
   if (runs('kept')) call kept()
   if (runs('renewal')) call renewal()
   call report()

contains

   !> Four pads of 70 degrees with oil of VG 46.
   type(case_type) function four_pads() result(inputs)
      inputs = case_of('&pads pivot_angle_deg = -45, 225, 45, 135, arc_deg = 70 / ' &
         & //'&oil law = ''walther'', grade = 46 / &thermal model = ''pad'' /')
   end function four_pads

   !> Random losses and flows of four pads, some of which take oil in at the sides.
   function some_losses() result(losses)
      type(pad_loss) :: losses(4)
      integer :: i
      do i = 1, 4
         losses(i)%couette = between(100.0_wp, 3000.0_wp)
         losses(i)%pressure = between(0.0_wp, 200.0_wp)
         losses(i)%boundary = between(0.0_wp, 10.0_wp)
         losses(i)%inlet = between(2e-5_wp, 9e-5_wp)
         losses(i)%outlet = losses(i)%inlet*between(0.5_wp, 1.1_wp)
      end do
   end function some_losses

   !> The temperatures, which must be there.
   type(oil_temperatures_type) function balanced(inputs, losses, of) result(oil)
      type(case_type), intent(in) :: inputs
      type(pad_loss), intent(in) :: losses(:)
      !> Viscosities, if they are not the first of `films`.
      real(wp), intent(in), optional :: of(:)
      type(heat_balance_type) :: balance
      real(wp) :: viscosities(size(losses))
      logical :: ok
      viscosities = films(:size(losses))
      if (present(of)) viscosities = of
      balance = new_heat_balance(inputs%bearings(1), inputs%sense())
      call balance%temperatures(losses, viscosities, speed, oil, ok)
      call expect(ok, 'there is a balance')
   end function balanced

   !> Conductance of a film to the shaft, W/K: Nu k times the integral of dA/h.
   elemental real(wp) function conductance(inputs, loss, film)
      type(case_type), intent(in) :: inputs
      type(pad_loss), intent(in) :: loss
      real(wp), intent(in) :: film
      conductance = inputs%bearings(1)%oil%shaft_nusselt*inputs%bearings(1)%oil%conductivity*loss%couette &
         & /(film*(speed*inputs%bearings(1)%journal_radius)**2)
   end function conductance

   !> One pad of fresh oil beside a shaft of known temperature: dT/ds = Phi/m - N (T - T_J), by Runge and Kutta.
   subroutine along_a_film()
      type(case_type) :: inputs
      type(pad_loss) :: loss
      type(oil_temperatures_type) :: oil
      real(wp) :: capacity, n, t, mean, k(4)
      integer :: step, i
      integer, parameter :: steps = 1000
      real(wp), parameter :: shares(6) = [1e-3_wp, 9.99e-3_wp, 1.001e-2_wp, 0.3_wp, 3.0_wp, 30.0_wp]
      inputs = four_pads()
      inputs%bearings(1)%pads%pivot_angle_deg = [-90.0_wp]
      inputs%bearings(1)%machined_clearance = inputs%bearings(1)%machined_clearance(:1)
      inputs%bearings(1)%axial_length = inputs%bearings(1)%axial_length(:1)
      inputs%bearings(1)%oil%shaft_temperature = 75
      do i = 1, size(shares)
         loss = pad_loss(couette=1500.0_wp, pressure=120.0_wp, inlet=6e-5_wp, outlet=4e-5_wp)
         capacity = inputs%bearings(1)%oil%density*inputs%bearings(1)%oil%specific_heat*5e-5_wp
         ! N from 0.001 to 30, on both sides of where series give way to closed forms
         n = shares(i)
         inputs%bearings(1)%oil%shaft_nusselt = 1
         inputs%bearings(1)%oil%shaft_nusselt = n*capacity/conductance(inputs, loss, films(1))
         oil = balanced(inputs, [loss])
         t = inputs%bearings(1)%oil%supply_temperature
         mean = 0
         do step = 1, steps
            k(1) = rate(t, n, 1620/capacity)
            k(2) = rate(t + k(1)/(2*steps), n, 1620/capacity)
            k(3) = rate(t + k(2)/(2*steps), n, 1620/capacity)
            k(4) = rate(t + k(3)/steps, n, 1620/capacity)
            mean = mean + (t + (k(1) + k(2) + k(3))/(6*steps))/steps
            t = t + (k(1) + 2*k(2) + 2*k(3) + k(4))/(6*steps)
         end do
         call expect_close(oil%outlet(1), t, 1e-6_wp, 'where the film ends')
         call expect_close(oil%mean(1), mean, 1e-6_wp, 'mean')
         call expect_close(oil%maximum(1), t + max(t - 75, 0.0_wp)/2, 1e-6_wp, 'pad')
      end do
   end subroutine along_a_film

   !> dT/ds beside a shaft of 75 C.
   pure real(wp) function rate(t, n, warming)
      real(wp), intent(in) :: t, n, warming
      rate = warming - n*(t - 75)
   end function rate

   !> Without exchange each film warms its own oil; the shaft lies between the films.
   subroutine adiabatic()
      type(case_type) :: inputs
      type(pad_loss) :: losses(4)
      type(oil_temperatures_type) :: oil
      real(wp) :: rise(4)
      inputs = four_pads()
      inputs%bearings(1)%oil%shaft_nusselt = 0
      losses = some_losses()
      oil = balanced(inputs, losses)
      rise = losses%power()/(inputs%bearings(1)%oil%density*inputs%bearings(1)%oil%specific_heat*(losses%inlet &
         & + losses%outlet)/2)
      call expect(all(abs(oil%outlet - oil%inlet - rise) < 1e-10_wp), 'warming')
      call expect(all(abs(oil%mean - (oil%inlet + oil%outlet)/2) < 1e-10_wp), 'mean')
      call expect(oil%shaft > minval(oil%mean) .and. oil%shaft < maxval(oil%mean), 'shaft')
   end subroutine adiabatic

   !> All heat leaves with the oil, but for what a shaft of known temperature takes.
   subroutine energy()
      type(case_type) :: inputs
      type(pad_loss) :: losses(4)
      type(oil_temperatures_type) :: oil
      real(wp) :: heat, fresh, hot
      integer :: k, i
      integer, parameter :: upstream(4) = [3, 1, 4, 2]
      do k = 1, 20
         inputs = four_pads()
         inputs%bearings(1)%oil%carry_over = between(0.0_wp, 1.0_wp)
         inputs%bearings(1)%oil%widest_gap_deg = merge(60, 10, k < 15)
         if (k > 10) inputs%bearings(1)%oil%shaft_temperature = between(20.0_wp, 100.0_wp)
         losses = some_losses()
         oil = balanced(inputs, losses)
         heat = sum(losses%power())
         if (k > 10) heat = heat - sum(conductance(inputs, losses, films)*(oil%mean - oil%shaft))
         fresh = sum(losses%inlet)
         do i = 1, 4
            hot = min(inputs%bearings(1)%oil%carry_over*losses(upstream(i))%outlet, losses(i)%inlet)
            if (inputs%bearings(1)%oil%widest_gap_deg < 20) hot = 0
            fresh = fresh - hot
         end do
         call expect_close(inputs%bearings(1)%oil%density*inputs%bearings(1)%oil%specific_heat*fresh*(oil%drain &
            & - inputs%bearings(1)%oil%supply_temperature), heat, 1e-10_wp*sum(losses%power()), 'drain')
      end do
   end subroutine energy

   !> Oil crosses gaps of 20 degrees, from the pad at the next larger angle.
   subroutine carry_over()
      type(case_type) :: inputs
      type(pad_loss) :: losses(4)
      type(oil_temperatures_type) :: oil
      real(wp) :: hot
      inputs = four_pads()
      losses = some_losses()
      oil = balanced(inputs, losses)
      hot = min(0.8_wp*losses(3)%outlet/losses(1)%inlet, 1.0_wp)
      call expect_close(oil%inlet(1), hot*oil%outlet(3) + (1 - hot)*inputs%bearings(1)%oil%supply_temperature, &
         & 1e-10_wp, 'mixed')
      inputs%bearings(1)%oil%widest_gap_deg = 19.9_wp
      oil = balanced(inputs, losses)
      call expect(all(abs(oil%inlet - inputs%bearings(1)%oil%supply_temperature) < 1e-10_wp), 'fresh across wide gaps')
   end subroutine carry_over

   !> Pads may be listed in any order, and turned together.
   subroutine order_of_pads()
      type(case_type) :: inputs
      type(pad_loss) :: losses(4)
      type(oil_temperatures_type) :: oil, other
      integer, parameter :: order(4) = [3, 1, 4, 2]
      inputs = four_pads()
      losses = some_losses()
      oil = balanced(inputs, losses)
      inputs%bearings(1)%pads%pivot_angle_deg = inputs%bearings(1)%pads%pivot_angle_deg(order) + 200
      other = balanced(inputs, losses(order), films(order))
      call expect(all(abs(oil%outlet(order) - other%outlet) < 1e-10_wp), 'temperatures')
   end subroutine order_of_pads

   !> The viscosities are those of the temperatures that the heat made with them leads to.
   subroutine viscosities()
      type(case_type) :: inputs
      type(pad_loss) :: losses(4)
      type(heat_balance_type) :: balance
      type(oil_temperatures_type) :: oil
      real(wp) :: wanted(4)
      integer :: k
      logical :: ok
      inputs = four_pads()
      do k = 1, 10
         inputs%bearings(1)%oil%supply_temperature = between(-10.0_wp, 80.0_wp)
         balance = new_heat_balance(inputs%bearings(1), inputs%sense())
         losses = some_losses()
         ! cold oil may make a hundred times the heat
         losses%couette = losses%couette*100**between(-1.0_wp, 1.0_wp)
         call balance%viscosities(losses, films, speed, wanted, ok)
         call expect(ok, 'found')
         ! the shaft's share of the films stays
         losses%couette = losses%couette*wanted/films
         losses%pressure = losses%pressure*wanted/films
         call balance%temperatures(losses, wanted, speed, oil, ok)
         call expect(all(abs(viscosity(inputs%bearings(1)%oil, oil%mean)/wanted - 1) < 1e-11_wp), &
            & 'of the mean temperatures')
      end do
   end subroutine viscosities

   !> Where all oil goes round and nothing is exchanged, there is no balance.
   subroutine no_fresh_oil()
      type(case_type) :: inputs
      type(heat_balance_type) :: balance
      type(pad_loss) :: losses(4)
      type(oil_temperatures_type) :: oil
      real(wp) :: wanted(4)
      logical :: ok
      inputs = four_pads()
      inputs%bearings(1)%oil%carry_over = 1
      inputs%bearings(1)%oil%shaft_nusselt = 0
      losses = some_losses()
      losses%outlet = losses(1)%inlet
      losses%inlet = losses(1)%inlet
      balance = new_heat_balance(inputs%bearings(1), inputs%sense())
      call balance%temperatures(losses, films, speed, oil, ok)
      call expect(.not. ok, 'temperatures')
      call balance%viscosities(losses, films, speed, wanted, ok)
      call expect(.not. ok, 'viscosities')
   end subroutine no_fresh_oil

   !> Oil that stands gives all its heat to the shaft.
   subroutine standing_oil()
      type(case_type) :: inputs
      type(pad_loss) :: losses(4)
      type(oil_temperatures_type) :: oil
      inputs = four_pads()
      inputs%bearings(1)%oil%shaft_temperature = 50
      losses = some_losses()
      losses(2)%inlet = 0
      losses(2)%outlet = 0
      oil = balanced(inputs, losses)
      call expect_close((oil%mean(2) - 50)*conductance(inputs, losses(2), films(2)), losses(2)%power(), &
         & 1e-3_wp*losses(2)%power(), 'heat')
   end subroutine standing_oil

   !> Grooves and shaft that keep the temperatures of the balance change nothing; others show in the films.
   subroutine kept()
      type(case_type) :: inputs
      type(heat_balance_type) :: balance
      type(pad_loss) :: losses(4)
      type(oil_temperatures_type) :: oil, other
      real(wp) :: wanted(4), others(4)
      logical :: ok
      inputs = four_pads()
      balance = new_heat_balance(inputs%bearings(1), inputs%sense())
      losses = some_losses()
      call balance%viscosities(losses, films, speed, wanted, ok)
      losses%couette = losses%couette*wanted/films
      losses%pressure = losses%pressure*wanted/films
      call balance%temperatures(losses, wanted, speed, oil, ok)
      call balance%temperatures(losses, wanted, speed, other, ok, oil)
      call expect(all(abs(other%outlet - oil%outlet) < 1e-9_wp), 'temperatures')
      call balance%viscosities(losses, wanted, speed, others, ok, oil)
      call expect(all(abs(others/wanted - 1) < 1e-10_wp), 'viscosities')
      oil%inlet(3) = oil%inlet(3) + 10
      call balance%temperatures(losses, wanted, speed, other, ok, oil)
      call expect(other%mean(3) - oil%mean(3) > 5 .and. all(abs(other%mean([1, 2, 4]) - oil%mean([1, 2, 4])) &
         & < 1e-9_wp), 'a warm groove warms its own film')
   end subroutine kept

   !> In balance what enters a groove is what is there; it is renewed in the time of its volume and half the film's.
   subroutine renewal()
      type(case_type) :: inputs
      type(heat_balance_type) :: balance
      type(pad_loss) :: losses(4)
      type(oil_temperatures_type) :: oil
      real(wp) :: entering(4), time_constant(4)
      logical :: ok
      inputs = four_pads()
      inputs%bearings(1)%oil%groove_volume = 3e-5_wp
      balance = new_heat_balance(inputs%bearings(1), inputs%sense())
      losses = some_losses()
      call balance%temperatures(losses, films, speed, oil, ok)
      call balance%renewal(losses, oil, speed, entering, time_constant)
      call expect(all(abs(entering - oil%inlet) < 1e-9_wp), 'what enters')
      ! a film 2 q/(U L) thick
      call expect(all(abs(time_constant - (3e-5_wp + 0.5_wp*2*losses%inlet/(speed*inputs%bearings(1)%journal_radius) &
         & *inputs%bearings(1)%pads%arc_deg*degree*inputs%bearings(1)%journal_radius)/losses%inlet) < 1e-10_wp), 'time')
   end subroutine renewal
end program test_heat_balance
