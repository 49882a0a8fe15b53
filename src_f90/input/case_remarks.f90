!> Remarks on a case: what is allowed and seldom meant, what the model is not made for, and what has no effect. A line
!> each; --check shows them, and a run puts them on its list.
module case_remarks
   use kinds, only: wp
   use text, only: to_text, fixed_text
   use case_groups, only: bearing_type
   use case_inputs, only: case_type
   use bearing_numbers, only: preload
   use variable_table, only: variable_table_type
   use case_fields, only: list_variables
   use namelist_writer, only: lines_of
   use unit_remarks, only: remarks_on_units, remarks_on_pads, remark_on_speed, remark_on_clearance
   use load_remarks, only: remarks_on_forces
   implicit none (type, external)
   private
   public :: remarks_on_case, behind, newline

   character(len=*), parameter :: newline = achar(10)
   !> Surface speed, m/s, up to which a temperature for each pad is close to those along and across the films.
   real(wp), parameter :: compared_up_to = 35

contains

   !> All of a case; of a machine those of each of its bearings, whose loads are not known yet.
   function remarks_on_case(inputs) result(lines)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: lines
      type(variable_table_type) :: table
      integer :: b
      lines = ''
      call list_variables(inputs, table)
      do b = 1, size(inputs%bearings)
         lines = lines//behind(inputs%bearings(b)%label(': '), on_bearing(inputs, inputs%bearings(b)))
      end do
      lines = lines//remarks_on_units(inputs, table)//remarks_on_forces(inputs)
      if (allocated(inputs%about%of_paper)) lines = lines//'not given, and so as in the paper''s bearing: ' &
         & //inputs%about%of_paper//newline
      lines = lines//on_idle_groups(inputs, table)
   end function remarks_on_case

   !> Lines, each behind a prefix.
   pure function behind(prefix, lines) result(prefixed)
      character(len=*), intent(in) :: prefix, lines
      character(len=:), allocatable :: prefixed
      integer :: first, length
      prefixed = ''
      first = 1
      do while (first <= len(lines))
         length = index(lines(first:), newline)
         prefixed = prefixed//prefix//lines(first:first + length - 1)
         first = first + length
      end do
   end function behind

   !> What does not depend on the load of a bearing.
   function on_bearing(inputs, bearing) result(lines)
      type(case_type), intent(in) :: inputs
      type(bearing_type), intent(in) :: bearing
      character(len=:), allocatable :: lines
      lines = remark_on_speed(inputs%highest_speed(), bearing%journal_radius)//remark_on_clearance(bearing) &
         & //remarks_on_pads(bearing)
      if (any(preload(bearing) < 0)) lines = lines//'negative preload '//to_text(minval(preload(bearing))) &
         & //': the bore of the pads ' &
         & //'is tighter than the clearance at the pivots; such a pad touches the journal at its edges first'//newline
      if (.not. bearing%tilting() .and. any(abs(preload(bearing)) > 0)) lines = lines//'each lobe has a centre of ' &
         & //'its own: eccentricity ratio and attitude angle are about the centre of the bearing and over its ' &
         & //'clearance, so that they differ from those of a cylindrical bore'//newline
      associate (surface => inputs%highest_speed()*bearing%journal_radius)
         if (inputs%thermal%model == 'pad' .and. surface > compared_up_to) lines = lines//'surface speed ' &
            & //fixed_text(surface, 1)//' m/s: above '//to_text(compared_up_to)//' m/s a temperature for each pad ' &
            & //'shows trends, and stiffness may be off by more than 10 % (docs/warm_oil.md)'//newline
      end associate
   end function on_bearing

   !> Groups that the task of a case does not use, and what they say.
   function on_idle_groups(inputs, table) result(lines)
      type(case_type), intent(in) :: inputs
      type(variable_table_type), intent(in) :: table
      character(len=:), allocatable :: lines
      type(variable_table_type) :: defaults
      character(len=:), allocatable :: group, names
      integer :: i
      lines = ''
      if (size(inputs%excitations) > 0 .and. .not. inputs%moves()) lines = 'excitation: has no effect with ' &
         & //'case%task = '''//inputs%about%task//''', where no force changes with time'//newline
      call list_variables(case_type(), defaults)
      group = ''
      names = ''
      do i = 1, table%count
         associate (v => table%variables(i))
            if (v%group /= group) call say()
            if (.not. is_idle(inputs, v%group, v%name)) cycle
            ! where each pad has a value of its own, the default has as many as the paper's bearing has pads
            if (v%each /= '') then
               if (all(abs(v%values) <= 0)) cycle
            else
               if (lines_of(v, '') == lines_of(defaults%variables(defaults%find(v%group, v%name)), '')) cycle
            end if
            group = v%group
            names = names//', '//v%name
         end associate
      end do
      call say()
   contains
      !> The line of the group before.
      subroutine say()
         if (names == '') return
         lines = lines//group//' ('//names(3:)//'): has no effect with case%task = '''//inputs%about%task//''''//newline
         names = ''
      end subroutine say
   end function on_idle_groups

   !> Whether a variable has no effect with the task of a case.
   pure logical function is_idle(inputs, group, name)
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: group, name
      select case (group)
      case ('coefficients', 'branch')
         is_idle = inputs%about%task /= group
      case ('periodic')
         is_idle = .not. inputs%seeks_orbits()
      case ('start')
         is_idle = .not. inputs%moves()
      case ('integration', 'output')
         is_idle = inputs%about%task /= 'march' .and. any(name == [character(len=18) :: 'stop_when_periodic', &
            & 'start_time'])
      case default
         is_idle = .false.
      end select
   end function is_idle
end module case_remarks
