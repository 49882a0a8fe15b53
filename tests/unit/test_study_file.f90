!> The file of a study: a row for each run, whatever order they come in and whatever labels each has; continued, grown
!> and joined studies; what is refused. And the record of a run, read back from its file.
program test_study_file
   use, intrinsic :: iso_c_binding, only: c_int, c_long
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_value, ieee_quiet_nan
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type, system_error
   use files, only: delete_file
   use processes, only: new_process, end_child, stop_process, ended, pause_seconds
   use record, only: record_type
   use record_file, only: write_record, read_record
   use packet, only: packet_type, packet_of, text_type
   use hdf5_file, only: hdf5_type
   use hdf5_rows, only: hdf5_rows_type
   use hdf5_texts, only: hdf5_texts_type
   use hdf5_scales, only: item_type, list_items, read_about
   use parameter_study, only: study_type, study_from_text
   use study_file, only: study_file_type
   use study_header, only: names_taken
   use study_row, only: study_row_type
   use study_builder, only: missing_runs
   use study_layout, only: dimension_type
   use scratch, only: scratch_path, file_there, write_bytes, bytes_of
   use check, only: runs, expect, expect_close, expect_no_error, expect_error, report
   implicit none (type, external)
   !> Runs of the study of most cases; each has other labels than the last.
   integer, parameter :: many = 24
   character(len=*), parameter :: newline = achar(10)
   character(len=:), allocatable :: path, other

   interface
      integer(c_int) function set_limit(resource, limits) bind(c, name='setrlimit')
         import :: c_int, c_long
         integer(c_int), value :: resource
         integer(c_long), intent(in) :: limits(2)
      end function set_limit

      integer(c_int) function get_limit(resource, limits) bind(c, name='getrlimit')
         import :: c_int, c_long
         integer(c_int), value :: resource
         integer(c_long), intent(out) :: limits(2)
      end function get_limit

      integer(c_long) function set_signal(number, action) bind(c, name='signal')
         import :: c_int, c_long
         integer(c_int), value :: number
         integer(c_long), value :: action
      end function set_signal
   end interface

   path = scratch_path('study.h5')
   other = scratch_path('other.h5')
   if (runs('values_and_labels')) call values_and_labels()
   if (runs('labels_twice')) call labels_twice()
   if (runs('any_order')) call any_order()
   if (runs('failed_runs')) call failed_runs()
   if (runs('run_again')) call run_again()
   if (runs('names_of_parameters')) call names_of_parameters()
   if (runs('continued')) call continued()
   if (runs('checkpoints')) call checkpoints()
   if (runs('read_meanwhile')) call read_meanwhile()
   if (runs('grown')) call grown()
   if (runs('other_studies')) call other_studies()
   if (runs('joined')) call joined()
   if (runs('long_study')) call long_study()
   if (runs('full_disk')) call full_disk()
   if (runs('damaged')) call damaged()
   if (runs('wrong_labels')) call wrong_labels()
   if (runs('cut_log')) call cut_log()
   if (runs('damaged_log')) call damaged_log()
   if (runs('sent_rows')) call sent_rows()
   if (runs('ranges')) call ranges()
   if (runs('read_back')) call read_back()
   call clear()
   call report()

contains

   !> Deletes all that a case may leave.
   subroutine clear()
      integer :: i
      call delete_file(path)
      call delete_file(path//'.part')
      call delete_file(path//'.lock')
      call delete_file(path//'.rows')
      call delete_file(path//'.rows.part')
      do i = 1, 3
         call delete_file(other//to_text(i))
      end do
      call delete_file(other)
   end subroutine clear

   !> A study of speeds, marked as the program does.
   subroutine make_study(count, study, step, base)
      integer, intent(in) :: count
      type(study_type), intent(out) :: study
      integer, intent(in), optional :: step
      character(len=*), intent(in), optional :: base
      type(error_type), allocatable :: error
      integer :: stride
      stride = 1
      if (present(step)) stride = step
      call study_from_text('&case title = ''speeds'' /'//newline//'&sweep operation%speed_rpm = 1000:' &
         & //to_text(1000 + (count - 1)*stride)//':'//to_text(stride)//' /', 'case.nml', [character ::], study, error)
      call expect_no_error(error, 'the study')
      if (present(base)) then
         call study%mark(base)
      else
         call study%mark('base')
      end if
   end subroutine make_study

   !> Results of run k: 2 to 4 pads, so that there are other labels of numbers and of texts, and a whirl frequency that
   !> few runs share; every third has a figure that others lack.
   subroutine make_record(k, record)
      integer, intent(in) :: k
      type(record_type), intent(inout) :: record
      character(len=6), allocatable :: names(:)
      integer :: pads, i, n
      call record%clear()
      pads = 2 + mod(k, 3)
      n = 2 + 2*pads
      allocate (names(n))
      names(1:2) = ['y', 'z']
      do i = 1, pads
         names(2 + i) = 'tilt'//to_text(i)
         names(2 + pads + i) = 'move'//to_text(i)
      end do
      call record%put_flag('resumes', mod(k, 2))
      call record%put('pad', [(real(i, wp), i=1, pads)], '1', 'pad number', 'pad')
      call record%put('frequency_ratio', [0.5_wp, 1 + mod(k*7, 5)*0.25_wp], '1', 'whirl frequency', &
         & 'frequency_ratio')
      call record%put_labels('position', names, 'position')
      call record%put('summary/speed', real(k, wp), 'rad/s', 'shaft speed')
      call record%put('summary/orbit', k/3.0_wp, 'm', 'size of the orbit')
      if (mod(k, 3) == 0) call record%put('summary/least_film', -k/7.0_wp, 'm', 'least film')
      call record%put_count('statistics/steps', int(100*k, i8), 'time steps')
      call record%put('equilibrium/load', [(value(k, 0, i, 0), i=1, pads)], 'N', 'force', 'pad')
      call record%put('equilibrium/pad_tilt', [(value(k, 1, i, 0), i=1, pads)], 'rad', 'tilt', 'pad')
      call record%put('coefficients/stiffness', reshape([((value(k, 2, label(names(i)), merge(2, 3 &
         & + mod(k*7, 5), n == 1)), i=1, size(names)), n=1, 2)], [size(names), 2]), 'N/m', 'stiffness', &
         & 'frequency_ratio position')
      call record%put('spectrum/power', [1.0_wp, 2.0_wp], 'W', 'no column', 'frequency_ratio')
   end subroutine make_record

   !> A number for each name of a position.
   pure integer function label(name)
      character(len=*), intent(in) :: name
      label = ichar(name(1:1)) + 10*ichar(name(5:5))
   end function label

   !> The value of run k in dataset j at the labels a and b.
   pure real(wp) function value(k, j, a, b)
      integer, intent(in) :: k, j, a, b
      value = k + j/10.0_wp + a/3e3_wp + b/7e6_wp
   end function value

   !> Adds a row of this record to an open study.
   subroutine add_record(table, k, status, reason, record)
      type(study_file_type), intent(inout) :: table
      integer, intent(in) :: k, status
      character(len=*), intent(in) :: reason
      type(record_type), intent(in) :: record
      type(study_row_type) :: row
      call row%begin('speed_rpm')
      call row%make(record, status == 0)
      call table%add(k, status, reason, row, '')
   end subroutine add_record

   !> Adds these runs to an open study; every other one as if it came from a second process.
   subroutine add(table, numbers)
      type(study_file_type), intent(inout) :: table
      integer, intent(in) :: numbers(:)
      type(record_type) :: records(2)
      type(study_row_type) :: rows(2)
      integer :: i, source
      call rows(1)%begin('speed_rpm')
      call rows(2)%begin('speed_rpm')
      do i = 1, size(numbers)
         source = 1 + mod(i, 2)
         call make_record(numbers(i), records(source))
         call rows(source)%make(records(source), .true.)
         call table%add(numbers(i), 0, '', rows(source), '')
      end do
   end subroutine add

   !> Publishes a study and frees its lock.
   subroutine finish(table)
      type(study_file_type), intent(inout) :: table
      type(error_type), allocatable :: error
      call table%publish(error)
      call expect_no_error(error, 'publish')
      call table%abandon()
   end subroutine finish

   !> A checkpoint, whatever time has passed.
   subroutine checkpoint(table)
      type(study_file_type), intent(inout) :: table
      type(error_type), allocatable :: error
      call table%checkpoint_if_due(huge(1.0_wp), 1.0_wp, error)
      call expect_no_error(error, 'a checkpoint')
   end subroutine checkpoint

   !> The file of a whole study under a name, its runs in this order.
   subroutine write_study(name, count, numbers)
      character(len=*), intent(in) :: name
      integer, intent(in) :: count, numbers(:)
      type(study_type) :: study
      type(study_file_type) :: table
      call make_study(count, study)
      call begin(table, name, study)
      call add(table, numbers)
      call finish(table)
   end subroutine write_study

   subroutine begin(table, name, study)
      type(study_file_type), intent(inout) :: table
      character(len=*), intent(in) :: name
      type(study_type), intent(in) :: study
      type(error_type), allocatable :: error
      call table%claim(name, error)
      call expect_no_error(error, 'claim')
      call table%begin(study, 1, study%runs, error)
      call expect_no_error(error, 'begin')
      call table%start(error)
      call expect_no_error(error, 'start')
   end subroutine begin

   !> Goes on with the study under the path; an error, where it is refused.
   subroutine try_reopening(table, study, other, error)
      type(study_file_type), intent(inout) :: table
      type(study_type), intent(in) :: study
      logical, intent(out) :: other
      type(error_type), allocatable, intent(out) :: error
      call table%claim(path, error)
      call expect_no_error(error, 'claim')
      call table%begin(study, 1, study%runs, error)
      call expect_no_error(error, 'begin')
      call table%take(study, path, other, error)
      if (allocated(error)) then
         call table%abandon()
      else
         call table%start(error)
      end if
   end subroutine try_reopening

   subroutine reopen(table, study)
      type(study_file_type), intent(inout) :: table
      type(study_type), intent(in) :: study
      type(error_type), allocatable :: error
      logical :: other
      call try_reopening(table, study, other, error)
      call expect_no_error(error, 'reopen')
   end subroutine reopen

   !> Reopening is refused with these words; what is of another study might be replaced.
   subroutine expect_refused(study, words, replaceable)
      type(study_type), intent(in) :: study
      character(len=*), intent(in) :: words
      logical, intent(in) :: replaceable
      type(study_file_type) :: table
      type(error_type), allocatable :: error
      logical :: other
      call try_reopening(table, study, other, error)
      call expect_error(error, system_error, words, 'refused')
      call expect(other .eqv. replaceable, 'whether it may be replaced: '//words)
      call expect_nothing_left()
   end subroutine expect_refused

   !> The values of a column in a file, (width, runs).
   subroutine read_column(name, values, extents, in)
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(out) :: values(:, :)
      integer, allocatable, intent(out) :: extents(:)
      character(len=*), intent(in), optional :: in
      type(hdf5_type) :: file
      type(hdf5_rows_type) :: column
      if (present(in)) then
         call file%open(in, writing=.false.)
      else
         call file%open(path, writing=.false.)
      end if
      call column%open(file, name)
      if (.not. allocated(file%failure)) call column%read(file, 1, column%rows, values)
      call expect(.not. allocated(file%failure), name//' is there')
      if (allocated(file%failure)) then
         allocate (values(0, 0), extents(0))
      else
         extents = column%extents
      end if
      call column%close(file)
      call file%close()
   end subroutine read_column

   subroutine read_list(name, texts)
      character(len=*), intent(in) :: name
      type(text_type), allocatable, intent(out) :: texts(:)
      type(hdf5_type) :: file
      type(hdf5_texts_type) :: list
      call file%open(path, writing=.false.)
      call list%open(file, name)
      call list%read(file, 1, list%length, texts)
      call list%close(file)
      call expect(.not. allocated(file%failure), name//' is there')
      call file%close()
   end subroutine read_list

   !> Two files have the same datasets, bit for bit.
   subroutine expect_same(one, two, what)
      character(len=*), intent(in) :: one, two, what
      type(hdf5_type) :: file, second
      type(item_type), allocatable :: items(:), others(:)
      integer :: i
      call file%open(one, writing=.false.)
      call second%open(two, writing=.false.)
      call list_items(file, items)
      call list_items(second, others)
      call expect(size(items) == size(others), what//': as many datasets')
      do i = 1, size(items)
         call expect(second%has(items(i)%path), what//': '//items(i)%path//' in both')
         if (.not. second%has(items(i)%path)) cycle
         if (items(i)%of_texts) then
            call expect_same_texts(file, second, items(i)%path, what)
         else
            call expect_same_values(file, second, items(i)%path, what)
         end if
      end do
      call file%close()
      call second%close()
   end subroutine expect_same

   subroutine expect_same_values(file, second, name, what)
      type(hdf5_type), intent(inout) :: file, second
      character(len=*), intent(in) :: name, what
      type(hdf5_rows_type) :: a, b
      real(wp), allocatable :: x(:, :), y(:, :)
      call a%open(file, name)
      call b%open(second, name)
      call a%read(file, 1, a%rows, x)
      call b%read(second, 1, b%rows, y)
      call a%close(file)
      call b%close(second)
      call expect(all(shape(x) == shape(y)), what//': shape of '//name)
      if (all(shape(x) == shape(y))) call expect(all(transfer(x, [0_i8]) == transfer(y, [0_i8])), what//': '//name)
   end subroutine expect_same_values

   subroutine expect_same_texts(file, second, name, what)
      type(hdf5_type), intent(inout) :: file, second
      character(len=*), intent(in) :: name, what
      type(hdf5_texts_type) :: a, b
      type(text_type), allocatable :: x(:), y(:)
      integer :: i
      logical :: same
      call a%open(file, name)
      call b%open(second, name)
      call a%read(file, 1, a%length, x)
      call b%read(second, 1, b%length, y)
      call a%close(file)
      call b%close(second)
      same = size(x) == size(y)
      if (same) same = all([(x(i)%text == y(i)%text, i=1, size(x))])
      call expect(same, what//': '//name)
   end subroutine expect_same_texts

   !> A root attribute of the file.
   subroutine expect_text(name, expected)
      character(len=*), intent(in) :: name, expected
      type(hdf5_type) :: file
      character(len=:), allocatable :: found
      call file%open(path, writing=.false.)
      call file%get_text(name, found)
      call expect(found == expected, name//': '//found)
      call file%close()
   end subroutine expect_text

   subroutine expect_flag(name, expected)
      character(len=*), intent(in) :: name
      integer, intent(in) :: expected
      type(hdf5_type) :: file
      integer :: found
      call file%open(path, writing=.false.)
      call file%get_flag(name, found)
      call expect(found == expected, name//': '//to_text(found))
      call file%close()
   end subroutine expect_flag

   !> No file is beside the study's.
   subroutine expect_nothing_left()
      call expect(.not. file_there(path//'.part'), 'no part is left')
      call expect(.not. file_there(path//'.lock'), 'no lock is left')
      call expect(.not. file_there(path//'.rows.part'), 'no beginning of a log is left')
   end subroutine expect_nothing_left

   !> Each value is at its run and its labels; all others are not numbers.
   subroutine values_and_labels()
      real(wp), allocatable :: x(:, :)
      type(text_type), allocatable :: names(:)
      integer, allocatable :: extents(:)
      integer :: k, i
      call write_study(path, 8, [5, 1, 3])
      call read_column('run', x, extents)
      call expect(all(nint(x(1, :)) == [(k, k=1, 8)]), 'all runs are numbered')
      call read_column('status', x, extents)
      call expect(all(nint(x(1, :)) == [0, -2, 0, -2, 0, -2, -2, -2]), 'status')
      call read_column('complete', x, extents)
      call expect(all(ieee_is_nan(x(1, :)) .eqv. [.false., .true., .false., .true., .false., .true., .true., &
         & .true.]), 'runs that have no row')
      call read_column('speed_rpm', x, extents)
      call expect(all(nint(x(1, :)) == [(999 + k, k=1, 8)]), 'parameters of all runs')
      call read_column('pad_equilibrium_load', x, extents)
      call expect(all(extents == [4]), 'pads of all runs')
      do i = 1, 4
         call expect(ieee_is_nan(x(i, 3)) .eqv. i > 2, 'pads that run 3 has')
         call expect(ieee_is_nan(x(i, 5)) .eqv. i > 4, 'pads that run 5 has')
         call expect_close(x(i, 5), value(5, 0, i, 0), 0.0_wp, 'a load')
      end do
      call read_column('frequency_ratio', x, extents)
      call expect(all(.not. abs(x(1, :) - [0.5_wp, 1.0_wp, 1.25_wp, 1.5_wp]) > 0), 'labels that are numbers rise')
      call read_list('position', names)
      call expect(size(names) == 10, 'positions')
      call expect(all([(names(i)%text == trim('y    z    tilt1tilt2tilt3tilt4move1move2move3move4'(5*i - 4:5*i)), &
         & i=1, 10)]), 'labels that are texts stand behind those that they follow')
      call read_column('stiffness', x, extents)
      call expect(all(extents == [10, 4]), 'extents')
      ! run 1: ratios 0.5 and 1.5, 3 pads; tilt3 is the fifth position
      call expect_close(x(5 + 30, 1), value(1, 2, label('tilt3 '), 5), 0.0_wp, 'at its labels')
      call expect(ieee_is_nan(x(5 + 20, 1)) .and. ieee_is_nan(x(6, 1)), 'no number at other labels')
      call expect_text('parameters', 'speed_rpm')
      call expect_text('variables', 'operation%speed_rpm')
      call expect_text('task', 'study')
      call expect_text('title', 'speeds')
      call expect_text('missing', '2, 4, 6-8')
      call expect_flag('finished', 0)
      call clear()
   end subroutine values_and_labels

   !> The values do not depend on the order of the rows.
   subroutine any_order()
      integer :: numbers(many), i, k, try, held
      real(wp) :: x
      numbers = [(i, i=1, many)]
      call write_study(path, many, numbers)
      call expect_text('missing', '')
      call expect_flag('finished', 1)
      do try = 1, 10
         do i = many, 2, -1
            call random_number(x)
            k = 1 + int(i*x)
            held = numbers(i)
            numbers(i) = numbers(k)
            numbers(k) = held
         end do
         call write_study(other, many, numbers)
         call expect_same(path, other, 'order '//to_text(try))
      end do
      call clear()
   end subroutine any_order

   !> Of a run that failed what it had before, and why it failed.
   subroutine labels_twice()
      integer, parameter :: labels = 200000
      type(dimension_type) :: numbers, words
      real(wp) :: from, to
      integer :: i
      numbers%numbers = [(real(i, wp), i=1, labels)]
      allocate (numbers%texts(0), words%numbers(0))
      call cpu_time(from)
      call expect(.not. numbers%has_twice(), 'many numbers, each once')
      call cpu_time(to)
      call expect(to - from < 5, 'in a time that rises as their number')
      numbers%numbers(labels) = 7
      call expect(numbers%has_twice(), 'a number twice')
      numbers%numbers = [0.0_wp, -0.0_wp]
      call expect(numbers%has_twice(), 'zero with both signs')
      numbers%numbers = [1.0_wp, ieee_value(1.0_wp, ieee_quiet_nan)]
      call expect(numbers%has_twice(), 'not a number is no label')
      words%has_texts = .true.
      words%texts = [text_type('a'), text_type('b')]
      call expect(.not. words%has_twice(), 'two texts')
      words%texts = [text_type('a'), text_type('b'), text_type('a')]
      call expect(words%has_twice(), 'a text twice')
   end subroutine labels_twice

   subroutine failed_runs()
      type(study_type) :: study
      type(study_file_type) :: table
      type(record_type) :: record
      type(text_type), allocatable :: reasons(:)
      real(wp), allocatable :: x(:, :)
      integer, allocatable :: extents(:)
      call make_study(3, study)
      call begin(table, path, study)
      call make_record(1, record)
      call add_record(table, 1, 2, 'the film closes'//char(255)//newline, record)
      ! it has nothing, but what a run before it had is described
      call record%clear()
      call add_record(table, 2, 3, '', record)
      call expect(table%has_row(1) .and. .not. table%has_row(2) .and. .not. table%has_row(3), 'runs that are to be run')
      call expect(table%status(1) == 2 .and. table%status(2) == 3 .and. table%status(3) == -2, 'status')
      call finish(table)
      call read_column('speed', x, extents)
      call expect_close(x(1, 1), 1.0_wp, 0.0_wp, 'speed')
      call read_column('equilibrium_pad_tilt', x, extents)
      call expect(all(.not. ieee_is_nan(x(:, 1))), 'its equilibrium')
      call expect_without('orbit')
      call read_column('complete', x, extents)
      call expect_close(x(1, 1), 0.0_wp, 0.0_wp, 'not complete')
      call read_list('reason', reasons)
      call expect(reasons(1)%text == 'the film closes??' .and. reasons(2)%text == '' .and. reasons(3)%text == '', &
         & 'reasons, one line of text each')
      call clear()
   end subroutine failed_runs

   !> The file has no such column.
   subroutine expect_without(name)
      character(len=*), intent(in) :: name
      type(hdf5_type) :: file
      call file%open(path, writing=.false.)
      call expect(.not. file%has(name), 'no '//name)
      call file%close()
   end subroutine expect_without

   !> A row in place of another leaves nothing of that.
   subroutine run_again()
      type(study_type) :: study
      type(study_file_type) :: table
      type(record_type) :: record
      integer :: i
      call write_study(other, 4, [1, 2, 3, 4])
      call make_study(4, study)
      call begin(table, path, study)
      do i = 1, 2
         ! a frequency that no other run has
         call make_record(16, record)
         call add_record(table, 2, 3, 'full disk', record)
         call add_record(table, 4, 3, '', record)
         if (i == 1) call checkpoint(table)
      end do
      call add(table, [1, 2, 3, 4])
      call finish(table)
      call expect_same(path, other, 'run again')
      call clear()
   end subroutine run_again

   !> Names, units and meanings of parameters; texts, elements of lists, and names that two groups have.
   subroutine names_of_parameters()
      type(study_type) :: study
      type(study_file_type) :: table
      type(error_type), allocatable :: error
      type(text_type), allocatable :: texts(:)
      call study_from_text('&sweep'//newline//'operation%speed_rpm = 1000, 2000'//newline &
         & //'friction%model = ''lugre'', none'//newline//'rotor%mass = 3'//newline//'pads%mass(2) = 1, 1d-1'//newline &
         & //'rotor%gravity = 9.8'//newline//'oil%supply_temperature = 40'//newline//'/', 'case.nml', [character ::], &
         & study, error)
      call expect_no_error(error, 'the study')
      call begin(table, path, study)
      call finish(table)
      call expect_text('parameters', 'speed_rpm model mass mass_2 gravity supply_temperature')
      call expect_about('speed_rpm', 'rpm', 'speed')
      call expect_about('model', '', 'friction model')
      call expect_about('mass_2', 'kg', 'mass, 2')
      call expect_about('gravity', 'm/s'//char(194)//char(178), 'gravity')
      call expect_about('supply_temperature', char(194)//char(176)//'C', 'supply temperature')
      call read_list('model', texts)
      call expect(texts(1)%text == 'lugre' .and. texts(3)%text == 'none' .and. size(texts) == 8, 'texts')
      call study_from_text('&sweep'//newline//'rotor%mass = 3'//newline//'pads%mass = 1'//newline &
         & //'coefficients%frequency_ratio = 1'//newline//'/', 'case.nml', [character ::], study, error)
      call begin(table, path, study)
      call finish(table)
      call expect_text('parameters', 'rotor_mass pads_mass coefficients_frequency_ratio')
      call expect_about('rotor_mass', 'kg', 'mass (rotor)')
      call expect_about('coefficients_frequency_ratio', '1', 'frequency ratio (coefficients)')
      call clear()
   end subroutine names_of_parameters

   subroutine expect_about(name, units, long_name)
      character(len=*), intent(in) :: name, units, long_name
      type(hdf5_type) :: file
      character(len=:), allocatable :: found_units, found_name
      call file%open(path, writing=.false.)
      call read_about(file, name, found_units, found_name)
      call expect(found_units == units .and. found_name == long_name, name//': '//found_units//', '//found_name)
      call file%close()
   end subroutine expect_about

   !> A study that was given up goes on with all rows that were added, and is the same in the end.
   subroutine continued()
      type(study_type) :: study
      type(study_file_type) :: table
      integer, parameter :: done(*) = [2, 3, 4, 7, 8, 9, 10]
      integer :: i
      call write_study(other, many, [(i, i=1, many)])
      call make_study(many, study)
      call begin(table, path, study)
      call add(table, [7, 2, 3])
      call checkpoint(table)
      call add(table, [8, 9])
      call checkpoint(table)
      call add(table, [10, 4])
      call table%abandon()
      call expect_nothing_left()
      call expect(file_there(path//'.rows'), 'the log stays')
      call reopen(table, study)
      call expect(all([(table%has_row(i), i=1, many)] .eqv. [(any(i == done), i=1, many)]), 'its rows')
      call table%abandon()
      call delete_file(path)
      call reopen(table, study)
      call expect(all([(table%has_row(i), i=1, many)] .eqv. [(any(i == done), i=1, many)]), &
         & 'rows of the log alone')
      call add(table, [1, 5, 6, (i, i=11, many)])
      call finish(table)
      call expect(.not. file_there(path//'.rows'), 'no log is left')
      call expect_same(path, other, 'in two stretches')
      call clear()
   end subroutine continued

   !> Checkpoints come after their time, and while the study is written it has one file beside that of the last.
   subroutine checkpoints()
      type(study_type) :: study
      type(study_file_type) :: table
      type(error_type), allocatable :: error
      real(wp), allocatable :: x(:, :)
      integer, allocatable :: extents(:)
      call make_study(4, study)
      call begin(table, path, study)
      call add(table, [1])
      call table%checkpoint_if_due(0.0_wp, 1.0_wp, error)
      call expect(.not. file_there(path), 'not yet')
      call table%checkpoint_if_due(huge(1.0_wp), 0.0_wp, error)
      call expect(.not. file_there(path), 'never')
      call checkpoint(table)
      call read_column('status', x, extents)
      call expect(nint(x(1, 1)) == 0 .and. nint(x(1, 2)) == -2, 'its rows')
      call expect_text('missing', '2-4')
      call expect(.not. file_there(path//'.part'), 'no part')
      call expect(file_there(path//'.rows'), 'its log')
      call table%abandon()
      call clear()
   end subroutine checkpoints

   !> Anybody can read what was published, though children were started meanwhile.
   subroutine read_meanwhile()
      type(study_type) :: study
      type(study_file_type) :: table
      type(hdf5_type) :: file
      character(len=:), allocatable :: how
      integer :: child, i
      logical :: over
      call make_study(4, study)
      call begin(table, path, study)
      do i = 1, 2
         child = new_process()
         if (child == 0) then
            call pause_seconds(1000)
            call end_child(0)
         end if
         call add(table, [i])
         call checkpoint(table)
         call file%open(path, writing=.false.)
         call expect(.not. allocated(file%failure), 'it can be read')
         call file%close()
         call stop_process(child)
         over = ended(child, .true., how)
      end do
      call add(table, [4, 3])
      call finish(table)
      call write_study(other, 4, [1, 2, 3, 4])
      call expect_same(path, other, 'after a child')
      call clear()
   end subroutine read_meanwhile

   !> A study that has got more runs keeps its rows.
   subroutine grown()
      type(study_type) :: study
      type(study_file_type) :: table
      integer :: i
      call write_study(other, many, [(i, i=1, many)])
      call write_study(path, 5, [1, 2, 3, 5])
      call make_study(many, study)
      call reopen(table, study)
      call expect(all([(table%has_row(i), i=1, many)] .eqv. [(any(i == [1, 2, 3, 5]), i=1, many)]), 'its rows')
      call add(table, [4, (i, i=6, many)])
      call finish(table)
      call expect_same(path, other, 'grown')
      call expect_flag('runs', many)
      call expect_flag('finished', 1)
      call clear()
   end subroutine grown

   !> Files of other studies, of fewer runs, and of no study.
   subroutine other_studies()
      type(study_type) :: study
      type(hdf5_type) :: file
      call write_study(path, 5, [1, 2])
      call make_study(4, study)
      call expect_refused(study, 'is of a study with 5 runs; this one has 4', .true.)
      call make_study(5, study, step=2)
      call expect_refused(study, 'is of another study: its runs have other values', .true.)
      call make_study(9, study, step=2)
      call expect_refused(study, 'is of another study: its runs have other values', .true.)
      call make_study(5, study, base='another base')
      call expect_refused(study, 'is the study of another case', .true.)
      call file%open(path, writing=.true.)
      call file%put_text('task', 'march')
      call file%close()
      call make_study(5, study)
      call expect_refused(study, 'is the result of one run, and not a study', .true.)
      call clear()
   end subroutine other_studies

   !> Blocks that were run apart are the study that was run at once.
   subroutine joined()
      type(study_type) :: study
      type(study_file_type) :: table
      type(record_type) :: record
      type(error_type), allocatable :: error
      real(wp), allocatable :: x(:, :)
      integer, allocatable :: extents(:)
      integer :: i, k, first, last
      logical :: foreign
      call write_study(path, many, [(i, i=1, many)])
      call make_study(many, study)
      do i = 1, 3
         first = (i - 1)*many/3 + 1
         last = i*many/3
         call table%claim(other//to_text(i), error)
         call table%begin(study, first, last, error)
         call expect_no_error(error, 'a block')
         call table%start(error)
         call make_record(1, record)
         if (i == 1) call add_record(table, last + 1, 3, 'no disk', record)
         call add(table, [(k, k=first, last)])
         call finish(table)
      end do
      call read_column('speed_rpm', x, extents, in=other//'1')
      call expect(nint(x(1, 1)) == 1000 .and. ieee_is_nan(x(1, many)), 'a block has the parameters of its runs')
      call begin(table, other, study)
      call add(table, [2])
      do i = 1, 3
         call table%take(study, other//to_text(i), foreign, error)
         call expect_no_error(error, 'a block')
      end do
      call expect(all([(table%has_row(i), i=1, many)]), 'all rows')
      call table%take(study, other//'4', foreign, error)
      call expect_no_error(error, 'no block')
      call write_study(other//'1', many - 1, [1])
      call table%take(study, other//'1', foreign, error)
      call expect_no_error(error, 'of the study before it has grown')
      call write_study(other//'1', many + 1, [1])
      call table%take(study, other//'1', foreign, error)
      call expect_error(error, system_error, 'runs; this one has', 'of a larger study')
      call finish(table)
      call expect_same(path, other, 'joined')
      call clear()
   end subroutine joined

   !> More rows than are held back, in blocks and alone.
   subroutine long_study()
      integer, parameter :: long = 3000
      integer :: i
      real(wp), allocatable :: x(:, :)
      integer, allocatable :: extents(:)
      call write_study(path, long, [(i, i=1, 1999), 2500, (i, i=2998, 2001, -1)])
      call read_column('orbit', x, extents)
      call expect(all(abs(x(1, :1999) - [(i/3.0_wp, i=1, 1999)]) <= 0), 'in their places')
      call expect(all(abs(x(1, 2001:2998) - [(i/3.0_wp, i=2001, 2998)]) <= 0), 'in their places')
      call expect(ieee_is_nan(x(1, 2000)) .and. all(ieee_is_nan(x(1, 2999:))), 'those without rows')
      call expect_text('missing', '2000, 2999-3000')
      call clear()
   end subroutine long_study

   !> A file that cannot get longer: one line says why, and the last checkpoint is there.
   subroutine full_disk()
      integer(c_int), parameter :: file_size = 1, too_long = 25
      integer(c_long), parameter :: ignore = 1
      type(study_type) :: study
      type(study_file_type) :: table
      type(error_type), allocatable :: error
      integer(c_long) :: limits(2), before
      integer :: i, there, status
      call make_study(2000, study)
      call begin(table, path, study)
      call add(table, [1, 2])
      call checkpoint(table)
      status = get_limit(file_size, limits)
      before = set_signal(too_long, ignore)
      status = set_limit(file_size, [300000_c_long, limits(2)])
      call add(table, [(i, i=3, 2000)])
      call table%checkpoint_if_due(0.0_wp, 1.0_wp, error)
      status = set_limit(file_size, limits)
      before = set_signal(too_long, before)
      call expect_error(error, system_error, 'cannot write '//path//'.rows: file too large; '//path//'.rows has the ' &
         & //'rows so far', 'no room')
      call expect_nothing_left()
      call reopen(table, study)
      there = count([(table%has_row(i), i=1, 2000)])
      call expect(there > 100 .and. there < 2000 .and. table%lost() == 0, 'rows for which there was room: ' &
         & //to_text(there))
      call expect(table%has_row(there) .and. .not. table%has_row(there + 1), 'the first of them')
      call add(table, [(i, i=there + 1, 2000)])
      call finish(table)
      call write_study(other, 2000, [(i, i=1, 2000)])
      call expect_same(path, other, 'after a full disk')
      call clear()
   end subroutine full_disk

   !> A file cut off, and one that lacks a column that every study has. Where bytes anywhere are others, it is refused
   !> with one line, now or when it is written, or goes on.
   subroutine damaged()
      type(study_type) :: study
      type(study_file_type) :: table
      type(error_type), allocatable :: error
      type(hdf5_type) :: file
      character(len=:), allocatable :: bytes, wrong
      integer :: i, k, refused
      logical :: other
      real(wp) :: x(9)
      call write_study(path, 5, [1, 2])
      call make_study(5, study)
      bytes = bytes_of(path)
      call write_bytes(path, bytes(:len(bytes)/2))
      call expect_refused(study, 'not a result file', .false.)
      call write_bytes(path, bytes)
      call file%open(path, writing=.true.)
      call file%delete('status')
      call file%close()
      call expect_refused(study, 'damaged: its rows cannot be read', .false.)
      refused = 0
      do i = 1, 60
         call random_number(x)
         wrong = bytes
         do k = 1, 8
            wrong(1 + int(x(9)*(len(bytes) - 8)) + k:1 + int(x(9)*(len(bytes) - 8)) + k) = char(int(256*x(k)))
         end do
         call write_bytes(path, wrong)
         call try_reopening(table, study, other, error)
         if (.not. allocated(error)) then
            call add(table, [3, 4])
            call table%publish(error)
            call table%abandon()
         end if
         call delete_file(path//'.rows')
         if (.not. allocated(error)) cycle
         refused = refused + 1
         call expect(error%status == system_error .and. index(error%message, path) > 0 &
            & .and. index(error%message, newline) == 0, 'one line: '//error%message)
         call expect_nothing_left()
      end do
      call expect(refused > 0, 'some are refused')
      call clear()
   end subroutine damaged

   !> Labels that are no numbers, or are there twice, and a status that no run has: refused, and not replaced.
   subroutine wrong_labels()
      type(study_type) :: study
      real(wp) :: nan
      nan = ieee_value(nan, ieee_quiet_nan)
      call write_study(path, 5, [1, 2])
      call make_study(5, study)
      call change('pad', [1.0_wp, nan, 3.0_wp, 4.0_wp])
      call expect_refused(study, 'damaged: its rows cannot be read', .false.)
      call change('pad', [1.0_wp, 2.0_wp, 2.0_wp, 4.0_wp])
      call expect_refused(study, 'damaged: its rows cannot be read', .false.)
      call change('pad', [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp])
      call change('status', [0.0_wp, 77.0_wp, -2.0_wp, -2.0_wp, -2.0_wp])
      call expect_refused(study, 'damaged: its rows cannot be read', .false.)
      call clear()
   end subroutine wrong_labels

   !> Other values in a dataset of the file.
   subroutine change(name, values)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: values(:)
      type(hdf5_type) :: file
      type(hdf5_rows_type) :: column
      call file%open(path, writing=.true.)
      call column%open(file, name)
      call column%write(file, 1, reshape(values, [1, size(values)]))
      call column%close(file)
      call file%close()
   end subroutine change

   !> A log that was cut anywhere has all rows before, and it is said how much is lost.
   subroutine cut_log()
      type(study_type) :: study
      type(study_file_type) :: table
      character(len=:), allocatable :: bytes
      integer :: i, there, before, length, head
      real(wp) :: x
      call make_study(many, study)
      call begin(table, path, study)
      call add(table, [(i, i=1, many)])
      call table%abandon()
      bytes = bytes_of(path//'.rows')
      before = 0
      head = end_of_header(bytes)
      do i = 1, 50
         call random_number(x)
         length = head + int(x*(len(bytes) - head))
         call write_bytes(path//'.rows', bytes(:length)//repeat(achar(0), merge(0, 777, mod(i, 2) == 0)))
         call reopen(table, study)
         there = count([(table%has_row(before), before=1, many)])
         call expect(all([(table%has_row(before) .eqv. before <= there, before=1, many)]), 'the first rows')
         call expect(there <= many*length/len(bytes) + 3, 'rows that are there')
         call table%abandon()
      end do
      call clear()
   end subroutine cut_log

   !> The last byte of what a log says of its study, behind a line and the head of its frame.
   pure integer function end_of_header(bytes) result(at)
      character(len=*), intent(in) :: bytes
      at = index(bytes, achar(10)) + 16
      at = at + int(transfer(bytes(at - 7:at), 0_i8))
   end function end_of_header

   !> Where bytes of a log are others, the rows that they are of are lost, and no other is.
   subroutine damaged_log()
      type(study_type) :: study
      type(study_file_type) :: table
      character(len=:), allocatable :: bytes, wrong
      integer :: i, k, at, lost, head
      real(wp) :: x
      call make_study(many, study)
      call write_study(other, many, [(k, k=1, many)])
      call begin(table, path, study)
      call add(table, [(i, i=1, many)])
      call table%abandon()
      bytes = bytes_of(path//'.rows')
      head = end_of_header(bytes)
      lost = 0
      do i = 1, 50
         call random_number(x)
         at = head + 1 + int(x*(len(bytes) - head))
         wrong = bytes
         wrong(at:at) = achar(ieor(iachar(wrong(at:at)), 2**mod(i, 8)))
         call write_bytes(path//'.rows', wrong)
         call reopen(table, study)
         lost = lost + count([(.not. table%has_row(k), k=1, many)])
         call add(table, pack([(k, k=1, many)], [(.not. table%has_row(k), k=1, many)]))
         call finish(table)
         call expect_same(path, other, 'a damaged log')
         call delete_file(path)
      end do
      call expect(lost > 0, to_text(lost)//' rows were lost')
      call clear()
   end subroutine damaged_log

   !> Rows that come through packets are those that were sent, with what they have where it changes alone.
   subroutine sent_rows()
      type(study_type) :: study
      type(study_row_type) :: row, got
      type(record_type) :: record
      type(packet_type) :: packed
      integer :: k
      call make_study(3, study)
      call expect(index(names_taken(study)//' ', ' speed_rpm ') > 0, 'names of parameters')
      call row%begin(names_taken(study))
      do k = 1, many
         call make_record(k, record)
         call row%make(record, mod(k, 5) /= 0)
         packed = packet_type()
         call row%exchange(packed)
         packed = packet_of(packed%bytes())
         call got%exchange(packed)
         call expect(packed%at_end(), 'all of it')
         call expect(got%description == row%description .and. got%remarks == '', 'what it has')
         call expect(size(got%numbers) == size(row%numbers), 'as many numbers')
         call expect(all(transfer(got%numbers, [0_i8]) == transfer(row%numbers, [0_i8])), 'numbers')
      end do
      packed = packet_of('abc')
      call got%exchange(packed)
      call expect(.not. packed%ok, 'no packet')
   end subroutine sent_rows

   subroutine ranges()
      integer :: i
      call expect(missing_runs([logical ::]) == '', 'no run')
      call expect(missing_runs([.false., .false.]) == '', 'none')
      call expect(missing_runs([.true., .true.]) == '1-2', 'all')
      call expect(missing_runs([.false., .true., .false., .true., .true., .true.]) == '2, 4-6', 'some')
      call expect(len(missing_runs([(mod(i, 2) == 0, i=1, 10000)])) == sum([(len(to_text(i)) + 2, i=2, 10000, 2)]) &
         & - 2, 'many')
   end subroutine ranges

   !> What is read from the file of a run is what was written; but no series and no checkpoint.
   subroutine read_back()
      type(hdf5_type) :: file
      type(record_type) :: record, found
      integer :: i, k, value
      logical :: same
      call make_record(3, record)
      call file%create(path)
      call write_record(record, file, all=.true.)
      call file%close()
      call file%open(path, writing=.false.)
      call read_record(file, found)
      call expect(.not. allocated(file%failure), 'it can be read')
      call file%close()
      call expect(found%count == record%count, 'as many datasets')
      do i = 1, record%count
         associate (own => record%datasets(i))
            do k = 1, found%count
               if (found%datasets(k)%path == own%path) exit
            end do
            call expect(k <= found%count, own%path//' is there')
            if (k > found%count) cycle
            associate (read => found%datasets(k))
               same = read%units == own%units .and. read%long_name == own%long_name .and. read%scales == own%scales &
                  & .and. read%kind == own%kind .and. read%texts == own%texts .and. read%there &
                  & .and. size(read%extents) == size(own%extents) .and. size(read%values) == size(own%values)
               if (same) same = all(read%extents == own%extents) .and. all(.not. abs(read%values - own%values) > 0)
               call expect(same, own%path//': units, meaning, scales and values')
            end associate
         end associate
      end do
      call found%get_flag('resumes', value)
      call expect(value == 1, 'resumes')
      call clear()
   end subroutine read_back
end program test_study_file
