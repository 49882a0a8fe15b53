!> How assignments name the groups of a machine that a case has several times: disc(2) is the second group &disc,
!> pads:drive_end the group &pads of the bearing drive_end; pads alone is that of all bearings.
module machine_names
   use text, only: to_text, replaced
   implicit none (type, external)
   private
   public :: counted, of_bearing, kind_of, bearing_of, is_counted, may_have_bearing, naming_variable, group_heading
   public :: identifier_of, is_name, is_spelled, longest_bearing

   !> Groups of what there may be several of on a rotor, and of each bearing.
   character(len=*), parameter :: several = ' disc unbalance load excitation '
   character(len=*), parameter :: of_bearings = ' bearing support oil pads pivot friction asperity film '
   character(len=*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz'
   !> Longest name of a bearing.
   integer, parameter :: longest_bearing = 30

contains

   !> Behind the name of a group: "(2)".
   pure function counted(number) result(text)
      integer, intent(in) :: number
      character(len=:), allocatable :: text
      text = '('//to_text(number)//')'
   end function counted

   !> Behind the name of a group: ":drive_end".
   pure function of_bearing(name) result(text)
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: text
      text = ':'//name
   end function of_bearing

   !> "disc" of disc(2), "pads" of pads:drive_end.
   pure function kind_of(group) result(kind)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: kind
      kind = group(:scan(group//':', ':(') - 1)
   end function kind_of

   !> "drive_end" of pads:drive_end; empty where it is the group of no bearing, or of all.
   pure function bearing_of(group) result(name)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: name
      name = group(min(len(group) + 1, index(group//':', ':') + 1):)
   end function bearing_of

   !> Whether groups of this kind have numbers.
   pure logical function is_counted(kind)
      character(len=*), intent(in) :: kind
      is_counted = index(several, ' '//kind//' ') > 0
   end function is_counted

   !> Whether each bearing may have a group of this kind.
   pure logical function may_have_bearing(kind)
      character(len=*), intent(in) :: kind
      may_have_bearing = index(of_bearings, ' '//kind//' ') > 0
   end function may_have_bearing

   !> What names the bearing in a group of this kind: "name" in &bearing itself.
   pure function naming_variable(kind) result(name)
      character(len=*), intent(in) :: kind
      character(len=:), allocatable :: name
      name = 'bearing'
      if (kind == 'bearing') name = 'name'
   end function naming_variable

   !> The start of a group in a case, and the line that names its bearing.
   pure function group_heading(group) result(text)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: text
      text = '&'//kind_of(group)//new_line('a')
      if (bearing_of(group) /= '') text = text//'  '//naming_variable(kind_of(group))//' = '''//bearing_of(group) &
         & //''''//new_line('a')
   end function group_heading

   !> "pads_drive_end" of pads:drive_end, "disc_2" of disc(2).
   pure function identifier_of(group) result(text)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: text
      text = replaced(replaced(replaced(group, ':', '_'), '(', '_'), ')', '')
   end function identifier_of

   !> Whether a bearing may have this name: letters, digits and underscores behind a letter.
   pure logical function is_name(name)
      character(len=*), intent(in) :: name
      is_name = len(name) > 0 .and. len(name) <= longest_bearing .and. verify(name, letters//'0123456789_') == 0
      if (is_name) is_name = index(letters, name(1:1)) > 0
   end function is_name

   !> Whether a group is spelled as one: alone, with a number, disc(2), or with the name of a bearing, pads:drive_end,
   !> where there are such groups of its kind.
   pure logical function is_spelled(group)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: kind, number
      kind = kind_of(group)
      is_spelled = kind == group
      if (index(group, ':') > 0) is_spelled = may_have_bearing(kind) .and. is_name(bearing_of(group))
      if (index(group, '(') /= len(kind) + 1) return
      number = group(len(kind) + 2:max(len(group) - 1, len(kind) + 1))
      is_spelled = is_counted(kind) .and. group == kind//'('//number//')' .and. number /= '' &
         & .and. verify(number, '0123456789') == 0
   end function is_spelled
end module machine_names
