!> A film by powers of small slopes, from its volumes without them (docs/theory/pitch_and_yaw.md, *Tables of small
!> slopes*).
!>
!> With h = h0 (1 - x), x = z gamma.n/h0, the equations A p = b of volumes have conductances times (1 - x)^3, that is
!> A = A0 + A1 + A2 + A3 by powers of gamma, and at constant w sources b = b0 + b1, b1 linear in v. With s = (gamma, v),
!> A0 p1 = b1 - A1 p0, the adjoint a of a force and that of a moment, q, and its change A0 q1 = -A1 q, force and moment
!> change by
!>    second order:   -a (A1 p1 + A2 p0),
!>    third order:    -q1 (A1 p1 + A2 p0) - q (A2 p1 + A3 p0),
!> which are sums over the faces of volumes.
module slope_expansion
   use kinds, only: wp
   use sloped_gap, only: sloped_response
   use sloped_volumes, only: sloped_volumes_type, end_between, solve, flow_into
   implicit none (type, external)
   private
   public :: of_force, of_moment, of_pressure, coefficients, expand

   !> Coefficients of each component of force, of gamma s, and of moment, of s and gamma gamma s; all of them; what
   !> tells the highest pressure: its angle, how the pressure bends across the width there, its slope by s, and how it
   !> changes in the middle by gamma s.
   integer, parameter :: of_force = 8, of_moment = 16, coefficients = 2*(of_force + of_moment), of_pressure = 14
   !> Changes on volumes: p1 of each component of s, a of each component of the force and of the pressure where it is
   !> highest, and of each component of the moment q, and q1 of each component of gamma.
   integer, parameter :: p1(4) = [1, 2, 3, 4], a(3) = [5, 6, 7], q(2) = [8, 9], &
      & q1(2, 2) = reshape([10, 11, 12, 13], [2, 2]), changes = 13

contains

   !> The coefficients of the film on volumes with oil of one viscosity, without slopes, and with a condition of
   !> cavitation that has been solved on them: of both components of force, and of moment, over half the width; in place
   !> of gamma and v with gamma half the width over the mean thickness, and v half the width, both over `room`; over the
   !> power -3 of the mean thickness and 4 of `room`.
   pure subroutine expand(volumes, condition, mean, room, known, loads, pressures)
      type(sloped_volumes_type), intent(inout) :: volumes
      integer, intent(in) :: condition
      !> Mean thickness over the clearance; what is left of the film, 1 - T.
      real(wp), intent(in) :: mean, room
      !> The same film as it is known better, with its derivatives: the first order of the moment is theirs.
      type(sloped_response), intent(in) :: known
      real(wp), intent(out) :: loads(coefficients), pressures(of_pressure)
      real(wp) :: d(0:volumes%rows + 1, 0:volumes%columns + 1, changes), unit(4), force(of_force, 3), &
         & moment(of_moment, 2), weights(2)
      integer :: column, k
      associate (half => 0.5_wp*volumes%gap%axial_length)
         unit = [spread(mean*volumes%gap%machined_clearance, 1, 2), 1.0_wp, 1.0_wp]*(room/half)
         call end_between(volumes, condition)
         call find_highest_column(volumes, known%place(1), column, weights)
         call find_changes(volumes, unit, column, weights, d)
         call sum_over_faces(volumes, unit(1), d, force, moment)
         moment = moment/half
         do k = 1, 2
            moment(:4, k) = known%derivatives(2 + k, [3, 4, 7, 8])*unit/half
         end do
      end associate
      loads = mean**3/room**4*[force(:, :2), moment]
      pressures = [known%place(1), mean**3/room**4*[pressures_of(volumes, column, weights, d), force(:, 3)]]
   end subroutine expand

   !> The changes, in units of s, (row, column, change), 0 around.
   pure subroutine find_changes(volumes, unit, column, weights, d)
      type(sloped_volumes_type), intent(in) :: volumes
      real(wp), intent(in) :: unit(4), weights(2)
      !> Where the pressure is highest (find_highest_column).
      integer, intent(in) :: column
      real(wp), intent(out) :: d(0:, 0:, :)
      real(wp), dimension(volumes%rows, volumes%columns) :: area, arm
      integer :: i, j, k
      d = 0
      associate (m => volumes%rows, n => volumes%columns, scale => volumes%scale, radius => volumes%radius)
         do k = 1, 2
            do i = 1, n
               area(:, i) = volumes%height*volumes%integral(k, i)
               arm(:, i) = volumes%z(1:m)*area(:, i)
            end do
            d(1:m, 1:n, p1(k)) = unit(k)*solution(volumes, changed_flow(volumes, k, volumes%p))
            d(1:m, 1:n, q(k)) = -radius*solution(volumes, arm)
            d(1:m, 1:n, p1(2 + k)) = -(unit(2 + k)*scale/radius)*d(1:m, 1:n, q(k))
            d(1:m, 1:n, a(k)) = -radius*solution(volumes, area)
            do j = 1, 2
               d(1:m, 1:n, q1(k, j)) = unit(j)*solution(volumes, changed_flow(volumes, j, d(:, :, q(k))))
            end do
         end do
         area = 0
         area(m/2, column:column + 1) = 0.5_wp*weights
         area(m/2 + 1, column:column + 1) = 0.5_wp*weights
         d(1:m, 1:n, a(3)) = solution(volumes, area)
      end associate
   end subroutine find_changes

   !> The solution for a load of all cells, (row, column).
   pure function solution(volumes, load)
      type(sloped_volumes_type), intent(in) :: volumes
      real(wp), intent(in) :: load(:, :)
      real(wp) :: solution(volumes%rows, volumes%columns), b(size(volumes%inverse, 1), volumes%columns)
      b(:volumes%rows, :) = load
      call solve(volumes, b)
      solution = b(:volumes%rows, :)
   end function solution

   !> -A1 p for component k of gamma, (row, column).
   pure function changed_flow(volumes, k, p) result(flow)
      type(sloped_volumes_type), intent(in) :: volumes
      integer, intent(in) :: k
      real(wp), intent(in) :: p(0:, 0:)
      real(wp) :: flow(volumes%rows, volumes%columns), along(volumes%rows, 0:1), across(0:volumes%rows)
      integer :: i, side
      do i = 1, volumes%columns
         do side = 0, 1
            associate (face => i - 1 + side)
               along(:, side) = -volumes%z(1:volumes%rows)*volumes%face(k, face)*volumes%along_turn(:, face) &
                  & *volumes%along(:, face)
            end associate
         end do
         across = -volumes%z_face*volumes%middle(k, i)*volumes%across_turn(:, i)*volumes%across(:, i)
         flow(:, i) = flow_into(p(:, i - 1:i + 1), along, across)
      end do
   end function changed_flow

   !> Coefficients of the force and the pressure where it is highest, and of the third order of the moment, N m.
   pure subroutine sum_over_faces(volumes, unit, d, force, moment)
      type(sloped_volumes_type), intent(in) :: volumes
      real(wp), intent(in) :: unit, d(0:, 0:, :)
      real(wp), intent(out) :: force(of_force, 3), moment(of_moment, 2)
      integer :: i, r
      force = 0
      moment = 0
      associate (m => volumes%rows, n => volumes%columns, p => volumes%p)
         do i = 0, n
            do r = 1, m
               call add(volumes%along(r, i), unit*volumes%z(r)*volumes%along_turn(r, i)/3*volumes%face(:, i), &
                  & p(r, i + 1) - p(r, i), d(r, i + 1, :) - d(r, i, :), force, moment)
            end do
         end do
         do i = 1, n
            do r = 0, m
               call add(volumes%across(r, i), unit*volumes%z_face(r)*volumes%across_turn(r, i)/3*volumes%middle(:, i), &
                  & p(r + 1, i) - p(r, i), d(r + 1, i, :) - d(r, i, :), force, moment)
            end do
         end do
      end associate
   end subroutine sum_over_faces

   !> Adds what a face makes, with its conductance, x by component of gamma, and the differences of p0 and of the
   !> changes across it.
   pure subroutine add(conductance, x, drop, drops, force, moment)
      real(wp), intent(in) :: conductance, x(2), drop, drops(changes)
      real(wp), intent(inout) :: force(of_force, 3), moment(of_moment, 2)
      real(wp) :: first(4), second(4)
      integer :: i, j, k
      do i = 1, 2
         ! -(A1 p1 + A2 p0), and -(A2 p1 + A3 p0) over x_j
         first = 3*conductance*x(i)*drops(p1)
         first(:2) = first(:2) - 3*conductance*x(i)*drop*x
         second = -3*conductance*x(i)*drops(p1)
         second(:2) = second(:2) + conductance*x(i)*drop*x
         do k = 1, 3
            associate (to => force(4*i - 3:4*i, k))
               to = to + drops(a(k))*first
            end associate
         end do
         do k = 1, 2
            do j = 1, 2
               associate (to => moment(4*(i + j) - 3:4*(i + j), k))
                  to = to + drops(q1(k, j))*first + (x(j)*drops(q(k)))*second
               end associate
            end do
         end do
      end do
   end subroutine add

   !> The column from which on an angle lies, and weights of it and the next one there.
   pure subroutine find_highest_column(volumes, angle, column, weights)
      type(sloped_volumes_type), intent(in) :: volumes
      real(wp), intent(in) :: angle
      integer, intent(out) :: column
      real(wp), intent(out) :: weights(2)
      associate (x => volumes%angle, n => volumes%columns)
         column = min(max(1, count(x(1:n) >= angle)), n - 1)
         weights(2) = min(max(0.0_wp, (x(column) - angle)/(x(column) - x(column + 1))), 1.0_wp)
         weights(1) = 1 - weights(2)
      end associate
   end subroutine find_highest_column

   !> How the pressure bends across half the width where it is highest, and its slope by s.
   pure function pressures_of(volumes, column, weights, d) result(found)
      type(sloped_volumes_type), intent(in) :: volumes
      integer, intent(in) :: column
      real(wp), intent(in) :: weights(2), d(0:, 0:, :)
      real(wp) :: found(5)
      associate (half => 0.5_wp*volumes%gap%axial_length, r => volumes%rows/2 + 1, z => volumes%z, &
         & at => [column, column + 1])
         found(1) = 2*half**2*dot_product(weights, volumes%p(r, at) - volumes%p(r + 1, at))/(z(r + 1)**2 - z(r)**2)
         found(2:) = half/(z(r) - z(r - 1))*matmul(weights, d(r, at, p1) - d(r - 1, at, p1))
      end associate
   end function pressures_of
end module slope_expansion
