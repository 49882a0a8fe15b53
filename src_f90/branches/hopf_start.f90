!> Where limit cycles begin: the Hopf point of a branch of equilibria, and the vibration there as a cycle of no size.
module hopf_start
   use kinds, only: wp, pi
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error, stopped
   use linear_algebra, only: find_eigenvalues
   use newton_method, only: branch_point_type, return_to
   use continuation, only: branch_options, start_branch, advance, bifurcation_type, find_bifurcations
   use orbit_polynomials, only: orbit_type, points
   use orbit_problem, only: parametric_ode_type
   use limit_cycle, only: limit_cycle_type, begin_cycles
   use equilibrium_branch, only: equilibrium_problem_type
   implicit none (type, external)
   private
   public :: find_hopf_point, begin_at_hopf_point

   !> Intervals of the first cycle, which is nearly harmonic: the collocation leaves less than 1e-8 of it.
   integer, parameter :: intervals = 24

contains

   !> Follows equilibria, from where a problem stands, to the first Hopf point, at which it stands then. An error where
   !> there is none up to the bound of the parameter, which has this name.
   subroutine find_hopf_point(problem, options, parameter, found, error)
      type(equilibrium_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      character(len=*), intent(in) :: parameter
      type(bifurcation_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      type(branch_point_type) :: here, next
      type(bifurcation_type), allocatable :: special(:)
      real(wp) :: length, first
      logical :: ends
      integer :: k
      first = problem%parameter
      length = options%first_step
      call start_branch(problem, options, options%high > first, here, error)
      call add_context(error, 'the first equilibrium')
      ends = .false.
      do while (.not. (allocated(error) .or. ends))
         call advance(problem, options, here, length, next, ends, error)
         if (.not. allocated(error)) call find_bifurcations(problem, options, here, next, special, error)
         if (allocated(error)) exit
         do k = 1, size(special)
            if (special(k)%kind /= 'hopf') cycle
            found = special(k)
            call return_to(problem, found%point)
            return
         end do
         here = next
      end do
      if (allocated(error)) then
         if (error%status /= stopped) call add_context(error, 'no Hopf point of the equilibria up to '//parameter &
            & //' = '//to_text(here%parameter))
         return
      end if
      associate (leading => here%values(1))
         call raise(error, numerics_error, 'the equilibria have no Hopf point, where limit cycles begin, from ' &
            & //parameter//' = '//to_text(first)//' to '//to_text(here%parameter)//': there the leading eigenvalue ' &
            & //'is '//to_text(leading%re)//' 1/s at '//to_text(abs(leading%im)/(2*pi))//' Hz; try another ' &
            & //'branch%last, or another first value')
      end associate
   end subroutine find_hopf_point

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
