!> Newton's linear systems of the motion of a rotor and its elements: these as linearised last, friction as evaluated
!> last.
module newton_system
   use kinds, only: wp
   use linear_algebra, only: solve_equations => solve, identity
   use rigid_rotor, only: rotor_type
   use state_layout, only: state_layout_type, of_journal
   use abstract_element, only: element_type, element_pointer
   use bordered_system, only: bordered_matrix, new_bordered_matrix
   implicit none (type, external)
   private
   public :: newton_system_type, new_newton_system

   !> What the parts of an element add to rows of the equations of the rotor's displacements that they know and to their
   !> own accelerations, (m, m, part), over the displacements of both and over their rates: m = on + n of a part that
   !> knows `on` of the rotor's and has n.
   type :: element_rows_type
      integer :: m = of_journal, on = of_journal
      real(wp), allocatable :: over_positions(:, :, :), over_rates(:, :, :)
      !> Of parts with several bristles: these are `known` + `follow` times the rates of the part's rotations; what they
      !> do to its accelerations.
      real(wp), allocatable :: known(:, :), follow(:, :, :), over_bristle(:, :, :)
   end type element_rows_type

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
      !> Where all displacements stand among the states, and their rates.
      integer, allocatable :: position_at(:), rate_at(:)
      !> Of the displacements those of the rotor, and of these the first, on which elements act.
      integer :: rotor = 0, journals = 0
      type(element_rows_type), allocatable :: elements(:)
      type(condensed_rotor_type) :: condensed
      !> Speed where it was linearised last, rad/s.
      real(wp) :: speed = 0
      !> The system on the rates of the rotor's first displacements and of those of the elements.
      type(bordered_matrix) :: matrix
   contains
      procedure :: linearize
      procedure :: solve
      procedure :: jacobian
   end type newton_system_type

   !> A change of the speed, over the speed, that leaves the condensed rotor as it is: gyroscopic moments that are off
   !> by so little slow the convergence by no more.
   real(wp), parameter :: same_speed = 1e-3_wp
   !> Displacements that a pad on a flexible pivot knows.
   integer, parameter :: usual = 4

contains

   !> The systems of this layout, in which this number of pairs of the rotor's displacements has elements.
   type(newton_system_type) function new_newton_system(layout, pairs) result(system)
      type(state_layout_type), intent(in) :: layout
      integer, intent(in) :: pairs
      integer :: e
      system%layout = layout
      system%position_at = layout%positions()
      system%rate_at = layout%rates()
      system%rotor = layout%rotor/2
      system%journals = of_journal*pairs
      allocate (system%elements(size(layout%elements)))
      do e = 1, size(layout%elements)
         associate (of => system%elements(e), from => layout%elements(e))
            of%on = from%of_rotor
            of%m = of%on + from%coordinates
            allocate (of%over_positions(of%m, of%m, from%parts), of%over_rates(of%m, of%m, from%parts), source=0.0_wp)
            associate (n => from%rotations, parts => from%parts)
               if (n > 1) allocate (of%known(n, parts), of%follow(n, n, parts), &
                  & of%over_bristle(from%coordinates, n, parts))
            end associate
         end associate
      end do
      system%matrix = new_bordered_matrix(pairs, [(layout%elements(e)%pair(), e=1, size(layout%elements))], &
         & layout%elements%coordinates, layout%elements%parts, layout%elements%slopes(of_journal)/of_journal)
   end function new_newton_system

   !> Takes the derivatives of elements, which have them, at a speed, rad/s.
   pure subroutine linearize(self, rotor, elements, speed)
      class(newton_system_type), intent(inout) :: self
      class(rotor_type), intent(in) :: rotor
      type(element_pointer), intent(in) :: elements(:)
      real(wp), intent(in) :: speed
      integer :: e, i
      self%speed = speed
      do e = 1, size(elements)
         associate (of => self%elements(e))
            do i = 1, size(of%over_rates, 3)
               call elements(e)%to%part_derivatives(i, of%m, .true., of%over_positions(:, :, i), of%over_rates(:, :, i))
               of%over_positions(:of%on, :, i) = rotor%newton_rows(of%over_positions(:of%on, :, i))
               of%over_rates(:of%on, :, i) = rotor%newton_rows(of%over_rates(:of%on, :, i))
            end do
         end associate
      end do
   end subroutine linearize

   !> b := (1 - gamma J)^(-1) b. Displacements follow from their rates u, x = b_x + gamma u, and so do bristles; u alone
   !> is solved for.
   subroutine solve(self, rotor, elements, gamma, b, ok)
      class(newton_system_type), intent(inout) :: self
      class(rotor_type), intent(in) :: rotor
      type(element_pointer), intent(in) :: elements(:)
      real(wp), intent(in) :: gamma
      real(wp), intent(inout) :: b(:)
      logical, intent(out) :: ok
      real(wp) :: x(size(self%rate_at)), u(size(self%rate_at)), bristle(2, self%layout%pads)
      integer :: e, i, n
      x = b(self%position_at)
      u = b(self%rate_at)
      call rotor%newton_right(gamma, self%speed, x(:self%rotor), u(:self%rotor))
      self%matrix%corner = 0
      do e = 1, size(elements)
         associate (of => self%layout%elements(e))
            if (of%of_rotor > of_journal) self%matrix%groups(e)%corner = 0
            do i = 1, of%parts
               n = min(of%first_pad + i - 1, size(bristle, 2))
               if (of%bristles .and. of%rotations > 1) then
                  bristle(:, n) = 0
                  call put_part(self, e, elements(e)%to, i, gamma, x, bristle(:, n), u)
                  call put_bristles(self, e, elements(e)%to, i, gamma, b, u)
                  cycle
               end if
               if (of%bristles) bristle(:, n) = bristle_of(elements(e)%to%bristle_slopes(i), gamma, b(of%bristle(i)))
               call put_part(self, e, elements(e)%to, i, gamma, x, bristle(:, n), u)
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
      do e = 1, size(elements)
         associate (of => self%layout%elements(e))
            if (.not. of%bristles) cycle
            do i = 1, of%pads
               n = of%first_pad + i - 1
               if (of%rotations > 1) then
                  associate (z => of%bristle(i), r => of%rotations, rows => self%elements(e))
                     b(z:z + r - 1) = rows%known(:, i) + matmul(rows%follow(:, :, i), &
                        & u(of%first_position(i) - 1 + of%rotation(:r)))
                  end associate
                  cycle
               end if
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
      real(wp) :: a(self%rotor, self%rotor)
      a = rotor%newton_matrix(gamma, self%speed)
      associate (n => self%journals, inner => self%rotor - self%journals, of => self%condensed)
         of%inverse = identity(inner)
         call solve_equations(inner, inner, a(n + 1:, n + 1:), of%inverse, ok)
         if (.not. ok) return
         of%follow = matmul(of%inverse, a(n + 1:, :n))
         of%onto = matmul(a(:n, n + 1:), of%inverse)
         self%matrix%border = a(:n, :n) - matmul(a(:n, n + 1:), of%follow)
         of%gamma = gamma
         of%speed = self%speed
      end associate
   end subroutine condense

   !> The deflection of a part's bristles in Newton's system, bristle(1) + bristle(2) times the rate of its first
   !> displacement, from the derivatives of their rate and their right-hand side.
   pure function bristle_of(slopes, gamma, b) result(bristle)
      real(wp), intent(in) :: slopes(3), gamma, b
      real(wp) :: bristle(2)
      bristle = [b, gamma*slopes(1)*slopes(3)]/(1 - gamma*slopes(2))
   end function bristle_of

   !> Puts the derivatives of a part of element e into the matrix on the rates, and what is known of displacements and
   !> bristles into its right-hand side u.
   subroutine put_part(self, e, element, part, gamma, x, bristle, u)
      class(newton_system_type), intent(inout) :: self
      integer, intent(in) :: e, part
      class(element_type), intent(in) :: element
      real(wp), intent(in) :: gamma, x(:), bristle(2)
      real(wp), intent(inout) :: u(:)
      associate (rows => self%elements(e), group => self%matrix%groups(e), corner => self%matrix%corner, &
         & own => self%layout%elements(e)%first_position(part), y => self%layout%elements(e)%journal(1))
         ! a size that the compiler knows is faster
         if (rows%on > of_journal) then
            call put_inclined(rows%over_positions(:, :, part), rows%over_rates(:, :, part), group%across(:, :, part), &
               & group%down(:, :, part), group%block(:, :, part), group%corner)
         else if (rows%m == usual) then
            call put(usual, rows%over_positions(:, :, part), rows%over_rates(:, :, part), own, y, &
               & group%across(:, :, part), group%down(:, :, part), group%block(:, :, part), corner(:, :, group%pair))
         else
            call put(rows%m, rows%over_positions(:, :, part), rows%over_rates(:, :, part), own, y, &
               & group%across(:, :, part), group%down(:, :, part), group%block(:, :, part), corner(:, :, group%pair))
         end if
      end associate

   contains

      !> The same with m displacements, of which those of the part itself begin at `own`, and those of the pair at y.
      subroutine put(m, linear, linear_rates, own, y, across, down, block, corner)
         integer, value :: m, own, y
         real(wp), intent(in) :: linear(m, m), linear_rates(m, m)
         real(wp), intent(out) :: across(of_journal, m - of_journal), down(m - of_journal, of_journal), &
            & block(m - of_journal, m - of_journal)
         real(wp), intent(inout) :: corner(of_journal, of_journal)
         real(wp) :: over_positions(m, m), over_rates(m, m), over_bristle(m - of_journal), known(m), of_part(m)
         integer :: k
         over_positions = linear
         over_rates = linear_rates
         call element%add_late(part, m, .true., over_positions, over_rates, over_bristle)
         of_part(:of_journal) = x(y:y + of_journal - 1)
         of_part(of_journal + 1:) = x(own:own + m - of_journal - 1)
         known = 0
         do k = 1, m
            known = known + over_positions(:, k)*of_part(k)
            over_rates(:, k) = over_rates(:, k) + gamma*over_positions(:, k)
         end do
         if (self%layout%elements(e)%bristles) then
            known(of_journal + 1:) = known(of_journal + 1:) + over_bristle*bristle(1)
            over_rates(of_journal + 1:, of_journal + 1) = over_rates(of_journal + 1:, of_journal + 1) &
               & + over_bristle*bristle(2)
         end if
         u(y:y + of_journal - 1) = u(y:y + of_journal - 1) + gamma*known(:of_journal)
         u(own:own + m - of_journal - 1) = u(own:own + m - of_journal - 1) + gamma*known(of_journal + 1:)
         corner = corner + over_rates(:of_journal, :of_journal)
         down = over_rates(of_journal + 1:, :of_journal)
         across = over_rates(:of_journal, of_journal + 1:)
         block = over_rates(of_journal + 1:, of_journal + 1:)
      end subroutine put

      !> The same where the part knows slopes of the journal, too.
      subroutine put_inclined(linear, linear_rates, across, down, block, corner)
         real(wp), intent(in) :: linear(:, :), linear_rates(:, :)
         real(wp), intent(out) :: across(:, :), down(:, :), block(:, :)
         real(wp), intent(inout) :: corner(:, :)
         real(wp), dimension(size(linear, 1), size(linear, 1)) :: over_positions, over_rates
         real(wp) :: over_bristle(size(linear, 1) - of_journal), known(size(linear, 1))
         over_positions = linear
         over_rates = linear_rates
         call element%add_late(part, size(known), .true., over_positions, over_rates, over_bristle)
         associate (layout => self%layout%elements(e), on => self%layout%elements(e)%of_rotor, &
            & at => self%layout%elements(e)%positions_of(part))
            known = matmul(over_positions, x(at))
            over_rates = over_rates + gamma*over_positions
            if (layout%bristles) then
               known(of_journal + 1:) = known(of_journal + 1:) + over_bristle*bristle(1)
               over_rates(of_journal + 1:, on + 1) = over_rates(of_journal + 1:, on + 1) + over_bristle*bristle(2)
            end if
            u(at) = u(at) + gamma*known
            corner = corner + over_rates(:on, :on)
            down = over_rates(on + 1:, :on)
            across = over_rates(:on, on + 1:)
            block = over_rates(on + 1:, on + 1:)
         end associate
      end subroutine put_inclined
   end subroutine put_part

   !> Puts the bristles of a part with several into the matrix on the rates, where its derivatives already are.
   subroutine put_bristles(self, e, element, part, gamma, b, u)
      class(newton_system_type), intent(inout) :: self
      integer, intent(in) :: e, part
      class(element_type), intent(in) :: element
      real(wp), intent(in) :: gamma, b(:)
      real(wp), intent(inout) :: u(:)
      real(wp) :: of_bristle
      associate (rows => self%elements(e), block => self%matrix%groups(e)%block(:, :, part), &
         & of => self%layout%elements(e))
         associate (own => of%first_position(part), z => of%bristle(part), at => of%rotation(:of%rotations), &
            & known => rows%known(:, part), follow => rows%follow(:, :, part), over => rows%over_bristle(:, :, part))
            call element%find_bristles(part, rows%m, .true., over, follow, of_bristle)
            known = b(z:z + of%rotations - 1)/(1 - gamma*of_bristle)
            follow = follow*gamma/(1 - gamma*of_bristle)
            u(own:own + of%coordinates - 1) = u(own:own + of%coordinates - 1) + gamma*matmul(over, known)
            block(:, at) = block(:, at) + matmul(over, follow)
         end associate
      end associate
   end subroutine put_bristles

   !> The whole Jacobian J.
   function jacobian(self, rotor, elements) result(matrix)
      class(newton_system_type), intent(in) :: self
      class(rotor_type), intent(in) :: rotor
      type(element_pointer), intent(in) :: elements(:)
      real(wp), allocatable, dimension(:, :) :: matrix, over_positions, over_rates
      integer :: e, i
      allocate (matrix(self%layout%n, self%layout%n), source=0.0_wp)
      allocate (over_positions(self%rotor, self%rotor), over_rates(self%rotor, self%rotor))
      call rotor%force_derivatives(self%speed, over_positions, over_rates)
      associate (n => self%rotor)
         do i = 1, n
            matrix(i, n + i) = 1
            matrix(n + 1:2*n, i) = rotor%accelerations(over_positions(:, i))
            matrix(n + 1:2*n, n + i) = rotor%accelerations(over_rates(:, i))
         end do
      end associate
      do e = 1, size(elements)
         do i = 1, self%layout%elements(e)%parts
            call add_part(self, rotor, e, elements(e)%to, i, matrix)
         end do
      end do
   end function jacobian

   !> Adds what a part of element e adds to the Jacobian.
   subroutine add_part(self, rotor, e, element, part, matrix)
      class(newton_system_type), intent(in) :: self
      class(rotor_type), intent(in) :: rotor
      integer, intent(in) :: e, part
      class(element_type), intent(in) :: element
      real(wp), intent(inout) :: matrix(:, :)
      real(wp), dimension(self%elements(e)%m, self%elements(e)%m) :: over_positions, over_rates
      real(wp) :: over_bristle(self%elements(e)%m - of_journal), slopes(3), of_bristle
      real(wp) :: over_bristles(self%layout%elements(e)%coordinates, self%layout%elements(e)%rotations)
      real(wp), dimension(self%layout%elements(e)%rotations, self%layout%elements(e)%rotations) :: of_rates
      integer :: i, at(self%elements(e)%m)
      over_positions = self%elements(e)%over_positions(:, :, part)
      over_rates = self%elements(e)%over_rates(:, :, part)
      call element%add_late(part, self%elements(e)%m, .true., over_positions, over_rates, over_bristle)
      associate (layout => self%layout%elements(e), own => self%elements(e)%on + 1)
         at = layout%positions_of(part)
         associate (u => self%rate_at(at), x => self%position_at(at), of_rotor => self%rate_at(:self%rotor), &
            & pair => layout%pair())
            do i = own, size(at)
               matrix(x(i), u(i)) = 1
            end do
            matrix(of_rotor, x) = matrix(of_rotor, x) + rotor%row_accelerations(over_positions(:of_journal, :), pair)
            matrix(of_rotor, u) = matrix(of_rotor, u) + rotor%row_accelerations(over_rates(:of_journal, :), pair)
            if (own > of_journal + 1) then
               associate (slopes => layout%slopes(of_journal)/of_journal, rows => [of_journal + 1, own - 1])
                  matrix(of_rotor, x) = matrix(of_rotor, x) + rotor%row_accelerations(over_positions(rows, :), slopes)
                  matrix(of_rotor, u) = matrix(of_rotor, u) + rotor%row_accelerations(over_rates(rows, :), slopes)
               end associate
            end if
            matrix(u(own:), x) = matrix(u(own:), x) + over_positions(own:, :)
            matrix(u(own:), u) = matrix(u(own:), u) + over_rates(own:, :)
            if (layout%bristles .and. layout%rotations > 1) then
               call element%find_bristles(part, self%elements(e)%m, .true., over_bristles, of_rates, of_bristle)
               associate (z => layout%bristle(part) - 1, r => layout%rotations)
                  matrix(u(own:), z + 1:z + r) = over_bristles
                  matrix(z + 1:z + r, u(own - 1 + layout%rotation(:r))) = of_rates
                  do i = 1, r
                     matrix(z + i, z + i) = of_bristle
                  end do
               end associate
            else if (layout%bristles) then
               slopes = element%bristle_slopes(part)
               associate (z => layout%bristle(part))
                  matrix(u(own:), z) = over_bristle(own - of_journal:)
                  matrix(z, u(own)) = slopes(1)*slopes(3)
                  matrix(z, z) = slopes(2)
               end associate
            end if
         end associate
      end associate
   end subroutine add_part
end module newton_system
