!> A pad whose journal is inclined to it (docs/theory/pitch_and_yaw.md): the motion of the journal with its slopes, seen
!> from the pad; what films and asperities then do along the displacements of journal and pad, with derivatives; and the
!> friction of a pivot in which the pad tilts, pitches and yaws.
!>
!> Slopes are displacements over the distance along the shaft. The journal's, along y and z, have places behind its own
!> displacements: `most` is the number of all, the journal's two and two, then those of the pad.
module sloped_pad
   use kinds, only: wp
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, tilt, pivot_deflection, pitch, yaw, most_coordinates, of_journal
   use kinematics, only: pad_frame, motion_of, journal_slopes, in_mirror, to_global
   use sloped_gap, only: sloped_motion
   use friction, only: turning_friction
   use tilting_pad, only: tilting_pad_type, pad_coordinates_type, pad_loads, pad_derivatives
   implicit none (type, external)
   private
   public :: journal_slope, sloped_derivatives, sloped_motion_of, in_frame, find_derivatives, add_slope_loads, &
      & add_turning_friction

   !> First place of the journal's slopes, and of the pad's displacements.
   integer, parameter, public :: of_slopes = of_journal + 1, of_pad = 2*of_journal + 1
   integer, parameter, public :: most = 2*of_journal + most_coordinates
   !> Places of all but the slopes.
   integer, parameter :: unsloped(of_journal + most_coordinates) = [1, 2, 5, 6, 7, 8]

   !> Slopes of the journal along global y and z, and their rates, 1/s.
   type :: journal_slope
      real(wp) :: slope(2) = 0, rate(2) = 0
   end type journal_slope

   !> Derivatives over displacements and over rates, without friction.
   type :: sloped_derivatives
      !> Of the forces on the journal along y and z, N, the moments against its slopes there, N m, and the forces along
      !> the displacements of the pad.
      real(wp), dimension(most, most) :: over_positions = 0, over_rates = 0
      !> Of force and moment of the film on the journal in the pad frame.
      real(wp), dimension(4, most) :: film_over_positions = 0, film_over_rates = 0
      !> Of the pivot load.
      real(wp), dimension(most) :: contact_over_positions = 0, contact_over_rates = 0
   end type sloped_derivatives

contains

   !> The motion of the journal seen from the pad, whose middle plane moves as the pad turns about a pivot that stands
   !> off it.
   pure type(sloped_motion) function sloped_motion_of(pad, frame, journal, slopes, state) result(motion)
      type(tilting_pad_type), intent(in) :: pad
      type(pad_frame), intent(in) :: frame
      type(journal_motion), intent(in) :: journal
      type(journal_slope), intent(in) :: slopes
      type(pad_state), intent(in) :: state
      real(wp) :: slope(2), rate(2)
      slope = in_frame(frame, slopes%slope)
      rate = in_frame(frame, slopes%rate) + state%v(tilt)*[slope(2), -slope(1)]
      motion%middle = motion_of(pad%position, frame, journal, state)
      motion%middle%position = motion%middle%position + pad%axial_offset*[state%x(yaw), state%x(pitch)]
      motion%middle%velocity = motion%middle%velocity + pad%axial_offset*[state%v(yaw), state%v(pitch)]
      motion%slope = slope - [state%x(yaw), state%x(pitch)]
      motion%slope_rate = rate - [state%v(yaw), state%v(pitch)]
   end function sloped_motion_of

   !> A vector along global y and z in the pad frame.
   pure function in_frame(frame, vector)
      type(pad_frame), intent(in) :: frame
      real(wp), intent(in) :: vector(2)
      real(wp) :: in_frame(2), seen(2)
      seen = in_mirror(frame%mirrored, vector)
      in_frame = [seen(1)*frame%c - seen(2)*frame%s, seen(1)*frame%s + seen(2)*frame%c]
   end function in_frame

   !> Derivatives of position and slope of such a motion over all displacements, `arms`, and the rates of these.
   pure subroutine find_arms(pad, frame, journal, slopes, state, kinds, arms, arm_rates)
      type(tilting_pad_type), intent(in) :: pad
      type(pad_frame), intent(in) :: frame
      type(journal_motion), intent(in) :: journal
      type(journal_slope), intent(in) :: slopes
      type(pad_state), intent(in) :: state
      integer, intent(in) :: kinds(:)
      real(wp), dimension(4, most), intent(out) :: arms, arm_rates
      real(wp), dimension(4, of_journal) :: of_motion, of_rates
      real(wp), dimension(2) :: slope, rate, place, velocity, outward
      integer :: k
      arms = 0
      arm_rates = 0
      call journal_slopes(frame, state%v(tilt), of_motion, of_rates)
      do k = 1, 2
         associate (at => [2*k - 1, 2*k])
            arms(at, at) = of_motion(1:2, :)
            arm_rates(at, at) = of_motion(3:4, :)
         end associate
      end do
      outward = [pad%position%sin_angle*frame%c - pad%position%cos_angle*frame%s, &
         & pad%position%sin_angle*frame%s + pad%position%cos_angle*frame%c]
      slope = in_frame(frame, slopes%slope)
      rate = in_frame(frame, slopes%rate)
      place = [frame%along, frame%outward]
      velocity = in_frame(frame, journal%velocity) - state%v(pivot_deflection)*outward
      do k = 1, size(kinds)
         associate (arm => arms(:, of_pad + k - 1), arm_rate => arm_rates(:, of_pad + k - 1), v => state%v(tilt))
            select case (kinds(k))
            case (tilt)
               arm = [place(2), -place(1), slope(2), -slope(1)]
               arm_rate = [velocity(2), -velocity(1), rate(2), -rate(1)] - v*[place, slope]
            case (pivot_deflection)
               arm(1:2) = -outward
               arm_rate(1:2) = v*[-outward(2), outward(1)]
            case (pitch)
               arm = [0.0_wp, pad%axial_offset, 0.0_wp, -1.0_wp]
            case (yaw)
               arm = [pad%axial_offset, 0.0_wp, -1.0_wp, 0.0_wp]
            case default
               arm = 0
            end select
         end associate
      end do
   end subroutine find_arms

   !> What force and moment on the journal in the pad frame, N and N m, do along all displacements, (place, component).
   !> On the pad, whose tilt has the pressure's arm about the centre of its arc.
   pure function carriers(pad, frame, kinds)
      type(tilting_pad_type), intent(in) :: pad
      type(pad_frame), intent(in) :: frame
      integer, intent(in) :: kinds(:)
      real(wp) :: carriers(most, 4)
      integer :: k
      carriers = 0
      do k = 0, 2, 2
         carriers(k + 1:k + 2, k + 1) = to_global(frame, [1.0_wp, 0.0_wp])
         carriers(k + 1:k + 2, k + 2) = to_global(frame, [0.0_wp, 1.0_wp])
      end do
      do k = 1, size(kinds)
         associate (carrier => carriers(of_pad + k - 1, :))
            select case (kinds(k))
            case (tilt)
               carrier(1) = -pad%position%centre_distance
            case (pivot_deflection)
               carrier(2) = -1
            case (pitch)
               carrier([2, 4]) = [pad%axial_offset, -1.0_wp]
            case (yaw)
               carrier([1, 3]) = [pad%axial_offset, -1.0_wp]
            case default
               carrier = 0
            end select
         end associate
      end do
   end function carriers

   !> Moments of the weight along pitch and yaw, N m, of a pad that has these: with sine and cosine of the angle of its
   !> frame, or the derivatives of these.
   pure function hanging(pad, s, c, state)
      type(tilting_pad_type), intent(in) :: pad
      real(wp), intent(in) :: s, c
      type(pad_state), intent(in) :: state
      real(wp) :: hanging(2), slopes(2, 2)
      slopes = weight_slopes(pad, s, c)
      hanging = pad%weight*pad%axial_offset*[s, c] + matmul(slopes, state%x([pitch, yaw]))
   end function hanging

   !> Their derivatives over pitch and yaw: of a rigid body's turn to second order.
   pure function weight_slopes(pad, s, c)
      type(tilting_pad_type), intent(in) :: pad
      real(wp), intent(in) :: s, c
      real(wp) :: weight_slopes(2, 2), both
      both = 0.5_wp*(c*pad%centre_radial + s*pad%centre_tangential)
      weight_slopes = pad%weight*reshape([s*pad%centre_radial, both, both, c*pad%centre_tangential], [2, 2])
   end function weight_slopes

   !> Adds the forces along pitch and yaw to loads whose others are set, under this force and moment, N and N m, of film
   !> and asperities on the journal in the pad frame.
   pure subroutine add_slope_loads(coordinates, pad, frame, state, load, answer)
      class(pad_coordinates_type), intent(in) :: coordinates
      type(tilting_pad_type), intent(in) :: pad
      type(pad_frame), intent(in) :: frame
      type(pad_state), intent(in) :: state
      real(wp), intent(in) :: load(4)
      type(pad_loads), intent(inout) :: answer
      integer :: k
      associate (n => coordinates%n, kinds => coordinates%kind(:coordinates%n))
         associate (along => matmul(carriers(pad, frame, kinds), load), weight => hanging(pad, frame%s, frame%c, state))
            do k = 1, n
               if (kinds(k) >= pitch) answer%own(k) = along(of_pad + k - 1) + weight(kinds(k) - pitch + 1)
            end do
         end associate
      end associate
   end subroutine add_slope_loads

   !> The derivatives of all loads by those of the film's force and moment over position, slope and their rates, and by
   !> those of all that acts so, of which `load` is the sum; `moment_slopes` are those of a moment on the pad about the
   !> centre of its arc over position and slope.
   pure subroutine find_derivatives(coordinates, pad, frame, journal, slopes, state, film, all, load, moment_slopes, &
      & loads, answer, unsloped_answer)
      class(pad_coordinates_type), intent(in) :: coordinates
      type(tilting_pad_type), intent(in) :: pad
      type(pad_frame), intent(in) :: frame
      type(journal_motion), intent(in) :: journal
      type(journal_slope), intent(in) :: slopes
      type(pad_state), intent(in) :: state
      real(wp), intent(in) :: film(4, 8), all(4, 8), load(4), moment_slopes(4)
      type(pad_loads), intent(in) :: loads
      type(sloped_derivatives), intent(out) :: answer
      !> What is left of them where the journal has no slopes.
      type(pad_derivatives), intent(inout) :: unsloped_answer
      real(wp), dimension(4, most) :: arms, arm_rates
      real(wp) :: carried(most, 4), radial(most), radial_rates(most)
      associate (kinds => coordinates%kind(:coordinates%n), of_tilt => of_pad, x => answer%over_positions, &
         & v => answer%over_rates, weight => pad%weight)
         call find_arms(pad, frame, journal, slopes, state, kinds, arms, arm_rates)
         answer%film_over_positions = matmul(film(:, :4), arms) + matmul(film(:, 5:), arm_rates)
         answer%film_over_rates = matmul(film(:, 5:), arms)
         carried = carriers(pad, frame, kinds)
         x = matmul(carried, matmul(all(:, :4), arms) + matmul(all(:, 5:), arm_rates))
         v = matmul(carried, matmul(all(:, 5:), arms))
         if (coordinates%n > 0) then
            ! the frame turns with the pad
            x(1:2, of_tilt) = x(1:2, of_tilt) + to_global(frame, [-load(2), load(1)])
            x(3:4, of_tilt) = x(3:4, of_tilt) + to_global(frame, [-load(4), load(3)])
            radial = -matmul(all(2, :4), arms) - matmul(all(2, 5:), arm_rates)
            radial(of_tilt) = radial(of_tilt) + weight*frame%c
            radial_rates = -matmul(all(2, 5:), arms)
            radial_rates(of_tilt) = radial_rates(of_tilt) + 2*pad%mass*pad%centre_radial*state%v(tilt)
            x(of_tilt, :) = x(of_tilt, :) + matmul(moment_slopes, arms)
            x(of_tilt, of_tilt) = x(of_tilt, of_tilt) - pad%rotational_stiffness &
               & + weight*(pad%centre_tangential*frame%c + pad%centre_radial*frame%s)
            call add_weight(kinds, pad, frame, state, x)
            call add_contact(coordinates%deflection, loads, radial, radial_rates, answer, unsloped_answer)
         end if
         unsloped_answer%over_positions = x(unsloped, unsloped)
         unsloped_answer%over_rates = v(unsloped, unsloped)
         unsloped_answer%film_over_positions = answer%film_over_positions(:2, unsloped)
         unsloped_answer%film_over_rates = answer%film_over_rates(:2, unsloped)
      end associate
   end subroutine find_derivatives

   !> Adds the derivatives of the moments of the weight along pitch and yaw, with the tilt those of the frame.
   pure subroutine add_weight(kinds, pad, frame, state, over_positions)
      integer, intent(in) :: kinds(:)
      type(tilting_pad_type), intent(in) :: pad
      type(pad_frame), intent(in) :: frame
      type(pad_state), intent(in) :: state
      real(wp), intent(inout) :: over_positions(most, most)
      real(wp) :: slopes(2, 2), turned(2)
      integer :: i, k
      slopes = weight_slopes(pad, frame%s, frame%c)
      turned = hanging(pad, -frame%c, frame%s, state)
      do k = 1, size(kinds)
         if (kinds(k) < pitch) cycle
         associate (row => over_positions(of_pad + k - 1, :), this => kinds(k) - pitch + 1)
            row(of_pad) = row(of_pad) + turned(this)
            do i = 1, size(kinds)
               if (kinds(i) >= pitch) row(of_pad + i - 1) = row(of_pad + i - 1) + slopes(this, kinds(i) - pitch + 1)
            end do
         end associate
      end do
   end subroutine add_weight

   !> The derivatives of the pivot load, and of the force along a pivot deflection: that of a rigid pivot has those of
   !> the force on it.
   pure subroutine add_contact(deflection, loads, radial, radial_rates, answer, unsloped_answer)
      !> Which coordinate is the pivot deflection, or 0.
      integer, intent(in) :: deflection
      type(pad_loads), intent(in) :: loads
      real(wp), intent(in) :: radial(most), radial_rates(most)
      type(sloped_derivatives), intent(inout) :: answer
      type(pad_derivatives), intent(inout) :: unsloped_answer
      real(wp), dimension(most) :: contact, contact_rates
      contact = 0
      contact_rates = 0
      if (deflection > 0) then
         associate (row => of_pad + deflection - 1)
            contact(row) = loads%contact_stiffness
            answer%over_positions(row, :) = radial - contact
            answer%over_rates(row, :) = radial_rates
         end associate
      else if (loads%contact > 0) then
         contact = radial
         contact_rates = radial_rates
      end if
      answer%contact_over_positions = contact
      answer%contact_over_rates = contact_rates
      unsloped_answer%contact_over_positions = contact(unsloped)
      unsloped_answer%contact_over_rates = contact_rates(unsloped)
   end subroutine add_contact

   !> Adds what the friction of a pivot does to derivatives of the forces on what a pad knows of the rotor, `on` of all,
   !> and on the pad: `per_moment` are the rows' answers to a moment along each rotation, (row of the pad, rotation).
   pure subroutine add_turning_friction(contact, contact_rates, pad, rotation, friction, on, m, per_moment, &
      & over_positions, over_rates)
      integer, intent(in) :: on, m
      !> Derivatives of the pivot load over positions and rates.
      real(wp), intent(in) :: contact(m), contact_rates(m)
      type(tilting_pad_type), intent(in) :: pad
      !> Places of the rotations among the coordinates.
      integer, intent(in) :: rotation(:)
      type(turning_friction), intent(in) :: friction
      real(wp), intent(in) :: per_moment(m - on, size(rotation))
      real(wp), intent(inout) :: over_positions(m, m), over_rates(m, m)
      real(wp), dimension(size(rotation), m) :: moments, moment_rates
      integer :: k
      do k = 1, m
         associate (f => -pad%ball_radius*friction%force_normal(:size(rotation)))
            moments(:, k) = f*contact(k)
            moment_rates(:, k) = f*contact_rates(k)
         end associate
      end do
      associate (at => on + rotation, n => size(rotation), own => on + 1)
         moment_rates(:, at) = moment_rates(:, at) - pad%ball_radius**2*friction%force_velocity(:n, :n)
         over_positions(own:, :) = over_positions(own:, :) + matmul(per_moment, moments)
         over_rates(own:, :) = over_rates(own:, :) + matmul(per_moment, moment_rates)
      end associate
   end subroutine add_turning_friction
end module sloped_pad
