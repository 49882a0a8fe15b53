!> What acts on a rotor between a pair of its displacements, y and z, and the ground: a bearing on its journal, a
!> support under a housing, a spring with a damper. It may have displacements of its own in parts that know the pair
!> and themselves but not each other, as the pads of a bearing have. The rotor's displacements are relative ones, so
!> that a chain, as a bearing in a housing on a support, has one element on each pair. Statics, Newton's systems,
!> linear analysis, samples and names of a model loop over its elements and know none of them by name.
module abstract_element
   use kinds, only: wp
   use film_oils, only: film_oil
   use rigid_rotor, only: journal_motion
   use state_layout, only: element_layout_type, new_element_layout, pad_state, of_journal
   implicit none (type, external)
   private
   public :: element_type, element_slot, element_pointer

   !> As it is, without displacements of its own.
   type, abstract :: element_type
      !> Force on the pair in the state evaluated last, N.
      real(wp), private :: force(of_journal) = 0
      !> How many displacements of the rotor its parts know: the pair, and a second one where slopes act in it.
      integer :: of_rotor = of_journal
   contains
      procedure :: layout
      procedure :: evaluate
      procedure :: add_force
      procedure :: add_moment
      procedure(part_derivatives), deferred :: part_derivatives
      procedure :: add_late
      procedure :: bristle_slopes
      procedure :: find_bristles
      procedure :: own_force
      procedure :: sampled_force
      procedure :: sampled_position
      procedure :: add_rates
      procedure :: part_masses
      procedure :: length
      procedure :: clearance_of
      procedure :: position_name
      procedure :: scales
      procedure :: reference_force
      procedure :: switching_rates
      procedure :: is_smooth
      procedure :: warning
   end type element_type

   !> One of several elements of different types, on a pair of the rotor's displacements.
   type :: element_slot
      class(element_type), allocatable :: of
      integer :: pair = 1
   end type element_slot

   !> One of all elements of a model.
   type :: element_pointer
      class(element_type), pointer :: to => null()
   end type element_pointer

   abstract interface
      !> What a part adds to the derivatives of the forces on the rotor's displacements that it knows and along its own
      !> n, over these displacements and over their rates, as they were taken last and without what add_late adds: m =
      !> of_rotor + n.
      pure subroutine part_derivatives(self, part, m, accelerations, over_positions, over_rates)
         import :: element_type, wp
         class(element_type), intent(in) :: self
         integer, intent(in) :: part, m
         !> Whether its own rows are those of its accelerations, not of its forces.
         logical, intent(in) :: accelerations
         real(wp), intent(out) :: over_positions(m, m), over_rates(m, m)
      end subroutine part_derivatives
   end interface

contains

   !> Its parts and their displacements.
   pure type(element_layout_type) function layout(self)
      class(element_type), intent(in) :: self
      layout = new_element_layout(0, [integer ::], .false.)
   end function layout

   !> Sets the forces in a state and, where they are wanted, their derivatives: with the motion of its pair, the
   !> states of its parts, the oil of each, and the speed of the rotor, rad/s. Where it refuses a state, `refusal`
   !> says why. Forces of parts that are not chosen stay what they are.
   subroutine evaluate(self, journal, pads, oil, speed, want_derivatives, refusal, ok, chosen)
      class(element_type), intent(inout) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      character(len=:), allocatable, intent(inout) :: refusal
      logical, intent(out) :: ok
      !> Left out: all.
      logical, intent(in), optional :: chosen(:)
      self%force = self%sampled_force(journal, pads, speed)
      ok = .true.
   end subroutine evaluate

   !> Adds its force on the pair, N, in the state evaluated last.
   pure subroutine add_force(self, force)
      class(element_type), intent(in) :: self
      real(wp), intent(inout) :: force(of_journal)
      force = force + self%force
   end subroutine add_force

   !> Adds its moment against the slopes, N m, where these act in it.
   pure subroutine add_moment(self, moment)
      class(element_type), intent(in) :: self
      real(wp), intent(inout) :: moment(of_journal)
   end subroutine add_moment

   !> Adds to such derivatives what acts as evaluated last, not as linearised last: friction; and gives what bristles
   !> do to the rows behind those of the pair, per deflection.
   pure subroutine add_late(self, part, m, accelerations, over_positions, over_rates, over_bristle)
      class(element_type), intent(in) :: self
      integer, intent(in) :: part, m
      logical, intent(in) :: accelerations
      real(wp), intent(inout) :: over_positions(m, m), over_rates(m, m)
      real(wp), intent(out) :: over_bristle(m - of_journal)
      over_bristle = 0
   end subroutine add_late

   !> Derivatives of the rate of a part's bristles, in the state evaluated last, over the velocity at which it slides
   !> and over their own deflection; and that velocity over the rate of the first displacement. Only where there are
   !> bristles.
   pure function bristle_slopes(self, part) result(slopes)
      class(element_type), intent(in) :: self
      integer, intent(in) :: part
      real(wp) :: slopes(3)
      slopes = 0
   end function bristle_slopes

   !> The same of a part with bristles of several rotations: what they do to its own rows, per deflection (row,
   !> rotation), which is then left out of `add_late`; derivatives of their rates over the rates of the rotations, and
   !> of each over its own deflection.
   pure subroutine find_bristles(self, part, m, accelerations, over_bristle, of_rates, of_bristle)
      class(element_type), intent(in) :: self
      integer, intent(in) :: part, m
      logical, intent(in) :: accelerations
      real(wp), intent(out) :: over_bristle(:, :), of_rates(:, :), of_bristle
      over_bristle = 0
      of_rates = 0
      of_bristle = 0
   end subroutine find_bristles

   !> Force along a displacement of a part, N or N m, in the state evaluated last.
   pure real(wp) function own_force(self, part, coordinate)
      class(element_type), intent(in) :: self
      integer, intent(in) :: part, coordinate
      own_force = 0
   end function own_force

   !> Its force on the pair, N, from the states alone: what is sampled of it in a motion. Of a bearing, which has
   !> samples of its own, 0.
   pure function sampled_force(self, journal, pads, speed) result(force)
      class(element_type), intent(in) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      !> rad/s
      real(wp), intent(in) :: speed
      real(wp) :: force(of_journal)
      force = 0
   end function sampled_force

   !> Where its pair is for it, m.
   pure function sampled_position(self, journal) result(position)
      class(element_type), intent(in) :: self
      type(journal_motion), intent(in) :: journal
      real(wp) :: position(of_journal)
      position = journal%position
   end function sampled_position

   !> Sets the rates of the states of its parts at y, which was evaluated last, in those of all states.
   pure subroutine add_rates(self, layout, y, dydt)
      class(element_type), intent(in) :: self
      type(element_layout_type), intent(in) :: layout
      real(wp), intent(in) :: y(:)
      real(wp), intent(inout) :: dydt(:)
   end subroutine add_rates

   !> Masses of the n displacements of a part.
   pure subroutine part_masses(self, part, n, masses)
      class(element_type), intent(in) :: self
      integer, intent(in) :: part, n
      real(wp), intent(out) :: masses(n, n)
      masses = 0
   end subroutine part_masses

   !> What stands for a unit of a part's displacement, m: 1 but for rotations.
   pure real(wp) function length(self, part, coordinate)
      class(element_type), intent(in) :: self
      integer, intent(in) :: part, coordinate
      length = 1
   end function length

   !> How far a displacement of a part goes at most in a step of a search, in its own unit, of this characteristic
   !> scale.
   pure real(wp) function clearance_of(self, coordinate, scale)
      class(element_type), intent(in) :: self
      integer, intent(in) :: coordinate
      real(wp), intent(in) :: scale
      clearance_of = scale
   end function clearance_of

   !> The name of a displacement of its parts, as 'tilt'.
   pure function position_name(self, coordinate) result(name)
      class(element_type), intent(in) :: self
      integer, intent(in) :: coordinate
      character(len=:), allocatable :: name
      name = ''
   end function position_name

   !> Characteristic scales of the states of its parts, under a force, N, at the highest speed, rad/s.
   pure function scales(self, parts, force, speed)
      class(element_type), intent(in) :: self
      integer, intent(in) :: parts
      real(wp), intent(in) :: force, speed
      type(pad_state) :: scales(parts)
   end function scales

   !> A force, N, by which unbalanced ones are measured, of the state evaluated last; 0: only the load counts.
   pure real(wp) function reference_force(self, oil, speed)
      class(element_type), intent(in) :: self
      !> Of its parts; speed of the rotor, rad/s.
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      reference_force = 0
   end function reference_force

   !> The rates of the first displacement of a part at which derivatives of the forces jump.
   pure function switching_rates(self, part) result(rates)
      class(element_type), intent(in) :: self
      integer, intent(in) :: part
      real(wp), allocatable :: rates(:)
      allocate (rates(0))
   end function switching_rates

   !> Whether nothing puts switching points into the motion.
   pure logical function is_smooth(self)
      class(element_type), intent(in) :: self
      is_smooth = .true.
   end function is_smooth

   !> What may soon stop a motion in the state evaluated last; else empty.
   function warning(self)
      class(element_type), intent(in) :: self
      character(len=:), allocatable :: warning
      warning = ''
   end function warning
end module abstract_element
