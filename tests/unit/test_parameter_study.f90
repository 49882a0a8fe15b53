!> Parameter studies: the values of a variable, single ones as they stand and ranges to the last bit; how many runs,
!> which values in which order; what is refused.
program test_parameter_study
   use kinds, only: wp, i8
   use text, only: to_text, exact_text, checksum
   use errors, only: error_type, input_error
   use assignments, only: token_type
   use study_variables, only: varied_values_type, read_varied_values
   use case_inputs, only: case_type
   use namelist_writer, only: namelist_of
   use parameter_study, only: study_type, run_tag, study_from_text
   use check, only: runs, expect, expect_close, expect_no_error, expect_error, between, report
   implicit none (type, external)
   integer :: i
   character(len=*), parameter :: newline = achar(10)

   if (runs('single_values')) call single_values()
   if (runs('strides')) call strides()
   if (runs('factors')) call factors()
   if (runs('mixed')) call mixed()
   do i = 1, 20
      if (runs('to_the_last_bit')) call to_the_last_bit()
   end do
   if (runs('longest')) call longest()
   if (runs('wrong_values')) call wrong_values()
   if (runs('no_study')) call no_study()
   if (runs('product_order')) call product_order()
   if (runs('zip_order')) call zip_order()
   if (runs('marks')) call marks()
   if (runs('numbers')) call numbers()
   if (runs('in_place_of_the_case')) call in_place_of_the_case()
   if (runs('overrides')) call overrides()
   if (runs('resolved_again')) call resolved_again()
   if (runs('many_variables')) call many_variables()
   if (runs('refused')) call refused()
   if (runs('refused_members')) call refused_members()
   call report()

contains

   !> Tokens of words between blanks; those that begin with a quote are quoted.
   subroutine read_values(words, values, error)
      character(len=*), intent(in) :: words
      type(varied_values_type), intent(out) :: values
      type(error_type), allocatable, intent(out) :: error
      type(token_type), allocatable :: tokens(:)
      type(token_type) :: token
      character(len=:), allocatable :: rest
      integer :: blank
      allocate (tokens(0))
      rest = words//' '
      do while (rest /= '')
         blank = index(rest, ' ')
         token%text = rest(:blank - 1)
         token%quoted = rest(1:1) == ''''
         if (token%quoted) token%text = rest(2:blank - 2)
         tokens = [tokens, token]
         rest = rest(blank + 1:)
      end do
      call read_varied_values(tokens, 'a%x', values, error)
   end subroutine read_values

   !> The values are these, separated by blanks.
   subroutine expect_values(words, expected)
      character(len=*), intent(in) :: words, expected
      type(varied_values_type) :: values
      type(error_type), allocatable :: error
      type(token_type) :: token
      character(len=:), allocatable :: found
      integer :: k
      call read_values(words, values, error)
      call expect_no_error(error, words)
      if (allocated(error)) return
      found = ''
      do k = 1, values%count()
         call values%value(k, token)
         found = found//' '//token%text
      end do
      call expect(found == ' '//expected, words//' are '//expected//', not'//found)
   end subroutine expect_values

   subroutine single_values()
      type(varied_values_type) :: values
      type(error_type), allocatable :: error
      type(token_type) :: token
      call expect_values('1 2.50 -3e5', '1 2.50 -3e5')
      call read_values('none ''1:2:1''', values, error)
      call expect_no_error(error, 'texts')
      call expect(values%count() == 2, 'a quoted text is no range')
      call values%value(2, token)
      call expect(token%quoted .and. token%text == '1:2:1', 'and stays as it is')
      call expect(values%text() == 'none, ''1:2:1''', 'as they stand in a case: '//values%text())
   end subroutine single_values

   subroutine strides()
      call expect_values('1:3:1', '1 2 3')
      call expect_values('1:3.9:1', '1 2 3')
      call expect_values('3:1:-1', '3 2 1')
      call expect_values('5:5:1', '5')
      call expect_values('0:2e6:1e6', '0 1000000 2000000')
      ! ten strides of 0.1 make a last value that 1 exceeds by its rounding alone
      call expect_count('0:1:0.1', 11)
      call expect_count('0:0.99999:0.1', 10)
      call expect_count('0:0.99999999:0.1', 11)
   end subroutine strides

   subroutine factors()
      call expect_values('1:1000:*10', '1 10 100 1000')
      call expect_values('1:999:*10', '1 10 100')
      call expect_values('8:1:*0.5', '8 4 2 1')
      call expect_values('-1:-4:*2', '-1 -2 -4')
      call expect_values('7:7:*2', '7')
      call expect_values('1E1:1d3:*10', '10 100 1000')
   end subroutine factors

   subroutine expect_count(words, expected)
      character(len=*), intent(in) :: words
      integer, intent(in) :: expected
      type(varied_values_type) :: values
      type(error_type), allocatable :: error
      call read_values(words, values, error)
      call expect_no_error(error, words)
      if (allocated(error)) return
      call expect(values%count() == expected, words//' are '//to_text(expected)//', not '//to_text(values%count()))
   end subroutine expect_count

   subroutine mixed()
      type(varied_values_type) :: values
      type(error_type), allocatable :: error
      call expect_values('7 1:3:1 9 10:1000:*10 11', '7 1 2 3 9 10 100 1000 11')
      call read_values('7 1:3:1 9', values, error)
      call expect(values%text() == '7, 1:3:1, 9', 'as they stand in a case: '//values%text())
   end subroutine mixed

   !> first + i*stride, the product rounded by itself; first*factor**i, not a product of products.
   subroutine to_the_last_bit()
      type(varied_values_type) :: values
      type(error_type), allocatable :: error
      type(token_type) :: token
      real(wp), volatile :: product
      real(wp) :: first, step, x
      integer :: k
      first = between(1.0_wp, 2.0_wp)
      step = between(1e-3_wp, 2e-3_wp)
      call read_values(exact_text(first)//':'//exact_text(first + 1)//':'//exact_text(step), values, error)
      do k = 1, values%count()
         call values%value(k, token)
         read (token%text, *) x
         product = (k - 1)*step
         call expect_close(x, first + product, 0.0_wp, 'value '//to_text(k)//' of a stride')
      end do
      step = between(1.01_wp, 1.02_wp)
      call read_values(exact_text(first)//':'//exact_text(10*first)//':*'//exact_text(step), values, error)
      call expect(values%count() == 1 + floor(log(10.0_wp)/log(step)), 'as many as the logarithms say')
      do k = 1, values%count()
         call values%value(k, token)
         read (token%text, *) x
         call expect_close(x, first*step**real(k - 1, wp), 0.0_wp, 'value '//to_text(k)//' of a factor')
      end do
   end subroutine to_the_last_bit

   subroutine longest()
      call expect_count('1:1000000:1', 1000000)
      call expect_wrong('1:1000001:1', 'more than 1000000 values')
      call expect_wrong('0:1:1e-100', 'more than 1000000 values')
      call expect_wrong('-1e100:1e100:1e-100', 'more than 1000000 values')
      call expect_wrong('1:1e99:*1.0000001', 'more than 1000000 values')
   end subroutine longest

   subroutine expect_wrong(words, reason)
      character(len=*), intent(in) :: words, reason
      type(varied_values_type) :: values
      type(error_type), allocatable :: error
      call read_values(words, values, error)
      call expect_error(error, input_error, reason, 'refused: '//words)
      if (allocated(error)) call expect(index(error%message, 'a%x = ') == 1, 'says what is assigned: '//error%message)
   end subroutine expect_wrong

   subroutine wrong_values()
      call expect_wrong('3*1', 'not for a study')
      call expect_wrong('1:2', 'a range is first:last:stride')
      call expect_wrong('1:2:3:4', 'a range is')
      call expect_wrong('1:', 'a range is')
      call expect_wrong('::', 'a range is')
      call expect_wrong('1::3', 'a range is')
      call expect_wrong('1:2:*', 'a range is')
      call expect_wrong('1:2:', 'a range is')
      call expect_wrong('1:2:**3', 'a range is')
      call expect_wrong('1:a:3', 'a range is')
      call expect_wrong('1:nan:3', 'a range is')
      call expect_wrong('1:1e101:1', '1e-100 to 1e100 in size')
      call expect_wrong('1e-101:1:1', '1e-100 to 1e100 in size')
      call expect_wrong('1:1e999:1', '1e-100 to 1e100 in size')
      call expect_wrong('1:2:1e-200', '1e-100 to 1e100 in size')
      call expect_wrong('1:2:0', 'must not be 0')
      call expect_wrong('1:2:-1', 'must be > 0')
      call expect_wrong('2:1:1', 'must be < 0')
      call expect_wrong('-1:2:*2', 'of one sign')
      call expect_wrong('0:2:*2', 'of one sign')
      call expect_wrong('2:0:*0.5', 'of one sign, and not 0')
      call expect_wrong('1:2:*-2', 'must be > 0, and not 1')
      call expect_wrong('1:2:*1', 'must be > 0, and not 1')
      call expect_wrong('1:2:*0', 'must be > 0, and not 1')
      call expect_wrong('1:2:*0.5', 'must be > 1')
      call expect_wrong('2:1:*2', 'must be < 1')
   end subroutine wrong_values

   !> A study from text that must be good.
   type(study_type) function study_of(text, overrides) result(study)
      character(len=*), intent(in) :: text
      character(len=*), intent(in), optional :: overrides(:)
      type(error_type), allocatable :: error
      if (present(overrides)) then
         call study_from_text(text, 'case.nml', overrides, study, error)
      else
         call study_from_text(text, 'case.nml', [character(len=1) ::], study, error)
      end if
      call expect_no_error(error, 'accepted: '//text)
   end function study_of

   !> The case of a run that must be good.
   type(case_type) function run(study, k) result(inputs)
      type(study_type), intent(in) :: study
      integer, intent(in) :: k
      type(error_type), allocatable :: error
      call study%inputs(k, inputs, error)
      call expect_no_error(error, 'run '//to_text(k)//' is good')
   end function run

   subroutine expect_tag(study, k, expected)
      type(study_type), intent(in) :: study
      integer, intent(in) :: k
      character(len=*), intent(in) :: expected
      type(run_tag) :: tag
      call study%tag(k, tag)
      call expect(tag%number == k .and. tag%runs == study%runs, 'number of a run')
      call expect(tag%study == expected .and. len(tag%study) == len(expected), expected//' came out as '//tag%study)
   end subroutine expect_tag

   subroutine no_study()
      type(study_type) :: study
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      study = study_of('&rotor mass = 1234 /')
      call expect(.not. study%given .and. study%runs == 1, 'a case without a study')
      inputs = run(study, 1)
      call expect_close(inputs%rotor%mass, 1234.0_wp, 0.0_wp, 'is its one run')
      call expect_tag(study, 1, '')
      study = study_of('&rotor mass = -1 /')
      call study%inputs(1, inputs, error)
      call expect_error(error, input_error, 'case.nml line 1: rotor%mass = -1', 'a bad value in it')
   end subroutine no_study

   !> The first variable is the slowest.
   subroutine product_order()
      type(study_type) :: study
      type(case_type) :: inputs
      study = study_of('&sweep'//newline//'operation%speed_rpm = 1e3, 2e3'//newline//'friction%model = ''none'', ' &
         & //'"LuGre", bengisu_akay Pads%Arc_deg(2)=60 65/')
      call expect(study%given .and. study%runs == 12, 'product of 2, 3 and 2')
      call expect_tag(study, 1, 'operation%speed_rpm = 1e3'//newline//'friction%model = ''none'''//newline &
         & //'pads%arc_deg(2) = 60')
      call expect_tag(study, 2, 'operation%speed_rpm = 1e3'//newline//'friction%model = ''none'''//newline &
         & //'pads%arc_deg(2) = 65')
      call expect_tag(study, 9, 'operation%speed_rpm = 2e3'//newline//'friction%model = ''LuGre'''//newline &
         & //'pads%arc_deg(2) = 60')
      inputs = run(study, 12)
      call expect_close(inputs%operation%speed_rpm, 2000.0_wp, 0.0_wp, 'speed of the last')
      call expect_close(inputs%operation%final_speed_rpm, 2000.0_wp, 0.0_wp, 'its final speed is the same')
      call expect(inputs%bearings(1)%friction%model == 'bengisu_akay', 'its friction')
      call expect_close(maxval(abs(inputs%bearings(1)%pads%arc_deg - [69.3_wp, 65.0_wp])), 0.0_wp, 0.0_wp, 'its arcs')
   end subroutine product_order

   subroutine zip_order()
      type(study_type) :: study
      study = study_of('&sweep order = '' Zip '', rotor%mass = 1:3:1, rotor%unbalance = 0.1, 0.2:0.3:0.1 /')
      call expect(study%runs == 3, 'three pairs')
      call expect_tag(study, 2, 'rotor%mass = 2'//newline//'rotor%unbalance = 0.2')
      study = study_of('&sweep order = ''product'', rotor%mass = 1:3:1, rotor%unbalance = 0.1, 0.2 /')
      call expect(study%runs == 6, 'the product in words')
   end subroutine zip_order

   !> The checksum up to each run is that of the base and of the lines of all runs so far, whichever value changes when.
   subroutine marks()
      character(len=*), parameter :: of(*) = [character(len=120) :: &
         & '&sweep rotor%mass = 1:3:1 operation%speed_rpm = 1e3, 2e3:4e3:*1.1 friction%model = ''none'', lugre /', &
         & '&sweep order=''zip'' rotor%mass = 1:3:0.7 friction%model = lugre, lugre, none rotor%gravity = 5, 6, 7 /', &
         & '&sweep rotor%mass = 1 /']
      type(study_type) :: study
      type(run_tag) :: tag
      character(len=:), allocatable :: found
      integer(i8) :: expected
      integer :: i, k
      do i = 1, size(of)
         study = study_of(trim(of(i)))
         call study%mark('base')
         expected = checksum('base', 0_i8)
         do k = 1, study%runs
            call study%tag(k, tag)
            found = tag%marks(:index(tag%marks, ' ', back=.true.) - 1)
            call expect(found == to_text(expected)//' '//to_text(checksum(tag%study//newline, expected)), &
               & 'run '//to_text(k)//' of '//trim(of(i)))
            expected = checksum(tag%study//newline, expected)
         end do
      end do
   end subroutine marks

   !> The number of a value is that of its text; a word has none.
   subroutine numbers()
      type(study_type) :: study
      type(token_type) :: token
      real(wp) :: x, y
      logical :: ok
      integer :: i, k
      study = study_of('&sweep rotor%mass = 0.1:3:0.7, 1d2 operation%speed_rpm = 1e3, 2e3:4e3:*1.1 ' &
         & //'friction%model = ''none'', lugre /')
      do k = 1, study%runs
         do i = 1, 2
            call study%varied%number_of_run(i, k, x, ok)
            call study%varied%value(i, k, token)
            read (token%text, *) y
            call expect(ok .and. abs(x - y) <= 0, token%text)
         end do
         call study%varied%number_of_run(3, k, x, ok)
         call expect(.not. ok, 'a word')
      end do
   end subroutine numbers

   !> A varied value stands in place of the case's, be that good or bad, and elements in place of elements.
   subroutine in_place_of_the_case()
      type(study_type) :: study
      type(case_type) :: inputs
      study = study_of('&rotor mass = -1, gravity = 5 / &sweep rotor%mass = 10, 20 / &pads arc_deg(1) = 50, 51 /')
      inputs = run(study, 2)
      call expect_close(inputs%rotor%mass, 20.0_wp, 0.0_wp, 'a bad value mended')
      call expect_close(inputs%rotor%gravity, 5.0_wp, 0.0_wp, 'what is not varied stays')
      study = study_of('&pads arc_deg(1) = 50, 51 / &sweep pads%arc_deg(1) = 60 /')
      inputs = run(study, 1)
      call expect_close(maxval(abs(inputs%bearings(1)%pads%arc_deg - [60.0_wp, 51.0_wp])), 0.0_wp, 0.0_wp, &
         & 'one element of a list')
      study = study_of('&pads arc_deg = 50, 51 / &sweep pads%arc_deg = 60 /')
      inputs = run(study, 1)
      call expect_close(maxval(abs(inputs%bearings(1)%pads%arc_deg - 60)), 0.0_wp, 0.0_wp, 'one value for all pads')
   end subroutine in_place_of_the_case

   !> --set sweep%... keeps the order of the variables, and makes a study where there is none.
   subroutine overrides()
      character(len=*), parameter :: case = '&sweep rotor%mass = 1, 2, rotor%unbalance = 3, 4 /'
      type(study_type) :: study
      study = study_of(case, [character(len=30) :: 'sweep%rotor%mass=5:7:1'])
      call expect(study%runs == 6, 'other values')
      call expect_tag(study, 2, 'rotor%mass = 5'//newline//'rotor%unbalance = 4')
      study = study_of(case, [character(len=30) :: 'sweep%order=''zip'''])
      call expect(study%runs == 2, 'another order')
      study = study_of(case, [character(len=30) :: 'sweep%rotor%gravity=1,2,3', 'SWEEP%rotor%gravity=5'])
      call expect_tag(study, 4, 'rotor%mass = 2'//newline//'rotor%unbalance = 4'//newline//'rotor%gravity = 5')
      study = study_of('&rotor /', [character(len=30) :: 'sweep%pads%mass(2)=0.9,1'])
      call expect(study%given .and. study%runs == 2, 'a study where there was none')
      call expect_tag(study, 2, 'pads%mass(2) = 1')
      study = study_of('&sweep pads%mass(2) = 0.9, 1/', [character(len=30) :: 'pads%mass(1)=0.7'])
      call expect(study%runs == 2, 'an override of another element')
   end subroutine overrides

   !> The resolved text is a case with the same runs, whose resolved text it is.
   subroutine resolved_again()
      character(len=*), parameter :: cases(*) = [character(len=200) :: &
         & '&sweep operation%speed_rpm = 0.1:0.5:0.1, 1e3:1e5:*10, 7, friction%model = ''LuGre'', none /', &
         & '&operation final_speed_rpm = 3000 / &sweep order=''zip'' operation%speed_rpm = 1:2:1 rotor%mass=3,4 /', &
         & '&pads mass = 1, 2, arc_deg = 50 / &sweep pads%mass(2) = 0.7, 0.9 pads%arc_deg = 60:30:-10 /', &
         & '&pads arc_deg = 300 / &sweep pads%pivot_angle_deg = -90, -80 /']
      type(study_type) :: study, again
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text, second
      integer :: i, k
      do i = 1, size(cases)
         study = study_of(trim(cases(i)))
         call study%resolved(text, error)
         call expect_no_error(error, 'resolved: '//trim(cases(i)))
         if (allocated(error)) cycle
         again = study_of(text)
         call again%resolved(second, error)
         call expect(text == second .and. len(text) == len(second), 'resolves to itself: '//trim(cases(i)))
         call expect(again%runs == study%runs .and. study%runs > 1, 'as many runs')
         do k = 1, study%runs
            call expect(namelist_of(run(again, k)) == namelist_of(run(study, k)), 'the same run '//to_text(k))
         end do
      end do
   end subroutine resolved_again

   !> The message names the place and has the words, before any run is looked at.
   subroutine expect_refused(text, words, overrides)
      character(len=*), intent(in) :: text, words
      character(len=*), intent(in), optional :: overrides(:)
      type(study_type) :: study
      type(error_type), allocatable :: error
      if (present(overrides)) then
         call study_from_text(text, 'case.nml', overrides, study, error)
      else
         call study_from_text('&rotor /'//newline//text, 'case.nml', [character(len=1) ::], study, error)
      end if
      call expect_error(error, input_error, words, 'refused: '//text)
      if (.not. allocated(error)) return
      if (.not. present(overrides)) call expect(index(error%message, 'case.nml line 2: ') == 1, error%message)
      call expect(index(error%message, newline) == 0, 'one line')
   end subroutine expect_refused

   !> However many variables a study has, the message that counts them is short.
   subroutine many_variables()
      type(study_type) :: study
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      integer :: i
      text = '&sweep'
      do i = 1, 900
         text = text//' a%b'//to_text(i)//' = 1:9:1'
      end do
      call study_from_text(text//' /', 'case.nml', [character(len=1) ::], study, error)
      call expect_error(error, input_error, 'a%b8 has 9, ...', 'too many runs')
   end subroutine many_variables

   !> The values of a variable have more in wrong_values.
   subroutine refused()
      character(len=*), parameter :: range = 'a range is first:last:stride or first:last:*factor'
      call expect_refused('&sweep /', '&sweep names no variable')
      call expect_refused('&sweep order = ''zip'' /', '&sweep names no variable')
      call expect_refused('&sweep order = ''outer'', rotor%mass = 1/', '''product'', ''zip''')
      call expect_refused('&sweep order = ''zip'', ''zip'', rotor%mass = 1/', '''product'', ''zip''')
      call expect_refused('&sweep order(1) = ''zip'', rotor%mass = 1/', '''product'', ''zip''')
      call expect_refused('&sweep mass = 1/', &
         & 'unknown variable sweep%mass (did you mean rotor%mass or pads%mass?); expected order, file or group%name')
      call expect_refused('&sweep rotor% = 1/', 'expected order, file or group%name')
      call expect_refused('&sweep %mass = 1/', 'expected order, file or group%name')
      call expect_refused('&sweep rotor%mass%x = 1/', 'expected order, file or group%name')
      call expect_refused('&sweep rotor%%mass = 1/', 'expected order, file or group%name')
      call expect_refused('&sweep sweep%order = ''zip''/', 'sweep%order cannot be swept')
      call expect_refused('&sweep sweep%rotor%mass = 1/', 'expected order, file or group%name')
      call expect_refused('&sweep case%title = ''a'', ''b''/', 'case%title cannot be swept')
      call expect_refused('&sweep rotor%mass = 1 rotor%mass = 2/', 'given twice')
      call expect_refused('&sweep rotor%mass = 1 ROTOR%MASS = 2/', 'given twice')
      call expect_refused('&sweep pads%mass(1) = 1 pads%mass = 2/', 'given twice')
      call expect_refused('&sweep pads%mass = 1 pads%mass(1) = 2/', 'pads%mass is swept twice')
      call expect_refused('&sweep rotor%mass = /', 'a value is missing')
      call expect_refused('&sweep rotor%mass = 1:2/', range)
      call expect_refused('&sweep rotor%mass = 1 : 2 : 1/', range)
      call expect_refused('&sweep rotor%mass = 1:1000:1 rotor%gravity = 0:1000:1/', &
         & 'more than 1000000 runs: rotor%mass has 1000, rotor%gravity has 1001')
      call expect_refused('&sweep rotor%mass = 1:900000:1 rotor%gravity = 1:900000:1 rotor%unbalance = 1:900000:1' &
         & //' bearing%viscosity = 1:900000:1 /', 'more than 1000000 runs')
      call expect_refused('&sweep order=''zip'' rotor%mass = 1, 2 rotor%gravity = 1, 2, 3/', &
         & 'rotor%mass has 2, rotor%gravity has 3')
      call expect_refused('&sweep rotor%mass = 1, 2/', 'rotor%mass = 3: is swept (case.nml line 1)', ['rotor%mass=3'])
      call expect_refused('&sweep rotor%mass = 1, 2/', '--set sweep%rotor%mass=', ['rotor%mass=3'])
      call expect_refused('&sweep pads%mass = 1, 2/', 'pads%mass(2) = 3: is swept', ['pads%mass(2)=3'])
      call expect_refused('&rotor /', '&sweep names no variable', ['sweep%order=''zip'''])
      call expect_refused('&rotor /', '--set: unknown variable sweep%mass', ['sweep%mass=3'])
   end subroutine refused

   !> What the case of a run shows; every run knows names that there are not.
   subroutine refused_members()
      call expect_bad(1, 'roter%mass = 1', 'case.nml line 2, run 1: unknown group roter')
      call expect_bad(1, 'rotor%mess = 1', 'case.nml line 2, run 1: unknown variable rotor%mess')
      call expect_bad(2, 'rotor%mass = 1, -1', 'case.nml line 2, run 2: rotor%mass = -1: must be 1e-6')
      call expect_bad(3, 'rotor%mass = 1:3:1, rotor%mess=1', 'case.nml line 2, run 3: unknown variable')
      call expect_bad(3, 'film%axial_cells = 2:5:*1.5', 'run 3: film%axial_cells = 4.5: must be a whole number')
      call expect_bad(1, 'friction%model = 1:2:1', 'run 1: friction%model = 1: must be one of')
      call expect_bad(1, 'rotor%static_load = 1, 2', 'run 1: rotor%static_load = 1: takes 2 values')
      call expect_bad(1, 'pads%mass(3) = 1, 2', 'run 1: pads%mass(3) = 1: at most 2')
      call expect_bad(2, 'friction%dynamic_coefficient = 0.1, 0.2', &
         & 'case.nml, run 2: friction%dynamic_coefficient = 0.2: must not exceed')
   end subroutine refused_members

   subroutine expect_bad(k, assignment, words)
      integer, intent(in) :: k
      character(len=*), intent(in) :: assignment, words
      type(study_type) :: study
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      study = study_of('&sweep'//newline//assignment//'/')
      call study%inputs(k, inputs, error)
      call expect_error(error, input_error, words, 'a bad run: '//assignment)
   end subroutine expect_bad
end program test_parameter_study
