!> Newton's linear systems of the motion of rotor and pads: film and contact as linearised last, friction as evaluated
!> last.
module newton_system
   use kinds, only: wp
   use linear_algebra, only: dgesv
   use tilting_pad_bearing, only: tilting_pad_bearing_type
   use abstract_rotor, only: rotor_type
   use state_layout, only: state_layout_type, pads_layout_type
   use bordered_system, only: bordered_matrix, block_group, new_bordered_matrix
   implicit none (type, external)
   private
   public :: newton_system_type, new_newton_system

   !> What film and contact of a bearing's pads add to rows of the journal's equations and to the accelerations of the
   !> pads, (4, 4, pad), over displacements and over rates; rows and columns in the order journal y, z, tilt, pivot
   !> deflection.
   type :: pad_rows_type
      real(wp), allocatable :: over_positions(:, :, :), over_rates(:, :, :)
   end type pad_rows_type

   !> The rotor's equations without the displacements that are not those of journals: A on the rates of the journals,
   !> from A_jj, A_ji, A_ij, A_ii of all displacements.
   type :: condensed_rotor_type
      !> For which gamma, s, and which speed, rad/s.
      real(wp) :: gamma = -1, speed = -1
      !> A_ii^-1, (inner, inner), and A_ii^-1 A_ij, (inner, journals); A_ji A_ii^-1, (journals, inner).
      real(wp), allocatable :: inverse(:, :), follow(:, :), onto(:, :)
   end type condensed_rotor_type

   type :: newton_system_type
      private
      type(state_layout_type) :: layout
      !> Where the displacements of rotor and pads stand among the states, and their rates.
      integer, allocatable :: position_at(:), rate_at(:)
      !> Of the displacements those of the rotor, and of its journals.
      integer :: rotor = 0, journals = 0
      type(pad_rows_type), allocatable :: pads(:)
      type(condensed_rotor_type) :: condensed
      !> Speed where it was linearised last, rad/s.
      real(wp) :: speed = 0
      !> The system on the rates of journals and pads.
      type(bordered_matrix) :: matrix
   contains
      procedure :: linearize
      procedure :: solve
      procedure :: jacobian
   end type newton_system_type

   !> A change of the speed, over the speed, that leaves the condensed rotor as it is: gyroscopic moments that are off
   !> by so little slow the convergence by no more.
   real(wp), parameter :: same_speed = 1e-3_wp

contains

   !> The systems of this layout.
   type(newton_system_type) function new_newton_system(layout) result(system)
      type(state_layout_type), intent(in) :: layout
      integer :: b
      system%layout = layout
      system%position_at = layout%positions()
      system%rate_at = layout%rates()
      system%rotor = layout%rotor/2
      system%journals = 2*size(layout%bearings)
      allocate (system%pads(size(layout%bearings)))
      do b = 1, size(layout%bearings)
         associate (of => system%pads(b), n => layout%bearings(b)%pads)
            allocate (of%over_positions(4, 4, n), of%over_rates(4, 4, n), source=0.0_wp)
         end associate
      end do
      system%matrix = new_bordered_matrix(layout%bearings%motion/2, layout%bearings%pads)
   end function new_newton_system

   !> Takes the derivatives of film and contact from bearings, which have them, at a speed, rad/s.
   pure subroutine linearize(self, rotor, bearings, speed)
      class(newton_system_type), intent(inout) :: self
      class(rotor_type), intent(in) :: rotor
      type(tilting_pad_bearing_type), intent(in) :: bearings(:)
      real(wp), intent(in) :: speed
      real(wp) :: over_positions(4, 4), over_rates(4, 4)
      integer :: b, i
      self%speed = speed
      do b = 1, size(bearings)
         do i = 1, size(bearings(b)%pads)
            call bearings(b)%derivatives(i)%as_matrices(over_positions, over_rates)
            self%pads(b)%over_positions(:, :, i) = rows_of(over_positions, bearings(b)%per_mass(:, :, i))
            self%pads(b)%over_rates(:, :, i) = rows_of(over_rates, bearings(b)%per_mass(:, :, i))
         end do
      end do

   contains

      !> Derivatives of the journal's rows and the pad's accelerations from those of the forces on both.
      pure function rows_of(forces, per_mass) result(rows)
         real(wp), intent(in) :: forces(4, 4), per_mass(2, 2)
         real(wp) :: rows(4, 4)
         integer :: k
         rows(1:2, :) = rotor%newton_rows(forces(1:2, :))
         do k = 1, 4
            rows(3:4, k) = per_mass(:, 1)*forces(3, k) + per_mass(:, 2)*forces(4, k)
         end do
      end function rows_of
   end subroutine linearize

   !> A pad's over_positions and over_rates with friction as evaluated last; and what its accelerations gain per
   !> deflection of the bristles.
   pure subroutine with_friction(rows, bearing, pad, over_positions, over_rates, over_deflection)
      type(pad_rows_type), intent(in) :: rows
      type(tilting_pad_bearing_type), intent(in) :: bearing
      integer, intent(in) :: pad
      real(wp), intent(out) :: over_positions(4, 4), over_rates(4, 4), over_deflection(2)
      over_positions = rows%over_positions(:, :, pad)
      over_rates = rows%over_rates(:, :, pad)
      call bearing%pads(pad)%add_friction(bearing%loads(pad)%friction, bearing%derivatives(pad)%contact, &
         & bearing%per_mass(:, 1, pad), over_positions, over_rates, over_deflection)
   end subroutine with_friction

   !> b := (1 - gamma J)^(-1) b. Displacements follow from their rates u, x = b_x + gamma u, and so do bristles; u alone
   !> is solved for.
   subroutine solve(self, rotor, bearings, gamma, b, ok)
      class(newton_system_type), intent(inout) :: self
      class(rotor_type), intent(in) :: rotor
      type(tilting_pad_bearing_type), intent(in) :: bearings(:)
      real(wp), intent(in) :: gamma
      real(wp), intent(inout) :: b(:)
      logical, intent(out) :: ok
      real(wp) :: x(size(self%rate_at)), u(size(self%rate_at)), bristle(2, self%layout%pads)
      integer :: k, i, n
      x = b(self%position_at)
      u = b(self%rate_at)
      call rotor%newton_right(gamma, x(:self%rotor), u(:self%rotor))
      self%matrix%corner = 0
      do k = 1, size(bearings)
         associate (of => self%layout%bearings(k))
            do i = 1, of%pads
               n = of%other_pads + i
               if (of%bristles) bristle(:, n) = bristle_of(bearings(k), i, gamma, b(of%bristle(i)))
               call set_pad(of, self%pads(k), bearings(k), i, gamma, x, bristle(:, n), &
                  & self%matrix%groups(k), self%matrix%corner(:, :, k), u)
            end do
         end associate
      end do
      if (rotor%is_identity) then
         call self%matrix%solve(gamma, u, ok)
      else
         call solve_condensed(self, rotor, gamma, u, ok)
      end if
      b(self%position_at) = x + gamma*u
      b(self%rate_at) = u
      do k = 1, size(bearings)
         associate (of => self%layout%bearings(k))
            if (.not. of%bristles) cycle
            do i = 1, of%pads
               n = of%other_pads + i
               b(of%bristle(i)) = bristle(1, n) + bristle(2, n)*u(of%first_position(i))
            end do
         end associate
      end do
   end subroutine solve

   !> Solves for the rates of journals and pads, without the rotor's other displacements; then for theirs.
   subroutine solve_condensed(self, rotor, gamma, u, ok)
      class(newton_system_type), intent(inout) :: self
      class(rotor_type), intent(in) :: rotor
      real(wp), intent(in) :: gamma
      real(wp), intent(inout) :: u(:)
      logical, intent(out) :: ok
      real(wp) :: kept(size(u) - self%rotor + self%journals)
      ok = .true.
      associate (last => self%condensed)
         if (abs(last%gamma - gamma) > 0 .or. abs(last%speed - self%speed) > same_speed*abs(self%speed)) then
            call condense(self, rotor, gamma, ok)
         end if
      end associate
      if (.not. ok) return
      associate (n => self%journals, m => self%rotor)
         kept(:n) = u(:n) - matmul(self%condensed%onto, u(n + 1:m))
         kept(n + 1:) = u(m + 1:)
         call self%matrix%solve(gamma, kept, ok)
         u(n + 1:m) = matmul(self%condensed%inverse, u(n + 1:m)) - matmul(self%condensed%follow, kept(:n))
         u(:n) = kept(:n)
         u(m + 1:) = kept(n + 1:)
      end associate
   end subroutine solve_condensed

   !> Condenses the rotor's equations for this gamma, s, onto its journals.
   subroutine condense(self, rotor, gamma, ok)
      class(newton_system_type), intent(inout) :: self
      class(rotor_type), intent(in) :: rotor
      real(wp), intent(in) :: gamma
      logical, intent(out) :: ok
      real(wp) :: a(self%rotor, self%rotor), inner(self%rotor - self%journals, self%rotor - self%journals)
      integer :: pivots(size(inner, 1)), info, i
      a = rotor%newton_matrix(gamma, self%speed)
      associate (n => self%journals, of => self%condensed)
         inner = a(n + 1:, n + 1:)
         if (allocated(of%inverse)) deallocate (of%inverse)
         allocate (of%inverse, mold=inner)
         of%inverse = 0
         do i = 1, size(inner, 1)
            of%inverse(i, i) = 1
         end do
         info = 0
         if (size(inner, 1) > 0) call dgesv(size(inner, 1), size(inner, 1), inner, size(inner, 1), pivots, &
            & of%inverse, size(inner, 1), info)
         ok = info == 0
         if (.not. ok) return
         of%follow = matmul(of%inverse, a(n + 1:, :n))
         of%onto = matmul(a(:n, n + 1:), of%inverse)
         self%matrix%border = a(:n, :n) - matmul(a(:n, n + 1:), of%follow)
         of%gamma = gamma
         of%speed = self%speed
      end associate
   end subroutine condense

   !> A pad's deflection in Newton's system, bristle(1) + bristle(2) times its tilt rate, from its right-hand side.
   pure function bristle_of(bearing, pad, gamma, b) result(bristle)
      type(tilting_pad_bearing_type), intent(in) :: bearing
      integer, intent(in) :: pad
      real(wp), intent(in) :: gamma, b
      real(wp) :: bristle(2)
      associate (friction => bearing%loads(pad)%friction)
         bristle = [b, gamma*friction%rate_velocity*bearing%pads(pad)%ball_radius] &
            & /(1 - gamma*friction%rate_deflection)
      end associate
   end function bristle_of

   !> Puts the derivatives of a pad into the matrix on the rates, and what is known of displacements and bristles into
   !> its right-hand side u.
   subroutine set_pad(layout, rows, bearing, pad, gamma, x, bristle, group, corner, u)
      type(pads_layout_type), intent(in) :: layout
      type(pad_rows_type), intent(in) :: rows
      type(tilting_pad_bearing_type), intent(in) :: bearing
      integer, intent(in) :: pad
      real(wp), intent(in) :: gamma, x(:), bristle(2)
      type(block_group), intent(inout) :: group
      real(wp), intent(inout) :: corner(2, 2), u(:)
      real(wp) :: over_positions(4, 4), over_rates(4, 4), over_deflection(2), known(4), of_pad(4)
      integer :: k, own, m, y
      call with_friction(rows, bearing, pad, over_positions, over_rates, over_deflection)
      own = layout%first_position(pad)
      y = layout%journal(1)
      m = layout%motion/2
      of_pad = 0
      of_pad(1:2) = x(y:y + 1)
      of_pad(3:2 + m) = x(own:own + m - 1)
      known = 0
      do k = 1, 4
         known = known + over_positions(:, k)*of_pad(k)
         over_rates(:, k) = over_rates(:, k) + gamma*over_positions(:, k)
      end do
      if (layout%bristles) then
         known(3:4) = known(3:4) + over_deflection*bristle(1)
         over_rates(3:4, 3) = over_rates(3:4, 3) + over_deflection*bristle(2)
      end if
      u(y:y + 1) = u(y:y + 1) + gamma*known(1:2)
      u(own:own + m - 1) = u(own:own + m - 1) + gamma*known(3:2 + m)
      do k = 1, 2
         corner(1:2, k) = corner(1:2, k) + over_rates(1:2, k)
         group%down(1:m, k, pad) = over_rates(3:2 + m, k)
      end do
      do k = 1, m
         group%across(1:2, k, pad) = over_rates(1:2, 2 + k)
         group%block(1:m, k, pad) = over_rates(3:2 + m, 2 + k)
      end do
   end subroutine set_pad

   !> The whole Jacobian J.
   function jacobian(self, rotor, bearings) result(matrix)
      class(newton_system_type), intent(in) :: self
      class(rotor_type), intent(in) :: rotor
      type(tilting_pad_bearing_type), intent(in) :: bearings(:)
      real(wp) :: matrix(self%layout%n, self%layout%n)
      real(wp), dimension(self%rotor, self%rotor) :: over_positions, over_rates
      integer :: i, k
      matrix = 0
      call rotor%force_derivatives(self%speed, over_positions, over_rates)
      associate (n => self%rotor)
         do i = 1, n
            matrix(i, n + i) = 1
            matrix(n + 1:2*n, i) = rotor%accelerations(over_positions(:, i))
            matrix(n + 1:2*n, n + i) = rotor%accelerations(over_rates(:, i))
         end do
      end associate
      do k = 1, size(bearings)
         do i = 1, size(bearings(k)%pads)
            call add_pad(self, rotor, k, bearings(k), i, matrix)
         end do
      end do
   end function jacobian

   !> Adds what a pad of bearing k adds to the Jacobian.
   subroutine add_pad(self, rotor, k, bearing, pad, matrix)
      class(newton_system_type), intent(in) :: self
      class(rotor_type), intent(in) :: rotor
      integer, intent(in) :: k, pad
      type(tilting_pad_bearing_type), intent(in) :: bearing
      real(wp), intent(inout) :: matrix(:, :)
      real(wp) :: over_positions(4, 4), over_rates(4, 4), over_deflection(2)
      integer :: i, m, at(2 + self%layout%bearings(k)%motion/2)
      call with_friction(self%pads(k), bearing, pad, over_positions, over_rates, over_deflection)
      at = self%layout%bearings(k)%positions_of(pad)
      m = size(at) - 2
      associate (u => self%rate_at(at), x => self%position_at(at), of_rotor => self%rate_at(:self%rotor))
         do i = 3, 2 + m
            matrix(x(i), u(i)) = 1
         end do
         matrix(of_rotor, x) = matrix(of_rotor, x) + rotor%row_accelerations(over_positions(:2, :2 + m), k)
         matrix(of_rotor, u) = matrix(of_rotor, u) + rotor%row_accelerations(over_rates(:2, :2 + m), k)
         matrix(u(3:), x) = matrix(u(3:), x) + over_positions(3:2 + m, :2 + m)
         matrix(u(3:), u) = matrix(u(3:), u) + over_rates(3:2 + m, :2 + m)
         if (self%layout%bearings(k)%bristles) then
            associate (friction => bearing%loads(pad)%friction, z => self%layout%bearings(k)%bristle(pad))
               matrix(u(3:), z) = over_deflection(:m)
               matrix(z, u(3)) = friction%rate_velocity*bearing%pads(pad)%ball_radius
               matrix(z, z) = friction%rate_deflection
            end associate
         end if
      end associate
   end subroutine add_pad
end module newton_system
