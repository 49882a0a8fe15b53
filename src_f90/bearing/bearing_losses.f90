!> Loads, losses and flows of all pads in a state of the bearing.
module bearing_losses
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp
   use case_groups, only: bearing_type
   use film_solver, only: film_motion, film_oil, film_law_type, film_ok
   use turbulent_film, only: turbulent_film_type
   use pad_gap, only: pad_gap_type, first_like
   use film_losses, only: film_losses_type, film_loss
   use sloped_gap, only: sloped_motion
   use sloped_film, only: sloped_film_type
   use asperity_contact, only: asperity_load, sloped_asperity_load
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state
   use kinematics, only: frame_of, motion_of
   use sloped_pad, only: sloped_motion_of
   use sloped_bearing, only: slopes_of
   use tilting_pad, only: tilting_pad_type
   use tilting_pad_bearing, only: tilting_pad_bearing_type
   use factories, only: new_losses
   implicit none (type, external)
   private
   public :: bearing_losses_type, pad_loss, new_bearing_losses

   !> Of one pad.
   type :: pad_loss
      !> Force of film and asperities on the journal, N.
      real(wp) :: load = 0
      !> Heat made in the film by shear of sliding and of pressure flow, and by boundary friction of asperities, W.
      real(wp) :: couette = 0, pressure = 0, boundary = 0
      !> Moments of the film's shear, N m: on the journal, against its rotation; on the pad about the centre of its arc,
      !> with the rotation.
      real(wp) :: journal_drag = 0, pad_drag = 0
      !> Flow in at the leading edge, out at the trailing edge and out at both sides, m^3/s.
      real(wp) :: inlet = 0, outlet = 0, side = 0
      !> What the film takes up at the reformation boundary beyond what reaches it, m^3/s: inlet + reformation =
      !> outlet + side.
      real(wp) :: reformation = 0
      !> Over the arc, m.
      real(wp) :: mean_film_thickness = 0
      !> Of a turbulent film: largest local Reynolds number; mean over the arc of the transition's share.
      real(wp) :: largest_reynolds = 0, turbulent_share = 0
      !> How many times that of a film without eddies its shear of sliding is.
      real(wp) :: shear_factor = 1
   contains
      procedure :: power
      procedure :: reynolds_number
   end type pad_loss

   type :: bearing_losses_type
      private
      type(film_losses_type), allocatable :: films(:)
      !> Where slopes count.
      type(sloped_film_type), allocatable :: sloped
   contains
      procedure :: find
   end type bearing_losses_type

contains

   function new_bearing_losses(bearing) result(losses)
      type(bearing_type), intent(in) :: bearing
      type(bearing_losses_type) :: losses
      losses%films = new_losses(bearing)
   end function new_bearing_losses

   !> All heat that a pad makes, W.
   elemental real(wp) function power(self)
      class(pad_loss), intent(in) :: self
      power = self%couette + self%pressure + self%boundary
   end function power

   !> rho U h/mu with the mean film thickness, at a speed of the journal's surface, m/s; of oil of a density, kg/m^3,
   !> and a viscosity, Pa s.
   elemental real(wp) function reynolds_number(self, surface_speed, density, viscosity)
      class(pad_loss), intent(in) :: self
      real(wp), intent(in) :: surface_speed, density, viscosity
      reynolds_number = density*abs(surface_speed)*self%mean_film_thickness/viscosity
   end function reynolds_number

   !> Of every pad in a state, with the oil of each, the speed in rad/s. What a pad lacks whose film is closed or not
   !> found is no number.
   subroutine find(self, bearing, journal, pads, oil, speed, losses)
      class(bearing_losses_type), intent(inout) :: self
      type(tilting_pad_bearing_type), intent(in) :: bearing
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      type(pad_loss), intent(out) :: losses(:)
      type(film_motion) :: motion
      type(asperity_load) :: asperity
      type(film_loss) :: film
      class(film_law_type), allocatable :: laws(:)
      integer :: i
      call bearing%laws_with(oil, speed, laws)
      do i = 1, size(pads)
         associate (pad => bearing%pads(i))
            if (allocated(bearing%sloped)) then
               call find_sloped(self, bearing, i, journal, pads(i), laws(i), speed, motion, asperity, film)
            else
               motion = motion_of(pad%position, frame_of(pad%position, journal, pads(i)), journal, pads(i))
               call bearing%asperities%evaluate(pad%gap, pad%directions, motion, speed, asperity)
               if (asperity%touches) motion%position = asperity%film_position
               call self%films(first_like(bearing%pads%gap, i))%find(motion, laws(i), speed, film)
            end if
            losses(i) = of_pad(pad, speed, film, asperity)
            losses(i)%mean_film_thickness = pad%gap%mean_film_thickness(motion, pad%directions)
            select type (laws)
            type is (turbulent_film_type)
               call find_turbulence(laws(i), pad%gap, motion, losses(i))
            end select
         end associate
      end do
   end subroutine find

   !> The loss of a film with slopes, the motion in the middle plane at which it is taken, and the asperities.
   subroutine find_sloped(self, bearing, i, journal, state, law, speed, motion, asperity, film)
      class(bearing_losses_type), intent(inout) :: self
      type(tilting_pad_bearing_type), intent(in) :: bearing
      integer, intent(in) :: i
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: state
      class(film_law_type), intent(in) :: law
      real(wp), intent(in) :: speed
      type(film_motion), intent(out) :: motion
      type(asperity_load), intent(out) :: asperity
      type(film_loss), intent(out) :: film
      type(sloped_motion) :: sloped
      type(sloped_asperity_load) :: touching
      associate (pad => bearing%pads(i))
         sloped = sloped_motion_of(pad, frame_of(pad%position, journal, state), journal, slopes_of(bearing, journal), &
            & state)
         call bearing%asperities%evaluate_sloped(pad%gap, pad%directions, sloped, speed, touching)
      end associate
      if (touching%touches) sloped = touching%film_motion
      if (.not. allocated(self%sloped)) then
         self%sloped = bearing%sloped%film
         ! the losses are those of the case's own condition
         call self%sloped%set_cavitation(.true.)
      end if
      call self%sloped%find_loss(i, sloped, law, speed, film)
      motion = sloped%middle
      asperity = touching%asperity_load
   end subroutine find_sloped

   !> How turbulent a film is, at points of its arc.
   pure subroutine find_turbulence(law, gap, motion, loss)
      type(turbulent_film_type), intent(in) :: law
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      type(pad_loss), intent(inout) :: loss
      integer, parameter :: points = 200
      real(wp), dimension(0:points) :: phi, reynolds, inverse
      integer :: i
      phi = [(i*gap%arc()/points - gap%trailing_angle, i=0, points)]
      reynolds = law%reynolds_number(gap, motion, phi)
      loss%largest_reynolds = maxval(reynolds)
      associate (w => law%closure%turbulent_share(reynolds))
         loss%turbulent_share = (sum(w) - 0.5_wp*(w(1) + w(points + 1)))/points
      end associate
      inverse = 1/gap%thickness(motion, sin(phi), cos(phi))
      loss%shear_factor = dot_product(inverse, law%shear_weight(gap, motion, phi)) &
         & /dot_product(inverse, law%oil%shear_weight(gap, motion, phi))
   end subroutine find_turbulence

   pure type(pad_loss) function of_pad(pad, speed, film, asperity) result(loss)
      type(tilting_pad_type), intent(in) :: pad
      real(wp), intent(in) :: speed
      type(film_loss), intent(in) :: film
      type(asperity_load), intent(in) :: asperity
      real(wp) :: force(2)
      force = film%force
      if (asperity%touches) then
         force = force + asperity%force
         loss%boundary = asperity%moment/pad%gap%pad_radius()*speed*pad%gap%journal_radius
      end if
      loss%load = norm2(force)
      loss%couette = film%couette
      loss%pressure = film%pressure
      loss%inlet = film%inlet
      loss%outlet = film%outlet
      loss%side = film%side
      loss%reformation = film%unfed
      if (abs(speed) > 0) then
         loss%journal_drag = (film%couette + film%wedge)/speed
         loss%pad_drag = (film%couette - film%wedge)/speed*pad%gap%pad_radius()/pad%gap%journal_radius
      end if
      if (film%status == film_ok) return
      associate (unknown => ieee_value(force(1), ieee_quiet_nan))
         loss = pad_loss(unknown, unknown, unknown, loss%boundary, unknown, unknown, unknown, unknown, unknown)
      end associate
   end function of_pad
end module bearing_losses
