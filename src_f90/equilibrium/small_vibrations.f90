!> Small vibrations about a state in equilibrium: the eigenvalues of the motion linearised there, and what they say of
!> it.
module small_vibrations
   use kinds, only: wp
   use eigenvalues, only: find_eigenvalues
   use lapack, only: dgesv
   use equations_of_motion, only: bearing_model
   use force_balance, only: force_derivatives, masses
   implicit none (type, external)
   private
   public :: stability_type, stability_at, stability_of, find_vibrations

   !> How a state in equilibrium answers a small disturbance.
   type :: stability_type
      !> The eigenvalue of largest real part, 1/s; of a pair the one with positive imaginary part.
      complex(wp) :: eigenvalue = 0
      !> 'stable'; 'oscillatory instability': vibrations grow; 'static instability': it is left without vibration, and
      !> no motion dwells there.
      character(len=:), allocatable :: name
   end type stability_type

   !> Growth in a radian of the shaft that counts as none: films without any stiffness leave eigenvalues of rounding.
   real(wp), parameter :: no_growth = 1e-6_wp

contains

   !> The stability of a model in equilibrium in the state y.
   subroutine stability_at(model, y, stability, ok)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      type(stability_type), intent(out) :: stability
      !> False where the films have no derivatives or the eigenvalues are not found.
      logical, intent(out) :: ok
      complex(wp) :: values(2*model%layout%n_positions())
      real(wp), dimension(model%layout%n_positions(), model%layout%n_positions()) :: stiffness, damping
      call model%evaluate(0.0_wp, y, .true., ok)
      if (.not. ok) return
      call force_derivatives(model, stiffness, damping)
      call find_vibrations(masses(model), stiffness, damping, values, ok)
      if (ok) stability = stability_of(values, no_growth*model%point%speed(0.0_wp))
   end subroutine stability_at

   !> What eigenvalues, 1/s, say, with a growth, 1/s, that counts as none.
   pure type(stability_type) function stability_of(values, no_growth) result(stability)
      complex(wp), intent(in) :: values(:)
      real(wp), intent(in) :: no_growth
      stability%eigenvalue = values(maxloc(values%re, dim=1))
      stability%eigenvalue%im = abs(stability%eigenvalue%im)
      if (any(values%re > no_growth .and. abs(values%im) <= 0)) then
         stability%name = 'static instability'
      else if (stability%eigenvalue%re > no_growth) then
         stability%name = 'oscillatory instability'
      else
         stability%name = 'stable'
      end if
   end function stability_of

   !> Eigenvalues of M x'' = C x' + K x, with the derivatives of the forces over positions, K, and over rates, C.
   subroutine find_vibrations(mass, stiffness, damping, values, ok, shapes)
      real(wp), intent(in) :: mass(:, :), stiffness(:, :), damping(:, :)
      complex(wp), intent(out) :: values(2*size(mass, 1))
      logical, intent(out) :: ok
      !> The positions in the vibration of each eigenvalue, (position, eigenvalue), of any size and phase.
      complex(wp), intent(out), optional :: shapes(:, :)
      real(wp) :: matrix(2*size(mass, 1), 2*size(mass, 1)), per_mass(size(mass, 1), 2*size(mass, 1))
      real(wp) :: factors(size(mass, 1), size(mass, 1))
      complex(wp), allocatable :: vectors(:, :)
      integer :: pivots(size(mass, 1)), info, i
      associate (n => size(mass, 1))
         per_mass(:, :n) = stiffness
         per_mass(:, n + 1:) = damping
         factors = mass
         call dgesv(n, 2*n, factors, n, pivots, per_mass, n, info)
         ok = info == 0
         if (.not. ok) return
         matrix = 0
         do i = 1, n
            matrix(i, n + i) = 1
         end do
         matrix(n + 1:, :) = per_mass
         if (present(shapes)) allocate (vectors(2*n, 2*n))
         call find_eigenvalues(matrix, values, ok, vectors)
         if (present(shapes) .and. ok) shapes = vectors(:n, :)
      end associate
   end subroutine find_vibrations
end module small_vibrations
