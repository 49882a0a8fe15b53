!> A shaft that bends in several bearings, by the matrices of its equations on its journals.
module elastic_rotor
   use kinds, only: wp
   use linear_algebra, only: solve, identity
   use operating_point, only: operating_point_type
   use rotor_reduction, only: rotor_matrices_type
   use rigid_rotor, only: rotor_type
   implicit none (type, external)
   private
   public :: elastic_rotor_type, new_elastic_rotor

   type, extends(rotor_type) :: elastic_rotor_type
      type(rotor_matrices_type) :: matrices
      !> Sum of the moments of its unbalances, kg m, by which that of an operating point is distributed.
      real(wp) :: unbalance = 0
      !> Inverse of the matrix of masses.
      real(wp), allocatable :: per_mass(:, :)
      !> What the bearings bear where the journals stand in the middle of them, N, (2, bearing).
      real(wp), allocatable :: borne(:, :)
   contains
      procedure :: scales
      procedure :: loads
      procedure :: station_displacements
      procedure :: station_slopes
      procedure :: force
      procedure :: turn
      procedure :: accelerations
      procedure :: masses
      procedure :: move_about
      procedure :: element_forces
      procedure :: element_positions
      procedure :: force_derivatives
      procedure :: newton_rows
      procedure :: newton_matrix
      procedure :: newton_right
      procedure :: row_accelerations
      procedure :: has_own_frequencies
      procedure :: whirl_ends
      procedure :: whirl_changes
   end type elastic_rotor_type

   !> The smallest stiffness, over the largest, that is not rounding.
   real(wp), parameter :: least_stiffness = 1e-14_wp

contains

   !> The rotor of these matrices, whose unbalances have this sum of moments, kg m, and which turns at first with this
   !> speed, rad/s. `ok` is false where its masses are singular, or its stiffness while its films hold it.
   subroutine new_elastic_rotor(matrices, unbalance, speed, rotor, ok)
      type(rotor_matrices_type), intent(in) :: matrices
      real(wp), intent(in) :: unbalance, speed
      type(elastic_rotor_type), intent(out) :: rotor
      logical, intent(out) :: ok
      real(wp), allocatable :: bent(:, :), k(:, :), ignored(:, :)
      rotor%matrices = matrices
      rotor%unbalance = unbalance
      rotor%journals = matrices%journals
      rotor%positions = size(matrices%load)
      rotor%states = 2*rotor%positions
      rotor%stations = size(matrices%station, 1)/2
      if (any(matrices%slope_pairs > 0)) rotor%slope_pairs = matrices%slope_pairs
      if (allocated(matrices%elements)) rotor%elements = size(matrices%elements)
      rotor%per_mass = identity(rotor%positions)
      call solve(rotor%positions, rotor%positions, matrices%mass, rotor%per_mass, ok)
      if (.not. ok) return
      k = matrices%stiffness
      if (rotor%elements > 0 .or. allocated(matrices%circulatory)) then
         allocate (ignored, mold=k)
         call rotor%force_derivatives(speed, k, ignored, at_rest=.true.)
         k = -k
      end if
      associate (n => 2*rotor%journals, f => matrices%load, inner => rotor%positions - 2*rotor%journals)
         bent = reshape(f(n + 1:), [inner, 1])
         ! flexibility tells how near the stiffness is to a singular one
         if (rotor%elements > 0) bent = reshape([f(n + 1:), identity(inner)], [inner, inner + 1])
         call solve(inner, size(bent, 2), k(n + 1:, n + 1:), bent, ok)
         if (ok .and. rotor%elements > 0) ok = least_stiffness*norm2(k(n + 1:, n + 1:))*norm2(bent(:, 2:)) < 1
         if (ok) rotor%borne = reshape(f(:n) - matmul(k(:n, n + 1:), bent(:, 1)), [2, rotor%journals])
      end associate
   end subroutine new_elastic_rotor

   !> Journals: the clearance; slopes in bearings: over half the bearing's width; others: what moves a station by the
   !> least clearance.
   pure function scales(self, clearances)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: clearances(:)
      real(wp) :: scales(self%positions)
      integer :: i
      do i = 1, self%journals
         scales(2*i - 1:2*i) = clearances(i)
      end do
      do i = 2*self%journals + 1, self%positions
         scales(i) = minval(clearances)/maxval(abs(self%matrices%station(:, i)))
      end do
      do i = 1, self%journals
         associate (pair => self%slope_pair(i))
            if (pair > 0) scales(2*pair - 1:2*pair) = clearances(i)/self%matrices%half_width(i)
         end associate
      end do
   end function scales

   pure function loads(self, point)
      class(elastic_rotor_type), intent(in) :: self
      type(operating_point_type), intent(in) :: point
      real(wp) :: loads(2, self%journals)
      loads = self%borne
   end function loads

   pure function station_displacements(self, states) result(displacements)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: states(:)
      real(wp) :: displacements(2, self%stations), flat(2*self%stations)
      integer :: i
      ! called for every sample: columns are added up faster than by matmul
      flat = self%matrices%station_offset
      do i = 1, self%positions
         flat = flat + states(i)*self%matrices%station(:, i)
      end do
      displacements = reshape(flat, [2, self%stations])
   end function station_displacements

   pure function station_slopes(self, states) result(slopes)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: states(:)
      real(wp) :: slopes(2, self%stations)
      slopes = reshape(matmul(self%matrices%slope, states(:self%positions)) + self%matrices%slope_offset, &
         & [2, self%stations])
   end function station_slopes

   !> Part of its unbalances that acts at an operating point.
   pure real(wp) function share(self, point)
      class(elastic_rotor_type), intent(in) :: self
      type(operating_point_type), intent(in) :: point
      share = 0
      if (self%unbalance > 0) share = point%unbalance/self%unbalance
   end function share

   !> What forces at the stations of the excitations, (2, excitation), are on its displacements.
   pure function from_stations(self, point, forces) result(force)
      class(elastic_rotor_type), intent(in) :: self
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: forces(:, :)
      real(wp) :: force(self%positions)
      integer :: i
      force = 0
      do i = 1, size(forces, 2)
         associate (at => point%excitations(i)%station)
            force = force + matmul(forces(:, i), self%matrices%station(2*at - 1:2*at, :))
         end associate
      end do
   end function from_stations

   !> Weight and loads, unbalance, excitations, and what the shaft's bending, damping and gyroscopic moments answer.
   pure function force(self, states, point, t)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: states(:)
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: t
      real(wp) :: force(self%positions), phase, speed
      phase = point%shaft_angle(t)
      speed = point%speed(t)
      associate (m => self%matrices, n => self%positions)
         force = m%load - matmul(m%stiffness, states(:n)) - matmul(m%damping + speed*m%gyroscopic, states(n + 1:)) &
            & + share(self, point)*(speed**2*(m%unbalance(:, 1)*cos(phase) + m%unbalance(:, 2)*sin(phase)) &
            & + point%acceleration*(m%unbalance(:, 1)*sin(phase) - m%unbalance(:, 2)*cos(phase)))
      end associate
      if (allocated(point%excitations)) force = force + from_stations(self, point, point%excitation_forces(t))
      if (allocated(self%matrices%circulatory)) force = force - speed*matmul(self%matrices%circulatory, &
         & states(:self%positions))
      if (allocated(self%matrices%bow) .and. point%bent) then
         associate (m => self%matrices)
            force = force + (m%bow(:, 1) + speed**2*m%skew(:, 1) - point%acceleration*m%skew(:, 2))*cos(phase) &
               & + (m%bow(:, 2) + speed**2*m%skew(:, 2) + point%acceleration*m%skew(:, 1))*sin(phase)
         end associate
      end if
      if (allocated(self%matrices%elements)) call add_elements(self, states, point, speed, force)
   end function force

   !> Adds the forces of the elements that the matrices do not have.
   pure subroutine add_elements(self, states, point, speed, force)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: states(:), speed
      type(operating_point_type), intent(in) :: point
      real(wp), intent(inout) :: force(:)
      integer :: i
      associate (elements => self%matrices%elements, n => self%positions)
         do i = 1, size(elements)
            if (elements(i)%in_matrices .or. .not. (elements(i)%static .or. point%moves)) cycle
            force = force + matmul(elements(i)%force(states(:n), states(n + 1:), speed, point%moves), elements(i)%ends)
         end do
      end associate
   end subroutine add_elements

   !> Unbalance, bow and skew turn, and excitations change.
   pure function turn(self, point, t)
      class(elastic_rotor_type), intent(in) :: self
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: t
      real(wp) :: turn(self%positions), phase
      phase = point%shaft_angle(t)
      associate (u => self%matrices%unbalance)
         turn = share(self, point)*point%speed(t)**3*(u(:, 2)*cos(phase) - u(:, 1)*sin(phase))
      end associate
      if (allocated(self%matrices%bow) .and. point%bent) then
         associate (m => self%matrices, speed => point%speed(t))
            turn = turn + speed*(m%bow(:, 2)*cos(phase) - m%bow(:, 1)*sin(phase)) &
               & + speed**3*(m%skew(:, 2)*cos(phase) - m%skew(:, 1)*sin(phase))
         end associate
      end if
      if (allocated(point%excitations)) turn = turn + from_stations(self, point, point%excitation_rates(t))
   end function turn

   pure function accelerations(self, force)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: force(:)
      real(wp) :: accelerations(self%positions)
      accelerations = matmul(self%per_mass, force)
   end function accelerations

   pure function masses(self)
      class(elastic_rotor_type), intent(in) :: self
      real(wp) :: masses(self%positions, self%positions)
      masses = self%matrices%mass
   end function masses

   pure function element_forces(self, states, point, t) result(forces)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: states(:)
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: t
      real(wp) :: forces(2, self%elements)
      integer :: i
      do i = 1, self%elements
         associate (e => self%matrices%elements(i), n => self%positions)
            forces(:, i) = 0
            if (e%static .or. point%moves) forces(:, i) = e%force(states(:n), states(n + 1:2*n), point%speed(t), &
               & point%moves)
         end associate
      end do
   end function element_forces

   pure function element_positions(self, states) result(positions)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: states(:)
      real(wp) :: positions(2, self%elements)
      integer :: i
      do i = 1, self%elements
         associate (e => self%matrices%elements(i))
            positions(:, i) = matmul(e%ends, states(:self%positions)) + e%offset
         end associate
      end do
   end function element_positions

   !> What acts in motion alone vanishes at the equilibrium.
   pure subroutine move_about(self, positions)
      class(elastic_rotor_type), intent(inout) :: self
      real(wp), intent(in) :: positions(:)
      integer :: i
      if (.not. allocated(self%matrices%elements)) return
      do i = 1, size(self%matrices%elements)
         associate (e => self%matrices%elements(i))
            if (.not. e%static) e%origin = matmul(e%ends, positions(:self%positions)) + e%offset
         end associate
      end do
   end subroutine move_about

   pure subroutine force_derivatives(self, speed, over_positions, over_rates, at_rest)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: speed
      real(wp), intent(out) :: over_positions(:, :), over_rates(:, :)
      logical, intent(in), optional :: at_rest
      logical :: moves
      real(wp) :: c(2, 2, 3)
      integer :: i
      over_positions = -self%matrices%stiffness
      over_rates = -(self%matrices%damping + speed*self%matrices%gyroscopic)
      if (allocated(self%matrices%circulatory)) over_positions = over_positions - speed*self%matrices%circulatory
      if (.not. allocated(self%matrices%elements)) return
      moves = .true.
      if (present(at_rest)) moves = .not. at_rest
      do i = 1, size(self%matrices%elements)
         associate (e => self%matrices%elements(i))
            if (e%in_matrices .or. .not. (e%static .or. moves)) cycle
            if (moves) then
               c = e%coefficients(speed)
            else
               c = e%at_rest(speed)
            end if
            over_positions = over_positions - e%onto_rotor(c(:, :, 1))
            over_rates = over_rates - e%onto_rotor(c(:, :, 2))
         end associate
      end do
   end subroutine force_derivatives

   !> Whether an element depends on the frequency of a whirl.
   pure logical function has_own_frequencies(self)
      class(elastic_rotor_type), intent(in) :: self
      has_own_frequencies = .false.
      if (allocated(self%matrices%elements)) has_own_frequencies = any(self%matrices%elements%own_frequency)
   end function has_own_frequencies

   !> The elements that depend on the frequency of a whirl.
   pure function of_own_frequency(self) result(chosen)
      class(elastic_rotor_type), intent(in) :: self
      integer, allocatable :: chosen(:)
      integer :: i
      allocate (chosen(0))
      if (self%has_own_frequencies()) chosen = pack([(i, i=1, self%elements)], self%matrices%elements%own_frequency)
   end function of_own_frequency

   !> What the displacements of the rotor are between the ends of these elements, (two of each, displacement).
   pure function whirl_ends(self) result(ends)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), allocatable :: ends(:, :)
      integer :: i
      associate (chosen => of_own_frequency(self))
         allocate (ends(2*size(chosen), self%positions))
         do i = 1, size(chosen)
            ends(2*i - 1:2*i, :) = self%matrices%elements(chosen(i))%ends
         end do
      end associate
   end function whirl_ends

   !> What a whirl at another frequency than that of the speed, both in rad/s, changes of stiffness, damping and mass
   !> between these ends.
   pure function whirl_changes(self, speed, whirl) result(changes)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: speed, whirl
      real(wp), allocatable :: changes(:, :, :)
      integer :: i
      associate (chosen => of_own_frequency(self))
         allocate (changes(2*size(chosen), 2*size(chosen), 3), source=0.0_wp)
         do i = 1, size(chosen)
            associate (e => self%matrices%elements(chosen(i)), at => [2*i - 1, 2*i])
               changes(at, at, :) = e%coefficients(speed, whirl) - e%coefficients(speed)
            end associate
         end do
      end associate
   end function whirl_changes

   !> P = 1: forces.
   pure function newton_rows(self, forces) result(rows)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: forces(:, :)
      real(wp) :: rows(size(forces, 1), size(forces, 2))
      rows = forces
   end function newton_rows

   pure function newton_matrix(self, gamma, speed) result(matrix)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: gamma, speed
      real(wp) :: matrix(self%positions, self%positions)
      real(wp) :: c(2, 2, 3)
      integer :: i
      associate (m => self%matrices)
         matrix = m%mass + gamma*(m%damping + speed*m%gyroscopic) + gamma**2*m%stiffness
         if (allocated(m%circulatory)) matrix = matrix + gamma**2*speed*m%circulatory
         if (.not. allocated(m%elements)) return
         do i = 1, size(m%elements)
            associate (e => m%elements(i))
               if (e%in_matrices) cycle
               c = e%coefficients(speed)
               matrix = matrix + e%onto_rotor(gamma*c(:, :, 2) + gamma**2*c(:, :, 1))
            end associate
         end do
      end associate
   end function newton_matrix

   pure subroutine newton_right(self, gamma, speed, x, u)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: gamma, speed, x(:)
      real(wp), intent(inout) :: u(:)
      real(wp) :: c(2, 2, 3)
      integer :: i
      u = matmul(self%matrices%mass, u) - gamma*matmul(self%matrices%stiffness, x)
      if (allocated(self%matrices%circulatory)) u = u - gamma*speed*matmul(self%matrices%circulatory, x)
      if (.not. allocated(self%matrices%elements)) return
      do i = 1, size(self%matrices%elements)
         associate (e => self%matrices%elements(i))
            if (e%in_matrices) cycle
            c = e%coefficients(speed)
            u = u - gamma*matmul(matmul(c(:, :, 1), matmul(e%ends, x)), e%ends)
         end associate
      end do
   end subroutine newton_right

   pure function row_accelerations(self, rows, journal) result(accelerations)
      class(elastic_rotor_type), intent(in) :: self
      real(wp), intent(in) :: rows(:, :)
      integer, intent(in) :: journal
      real(wp) :: accelerations(self%positions, size(rows, 2))
      accelerations = matmul(self%per_mass(:, 2*journal - 1:2*journal), rows)
   end function row_accelerations
end module elastic_rotor
