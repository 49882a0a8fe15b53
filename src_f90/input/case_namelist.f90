!> Case from namelist text. Each value is checked where it is read, so that the message can say where it stands.
module case_namelist
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, add_context, input_error
   use case_inputs, only: case_type, max_pads
   use case_checks, only: check_case
   use case_completion, only: leave_out, complete_case
   use field_visitor, only: visitor_type, field_type
   use case_fields, only: visit_case
   use case_parameter, only: check_branch_parameter
   use assignments, only: namelist_type, assignment_type, study_group
   use assigned_values, only: read_word, read_reals, refuse_values
   use variable_names, only: group_names, names_in, meant_variable, meant_group
   use namelist_text, only: parse_namelist
   implicit none (type, external)
   private
   public :: case_from_text, case_from_namelist, fill_case

   !> Fills a case from assignments, up to the first error.
   type, extends(visitor_type) :: case_reader
      type(namelist_type) :: namelist
      !> Assignments to a known variable, and groups that are known.
      logical, allocatable :: used(:), known_group(:)
      !> The group just visited.
      character(len=:), allocatable :: this_group
      integer :: pad_count = 0
      !> The assignment of the error, where its variable is unknown.
      integer :: unknown = 0
      type(error_type), allocatable :: error
   contains
      procedure :: group => visit_group
      procedure :: word => visit_word
      procedure :: whole => visit_whole
      procedure :: numbers => visit_numbers
      procedure :: per_pad => visit_per_pad
      procedure :: list => visit_list
      procedure, private :: look_up
      procedure, private :: check_unused
      procedure, private :: refuse_unknown_group
   end type case_reader

contains

   !> The case of a text, everything checked; a study is refused. `file` is for messages.
   subroutine case_from_text(text, file, inputs, error)
      character(len=*), intent(in) :: text, file
      type(case_type), intent(out) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(namelist_type) :: parsed
      integer :: i
      call parse_namelist(text, file, parsed, error)
      if (allocated(error)) return
      do i = 1, size(parsed%groups)
         if (parsed%groups(i)%group == study_group) call raise(error, input_error, parsed%groups(i)%origin &
            & //': a study, where one case is expected; tiltpad --check --run K prints those of a study')
      end do
      if (.not. allocated(error)) call case_from_namelist(parsed, inputs, error)
   end subroutine case_from_text

   !> The case of assignments, everything checked.
   subroutine case_from_namelist(parsed, inputs, error)
      type(namelist_type), intent(in) :: parsed
      type(case_type), intent(out) :: inputs
      type(error_type), allocatable, intent(out) :: error
      call fill_case(parsed, inputs, error)
      if (allocated(error)) return
      call complete_case(inputs, error)
      if (.not. allocated(error)) call check_case(inputs, error)
      if (.not. allocated(error)) call check_branch_parameter(inputs, error)
      call add_context(error, parsed%file)
   end subroutine case_from_namelist

   !> The case before `complete_case`: each value is checked by itself; what follows from other variables is left out.
   subroutine fill_case(parsed, inputs, error)
      type(namelist_type), intent(in) :: parsed
      type(case_type), intent(out) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(case_reader) :: reader
      integer :: i
      reader%namelist = parsed
      allocate (reader%used(size(parsed%assignments)), source=.false.)
      allocate (reader%known_group(size(parsed%groups)), source=.false.)
      reader%this_group = ''
      inputs = case_type()
      call leave_out(inputs)
      call visit_case(inputs, reader)
      call reader%group('', '')
      if (reader%unknown > 0) then
         associate (a => parsed%assignments(reader%unknown))
            call raise(reader%error, input_error, a%origin//': unknown variable '//a%group//'%'//a%name &
               & //meant_variable(a%group, a%name)//'; known:'//names_in(a%group))
         end associate
      end if
      do i = 1, size(parsed%groups)
         if (.not. reader%known_group(i)) call reader%refuse_unknown_group(parsed%groups(i), '&')
      end do
      do i = 1, size(parsed%assignments)
         if (.not. reader%used(i)) call reader%refuse_unknown_group(parsed%assignments(i), '')
      end do
      if (allocated(reader%error)) call move_alloc(reader%error, error)
   end subroutine fill_case

   subroutine visit_group(self, name, meaning)
      class(case_reader), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      integer :: i
      call self%check_unused()
      self%this_group = name
      do i = 1, size(self%namelist%groups)
         if (self%namelist%groups(i)%group == name) self%known_group(i) = .true.
      end do
   end subroutine visit_group

   !> Refuses what was assigned in the group just left to a variable that it does not have.
   subroutine check_unused(self)
      class(case_reader), intent(inout) :: self
      integer :: i
      do i = 1, size(self%used)
         if (allocated(self%error)) return
         associate (a => self%namelist%assignments(i))
            if (a%group /= self%this_group .or. self%used(i)) cycle
            ! in words after this walk along the variables, as proposals need another
            self%unknown = i
            call raise(self%error, input_error, '')
         end associate
      end do
   end subroutine check_unused

   !> Refuses an assignment or the start of a group; the message has `prefix` before the group's name.
   subroutine refuse_unknown_group(self, found, prefix)
      class(case_reader), intent(inout) :: self
      type(assignment_type), intent(in) :: found
      character(len=*), intent(in) :: prefix
      if (allocated(self%error)) return
      call raise(self%error, input_error, found%origin//': unknown group '//prefix//found%group &
         & //meant_group(found%group)//'; known:'//group_names())
   end subroutine refuse_unknown_group

   !> The assignments to a variable of this group, in their order; none after an error.
   subroutine look_up(self, field, found)
      class(case_reader), intent(inout) :: self
      type(field_type), intent(in) :: field
      type(assignment_type), allocatable, intent(out) :: found(:)
      integer :: i
      allocate (found(0))
      if (allocated(self%error)) return
      do i = 1, size(self%used)
         associate (a => self%namelist%assignments(i))
            if (a%group /= self%this_group .or. a%name /= field%name) cycle
            self%used(i) = .true.
            found = [found, a]
         end associate
      end do
   end subroutine look_up

   subroutine visit_word(self, value, field)
      class(case_reader), intent(inout) :: self
      character(len=:), allocatable, intent(inout) :: value
      type(field_type), intent(in) :: field
      type(assignment_type), allocatable :: found(:)
      integer :: i
      call self%look_up(field, found)
      do i = 1, size(found)
         call read_word(found(i), field, value, self%error)
         if (allocated(self%error)) return
      end do
   end subroutine visit_word

   subroutine visit_whole(self, value, field)
      class(case_reader), intent(inout) :: self
      integer, intent(inout) :: value
      type(field_type), intent(in) :: field
      type(assignment_type), allocatable :: found(:)
      real(wp), allocatable :: given(:)
      logical :: taken(1)
      integer :: i
      call self%look_up(field, found)
      taken = .false.
      do i = 1, size(found)
         call read_reals(found(i), 1, field, given, self%error)
         if (.not. allocated(self%error)) call take(found(i), size(given), taken, self%error)
         if (allocated(self%error)) return
         if (verify(found(i)%values(1)%text, '+-0123456789*') /= 0) then
            call refuse_values(found(i), 'must be a whole number, '//field%range_text(), self%error)
            return
         end if
         value = nint(given(1))
      end do
   end subroutine visit_whole

   subroutine visit_numbers(self, values, field)
      class(case_reader), intent(inout) :: self
      real(wp), intent(inout) :: values(:)
      type(field_type), intent(in) :: field
      type(assignment_type), allocatable :: found(:)
      real(wp), allocatable :: given(:)
      logical :: taken(size(values))
      integer :: i, first
      call self%look_up(field, found)
      taken = .false.
      do i = 1, size(found)
         call read_reals(found(i), size(values), field, given, self%error)
         if (.not. allocated(self%error)) call take(found(i), size(given), taken, self%error)
         if (allocated(self%error)) return
         if (found(i)%subscript == 0 .and. size(given) /= size(values)) then
            call refuse_values(found(i), 'takes '//to_text(size(values))//' values', self%error)
            return
         end if
         first = max(1, found(i)%subscript)
         values(first:first + size(given) - 1) = given
      end do
   end subroutine visit_numbers

   subroutine visit_per_pad(self, values, field)
      class(case_reader), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      type(field_type), intent(in) :: field
      type(assignment_type), allocatable :: found(:)
      real(wp), allocatable :: given(:)
      logical :: taken(max_pads)
      integer :: i, most
      call self%look_up(field, found)
      most = merge(max_pads, self%pad_count, field%fixes_pads)
      taken = .false.
      if (.not. field%fixes_pads) values = spread(values(1), 1, self%pad_count)
      do i = 1, size(found)
         call read_reals(found(i), most, field, given, self%error)
         if (.not. allocated(self%error)) call take(found(i), size(given), taken(:most), self%error)
         if (allocated(self%error)) exit
         if (field%fixes_pads) then
            if (found(i)%subscript > 0) call refuse_values(found(i), &
               & 'the number of angles is the number of pads; give all of them without subscript', self%error)
            values = given
         else if (found(i)%subscript > 0) then
            values(found(i)%subscript:found(i)%subscript + size(given) - 1) = given
         else if (size(given) == 1) then
            values = spread(given(1), 1, self%pad_count)
         else if (size(given) == self%pad_count) then
            values = given
         else
            call refuse_values(found(i), 'takes one value for all pads or one each ('//to_text(self%pad_count)//')', &
               & self%error)
         end if
         if (allocated(self%error)) exit
      end do
      if (field%fixes_pads) self%pad_count = size(values)
   end subroutine visit_per_pad

   subroutine visit_list(self, values, most, field)
      class(case_reader), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: most
      type(field_type), intent(in) :: field
      type(assignment_type), allocatable :: found(:)
      real(wp), allocatable :: given(:)
      integer :: i
      call self%look_up(field, found)
      do i = 1, size(found)
         call read_reals(found(i), most, field, given, self%error)
         if (.not. allocated(self%error) .and. found(i)%subscript > 0) call refuse_values(found(i), &
            & 'takes a list; give all of it without subscript', self%error)
         if (allocated(self%error)) return
         values = given
      end do
   end subroutine visit_list

   !> Marks the elements that an assignment of the file sets, and refuses those that were set before. An element may be
   !> set after the whole list, unless the list has only one. An assignment of --set may set anything again.
   subroutine take(a, count, taken, error)
      type(assignment_type), intent(in) :: a
      integer, intent(in) :: count
      logical, intent(inout) :: taken(:)
      type(error_type), allocatable, intent(inout) :: error
      if (a%overrides .or. a%subscript == 0 .and. size(taken) > 1) return
      associate (elements => taken(max(1, a%subscript):max(1, a%subscript) + count - 1))
         if (any(elements)) call refuse_values(a, 'given twice', error)
         elements = .true.
      end associate
   end subroutine take
end module case_namelist
