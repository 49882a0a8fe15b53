!> Checks of the input of branches, of curves of bifurcation points and of limit cycles at a threshold speed: what no
!> single value can tell.
module branch_checks
   use errors, only: error_type, require
   use case_groups, only: is_set
   use case_inputs, only: case_type
   implicit none (type, external)
   private
   public :: check_branch, check_threshold_cycles

contains

   !> A branch needs a parameter; `case_parameter` checks what it, its last value and its step mean.
   subroutine check_branch(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      if (inputs%about%task /= 'branch') return
      associate (b => inputs%branch)
         call require(b%parameter /= '', 'branch%parameter = '''': must name a number of the input, such as ' &
            & //'''operation%speed_rpm''', error)
         if (is_set(b%step) .and. b%max_step > 0) call require(b%max_step >= abs(b%step), 'branch%max_step = {}: ' &
            & //'must be 0 or at least the size of branch%step = {}', [b%max_step, b%step], error)
         call check_curve()
         if (inputs%followed() == 'limit_cycle') call check_free('limit cycles')
         if (b%point == 'hopf') call check_free('Hopf points')
         call require(b%point /= 'fold' .or. inputs%thermal%model /= 'film' .or. inputs%followed() /= 'equilibrium', &
            & 'branch%point = ''fold'': is not followed with temperatures along and across films, whose folds are ' &
            & //'sharp; thermal%model = ''pad'' has such curves, and a study of branches over '//b%parameter &
            & //' has the folds of this model at values of '//b%second_parameter, error)
         call require(b%switch .or. b%of == 'periodic' .or. b%of == 'limit_cycle', &
            & 'branch%switch = .false.: has no effect on a branch of equilibria and on a curve', error)
      end associate
   contains

      !> A curve has a kind of points and two parameters, and nothing else has them.
      subroutine check_curve()
         associate (b => inputs%branch)
            if (b%of == 'curve') then
               call require(b%point /= '', 'branch%of = ''curve'': needs branch%point, one of ''hopf'', ''fold'', ' &
                  & //'''period_doubling'', ''neimark_sacker'', ''cycle_fold''', error)
               call require(b%second_parameter /= '', 'branch%of = ''curve'': needs branch%second_parameter, another ' &
                  & //'number of the input, such as ''rotor%mass''', error)
               call require(inputs%is_driven() .or. all(b%point /= ['period_doubling', 'neimark_sacker ']), &
                  & 'branch%point = '''//b%point//''': needs an unbalance, about whose orbits it is ' &
                  & //'(rotor%unbalance); without one ''hopf'' has the points where vibrations begin', error)
            else
               call require(b%point == '', 'branch%point = '''//b%point//''': has no effect on branch%of = '''//b%of &
                  & //'''; branch%of = ''curve'' follows such points over two numbers', error)
               call require(b%second_parameter == '' .and. .not. is_set(b%second_last), 'branch%second_parameter, ' &
                  & //'branch%second_last: have no effect on branch%of = '''//b%of//'''', error)
            end if
         end associate
      end subroutine check_curve

      !> Vibrations that nothing drives begin where pivots at rest have stiffness or none.
      subroutine check_free(what)
         character(len=*), intent(in) :: what
         character(len=:), allocatable :: given
         given = 'branch%of = ''limit_cycle'''
         if (inputs%branch%of == 'curve') given = 'branch%point = '''//inputs%branch%point//''''
         call require(.not. inputs%unbalance() > 0, given//': must be without unbalance ({} kg m; rotor%unbalance = ' &
            & //'0), which would drive the motion; '//what//' are those of a motion that nothing drives', &
            & [inputs%unbalance()], error)
         call require(.not. inputs%is_driven(), given//': must be without groups &bow and disc%skew, which would ' &
            & //'drive the motion', error)
         call check_pivots(inputs, given, error)
      end subroutine check_free
   end subroutine check_branch

   !> The limit cycles at a threshold speed need one that is sought.
   subroutine check_threshold_cycles(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      if (.not. inputs%coefficients%threshold_born) return
      call require(inputs%coefficients%threshold_up_to_rpm > 0, 'coefficients%threshold_born = .true.: needs ' &
         & //'coefficients%threshold_up_to_rpm, the speed in rpm up to which thresholds and their cycles are sought', &
         & error)
      call require(.not. abs(inputs%coefficients%cross_stiffness) > 0, 'coefficients%threshold_born = .true.: not ' &
         & //'with coefficients%cross_stiffness = {}, which acts on small vibrations alone; a group &element with ' &
         & //'cross_stiffness acts on the motion of a machine', [inputs%coefficients%cross_stiffness], error)
      call check_pivots(inputs, 'coefficients%threshold_born', error)
   end subroutine check_threshold_cycles

   !> Pivots at rest have stiffness or none where free vibrations begin; `given` asks for these.
   subroutine check_pivots(inputs, given, error)
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: given
      type(error_type), allocatable, intent(inout) :: error
      integer :: b
      do b = 1, size(inputs%bearings)
         associate (model => inputs%bearings(b)%friction%model)
            call require(model /= 'bengisu_akay', inputs%bearings(b)%label(': ')//'friction%model = '''//model &
               & //''': must be ''none'' or ''lugre'' with '//given//', as pivots at rest hold with no stiffness ' &
               & //'there', error)
         end associate
      end do
   end subroutine check_pivots
end module branch_checks
