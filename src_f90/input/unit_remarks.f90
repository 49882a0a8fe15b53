!> Remarks on numbers that are allowed and seldom meant in the unit of the input, with what they are in others.
module unit_remarks
   use kinds, only: wp, pi, degree, rpm
   use text, only: to_text
   use case_groups, only: is_set, bearing_type
   use case_inputs, only: case_type
   use other_units, only: in_other_units, usual_size, usual_type
   use variable_table, only: variable_table_type, variable_type
   implicit none (type, external)
   private
   public :: remarks_on_units, remarks_on_pads, remark_on_unbalance, remark_on_speed, &
      & remark_on_clearance

   character(len=*), parameter :: newline = achar(10)

   !> Density, kg/m^3, that no pad has; its radius of gyration about the pivot over the radius of the journal.
   real(wp), parameter :: densest = 1e5_wp, widest = 5
   !> Bearing clearance over the radius of the journal that no bearing has.
   real(wp), parameter :: widest_clearance = 0.01_wp
   !> Multiple of the speed of the shaft above which frequencies seldom are, and how close to the speed in another unit
   !> a number must be, of itself, to be taken for it.
   real(wp), parameter :: highest_order = 25, closeness = 1e-3_wp
   !> Usual surface speeds of journals at their working speed, m/s.
   real(wp), parameter :: usual_speeds(2) = [2.0_wp, 150.0_wp]

contains

   !> All of a case, but for those on pads, a line each; by its table of variables.
   function remarks_on_units(inputs, table) result(lines)
      type(case_type), intent(in) :: inputs
      type(variable_table_type), intent(in) :: table
      character(len=:), allocatable :: lines
      integer :: i
      lines = ''
      do i = 1, table%count
         lines = lines//remark_on_number(table%variables(i))
      end do
      lines = lines//on_discs(inputs)//on_frequencies(inputs)
   end function remarks_on_units

   !> On the first value of a variable that is not of usual size; empty where there is none.
   function remark_on_number(v) result(line)
      type(variable_type), intent(in) :: v
      character(len=:), allocatable :: line, name
      type(usual_type) :: usual
      integer :: i
      line = ''
      if (v%is_text) return
      name = v%group//'%'//v%name
      usual = usual_size(name, v%unit)
      if (.not. usual%told) return
      do i = 1, size(v%values)
         associate (x => v%values(i))
            if (.not. is_set(x) .or. abs(x) <= 0 .or. (abs(x) >= usual%low .and. abs(x) <= usual%high)) cycle
            line = name//' = '//to_text(x)//': seldom so in '//v%unit//in_other_units(x, name, v%unit, v%low, v%high) &
               & //newline
            return
         end associate
      end do
   end function remark_on_number

   !> On a clearance that no pad has, beside the radius of the journal.
   function remark_on_clearance(b) result(line)
      type(bearing_type), intent(in) :: b
      character(len=:), allocatable :: line
      line = ''
      associate (c => minval(b%assembled_clearance), largest => widest_clearance*b%journal_radius)
         if (c > largest) line = 'bearing%assembled_clearance = '//to_text(c)//': '//to_text(c/b%journal_radius) &
            & //' of the radius of the journal; usual are 0.001 to 0.003' &
            & //in_other_units(c, 'bearing%assembled_clearance', 'm', 0.0_wp, largest)//newline
      end associate
   end function remark_on_clearance

   !> On masses and moments of inertia of a bearing that no pad of its size has.
   function remarks_on_pads(b) result(lines)
      type(bearing_type), intent(in) :: b
      character(len=:), allocatable :: lines
      real(wp) :: heaviest, largest
      integer :: i
      lines = ''
      if (.not. b%tilting()) return
      associate (p => b%pads)
         do i = 1, b%pad_count()
            heaviest = densest*p%arc_deg(i)*degree*b%journal_radius*b%axial_length(i)*p%pivot_distance(i)
            largest = p%mass(i)*(widest*b%journal_radius)**2
            if (p%mass(i) > heaviest) then
               lines = 'pads%mass = '//to_text(p%mass(i))//': more than a pad of this size weighs' &
                  & //in_other_units(p%mass(i), 'pads%mass', 'kg', 0.0_wp, heaviest)//newline
            else if (p%inertia(i) > largest) then
               lines = 'pads%inertia = '//to_text(p%inertia(i))//': more than a pad of this size and mass has' &
                  & //in_other_units(p%inertia(i), 'pads%inertia', 'kg m^2', 0.0_wp, largest)//newline
            end if
            if (lines /= '') return
         end do
      end associate
   end function remarks_on_pads

   !> Discs whose radius of gyration is longer than the shaft.
   function on_discs(inputs) result(lines)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: lines
      real(wp) :: largest
      integer :: i
      lines = ''
      if (inputs%rotor%station_count() == 0) return
      do i = 1, size(inputs%rotor%elastic%discs)
         associate (disc => inputs%rotor%elastic%discs(i))
            largest = disc%mass*sum(inputs%rotor%elastic%shaft%length)**2
            if (disc%diametral_inertia > largest) lines = lines//'disc('//to_text(i)//')%diametral_inertia = ' &
               & //to_text(disc%diametral_inertia)//': more than a disc of its mass has that is not larger than the ' &
               & //'shaft is long'//in_other_units(disc%diametral_inertia, 'disc%', 'kg m^2', 0.0_wp, largest)//newline
         end associate
      end do
   end function on_discs

   !> Frequencies and speeds beside the speed of the shaft.
   function on_frequencies(inputs) result(lines)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: lines, name
      integer :: i
      lines = ''
      associate (balance => inputs%rotor%balance_speed_rpm)
         if (is_set(balance) .and. is_near(balance, inputs%highest_speed())) lines = 'rotor%balance_speed_rpm = ' &
            & //to_text(balance)//': the speed of the shaft in rad/s; it is in rpm'//newline
      end associate
      do i = 1, size(inputs%excitations)
         name = 'excitation('//to_text(i)//')%'
         associate (x => inputs%excitations(i))
            if (is_set(x%frequency_hz)) lines = lines//on_frequency(name//'frequency_hz', x%frequency_hz, &
               & inputs%highest_speed())
            if (is_set(x%frequency_ratio)) lines = lines//on_ratio(name//'frequency_ratio', x%frequency_ratio)
         end associate
      end do
      if (inputs%about%task == 'coefficients') lines = lines//on_ratio('coefficients%frequency_ratio', &
         & maxval([0.0_wp, inputs%coefficients%frequency_ratio]))
   end function on_frequencies

   !> The highest speed of a run, rad/s, where the surface of a journal of this radius, m, is seldom so slow.
   function remark_on_speed(speed, radius) result(line)
      real(wp), intent(in) :: speed, radius
      character(len=:), allocatable :: line
      line = ''
      associate (turns => speed/rpm)
         if (speed*radius < usual_speeds(1)) line = 'surface speed ' &
            & //to_text(speed*radius)//' m/s at '//to_text(turns)//' rpm: seldom so low' &
            & //in_other_units(turns, 'operation%speed_rpm', 'rpm', usual_speeds(1)/radius/rpm, &
            & usual_speeds(2)/radius/rpm)//newline
      end associate
   end function remark_on_speed

   !> A frequency, Hz, far above that of the shaft, or its speed, rad/s, in another unit.
   function on_frequency(name, frequency, speed) result(line)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: frequency, speed
      character(len=:), allocatable :: line
      line = ''
      associate (turns => speed/(2*pi))
         if (is_near(frequency, speed)) then
            line = ': the speed of the shaft in rad/s'
         else if (frequency > highest_order*turns) then
            line = ': '//to_text(frequency/turns)//' times the speed of the shaft; '//to_text(frequency)//' rpm are ' &
               & //to_text(frequency/60)
         end if
         if (line /= '') line = name//' = '//to_text(frequency)//line//'; the shaft turns at '//to_text(turns)//' Hz' &
            & //newline
      end associate
   end function on_frequency

   !> A frequency over the speed of the shaft.
   function on_ratio(name, ratio) result(line)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: ratio
      character(len=:), allocatable :: line
      line = ''
      if (ratio > highest_order) line = name//' = '//to_text(ratio)//': this many times the speed of the shaft; is ' &
         & //'it in Hz or rpm?'//newline
   end function on_ratio

   !> Whether two numbers are the same but for rounding in a data sheet.
   pure logical function is_near(x, y)
      real(wp), intent(in) :: x, y
      is_near = abs(x - y) <= closeness*abs(y)
   end function is_near

   !> What an unbalance, kg m, of a rotor of this mass, kg, says where its eccentricity is more than the clearance, m;
   !> else empty.
   function remark_on_unbalance(unbalance, mass, clearance) result(line)
      real(wp), intent(in) :: unbalance, mass, clearance
      character(len=:), allocatable :: line
      line = ''
      if (unbalance > mass*clearance) line = 'mass eccentricity '//to_text(1e6_wp*unbalance/mass) &
         & //' um (unbalance over the mass of the rotor): more than the bearing clearance of ' &
         & //to_text(1e6_wp*clearance)//' um; the unbalance is in kg m' &
         & //in_other_units(unbalance, 'rotor%unbalance', 'kg m', 0.0_wp, mass*clearance)//newline
   end function remark_on_unbalance
end module unit_remarks
