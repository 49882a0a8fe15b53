!> What a bearing of tilting or fixed pads is made of, and what it keeps of the state evaluated last.
module bearing_construction
   use kinds, only: wp, i8
   use text, only: to_text
   use film_solver, only: film_solver_type, film_motion, film_law_type, film_response, film_not_converged
   use sloped_gap, only: sloped_motion, sloped_response
   use sloped_film, only: sloped_film_type
   use small_slopes, only: small_slopes_type
   use asperity_contact, only: asperity_contact_type, asperity_load, sloped_asperity_load
   use friction, only: turning_friction
   use state_layout, only: pad_state, pivot_deflection
   use abstract_element, only: element_type
   use kinematics, only: pad_frame
   use tilting_pad, only: tilting_pad_type, pad_coordinates_type, pad_loads, pad_derivatives
   use sloped_pad, only: journal_slope, sloped_derivatives
   use factories, only: march_films, pad_pivot
   implicit none (type, external)
   private
   public :: constructed_bearing, pad_sample, sloped_sample, pad_outputs, sloped_outputs

   !> Outputs of a pad: film force on the journal in its frame, N, maximum pressure, Pa; where slopes count also its
   !> moment, N m, and where the pressure is highest, rad and m.
   integer, parameter :: pad_outputs = 3, sloped_outputs = 7

   !> What is sampled of a pad beside its state.
   type :: pad_sample
      !> N; N m; film force on the journal in the pad frame, N.
      real(wp) :: pivot_load = 0, friction_moment = 0, film_force(2) = 0
      !> m; Pa.
      real(wp) :: min_film_thickness = 0, max_pressure = 0
      !> Normal force between the asperities of pad and journal, N.
      real(wp) :: asperity_force = 0
   end type pad_sample

   !> What is sampled beside where slopes count: friction moments against pitch and yaw, N m; least films at both ends,
   !> that of lower x first, m; moment of film and asperities on the journal in the pad frame, N m; where pressure is
   !> highest: angle from the pivot, rad, and distance from the middle, m.
   type :: sloped_sample
      real(wp) :: friction_moment(2) = 0, edge_films(2) = 0, moment(2) = 0, place(2) = 0
   end type sloped_sample

   !> Where slopes of the journal count: its slopes, films and what acts with them, of each pad.
   type :: sloped_parts_type
      type(journal_slope) :: journal
      type(sloped_film_type) :: film
      !> Of films that need not be close: tables of small slopes.
      type(small_slopes_type), allocatable :: small
      !> Motions, and those at which the films are taken.
      type(sloped_motion), allocatable :: motion(:), film_motion(:)
      type(sloped_response), allocatable :: response(:)
      type(sloped_asperity_load), allocatable :: asperity(:)
      type(sloped_derivatives), allocatable :: derivatives(:)
      !> Of pivots in which pads pitch.
      type(turning_friction), allocatable :: friction(:)
   end type sloped_parts_type

   type, abstract, extends(element_type) :: constructed_bearing
      type(tilting_pad_type), allocatable :: pads(:)
      !> What its pads do.
      class(pad_coordinates_type), allocatable :: coordinates
      type(pad_pivot), allocatable :: pivots(:)
      !> Of each pad the inverse of its matrix of masses, (coordinate, coordinate, pad); 0 of what is no coordinate.
      real(wp), allocatable :: per_mass(:, :, :)
      !> Of each pad the characteristic scales of its states that hang on no load.
      type(pad_state), allocatable :: natural(:)
      type(asperity_contact_type) :: asperities
      class(film_solver_type), allocatable :: film
      !> The loads of each pad in the state evaluated last; their derivatives where they were taken last.
      type(pad_loads), allocatable :: loads(:)
      type(pad_derivatives), allocatable :: derivatives(:)
      !> Contact of each pad with the journal in the state evaluated last.
      type(asperity_load), allocatable :: asperity(:)
      !> False: the pivots slide freely, whatever the law.
      logical :: rubs = .true.
      !> Bearing clearance, m.
      real(wp) :: clearance = 0
      !> What its films are for (factories).
      integer :: accuracy = march_films
      !> Of the oil, kg/m^3.
      real(wp) :: density = 0
      !> Of the state evaluated last: speed, rad/s, and laws of the films; frames and motions.
      real(wp) :: speed = 0
      class(film_law_type), allocatable :: laws(:)
      type(pad_frame), allocatable :: frame(:)
      type(film_motion), allocatable :: motion(:)
      !> Motions at which the films are taken: those of the journal, but where it touches a pad.
      type(film_motion), allocatable :: film_motion(:)
      type(film_response), allocatable :: response(:)
      integer(i8) :: evaluations = 0
      !> Values of a pad among the outputs of a motion.
      integer :: outputs = pad_outputs
      !> Not allocated where no slopes count.
      type(sloped_parts_type), allocatable :: sloped
   contains
      procedure :: part_masses
      procedure :: length
      procedure :: clearance_of
      procedure :: position_name
      procedure :: warning
      procedure :: films_converge
   end type constructed_bearing

   !> Film thickness over bearing clearance below which a failed march is put down to it.
   real(wp), parameter :: nearly_closed = 1e-2_wp

contains

   pure subroutine part_masses(self, part, n, masses)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: part, n
      real(wp), intent(out) :: masses(n, n)
      masses = self%coordinates%masses(self%pads(part))
   end subroutine part_masses

   pure real(wp) function length(self, part, coordinate)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: part, coordinate
      length = self%coordinates%length(self%pads(part), coordinate)
   end function length

   !> Of a pivot deflection the bearing clearance: that under the load is no limit.
   pure real(wp) function clearance_of(self, coordinate, scale)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: coordinate
      real(wp), intent(in) :: scale
      clearance_of = merge(self%clearance, scale, self%coordinates%kind(coordinate) == pivot_deflection)
   end function clearance_of

   pure function position_name(self, coordinate) result(name)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: coordinate
      character(len=:), allocatable :: name
      name = trim(self%coordinates%words(coordinate)%name)
   end function position_name

   !> Names the pad whose film was nearly closed in the state evaluated last, if there is one; else empty.
   function warning(self)
      class(constructed_bearing), intent(in) :: self
      character(len=:), allocatable :: warning
      integer :: i
      warning = ''
      i = minloc(self%response%min_film_thickness, dim=1)
      associate (thickness => self%response(i)%min_film_thickness)
         if (thickness < nearly_closed*self%clearance) warning = 'the film of pad '//to_text(i) &
            & //' is closing: thickness '//to_text(thickness)//' m'
      end associate
   end function warning

   !> False where a film of the state evaluated last, solved by iteration, did not converge.
   pure logical function films_converge(self)
      class(constructed_bearing), intent(in) :: self
      films_converge = all(self%response%status /= film_not_converged)
   end function films_converge
end module bearing_construction
