!> The temperatures along and across films and in pads as a coupled field: with the oil of some temperatures forces are
!> in equilibrium, and the streams of the films there carry heat to others (docs/theory/heat.md, *Temperature in the
!> film*).
module film_field
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error
   use film_solver, only: film_motion
   use elimination_film, only: elimination_film_type
   use film_streams, only: film_stream, new_stream_volumes, find_stream
   use asperity_contact, only: asperity_load
   use state_layout, only: pad_state
   use kinematics, only: frame_of, motion_of
   use heat_balance, only: new_grooves
   use film_profiles, only: film_profile
   use film_network, only: warm_films_type, set_heat, oil_of_field, solve_network
   use equations_of_motion, only: machine_model
   use force_balance, only: forces
   use heat_balance_equations, only: check_oil
   use static_model, only: name_bearing, set_free, newton_step, clearances, static_derivatives, newtons
   use fixed_point, only: coupled_field, most_rounds
   implicit none (type, external)
   private
   public :: film_field_type

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
      self%values = [(films(b)%fields - supply_of(model, b), b=1, size(films))]
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
      integer :: b, i
      logical :: ok
      if (self%gaps_change .or. .not. allocated(self%volumes)) call make_volumes(model, size(self%profiles, 1), &
         & self%volumes)
      do b = 1, size(self%films)
         call set_heat(model%inputs%bearings(b), model%inputs%thermal%layers, self%films(b))
         associate (own => model%inputs%bearings(b), first => model%layout%elements(b)%other_pads + 1, &
            & last => model%layout%elements(b)%other_pads + model%layout%elements(b)%pads)
            call self%find_streams(model, b, y, streams(first:last), ok, i)
            if (.not. ok) call raise(error, numerics_error, 'the flow in the film of pad '//to_text(i) &
               & //' is not found')
            if (.not. allocated(error)) then
               call solve_network(own%oil, new_grooves(own, model%inputs%sense()), self%films(b), streams(first:last), &
                  & self%profiles(:, first:last), model%point%speed(0.0_wp)*own%journal_radius, &
                  & fields(:, :, first:last), ok)
               if (.not. ok) call raise(error, numerics_error, 'nothing carries off the heat of the films')
            end if
            fields(:, :, first:last) = fields(:, :, first:last) - own%oil%supply_temperature
         end associate
         call name_bearing(model, b, error)
         if (allocated(error)) return
      end do
      wanted = reshape(fields, [size(fields)])
      self%changes = maxval(reshape(abs(wanted - self%values), [size(wanted)/size(fields, 3), size(fields, 3)]), 1)
   end subroutine find_wanted

   !> The volumes of the streams of all pads' films.
   subroutine make_volumes(model, stations, volumes)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: stations
      type(elimination_film_type), allocatable, intent(out) :: volumes(:)
      integer :: b, i
      allocate (volumes(model%layout%pads))
      do b = 1, size(model%bearings)
         associate (of => model%layout%elements(b), pads => model%bearings(b)%pads)
            do i = 1, of%pads
               volumes(of%other_pads + i) = new_stream_volumes(pads(i)%gap, stations)
            end do
         end associate
      end do
   end subroutine make_volumes

   !> The streams of the films of bearing b in the state y; `ok` is false where that of a pad, the i-th, is not found.
   subroutine find_streams(self, model, b, y, streams, ok, i)
      class(film_field_type), intent(inout) :: self
      type(machine_model), intent(in) :: model
      integer, intent(in) :: b
      real(wp), intent(in) :: y(:)
      type(film_stream), intent(out) :: streams(:)
      logical, intent(out) :: ok
      integer, intent(out) :: i
      type(pad_state) :: pads(size(streams))
      type(film_motion) :: motion
      type(asperity_load) :: asperity
      real(wp) :: position(2)
      pads = model%layout%elements(b)%pad_states(y)
      associate (bearing => model%bearings(b), journal => model%rotor%journal(y(:model%rotor%states), b), &
         & speed => model%point%speed(0.0_wp), before => model%layout%elements(b)%other_pads)
         do i = 1, size(streams)
            associate (pad => bearing%pads(i))
               motion = motion_of(pad%position, frame_of(pad%position, journal, pads(i)), journal, pads(i))
               call bearing%asperities%evaluate(pad%gap, pad%directions, motion, speed, asperity)
               position = motion%position
               if (asperity%touches) motion%position = asperity%film_position
               call find_stream(self%volumes(before + i), bearing%film%condition, motion, model%oil(before + i), &
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
         call name_bearing(model, b, error)
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
      b = count(model%layout%elements%other_pads < pad)
      films = 'films'
      if (pad > 0) films = 'film of pad '//to_text(pad - model%layout%elements(b)%other_pads)
      call add_context(error, 'the temperatures in the '//films//' do not settle at ' &
         & //to_text(model%point%speed_rpm)//' rpm')
      if (pad > 0) call name_bearing(model, b, error)
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

   !> The temperature, C, at which oil comes to bearing b.
   pure real(wp) function supply_of(model, b)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: b
      supply_of = model%inputs%bearings(b)%oil%supply_temperature
   end function supply_of
end module film_field
