!> The steady motion of a bearing whose equations are linearised in equilibrium, under its unbalance and without
!> friction: near the periodic orbit, and free of a march.
module unbalance_response
   use kinds, only: wp, pi
   use lapack, only: zgesv
   use operating_point, only: operating_point_type
   use equations_of_motion, only: bearing_model
   implicit none (type, external)
   private
   public :: go_to_response

   !> A state that its mean rates move by less than this, over the scales, is in equilibrium.
   real(wp), parameter :: still = 1e-3_wp
   !> Largest amplitude of a displacement, over its scale: of a longer response only a part is taken.
   real(wp), parameter :: largest = 0.3_wp

contains

   !> Puts a state in equilibrium into this motion, at t = 0; others stay.
   subroutine go_to_response(model, y)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      type(operating_point_type) :: point, free
      complex(wp) :: matrix(model%n, model%n), response(model%n, 2)
      real(wp) :: rates(model%n, 0:2), jacobian(model%n, model%n), speed, longest
      integer :: pivots(model%n), info, i
      logical :: ok
      point = model%point
      speed = point%speed(0.0_wp)
      free = point
      free%friction = .false.
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
      longest = maxval(abs(response(model%layout%positions(), 2)))
      y = y + model%scale*response(:, 2)%re*largest/max(largest, longest)
   end subroutine go_to_response
end module unbalance_response
