!> The temperatures to which the films of a model lead in a state, by their streams there.
module stream_fields
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error
   use case_inputs, only: case_type
   use film_solver, only: film_motion
   use elimination_film, only: elimination_film_type
   use film_streams, only: film_stream, new_stream_volumes, find_stream
   use film_profiles, only: film_profile
   use film_network, only: warm_films_type, set_heat, solve_network
   use heat_balance, only: new_grooves
   use asperity_contact, only: asperity_load
   use kinematics, only: pad_state, frame_of, motion_of
   use equations_of_motion, only: machine_model
   use static_model, only: name_bearing
   implicit none (type, external)
   private
   public :: find_fields, make_volumes

contains

   !> The volumes of the streams of all pads' films.
   subroutine make_volumes(model, stations, volumes)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: stations
      type(elimination_film_type), allocatable, intent(out) :: volumes(:)
      integer :: b, i
      allocate (volumes(model%layout%pads))
      do b = 1, size(model%bearings)
         associate (of => model%layout%bearings(b), pads => model%bearings(b)%pads)
            do i = 1, of%pads
               volumes(of%other_pads + i) = new_stream_volumes(pads(i)%gap, stations)
            end do
         end associate
      end do
   end subroutine make_volumes

   !> The temperatures to which the films in the state y lead, C, (layer, station, pad).
   subroutine find_fields(model, y, films, profiles, volumes, fields, error)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(warm_films_type), intent(inout) :: films(:)
      type(film_profile), intent(in) :: profiles(:, :)
      !> Of the streams; made anew where they are not there.
      type(elimination_film_type), allocatable, intent(inout) :: volumes(:)
      real(wp), intent(out) :: fields(:, :, :)
      type(error_type), allocatable, intent(out) :: error
      type(film_stream) :: streams(size(profiles, 2))
      type(case_type) :: own
      integer :: b, i
      logical :: ok, keeps
      keeps = allocated(volumes)
      if (.not. keeps) call make_volumes(model, size(profiles, 1), volumes)
      do b = 1, size(films)
         own = model%inputs%of_bearing(b)
         call set_heat(own, films(b))
         associate (first => model%layout%bearings(b)%other_pads + 1, &
            & last => model%layout%bearings(b)%other_pads + model%layout%bearings(b)%pads)
            call find_streams(model, b, y, volumes(first:last), size(profiles, 1), streams(first:last), ok, i)
            if (.not. ok) call raise(error, numerics_error, 'the flow in the film of pad '//to_text(i) &
               & //' is not found')
            if (.not. allocated(error)) then
               call solve_network(own%oil, new_grooves(own), films(b), streams(first:last), profiles(:, first:last), &
                  & model%point%speed(0.0_wp)*own%bearing%journal_radius, fields(:, :, first:last), ok)
               if (.not. ok) call raise(error, numerics_error, 'nothing carries off the heat of the films')
            end if
         end associate
         call name_bearing(model, b, error)
         if (allocated(error)) exit
      end do
      if (.not. keeps) deallocate (volumes)
   end subroutine find_fields

   !> The streams of the films of bearing b in the state y; `ok` is false where that of a pad, the i-th, is not found.
   subroutine find_streams(model, b, y, volumes, stations, streams, ok, i)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: b
      real(wp), intent(in) :: y(:)
      type(elimination_film_type), intent(inout) :: volumes(:)
      integer, intent(in) :: stations
      type(film_stream), intent(out) :: streams(:)
      logical, intent(out) :: ok
      integer, intent(out) :: i
      type(pad_state) :: pads(size(streams))
      type(film_motion) :: motion
      type(asperity_load) :: asperity
      real(wp) :: position(2)
      pads = model%layout%bearings(b)%pad_states(y)
      associate (bearing => model%bearings(b), journal => model%rotor%journal(y(:model%rotor%states), b), &
         & speed => model%point%speed(0.0_wp), before => model%layout%bearings(b)%other_pads)
         do i = 1, size(streams)
            associate (pad => bearing%pads(i))
               motion = motion_of(pad%position, frame_of(pad%position, journal, pads(i)), journal, pads(i))
               call bearing%asperities%evaluate(pad%gap, pad%directions, motion, speed, asperity)
               position = motion%position
               if (asperity%touches) motion%position = asperity%film_position
               call find_stream(volumes(i), bearing%film%condition, motion, model%oil(before + i), speed, stations, &
                  & streams(i), ok)
               if (.not. ok) return
               if (asperity%touches) streams(i)%boundary_heat = bearing%asperities%heat(pad%gap, position, &
                  & speed*pad%gap%journal_radius, stations)
            end associate
         end do
      end associate
   end subroutine find_streams
end module stream_fields
