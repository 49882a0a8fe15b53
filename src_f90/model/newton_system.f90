!> Newton's linear systems of the motion of rotor and pads: film and contact as linearised last, friction as evaluated
!> last.
module newton_system
   use kinds, only: wp
   use tilting_pad_bearing, only: tilting_pad_bearing_type
   use rigid_journal, only: rigid_journal_type
   use state_layout, only: state_layout_type
   use bordered_system, only: bordered_matrix, new_bordered_matrix
   implicit none (type, external)
   private
   public :: newton_system_type, new_newton_system

   type :: newton_system_type
      private
      type(state_layout_type) :: layout
      !> Where the displacements of rotor and pads stand among the states, and their rates.
      integer, allocatable :: position_at(:), rate_at(:)
      !> What film and contact of a pad add to the derivatives of the accelerations, (4, 4, pad), over displacements and
      !> over rates; rows and columns in the order journal y, z, tilt, pivot deflection.
      real(wp), allocatable :: over_positions(:, :, :), over_rates(:, :, :)
      !> The system on the rates alone.
      type(bordered_matrix) :: matrix
   contains
      procedure :: linearize
      procedure :: solve
      procedure :: jacobian
   end type newton_system_type

contains

   !> The systems of this layout.
   type(newton_system_type) function new_newton_system(layout) result(system)
      type(state_layout_type), intent(in) :: layout
      system%layout = layout
      system%position_at = layout%positions()
      system%rate_at = layout%rates()
      allocate (system%over_positions(4, 4, layout%pads), system%over_rates(4, 4, layout%pads), source=0.0_wp)
      system%matrix = new_bordered_matrix(layout%rotor/2, layout%motion/2, layout%pads)
   end function new_newton_system

   !> Takes the derivatives of film and contact from a bearing, which has them.
   pure subroutine linearize(self, rotor, bearing)
      class(newton_system_type), intent(inout) :: self
      type(rigid_journal_type), intent(in) :: rotor
      type(tilting_pad_bearing_type), intent(in) :: bearing
      real(wp) :: over_positions(4, 4), over_rates(4, 4)
      integer :: i
      do i = 1, self%layout%pads
         call bearing%derivatives(i)%as_matrices(over_positions, over_rates)
         self%over_positions(:, :, i) = accelerations(over_positions, bearing%per_mass(:, :, i))
         self%over_rates(:, :, i) = accelerations(over_rates, bearing%per_mass(:, :, i))
      end do

   contains

      !> Derivatives of the accelerations from those of the forces on journal and pad.
      pure function accelerations(forces, per_mass)
         real(wp), intent(in) :: forces(4, 4), per_mass(2, 2)
         real(wp) :: accelerations(4, 4), journal(rotor%states, 4)
         integer :: k
         journal = rotor%rate_derivatives(forces(1:2, :))
         accelerations(1:2, :) = journal(self%rate_at(1:2), :)
         do k = 1, 4
            accelerations(3:4, k) = per_mass(:, 1)*forces(3, k) + per_mass(:, 2)*forces(4, k)
         end do
      end function accelerations
   end subroutine linearize

   !> A pad's over_positions and over_rates with friction as evaluated last; and what its accelerations gain per
   !> deflection of the bristles.
   pure subroutine with_friction(self, bearing, pad, over_positions, over_rates, over_deflection)
      class(newton_system_type), intent(in) :: self
      type(tilting_pad_bearing_type), intent(in) :: bearing
      integer, intent(in) :: pad
      real(wp), intent(out) :: over_positions(4, 4), over_rates(4, 4), over_deflection(2)
      over_positions = self%over_positions(:, :, pad)
      over_rates = self%over_rates(:, :, pad)
      call bearing%pads(pad)%add_friction(bearing%loads(pad)%friction, bearing%derivatives(pad)%contact, &
         & bearing%per_mass(:, 1, pad), over_positions, over_rates, over_deflection)
   end subroutine with_friction

   !> b := (1 - gamma J)^(-1) b. Displacements follow from their rates u, x = b_x + gamma u, and so do bristles; u alone
   !> is solved for.
   subroutine solve(self, bearing, gamma, b, ok)
      class(newton_system_type), intent(inout) :: self
      type(tilting_pad_bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: gamma
      real(wp), intent(inout) :: b(:)
      logical, intent(out) :: ok
      real(wp) :: x(size(self%rate_at)), u(size(self%rate_at)), bristle(2, self%layout%pads)
      integer :: i
      x = b(self%position_at)
      u = b(self%rate_at)
      self%matrix%corner = 0
      do i = 1, self%layout%pads
         if (self%layout%bristles) bristle(:, i) = bristle_of(bearing, i, gamma, b(self%layout%bristle(i)))
         call set_pad(self, bearing, i, gamma, x, bristle(:, i), u)
      end do
      call self%matrix%solve(gamma, u, ok)
      b(self%position_at) = x + gamma*u
      b(self%rate_at) = u
      if (self%layout%bristles) then
         do i = 1, self%layout%pads
            b(self%layout%bristle(i)) = bristle(1, i) + bristle(2, i)*u(self%layout%first_position(i))
         end do
      end if
   end subroutine solve

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

   !> Puts a pad's derivatives into the matrix on the rates, and what is known of displacements and
   !> bristles into its right-hand side u.
   subroutine set_pad(self, bearing, pad, gamma, x, bristle, u)
      class(newton_system_type), intent(inout) :: self
      type(tilting_pad_bearing_type), intent(in) :: bearing
      integer, intent(in) :: pad
      real(wp), intent(in) :: gamma, x(:), bristle(2)
      real(wp), intent(inout) :: u(:)
      real(wp) :: over_positions(4, 4), over_rates(4, 4), over_deflection(2), known(4), of_pad(4)
      integer :: k, own, m
      call with_friction(self, bearing, pad, over_positions, over_rates, over_deflection)
      own = self%layout%first_position(pad)
      m = self%layout%motion/2
      of_pad = 0
      of_pad(1:2) = x(1:2)
      of_pad(3:2 + m) = x(own:own + m - 1)
      known = 0
      do k = 1, 4
         known = known + over_positions(:, k)*of_pad(k)
         over_rates(:, k) = over_rates(:, k) + gamma*over_positions(:, k)
      end do
      if (self%layout%bristles) then
         known(3:4) = known(3:4) + over_deflection*bristle(1)
         over_rates(3:4, 3) = over_rates(3:4, 3) + over_deflection*bristle(2)
      end if
      u(1:2) = u(1:2) + gamma*known(1:2)
      u(own:own + m - 1) = u(own:own + m - 1) + gamma*known(3:2 + m)
      associate (matrix => self%matrix)
         do k = 1, 2
            matrix%corner(1:2, k) = matrix%corner(1:2, k) + over_rates(1:2, k)
            matrix%down(1:m, k, pad) = over_rates(3:2 + m, k)
         end do
         do k = 1, m
            matrix%across(1:2, k, pad) = over_rates(1:2, 2 + k)
            matrix%block(1:m, k, pad) = over_rates(3:2 + m, 2 + k)
         end do
      end associate
   end subroutine set_pad

   !> The whole Jacobian J.
   function jacobian(self, rotor, bearing) result(matrix)
      class(newton_system_type), intent(in) :: self
      type(tilting_pad_bearing_type), intent(in) :: bearing
      type(rigid_journal_type), intent(in) :: rotor
      real(wp) :: matrix(self%layout%n, self%layout%n)
      real(wp) :: over_positions(4, 4), over_rates(4, 4), over_deflection(2)
      integer :: i, k, m, at(2 + self%layout%motion/2)
      matrix = 0
      matrix(:self%layout%rotor, :self%layout%rotor) = rotor%own_derivatives()
      m = self%layout%motion/2
      do i = 1, self%layout%pads
         call with_friction(self, bearing, i, over_positions, over_rates, over_deflection)
         at = self%layout%positions_of(i)
         associate (u => self%rate_at(at), x => self%position_at(at))
            do k = 3, 2 + m
               matrix(x(k), u(k)) = 1
            end do
            matrix(u, x) = matrix(u, x) + over_positions(:2 + m, :2 + m)
            matrix(u, u) = matrix(u, u) + over_rates(:2 + m, :2 + m)
            if (self%layout%bristles) then
               associate (friction => bearing%loads(i)%friction, z => self%layout%bristle(i))
                  matrix(u(3:), z) = over_deflection(:m)
                  matrix(z, u(3)) = friction%rate_velocity*bearing%pads(i)%ball_radius
                  matrix(z, z) = friction%rate_deflection
               end associate
            end if
         end associate
      end do
   end function jacobian
end module newton_system
