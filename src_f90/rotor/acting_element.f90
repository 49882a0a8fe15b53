!> What linear elements (the groups &element) do to a rotor: the force of each on its displacements and rates, with
!> coefficients over the speed.
module acting_element
   use kinds, only: wp
   use rising_numbers, only: number_up_to
   use case_groups, only: station_element_type
   implicit none (type, external)
   private
   public :: acting_element_type, new_acting_element

   !> The force on one end is -K (u - u0) - C u' - M u'' with the displacement u towards it from the other end; what is
   !> opposite acts there.
   type :: acting_element_type
      logical :: static = .true.
      !> Whether the matrices of the rotor have it.
      logical :: in_matrices = .false.
      !> u is matmul(ends, x) + offset with the displacements x of the rotor, m; where its force vanishes.
      real(wp), allocatable :: ends(:, :)
      real(wp) :: offset(2) = 0, origin(2) = 0
      !> Coefficients of stiffness, damping and mass, in this order, yy, yz, zy, zz of each, (coefficient, whirl
      !> frequency, speed), over rising frequencies and speeds, rad/s, if there are any.
      real(wp), allocatable, private :: table(:, :, :), speeds(:), whirls(:)
      !> Cross-coupled stiffness, N/m, forward where the shaft turns clockwise.
      real(wp), private :: cross_stiffness = 0
      !> Whether it depends on the frequency of a whirl.
      logical :: own_frequency = .false.
   contains
      procedure :: is_constant
      procedure :: coefficients
      procedure :: at_rest
      procedure :: force
      procedure :: onto_rotor
   end type acting_element_type

contains

   !> What a group says of an element of a shaft that turns in this sense (1 clockwise, -1 anticlockwise).
   pure function new_acting_element(from, sense) result(element)
      type(station_element_type), intent(in) :: from
      real(wp), intent(in) :: sense
      type(acting_element_type) :: element
      element%static = from%static
      element%cross_stiffness = sense*from%cross_stiffness
      if (allocated(from%table)) then
         element%speeds = from%speeds
         element%whirls = from%whirls
         element%table = from%table
         element%own_frequency = size(from%whirls) > 0 .and. from%frequency == 'own'
      else
         allocate (element%speeds(0), element%whirls(0))
         element%table = reshape([from%stiffness, from%damping, from%mass], [12, 1, 1])
      end if
   end function new_acting_element

   !> Whether neither speed nor frequency matters.
   pure logical function is_constant(self)
      class(acting_element_type), intent(in) :: self
      is_constant = size(self%speeds) == 0
   end function is_constant

   !> Stiffness, N/m, damping, N s/m, and mass, kg, at a speed, rad/s: linear between the speeds of its table, and
   !> between its frequencies, beyond which they stay what they are.
   pure function coefficients(self, speed, whirl)
      class(acting_element_type), intent(in) :: self
      real(wp), intent(in) :: speed
      !> Frequency of the whirl, rad/s; left out: the speed.
      real(wp), intent(in), optional :: whirl
      real(wp) :: coefficients(2, 2, 3), values(12), part, frequency
      integer :: i, k, k2
      part = 0
      i = 1
      if (size(self%speeds) > 1) then
         i = max(1, min(number_up_to(self%speeds, speed), size(self%speeds) - 1))
         part = (speed - self%speeds(i))/(self%speeds(i + 1) - self%speeds(i))
      end if
      if (size(self%whirls) < 2) then
         values = at_frequency(1, 1, 0.0_wp)
      else
         frequency = speed
         if (present(whirl)) frequency = whirl
         k = max(1, min(number_up_to(self%whirls, frequency), size(self%whirls) - 1))
         k2 = k + 1
         values = at_frequency(k, k2, max(0.0_wp, min(1.0_wp, (frequency - self%whirls(k)) &
            & /(self%whirls(k2) - self%whirls(k)))))
      end if
      do k = 1, 3
         coefficients(:, :, k) = transpose(reshape(values(4*k - 3:4*k), [2, 2]))
      end do
      coefficients(1, 2, 1) = coefficients(1, 2, 1) + self%cross_stiffness
      coefficients(2, 1, 1) = coefficients(2, 1, 1) - self%cross_stiffness
   contains
      !> Between two frequencies, at the speed.
      pure function at_frequency(low, high, way) result(values)
         integer, intent(in) :: low, high
         real(wp), intent(in) :: way
         real(wp) :: values(12)
         associate (next => min(i + 1, size(self%table, 3)))
            values = (1 - part)*((1 - way)*self%table(:, low, i) + way*self%table(:, high, i)) &
               & + part*((1 - way)*self%table(:, low, next) + way*self%table(:, high, next))
         end associate
      end function at_frequency
   end function coefficients

   !> The same at the equilibrium, where what depends on the frequency has that of a whirl without any.
   pure function at_rest(self, speed) result(coefficients)
      class(acting_element_type), intent(in) :: self
      real(wp), intent(in) :: speed
      real(wp) :: coefficients(2, 2, 3)
      coefficients = self%coefficients(speed, merge(0.0_wp, speed, self%own_frequency))
   end function at_rest

   !> Force on its station, N, but for that of its mass, where the rotor has these displacements and rates.
   pure function force(self, x, v, speed, moves)
      class(acting_element_type), intent(in) :: self
      real(wp), intent(in) :: x(:), v(:), speed
      !> False: at the equilibrium.
      logical, intent(in) :: moves
      real(wp) :: force(2), c(2, 2, 3)
      if (moves) then
         c = self%coefficients(speed)
      else
         c = self%at_rest(speed)
      end if
      force = -matmul(c(:, :, 1), matmul(self%ends, x) + self%offset - self%origin) - matmul(c(:, :, 2), &
         & matmul(self%ends, v))
   end function force

   !> Coefficients between its ends as those of the displacements of the rotor.
   pure function onto_rotor(self, coefficients)
      class(acting_element_type), intent(in) :: self
      real(wp), intent(in) :: coefficients(2, 2)
      real(wp) :: onto_rotor(size(self%ends, 2), size(self%ends, 2))
      onto_rotor = matmul(transpose(self%ends), matmul(coefficients, self%ends))
   end function onto_rotor
end module acting_element
