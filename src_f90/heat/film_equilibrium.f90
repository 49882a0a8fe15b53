!> The equilibrium of bearings with temperatures along and across their films: the rotor comes to equilibrium with the
!> oil of some temperatures, the streams of the films there carry heat to others, until they agree (docs/theory/heat.md,
!> *Temperature in the film*).
module film_equilibrium
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error, stopped, asked_to_stop, asked
   use anderson, only: anderson_type
   use case_inputs, only: case_type
   use film_solver, only: film_oil
   use elimination_film, only: elimination_film_type
   use film_profiles, only: film_profile
   use film_network, only: warm_films_type, oil_of_field
   use equations_of_motion, only: machine_model
   use heat_balance_equations, only: check_oil
   use pseudo_transient, only: residual_limit
   use static_model, only: name_bearing
   use oil_change, only: follow_oil, pad_that_moves
   use stream_fields, only: find_fields, make_volumes
   implicit none (type, external)
   private
   public :: film_rounds_type, solve_warm_films

   !> Rounds that lead films to the temperatures of an equilibrium: what they have found.
   type :: film_rounds_type
      integer :: made = 0
      !> Of the pads of all bearings: temperatures above that of the supply, K, (layer, station, pad), as these stay
      !> nearly what they are where the supply warms; and pads that keep theirs.
      real(wp), allocatable :: fields(:, :, :)
      logical, allocatable :: kept(:)
      !> By how much their temperatures would change in the last round, K.
      real(wp), allocatable, private :: changes(:)
      type(anderson_type), private :: acceleration
      !> Of the oil that the model was given last, (station, pad).
      type(film_profile), allocatable, private :: profiles(:, :)
      !> Of the streams, where the gaps stay the same from round to round.
      type(elimination_film_type), allocatable, private :: volumes(:)
   contains
      procedure :: begin
      procedure :: begin_anew
      procedure :: set_oil
      procedure :: make
      procedure :: find_oil
      procedure :: give
      procedure :: refuse_lost
   end type film_rounds_type

   !> Largest change of a temperature at the end, K; most rounds: an unloaded pad whose film leaps takes half of them.
   real(wp), parameter :: agreement = 1e-6_wp
   integer, parameter :: most_rounds = 120
   !> Change of a temperature, K, that the equilibrium must follow; most iterations of a search for a larger one.
   real(wp), parameter :: least_change = 0.1_wp
   integer, parameter :: most_iterations = 50
   !> Once temperatures change by less than this, K, an unbalanced force may be left: over the reference force, for each
   !> K of change. It moves them by a few hundredths of that.
   real(wp), parameter :: small_change = 1, residual_per_kelvin = 1e-4_wp
   !> Rounds after which the pad that still changes most keeps its temperatures if they change by less than this, K: an
   !> unloaded pad whose film cavitates leaps with the cells that do.
   integer, parameter :: leaps_after = 15
   real(wp), parameter :: largest_leap = 0.3_wp
   character(len=*), parameter :: remedy = '; try more preload or another pads%pivot_ratio'
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
      real(wp) :: enough, change
      logical :: agrees
      call rounds%begin(model, films)
      call make_volumes(model, size(rounds%profiles, 1), rounds%volumes)
      settled = rounds%fields
      enough = residual_limit
      do
         call follow(model, y, films, settled, enough, rounds, residual, error, give_up, held)
         if (allocated(error)) then
            if (error%status /= stopped) call rounds%refuse_lost(model, y, error)
            return
         end if
         settled = rounds%fields
         call rounds%make(model, y, films, agrees, error)
         if (allocated(error)) return
         if (agrees .and. enough <= residual_limit) exit
         change = maxval(rounds%changes, .not. rounds%kept)
         enough = residual_limit
         if (change < small_change .and. .not. agrees) enough = max(residual_limit, residual_per_kelvin*change)
      end do
      call rounds%give(model, films)
   end subroutine solve_warm_films

   !> Brings the state y in equilibrium with the temperatures `settled` to equilibrium with those of the rounds, or with
   !> the largest part of their change that it can follow: these the rounds have then. An error where that is next to
   !> nothing.
   subroutine follow(model, y, films, settled, enough, rounds, residual, error, give_up, held)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      type(warm_films_type), intent(in) :: films(:)
      real(wp), intent(in) :: settled(:, :, :), enough
      type(film_rounds_type), intent(inout) :: rounds
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      logical, intent(in), optional :: held(:)
      type(film_oil) :: last_oil(model%layout%pads)
      real(wp) :: before(size(y))
      before = y
      last_oil = model%oil
      do
         call rounds%set_oil(model, films)
         call follow_oil(model, y, last_oil, enough, merge(most_iterations, huge(1), rounds%made > 0), residual, &
            & error, give_up, held)
         if (.not. allocated(error)) return
         if (asked(give_up) .or. .not. maxval(abs(rounds%fields - settled)) > least_change) return
         call rounds%acceleration%forget()
         rounds%fields = settled + (rounds%fields - settled)/4
         y = before
      end do
   end subroutine follow

   !> Begins with the temperatures of these films.
   subroutine begin(self, model, films)
      class(film_rounds_type), intent(inout) :: self
      type(machine_model), intent(in) :: model
      type(warm_films_type), intent(in) :: films(:)
      integer :: b
      if (.not. allocated(self%fields)) then
         associate (layers => size(films(1)%fields, 1), stations => size(films(1)%fields, 2), pads => model%layout%pads)
            allocate (self%fields(layers, stations, pads), self%profiles(stations, pads), self%kept(pads), &
               & self%changes(pads))
         end associate
      end if
      do b = 1, size(films)
         associate (pads => model%layout%bearings(b)%all_pads())
            self%fields(:, :, pads) = films(b)%fields - supply_of(model, b)
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
   !> boils or runs against the rotation.
   subroutine make(self, model, y, films, agrees, error)
      class(film_rounds_type), intent(inout) :: self
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(warm_films_type), intent(inout) :: films(:)
      logical, intent(out) :: agrees
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: wanted(size(self%fields, 1), size(self%fields, 2), size(self%fields, 3))
      real(wp) :: change
      integer :: i
      agrees = .false.
      self%made = self%made + 1
      call find_fields(model, y, films, self%profiles, self%volumes, wanted, error)
      if (allocated(error)) return
      do i = 1, size(films)
         associate (pads => model%layout%bearings(i)%all_pads())
            wanted(:, :, pads) = wanted(:, :, pads) - supply_of(model, i)
         end associate
      end do
      self%changes = maxval(maxval(abs(wanted - self%fields), 1), 1)
      self%kept = self%kept .and. self%changes <= largest_leap
      change = maxval(self%changes, mask=.not. self%kept)
      agrees = change <= agreement
      if (agrees) then
         ! elsewhere they agree in other rounds
         self%made = 0
         call self%acceleration%forget()
         call check_flow(model, films, error)
         if (.not. allocated(error)) call check_oil(model, films%oil, error)
      else if (self%made == most_rounds) then
         call refuse_unsettled(model, self, error)
      else if (mod(self%made, leaps_after) == 0 .and. change <= largest_leap) then
         self%kept(maxloc(self%changes, mask=.not. self%kept)) = .true.
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
      type(elimination_film_type), allocatable :: volumes(:)
      call find_fields(model, y, films, self%profiles, volumes, wanted, error)
   end subroutine find_oil

   !> Gives the films the temperatures that were found, and which pads keep theirs.
   subroutine give(self, model, films)
      class(film_rounds_type), intent(in) :: self
      type(machine_model), intent(in) :: model
      type(warm_films_type), intent(inout) :: films(:)
      integer :: b
      do b = 1, size(films)
         associate (pads => model%layout%bearings(b)%all_pads())
            films(b)%fields = self%fields(:, :, pads) + supply_of(model, b)
            films(b)%kept = self%kept(pads)
         end associate
      end do
   end subroutine give

   !> The temperature, C, at which oil comes to bearing b.
   pure real(wp) function supply_of(model, b)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: b
      type(case_type) :: own
      own = model%inputs%of_bearing(b)
      supply_of = own%oil%supply_temperature
   end function supply_of

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
            call oil_of_field(own%oil, films(b)%heat(i)%zeta, self%fields(:, :, pad) &
               & + own%oil%supply_temperature, self%profiles(:, pad), model%oil(pad))
         end do
      end do
   end subroutine set_oil

   !> Refuses films in which oil runs against the rotation and out of the leading edge: what comes in elsewhere instead
   !> has no temperature in the balance of the grooves.
   subroutine check_flow(model, films, error)
      type(machine_model), intent(in) :: model
      type(warm_films_type), intent(in) :: films(:)
      type(error_type), allocatable, intent(out) :: error
      integer :: b, pad
      do b = 1, size(films)
         pad = maxloc(films(b)%reversed, 1)
         if (.not. films(b)%reversed(pad) > 0) cycle
         call raise(error, numerics_error, 'the pressures around pad '//to_text(pad)//' drive its oil against the ' &
            & //'rotation and out of the leading edge, over '//to_text(nint(100*films(b)%reversed(pad)))//' % of its ' &
            & //'arc, and the oil that comes in elsewhere instead has no temperature in this model; try ' &
            & //'bearing%supply_pressure above bearing%ambient_pressure, or more speed')
         call name_bearing(model, b, error)
         return
      end do
   end subroutine check_flow

   !> Says which pad's temperatures still change most, by how much, K, after the last round.
   subroutine refuse_unsettled(model, rounds, error)
      type(machine_model), intent(in) :: model
      type(film_rounds_type), intent(in) :: rounds
      type(error_type), allocatable, intent(out) :: error
      call raise(error, numerics_error, 'after '//to_text(most_rounds)//' rounds they still change by ' &
         & //to_text(maxval(rounds%changes, .not. rounds%kept))//' K'//remedy)
      call name_pad(model, maxloc(rounds%changes, 1, .not. rounds%kept), error)
   end subroutine refuse_unsettled

   !> Says of a search that ended with an error in the state y which pad's temperatures led nowhere: those that change
   !> most, or, before the first round, those of the pad that Newton's method would move most.
   subroutine refuse_lost(self, model, y, error)
      class(film_rounds_type), intent(in) :: self
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      type(error_type), allocatable, intent(inout) :: error
      if (self%made > 0) then
         error%message = 'they would change by '//to_text(maxval(self%changes, .not. self%kept)) &
            & //' K more, to which the search finds no equilibrium ('//error%message//')'//remedy
         call name_pad(model, maxloc(self%changes, 1, .not. self%kept), error)
      else
         error%message = 'the search finds no equilibrium with them ('//error%message//')'//remedy
         call name_pad(model, pad_that_moves(model, y), error)
      end if
   end subroutine refuse_lost

   !> Puts the pad whose temperatures do not settle, 0 where it is not known, and the speed before the message.
   subroutine name_pad(model, pad, error)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: pad
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: films
      integer :: b
      b = count(model%layout%bearings%other_pads < pad)
      films = 'films'
      if (pad > 0) films = 'film of pad '//to_text(pad - model%layout%bearings(b)%other_pads)
      call add_context(error, 'the temperatures in the '//films//' do not settle at ' &
         & //to_text(model%point%speed_rpm)//' rpm')
      if (pad > 0) call name_bearing(model, b, error)
   end subroutine name_pad
end module film_equilibrium
