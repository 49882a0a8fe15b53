!> What --check prints: the resolved case, where each value comes from, and what follows from the values.
module checked_case
   use kinds, only: wp
   use text, only: to_text, fixed_text
   use errors, only: error_type
   use scene, only: scene_type
   use bearing_numbers, only: preload, clearance_ratio, length_over_diameter, load, specific_load, sommerfeld_number
   use result_size, only: result_bytes, sample_count
   use oil_properties, only: viscosity, kinematic_points
   use scene_completion, only: complete_scene
   use scene_fields, only: pads_variable
   use assignments, only: namelist_type
   use scene_namelist, only: fill_scene
   use namelist_writer, only: scene_text
   implicit none (type, external)
   private
   public :: marked_text, derived_text, notes

   character(len=*), parameter :: newline = achar(10)
   !> Column of the marks.
   integer, parameter :: column = 46
   !> Surface speed, m/s, up to which a temperature for each pad is close to those along and across the films.
   real(wp), parameter :: compared_up_to = 35
   !> Radius of a journal, m, beyond which inches may be meant.
   real(wp), parameter :: largest_usual = 1
   !> Temperatures of warm oil, C.
   real(wp), parameter :: warm(3) = [60.0_wp, 80.0_wp, 100.0_wp]

contains

   !> The text of a scene with a mark behind each value that its assignments do not give: a default, or derived from
   !> others.
   function marked_text(scene, parsed) result(text)
      type(scene_type), intent(in) :: scene
      type(namelist_type), intent(in) :: parsed
      character(len=:), allocatable :: text, left, line, defaults, group
      integer :: length
      left = scene_text(scene)
      defaults = default_text(parsed)
      text = ''
      group = ''
      do while (left /= '')
         length = index(left, newline)
         line = left(:length - 1)
         left = left(length + 1:)
         if (line(1:1) == '&') group = line(2:)
         if (line(1:1) == ' ' .and. .not. is_given(parsed, group, line)) then
            line = line//repeat(' ', max(2, column - len(line)))
            if (same_in(defaults, group, trim(line))) then
               line = line//'! default'
            else
               line = line//'! derived'
            end if
         end if
         text = text//line//newline
      end do
   end function marked_text

   !> The text of the paper's bearing with the pivots of the case.
   function default_text(parsed) result(text)
      type(namelist_type), intent(in) :: parsed
      character(len=:), allocatable :: text
      type(namelist_type) :: pivots
      type(scene_type) :: scene
      type(error_type), allocatable :: error
      integer :: i
      pivots%file = parsed%file
      allocate (pivots%groups(0))
      pivots%assignments = pack(parsed%assignments, [(parsed%assignments(i)%group//'%'//parsed%assignments(i)%name &
         & == pads_variable, i=1, size(parsed%assignments))])
      call fill_scene(pivots, scene, error)
      if (.not. allocated(error)) call complete_scene(scene, error)
      text = scene_text(scene)
   end function default_text

   !> True where the variable of a line, "  name = value" or "  name(2) = value", is assigned.
   pure logical function is_given(parsed, group, line)
      type(namelist_type), intent(in) :: parsed
      character(len=*), intent(in) :: group, line
      integer :: i
      is_given = .false.
      do i = 1, size(parsed%assignments)
         associate (a => parsed%assignments(i))
            if (a%group == group .and. a%name == line(3:scan(line, '(=') - 1)) is_given = .true.
         end associate
      end do
   end function is_given

   !> True where the group has the same line in another text.
   pure logical function same_in(text, group, line)
      character(len=*), intent(in) :: text, group, line
      integer :: start
      start = index(text, '&'//group//newline)
      same_in = index(text(start:start + index(text(start:), newline//'/'//newline)), newline//line//newline) > 0
   end function same_in

   !> What follows from a complete scene, as comments.
   function derived_text(scene) result(text)
      type(scene_type), intent(in) :: scene
      character(len=:), allocatable :: text
      text = '! derived values'//newline
      call say('preload', preload(scene), '1 - c_r/c_m')
      call say('clearance ratio', clearance_ratio(scene), 'c_r/R_J')
      call say('length ratio', length_over_diameter(scene), 'L/D')
      if (scene%rotor%balance_grade > 0) call say('unbalance', scene%unbalance(), 'kg m, by rotor%balance_grade')
      call say('load', load(scene), 'N, weight and static load')
      call say('specific load', specific_load(scene), 'Pa, W/(L D)')
      if (load(scene) > 0) call say('Sommerfeld number', sommerfeld_number(scene), &
         & 'mu N L D/W (R_J/c_r)^2, N in 1/s at the start')
      if (scene%oil%law /= 'constant') call say_oil()
      if (result_bytes(scene) > 0) call say('result', 0.1_wp*anint(result_bytes(scene)/1e5_wp), &
         & 'MB, '//to_text(sample_count(scene))//' samples')
      text = text//notes(scene, '! ')
   contains
      !> The oil's viscosity where it comes in and where it is warm.
      subroutine say_oil()
         integer :: i
         associate (oil => scene%oil, points => kinematic_points(scene%oil))
            call say('viscosity', viscosity(oil, oil%supply_temperature), 'Pa s at oil%supply_temperature = ' &
               & //to_text(oil%supply_temperature)//' C')
            do i = 1, size(warm)
               call say('viscosity', viscosity(oil, warm(i)), 'Pa s at '//to_text(warm(i))//' C')
            end do
            do i = 1, merge(2, 0, oil%grade > 0)
               call say('kinematic', points(i), 'm^2/s at '//to_text(oil%at_temperature(i))//' C')
            end do
         end associate
      end subroutine say_oil

      subroutine say(name, value, meaning)
         character(len=*), intent(in) :: name, meaning
         real(wp), intent(in) :: value
         character(len=18) :: padded
         padded = name
         text = text//'!   '//padded//' '//to_text(value)//'  '//meaning//newline
      end subroutine say
   end function derived_text

   !> What is allowed and seldom meant, a line each behind `mark`.
   function notes(scene, mark) result(text)
      type(scene_type), intent(in) :: scene
      character(len=*), intent(in) :: mark
      character(len=:), allocatable :: text
      text = line_of(length_note(scene))//line_of(preload_note(scene))//line_of(warm_note(scene))
   contains
      pure function line_of(note) result(line)
         character(len=*), intent(in) :: note
         character(len=:), allocatable :: line
         line = ''
         if (note /= '') line = mark//'note: '//note//newline
      end function line_of
   end function notes

   !> A word on a journal that is as large as one in inches; else empty.
   function length_note(scene) result(note)
      type(scene_type), intent(in) :: scene
      character(len=:), allocatable :: note
      note = ''
      if (scene%bearing%journal_radius > largest_usual) note = 'bearing%journal_radius = ' &
         & //to_text(scene%bearing%journal_radius)//': all lengths are in metres; an inch is 0.0254'
   end function length_note

   !> A word on a negative preload; else empty.
   function preload_note(scene) result(note)
      type(scene_type), intent(in) :: scene
      character(len=:), allocatable :: note
      note = ''
      if (preload(scene) < 0) note = 'negative preload '//to_text(preload(scene))//': the bore of the pads is ' &
         & //'tighter than the clearance at the pivots; such a pad touches the journal at its edges first'
   end function preload_note

   !> A word on a surface speed at which a temperature for each pad was not compared with more; else empty.
   function warm_note(scene) result(note)
      type(scene_type), intent(in) :: scene
      character(len=:), allocatable :: note
      real(wp) :: surface
      note = ''
      surface = scene%highest_speed()*scene%bearing%journal_radius
      if (scene%thermal%model /= 'none' .and. surface > compared_up_to) note = 'surface speed ' &
         & //fixed_text(surface, 1)//' m/s: above '//to_text(compared_up_to)//' m/s a temperature for each pad shows ' &
         & //'trends, and stiffness may be off by more than 10 % (docs/warm_oil.md)'
   end function warm_note
end module checked_case
