!> Squeeze film dampers between the housings of bearings and the ground: short films with open ends, which cavitate
!> where they are pulled or are full, and long ones with sealed ends, in closed form.
!>
!> The film is h = c - u.n thick in the direction n for a ring at u that moves with v. With open ends its force is
!> -mu R L^3 times the integral of n (n.v)/h^3 over the angle, where n.v > 0 in a cavitated film. Sommerfeld's
!> substitution makes polynomials in sine and cosine of the integrand, and of those of the derivatives, n n (n.v)/h^4.
module squeeze_film_damper
   use kinds, only: wp, pi
   use text, only: filled
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, of_journal
   use abstract_element, only: element_type, element_slot
   use film_oils, only: film_oil
   use case_groups, only: damper_type, mount_type
   use case_inputs, only: case_type
   use linear_element, only: housing_pair
   implicit none (type, external)
   private
   public :: squeeze_film_damper_type, dampers_of

   type, extends(element_type) :: squeeze_film_damper_type
      type(damper_type) :: of
      !> "the damper of bearing 'left'".
      character(len=:), allocatable :: title
      !> Force on the housing, N, and its derivatives over positions and rates, as evaluated last.
      real(wp), private :: total(of_journal) = 0
      real(wp), dimension(of_journal, of_journal), private :: over_positions = 0, over_rates = 0
   contains
      procedure :: evaluate
      procedure :: add_force
      procedure :: part_derivatives
      procedure :: sampled_force
      procedure :: sampled_position
   end type squeeze_film_damper_type

contains

   !> Those of a case, each on the displacements of its housing.
   pure function dampers_of(inputs) result(slots)
      type(case_type), intent(in) :: inputs
      type(element_slot), allocatable :: slots(:)
      type(squeeze_film_damper_type) :: damper
      type(mount_type), allocatable :: bearings(:)
      integer, allocatable :: of(:)
      integer :: i
      bearings = inputs%mounts()
      of = inputs%dampers()
      allocate (slots(size(of)))
      do i = 1, size(of)
         damper%of = bearings(of(i))%damper
         damper%title = 'the damper of '//bearings(of(i))%label()
         allocate (slots(i)%of, source=damper)
         slots(i)%pair = housing_pair(bearings, of(i))
      end do
   end function dampers_of

   !> Refuses a ring that touches.
   subroutine evaluate(self, journal, pads, oil, speed, want_derivatives, refusal, ok, chosen)
      class(squeeze_film_damper_type), intent(inout) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      character(len=:), allocatable, intent(inout) :: refusal
      logical, intent(out) :: ok
      logical, intent(in), optional :: chosen(:)
      associate (at => self%sampled_position(journal), c => self%of%clearance)
         ok = norm2(at) < c
         if (ok) then
            call answer(self%of, at, journal%velocity, self%total, self%over_positions, self%over_rates)
         else
            refusal = self%title//filled(' is closed: its ring lies at y {u.2}, z {u.2} um in damper%clearance of ' &
               & //'{u.2} um (damper%offset, support%stiffness)', [at, c])
         end if
      end associate
   end subroutine evaluate

   pure subroutine add_force(self, force)
      class(squeeze_film_damper_type), intent(in) :: self
      real(wp), intent(inout) :: force(of_journal)
      force = force + self%total
   end subroutine add_force

   pure subroutine part_derivatives(self, part, m, accelerations, over_positions, over_rates)
      class(squeeze_film_damper_type), intent(in) :: self
      integer, intent(in) :: part, m
      logical, intent(in) :: accelerations
      real(wp), intent(out) :: over_positions(m, m), over_rates(m, m)
      over_positions = self%over_positions
      over_rates = self%over_rates
   end subroutine part_derivatives

   pure function sampled_force(self, journal, pads, speed) result(force)
      class(squeeze_film_damper_type), intent(in) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      real(wp), intent(in) :: speed
      real(wp) :: force(of_journal), ignored(of_journal, of_journal, 2)
      call answer(self%of, self%sampled_position(journal), journal%velocity, force, ignored(:, :, 1), ignored(:, :, 2))
   end function sampled_force

   !> Where its ring is in the clearance, m.
   pure function sampled_position(self, journal) result(position)
      class(squeeze_film_damper_type), intent(in) :: self
      type(journal_motion), intent(in) :: journal
      real(wp) :: position(of_journal)
      position = journal%position + self%of%offset
   end function sampled_position

   !> The force of a film on its ring at u, m, that moves with v, m/s, and its derivatives over both. A ring at rest in
   !> a cavitated film has half of the damping of a full one, as it has in vanishing vibrations.
   pure subroutine answer(d, u, v, force, over_positions, over_rates)
      type(damper_type), intent(in) :: d
      real(wp), intent(in) :: u(2), v(2)
      real(wp), intent(out) :: force(2), over_positions(2, 2), over_rates(2, 2)
      !> Columns: the directions along and across the displacement; in these the velocity, over the clearance the
      !> eccentricity, the damping over `scale`, and how damping times velocity changes with the eccentricity.
      real(wp) :: frame(2, 2), w(2), e, damping(2, 2), change(2, 2), scale, root
      frame(:, 1) = [1.0_wp, 0.0_wp]
      if (norm2(u) > 0) frame(:, 1) = u/norm2(u)
      frame(:, 2) = [-frame(2, 1), frame(1, 1)]
      w = matmul(v, frame)
      e = norm2(u)/d%clearance
      root = sqrt((1 - e)*(1 + e))
      if (d%film == 'sealed') then
         scale = 12*pi*d%viscosity*d%length*d%lands*(d%radius/d%clearance)**3
         damping = reshape([1/root**3, 0.0_wp, 0.0_wp, 2/((2 + e**2)*root)], [2, 2])
         change(:, 1) = e*w*[3/root**5, damping(2, 2)*(1/root**2 - 2/(2 + e**2))]
         change(:, 2) = 3*e/((2 + e**2)*root**3)*w([2, 1])
      else
         scale = d%viscosity*d%radius*d%lands*(d%length/d%clearance)**3
         call integrate(d%film == 'pi', e, root, w, damping, change)
      end if
      over_rates = -scale*matmul(frame, matmul(damping, transpose(frame)))
      over_positions = -scale/d%clearance*matmul(frame, matmul(change, transpose(frame)))
      force = matmul(over_rates, v)
   end subroutine answer

   !> The integrals of n n/(1 - e cos)^3, and of 3 n n (n.w)/(1 - e cos)^4, with 1 - e^2 = root^2.
   pure subroutine integrate(cavitates, e, root, w, second, third)
      logical, intent(in) :: cavitates
      real(wp), intent(in) :: e, root, w(2)
      real(wp), intent(out) :: second(2, 2), third(2, 2)
      !> Of cos^2, cos sin, sin^2, then of cos^3, cos^2 sin, cos sin^2, sin^3 of the angle from u, over powers of root.
      real(wp) :: p(7), along(2)
      if (cavitates .and. norm2(w) > 0) then
         ! the limits are b +- pi/2 with b of this cosine and sine
         along = w/norm2(w)
         associate (h => [1 + e*along(2), 1 - e*along(2)])
            p = primitives(pi + 2*atan(e/root*along(1)), root*along(1)/h(1), -(along(2) + e)/h(1)) &
               & - primitives(0.0_wp, -root*along(1)/h(2), (along(2) - e)/h(2))
         end associate
      else
         p = primitives(merge(pi, 2*pi, cavitates), 0.0_wp, -1.0_wp) - primitives(0.0_wp, 0.0_wp, -1.0_wp)
      end if
      second(:, 1) = [p(1)/root, p(2)]
      second(:, 2) = [p(2), p(3)*root]
      second = second/root**4
      third(:, 1) = [w(1)*p(4) + w(2)*p(5)*root, (w(1)*p(5) + w(2)*p(6)*root)*root]
      third(:, 2) = [third(2, 1), (w(1)*p(6) + w(2)*p(7)*root)*root**2]
      third = 3*third/root**7
   contains
      !> Of the integrands in Sommerfeld's angle s, of which these are sine and cosine: (cos a - e)/(1 - e cos a) is the
      !> cosine where a is the angle, and root sin a/(1 - e cos a) the sine.
      pure function primitives(s, sine, cosine) result(p)
         real(wp), intent(in) :: s, sine, cosine
         real(wp) :: p(7)
         p = [(s + sine*cosine)/2 + 2*e*sine + e**2*s, sine**2/2 - e*cosine, (s - sine*cosine)/2, &
            & sine - sine**3/3 + 1.5_wp*e*(s + sine*cosine) + 3*e**2*sine + e**3*s, -(cosine + e)**3/3, &
            & sine**3/3 + e/2*(s - sine*cosine), cosine**3/3 - cosine]
      end function primitives
   end subroutine integrate
end module squeeze_film_damper
