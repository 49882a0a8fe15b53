!> The namelist groups of what is calculated: task, speeds, start, integration, results and analyses (case_groups has
!> those of the bearing and of the rotor).
module task_groups
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: unset, is_set, about_type, operation_type, thermal_type, start_type, held_type, integration_type, &
      & output_type, coefficients_type, periodic_type, branch_type

   !> A number that is not set: what it stands for follows from others, or there is none of it.
   real(wp), parameter :: unset = -huge(1.0_wp)

   type :: about_type
      character(len=:), allocatable :: title, task
      !> What a case of another bearing than the paper's leaves to this, with values; no variable of the input.
      character(len=:), allocatable :: of_paper
   end type about_type

   type :: operation_type
      !> Speed at the start and at the end (linear in between; set in a complete case), and how long, s.
      real(wp) :: speed_rpm = 6500, final_speed_rpm = unset, duration = 2
      character(len=:), allocatable :: rotation
   end type operation_type

   !> The heat balance.
   type :: thermal_type
      character(len=:), allocatable :: model, march
      !> Stations along the arc, and layers across the film, of its temperatures.
      integer :: stations = 40, layers = 12
   end type thermal_type

   type :: start_type
      character(len=:), allocatable :: from
      !> The result that a start from a file continues.
      character(len=:), allocatable :: file
      !> What is added: journal, m, m/s; per pad tilt, rad, pivot deflection, m, pitch and yaw, rad, and their rates.
      real(wp) :: journal(2) = 0, journal_velocity(2) = 0
      real(wp), allocatable :: pad_tilt(:), pad_tilt_rate(:), pivot_deflection(:), pivot_deflection_rate(:), &
         & pad_pitch(:), pad_pitch_rate(:), pad_yaw(:), pad_yaw_rate(:)
   end type start_type

   !> Where the journal is held: at an eccentricity over the bearing clearance, and an attitude from the load (unset:
   !> where the load keeps its direction), or at a position, m. Unset: it is not held.
   type :: held_type
      real(wp) :: eccentricity_ratio = unset, attitude_deg = unset, position(2) = unset
   contains
      procedure :: is_wanted
   end type held_type

   type :: integration_type
      real(wp) :: relative_tolerance = 1e-5_wp, tolerance_scale = 1
      !> 0: no limit.
      real(wp) :: max_step = 0
      integer :: max_steps = 100000000
      !> > 0: the march ends once journal and tilts repeat within this part of the clearance.
      real(wp) :: stop_when_periodic = 0
   end type integration_type

   type :: output_type
      integer :: samples_per_revolution = 360
      real(wp) :: start_time = 0
      !> Revolutions at the end of the run that the spectra are taken over.
      integer :: spectrum_revolutions = 50
      !> Wall time between checkpoints, s; 0: only when a signal asks for the end.
      real(wp) :: checkpoint_seconds = 300
      !> Which samples stay in the results.
      character(len=:), allocatable :: keep
   end type output_type

   type :: coefficients_type
      !> Whirl frequencies over the speed of the shaft.
      real(wp), allocatable :: frequency_ratio(:)
      !> > 0: up to where the threshold speed of stability is sought.
      real(wp) :: threshold_up_to_rpm = 0
      !> Whether the limit cycles are followed that begin there.
      logical :: threshold_born = .false.
      !> Whether also those against the slopes of the journal are asked for.
      logical :: slopes = .false.
      !> Q at the journal, N/m: what whirls forward is driven by Q times its displacement, across it.
      real(wp) :: cross_stiffness = 0
   end type coefficients_type

   type :: periodic_type
      !> Turns of the shaft in a period.
      integer :: revolutions = 1
      !> How far from the orbit Newton's method may end, over the characteristic scale of each state; most rounds.
      real(wp) :: tolerance = 1e-8_wp
      integer :: max_iterations = 30
   end type periodic_type

   type :: branch_type
      character(len=:), allocatable :: of, parameter
      !> Its value at the end; its first change; its largest change in a step, 0: ten times the first. Unset where they
      !> are left out.
      real(wp) :: last = unset, step = unset, max_step = 0
      !> Of a curve: what its points are, the other number, and its value at the end, unset where it is left out.
      character(len=:), allocatable :: point, second_parameter
      real(wp) :: second_last = unset
      !> Most points of a branch.
      integer :: max_points = 500
      !> Whether the branch of double period is followed where one begins.
      logical :: switch = .true.
   contains
      procedure :: speeds
   end type branch_type

contains

   !> False for a number that is left out.
   elemental logical function is_set(x)
      real(wp), intent(in) :: x
      is_set = x > unset
   end function is_set

   !> Whether the journal is held.
   elemental logical function is_wanted(self)
      class(held_type), intent(in) :: self
      is_wanted = is_set(max(self%eccentricity_ratio, self%attitude_deg, maxval(self%position)))
   end function is_wanted

   !> Last values of the speed, rpm, if a branch is over it.
   pure function speeds(self)
      class(branch_type), intent(in) :: self
      real(wp), allocatable :: speeds(:)
      speeds = [real(wp) ::]
      if (self%parameter == 'operation%speed_rpm' .and. is_set(self%last)) speeds = [self%last]
      if (self%second_parameter == 'operation%speed_rpm' .and. is_set(self%second_last)) speeds = [self%second_last]
   end function speeds
end module task_groups
