!> What a run is about: the values of all namelist groups. A default case is the paper's bearing.
module case_inputs
   use kinds, only: wp, rpm
   use text, only: to_text
   use case_groups, only: about_type, operation_type, bearing_type, thermal_type, start_type, held_type, &
      & integration_type, output_type, coefficients_type, periodic_type, branch_type, is_set, rotor_type, &
      & mount_type, station_element_type
   use excitations, only: excitation_type
   implicit none (type, external)
   private
   public :: case_type, longest_label

   !> Longest name of an element in results.
   integer, parameter :: longest_label = 50

   type :: case_type
      !> The namelist group &case.
      type(about_type) :: about
      type(rotor_type) :: rotor
      type(operation_type) :: operation
      type(thermal_type) :: thermal
      type(start_type) :: start
      type(held_type) :: held
      type(integration_type) :: integration
      type(output_type) :: output
      type(coefficients_type) :: coefficients
      type(periodic_type) :: periodic
      type(branch_type) :: branch
      !> The groups &excitation.
      type(excitation_type), allocatable :: excitations(:)
      !> One, without a name, where the rotor is rigid.
      type(bearing_type), allocatable :: bearings(:)
   contains
      procedure :: alone
      procedure :: mounts
      procedure :: station_elements
      procedure :: dampers
      procedure :: element_labels
      procedure :: has_slopes
      procedure :: inclined
      procedure :: moves
      procedure :: seeks_orbits
      procedure :: followed
      procedure :: highest_speed
      procedure :: unbalance
      procedure :: is_driven
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
      inputs%thermal%model = 'none'
      inputs%thermal%march = 'frozen'
      inputs%output%keep = 'all'
      inputs%start%from = 'equilibrium'
      inputs%start%file = ''
      inputs%start%pad_tilt = [0.0_wp, 0.0_wp]
      inputs%start%pad_tilt_rate = [0.0_wp, 0.0_wp]
      inputs%start%pivot_deflection = [0.0_wp, 0.0_wp]
      inputs%start%pivot_deflection_rate = [0.0_wp, 0.0_wp]
      inputs%start%pad_pitch = [0.0_wp, 0.0_wp]
      inputs%start%pad_pitch_rate = [0.0_wp, 0.0_wp]
      inputs%start%pad_yaw = [0.0_wp, 0.0_wp]
      inputs%start%pad_yaw_rate = [0.0_wp, 0.0_wp]
      inputs%coefficients%frequency_ratio = [1.0_wp]
      inputs%branch%of = 'periodic'
      inputs%branch%parameter = ''
      inputs%branch%point = ''
      inputs%branch%second_parameter = ''
      allocate (inputs%excitations(0), inputs%bearings(1))
      inputs%bearings(1) = bearing_type()
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
            & s%pivot_deflection_rate, s%pad_pitch, s%pad_pitch_rate, s%pad_yaw, s%pad_yaw_rate]) > 0)
      end associate
   end function is_disturbed

   !> Whether slopes of the journal count in the films of bearing b: of pads that pitch, of a journal that is inclined
   !> or comes to be on a branch, of an elastic shaft, and where coefficients against them are asked for.
   pure logical function has_slopes(self, b)
      class(case_type), intent(in) :: self
      integer, intent(in) :: b
      associate (bearing => self%bearings(b), branch => self%branch)
         has_slopes = bearing%pitching() .or. on_inclined_shaft(bearing) .or. any(abs(bearing%slope) > 0) &
            & .or. self%about%task == 'coefficients' .and. self%coefficients%slopes .or. self%about%task == 'branch' &
            & .and. index(branch%parameter//branch%second_parameter, 'bearing%slope') > 0
      end associate
   end function has_slopes

   !> The bearings whose films count the slopes of an elastic shaft.
   pure function inclined(self)
      class(case_type), intent(in) :: self
      integer, allocatable :: inclined(:)
      integer :: b
      allocate (inclined(0))
      if (.not. self%rotor%is_rigid()) inclined = pack([(b, b=1, size(self%bearings))], &
         & on_inclined_shaft(self%bearings))
   end function inclined

   !> Whether the films of a bearing count the slope of an elastic shaft.
   elemental logical function on_inclined_shaft(bearing)
      type(bearing_type), intent(in) :: bearing
      on_inclined_shaft = bearing%shaft_slope == 'film' .or. bearing%shaft_slope == 'auto' .and. bearing%pitching()
   end function on_inclined_shaft

   !> Whether the task integrates the motion.
   pure logical function moves(self)
      class(case_type), intent(in) :: self
      moves = self%about%task == 'march' .or. self%seeks_orbits()
   end function moves

   !> Whether the task seeks periodic orbits, limit cycles among them.
   pure logical function seeks_orbits(self)
      class(case_type), intent(in) :: self
      seeks_orbits = self%about%task == 'periodic' .or. self%about%task == 'branch' .and. self%followed() &
         & /= 'equilibrium'
   end function seeks_orbits

   !> What a branch is of, or the branches on which a curve has its points: 'periodic', 'equilibrium' or 'limit_cycle'.
   pure function followed(self)
      class(case_type), intent(in) :: self
      character(len=:), allocatable :: followed
      followed = self%branch%of
      if (followed /= 'curve') return
      select case (self%branch%point)
      case ('hopf')
         followed = 'equilibrium'
      case ('cycle_fold')
         followed = 'limit_cycle'
      case ('fold')
         followed = trim(merge('periodic   ', 'equilibrium', self%is_driven()))
      case default
         followed = 'periodic'
      end select
   end function followed

   !> The case of bearing b alone, with a rigid journal in the place of an elastic rotor, under a load along y and z, N.
   pure type(case_type) function alone(self, b, load, slope) result(inputs)
      class(case_type), intent(in) :: self
      integer, intent(in) :: b
      !> N, rad.
      real(wp), intent(in), optional :: load(2), slope(2)
      inputs = self
      if (allocated(inputs%rotor%elastic)) deallocate (inputs%rotor%elastic)
      if (present(load)) inputs%rotor%static_load = load + [inputs%rotor%mass*inputs%rotor%gravity, 0.0_wp]
      inputs%bearings = self%bearings(b:b)
      inputs%bearings(1)%name = ''
      if (present(slope)) inputs%bearings(1)%slope = slope
   end function alone

   !> What holds the rotor: bearings of pads, then those by coefficients.
   pure function mounts(self)
      class(case_type), intent(in) :: self
      type(mount_type), allocatable :: mounts(:)
      integer :: b, n
      n = 0
      if (.not. self%rotor%is_rigid()) n = size(self%rotor%elastic%linear)
      allocate (mounts(size(self%bearings) + n))
      do b = 1, size(self%bearings)
         mounts(b) = self%bearings(b)%mount_type
      end do
      do b = 1, n
         mounts(size(self%bearings) + b) = self%rotor%elastic%linear(b)%mount_type
      end do
   end function mounts

   ! What acts on a machine beside its films: linear elements, which its matrices know, then dampers.

   !> The elements of a machine: those of its groups, its bearings by coefficients, and for the task coefficients the
   !> cross-coupled stiffness at each of its journals.
   pure function station_elements(self) result(elements)
      class(case_type), intent(in) :: self
      type(station_element_type), allocatable :: elements(:)
      type(mount_type), allocatable :: mounts(:)
      integer :: b, n, m
      if (self%rotor%is_rigid()) then
         allocate (elements(0))
         return
      end if
      mounts = self%mounts()
      associate (given => self%rotor%elastic%elements, q => self%coefficients%cross_stiffness, &
         & linear => self%rotor%elastic%linear)
         n = size(given)
         allocate (elements(n + size(linear) + merge(size(mounts), 0, self%about%task == 'coefficients' .and. &
            & abs(q) > 0)))
         do b = 1, n
            elements(b) = given(b)
            elements(b)%label = 'element('//to_text(b)//')'
            if (given(b)%station > 0) cycle
            elements(b)%under_housing = .true.
            elements(b)%station = sum(pack(mounts%station, [(mounts(m)%name == given(b)%housing, m=1, size(mounts))]))
         end do
         do b = 1, size(linear)
            elements(n + b) = linear(b)%of
            elements(n + b)%origin = linear(b)%offset
            call stand_at(elements(n + b), linear(b)%mount_type, 'bearing')
         end do
         m = n + size(linear)
         do b = m + 1, size(elements)
            call elements(b)%begin()
            elements(b)%cross_stiffness = q
            elements(b)%static = .false.
            call stand_at(elements(b), mounts(b - m), 'cross_stiffness')
         end do
      end associate
   contains
      !> An element between the journal of a bearing and what this stands on.
      pure subroutine stand_at(element, mount, what)
         type(station_element_type), intent(inout) :: element
         type(mount_type), intent(in) :: mount
         character(len=*), intent(in) :: what
         element%station = mount%station
         if (allocated(mount%support)) element%housing = mount%name
         element%label = what//mount%suffix()
      end subroutine stand_at
   end function station_elements

   !> Which of what holds the rotor has a squeeze film damper at its housing.
   pure function dampers(self) result(bearings)
      class(case_type), intent(in) :: self
      integer, allocatable :: bearings(:)
      type(mount_type), allocatable :: mounts(:)
      integer :: b
      mounts = self%mounts()
      bearings = pack([(b, b=1, size(mounts))], [(allocated(mounts(b)%damper), b=1, size(mounts))] &
         & .and. .not. self%rotor%is_rigid())
   end function dampers

   !> What results call the elements and the dampers: as input does, 'element(1)', 'damper:left'.
   pure function element_labels(self) result(labels)
      class(case_type), intent(in) :: self
      character(len=longest_label), allocatable :: labels(:)
      type(station_element_type), allocatable :: elements(:)
      type(mount_type), allocatable :: mounts(:)
      integer, allocatable :: of(:)
      integer :: i
      mounts = self%mounts()
      elements = self%station_elements()
      of = self%dampers()
      allocate (labels(size(elements) + size(of)))
      do i = 1, size(elements)
         labels(i) = elements(i)%label
      end do
      do i = 1, size(of)
         labels(size(elements) + i) = 'damper'//mounts(of(i))%suffix()
      end do
   end function element_labels

   !> Highest speed of the run, rad/s.
   pure real(wp) function highest_speed(self)
      class(case_type), intent(in) :: self
      highest_speed = max(self%operation%speed_rpm, self%operation%final_speed_rpm)*rpm
   end function highest_speed

   !> Whether what turns with the rotor moves it: an unbalance, or a bow or skew discs of its shaft.
   pure logical function is_driven(self)
      class(case_type), intent(in) :: self
      is_driven = self%unbalance() > 0
      if (.not. self%rotor%is_rigid()) is_driven = .not. self%rotor%elastic%is_balanced()
   end function is_driven

   !> Unbalance, kg m: of an elastic rotor the sum of its moments, whatever their angles; else as given, or by
   !> ISO 21940-11, eq (26): m G / Omega with G in m/s.
   pure real(wp) function unbalance(self)
      class(case_type), intent(in) :: self
      real(wp) :: balance_rpm
      if (.not. self%rotor%is_rigid()) then
         unbalance = sum(self%rotor%elastic%unbalances%moment)
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
