!> What linear elements (the groups &element) do to a rotor: the force of each on its displacements and rates, with
!> coefficients over the speed.
module acting_element
   use kinds, only: wp
   use case_groups, only: station_element_type
   use case_inputs, only: case_type
   implicit none (type, external)
   private
   public :: acting_element_type, new_acting_element, elements_of

   !> The force on one end is -K (u - u0) - C u' - M u'' with the displacement u towards it from the other end; what is
   !> opposite acts there.
   type :: acting_element_type
      logical :: static = .true.
      !> Whether the matrices of the rotor have it.
      logical :: in_matrices = .false.
      !> u is matmul(ends, x) + offset with the displacements x of the rotor, m; where its force vanishes.
      real(wp), allocatable :: ends(:, :)
      real(wp) :: offset(2) = 0, origin(2) = 0
      real(wp), private, dimension(2, 2) :: constant_stiffness = 0, constant_damping = 0, constant_mass = 0
   contains
      procedure :: stiffness
      procedure :: damping
      procedure :: mass
      procedure :: force
      procedure :: onto_rotor
   end type acting_element_type

contains

   !> The elements of a machine: those of its groups and, for the task coefficients, the cross-coupled stiffness at each
   !> of its journals.
   pure function elements_of(inputs) result(elements)
      type(case_type), intent(in) :: inputs
      type(station_element_type), allocatable :: elements(:)
      integer :: b, n
      associate (given => inputs%rotor%elastic%elements, q => inputs%coefficients%cross_stiffness)
         n = size(given)
         allocate (elements(n + merge(size(inputs%bearings), 0, inputs%about%task == 'coefficients' .and. abs(q) > 0)))
         do b = 1, n
            elements(b) = given(b)
         end do
         do b = n + 1, size(elements)
            associate (bearing => inputs%bearings(b - n))
               elements(b)%station = bearing%station
               elements(b)%housing = ''
               if (allocated(bearing%support)) elements(b)%housing = bearing%name
               elements(b)%cross_stiffness = q
               elements(b)%static = .false.
            end associate
         end do
      end associate
   end function elements_of

   !> What a group says of an element of a shaft that turns in this sense (1 clockwise, -1 anticlockwise).
   pure function new_acting_element(from, sense) result(element)
      type(station_element_type), intent(in) :: from
      real(wp), intent(in) :: sense
      type(acting_element_type) :: element
      element%static = from%static
      element%constant_stiffness = matrix(from%stiffness) &
         & + sense*from%cross_stiffness*reshape([0.0_wp, -1.0_wp, 1.0_wp, 0.0_wp], [2, 2])
      element%constant_damping = matrix(from%damping)
      element%constant_mass = matrix(from%mass)
   end function new_acting_element

   !> Of coefficients yy, yz, zy, zz.
   pure function matrix(coefficients)
      real(wp), intent(in) :: coefficients(4)
      real(wp) :: matrix(2, 2)
      matrix = transpose(reshape(coefficients, [2, 2]))
   end function matrix

   !> N/m at a speed, rad/s.
   pure function stiffness(self, speed)
      class(acting_element_type), intent(in) :: self
      real(wp), intent(in) :: speed
      real(wp) :: stiffness(2, 2)
      stiffness = self%constant_stiffness
   end function stiffness

   !> N s/m at a speed, rad/s.
   pure function damping(self, speed)
      class(acting_element_type), intent(in) :: self
      real(wp), intent(in) :: speed
      real(wp) :: damping(2, 2)
      damping = self%constant_damping
   end function damping

   !> kg at a speed, rad/s.
   pure function mass(self, speed)
      class(acting_element_type), intent(in) :: self
      real(wp), intent(in) :: speed
      real(wp) :: mass(2, 2)
      mass = self%constant_mass
   end function mass

   !> Force on its station, N, but for that of its mass, where the rotor has these displacements and rates.
   pure function force(self, x, v, speed)
      class(acting_element_type), intent(in) :: self
      real(wp), intent(in) :: x(:), v(:), speed
      real(wp) :: force(2)
      force = -matmul(self%stiffness(speed), matmul(self%ends, x) + self%offset - self%origin) &
         & - matmul(self%damping(speed), matmul(self%ends, v))
   end function force

   !> Coefficients between its ends as those of the displacements of the rotor.
   pure function onto_rotor(self, coefficients)
      class(acting_element_type), intent(in) :: self
      real(wp), intent(in) :: coefficients(2, 2)
      real(wp) :: onto_rotor(size(self%ends, 2), size(self%ends, 2))
      onto_rotor = matmul(transpose(self%ends), matmul(coefficients, self%ends))
   end function onto_rotor
end module acting_element
