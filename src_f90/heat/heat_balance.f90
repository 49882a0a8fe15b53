!> Temperatures of the oil, one a pad, from the heat that its film makes and the oil that flows through it: carried over
!> from pad to pad, and exchanged with the shaft (docs/theory/heat.md, *Pad temperatures*).
!>
!> Along a film of conductance H to the shaft, through which a flow of heat capacity m passes, N = H/m, with
!> f = (1 - exp(-N))/N and g = (1 - f)/N,
!>    T_mean = f T_in + (1 - f) T_J + g Phi/m,   T_out = exp(-N) T_in + (1 - exp(-N)) T_J + f Phi/m.
!> All temperatures are therefore linear in the heat Phi of the films.
module heat_balance
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, degree
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error
   use linear_algebra, only: solve, identity
   use case_groups, only: bearing_type, oil_type, is_set
   use oil_properties, only: viscosity, viscosity_slope
   use bearing_losses, only: pad_loss
   use turbulence_closure, only: wall_law_type, new_wall_law, eddy_conduction
   implicit none (type, external)
   private
   public :: heat_balance_type, oil_temperatures_type, groove_type, new_heat_balance, new_grooves, check_boiling

   !> Of the oil, C.
   type :: oil_temperatures_type
      !> Of every pad's film: where it begins, mean over the film, where it ends, and the highest in the pad's surface.
      real(wp), allocatable :: inlet(:), mean(:), outlet(:), maximum(:)
      !> The hottest oil of every pad's film, by which it boils.
      real(wp), allocatable :: hottest(:)
      !> Of the shaft, and of all oil that leaves the bearing.
      real(wp) :: shaft = 0, drain = 0
   end type oil_temperatures_type

   !> The groove before a pad: the pad upstream, the next one against the rotation; which share of the oil that leaves
   !> it may come across.
   type :: groove_type
      integer :: upstream = 0
      real(wp) :: carry_over = 0
   end type groove_type

   type :: heat_balance_type
      private
      type(oil_type) :: oil
      !> Before each pad (groove_type).
      integer, allocatable :: upstream(:)
      real(wp), allocatable :: carry_over(:)
      !> m.
      real(wp) :: journal_radius
      !> Length of each pad's arc, m.
      real(wp), allocatable :: arc(:)
      !> Clearance of each pad times its length, m^2.
      real(wp), allocatable :: section(:)
   contains
      procedure :: temperatures
      procedure :: viscosities
      procedure :: renewal
      procedure, private :: network
      procedure, private :: least_flow
   end type heat_balance_type

   !> Pads and shaft as what the heat of the films warms; one element a pad.
   type :: heat_network
      !> Heat capacity of the flow through the film, W/K; share of the inflow that comes from upstream; exp(-N), f, g.
      real(wp), allocatable :: capacity(:), hot(:), left(:), f(:), g(:)
      !> Temperatures where the film begins and, last, of the shaft: without heat, C, and by each pad's, K/W.
      real(wp), allocatable :: cold(:), per_watt(:, :)
      logical :: solved = .false.
   end type heat_network

   !> Least flow through a film, over what the journal would drag through its clearance: oil that stands gives its
   !> heat to the shaft.
   real(wp), parameter :: least_share = 1e-12_wp
   !> Relative change of the viscosities at which they have settled; most rounds of Newton's method.
   real(wp), parameter :: settled = 1e-13_wp
   integer, parameter :: most_rounds = 200
   !> Mineral oils boil and crack from about here on, C.
   real(wp), parameter :: boiling = 300
   !> Highest temperature that is named, C: no law of viscosity goes further.
   real(wp), parameter :: beyond = 500

contains

   !> For a bearing and its oil, and a shaft that turns in this sense.
   pure type(heat_balance_type) function new_heat_balance(bearing, sense) result(self)
      type(bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: sense
      type(groove_type) :: grooves(bearing%pad_count())
      self%oil = bearing%oil
      self%journal_radius = bearing%journal_radius
      self%arc = bearing%pads%arc_deg*degree*bearing%journal_radius
      self%section = bearing%machined_clearance*bearing%axial_length
      grooves = new_grooves(bearing, sense)
      self%upstream = grooves%upstream
      self%carry_over = grooves%carry_over
   end function new_heat_balance

   !> The grooves of a bearing, for a shaft that turns in this sense.
   pure function new_grooves(bearing, sense) result(grooves)
      type(bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: sense
      type(groove_type) :: grooves(bearing%pad_count())
      real(wp) :: turn, nearest, gap
      integer :: i, k
      associate (p => bearing%pads)
         do i = 1, size(grooves)
            nearest = huge(nearest)
            do k = 1, size(grooves)
               turn = modulo(sense*(p%pivot_angle_deg(k) - p%pivot_angle_deg(i)), 360.0_wp)
               ! a pad alone is upstream of itself
               if (k == i) turn = 360
               if (turn >= nearest) cycle
               nearest = turn
               grooves(i)%upstream = k
            end do
            associate (up => grooves(i)%upstream)
               gap = nearest - p%pivot_ratio(i)*p%arc_deg(i) - (1 - p%pivot_ratio(up))*p%arc_deg(up)
            end associate
            if (gap <= bearing%oil%widest_gap_deg) grooves(i)%carry_over = bearing%oil%carry_over
         end do
      end associate
   end function new_grooves

   !> The temperatures with these losses and flows, of films with these viscosities, Pa s, at a speed, rad/s. `ok` is
   !> false where neither flow nor shaft carries the heat off.
   subroutine temperatures(self, losses, films, speed, found, ok, kept)
      class(heat_balance_type), intent(in) :: self
      type(pad_loss), intent(in) :: losses(:)
      real(wp), intent(in) :: films(:), speed
      type(oil_temperatures_type), intent(out) :: found
      logical, intent(out) :: ok
      !> Where grooves and shaft keep their temperatures: these.
      type(oil_temperatures_type), intent(in), optional :: kept
      type(heat_network) :: net
      real(wp) :: fresh
      integer :: n
      n = size(losses)
      call self%network(losses, films, speed, net, kept)
      ok = net%solved
      if (.not. ok) return
      associate (heat => losses%power(), inlet => losses%inlet, outlet => losses%outlet)
         associate (all => net%cold + matmul(net%per_watt, heat))
            found%inlet = all(:n)
            found%shaft = all(n + 1)
         end associate
         found%mean = net%f*found%inlet + (1 - net%f)*found%shaft + net%g*heat/net%capacity
         found%outlet = net%left*found%inlet + (1 - net%left)*found%shaft + net%f*heat/net%capacity
         found%maximum = found%outlet + max(found%outlet - found%shaft, 0.0_wp)/2
         found%hottest = found%maximum
         ! oil that leaves at the sides is warmed half of the way; what leaves at the outlets is not all carried over
         fresh = sum((1 - net%hot)*inlet)
         found%drain = self%oil%supply_temperature
         if (fresh > 0) found%drain = (sum((inlet - outlet)*(found%inlet + found%outlet)/2 + outlet*found%outlet) &
            & - sum(net%hot*inlet*found%outlet(self%upstream)))/fresh
      end associate
   end subroutine temperatures

   !> The viscosities, Pa s, that the films would take where journal and pads are: those of the mean temperatures, if
   !> the heat of the films, made with the viscosities `films`, follows them. `ok` is false where neither flow nor shaft
   !> carries the heat off.
   subroutine viscosities(self, losses, films, speed, wanted, ok, kept)
      class(heat_balance_type), intent(in) :: self
      type(pad_loss), intent(in) :: losses(:)
      real(wp), intent(in) :: films(:), speed
      real(wp), intent(out) :: wanted(:)
      logical, intent(out) :: ok
      type(oil_temperatures_type), intent(in), optional :: kept
      type(heat_network) :: net
      real(wp), dimension(size(losses)) :: base, mean, slope, step
      real(wp), dimension(size(losses), size(losses)) :: by_heat, matrix
      integer :: i, round
      call self%network(losses, films, speed, net, kept)
      ok = net%solved
      if (.not. ok) return
      associate (n => size(losses), per_viscosity => (losses%couette + losses%pressure)/films)
         do i = 1, n
            by_heat(i, :) = net%f(i)*net%per_watt(i, :) + (1 - net%f(i))*net%per_watt(n + 1, :)
            by_heat(i, i) = by_heat(i, i) + net%g(i)/net%capacity(i)
         end do
         base = net%f*net%cold(:n) + (1 - net%f)*net%cold(n + 1) + matmul(by_heat, losses%boundary)
         ! from the cold side, on which Newton's method stays: the heat falls ever less as the oil becomes warm
         mean = base
         do round = 1, most_rounds
            wanted = viscosity(self%oil, mean)
            slope = viscosity_slope(self%oil, mean)
            step = base + matmul(by_heat, per_viscosity*wanted) - mean
            matrix = -by_heat*spread(per_viscosity*slope, 1, n)
            do i = 1, n
               matrix(i, i) = matrix(i, i) + 1
            end do
            call solve(n, 1, matrix, step, ok)
            ok = ok .and. all(ieee_is_finite(step))
            if (.not. ok) return
            mean = max(mean + step, base)
            if (maxval(abs(slope/wanted*step)) <= settled) exit
         end do
         wanted = viscosity(self%oil, mean)
      end associate
   end subroutine viscosities

   !> Refuses oil that boils in the hottest place of a film.
   subroutine check_boiling(oil, error)
      type(oil_temperatures_type), intent(in) :: oil
      type(error_type), allocatable, intent(out) :: error
      integer :: pad
      pad = maxloc(oil%hottest, dim=1)
      if (oil%hottest(pad) > boiling) call raise(error, numerics_error, 'the oil in the hottest place of the film of ' &
         & //'pad '//to_text(pad)//' would have '//to_text(ceiling(min(oil%hottest(pad), beyond)))//' C' &
         & //trim(merge(' or more', '        ', oil%hottest(pad) > beyond))//', above '//to_text(nint(boiling)) &
         & //' C, where mineral oil boils: film and asperities make more heat than its flow carries off; try cooler ' &
         & //'or more oil, less load or more clearance')
   end subroutine check_boiling

   !> Temperatures, C, of what enters the groove before each pad, and the time, s, in which it renews the oil of groove
   !> and, half of it, film: oil passes the film with half the speed of the journal's surface.
   pure subroutine renewal(self, losses, oil, speed, entering, time_constant)
      class(heat_balance_type), intent(in) :: self
      type(pad_loss), intent(in) :: losses(:)
      type(oil_temperatures_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      real(wp), intent(out) :: entering(:), time_constant(:)
      real(wp) :: hot(size(losses))
      hot = hot_shares(self, losses)
      entering = hot*oil%outlet(self%upstream) + (1 - hot)*self%oil%supply_temperature
      time_constant = self%oil%groove_volume/max(losses%inlet, self%least_flow(speed)) &
         & + self%arc/(speed*self%journal_radius)
   end subroutine renewal

   !> Flow through each film, m^3/s, below which it counts as standing.
   pure function least_flow(self, speed)
      class(heat_balance_type), intent(in) :: self
      real(wp), intent(in) :: speed
      real(wp) :: least_flow(size(self%section))
      least_flow = least_share*speed*self%journal_radius*self%section/2
   end function least_flow

   !> Which share of the inflow comes from upstream.
   pure function hot_shares(self, losses) result(hot)
      type(heat_balance_type), intent(in) :: self
      type(pad_loss), intent(in) :: losses(:)
      real(wp) :: hot(size(losses))
      hot = 0
      where (losses%inlet > 0) hot = min(max(0.0_wp, self%carry_over*losses(self%upstream)%outlet)/losses%inlet, 1.0_wp)
   end function hot_shares

   !> The network of pads and shaft, solved.
   subroutine network(self, losses, films, speed, net, kept)
      class(heat_balance_type), intent(in) :: self
      type(pad_loss), intent(in) :: losses(:)
      real(wp), intent(in) :: films(:), speed
      type(heat_network), intent(out) :: net
      type(oil_temperatures_type), intent(in), optional :: kept
      real(wp) :: matrix(size(losses) + 1, size(losses) + 1), right(size(losses) + 1, 0:size(losses))
      real(wp) :: part(size(losses))
      integer :: i, last
      if (.not. all(ieee_is_finite(losses%power()) .and. ieee_is_finite(losses%inlet + losses%outlet))) return
      last = size(losses) + 1
      allocate (net%left, net%f, net%g, mold=part)
      associate (oil => self%oil, up => self%upstream)
         ! the integral of dA/h over what oil fills, with eddies of as many times that as they carry more heat
         part = losses%couette/(losses%shear_factor*films*(speed*self%journal_radius)**2)
         if (any(losses%turbulent_share > 0)) part = part*eddy_exchange(oil, losses, films, speed*self%journal_radius)
         net%capacity = oil%density*oil%specific_heat*max(self%least_flow(speed), (losses%inlet + losses%outlet)/2)
         call film_shares(oil%shaft_nusselt*oil%conductivity*part/net%capacity, net%left, net%f, net%g)
         net%hot = hot_shares(self, losses)
         matrix = 0
         right = 0
         do i = 1, last - 1
            associate (k => up(i), hot => net%hot(i))
               matrix(i, i) = 1
               matrix(i, k) = matrix(i, k) - hot*net%left(k)
               matrix(i, last) = -hot*(1 - net%left(k))
               right(i, 0) = (1 - hot)*oil%supply_temperature
               right(i, k) = hot*net%f(k)/net%capacity(k)
            end associate
         end do
         matrix(last, last) = 1
         if (is_set(oil%shaft_temperature)) then
            right(last, 0) = oil%shaft_temperature
         else if (.not. any(part > 0)) then
            right(last, 0) = oil%supply_temperature
         else
            ! no net heat; where nothing is exchanged, the limit of little
            associate (share => part*net%f/sum(part*net%f))
               matrix(last, :last - 1) = -share
               right(last, 1:) = share/net%f*net%g/net%capacity
            end associate
         end if
      end associate
      if (present(kept)) then
         matrix = identity(last)
         right = 0
         right(:, 0) = [kept%inlet, kept%shaft]
      end if
      call solve(last, last, matrix, right, net%solved)
      net%solved = net%solved .and. all(ieee_is_finite(right))
      net%cold = right(:, 0)
      net%per_watt = right(:, 1:)
   end subroutine network

   !> How many times more heat than by conduction crosses each film with its eddies.
   function eddy_exchange(oil, losses, films, surface_speed) result(factor)
      type(oil_type), intent(in) :: oil
      type(pad_loss), intent(in) :: losses(:)
      real(wp), intent(in) :: films(:), surface_speed
      real(wp) :: factor(size(losses))
      type(wall_law_type) :: wall
      integer :: i
      wall = new_wall_law()
      factor = 1
      if (.not. oil%conductivity > 0) return
      do i = 1, size(losses)
         if (losses(i)%turbulent_share > 0) factor(i) = eddy_conduction(wall, losses(i)%reynolds_number(surface_speed, &
            & oil%density, films(i)), losses(i)%turbulent_share, oil%specific_heat*films(i) &
            & /(oil%conductivity*oil%turbulent_prandtl))
      end do
   end function eddy_exchange

   !> exp(-N), f and g.
   elemental subroutine film_shares(n, left, f, g)
      real(wp), intent(in) :: n
      real(wp), intent(out) :: left, f, g
      if (n < 1e-2_wp) then
         left = 1 - n*(1 - n/2*(1 - n/3*(1 - n/4*(1 - n/5))))
         f = 1 - n/2*(1 - n/3*(1 - n/4*(1 - n/5*(1 - n/6))))
         g = (1 - n/3*(1 - n/4*(1 - n/5*(1 - n/6*(1 - n/7)))))/2
      else
         left = exp(-min(n, 700.0_wp))
         f = (1 - left)/n
         g = (1 - f)/n
      end if
   end subroutine film_shares
end module heat_balance
