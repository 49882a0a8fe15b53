!> Case files into assignments: their bytes, what the namelist text says and where, which assignment replaces which, and
!> what is refused.
program test_namelist_text
   use errors, only: error_type, input_error
   use assignments, only: namelist_type, assignment_text, assignment_type, token_type, put_assignment, undoes, &
      & target_text, value_text
   use namelist_text, only: read_text, parse_case, parse_namelist, parse_override
   use files, only: delete_file
   use scratch, only: scratch_path, write_bytes
   use text, only: to_text
   use check, only: runs, expect, expect_no_error, expect_error, report
   implicit none (type, external)
   character(len=:), allocatable :: path
   character(len=*), parameter :: newline = achar(10), return = achar(13), tab = achar(9)

   path = scratch_path('case.nml')
   if (runs('bytes')) call bytes()
   if (runs('longest')) call longest()
   if (runs('no_case')) call no_case()
   if (runs('overrides')) call overrides()
   if (runs('first_error')) call first_error()
   if (runs('plain')) call plain()
   if (runs('separators')) call separators()
   if (runs('quotes')) call quotes()
   if (runs('subscripts_and_repeats')) call subscripts_and_repeats()
   if (runs('endings')) call endings()
   if (runs('places')) call places()
   if (runs('overrides_text')) call overrides_text()
   if (runs('studies')) call studies()
   if (runs('refused')) call refused()
   if (runs('refused_overrides')) call refused_overrides()
   if (runs('one_undoes_another')) call one_undoes_another()
   if (runs('order')) call order()
   if (runs('elements_stay')) call elements_stay()
   if (runs('studies_keep_their_order')) call studies_keep_their_order()
   if (runs('texts')) call texts()
   call report()

contains

   !> What is read of a file with these bytes.
   subroutine read_back(bytes, text, error)
      character(len=*), intent(in) :: bytes
      character(len=:), allocatable, intent(out) :: text
      type(error_type), allocatable, intent(out) :: error
      call write_bytes(path, bytes)
      call read_text(path, text, error)
      call delete_file(path)
   end subroutine read_back

   subroutine expect_bytes(bytes, what)
      character(len=*), intent(in) :: bytes, what
      character(len=:), allocatable :: text
      type(error_type), allocatable :: error
      call read_back(bytes, text, error)
      call expect_no_error(error, what)
      if (allocated(error)) return
      call expect(len(text) == len(bytes), what//': all of it')
      if (len(text) == len(bytes)) call expect(text == bytes, what//': as it is')
   end subroutine expect_bytes

   subroutine bytes()
      call expect_bytes('', 'an empty file')
      call expect_bytes('&rotor mass = 1234 /', 'a file without a last line end')
      call expect_bytes('&a'//achar(13)//achar(10)//'/  '//achar(10)//achar(10), 'ends of lines and blanks')
      call expect_bytes(achar(0)//char(255)//achar(26)//'x', 'bytes that are no text')
   end subroutine bytes

   subroutine longest()
      character(len=:), allocatable :: text
      type(error_type), allocatable :: error
      call expect_bytes(repeat('!', 100000), 'the longest file')
      call read_back(repeat('!', 100001), text, error)
      call expect_error(error, input_error, path//': 100001 bytes; a case has at most 100000', 'a longer one')
   end subroutine longest

   subroutine no_case()
      character(len=:), allocatable :: text
      type(error_type), allocatable :: error
      call read_text('no/such/file.nml', text, error)
      call expect_error(error, input_error, 'no/such/file.nml: no such file', 'a missing file')
      call read_text('src_f90', text, error)
      call expect_error(error, input_error, 'src_f90: a directory, device or pipe', 'a folder')
      call read_text('/dev/null', text, error)
      call expect_error(error, input_error, '/dev/null: a directory, device or pipe', 'a device')
      call read_text('README.md ', text, error)
      call expect_error(error, input_error, 'README.md : the name of a case must not end in a blank', 'a last blank')
      call read_back(char(137)//'HDF'//char(13)//char(10)//char(26)//char(10)//repeat('x', 200000), text, error)
      call expect_error(error, input_error, path//': a result or study (an HDF5 file), where a case belongs', &
         & 'a result')
      call read_back(char(137)//'HD', text, error)
      call expect_no_error(error, 'three bytes')
   end subroutine no_case

   !> They stand behind what the file says, the last one behind the others.
   subroutine overrides()
      type(namelist_type) :: parsed
      type(error_type), allocatable :: error
      character(len=:), allocatable :: found
      integer :: i
      call parse_case('&a x = 1, y = 2 /', 'case.nml', [character(len=10) :: 'a%x=3', 'b%z=4', 'a%x=5'], parsed, error)
      call expect_no_error(error, 'overrides')
      if (allocated(error)) return
      found = ''
      do i = 1, size(parsed%assignments)
         found = found//assignment_text(parsed%assignments(i))//' '//parsed%assignments(i)%origin//'|'
      end do
      call expect(found == 'a%y = 2 case.nml line 1|b%z = 4 --set|a%x = 5 --set|', 'in their order: '//found)
      call expect(parsed%file == 'case.nml', 'the file for messages')
   end subroutine overrides

   !> The file's comes before that of an override, and no later override hides one.
   subroutine first_error()
      type(namelist_type) :: parsed
      type(error_type), allocatable :: error
      call parse_case('&a x /', 'case.nml', [character(len=10) :: 'nonsense'], parsed, error)
      call expect_error(error, input_error, 'case.nml line 1', 'the file''s')
      call parse_case('&a x=1 /', 'case.nml', [character(len=10) :: 'nonsense', 'a%x=2'], parsed, error)
      call expect_error(error, input_error, '--set nonsense', 'the first override''s')
   end subroutine first_error

   !> Parses text that must be good.
   subroutine parse(text, found)
      character(len=*), intent(in) :: text
      type(namelist_type), intent(out) :: found
      type(error_type), allocatable :: error
      call parse_namelist(text, 'case.nml', found, error)
      call expect_no_error(error, 'accepted: '//text)
   end subroutine parse

   !> The assignments as group%name=the values, joined by bars, quoted ones in quotes; semicolons between them.
   function as_text(found) result(text)
      type(namelist_type), intent(in) :: found
      character(len=:), allocatable :: text
      integer :: i, k
      text = ''
      do i = 1, size(found%assignments)
         associate (a => found%assignments(i))
            if (i > 1) text = text//'; '
            text = text//a%group//'%'//a%name
            if (a%subscript > 0) text = text//'('//to_text(a%subscript)//')'
            text = text//'='
            do k = 1, size(a%values)
               if (k > 1) text = text//'|'
               if (a%values(k)%quoted) then
                  text = text//'"'//a%values(k)%text//'"'
               else
                  text = text//a%values(k)%text
               end if
            end do
         end associate
      end do
   end function as_text

   !> The text is accepted and read as these assignments.
   subroutine expect_read(text, expected)
      character(len=*), intent(in) :: text, expected
      type(namelist_type) :: found
      call parse(text, found)
      call expect_text(as_text(found), expected)
   end subroutine expect_read

   subroutine plain()
      type(namelist_type) :: found
      call parse('&rotor mass = 2000 unbalance=0.01 /'//newline//'&film solver = ''sor'' /', found)
      call expect(size(found%groups) == 2 .and. size(found%assignments) == 3, 'two groups, three assignments')
      call expect(found%groups(1)%group == 'rotor' .and. found%groups(2)%group == 'film', 'names of groups')
      call expect_text(as_text(found), 'rotor%mass=2000; rotor%unbalance=0.01; film%solver="sor"')
      call parse('&film'//newline//'/'//newline, found)
      call expect(size(found%groups) == 1 .and. size(found%assignments) == 0, 'an empty group')
   end subroutine plain

   !> Blanks, tabs, commas, line ends of either kind, comments, capitals.
   subroutine separators()
      call expect_read('! head / & ''quote'//newline//'&ROTOR'//return//newline//tab//'Mass=1,'//return//newline &
         & //'static_LOAD = 1.0,'//tab//'2D0 ! a comment, with / and &end and = '//return//newline//'/' &
         & //return//newline, 'rotor%mass=1; rotor%static_load=1.0|2D0')
      call expect_read('&a x=1,y=2,/', 'a%x=1; a%y=2')
      call expect_read('&a x = 1 '//newline//' 2'//newline//',3'//newline//'y = 4/ &b z=5/', &
         & 'a%x=1|2|3; a%y=4; b%z=5')
      call expect_read('&a x = 1!comment'//newline//'/! the end', 'a%x=1')
   end subroutine separators

   !> Whatever stands in quotes is text; a doubled quote is one.
   subroutine quotes()
      call expect_read('&case title = ''a/b ! c & d = e, "f"'' task="it''s"/', &
         & 'case%title="a/b ! c & d = e, "f""; case%task="it''s"')
      call expect_read('&case title = ''it''''s ''''quoted'''''', b = "a""b", c = '''', d = '' two  blanks ''/', &
         & 'case%title="it''s ''quoted''"; case%b="a"b"; case%c=""; case%d=" two  blanks "')
   end subroutine quotes

   subroutine subscripts_and_repeats()
      call expect_read('&pads mass(2) = 0.9, arc_deg = 3*1.0, 2*69.3 pivot_ratio(1)=.5 pivot_ratio(02) = +5.E-1/', &
         & 'pads%mass(2)=0.9; pads%arc_deg=3*1.0|2*69.3; pads%pivot_ratio(1)=.5; pads%pivot_ratio(2)=+5.E-1')
   end subroutine subscripts_and_repeats

   subroutine endings()
      call expect_read('&a x=1 &end &b y=2 &END', 'a%x=1; b%y=2')
      call expect_read('&a x=1/,&b y=2/', 'a%x=1; b%y=2')
   end subroutine endings

   !> Every group and assignment knows its line.
   subroutine places()
      type(namelist_type) :: found
      call parse(newline//'! comment'//newline//'&a'//return//newline//'  x = 1,'//newline//'      2'//newline &
         & //'  y = ''z'' /', found)
      call expect(found%groups(1)%origin == 'case.nml line 3', 'line of the group: '//found%groups(1)%origin)
      call expect(found%assignments(1)%origin == 'case.nml line 4', 'line of x: '//found%assignments(1)%origin)
      call expect(found%assignments(2)%origin == 'case.nml line 6', 'line of y: '//found%assignments(2)%origin)
   end subroutine places

   !> An override takes the place of what the file says of the same element, and adds to the rest.
   subroutine overrides_text()
      type(namelist_type) :: found
      type(error_type), allocatable :: error
      call parse('&a x=1 y=2/', found)
      call parse_override('A%X = 3', found, error)
      call expect_no_error(error, 'an override')
      call expect(size(found%assignments) == 2, 'replaces')
      call expect_text(as_text(found), 'a%y=2; a%x=3')
      call expect(found%assignments(2)%origin == '--set', 'and says where it comes from')
      call parse_override('b%title=''a/b''', found, error)
      call expect_text(as_text(found), 'a%y=2; a%x=3; b%title="a/b"')
      call parse_override('a%y(2)=1,2', found, error)
      call expect_text(as_text(found), 'a%y=2; a%x=3; b%title="a/b"; a%y(2)=1|2')
      call expect(size(found%assignments) == 4, 'another element is another assignment')
      call parse('&a x(2)=5 y=2*1 /', found)
      call parse_override('a%x(2)=6', found, error)
      call expect(size(found%assignments) == 2, 'an element replaces itself')
      call parse('&a x(1)=5,6 y(1)=2*1 /', found)
      call parse_override('a%x(1)=7', found, error)
      call parse_override('a%y(1)=7', found, error)
      call expect(size(found%assignments) == 4, 'an element leaves the rest of a list')
   end subroutine overrides_text

   !> In &sweep a name is another group's variable, and an override keeps the rank of what it replaces.
   subroutine studies()
      type(namelist_type) :: found
      type(error_type), allocatable :: error
      call parse('&sweep order = ''zip'', a%x = 1:5:2, a%y(2) = 1:8:*2, 3 / &a x=1/', found)
      call expect_text(as_text(found), 'sweep%order="zip"; sweep%a%x=1:5:2; sweep%a%y(2)=1:8:*2|3; a%x=1')
      call parse_override('sweep%a%x=7,8', found, error)
      call expect(.not. allocated(error) .and. size(found%assignments) == 4, 'an override of a study')
      call expect_text(as_text(found), 'sweep%order="zip"; sweep%a%x=7|8; sweep%a%y(2)=1:8:*2|3; a%x=1')
      call parse_override('sweep%a%y(2)=9', found, error)
      call expect_text(as_text(found), 'sweep%order="zip"; sweep%a%x=7|8; sweep%a%y(2)=9; a%x=1')
      call parse_override('sweep%a%z=1', found, error)
      call expect_text(as_text(found), 'sweep%order="zip"; sweep%a%x=7|8; sweep%a%y(2)=9; a%x=1; sweep%a%z=1')
   end subroutine studies

   !> The message names file and line and has the words.
   subroutine expect_refused(text, words)
      character(len=*), intent(in) :: text, words
      type(namelist_type) :: found
      type(error_type), allocatable :: error
      call parse_namelist(text, 'case.nml', found, error)
      call expect_error(error, input_error, words, 'refused: '//text)
      if (allocated(error)) call expect(index(error%message, 'case.nml') == 1, 'names the file: '//error%message)
   end subroutine expect_refused

   subroutine refuse_each(texts, words)
      character(len=*), intent(in) :: texts(:), words
      integer :: i
      do i = 1, size(texts)
         call expect_refused(trim(texts(i)), words)
      end do
   end subroutine refuse_each

   subroutine refused()
      call refuse_each([character(len=14) :: '', '! nothing'//newline, ' '//newline//tab], 'no namelist group')
      call expect_refused('x = 1', 'outside a group')
      call expect_refused('&a x = 1', 'not closed by /')
      call expect_refused('&a'//newline//'x = 1'//newline//'&b y = 2 /', 'line 1: group &a is not closed')
      call expect_refused('&a /'//newline//'&A /', 'line 2: group &a is given twice, first at case.nml line 1')
      call expect_refused('&a x=1'//newline//'X=2/', 'line 2: a%x is given twice, first at case.nml line 1')
      call expect_refused('&a x(1)=1 x(01)=2/', 'given twice')
      call refuse_each([character(len=14) :: '&a x=/', '&a x= y=1/', '&a x=,1/', '&a x=1,,2/'], 'a value is missing')
      call refuse_each([character(len=14) :: '&a x/', '&a =1/', '&a x: 1/', '&a x()=1/', '&a x(-1)=1/', &
         & '&a x(1:2)=1/', '&a x(a)=1/', '&a x(1=1/', '&a x(99999)=1/', '&a b%c=1/'], 'expected name = value')
      call expect_refused('&a x(0)=1/', 'a%x(0): elements count from 1')
      call refuse_each([character(len=12) :: 'x=1 &a /', '&a / x=1', '{"a": {}}'], 'outside a group')
      call expect_refused('& x=1 /', 'group')
      call expect_refused('&a x == 1 /', 'a%x')
      call expect_refused('&a x=''open/', 'quote is not closed')
      call expect_refused('&a'//newline//'x=''open'//newline//'''/', 'line 2: a%x: the quote is not closed')
      call expect_refused('&a x=1'//achar(0)//'/', 'control character')
      call expect_refused('&a x=1 ! heavy'//return//' y=2 /'//newline//'/', 'byte 15 is a control character')
      call expect_refused('&a / /', '''/'' stands outside')
      call expect_refused('='//newline//'&a /', '''='' stands outside')
      call expect_short('&'//repeat('g', 5000)//' /', 'unknown group')
      call expect_short('&a '//repeat('v', 5000)//'=1 /', 'unknown variable')
      call expect_short('&a '//repeat('#', 5000)//'=1 /', 'expected name = value')
      call expect_short(repeat('x', 5000), 'outside a group')
      call expect_refused(char(137)//'HDF'//newline//return//newline//achar(26), 'not a text file')
   end subroutine refused

   !> Refused with the words in a message that is short though the text is long.
   subroutine expect_short(text, words)
      character(len=*), intent(in) :: text, words
      type(namelist_type) :: found
      type(error_type), allocatable :: error
      call parse_namelist(text, 'case.nml', found, error)
      call expect_error(error, input_error, words, 'refused: '//text(:10)//' ...')
      if (allocated(error)) call expect(len(error%message) < 300, 'in short: '//error%message)
   end subroutine expect_short

   subroutine refused_overrides()
      character(len=*), parameter :: wrong(*) = [character(len=12) :: 'x=1', '%x=1', 'a%x', 'a%=1', 'a%x=', &
         & 'a%x=1 y=2', 'a%x=1, y=2', 'a%x=1/ 2', 'a%x=1/ y=2', 'a%x=1/', '=a%x', 'a=b%c=3', 'a%x=''b']
      type(namelist_type) :: found
      type(error_type), allocatable :: error
      integer :: i
      call parse('&a x=1/', found)
      do i = 1, size(wrong)
         call parse_override(trim(wrong(i)), found, error)
         call expect_error(error, input_error, '--set ', 'refused: --set '//trim(wrong(i)))
      end do
      call parse_override('a%x='''//achar(27)//'[2J''', found, error)
      call expect(allocated(error), 'refused: a control character')
      call parse_override('a%x='''//return//'''', found, error)
      call expect(allocated(error), 'refused: a carriage return')
      call parse_override(repeat('x', 5000), found, error)
      call expect(allocated(error), 'refused: a long argument')
      if (allocated(error)) call expect(len(error%message) < 300, 'in short: '//error%message)
      call expect(size(found%assignments) == 1, 'and changes nothing')
   end subroutine refused_overrides

   !> An assignment of unquoted values, separated by blanks.
   function assigned(group, name, subscript, values) result(a)
      character(len=*), intent(in) :: group, name, values
      integer, intent(in) :: subscript
      type(assignment_type) :: a
      type(token_type) :: token
      character(len=:), allocatable :: rest
      integer :: blank
      a%group = group
      a%name = name
      a%subscript = subscript
      a%origin = 'here'
      allocate (a%values(0))
      rest = values//' '
      do while (rest /= '')
         blank = index(rest, ' ')
         token%text = rest(:blank - 1)
         a%values = [a%values, token]
         rest = rest(blank + 1:)
      end do
   end function assigned

   !> Puts one after another; all of them as text, with bars between them.
   function put(these) result(text)
      type(assignment_type), intent(in) :: these(:)
      character(len=:), allocatable :: text
      type(namelist_type) :: parsed
      integer :: i
      allocate (parsed%groups(0), parsed%assignments(0))
      do i = 1, size(these)
         call put_assignment(these(i), parsed)
      end do
      text = ''
      do i = 1, size(parsed%assignments)
         text = text//assignment_text(parsed%assignments(i))//'|'
      end do
   end function put

   subroutine expect_text(found, expected)
      character(len=*), intent(in) :: found, expected
      call expect(found == expected .and. len(found) == len(expected), expected//' came out as '//found)
   end subroutine expect_text

   subroutine one_undoes_another()
      type(assignment_type) :: whole, second, third
      whole = assigned('pads', 'mass', 0, '1 2 3')
      second = assigned('pads', 'mass', 2, '4')
      third = assigned('pads', 'mass', 3, '5')
      call expect(undoes(whole, second) .and. undoes(whole, whole), 'the whole undoes an element, and the whole')
      call expect(.not. undoes(second, whole), 'an element does not undo the whole')
      call expect(undoes(second, second) .and. .not. undoes(second, third), 'an element undoes itself alone')
      call expect(.not. undoes(whole, assigned('rotor', 'mass', 0, '1')), 'a variable of another group')
      call expect(.not. undoes(whole, assigned('pads', 'inertia', 0, '1')), 'another variable of the group')
   end subroutine one_undoes_another

   !> What comes later stands behind all others; what it replaces is gone.
   subroutine order()
      call expect_text(put([assigned('a', 'x', 0, '1'), assigned('b', 'y', 0, '2'), assigned('a', 'x', 0, '3')]), &
         & 'b%y = 2|a%x = 3|')
      call expect_text(put([assigned('a', 'x', 2, '1'), assigned('a', 'x', 1, '2'), assigned('a', 'x', 0, '3 4')]), &
         & 'a%x = 3, 4|')
      call expect_text(put([assigned('a', 'x', 2, '1'), assigned('a', 'x', 2, '3')]), 'a%x(2) = 3|')
   end subroutine order

   !> An element replaces one value, but not a list that starts there.
   subroutine elements_stay()
      call expect_text(put([assigned('a', 'x', 2, '1 5'), assigned('a', 'x', 2, '3')]), 'a%x(2) = 1, 5|a%x(2) = 3|')
      call expect_text(put([assigned('a', 'x', 2, '2*1'), assigned('a', 'x', 2, '3')]), 'a%x(2) = 2*1|a%x(2) = 3|')
      call expect_text(put([assigned('a', 'x', 0, '1 5'), assigned('a', 'x', 1, '3')]), 'a%x = 1, 5|a%x(1) = 3|')
   end subroutine elements_stay

   !> Their order is that of the runs.
   subroutine studies_keep_their_order()
      call expect_text(put([assigned('sweep', 'a%x', 0, '1 2'), assigned('sweep', 'a%y', 0, '3'), &
         & assigned('sweep', 'a%x', 0, '4 5 6')]), 'sweep%a%x = 4, 5, 6|sweep%a%y = 3|')
      call expect_text(put([assigned('sweep', 'a%y', 0, '3'), assigned('sweep', 'a%x', 0, '4')]), &
         & 'sweep%a%y = 3|sweep%a%x = 4|')
      call expect_text(put([assigned('sweep', 'a%y', 2, '3 4'), assigned('sweep', 'a%y', 2, '5')]), 'sweep%a%y(2) = 5|')
   end subroutine studies_keep_their_order

   subroutine texts()
      call expect_text(target_text(assigned('pads', 'mass', 0, '1')), 'pads%mass')
      call expect_text(target_text(assigned('pads', 'mass', 12, '1')), 'pads%mass(12)')
      call expect_text(assignment_text(assigned('a', 'x', 0, '1 2 3 4')), 'a%x = 1, 2, 3, 4')
      call expect_text(assignment_text(assigned('a', 'x', 3, '1 2 3 4 5')), 'a%x(3) = 1, 2, 3, 4, ... (5 values)')
      call expect(len(assignment_text(assigned('a', 'x', 0, repeat('1', 10000)))) < 200, 'a long value is cut')
      call expect_text(value_text(token_type('it''s', quoted=.true.)), '''it''''s''')
      call expect_text(value_text(token_type('it''s', quoted=.false.)), 'it''s')
      call expect_text(value_text(token_type('', quoted=.true.)), '''''')
   end subroutine texts
end program test_namelist_text
