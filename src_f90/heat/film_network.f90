!> Temperatures in all films of a bearing: the pads' (film_energy), joined by grooves and shaft, in which they are
!> affine (docs/theory/heat.md, *Temperature in the film*); and these temperatures as a coupled field: with the oil of
!> some of them forces are in equilibrium, and the streams of the films there carry heat to others.
module film_network
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use linear_algebra, only: solve
   use case_groups, only: bearing_type, oil_type, thermal_type, is_set
   use oil_properties, only: viscosity, viscosities
   use heat_balance, only: oil_temperatures_type, groove_type, new_grooves
   use film_law, only: film_law_type
   use film_oils, only: film_oil
   use film_streams, only: film_stream, new_stream_volumes, find_stream
   use film_energy, only: film_profile, layer_faces, new_profile, fitted_oil, film_heat_type, solid_layers, &
      & by_nothing, by_inlet, by_shaft, pad_heat
   use film_eddies, only: solve_film
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error
   use film_solver, only: film_motion
   use elimination_film, only: elimination_film_type
   use asperity_contact, only: asperity_load
   use state_layout, only: pad_state
   use kinematics, only: frame_of, motion_of
   use equations_of_motion, only: machine_model
   use force_balance, only: forces
   use heat_balance_equations, only: check_oil
   use static_model, only: set_free, newton_step, clearances, static_derivatives, newtons
   use fixed_point, only: coupled_field, most_rounds
   implicit none (type, external)
   private
   public :: warm_films_type, new_warm_films, film_field_type


   !> The films of one bearing.
   type :: warm_films_type
      type(film_heat_type), allocatable :: heat(:)
      !> C, (layer, station, pad), the pad's layers first; of the pads' surfaces, (station, pad).
      real(wp), allocatable :: fields(:, :, :), surfaces(:, :)
      type(oil_temperatures_type) :: oil
      !> Heat that each film gives to the shaft and to its pad, W.
      real(wp), allocatable :: to_shaft(:), to_pad(:)
      !> Part of each pad's arc over which the flow, over width and height, is against the rotation.
      real(wp), allocatable :: reversed(:)
   end type warm_films_type


   !> Its values are temperatures above that of the supply, K, of layers, stations and pads, the first first, as these
   !> stay nearly what they are where the supply warms.
   type, extends(coupled_field) :: film_field_type
      !> Of each bearing; after a round `films%oil` has the temperatures that are wanted.
      type(warm_films_type), allocatable :: films(:)
      !> By how much the temperatures of each pad were to change in the last round, K.
      real(wp), allocatable, private :: changes(:)
      !> Of the oil that the model was given last, (station, pad).
      type(film_profile), allocatable, private :: profiles(:, :)
      !> Of the streams; kept where the gaps stay the same from round to round.
      type(elimination_film_type), allocatable, private :: volumes(:)
      logical, private :: gaps_change = .false.
   contains
      procedure :: begin
      procedure :: apply
      procedure :: find_wanted
      procedure :: check
      procedure :: explain
      procedure, private :: find_streams
   end type film_field_type

   !> Largest change of a temperature at the end; that of a pad whose temperatures jump; longest step, K.
   real(wp), parameter :: agreement = 1e-6_wp, jump = 1, longest = 20
   character(len=*), parameter :: remedy = '; try more preload or another pads%pivot_ratio'

contains

   !> Films of a bearing with one temperature a pad, C.
   pure type(warm_films_type) function new_warm_films(bearing, thermal, temperature) result(films)
      type(bearing_type), intent(in) :: bearing
      type(thermal_type), intent(in) :: thermal
      real(wp), intent(in) :: temperature(:)
      integer :: i
      call set_heat(bearing, thermal%layers, films)
      allocate (films%fields(solid_layers + thermal%layers, thermal%stations, size(temperature)))
      allocate (films%surfaces(thermal%stations, size(temperature)))
      allocate (films%reversed(size(temperature)), source=0.0_wp)
      do i = 1, size(temperature)
         films%fields(:, :, i) = temperature(i)
         films%surfaces(:, i) = temperature(i)
      end do
   end function new_warm_films

   !> Gives the films of a bearing what heat meets in them, of this number of layers.
   pure subroutine set_heat(bearing, layers, films)
      type(bearing_type), intent(in) :: bearing
      integer, intent(in) :: layers
      type(warm_films_type), intent(inout) :: films
      integer :: i
      associate (oil => bearing%oil, pads => bearing%pads)
         if (.not. allocated(films%heat)) allocate (films%heat(bearing%pad_count()))
         do i = 1, size(films%heat)
            films%heat(i) = film_heat_type(oil%density*oil%specific_heat, oil%conductivity, pads%conductivity(i), &
               & bearing%journal_radius + bearing%machined_clearance(i), pads%thickness(i), oil%back_coefficient, &
               & oil%supply_temperature, layer_faces(layers))
         end do
         if (is_set(oil%back_temperature)) films%heat%back_temperature = oil%back_temperature
      end associate
   end subroutine set_heat

   !> Profiles of the stations of a film with these temperatures, C, (layer, station), of the pad first, and the oil
   !> that the film solvers take for it, with the viscosity of the mean temperature of the film.
   subroutine oil_of_field(oil, zeta, field, profiles, film)
      type(oil_type), intent(in) :: oil
      !> Faces of the layers.
      real(wp), intent(in) :: zeta(:), field(:, :)
      type(film_profile), intent(out) :: profiles(:)
      type(film_oil), intent(out) :: film
      real(wp) :: fluidity(size(zeta) - 1, size(profiles))
      integer :: i
      fluidity = 1/viscosities(oil, field(solid_layers + 1:, :))
      do i = 1, size(profiles)
         profiles(i) = new_profile(zeta, fluidity(:, i))
      end do
      film = fitted_oil(viscosity(oil, mean_temperature(zeta, field)), profiles)
   end subroutine oil_of_field

   !> Mean over arc and height, C.
   pure real(wp) function mean_temperature(zeta, field)
      real(wp), intent(in) :: zeta(:), field(:, :)
      mean_temperature = sum(matmul(zeta(2:) - zeta(:size(zeta) - 1), field(solid_layers + 1:, :)))/size(field, 2)
   end function mean_temperature

   !> The fields of all pads that the films lead to, C, (layer, station, pad), from their laws, streams and profiles at
   !> a speed of the journal's surface, m/s; `films` has the temperatures of their oil and surfaces then. `ok` is false
   !> where no heat balance is found.
   subroutine solve_network(oil, grooves, films, laws, streams, profiles, surface_speed, fields, ok)
      type(oil_type), intent(in) :: oil
      type(groove_type), intent(in) :: grooves(:)
      type(warm_films_type), intent(inout) :: films
      class(film_law_type), intent(in) :: laws(:)
      type(film_stream), intent(in) :: streams(:)
      !> Without eddies, (station, pad).
      type(film_profile), intent(in) :: profiles(:, :)
      real(wp), intent(in) :: surface_speed
      real(wp), intent(out) :: fields(:, :, :)
      logical, intent(out) :: ok
      type(pad_heat) :: pads(size(streams))
      type(oil_temperatures_type) :: found
      !> Flows of each pad, without what runs back, and which of them comes hot from upstream, m^3/s; temperatures where
      !> the films begin and, last, of the shaft, C.
      real(wp), dimension(size(streams)) :: inflow, outflow, hot
      real(wp) :: ends(size(streams) + 1), parts(3)
      real(wp), allocatable :: to_shaft(:), to_pad(:)
      integer :: i, last
      last = size(ends)
      do i = 1, size(streams)
         call solve_film(films%heat(i), streams(i), laws(i), oil, profiles(:, i), surface_speed, pads(i))
         inflow(i) = streams(i)%flow(0)
         outflow(i) = streams(i)%flow(size(profiles, 1))
         films%reversed(i) = real(count(streams(i)%flow < 0), wp)/size(streams(i)%flow)
      end do
      ok = all(pads%solved)
      if (.not. ok) return
      call find_ends()
      if (.not. ok) return
      found%inlet = ends(:size(streams))
      found%shaft = ends(last)
      allocate (found%mean, found%outlet, found%maximum, found%hottest, mold=found%inlet)
      found%drain = 0
      allocate (to_shaft(size(streams)), to_pad(size(streams)))
      do i = 1, size(streams)
         parts = [1.0_wp, ends(i), ends(last)]
         fields(:, :, i) = pads(i)%field(:, :, by_nothing) + ends(i)*pads(i)%field(:, :, by_inlet) &
            & + ends(last)*pads(i)%field(:, :, by_shaft)
         found%mean(i) = mean_temperature(films%heat(i)%zeta, fields(:, :, i))
         found%outlet(i) = dot_product(pads(i)%outlet, parts)
         films%surfaces(:, i) = matmul(pads(i)%surface, parts)
         found%maximum(i) = highest(films%surfaces(:, i))
         found%hottest(i) = max(found%maximum(i), maxval(fields(solid_layers + 1:, :, i)))
         to_shaft(i) = dot_product(pads(i)%to_shaft, parts)
         to_pad(i) = dot_product(pads(i)%to_back, parts)
         found%drain = found%drain + pads(i)%made - to_shaft(i) - to_pad(i)
      end do
      associate (fresh => sum(inflow - hot)*films%heat(1)%capacity)
         found%drain = oil%supply_temperature + merge(found%drain/max(fresh, tiny(fresh)), 0.0_wp, fresh > 0)
      end associate
      films%oil = found
      call move_alloc(to_shaft, films%to_shaft)
      call move_alloc(to_pad, films%to_pad)

   contains

      subroutine find_ends()
         real(wp) :: matrix(last, last)
         integer :: i
         matrix = 0
         ends = 0
         do i = 1, size(pads)
            matrix(last, i) = pads(i)%to_shaft(by_inlet)
            matrix(last, last) = matrix(last, last) + pads(i)%to_shaft(by_shaft)
            ends(last) = ends(last) - pads(i)%to_shaft(by_nothing)
            associate (up => grooves(i)%upstream, back => pads(i)%back_flow)
               hot(i) = max(0.0_wp, min(grooves(i)%carry_over*outflow(up), inflow(i)))
               ! where all in all oil runs out here, what comes in is this oil
               matrix(i, i) = matrix(i, i) + max(inflow(i), 0.0_wp) + back - back*pads(i)%back(by_inlet)
               matrix(i, up) = matrix(i, up) - hot(i)*pads(up)%outlet(by_inlet)
               matrix(i, last) = -hot(i)*pads(up)%outlet(by_shaft) - back*pads(i)%back(by_shaft)
               ends(i) = hot(i)*pads(up)%outlet(by_nothing) + back*pads(i)%back(by_nothing) &
                  & + max(inflow(i) - hot(i), 0.0_wp)*oil%supply_temperature
               if (inflow(i) + back > 0) cycle
               ! nothing comes in: no temperature counts
               matrix(i, :) = 0
               matrix(i, i) = 1
               ends(i) = oil%supply_temperature
            end associate
         end do
         if (is_set(oil%shaft_temperature)) then
            matrix(last, :) = 0
            matrix(last, last) = 1
            ends(last) = oil%shaft_temperature
         end if
         call solve(last, 1, matrix, ends, ok)
         ok = ok .and. all(ieee_is_finite(ends))
      end subroutine find_ends
   end subroutine solve_network

   !> The highest of values in the middles of equal steps: of the parabola through three, which goes on to the end where
   !> the last one is the highest, as in a film that is heated most at its trailing edge.
   pure real(wp) function highest(values)
      real(wp), intent(in) :: values(:)
      real(wp) :: slope, bend, at
      integer :: i
      i = min(max(maxloc(values, 1), 2), size(values) - 1)
      slope = (values(i + 1) - values(i - 1))/2
      bend = values(i + 1) - 2*values(i) + values(i - 1)
      at = sign(1.5_wp, slope)
      if (abs(slope) < -bend*abs(at)) at = -slope/bend
      highest = values(i) + at*(slope + at*bend/2)
   end function highest

   !> Begins with the temperatures of these films.
   subroutine begin(self, model, films, gaps_change)
      class(film_field_type), intent(inout) :: self
      type(machine_model), intent(in) :: model
      type(warm_films_type), intent(in) :: films(:)
      !> Whether the gaps do not stay what they are.
      logical, intent(in), optional :: gaps_change
      integer :: b
      self%agreement = agreement
      self%jump = jump
      self%longest = longest
      self%parts = model%layout%pads
      if (present(gaps_change)) self%gaps_change = gaps_change
      self%films = films
      self%values = [(films(b)%fields - model%inputs%bearings(b)%oil%supply_temperature, b=1, size(films))]
      allocate (self%profiles(size(films(1)%fields, 2), model%layout%pads))
   end subroutine begin

   subroutine apply(self, model)
      class(film_field_type), intent(inout) :: self
      type(machine_model), intent(inout) :: model
      integer :: b, i, pad
      pad = 0
      do b = 1, size(self%films)
         associate (fields => self%films(b)%fields, n => size(self%films(b)%fields(:, :, 1)), &
            & oil => model%inputs%bearings(b)%oil)
            do i = 1, size(fields, 3)
               fields(:, :, i) = reshape(self%values(n*pad + 1:n*(pad + 1)), shape(fields(:, :, i))) &
                  & + oil%supply_temperature
               pad = pad + 1
               call oil_of_field(oil, self%films(b)%heat(i)%zeta, fields(:, :, i), self%profiles(:, pad), &
                  & model%oil(pad))
            end do
         end associate
      end do
   end subroutine apply

   subroutine find_wanted(self, model, y, wanted, error)
      class(film_field_type), intent(inout) :: self
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      real(wp), intent(out) :: wanted(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: fields(size(self%films(1)%fields, 1), size(self%profiles, 1), size(self%profiles, 2))
      type(film_stream) :: streams(size(self%profiles, 2))
      class(film_law_type), allocatable :: laws(:)
      integer :: b, i
      logical :: ok, anew
      anew = self%gaps_change .or. .not. allocated(self%volumes)
      if (.not. allocated(self%volumes)) allocate (self%volumes(model%layout%pads))
      do b = 1, size(self%films)
         call set_heat(model%inputs%bearings(b), model%inputs%thermal%layers, self%films(b))
         associate (own => model%inputs%bearings(b), first => model%layout%elements(b)%first_pad, &
            & last => model%layout%elements(b)%last_pad)
            do i = 1, merge(size(model%bearings(b)%pads), 0, anew)
               self%volumes(first + i - 1) = new_stream_volumes(model%bearings(b)%pads(i)%gap, size(self%profiles, 1))
            end do
            call model%bearings(b)%laws_with(model%oil(first:last), model%point%speed(0.0_wp), laws)
            call self%find_streams(model, b, y, laws, streams(first:last), ok, i)
            if (.not. ok) call raise(error, numerics_error, 'the flow in the film of pad '//to_text(i) &
               & //' is not found')
            if (.not. allocated(error)) then
               call solve_network(own%oil, new_grooves(own, model%inputs%sense()), self%films(b), laws, &
                  & streams(first:last), self%profiles(:, first:last), model%point%speed(0.0_wp)*own%journal_radius, &
                  & fields(:, :, first:last), ok)
               if (.not. ok) call raise(error, numerics_error, 'nothing carries off the heat of the films')
            end if
            fields(:, :, first:last) = fields(:, :, first:last) - own%oil%supply_temperature
         end associate
         call add_context(error, model%inputs%bearings(b)%label())
         if (allocated(error)) return
      end do
      wanted = reshape(fields, [size(fields)])
      self%changes = maxval(reshape(abs(wanted - self%values), [size(wanted)/size(fields, 3), size(fields, 3)]), 1)
   end subroutine find_wanted

   !> The streams of the films of bearing b in the state y, with their laws; `ok` is false where that of a pad, the
   !> i-th, is not found.
   subroutine find_streams(self, model, b, y, laws, streams, ok, i)
      class(film_field_type), intent(inout) :: self
      type(machine_model), intent(in) :: model
      integer, intent(in) :: b
      real(wp), intent(in) :: y(:)
      class(film_law_type), intent(in) :: laws(:)
      type(film_stream), intent(out) :: streams(:)
      logical, intent(out) :: ok
      integer, intent(out) :: i
      type(pad_state) :: pads(size(streams))
      type(film_motion) :: motion
      type(asperity_load) :: asperity
      real(wp) :: position(2)
      pads = model%layout%elements(b)%pad_states(y)
      associate (bearing => model%bearings(b), journal => model%rotor%journal(y(:model%rotor%states), b), &
         & speed => model%point%speed(0.0_wp), before => model%layout%elements(b)%first_pad - 1)
         do i = 1, size(streams)
            associate (pad => bearing%pads(i))
               motion = motion_of(pad%position, frame_of(pad%position, journal, pads(i)), journal, pads(i))
               call bearing%asperities%evaluate(pad%gap, pad%directions, motion, speed, asperity)
               position = motion%position
               if (asperity%touches) motion%position = asperity%film_position
               call find_stream(self%volumes(before + i), bearing%film%condition, motion, laws(i), &
                  & speed, size(self%profiles, 1), streams(i), ok)
               if (.not. ok) return
               if (asperity%touches) streams(i)%boundary_heat = bearing%asperities%heat(pad%gap, position, &
                  & speed*pad%gap%journal_radius, size(self%profiles, 1))
            end associate
         end do
      end associate
   end subroutine find_streams

   !> Refuses temperatures that do not settle, oil that boils, and films in which oil runs against the rotation and out
   !> of the leading edge: what comes in elsewhere instead has no temperature in the balance of the grooves.
   subroutine check(self, model, agrees, error)
      class(film_field_type), intent(in) :: self
      type(machine_model), intent(in) :: model
      logical, intent(in) :: agrees
      type(error_type), allocatable, intent(out) :: error
      integer :: b, pad
      if (.not. agrees) then
         call raise(error, numerics_error, 'after '//to_text(most_rounds)//' rounds they still change by ' &
            & //to_text(maxval(self%changes))//' K'//remedy)
         call name_pad(model, maxloc(self%changes, 1), error)
         return
      end if
      do b = 1, size(self%films)
         pad = maxloc(self%films(b)%reversed, 1)
         if (.not. self%films(b)%reversed(pad) > 0) cycle
         call raise(error, numerics_error, 'the pressures around pad '//to_text(pad)//' drive its oil against the ' &
            & //'rotation and out of the leading edge, over '//to_text(nint(100*self%films(b)%reversed(pad))) &
            & //' % of its arc, and the oil that comes in elsewhere instead has no temperature in this model; try ' &
            & //'bearing%supply_pressure above bearing%ambient_pressure, or more speed')
         call add_context(error, model%inputs%bearings(b)%label())
         return
      end do
      call check_oil(model, self%films%oil, error)
   end subroutine check

   !> Says of a search that ended with an error in the state y which pad's temperatures led nowhere: those that change
   !> most, or, before the first round, those of the pad that Newton's method would move most.
   subroutine explain(self, model, y, first, error)
      class(film_field_type), intent(in) :: self
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      logical, intent(in) :: first
      type(error_type), allocatable, intent(inout) :: error
      if (first) then
         error%message = 'the search finds no equilibrium with them ('//error%message//')'//remedy
         call name_pad(model, pad_that_moves(model, y), error)
      else
         error%message = 'they would change by '//to_text(maxval(self%changes)) &
            & //' K more, to which the search finds no equilibrium ('//error%message//')'//remedy
         call name_pad(model, maxloc(self%changes, 1), error)
      end if
   end subroutine explain

   !> Puts the pad whose temperatures do not settle, 0 where it is not known, and the speed before the message.
   subroutine name_pad(model, pad, error)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: pad
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: films
      integer :: b
      b = count(model%layout%elements%first_pad <= pad)
      films = 'films'
      if (pad > 0) films = 'film of pad '//to_text(pad - model%layout%elements(b)%first_pad + 1)
      call add_context(error, 'the temperatures in the '//films//' do not settle at ' &
         & //to_text(model%point%speed_rpm)//' rpm')
      if (pad > 0) call add_context(error, model%inputs%bearings(b)%label())
   end subroutine name_pad

   !> The pad whose edge Newton's method would move most from the state y; 0 where there is none.
   integer function pad_that_moves(model, y) result(pad)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      real(wp), dimension(model%layout%n_positions(), model%layout%n_positions()) :: stiffness, damping
      real(wp), allocatable :: step(:)
      logical :: ok, free(model%layout%n_positions())
      integer, allocatable :: tilts(:)
      pad = 0
      tilts = model%layout%tilts()
      call model%evaluate(0.0_wp, y, .true., ok)
      if (.not. ok .or. size(tilts) == 0) return
      call static_derivatives(model, stiffness, damping)
      call set_free(model, free=free)
      call newton_step(stiffness, damping, forces(model, 0.0_wp, y), free, newtons, step, ok)
      if (.not. ok) return
      step = abs(step/clearances(model))
      pad = maxloc(step(tilts), 1)
   end function pad_that_moves
end module film_network
