!> The equilibrium of bearings with temperatures along and across their films: the rotor comes to equilibrium with the
!> oil of some temperatures, the streams of the films there carry heat to others, until they agree (docs/theory/heat.md,
!> *Temperature in the film*).
module film_equilibrium
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error, asked_to_stop, asked
   use anderson, only: anderson_type
   use case_inputs, only: case_type
   use film_solver, only: film_motion
   use film_streams, only: film_stream, find_stream
   use film_profiles, only: film_profile
   use film_network, only: warm_films_type, set_heat, oil_of_field, solve_network
   use heat_balance, only: new_grooves
   use asperity_contact, only: asperity_load
   use kinematics, only: pad_state, frame_of, motion_of
   use equations_of_motion, only: machine_model
   use heat_balance_equations, only: check_oil
   use static_model, only: solve_equilibrium, name_bearing
   implicit none (type, external)
   private
   public :: film_rounds_type, solve_warm_films

   !> Rounds that lead films to the temperatures of an equilibrium: what they have found.
   type :: film_rounds_type
      integer :: made = 0
      !> Of the pads of all bearings: temperatures, C, (layer, station, pad), and pads that keep theirs.
      real(wp), allocatable :: fields(:, :, :)
      logical, allocatable :: kept(:)
      type(anderson_type), private :: acceleration
      !> Of the oil that the model was given last, (station, pad).
      type(film_profile), allocatable, private :: profiles(:, :)
   contains
      procedure :: begin
      procedure :: begin_anew
      procedure :: set_oil
      procedure :: make
      procedure :: find_oil
      procedure :: give
   end type film_rounds_type

   !> Largest change of a temperature at the end, K; most rounds.
   real(wp), parameter :: agreement = 1e-6_wp
   integer, parameter :: most_rounds = 60
   !> Change of a temperature, K, that Newton's method must follow; its most iterations for a step, of which it needs
   !> about five where it comes to an end.
   real(wp), parameter :: least_change = 0.1_wp
   integer, parameter :: most_iterations = 50
   !> Rounds after which the pad that still changes most keeps its temperatures if they change by less than this, K: an
   !> unloaded pad whose film cavitates leaps with the cells that do.
   integer, parameter :: leaps_after = 15
   real(wp), parameter :: largest_leap = 0.3_wp
   !> While temperatures change by more than this, K, only a part of their change is made.
   real(wp), parameter :: large_change = 15, part = 0.6_wp

contains

   !> Brings the state y of a model that is near equilibrium to equilibrium, and the films of each of its bearings to
   !> their temperatures: the model then has their oil. An error where they do not settle, or where oil boils.
   subroutine solve_warm_films(model, y, films, residual, error, give_up, held)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      type(warm_films_type), intent(inout) :: films(:)
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      !> Pads that are held where they are.
      logical, intent(in), optional :: held(:)
      type(film_rounds_type) :: rounds
      real(wp), allocatable :: settled(:, :, :)
      real(wp) :: before(size(y))
      logical :: agrees
      call rounds%begin(model, films)
      settled = rounds%fields
      agrees = .false.
      do while (.not. agrees)
         before = y
         do
            call rounds%set_oil(model, films)
            call solve_equilibrium(model, y, residual, error, give_up, held, &
               & merge(most_iterations, huge(1), rounds%made > 0))
            if (.not. allocated(error)) exit
            ! Newton's method may follow a part of the step
            if (asked(give_up) .or. .not. maxval(abs(rounds%fields - settled)) > least_change) return
            call rounds%acceleration%forget()
            rounds%fields = settled + (rounds%fields - settled)/4
            y = before
         end do
         settled = rounds%fields
         call rounds%make(model, y, films, agrees, error)
         if (allocated(error)) return
      end do
      call rounds%give(model, films)
   end subroutine solve_warm_films

   !> Begins with the temperatures of these films.
   subroutine begin(self, model, films)
      class(film_rounds_type), intent(inout) :: self
      type(machine_model), intent(in) :: model
      type(warm_films_type), intent(in) :: films(:)
      integer :: b
      if (.not. allocated(self%fields)) then
         associate (layers => size(films(1)%fields, 1), stations => size(films(1)%fields, 2), pads => model%layout%pads)
            allocate (self%fields(layers, stations, pads), self%profiles(stations, pads), self%kept(pads))
         end associate
      end if
      do b = 1, size(films)
         associate (pads => model%layout%bearings(b)%all_pads())
            self%fields(:, :, pads) = films(b)%fields
            self%kept(pads) = films(b)%kept
         end associate
      end do
      self%made = 0
      call self%acceleration%forget()
   end subroutine begin

   !> Begins with the present temperatures at another state.
   pure subroutine begin_anew(self)
      class(film_rounds_type), intent(inout) :: self
      self%made = 0
      self%kept = .false.
      call self%acceleration%forget()
   end subroutine begin_anew

   !> A round, with a model in equilibrium in y with the oil of the present temperatures: the films lead to others,
   !> which may agree with these; else they are changed. An error where they do not settle, or, where they agree, oil
   !> boils.
   subroutine make(self, model, y, films, agrees, error)
      class(film_rounds_type), intent(inout) :: self
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(warm_films_type), intent(inout) :: films(:)
      logical, intent(out) :: agrees
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: wanted(size(self%fields, 1), size(self%fields, 2), size(self%fields, 3))
      real(wp) :: changes(size(self%kept)), change
      integer :: i
      agrees = .false.
      self%made = self%made + 1
      call find_fields(model, y, films, self%profiles, wanted, error)
      if (allocated(error)) return
      changes = maxval(maxval(abs(wanted - self%fields), 1), 1)
      self%kept = self%kept .and. changes <= largest_leap
      change = maxval(changes, mask=.not. self%kept)
      agrees = change <= agreement
      if (agrees) then
         ! elsewhere they agree in other rounds
         self%made = 0
         call self%acceleration%forget()
         call check_oil(model, films%oil, error)
      else if (self%made == most_rounds) then
         call refuse_unsettled(model, maxloc(changes, 1, .not. self%kept), change, error)
      else if (mod(self%made, leaps_after) == 0 .and. change <= largest_leap) then
         self%kept(maxloc(changes, mask=.not. self%kept)) = .true.
         call self%acceleration%forget()
      else
         do i = 1, size(self%kept)
            if (self%kept(i)) wanted(:, :, i) = self%fields(:, :, i)
         end do
         call advance(self%fields, wanted, change, self%acceleration)
      end if
   end subroutine make

   !> The next temperatures after a round that would lead to those wanted, with this largest change, K.
   subroutine advance(fields, wanted, change, acceleration)
      real(wp), intent(inout) :: fields(:, :, :)
      real(wp), intent(in) :: wanted(:, :, :), change
      type(anderson_type), intent(inout) :: acceleration
      real(wp) :: x(size(fields))
      if (change > large_change) then
         call acceleration%forget()
         fields = fields + part*(wanted - fields)
      else
         x = reshape(fields, [size(fields)])
         call acceleration%advance(x, reshape(wanted, [size(wanted)]))
         fields = reshape(x, shape(fields))
      end if
   end subroutine advance

   !> The temperatures of the oil, those of films%oil then, to which the present temperatures lead in the state y of a
   !> model that has their oil.
   subroutine find_oil(self, model, y, films, error)
      class(film_rounds_type), intent(in) :: self
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(warm_films_type), intent(inout) :: films(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: wanted(size(self%fields, 1), size(self%fields, 2), size(self%fields, 3))
      call find_fields(model, y, films, self%profiles, wanted, error)
   end subroutine find_oil

   !> Gives the films the temperatures that were found, and which pads keep theirs.
   subroutine give(self, model, films)
      class(film_rounds_type), intent(in) :: self
      type(machine_model), intent(in) :: model
      type(warm_films_type), intent(inout) :: films(:)
      integer :: b
      do b = 1, size(films)
         associate (pads => model%layout%bearings(b)%all_pads())
            films(b)%fields = self%fields(:, :, pads)
            films(b)%kept = self%kept(pads)
         end associate
      end do
   end subroutine give

   !> Gives a model the oil of the present temperatures.
   subroutine set_oil(self, model, films)
      class(film_rounds_type), intent(inout) :: self
      type(machine_model), intent(inout) :: model
      type(warm_films_type), intent(in) :: films(:)
      type(case_type) :: own
      integer :: b, i, pad
      do b = 1, size(films)
         own = model%inputs%of_bearing(b)
         do i = 1, size(films(b)%heat)
            pad = model%layout%bearings(b)%other_pads + i
            call oil_of_field(own%oil, films(b)%heat(i)%zeta, self%fields(:, :, pad), self%profiles(:, pad), &
               & model%oil(pad))
         end do
      end do
   end subroutine set_oil

   !> The temperatures to which the films in the state y lead, C, (layer, station, pad).
   subroutine find_fields(model, y, films, profiles, fields, error)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(warm_films_type), intent(inout) :: films(:)
      type(film_profile), intent(in) :: profiles(:, :)
      real(wp), intent(out) :: fields(:, :, :)
      type(error_type), allocatable, intent(out) :: error
      type(film_stream) :: streams(size(profiles, 2))
      type(case_type) :: own
      integer :: b, i
      logical :: ok
      do b = 1, size(films)
         own = model%inputs%of_bearing(b)
         call set_heat(own, films(b))
         associate (first => model%layout%bearings(b)%other_pads + 1, &
            & last => model%layout%bearings(b)%other_pads + model%layout%bearings(b)%pads)
            call find_streams(model, b, y, size(profiles, 1), streams(first:last), ok, i)
            if (.not. ok) call raise(error, numerics_error, 'the flow in the film of pad '//to_text(i) &
               & //' is not found')
            if (.not. allocated(error)) then
               call solve_network(own%oil, new_grooves(own), films(b), streams(first:last), profiles(:, first:last), &
                  & model%point%speed(0.0_wp)*own%bearing%journal_radius, fields(:, :, first:last), ok)
               if (.not. ok) call raise(error, numerics_error, 'nothing carries off the heat of the films')
            end if
         end associate
         call name_bearing(model, b, error)
         if (allocated(error)) return
      end do
   end subroutine find_fields

   !> Says which pad, of those of all bearings, still changes by how much, K, after the last round.
   subroutine refuse_unsettled(model, pad, change, error)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: pad
      real(wp), intent(in) :: change
      type(error_type), allocatable, intent(out) :: error
      integer :: b
      b = count(model%layout%bearings%other_pads < pad)
      call raise(error, numerics_error, 'the temperatures in the film of pad ' &
         & //to_text(pad - model%layout%bearings(b)%other_pads)//' do not settle at ' &
         & //to_text(model%point%speed_rpm)//' rpm: after '//to_text(most_rounds)//' rounds they still change by ' &
         & //to_text(change)//' K')
      call name_bearing(model, b, error)
   end subroutine refuse_unsettled

   !> The streams of the films of bearing b in the state y; `ok` is false where that of a pad, the i-th, is not found.
   subroutine find_streams(model, b, y, stations, streams, ok, i)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: b
      real(wp), intent(in) :: y(:)
      integer, intent(in) :: stations
      type(film_stream), intent(out) :: streams(:)
      logical, intent(out) :: ok
      integer, intent(out) :: i
      type(pad_state) :: pads(size(streams))
      type(film_motion) :: motion
      type(asperity_load) :: asperity
      pads = model%layout%bearings(b)%pad_states(y)
      associate (bearing => model%bearings(b), journal => model%rotor%journal(y(:model%rotor%states), b), &
         & speed => model%point%speed(0.0_wp), before => model%layout%bearings(b)%other_pads)
         do i = 1, size(streams)
            associate (pad => bearing%pads(i))
               motion = motion_of(pad%position, frame_of(pad%position, journal, pads(i)), journal, pads(i))
               call bearing%asperities%evaluate(pad%gap, pad%directions, motion, speed, asperity)
               if (asperity%touches) motion%position = asperity%film_position
               call find_stream(pad%gap, bearing%film%condition, motion, model%oil(before + i), speed, stations, &
                  & streams(i), ok)
               if (.not. ok) return
            end associate
         end do
      end associate
   end subroutine find_streams
end module film_equilibrium
