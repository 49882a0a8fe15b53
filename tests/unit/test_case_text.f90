!> Case files: their bytes as they are, what is refused, and overrides in their order.
program test_case_text
   use errors, only: error_type, input_error
   use assignments, only: namelist_type, assignment_text
   use case_text, only: read_text, parse_case
   use files, only: delete_file
   use scratch, only: scratch_path, write_bytes
   use check, only: runs, expect, expect_no_error, expect_error, report
   implicit none (type, external)
   character(len=:), allocatable :: path

   path = scratch_path('case.nml')
   if (runs('bytes')) call bytes()
   if (runs('longest')) call longest()
   if (runs('no_case')) call no_case()
   if (runs('overrides')) call overrides()
   if (runs('first_error')) call first_error()
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
      call expect_error(error, input_error, path//': 100001 bytes; an input file has at most 100000', 'a longer one')
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
end program test_case_text
