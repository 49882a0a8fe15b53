!> Scene from namelist text. Values are checked where they are read, so that the message can
!> name file, line, group, variable, value and what is allowed.
module scene_namelist
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use text, only: to_text, lower_case, is_utf8
   use errors, only: error_type, raise, add_context, input_error
   use scene, only: scene_type, max_pads
   use scene_fields, only: field_visitor, range_type, visit_scene
   use number_syntax, only: is_special, read_number
   use assignments, only: namelist_type, assignment_type, assignment_text, sweep_group
   use case_text, only: parse_case
   implicit none (type, external)
   private
   public :: scene_from_text, scene_from_namelist, fill_scene

   !> Longest text in it, bytes.
   integer, parameter :: longest_text = 1000

   !> Fills a scene from assignments.
   type, extends(field_visitor) :: scene_reader
      type(namelist_type) :: namelist
      logical, allocatable :: used(:), known_group(:)
      character(len=:), allocatable :: this_group, groups, variables
      integer :: pad_count = 0
      type(error_type), allocatable :: error
   contains
      procedure :: group => read_group
      procedure :: word => read_word
      procedure :: whole => read_whole
      procedure :: numbers => read_numbers
      procedure :: per_pad => read_per_pad
      procedure, private :: check_unused
      procedure, private :: reals
      procedure, private :: take
      procedure, private :: refuse
   end type scene_reader

contains

   !> The scene of a case's text, everything checked; a sweep is refused.
   subroutine scene_from_text(text, file, overrides, scene, error)
      character(len=*), intent(in) :: text, file, overrides(:)
      type(scene_type), intent(out) :: scene
      type(error_type), allocatable, intent(out) :: error
      type(namelist_type) :: parsed
      integer :: i
      call parse_case(text, file, overrides, parsed, error)
      if (allocated(error)) return
      do i = 1, size(parsed%groups)
         if (parsed%groups(i)%group == sweep_group) call raise(error, input_error, parsed%groups(i)%place &
            & //': a sweep, where one scene is expected; tiltpad --check --member K prints those of a sweep')
      end do
      if (.not. allocated(error)) call scene_from_namelist(parsed, scene, error)
   end subroutine scene_from_text

   !> The scene of assignments, everything checked.
   subroutine scene_from_namelist(parsed, scene, error)
      type(namelist_type), intent(in) :: parsed
      type(scene_type), intent(out) :: scene
      type(error_type), allocatable, intent(out) :: error
      call fill_scene(parsed, scene, error)
      if (allocated(error)) return
      call scene%settle()
      call scene%validate(error)
      call add_context(error, parsed%file)
   end subroutine scene_from_namelist

   !> The same before `settle`: each value is checked by itself, and one that stands for another's is kept.
   subroutine fill_scene(parsed, scene, error)
      type(namelist_type), intent(in) :: parsed
      type(scene_type), intent(out) :: scene
      type(error_type), allocatable, intent(out) :: error
      type(scene_reader) :: reader
      integer :: i
      reader%namelist = parsed
      allocate (reader%used(size(reader%namelist%assignments)), source=.false.)
      allocate (reader%known_group(size(reader%namelist%groups)), source=.false.)
      reader%this_group = ''
      reader%groups = ''
      scene = scene_type()
      scene%operation%final_speed_rpm = -1
      call visit_scene(scene, reader)
      call reader%group('', '')
      do i = 1, size(reader%namelist%groups)
         if (.not. reader%known_group(i)) call reader%refuse(reader%namelist%groups(i)%place//': unknown group &' &
            & //reader%namelist%groups(i)%group//'; known:'//reader%groups)
      end do
      do i = 1, size(reader%used)
         if (.not. reader%used(i)) call reader%refuse(reader%namelist%assignments(i)%place//': unknown group ' &
            & //reader%namelist%assignments(i)%group//'; known:'//reader%groups)
      end do
      if (allocated(reader%error)) call move_alloc(reader%error, error)
   end subroutine fill_scene

   !> Keeps the first error.
   subroutine refuse(self, message)
      class(scene_reader), intent(inout) :: self
      character(len=*), intent(in) :: message
      if (.not. allocated(self%error)) call raise(self%error, input_error, message)
   end subroutine refuse

   subroutine read_group(self, name, meaning)
      class(scene_reader), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      integer :: i
      call self%check_unused()
      self%this_group = name
      self%variables = ''
      self%groups = self%groups//' '//name
      do i = 1, size(self%namelist%groups)
         if (self%namelist%groups(i)%group == name) self%known_group(i) = .true.
      end do
   end subroutine read_group

   !> Refuses what was assigned in the group just left and not asked for.
   subroutine check_unused(self)
      class(scene_reader), intent(inout) :: self
      integer :: i
      do i = 1, size(self%used)
         associate (a => self%namelist%assignments(i))
            if (a%group /= self%this_group .or. self%used(i)) cycle
            call self%refuse(a%place//': unknown variable '//a%group//'%'//a%name//'; known:'//self%variables)
            self%used(i) = .true.
         end associate
      end do
   end subroutine check_unused

   subroutine read_word(self, name, value, choices, meaning)
      class(scene_reader), intent(inout) :: self
      character(len=*), intent(in) :: name, choices, meaning
      character(len=:), allocatable, intent(inout) :: value
      character(len=:), allocatable :: found
      integer :: i
      self%variables = self%variables//' '//name
      do i = 1, size(self%used)
         associate (a => self%namelist%assignments(i))
            if (a%group /= self%this_group .or. a%name /= name) cycle
            self%used(i) = .true.
            found = a%values(1)%text
            if (choices /= '') found = lower_case(trim(adjustl(found)))
            if (size(a%values) > 1 .or. a%subscript > 0) then
               call self%refuse(a%place//': '//assignment_text(a)//': takes one text')
            else if (choices /= '' .and. .not. is_choice(found, choices)) then
               call self%refuse(a%place//': '//assignment_text(a)//': must be one of '''//quoted_list(choices)//'''')
            else if (choices == '' .and. .not. a%values(1)%quoted) then
               call self%refuse(a%place//': '//assignment_text(a)//': text must stand in quotes')
            else if (len(found) > longest_text) then
               call self%refuse(a%place//': '//a%group//'%'//a%name//': '//to_text(len(found)) &
                  & //' characters; a text has at most '//to_text(longest_text))
            else if (.not. is_utf8(found)) then
               call self%refuse(a%place//': '//assignment_text(a)//': must be UTF-8 text')
            end if
            value = found
         end associate
      end do
   end subroutine read_word

   subroutine read_whole(self, name, value, allowed, meaning)
      class(scene_reader), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      integer, intent(inout) :: value
      type(range_type), intent(in) :: allowed
      real(wp), allocatable :: given(:)
      logical :: taken(1)
      integer :: i
      self%variables = self%variables//' '//name
      taken = .false.
      do i = 1, size(self%used)
         associate (a => self%namelist%assignments(i))
            if (a%group /= self%this_group .or. a%name /= name) cycle
            self%used(i) = .true.
            call self%reals(a, 1, allowed, given)
            call self%take(a, size(given), taken)
            if (allocated(self%error)) return
            if (verify(a%values(1)%text, '+-0123456789*') /= 0) then
               call self%refuse(a%place//': '//assignment_text(a)//': must be a whole number, '//allowed%text())
               return
            end if
            value = nint(given(1))
         end associate
      end do
   end subroutine read_whole

   subroutine read_numbers(self, name, values, allowed, unit, meaning)
      class(scene_reader), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, meaning
      real(wp), intent(inout) :: values(:)
      type(range_type), intent(in) :: allowed
      real(wp), allocatable :: given(:)
      logical :: taken(size(values))
      integer :: i
      self%variables = self%variables//' '//name
      taken = .false.
      do i = 1, size(self%used)
         associate (a => self%namelist%assignments(i))
            if (a%group /= self%this_group .or. a%name /= name) cycle
            self%used(i) = .true.
            call self%reals(a, size(values), allowed, given)
            call self%take(a, size(given), taken)
            if (allocated(self%error)) return
            if (a%subscript == 0 .and. size(given) /= size(values)) then
               call self%refuse(a%place//': '//assignment_text(a)//': takes '//to_text(size(values))//' values')
               return
            end if
            values(max(1, a%subscript):max(1, a%subscript) + size(given) - 1) = given
         end associate
      end do
   end subroutine read_numbers

   subroutine read_per_pad(self, name, values, fixes_pads, allowed, unit, meaning)
      class(scene_reader), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, meaning
      real(wp), allocatable, intent(inout) :: values(:)
      logical, intent(in) :: fixes_pads
      type(range_type), intent(in) :: allowed
      real(wp), allocatable :: given(:)
      logical :: taken(max_pads)
      integer :: i, most
      self%variables = self%variables//' '//name
      most = merge(max_pads, self%pad_count, fixes_pads)
      taken = .false.
      if (.not. fixes_pads) values = spread(values(1), 1, self%pad_count)
      do i = 1, size(self%used)
         associate (a => self%namelist%assignments(i))
            if (a%group /= self%this_group .or. a%name /= name) cycle
            self%used(i) = .true.
            call self%reals(a, most, allowed, given)
            call self%take(a, size(given), taken(:most))
            if (allocated(self%error)) exit
            if (fixes_pads) then
               if (a%subscript > 0) call self%refuse(a%place//': '//assignment_text(a) &
                  & //': the number of angles is the number of pads; give all of them without subscript')
               values = given
            else if (a%subscript > 0) then
               values(a%subscript:a%subscript + size(given) - 1) = given
            else if (size(given) == 1) then
               values = spread(given(1), 1, self%pad_count)
            else if (size(given) == self%pad_count) then
               values = given
            else
               call self%refuse(a%place//': '//assignment_text(a)//': takes one value for all pads or one each (' &
                  & //to_text(self%pad_count)//')')
            end if
         end associate
      end do
      if (fixes_pads) self%pad_count = size(values)
   end subroutine read_per_pad

   !> The values of an assignment as reals, each within the range; at most `most` up to the last element.
   subroutine reals(self, a, most, allowed, values)
      class(scene_reader), intent(inout) :: self
      type(assignment_type), intent(in) :: a
      integer, intent(in) :: most
      type(range_type), intent(in) :: allowed
      real(wp), allocatable, intent(out) :: values(:)
      real(wp) :: x
      integer :: i, star, repeat, status
      logical :: ok
      character(len=:), allocatable :: digits
      allocate (values(0))
      do i = 1, size(a%values)
         digits = lower_case(a%values(i)%text)
         star = index(digits, '*')
         repeat = 1
         status = 0
         if (star > 0) then
            if (star == 1 .or. star > 7 .or. verify(digits(:star - 1), '0123456789') /= 0) then
               status = 1
            else
               read (digits(:star - 1), *) repeat
               if (repeat < 1) status = 1
            end if
            digits = digits(star + 1:)
         end if
         if (.not. a%values(i)%quoted .and. is_special(digits)) then
            call self%refuse(a%place//': '//assignment_text(a)//': must be finite, '//allowed%text())
            return
         end if
         call read_number(digits, x, ok)
         if (status /= 0 .or. a%values(i)%quoted .or. .not. ok) then
            call self%refuse(a%place//': '//assignment_text(a)//': must be a number, '//allowed%text())
            return
         end if
         if (.not. ieee_is_finite(x)) then
            call self%refuse(a%place//': '//assignment_text(a)//': must be finite, '//allowed%text())
            return
         end if
         if (.not. allowed%allows(x)) then
            call self%refuse(a%place//': '//assignment_text(a)//': must be '//allowed%text())
            return
         end if
         if (max(1, a%subscript) - 1 + size(values) + repeat > most) then
            call self%refuse(a%place//': '//assignment_text(a)//': at most '//to_text(most)//' values')
            return
         end if
         values = [values, spread(x, 1, repeat)]
      end do
   end subroutine reals

   !> Notes which elements an assignment of the file takes for good, and refuses those taken before. Elements may
   !> follow the whole list; where the list is one element, that gives it twice. What --set says comes last.
   subroutine take(self, a, count, taken)
      class(scene_reader), intent(inout) :: self
      type(assignment_type), intent(in) :: a
      integer, intent(in) :: count
      logical, intent(inout) :: taken(:)
      if (allocated(self%error) .or. a%overrides .or. a%subscript == 0 .and. size(taken) > 1) return
      associate (elements => taken(max(1, a%subscript):max(1, a%subscript) + count - 1))
         if (any(elements)) call self%refuse(a%place//': '//assignment_text(a)//': given twice')
         elements = .true.
      end associate
   end subroutine take

   !> True for one of the words that `choices` lists, separated by blanks.
   pure logical function is_choice(word, choices)
      character(len=*), intent(in) :: word, choices
      is_choice = scan(word, ' ') == 0 .and. index(' '//choices//' ', ' '//word//' ') > 0
   end function is_choice

   !> "a b" to "a', 'b".
   pure function quoted_list(choices) result(list)
      character(len=*), intent(in) :: choices
      character(len=:), allocatable :: list
      integer :: i
      list = ''
      do i = 1, len(choices)
         if (choices(i:i) == ' ') then
            list = list//''', '''
         else
            list = list//choices(i:i)
         end if
      end do
   end function quoted_list
end module scene_namelist
