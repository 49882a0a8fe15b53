!> The names of all input variables, and what a wrong name may stand for.
module variable_names
   use text, only: find_similar, did_you_mean
   use kinds, only: wp
   use former_names, only: new_name
   use case_inputs, only: case_type
   use field_visitor, only: visitor_type, field_type
   use case_fields, only: visit_case
   implicit none (type, external)
   private
   public :: group_names, names_in, meant_variable, meant_group

   !> Writes the names down.
   type, extends(visitor_type) :: name_collector
      !> The group just visited; all groups, and all variables as group%name, each with a blank before it.
      character(len=:), allocatable :: this_group, groups, variables
   contains
      procedure :: group => note_group
      procedure :: word => note_word
      procedure :: whole => note_whole
      procedure :: numbers => note_numbers
      procedure :: per_pad => note_per_pad
      procedure :: list => note_list
      procedure, private :: note
   end type name_collector

contains

   !> The groups, each with a blank before it.
   function group_names() result(names)
      character(len=:), allocatable :: names
      type(name_collector) :: all
      call collect(all)
      names = all%groups
   end function group_names

   !> The variables of a group, each with a blank before it.
   function names_in(group) result(names)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: names, known
      integer :: start
      known = all_variables()//' '
      names = ''
      start = index(known, ' '//group//'%')
      do while (start > 0)
         known = known(start + len(group) + 2:)
         names = names//' '//known(:index(known, ' ') - 1)
         start = index(known, ' '//group//'%')
      end do
   end function names_in

   !> " (did you mean rotor%mass?)" for a variable that its group does not have; the group may be empty or unknown.
   !> For the former name of a variable its new one.
   function meant_variable(group, name) result(text)
      character(len=*), intent(in) :: group, name
      character(len=:), allocatable :: text, own, other
      integer :: own_score, other_score
      call find_similar(name, names_in(group), own, own_score)
      call find_similar(name, all_variables(), other, other_score)
      text = new_name(group//'%'//name)
      if (text /= '') return
      if (own /= '' .and. own_score <= other_score) then
         text = did_you_mean(name, names_in(group))
      else if (other /= '') then
         text = ' (did you mean '//other//'?)'
      end if
   end function meant_variable

   !> " (did you mean rotor?)" for a group that does not exist.
   function meant_group(group) result(text)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: text
      text = did_you_mean(group, group_names()//' sweep')
   end function meant_group

   function all_variables() result(names)
      character(len=:), allocatable :: names
      type(name_collector) :: all
      call collect(all)
      names = all%variables
   end function all_variables

   subroutine collect(all)
      type(name_collector), intent(out) :: all
      type(case_type) :: inputs
      all%groups = ''
      all%variables = ''
      inputs = case_type()
      call visit_case(inputs, all)
   end subroutine collect

   subroutine note_group(self, name, meaning)
      class(name_collector), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      self%this_group = name
      self%groups = self%groups//' '//name
   end subroutine note_group

   subroutine note(self, field)
      class(name_collector), intent(inout) :: self
      type(field_type), intent(in) :: field
      self%variables = self%variables//' '//self%this_group//'%'//field%name
   end subroutine note

   subroutine note_word(self, value, field)
      class(name_collector), intent(inout) :: self
      character(len=:), allocatable, intent(inout) :: value
      type(field_type), intent(in) :: field
      call self%note(field)
   end subroutine note_word

   subroutine note_whole(self, value, field)
      class(name_collector), intent(inout) :: self
      integer, intent(inout) :: value
      type(field_type), intent(in) :: field
      call self%note(field)
   end subroutine note_whole

   subroutine note_numbers(self, values, field)
      class(name_collector), intent(inout) :: self
      real(wp), intent(inout) :: values(:)
      type(field_type), intent(in) :: field
      call self%note(field)
   end subroutine note_numbers

   subroutine note_per_pad(self, values, field)
      class(name_collector), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      type(field_type), intent(in) :: field
      call self%note(field)
   end subroutine note_per_pad

   subroutine note_list(self, values, most, field)
      class(name_collector), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: most
      type(field_type), intent(in) :: field
      call self%note(field)
   end subroutine note_list
end module variable_names
