!> Which groups a case has of those that there may be several of: excitations, and of a machine discs, bearings with
!> their names and others. And what groups without a bearing's name say of all bearings.
module machine_structure
   use text, only: to_text, did_you_mean
   use errors, only: error_type, raise, refuse, input_error
   use case_inputs, only: case_type
   use excitations, only: make_excitations
   use case_groups, only: bearing_type, most_bearings
   use assignments, only: namelist_type, assignment_type, undoes, counted, of_bearing, kind_of, bearing_of, &
      & is_counted, may_have_bearing, naming_variable
   implicit none (type, external)
   private
   public :: make_several, give_to_bearings

   !> Groups that only a machine has, and the variable of another group.
   character(len=*), parameter :: of_machine = ' shaft disc unbalance load support reduction '
   character(len=*), parameter :: file_variable = 'rotor%file'

contains

   !> Gives a case its excitations and its machine, with default values, where its namelist has groups of them.
   subroutine make_several(parsed, inputs, error)
      type(namelist_type), intent(in) :: parsed
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      call make_excitations(count_of(parsed, 'excitation('), inputs%excitations)
      if (has_machine(parsed)) call make_machine(parsed, inputs, error)
      do i = 1, size(parsed%groups)
         call look_at(parsed%groups(i), inputs, error)
      end do
      do i = 1, size(parsed%assignments)
         call look_at(parsed%assignments(i), inputs, error)
      end do
   end subroutine make_several

   !> Groups whose names begin so.
   pure integer function count_of(parsed, beginning)
      type(namelist_type), intent(in) :: parsed
      character(len=*), intent(in) :: beginning
      integer :: k
      count_of = count([(index(parsed%groups(k)%group, beginning) == 1, k=1, size(parsed%groups))])
   end function count_of

   !> Gives a case its machine.
   subroutine make_machine(parsed, inputs, error)
      type(namelist_type), intent(in) :: parsed
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      integer :: i, b
      allocate (inputs%rotor%elastic)
      call inputs%rotor%elastic%begin(count_of(parsed, 'disc('), count_of(parsed, 'unbalance('), &
         & count_of(parsed, 'load('))
      deallocate (inputs%bearings)
      allocate (inputs%bearings(count_of(parsed, 'bearing:')))
      associate (groups => parsed%groups, bearings => inputs%bearings)
         if (size(bearings) > most_bearings) call refuse(parsed%file//': ' &
            & //to_text(size(bearings))//' groups &bearing with names; a machine has at most ' &
            & //to_text(most_bearings)//' bearings', error)
         b = 0
         do i = 1, size(groups)
            if (index(groups(i)%group, 'bearing:') /= 1) cycle
            b = b + 1
            bearings(b) = bearing_type()
            bearings(b)%name = bearing_of(groups(i)%group)
         end do
         do i = 1, size(groups)
            if (kind_of(groups(i)%group) == 'support') call put_support(bearing_of(groups(i)%group), bearings)
         end do
      end associate
   end subroutine make_machine

   !> Whether a namelist has a group or variable that only a machine has.
   pure logical function has_machine(parsed)
      type(namelist_type), intent(in) :: parsed
      integer :: i
      has_machine = .true.
      do i = 1, size(parsed%groups)
         if (is_of_machine(parsed%groups(i)%group)) return
      end do
      do i = 1, size(parsed%assignments)
         associate (a => parsed%assignments(i))
            if (is_of_machine(a%group) .or. a%group//'%'//a%name == file_variable) return
         end associate
      end do
      has_machine = .false.
   end function has_machine

   pure logical function is_of_machine(group)
      character(len=*), intent(in) :: group
      is_of_machine = index(group, ':') > 0 .or. index(of_machine, ' '//kind_of(group)//' ') > 0
   end function is_of_machine

   !> Puts the bearing of this name on a support; without a name all of them.
   subroutine put_support(name, bearings)
      character(len=*), intent(in) :: name
      type(bearing_type), intent(inout) :: bearings(:)
      integer :: b
      do b = 1, size(bearings)
         if (allocated(bearings(b)%support)) cycle
         if (name == '' .or. name == bearings(b)%name) allocate (bearings(b)%support)
      end do
   end subroutine put_support

   !> Refuses a group or an assignment of what the case does not have.
   subroutine look_at(a, inputs, error)
      type(assignment_type), intent(in) :: a
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: kind
      if (allocated(error)) return
      kind = kind_of(a%group)
      if (kind == 'excitation') then
         call look_at_number(a, kind, size(inputs%excitations), error)
      else if (.not. inputs%rotor%is_rigid()) then
         call look_at_part(a, kind, inputs, error)
      end if
   end subroutine look_at

   !> The same of what only a machine has.
   subroutine look_at_part(a, kind, inputs, error)
      type(assignment_type), intent(in) :: a
      character(len=*), intent(in) :: kind
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: name, names
      integer :: b
      name = bearing_of(a%group)
      if (kind == 'disc') call look_at_number(a, kind, size(inputs%rotor%elastic%discs), error)
      if (kind == 'unbalance') call look_at_number(a, kind, size(inputs%rotor%elastic%unbalances), error)
      if (kind == 'load') call look_at_number(a, kind, size(inputs%rotor%elastic%loads), error)
      if (kind == 'support' .and. name == '' .and. .not. any([(allocated(inputs%bearings(b)%support), &
         & b=1, size(inputs%bearings))])) call refuse(a%origin//': '//a%group//'%'//a%name &
         & //': the case has no group &support', error)
      if (a%group == 'bearing' .and. a%name == 'station') call refuse(a%origin//': bearing%station: must be in a ' &
         & //'group &bearing with a name, as each bearing has a station of its own', error)
      if (a%group /= kind .and. .not. is_counted(kind)) then
         if (.not. (may_have_bearing(kind) .and. name /= '' .and. a%group == kind//of_bearing(name))) then
            call refuse(a%origin//': unknown group '//a%group//'; the name of a bearing stands behind its own groups ' &
               & //'alone, as in pads:left', error)
         end if
      end if
      if (name == '' .or. allocated(error)) return
      names = ''
      do b = size(inputs%bearings), 1, -1
         if (inputs%bearings(b)%name == name) exit
         names = ' '//inputs%bearings(b)%name//names
      end do
      if (b == 0) then
         if (names == '') names = ' none'
         call raise(error, input_error, a%origin//': &'//kind//' '//naming_variable(kind)//' = '''//name &
            & //''': there is no group &bearing of this name'//did_you_mean(name, names)//'; there are:'//names)
      else if (kind == 'support' .and. .not. allocated(inputs%bearings(b)%support)) then
         call raise(error, input_error, a%origin//': '//a%group//'%'//a%name//': the case has no group &support of ' &
            & //'this bearing')
      end if
   end subroutine look_at_part

   !> Refuses the number of a group that there are fewer of.
   subroutine look_at_number(a, kind, number, error)
      type(assignment_type), intent(in) :: a
      character(len=*), intent(in) :: kind
      integer, intent(in) :: number
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: allowed
      integer :: i
      do i = 1, number
         if (a%group == kind//counted(i)) return
      end do
      allowed = kind//counted(1)//'%'//a%name
      if (number > 1) allowed = allowed//' to '//kind//counted(number)//'%'//a%name
      if (number == 0) then
         call raise(error, input_error, a%origin//': '//a%group//'%'//a%name//': the case has no group &'//kind)
      else
         call raise(error, input_error, a%origin//': '//a%group//'%'//a%name//': must be '//allowed &
            & //', as the case has '//to_text(number)//' of these groups')
      end if
   end subroutine look_at_number

   !> The assignments of a machine, where those to a group of all bearings are one to each: those of the case before the
   !> bearings' own, which take their place, those of --set in the order in which they are given.
   subroutine give_to_bearings(parsed, bearings, given)
      type(namelist_type), intent(in) :: parsed
      type(bearing_type), intent(in) :: bearings(:)
      type(namelist_type), intent(out) :: given
      type(assignment_type), allocatable :: longer(:)
      type(assignment_type) :: own
      logical :: defaults(size(parsed%assignments)), general(size(parsed%assignments))
      integer :: pass, k, b, n
      general = [(may_have_bearing(parsed%assignments(k)%group), k=1, size(general))]
      defaults = general .and. .not. parsed%assignments%overrides
      given%file = parsed%file
      given%groups = parsed%groups
      allocate (longer(size(general) + count(general)*max(0, size(bearings) - 1)))
      n = 0
      do pass = 1, 2
         do k = 1, size(general)
            if (defaults(k) .neqv. pass == 1) cycle
            do b = 1, merge(size(bearings), 1, general(k))
               own = parsed%assignments(k)
               if (general(k)) own%group = own%group//bearings(b)%suffix()
               own%of_all = defaults(k)
               if (is_undone(own, k)) cycle
               n = n + 1
               longer(n) = own
            end do
         end do
      end do
      ! one by one, as the compiler forgets to free what a constructor copies
      allocate (given%assignments(n))
      do k = 1, n
         given%assignments(k) = longer(k)
      end do
   contains
      !> Whether what follows gives all of it another value.
      pure logical function is_undone(own, k)
         type(assignment_type), intent(in) :: own
         integer, intent(in) :: k
         integer :: i
         is_undone = .false.
         if (.not. general(k)) return
         do i = 1, size(parsed%assignments)
            is_undone = undoes(parsed%assignments(i), own) .and. (i > k .or. defaults(k))
            if (is_undone) return
         end do
      end function is_undone
   end subroutine give_to_bearings
end module machine_structure
