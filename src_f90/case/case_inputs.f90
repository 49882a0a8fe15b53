!> What a run is about: the values of all namelist groups. A default case is the paper's bearing.
module case_inputs
   use kinds, only: wp, rpm
   use case_groups, only: about_type, rotor_type, operation_type, bearing_type, oil_type, thermal_type, pads_type, &
      & pivot_type, friction_type, asperity_type, start_type, film_type, integration_type, output_type, &
      & coefficients_type, periodic_type, branch_type, unset, is_set
   use excitations, only: excitation_type
   use machine_groups, only: machine_type
   implicit none (type, external)
   private
   public :: case_type

   type :: case_type
      !> The namelist group &case.
      type(about_type) :: about
      type(rotor_type) :: rotor
      type(operation_type) :: operation
      type(bearing_type) :: bearing
      type(oil_type) :: oil
      type(thermal_type) :: thermal
      type(pads_type) :: pads
      type(pivot_type) :: pivot
      type(friction_type) :: friction
      type(asperity_type) :: asperity
      type(start_type) :: start
      type(film_type) :: film
      type(integration_type) :: integration
      type(output_type) :: output
      type(coefficients_type) :: coefficients
      type(periodic_type) :: periodic
      type(branch_type) :: branch
      !> The groups &excitation.
      type(excitation_type), allocatable :: excitations(:)
      !> Of a machine: shaft and bearings; not allocated where a rigid journal turns in one bearing.
      type(machine_type), allocatable :: machine
   contains
      procedure :: is_machine
      procedure :: bearing_count
      procedure :: of_bearing
      procedure :: set_bearing
      procedure :: pad_count
      procedure :: clearance
      procedure :: moves
      procedure :: seeks_orbits
      procedure :: changes_shape
      procedure :: tilting
      procedure :: tilting_radial
      procedure :: highest_speed
      procedure :: unbalance
      procedure :: sense
      procedure :: is_steady
      procedure :: is_disturbed
      procedure :: set_final_speed
   end type case_type

   !> The paper's bearing.
   interface case_type
      module procedure new_case
   end interface case_type

contains

   pure function new_case() result(inputs)
      type(case_type) :: inputs
      inputs%about%title = ''
      inputs%about%task = 'march'
      inputs%operation%rotation = 'clockwise'
      inputs%oil%law = 'constant'
      inputs%thermal%model = 'none'
      inputs%thermal%march = 'frozen'
      inputs%output%keep = 'all'
      inputs%bearing%machined_clearance = [100e-6_wp, 100e-6_wp]
      inputs%bearing%assembled_clearance = [80e-6_wp, 80e-6_wp]
      inputs%bearing%preload = [unset, unset]
      inputs%bearing%axial_length = [100e-3_wp, 100e-3_wp]
      inputs%pads%pivot_angle_deg = [-45.0_wp, 225.0_wp]
      inputs%pads%arc_deg = [69.3_wp, 69.3_wp]
      inputs%pads%pivot_ratio = [0.5_wp, 0.5_wp]
      inputs%pads%pivot_distance = [14e-3_wp, 14e-3_wp]
      inputs%pads%mass = [0.8108_wp, 0.8108_wp]
      inputs%pads%inertia = [4.055e-4_wp, 4.055e-4_wp]
      inputs%pads%centre_tangential = [0.0_wp, 0.0_wp]
      inputs%pads%centre_radial = [-10.1e-3_wp, -10.1e-3_wp]
      inputs%pads%density = [unset, unset]
      inputs%pads%thickness = [unset, unset]
      inputs%pads%conductivity = [50.0_wp, 50.0_wp]
      inputs%pads%motion = 'tilting_radial'
      inputs%pads%bending = 'none'
      inputs%pads%young_modulus = [2.1e11_wp, 2.1e11_wp]
      inputs%pads%poisson_ratio = [0.3_wp, 0.3_wp]
      inputs%pads%expansion = [11e-6_wp, 11e-6_wp]
      inputs%pads%temperature = [unset, unset]
      inputs%pivot%law = 'fang'
      inputs%pivot%file = ''
      inputs%pivot%socket_radius = [13e-3_wp, 13e-3_wp]
      inputs%pivot%radius_difference = [15e-6_wp, 15e-6_wp]
      inputs%friction%model = 'none'
      inputs%friction%static_coefficient = [0.1_wp, 0.1_wp]
      inputs%friction%dynamic_coefficient = [0.05_wp, 0.05_wp]
      inputs%asperity%model = 'greenwood_tripp'
      inputs%start%from = 'equilibrium'
      inputs%start%file = ''
      inputs%start%pad_tilt = [0.0_wp, 0.0_wp]
      inputs%start%pad_tilt_rate = [0.0_wp, 0.0_wp]
      inputs%start%pivot_deflection = [0.0_wp, 0.0_wp]
      inputs%start%pivot_deflection_rate = [0.0_wp, 0.0_wp]
      inputs%film%solver = 'auto'
      inputs%film%cavitation = 'reynolds'
      inputs%coefficients%frequency_ratio = [1.0_wp]
      inputs%branch%of = 'periodic'
      inputs%branch%parameter = ''
      allocate (inputs%excitations(0))
      call inputs%set_final_speed()
   end function new_case

   !> The final speed where the input leaves it out: the speed at the start.
   pure subroutine set_final_speed(self)
      class(case_type), intent(inout) :: self
      if (.not. is_set(self%operation%final_speed_rpm)) self%operation%final_speed_rpm = self%operation%speed_rpm
   end subroutine set_final_speed

   !> 1 where the shaft turns clockwise, from +y towards +z; -1 where it turns from +y towards -z.
   pure real(wp) function sense(self)
      class(case_type), intent(in) :: self
      sense = merge(-1.0_wp, 1.0_wp, self%operation%rotation == 'anticlockwise')
   end function sense

   !> Whether the speed stays the same.
   pure logical function is_steady(self)
      class(case_type), intent(in) :: self
      is_steady = .not. abs(self%operation%final_speed_rpm - self%operation%speed_rpm) > 0
   end function is_steady

   !> Whether the group start adds something to where a march starts.
   pure logical function is_disturbed(self)
      class(case_type), intent(in) :: self
      associate (s => self%start)
         is_disturbed = any(abs([s%journal, s%journal_velocity, s%pad_tilt, s%pad_tilt_rate, s%pivot_deflection, &
            & s%pivot_deflection_rate]) > 0)
      end associate
   end function is_disturbed

   !> Whether the task integrates the motion.
   pure logical function moves(self)
      class(case_type), intent(in) :: self
      moves = self%about%task == 'march' .or. self%seeks_orbits()
   end function moves

   !> Whether the task seeks periodic orbits.
   pure logical function seeks_orbits(self)
      class(case_type), intent(in) :: self
      seeks_orbits = self%about%task == 'periodic' .or. self%about%task == 'branch' .and. self%branch%of == 'periodic'
   end function seeks_orbits

   !> Whether a shaft turns in bearings that have names.
   pure logical function is_machine(self)
      class(case_type), intent(in) :: self
      is_machine = allocated(self%machine)
   end function is_machine

   pure integer function bearing_count(self)
      class(case_type), intent(in) :: self
      bearing_count = 1
      if (self%is_machine()) bearing_count = size(self%machine%bearings)
   end function bearing_count

   !> The case of one bearing of a machine, with its own groups and a rigid journal in the place of the shaft, under a
   !> load along y and z, N; of a rigid journal the case itself.
   pure type(case_type) function of_bearing(self, b, load) result(inputs)
      class(case_type), intent(in) :: self
      integer, intent(in) :: b
      real(wp), intent(in), optional :: load(2)
      inputs = self
      if (.not. self%is_machine()) return
      if (present(load)) inputs%rotor%static_load = load + [inputs%rotor%mass*inputs%rotor%gravity, 0.0_wp]
      associate (own => self%machine%bearings(b))
         inputs%bearing = own%bearing
         inputs%oil = own%oil
         inputs%pads = own%pads
         inputs%pivot = own%pivot
         inputs%friction = own%friction
         inputs%asperity = own%asperity
         inputs%film = own%film
      end associate
      deallocate (inputs%machine)
      ! a machine starts without a disturbance
      associate (s => inputs%start, none => 0*inputs%pads%pivot_angle_deg)
         s%pad_tilt = none
         s%pad_tilt_rate = none
         s%pivot_deflection = none
         s%pivot_deflection_rate = none
      end associate
   end function of_bearing

   !> Gives a bearing of a machine the groups of a case of one bearing.
   pure subroutine set_bearing(self, b, inputs)
      class(case_type), intent(inout) :: self
      integer, intent(in) :: b
      type(case_type), intent(in) :: inputs
      associate (own => self%machine%bearings(b))
         own%bearing = inputs%bearing
         own%oil = inputs%oil
         own%pads = inputs%pads
         own%pivot = inputs%pivot
         own%friction = inputs%friction
         own%asperity = inputs%asperity
         own%film = inputs%film
      end associate
   end subroutine set_bearing

   pure integer function pad_count(self)
      class(case_type), intent(in) :: self
      pad_count = size(self%pads%pivot_angle_deg)
   end function pad_count

   !> The bearing clearance c_r, m: of pads that differ the smallest.
   pure real(wp) function clearance(self)
      class(case_type), intent(in) :: self
      clearance = minval(self%bearing%assembled_clearance)
   end function clearance

   !> Whether the equilibrium changes clearances, of a machine of any bearing: pads bend, or shaft, pads and housing
   !> expand.
   pure logical function changes_shape(self)
      class(case_type), intent(in) :: self
      integer :: b
      if (.not. self%is_machine()) then
         changes_shape = changes(self%pads, self%bearing)
         return
      end if
      changes_shape = .false.
      do b = 1, size(self%machine%bearings)
         associate (of => self%machine%bearings(b))
            changes_shape = changes_shape .or. changes(of%pads, of%bearing)
         end associate
      end do
   contains
      pure logical function changes(pads, bearing)
         type(pads_type), intent(in) :: pads
         type(bearing_type), intent(in) :: bearing
         changes = pads%bending /= 'none' .or. is_set(bearing%clearance_temperature)
      end function changes
   end function changes_shape

   !> False for pads that are fixed: lobes of a plain bearing.
   pure logical function tilting(self)
      class(case_type), intent(in) :: self
      tilting = self%pads%motion /= 'fixed'
   end function tilting

   pure logical function tilting_radial(self)
      class(case_type), intent(in) :: self
      tilting_radial = self%pads%motion == 'tilting_radial'
   end function tilting_radial

   !> Highest speed of the run, rad/s.
   pure real(wp) function highest_speed(self)
      class(case_type), intent(in) :: self
      highest_speed = max(self%operation%speed_rpm, self%operation%final_speed_rpm)*rpm
   end function highest_speed

   !> Unbalance, kg m: of a machine the sum of its moments, whatever their angles; else as given, or by ISO 21940-11,
   !> eq (26): m G / Omega with G in m/s.
   pure real(wp) function unbalance(self)
      class(case_type), intent(in) :: self
      real(wp) :: balance_rpm
      if (self%is_machine()) then
         unbalance = sum(self%machine%unbalances%moment)
         return
      end if
      unbalance = self%rotor%unbalance
      if (is_set(self%rotor%balance_grade)) then
         balance_rpm = self%rotor%balance_speed_rpm
         if (.not. is_set(balance_rpm)) balance_rpm = self%highest_speed()/rpm
         ! eq (26): 9549 G m / n, in g mm
         unbalance = 9549*self%rotor%balance_grade*self%rotor%mass/balance_rpm*1e-6_wp
      end if
   end function unbalance
end module case_inputs
