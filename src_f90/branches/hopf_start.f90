!> Where limit cycles begin: the vibration at a Hopf point of a branch of equilibria as a cycle of no size.
module hopf_start
   use kinds, only: wp, pi
   use errors, only: error_type, raise, numerics_error
   use linear_algebra, only: find_eigenvalues
   use newton_method, only: branch_point_type, return_to
   use orbit_polynomials, only: orbit_type, points
   use orbit_problem, only: parametric_ode_type
   use limit_cycle, only: limit_cycle_type, begin_cycles
   implicit none (type, external)
   private
   public :: begin_at_hopf_point

   !> Intervals of the first cycle, which is nearly harmonic: the collocation leaves less than 1e-8 of it.
   integer, parameter :: intervals = 24

contains

   !> The first point of a branch of cycles: the place of rest y of an ODE at a value of the parameter, over the period
   !> of the vibration of nearly this eigenvalue, 1/s. Its tangent is that vibration.
   subroutine begin_at_hopf_point(problem, ode, y, scale, eigenvalue, parameter, unit, point, error)
      type(limit_cycle_type), intent(inout) :: problem
      class(parametric_ode_type), intent(inout), target :: ode
      real(wp), intent(in) :: y(:), scale(:)
      complex(wp), intent(in) :: eigenvalue
      real(wp), intent(in) :: parameter
      !> Its natural change.
      real(wp), intent(in) :: unit
      type(branch_point_type), intent(out) :: point
      type(error_type), allocatable, intent(out) :: error
      type(orbit_type) :: orbit
      real(wp) :: rates(size(y)), jacobian(size(y), size(y)), period
      complex(wp) :: values(size(y)), vectors(size(y), size(y)), vibration(size(y))
      integer :: k
      logical :: ok
      call ode%set(parameter, error)
      if (allocated(error)) return
      call ode%model%rhs_and_jacobian(0.0_wp, y, rates, jacobian, ok)
      if (ok) call find_eigenvalues(jacobian, values, ok, vectors)
      if (.not. ok) then
         call raise(error, numerics_error, 'the vibration at the Hopf point is not found')
         return
      end if
      vibration = vectors(:, minloc(abs(values - eigenvalue), dim=1))/scale
      period = 2*pi/abs(eigenvalue%im)
      orbit%start = y
      orbit%scale = scale
      call orbit%set_mesh([(period*k/intervals, k=0, intervals)], spread(spread(y, 2, points), 3, intervals))
      call begin_cycles(problem, ode, orbit, parameter, unit)
      associate (weight => problem%weight(:size(y)))
         ! where it is largest in the measure of the branch it is across the motion
         vibration = vibration*exp(-cmplx(0, 0.5_wp, wp)*arg(sum(weight*vibration**2)))
         vibration = vibration/sqrt(sum(weight*vibration%re**2))
      end associate
      point%parameter = parameter
      point%tangent = [vibration%re, 0.0_wp, 0.0_wp]
      allocate (point%change(size(point%tangent)), source=0.0_wp)
      call problem%get_place(point%place)
      call return_to(problem, point, error)
      if (.not. allocated(error)) call problem%spectrum(point%values, point%growth, ok)

   contains

      pure real(wp) function arg(z)
         complex(wp), intent(in) :: z
         arg = atan2(z%im, z%re)
      end function arg
   end subroutine begin_at_hopf_point
end module hopf_start
