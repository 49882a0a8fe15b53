!> Tables of the values of a study: which texts are tables and what their values are, what is refused and where, and
!> the studies of tables beside lists and ranges.
program test_study_table
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, input_error
   use assignments, only: token_type, target_text, value_text
   use case_inputs, only: case_type
   use study_variables, only: study_table_type, read_table
   use parameter_study, only: study_type, run_tag, study_from_text
   use scratch, only: scratch_path, write_bytes
   use files, only: delete_file, real_path
   use check, only: runs, expect, expect_close, expect_no_error, expect_error, report
   implicit none (type, external)
   character(len=*), parameter :: newline = achar(10), crlf = achar(13)//achar(10)

   if (runs('spellings')) call spellings()
   if (runs('texts')) call texts()
   if (runs('names')) call names()
   if (runs('rows')) call rows()
   if (runs('cells')) call cells()
   if (runs('no_files')) call no_files()
   if (runs('factor')) call factor()
   if (runs('zipped')) call zipped()
   if (runs('resolved')) call resolved()
   if (runs('bad_values')) call bad_values()
   if (runs('twice')) call twice()
   if (runs('many')) call many()
   call report()

contains

   subroutine read_lines(text, table, error)
      character(len=*), intent(in) :: text
      type(study_table_type), intent(out) :: table
      type(error_type), allocatable, intent(out) :: error
      call write_bytes(scratch_path('members.csv'), text)
      call read_table(scratch_path('members.csv'), table, error)
      call delete_file(scratch_path('members.csv'))
   end subroutine read_lines

   !> The names and values of a table, those in quotes that are texts: "rotor%mass | 1 | 2".
   subroutine expect_table(text, expected)
      character(len=*), intent(in) :: text, expected
      type(study_table_type) :: table
      type(error_type), allocatable :: error
      type(token_type) :: token
      character(len=:), allocatable :: found
      integer :: row, column
      call read_lines(text, table, error)
      call expect_no_error(error, 'a table: '//text)
      if (allocated(error)) return
      found = ''
      do column = 1, size(table%columns)
         found = found//' | '//target_text(table%columns(column))
      end do
      do row = 1, table%rows
         do column = 1, size(table%columns)
            call table%value(row, column, token)
            found = found//' | '
            if (token%quoted) found = found//''''
            found = found//token%text
            if (token%quoted) found = found//''''
         end do
      end do
      call expect(found(4:) == expected .and. len(found) == len(expected) + 3, expected//' came out as '//found(4:))
   end subroutine expect_table

   !> One table in many spellings.
   subroutine spellings()
      character(len=*), parameter :: same = 'rotor%mass | pads%mass(2) | 2e3 | 0.5 | 1000 | -1D0'
      character(len=*), parameter :: name = 'rotor%mass,pads%mass(2)'
      call expect_table(name//newline//'2e3,0.5'//newline//'1000,-1D0', same)
      call expect_table(name//crlf//'2e3,0.5'//crlf//'1000,-1D0'//crlf, same)
      call expect_table(name//newline//'2e3,0.5'//crlf//'1000,-1D0'//newline, same)
      call expect_table(char(239)//char(187)//char(191)//name//newline//'2e3,0.5'//newline//'1000,-1D0', same)
      call expect_table(name//newline//'2e3,0.5'//newline//'1000,-1D0'//newline//newline//' '//crlf, same)
      call expect_table(' Rotor%MASS ,'//achar(9)//'pads%Mass(2)'//newline//'  2e3, 0.5 '//newline//'1000 ,-1D0', same)
      call expect_table('"rotor%mass","pads%mass(2)"'//crlf//'"2e3","0.5"'//crlf//'"1000" , "-1D0"'//crlf, same)
      call expect_table('rotor%mass'//newline//'5'//crlf, 'rotor%mass | 5')
   end subroutine spellings

   !> Texts are quoted in the case, also what a number's column cannot take.
   subroutine texts()
      call expect_table('start%file'//newline//'"a, ""b"""'//newline//'c d'//newline//'""""', &
         & 'start%file | ''a, "b"'' | ''c d'' | ''"''')
      call expect_table('friction%model,rotor%mass'//newline//'LuGre,1'//newline//'"none","1:2:1"', &
         & 'friction%model | rotor%mass | ''LuGre'' | 1 | ''none'' | ''1:2:1''')
      call expect_table('rotor%mass'//newline//'3*1'//newline//'"1,5"'//newline//'inf', &
         & 'rotor%mass | ''3*1'' | ''1,5'' | ''inf''')
   end subroutine texts

   subroutine expect_wrong(text, words)
      character(len=*), intent(in) :: text, words
      type(study_table_type) :: table
      type(error_type), allocatable :: error
      call read_lines(text, table, error)
      call expect_error(error, input_error, words, 'refused: '//text(:min(60, len(text))))
   end subroutine expect_wrong

   subroutine names()
      call expect_wrong('', 'members.csv: is empty; its first line must name variables')
      call expect_wrong(newline//crlf//' ', 'members.csv: is empty')
      call expect_wrong('rotor%mess'//newline//'1', &
         & 'members.csv line 1, column 1: unknown variable rotor%mess (did you mean mass?)')
      call expect_wrong('rotor%mass,roter%mass'//newline//'1,1', &
         & 'members.csv line 1, column 2: unknown group roter (did you mean rotor?)')
      call expect_wrong('mass'//newline//'1', '''mass'': expected a variable, group%name or group%name(element) ' &
         & //'(did you mean rotor%mass or pads%mass?)')
      call expect_wrong('1000,2000'//newline//'1,1', 'column 1: ''1000'': expected a variable')
      call expect_wrong('rotor%mass,'//newline//'1,', 'column 2: '''': expected a variable')
      call expect_wrong('pads%mass(0)'//newline//'1', '''pads%mass(0)'': expected a variable')
      call expect_wrong('pads%mass (1)'//newline//'1', '''pads%mass (1)'': expected a variable')
      call expect_wrong('pads%mass(x)'//newline//'1', '''pads%mass(x)'': expected a variable')
      call expect_wrong('rotor%mass;rotor%gravity'//newline//'1;2', 'column 1: commas must separate the columns')
      call expect_wrong('rotor%mass'//achar(9)//'rotor%gravity'//newline//'1 2', 'not semicolons or tabs')
      call expect_wrong('"rotor%mass,rotor%gravity'//newline//'1,2', 'column 1: the quote is not closed')
      call expect_wrong('pivot(%file'//newline//'a.csv', 'unknown group pivot(')
      call expect_wrong('rotor:left%mass'//newline//'1', 'unknown group rotor:left')
      call expect_wrong('excitation()%amplitude'//newline//'1', 'unknown group excitation()')
      call expect_table('excitation(2)%amplitude,pads:left%mass(3)'//newline//'1,2', &
         & 'excitation(2)%amplitude | pads:left%mass(3) | 1 | 2')
      call expect_wrong(repeat('rotor%mass,', 1000)//'rotor%mass'//newline//'1', 'column 1001: more than 1000 columns')
   end subroutine names

   subroutine rows()
      character(len=*), parameter :: name = 'rotor%mass,rotor%gravity'//newline//'1,2'//newline
      call expect_wrong('rotor%mass', 'members.csv: has no rows')
      call expect_wrong('rotor%mass'//crlf//crlf, 'members.csv: has no rows')
      call expect_wrong(name//'3', 'members.csv line 3: has 1 values for 2 columns; rotor%gravity has none')
      call expect_wrong(name//'3,4,5', 'members.csv line 3: has 3 values for 2 columns; a comma ends a value, and ' &
         & //'decimals have a point')
      call expect_wrong(name//'3,', 'members.csv line 3: rotor%gravity: a value is missing')
      call expect_wrong(name//'"",3', 'members.csv line 3: rotor%mass: a value is missing')
      call expect_wrong(name//' '//newline//'3,4', 'members.csv line 3: is empty, with others below it')
      call expect_wrong('rotor%mass'//newline//newline//'3', 'members.csv line 2: is empty')
   end subroutine rows

   subroutine cells()
      character(len=*), parameter :: name = 'rotor%mass,rotor%gravity'//newline//'1,2'//newline
      call expect_wrong(name//'3,"4', 'members.csv line 3: rotor%gravity: the quote is not closed on its line')
      call expect_wrong(name//'3,"4'//newline//'5"', 'line 3: rotor%gravity: the quote is not closed on its line')
      call expect_wrong(name//'"3"1,4', 'members.csv line 3: rotor%mass: text behind the closing quote')
      call expect_wrong(name//'1'//achar(13)//'2', 'not a text file (byte 31 is a control character)')
      call expect_wrong(name//'1,'//achar(0), 'is a control character')
   end subroutine cells

   subroutine no_files()
      type(study_table_type) :: table
      type(error_type), allocatable :: error
      call read_table('no/such/file.csv', table, error)
      call expect_error(error, input_error, 'no/such/file.csv: no such file', 'a missing file')
      call read_table('src_f90', table, error)
      call expect_error(error, input_error, 'src_f90: a directory, device or pipe, where a table belongs', 'a folder')
   end subroutine no_files

   !> The study of a case in a folder of its own, with a table beside it.
   subroutine read_study(assignments, lines, study, error)
      character(len=*), intent(in) :: assignments, lines
      type(study_type), intent(out) :: study
      type(error_type), allocatable, intent(out) :: error
      call write_bytes(scratch_path('members.csv'), lines)
      call study_from_text('&sweep '//assignments//'/', scratch_path('case.nml'), [character(len=1) ::], study, error)
      call delete_file(scratch_path('members.csv'))
   end subroutine read_study

   !> As a case names it: in the folder of the case.
   function table_name() result(assignment)
      character(len=:), allocatable :: assignment, path
      path = scratch_path('members.csv')
      assignment = 'file = '//value_text(token_type(path(index(path, '/', back=.true.) + 1:), .true.))//' '
   end function table_name

   subroutine expect_tag(study, k, expected)
      type(study_type), intent(in) :: study
      integer, intent(in) :: k
      character(len=*), intent(in) :: expected
      type(run_tag) :: tag
      call study%tag(k, tag)
      call expect(tag%study == expected .and. len(tag%study) == len(expected), expected//' came out as '//tag%study)
   end subroutine expect_tag

   !> The rows are one factor, in the place that the file has among the variables.
   subroutine factor()
      type(study_type) :: study
      type(error_type), allocatable :: error
      type(case_type) :: inputs
      character(len=*), parameter :: lines = 'rotor%mass,pads%mass(2)'//newline//'10,1'//newline//'20,2'//newline &
         & //'30,3'
      call read_study('operation%speed_rpm = 1000, 2000 '//table_name()//' rotor%gravity = 5:6:1', lines, study, error)
      call expect_no_error(error, 'a table between lists')
      call expect(study%runs == 12, 'product of 2, 3 and 2')
      call expect_tag(study, 1, 'operation%speed_rpm = 1000'//newline//'rotor%mass = 10'//newline &
         & //'pads%mass(2) = 1'//newline//'rotor%gravity = 5')
      call expect_tag(study, 4, 'operation%speed_rpm = 1000'//newline//'rotor%mass = 20'//newline &
         & //'pads%mass(2) = 2'//newline//'rotor%gravity = 6')
      call expect_tag(study, 11, 'operation%speed_rpm = 2000'//newline//'rotor%mass = 30'//newline &
         & //'pads%mass(2) = 3'//newline//'rotor%gravity = 5')
      call study%inputs(11, inputs, error)
      call expect_no_error(error, 'run 11 is good')
      call expect_close(inputs%rotor%mass, 30.0_wp, 0.0_wp, 'its mass')
      call expect_close(inputs%bearings(1)%pads%mass(2), 3.0_wp, 0.0_wp, 'the mass of its second pad')
   end subroutine factor

   subroutine zipped()
      type(study_type) :: study
      type(error_type), allocatable :: error
      character(len=*), parameter :: lines = 'rotor%mass,friction%model'//newline//'10,none'//newline//'20,lugre'
      call read_study('order = ''zip'' '//table_name()//'rotor%gravity = 5:6:1', lines, study, error)
      call expect_no_error(error, 'a table beside a range')
      call expect(study%runs == 2, 'two rows')
      call expect_tag(study, 2, 'rotor%mass = 20'//newline//'friction%model = ''lugre'''//newline//'rotor%gravity = 6')
      call read_study('order = ''zip'' '//table_name()//'rotor%gravity = 5, 6, 7', lines, study, error)
      call expect_error(error, input_error, 'members.csv has 2, rotor%gravity has 3', 'another number of values')
   end subroutine zipped

   !> The resolved text names the file so that it is found from any folder.
   subroutine resolved()
      type(study_type) :: study, again
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      call read_study('rotor%gravity = 5, 6 '//table_name(), 'rotor%mass'//newline//'10'//newline//'20', study, error)
      call expect_no_error(error, 'a study')
      call study%resolved(text, error)
      call expect_no_error(error, 'resolved')
      call expect(index(text, '&sweep'//newline//'  order = ''product'''//newline//'  rotor%gravity = 5, 6'//newline &
         & //'  file = '//value_text(token_type(real_path(scratch_path('members.csv')), .true.))//newline//'/') > 0, &
         & 'the file: '//text)
      call study_from_text(text, 'elsewhere/case.nml', [character(len=1) ::], again, error)
      call expect_error(error, input_error, 'sweep%file: '//real_path(scratch_path('members.csv'))//': no such file', &
         & 'the file is not there any more')
   end subroutine resolved

   !> The message of a value has its line, its variable and what is allowed, whatever the run.
   subroutine bad_values()
      call expect_bad('rotor%mass', '-3', 'members.csv line 3, run 2: rotor%mass = -3: must be 1e-6 to')
      call expect_bad('rotor%mass', 'heavy', 'line 3, run 2: rotor%mass = ''heavy'': must be a number, 1e-6 to')
      call expect_bad('rotor%mass', '"80,5"', 'line 3, run 2: rotor%mass = ''80,5'': must be a number')
      call expect_bad('rotor%mass', '1e', 'line 3, run 2: rotor%mass = 1e: must be a number')
      call expect_bad('rotor%mass', 'nan', 'line 3, run 2: rotor%mass = ''nan'': must be a number')
      call expect_bad('rotor%mass', '1e999', 'line 3, run 2: rotor%mass = 1e999: must be finite')
      call expect_bad('rotor%gravity', '2*7', 'line 3, run 2: rotor%gravity = ''2*7'': must be a number')
      call expect_bad('rotor%mass', '1:2:1', 'line 3, run 2: rotor%mass = ''1:2:1'': must be a number')
      call expect_bad('film%axial_cells', '4.5', 'line 3, run 2: film%axial_cells = 4.5: must be a whole number')
   end subroutine bad_values

   !> The second row has a value that its variable does not take.
   subroutine expect_bad(name, value, words)
      character(len=*), intent(in) :: name, value, words
      type(study_type) :: study
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      call read_study(table_name(), name//newline//'10'//newline//value, study, error)
      call expect_no_error(error, 'a study with a bad run')
      call study%inputs(1, inputs, error)
      call expect_no_error(error, 'another run of it')
      call study%inputs(2, inputs, error)
      call expect_error(error, input_error, words, 'a bad value: '//value)
   end subroutine expect_bad

   subroutine twice()
      type(study_type) :: study
      type(error_type), allocatable :: error
      call read_study(table_name(), 'rotor%mass,rotor%mass'//newline//'1,2', study, error)
      call expect_error(error, input_error, 'line 1, column 2: rotor%mass is swept twice, first at ', 'two columns')
      call read_study(table_name(), 'pads%mass(1),pads%mass'//newline//'1,2', study, error)
      call expect_error(error, input_error, 'line 1, column 2: pads%mass is swept twice, first at ', 'an element, all')
      call read_study(table_name()//'rotor%mass = 1, 2', 'rotor%mass'//newline//'1', study, error)
      call expect_error(error, input_error, 'line 1: rotor%mass is swept twice, first at ', 'a column and a list')
      call read_study(table_name(), 'case%title'//newline//'a', study, error)
      call expect_error(error, input_error, 'line 1, column 1: case%title cannot be swept', 'the title')
      call read_study('file = ''a'', ''b''', 'rotor%mass'//newline//'1', study, error)
      call expect_error(error, input_error, 'must be the name of one file', 'two files')
      call read_study('file = a', 'rotor%mass'//newline//'1', study, error)
      call expect_error(error, input_error, 'in quotes', 'a bare name')
      call read_study('file = ''''', 'rotor%mass'//newline//'1', study, error)
      call expect_error(error, input_error, 'must be the name of one file', 'no name')
   end subroutine twice

   !> A million runs, of a table and a list; one more row is refused.
   subroutine many()
      type(study_type) :: study
      type(error_type), allocatable :: error
      call read_study('rotor%gravity = 1:10:1 '//table_name(), 'rotor%mass'//newline//repeat('1'//newline, 100000), &
         & study, error)
      call expect_no_error(error, 'a million runs')
      call expect(study%runs == 1000000, 'ten times a hundred thousand, not '//to_text(study%runs))
      call expect_tag(study, 1000000, 'rotor%gravity = 10'//newline//'rotor%mass = 1')
      call read_study('rotor%gravity = 1:10:1 '//table_name(), 'rotor%mass'//newline//repeat('1'//newline, 100001), &
         & study, error)
      call expect_error(error, input_error, 'more than 1000000 runs: rotor%gravity has 10, ', 'one row more')
   end subroutine many
end program test_study_table
