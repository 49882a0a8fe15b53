!> What the equations linearised in a state say of an orbit near it: the steady motion under the unbalance, and how
!> short intervals have to be to show the vibrations that last.
module linear_response
   use kinds, only: wp, pi
   use linear_algebra, only: zgesv, find_eigenvalues
   use operating_point, only: operating_point_type
   use equations_of_motion, only: machine_model
   implicit none (type, external)
   private
   public :: go_to_response, longest_interval

   !> A vibration of which more than this part is left after a period is seen by its multiplier; by how much it turns
   !> in an interval of the first mesh, rad, at most. From there on its multiplier says whether that is enough.
   real(wp), parameter :: lasting = 1e-2_wp, turn = 1.5_wp
   !> A state that its mean rates move by less than this, over the scales, is in equilibrium.
   real(wp), parameter :: still = 1e-3_wp
   !> Largest amplitude of a displacement, over its scale: of a longer response only a part is taken.
   real(wp), parameter :: largest = 0.3_wp

contains

   !> Puts a state in equilibrium into the steady motion of the linearised equations under the unbalance, without
   !> friction, at t = 0: it is near the periodic orbit, and free of a march. Other states stay.
   subroutine go_to_response(model, y)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      type(operating_point_type) :: point, free
      complex(wp) :: matrix(model%n, model%n), response(model%n, 2)
      real(wp) :: rates(model%n, 0:2), jacobian(model%n, model%n), speed, amplitude
      integer :: pivots(model%n), info, i
      logical :: ok
      point = model%point
      speed = point%speed(0.0_wp)
      free = point
      free%friction = .false.
      if (allocated(free%excitations)) deallocate (free%excitations)
      call model%set_point(free)
      do i = 2, 0, -1
         call model%rhs_and_jacobian(i*pi/(2*speed), y, rates(:, i), jacobian, ok)
         if (.not. ok) exit
         rates(:, i) = rates(:, i)/(speed*model%scale)
      end do
      call model%set_point(point)
      if (.not. ok) return
      ! the rates are mean + Re(swing exp(i angle))
      response(:, 1) = 0.5_wp*(rates(:, 0) + rates(:, 2))
      response(:, 2) = cmplx(rates(:, 0), -rates(:, 1), wp) - (1.0_wp, -1.0_wp)*response(:, 1)
      do i = 1, model%n
         matrix(:, i) = -jacobian(:, i)*model%scale(i)/(speed*model%scale)
         matrix(i, i) = matrix(i, i) + (0.0_wp, 1.0_wp)
      end do
      call zgesv(model%n, 2, matrix, model%n, pivots, response, model%n, info)
      if (info /= 0 .or. .not. all(abs(response) <= huge(speed))) return
      if (maxval(abs(response(:, 1))) > still) return
      amplitude = maxval(abs(response(model%layout%positions(), 2)))
      y = y + model%scale*response(:, 2)%re*largest/max(largest, amplitude)
   end subroutine go_to_response

   !> The longest interval, s, that shows the vibrations about state y that last longer than a period, s.
   real(wp) function longest_interval(model, y, period) result(longest)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:), period
      real(wp) :: rates(model%n), jacobian(model%n, model%n)
      complex(wp) :: values(model%n)
      logical :: ok
      integer :: i
      longest = period
      call model%rhs_and_jacobian(0.0_wp, y, rates, jacobian, ok)
      if (.not. ok) return
      do i = 1, model%n
         jacobian(:, i) = jacobian(:, i)*model%scale(i)/model%scale
      end do
      call find_eigenvalues(jacobian, values, ok)
      if (.not. ok) return
      longest = turn/max(turn/period, maxval(abs(values), mask=values%re*period > log(lasting)))
   end function longest_interval
end module linear_response
