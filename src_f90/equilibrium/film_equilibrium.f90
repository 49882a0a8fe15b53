!> The equilibrium of a bearing with temperatures along and across its films: the bearing comes to equilibrium with the
!> oil of some temperatures, the streams of its films there carry heat to others, until they agree (docs/theory/heat.md,
!> *Temperature in the film*).
module film_equilibrium
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error, asked_to_stop, asked
   use anderson, only: anderson_type
   use film_solver, only: film_motion
   use film_streams, only: film_stream, find_stream
   use film_profiles, only: film_profile
   use film_network, only: warm_films_type, oil_of_field, solve_network
   use heat_balance, only: new_grooves
   use asperity_contact, only: asperity_load
   use kinematics, only: pad_state, frame_of, motion_of
   use equations_of_motion, only: machine_model
   use static_model, only: solve_equilibrium
   implicit none (type, external)
   private
   public :: solve_warm_films

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

   !> Brings the state y of a model of one bearing that is near equilibrium to equilibrium, and its films to their
   !> temperatures: the model then has their oil.
   subroutine solve_warm_films(model, y, films, residual, error, give_up, held)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      type(warm_films_type), intent(inout) :: films
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      !> Pads that are held where they are.
      logical, intent(in), optional :: held(:)
      type(film_profile) :: profiles(size(films%fields, 2), size(films%fields, 3))
      type(film_stream) :: streams(size(films%fields, 3))
      type(anderson_type) :: acceleration
      real(wp), allocatable :: wanted(:, :, :), settled(:, :, :)
      real(wp) :: changes(size(streams)), change, before(size(y))
      integer :: i, round
      logical :: ok
      allocate (wanted, mold=films%fields)
      settled = films%fields
      do round = 1, most_rounds
         before = y
         do
            do i = 1, size(streams)
               call oil_of_field(model%inputs%oil, films%heat(i)%zeta, films%fields(:, :, i), profiles(:, i), &
                  & model%oil(i))
            end do
            call solve_equilibrium(model, y, residual, error, give_up, held, merge(most_iterations, huge(1), round > 1))
            if (.not. allocated(error)) exit
            ! Newton's method may follow a part of the step
            if (asked(give_up) .or. .not. maxval(abs(films%fields - settled)) > least_change) return
            call acceleration%forget()
            films%fields = settled + (films%fields - settled)/4
            y = before
         end do
         settled = films%fields
         call find_streams(model, y, size(profiles, 1), streams, ok, i)
         if (.not. ok) call raise(error, numerics_error, 'the flow in the film of pad '//to_text(i)//' is not found')
         if (allocated(error)) return
         call solve_network(model%inputs%oil, new_grooves(model%inputs), films, streams, profiles, &
            & model%point%speed(0.0_wp)*model%inputs%bearing%journal_radius, wanted, ok)
         if (.not. ok) call raise(error, numerics_error, 'nothing carries off the heat of the films')
         if (allocated(error)) return
         changes = maxval(maxval(abs(wanted - films%fields), 1), 1)
         films%kept = films%kept .and. changes <= largest_leap
         change = maxval(changes, mask=.not. films%kept)
         if (change <= agreement) return
         if (mod(round, leaps_after) == 0 .and. change <= largest_leap) then
            films%kept(maxloc(changes, mask=.not. films%kept)) = .true.
            call acceleration%forget()
            cycle
         end if
         do i = 1, size(streams)
            if (films%kept(i)) wanted(:, :, i) = films%fields(:, :, i)
         end do
         call advance(films%fields, wanted, change, acceleration)
      end do
      call raise(error, numerics_error, 'the temperatures in the film of pad ' &
         & //to_text(maxloc(changes, 1, .not. films%kept))//' do not settle at ' &
         & //to_text(model%point%speed_rpm)//' rpm: after '//to_text(most_rounds)//' rounds they still change by ' &
         & //to_text(change)//' K')
   end subroutine solve_warm_films

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

   !> The streams of all films in the state y; `ok` is false where that of a pad, the i-th, is not found.
   subroutine find_streams(model, y, stations, streams, ok, i)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      integer, intent(in) :: stations
      type(film_stream), intent(out) :: streams(:)
      logical, intent(out) :: ok
      integer, intent(out) :: i
      type(pad_state) :: pads(size(streams))
      type(film_motion) :: motion
      type(asperity_load) :: asperity
      pads = model%layout%bearings(1)%pad_states(y)
      associate (bearing => model%bearings(1), journal => model%rotor%journal(y(:model%rotor%states), 1), &
         & speed => model%point%speed(0.0_wp))
         do i = 1, size(streams)
            associate (pad => bearing%pads(i))
               motion = motion_of(pad%position, frame_of(pad%position, journal, pads(i)), journal, pads(i))
               call bearing%asperities%evaluate(pad%gap, pad%directions, motion, speed, asperity)
               if (asperity%touches) motion%position = asperity%film_position
               call find_stream(pad%gap, bearing%film%condition, motion, model%oil(i), speed, stations, streams(i), ok)
               if (.not. ok) return
            end associate
         end do
      end associate
   end subroutine find_streams
end module film_equilibrium
