!> Remarks on forces: loads that few bearings have, forces too small beside the others to be meant in N, and where the
!> load of fixed pads points to.
module load_remarks
   use kinds, only: wp, degree
   use text, only: to_text, fixed_text
   use case_groups, only: bearing_type
   use case_inputs, only: case_type
   use bearing_numbers, only: load, specific_load
   use operating_point, only: operating_point_type
   use other_units, only: in_other_units, usual_size, usual_type
   use unit_remarks, only: remark_on_unbalance
   implicit none (type, external)
   private
   public :: remarks_on_load, remarks_on_forces

   character(len=*), parameter :: newline = achar(10)
   !> Specific loads, Pa, that few bearings have; the lowest that another unit of a load is proposed for.
   real(wp), parameter :: highest_usual_load = 5e6_wp, lowest_usual_load = 5e3_wp, lowest_proposed = 2e4_wp
   !> Part of the weight of which no force is worth its place in the input; part of the load of a bearing where the
   !> measured law of its pivots may end; multiple of the clearance where its deflections may.
   real(wp), parameter :: negligible = 1e-3_wp, beyond_table = 0.05_wp, deepest = 5
   !> From the edge of a fixed pad on this angle, deg, carries little.
   real(wp), parameter :: beside_edge = 15

contains

   !> Steady forces that a case gives, the tables of its pivots beside them, and what depends on the load and the
   !> unbalance of a rigid journal, a line each.
   function remarks_on_forces(inputs) result(lines)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: lines
      real(wp) :: weight
      integer :: i
      lines = ''
      associate (r => inputs%rotor, bearings => inputs%bearings)
         if (r%is_rigid()) then
            lines = on_force('rotor%static_load', norm2(r%static_load), r%mass*r%gravity)//on_low_load(inputs) &
               & //on_table(bearings(1), load(inputs))
            if (inputs%moves()) lines = lines//remark_on_unbalance(inputs%unbalance(), r%mass, bearings(1)%clearance())
            lines = lines//remarks_on_load(inputs)
         else if (r%station_count() > 0) then
            weight = r%elastic%mass()*r%gravity
            do i = 1, size(r%elastic%loads)
               lines = lines//on_force('load('//to_text(i)//')%force', norm2(r%elastic%loads(i)%force), weight)
            end do
            do i = 1, size(bearings)
               lines = lines//on_table(bearings(i), weight/size(bearings))
            end do
         end if
      end associate
   end function remarks_on_forces

   !> A force, N, that is nothing beside the weight.
   function on_force(name, force, weight) result(line)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: force, weight
      character(len=:), allocatable :: line
      line = ''
      if (.not. force > 0 .or. force >= negligible*weight) return
      line = name//': '//to_text(force)//' N are nothing beside the weight of '//to_text(weight)//' N' &
         & //in_other_units(force, name, 'N', 10*negligible*weight, huge(1.0_wp))//newline
   end function on_force

   !> A load that is low for the size of the bearing, where its size is usual.
   function on_low_load(inputs) result(line)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: line
      type(usual_type) :: usual
      usual = usual_size('bearing%journal_radius', 'm')
      line = ''
      if (inputs%bearings(1)%journal_radius > usual%high .or. .not. load(inputs) > 0) return
      if (specific_load(inputs) < lowest_usual_load) line = 'specific load ' &
         & //to_text(1e-6_wp*specific_load(inputs))//' MPa: seldom so low; most bearings carry 1 to 3 MPa' &
         & //in_usual_unit(inputs)//newline
   end function on_low_load

   !> What weight or static load of a case, whichever is larger, is in units in which its specific load is usual.
   function in_usual_unit(inputs) result(hint)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: hint
      associate (r => inputs%rotor, area => load(inputs)/specific_load(inputs))
         if (norm2(r%static_load) > r%mass*r%gravity) then
            hint = in_other_units(norm2(r%static_load), 'rotor%static_load', 'N', lowest_proposed*area, &
               & highest_usual_load*area)
         else
            hint = in_other_units(r%mass, 'rotor%mass', 'kg', lowest_proposed*area/r%gravity, &
               & highest_usual_load*area/r%gravity)
         end if
      end associate
   end function in_usual_unit

   !> The measured law of the pivots of a bearing, where it ends far below the load or far beyond the clearance.
   function on_table(bearing, carried) result(line)
      type(bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: carried
      character(len=:), allocatable :: line, group
      line = ''
      if (.not. allocated(bearing%pivot%points)) return
      group = 'pivot'//bearing%suffix()
      associate (last => bearing%pivot%points(:, size(bearing%pivot%points, 2)), clearance => bearing%clearance())
         if (last(2) < beyond_table*carried) line = line//group//'%file: its largest force is '//to_text(last(2)) &
            & //' N, and the bearing carries '//to_text(carried)//' N'//in_other_units(last(2), 'force', 'N', &
            & beyond_table*carried, huge(1.0_wp))//newline
         if (last(1) > deepest*clearance) line = line//group//'%file: its largest deflection is '//to_text(last(1)) &
            & //' m, and the clearance of the bearing is '//to_text(clearance)//' m'//in_other_units(last(1), &
            & 'deflection', 'm', 0.0_wp, deepest*clearance)//newline
      end associate
   end function on_table

   !> What depends on the load of the one bearing of a case.
   function remarks_on_load(inputs) result(lines)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: lines
      lines = ''
      if (.not. load(inputs) > 0) return
      if (specific_load(inputs) > highest_usual_load) then
         lines = lines//'specific load '//fixed_text(1e-6_wp*specific_load(inputs), 2)//' MPa: above ' &
            & //to_text(1e-6_wp*highest_usual_load)//' MPa, where pads bend under their pressure (pads%bending); ' &
            & //'most bearings carry 1 to 3 MPa'//in_usual_unit(inputs)//newline
      end if
      if (inputs%bearings(1)%tilting()) return
      associate (at => direction_of_load(inputs))
         if (carries_at(inputs%bearings(1), inputs%sense(), at)) return
         lines = lines//'the load points to '//fixed_text(at, 1)//' deg, to the end of a fixed pad or between two, ' &
            & //'where little oil film carries; turn the pads (pads%pivot_angle_deg) for a groove out of the load' &
            & //newline
      end associate
   end function remarks_on_load

   !> The angle to which the load points, deg, counted as that of a pivot.
   real(wp) function direction_of_load(inputs) result(at)
      type(case_type), intent(in) :: inputs
      type(operating_point_type) :: point
      point = operating_point_type(inputs)
      at = atan2(point%load(1), point%load(2))/degree
   end function direction_of_load

   !> Whether a fixed pad reaches past this angle, deg, on either side, where the shaft turns in this sense.
   pure logical function carries_at(bearing, sense, at)
      type(bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: sense, at
      real(wp) :: from_trailing(bearing%pad_count())
      associate (p => bearing%pads)
         from_trailing = modulo(sense*(at - p%pivot_angle_deg) + (1 - p%pivot_ratio)*p%arc_deg, 360.0_wp)
         carries_at = any(from_trailing >= beside_edge .and. p%arc_deg - from_trailing >= beside_edge)
      end associate
   end function carries_at
end module load_remarks
