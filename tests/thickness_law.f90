!> A film law of no physics whose mobilities turn with the film thickness: E = 1/(1 + a H^2) along the film, K = 1 + c H
!> across over along, H the thickness over the pad clearance, S = 1 + a H.
module thickness_law
   use kinds, only: wp
   use film_law, only: film_law_type, law_at_nodes, most_numbers
   use pad_gap, only: pad_gap_type, film_motion
   implicit none (type, external)
   private
   public :: thickness_law_type

   type, extends(film_law_type) :: thickness_law_type
      real(wp) :: a = 0, c = 0
   contains
      procedure :: at_nodes
      procedure :: shear_weight
      procedure :: numbers
      procedure :: mirrored
      procedure :: turns_with_thickness
      procedure :: slides_unevenly
   end type thickness_law_type

contains

   pure subroutine at_nodes(self, gap, motion, sine, cosine, nodes)
      class(thickness_law_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: sine(:), cosine(:)
      type(law_at_nodes), intent(inout) :: nodes
      !> H; how much of 1/E and of K is theirs that grows; ln H and its slopes along the film, (node, order from 0).
      real(wp), dimension(size(sine)) :: h, f, g
      real(wp) :: slopes(size(sine), 0:3)
      h = gap%thickness(motion, sine, cosine)/gap%machined_clearance
      slopes = gap%thickness_slopes(motion, sine, cosine)
      f = self%a*h**2/(1 + self%a*h**2)
      g = self%c*h/(1 + self%c*h)
      nodes%inverse_root = sqrt(1 + self%a*h**2)
      nodes%sliding = spread(1.0_wp, 1, size(h))
      nodes%sliding_slopes = spread(spread(0.0_wp, 1, size(h)), 2, 2)
      associate (first => slopes(:, 1), second => slopes(:, 2), third => slopes(:, 3), l_1 => -2*f, &
         & l_2 => -4*f*(1 - f), l_3 => -8*f*(1 - f)*(1 - 2*f))
         nodes%flow_slopes = reshape([l_1*first, l_2*first**2 + l_1*second, &
            & l_3*first**3 + 3*l_2*first*second + l_1*third], [size(h), 3])
         if (.not. allocated(nodes%flow_power)) allocate (nodes%flow_power(size(h), 0:2), &
            & nodes%across_power(size(h), 0:1))
         nodes%flow_power(:, 0) = l_1
         nodes%flow_power(:, 1) = l_2*first
         nodes%flow_power(:, 2) = l_3*first**2 + l_2*second
      end associate
      nodes%across = 1 + self%c*h
      nodes%across_slope = g*slopes(:, 1)
      nodes%across_power(:, 0) = g
      nodes%across_power(:, 1) = g*(1 - g)*slopes(:, 1)
   end subroutine at_nodes

   elemental real(wp) function shear_weight(self, gap, motion, phi)
      class(thickness_law_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: phi
      shear_weight = 1 + self%a*gap%thickness(motion, sin(phi), cos(phi))/gap%machined_clearance
   end function shear_weight

   pure function numbers(self)
      class(thickness_law_type), intent(in) :: self
      real(wp) :: numbers(most_numbers)
      numbers = 0
      numbers(:3) = [1.0_wp, self%a, self%c]
   end function numbers

   function mirrored(self)
      class(thickness_law_type), intent(in) :: self
      class(film_law_type), allocatable :: mirrored
      allocate (mirrored, source=self)
   end function mirrored

   pure logical function turns_with_thickness(self)
      class(thickness_law_type), intent(in) :: self
      turns_with_thickness = .true.
   end function turns_with_thickness

   pure logical function slides_unevenly(self)
      class(thickness_law_type), intent(in) :: self
      slides_unevenly = .false.
   end function slides_unevenly
end module thickness_law
