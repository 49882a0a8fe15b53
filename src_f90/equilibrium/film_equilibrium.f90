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
   use film_network, only: warm_films_type, oil_of_field, solve_network
   use heat_balance, only: oil_temperatures_type, new_grooves
   use asperity_contact, only: asperity_load
   use kinematics, only: pad_state, frame_of, motion_of
   use equations_of_motion, only: machine_model
   use heat_balance_equations, only: check_oil
   use static_model, only: solve_equilibrium, name_bearing
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
      type(film_profile) :: profiles(size(films(1)%fields, 2), model%layout%pads)
      type(anderson_type) :: acceleration
      !> Of the pads of all bearings.
      real(wp), allocatable :: fields(:, :, :), wanted(:, :, :), settled(:, :, :)
      real(wp) :: changes(size(profiles, 2)), change, before(size(y))
      logical :: kept(size(profiles, 2))
      integer :: i, round
      call gather(model, films, fields, kept)
      allocate (wanted, mold=fields)
      settled = fields
      do round = 1, most_rounds
         before = y
         do
            call set_oil(model, films, fields, profiles)
            call solve_equilibrium(model, y, residual, error, give_up, held, merge(most_iterations, huge(1), round > 1))
            if (.not. allocated(error)) exit
            ! Newton's method may follow a part of the step
            if (asked(give_up) .or. .not. maxval(abs(fields - settled)) > least_change) return
            call acceleration%forget()
            fields = settled + (fields - settled)/4
            y = before
         end do
         settled = fields
         call find_fields(model, y, films, profiles, wanted, error)
         if (allocated(error)) return
         changes = maxval(maxval(abs(wanted - fields), 1), 1)
         kept = kept .and. changes <= largest_leap
         change = maxval(changes, mask=.not. kept)
         if (change <= agreement) then
            call finish(model, films, fields, kept, error)
            return
         end if
         if (mod(round, leaps_after) == 0 .and. change <= largest_leap) then
            kept(maxloc(changes, mask=.not. kept)) = .true.
            call acceleration%forget()
            cycle
         end if
         do i = 1, size(kept)
            if (kept(i)) wanted(:, :, i) = fields(:, :, i)
         end do
         call advance(fields, wanted, change, acceleration)
      end do
      call refuse_unsettled(model, maxloc(changes, 1, .not. kept), change, error)
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

   !> The temperatures of the pads of all bearings, C, (layer, station, pad), and which pads keep theirs.
   subroutine gather(model, films, fields, kept)
      type(machine_model), intent(in) :: model
      type(warm_films_type), intent(in) :: films(:)
      real(wp), allocatable, intent(out) :: fields(:, :, :)
      logical, intent(out) :: kept(:)
      integer :: b
      allocate (fields(size(films(1)%fields, 1), size(films(1)%fields, 2), size(kept)))
      do b = 1, size(films)
         associate (of => model%layout%bearings(b))
            fields(:, :, of%other_pads + 1:of%other_pads + of%pads) = films(b)%fields
            kept(of%other_pads + 1:of%other_pads + of%pads) = films(b)%kept
         end associate
      end do
   end subroutine gather

   !> Gives the films what was found for the pads of all bearings; an error where oil boils.
   subroutine finish(model, films, fields, kept, error)
      type(machine_model), intent(in) :: model
      type(warm_films_type), intent(inout) :: films(:)
      real(wp), intent(in) :: fields(:, :, :)
      logical, intent(in) :: kept(:)
      type(error_type), allocatable, intent(out) :: error
      type(oil_temperatures_type) :: oil(size(films))
      integer :: b
      do b = 1, size(films)
         associate (of => model%layout%bearings(b))
            films(b)%fields = fields(:, :, of%other_pads + 1:of%other_pads + of%pads)
            films(b)%kept = kept(of%other_pads + 1:of%other_pads + of%pads)
         end associate
         oil(b) = films(b)%oil
      end do
      call check_oil(model, oil, error)
   end subroutine finish

   !> Gives a model the oil of these temperatures, with profiles, (station, pad).
   subroutine set_oil(model, films, fields, profiles)
      type(machine_model), intent(inout) :: model
      type(warm_films_type), intent(in) :: films(:)
      real(wp), intent(in) :: fields(:, :, :)
      type(film_profile), intent(out) :: profiles(:, :)
      type(case_type) :: own
      integer :: b, i, pad
      do b = 1, size(films)
         own = model%inputs%of_bearing(b)
         do i = 1, size(films(b)%heat)
            pad = model%layout%bearings(b)%other_pads + i
            call oil_of_field(own%oil, films(b)%heat(i)%zeta, fields(:, :, pad), profiles(:, pad), model%oil(pad))
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
