!> What the limit cycles do that begin at a threshold speed: to which side they are born, and how far they reach.
module threshold_cycle
   use kinds, only: wp, i8
   use errors, only: error_type
   use case_groups, only: unset
   use case_inputs, only: case_type
   use case_parameter, only: complete_branch
   use equations_of_motion, only: machine_model, new_machine_model
   use factories, only: march_films
   use film_network, only: warm_films_type
   use newton_method, only: branch_point_type, place_part_type, return_to
   use continuation, only: bifurcation_type
   use orbit_figures, only: orbit_figures_type, find_orbit_figures
   use branch_progress, only: branch_progress_type
   implicit none (type, external)
   private
   public :: threshold_cycle_type, follow_cycles

   type :: threshold_cycle_type
      !> Threshold speed where they begin, that of the first cycle behind it, and the lowest one with a cycle, rpm.
      real(wp) :: threshold = 0, next = 0, lowest = 0
      !> Amplitude along y and z at the lowest speed, the largest of all bearings, m.
      real(wp) :: amplitude(2) = 0
   end type threshold_cycle_type

contains

   !> Those of a static model that is in equilibrium in y, without its unbalance, up to where thresholds are sought;
   !> from an equilibrium before the threshold speed, as `find_thresholds` has it. An error where no Hopf point follows,
   !> or no cycle behind it; one of status `stopped`, too.
   subroutine follow_cycles(fine, y, films, before, found, error)
      type(machine_model), intent(in), target :: fine
      real(wp), intent(in) :: y(:)
      !> Of each bearing, where films have temperatures along and across.
      type(warm_films_type), allocatable, intent(in) :: films(:)
      type(place_part_type), intent(in) :: before(:)
      type(threshold_cycle_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      type(machine_model), target :: moving, static
      type(branch_progress_type), target :: b
      type(bifurcation_type) :: hopf
      type(bifurcation_type), allocatable :: special(:)
      type(case_type) :: inputs
      character(len=:), allocatable :: at_end
      logical :: another
      integer :: k
      inputs = fine%inputs
      inputs%about%task = 'branch'
      inputs%branch%of = 'limit_cycle'
      inputs%branch%parameter = 'operation%speed_rpm'
      inputs%branch%last = inputs%coefficients%threshold_up_to_rpm
      inputs%coefficients%threshold_born = .false.
      inputs%output%keep = 'all'
      inputs%rotor%unbalance = 0
      inputs%rotor%balance_grade = unset
      if (.not. inputs%rotor%is_rigid()) call inputs%rotor%elastic%balance()
      call complete_branch(inputs)
      moving = new_machine_model(inputs, march_films, fine%others, fine%rotor)
      moving%oil = fine%oil
      moving%give_up => fine%give_up
      static = fine
      static%inputs = inputs
      call b%prepare(moving, 0_i8, error)
      b%options%give_up => fine%give_up
      if (.not. allocated(error)) call b%begin_at_hopf(moving, static, y, films, hopf, error, before)
      if (allocated(error)) return
      found%threshold = hopf%point%parameter
      found%lowest = found%threshold
      at_end = ''
      do while (at_end == '')
         call b%take_step(special, another, at_end, error)
         if (allocated(error)) exit
         do k = 1, size(special)
            if (special(k)%kind == 'fold') call note(special(k)%point)
         end do
         if (another) call note(b%here)
      end do
   contains
      !> Takes a point of the branch into account.
      subroutine note(point)
         type(branch_point_type), intent(in) :: point
         type(orbit_figures_type) :: figures
         integer :: i, axis
         if (.not. found%next > 0) found%next = point%parameter
         if (point%parameter >= found%lowest) return
         found%lowest = point%parameter
         call return_to(b%problem, point)
         call find_orbit_figures(moving, b%orbits, moving%inputs%output%samples_per_revolution, figures)
         call return_to(b%problem, b%here)
         associate (journals => figures%bearings%journal)
            found%amplitude = [(maxval([(journals(i)%highest(axis) - journals(i)%lowest(axis), i=1, &
               & size(journals))])/2, axis=1, 2)]
         end associate
      end subroutine note
   end subroutine follow_cycles
end module threshold_cycle
