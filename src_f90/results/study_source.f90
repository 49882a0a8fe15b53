!> What there is of a study under a name: its log, NAME.rows, and its table, NAME.h5. The log of a study has all rows
!> that its table has, unless somebody has put another table there.
module study_source
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, system_error
   use files, only: is_regular, real_path
   use parameter_study, only: study_type, run_tag
   use hdf5_file, only: hdf5_type
   use hdf5_rows, only: hdf5_rows_type, most_rows
   use hdf5_texts, only: hdf5_texts_type
   use hdf5_scales, only: item_type, list_items, scales_of, read_about, word => scale_name, scale_count
   use guarded_open, only: new_reader
   use packet, only: packet_type, text_type
   use processes, only: end_child, exit_status
   use restart, only: open_result
   use study_header, only: header_type
   use study_layout, only: layout_type, dimension_type, column_type, most_labels
   use study_log, only: study_log_type, row_type, not_run, stays, text_names
   use study_builder, only: run_scale, columns_mark
   use verification_results, only: states_figure
   implicit none (type, external)
   private
   public :: take_rows, read_states, log_path, is_collected, is_study

   !> What the name of a log has behind that of the study's file.
   character(len=*), parameter, public :: log_ending = '.rows'
   character(len=*), parameter :: marks_name = 'study_marks'

   !> A table that is open.
   type :: open_table_type
      type(hdf5_type) :: file
      type(layout_type) :: layout
      type(hdf5_rows_type), allocatable :: columns(:)
      integer, allocatable :: status(:)
   contains
      procedure :: open => open_table
      procedure :: close => close_table
   end type open_table_type

contains

   !> The log of the study that is written to PATH.
   function log_path(path)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: log_path
      log_path = real_path(path)//log_ending
   end function log_path

   !> The exit status of each run of a study, where log or table of a path have a row of it that `status` has not, or
   !> only one that the system has failed; these rows are added to `log`. `other` is true where what is there is whole,
   !> but not of this study, so that it may be replaced. `origin` says when the study was begun, and
   !> by which builds the rows were made. A table whose columns were changed is refused, unless `columns` says that they
   !> do not matter.
   subroutine take_rows(path, study, status, other, error, log, origin, columns)
      character(len=*), intent(in) :: path
      type(study_type), intent(in) :: study
      integer, intent(inout) :: status(:)
      logical, intent(out) :: other
      type(error_type), allocatable, intent(out) :: error
      type(study_log_type), intent(inout), optional :: log
      type(header_type), intent(inout), optional :: origin
      logical, intent(in), optional :: columns
      type(study_log_type) :: there
      type(open_table_type) :: table
      logical, allocatable :: wanted(:)
      logical :: rows
      other = .false.
      rows = .true.
      if (present(columns)) rows = columns
      if (is_regular(log_path(path))) then
         call there%open(log_path(path), error)
         if (.not. allocated(error)) call check_marks(log_path(path), there%header%runs, there%header%marks, study, &
            & other, error)
         if (.not. allocated(error)) then
            wanted = lacking(status, there%status)
            if (present(log)) call log%take(there, wanted, error)
            where (wanted) status(:size(wanted)) = there%status
            if (present(origin) .and. any(wanted)) origin = there%header
         end if
         call there%close()
      end if
      if (allocated(error) .or. .not. is_regular(path)) return
      call table%open(path, study, other, error, rows)
      if (.not. allocated(error)) then
         wanted = lacking(status, table%status)
         if (present(log)) call take_table(table, path, wanted, log, error)
         where (wanted) status(:size(wanted)) = table%status
         if (present(origin) .and. any(wanted)) call read_origin(table%file, origin)
      end if
      call table%close()
   end subroutine take_rows

   !> States of each run whose films were solved closely, by the table of a study; 0 where none were.
   subroutine read_states(path, study, states, error)
      character(len=*), intent(in) :: path
      type(study_type), intent(in) :: study
      integer, allocatable, intent(out) :: states(:)
      type(error_type), allocatable, intent(out) :: error
      type(open_table_type) :: table
      real(wp), allocatable :: values(:, :)
      logical :: other
      integer :: c, k
      allocate (states(study%runs), source=0)
      if (.not. is_regular(path)) return
      call table%open(path, study, other, error, rows=.true.)
      if (allocated(error)) return
      c = table%layout%find(states_figure)
      if (c > 0) then
         call table%columns(c)%read(table%file, 1, size(table%status), values)
         do k = 1, size(values, 2)
            if (.not. ieee_is_nan(values(1, k))) states(k) = nint(values(1, k))
         end do
      end if
      call table%close()
   end subroutine read_states

   !> Which rows are there that are not yet known, or only of runs that the system has failed.
   pure function lacking(known, there) result(wanted)
      integer, intent(in) :: known(:), there(:)
      logical :: wanted(size(there))
      wanted = there /= not_run .and. .not. stays(known(:size(there)))
   end function lacking

   !> When a study was begun, unless that is known, and which builds made its rows, beside those that are known.
   subroutine read_origin(file, origin)
      class(hdf5_type), intent(inout) :: file
      type(header_type), intent(inout) :: origin
      character(len=:), allocatable :: builds
      if (.not. allocated(origin%created)) call file%get_text('created', origin%created)
      call file%get_text('version', builds)
      call origin%add_builds(builds)
   end subroutine read_origin

   !> Refuses what is of another study than this one, which may be replaced, or of one with more runs.
   subroutine check_marks(path, runs, marks, study, other, error)
      character(len=*), intent(in) :: path, marks
      integer, intent(in) :: runs
      type(study_type), intent(in) :: study
      logical, intent(out) :: other
      type(error_type), allocatable, intent(out) :: error
      type(run_tag) :: first, last
      other = .false.
      if (runs < 1) then
         call raise(error, system_error, path//': damaged: a study without runs')
         return
      else if (runs > study%runs) then
         call raise(error, system_error, path//': is of a study with '//to_text(runs)//' runs; this one has ' &
            & //to_text(study%runs))
      else
         call study%tag(1, first)
         call study%tag(runs, last)
         if (marks == '' .or. first%marks == '') return
         if (word(first%marks, 1) /= word(marks, 1)) then
            call raise(error, system_error, path//': is the study of another case, or of files that have ' &
               & //'changed since')
         else if (word(last%marks, 2) /= word(marks, 2)) then
            call raise(error, system_error, path//': is of another study: its runs have other values')
         end if
      end if
      other = allocated(error)
   end subroutine check_marks

   !> Whether a file is a study that tiltpad-collect made of results.
   logical function is_collected(path)
      character(len=*), intent(in) :: path
      logical :: marked
      is_collected = is_study(path, marked)
      if (is_collected) is_collected = .not. marked
   end function is_collected

   !> Whether a file is a study; `marked`: one that the program has performed. What cannot be read is none.
   logical function is_study(path, marked)
      character(len=*), intent(in) :: path
      logical, intent(out) :: marked
      type(hdf5_type) :: file
      type(error_type), allocatable :: error
      character(len=:), allocatable :: task
      is_study = .false.
      marked = .false.
      call open_result(path, file, error)
      if (allocated(error)) return
      call file%get_text('task', task)
      if (task == 'study') marked = file%has_attribute(marks_name)
      is_study = task == 'study' .and. .not. allocated(file%failure)
      call file%close()
   end function is_study

   !> Opens a table for reading, once a child process has read it, and reads the status of its runs and, for its rows,
   !> what else it has.
   subroutine open_table(self, path, study, other, error, rows)
      class(open_table_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(study_type), intent(in) :: study
      logical, intent(out) :: other
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in) :: rows
      character(len=:), allocatable :: task, marks
      logical :: older
      integer :: runs
      call open_result(path, self%file, error, older)
      other = older
      if (allocated(error)) return
      other = .true.
      marks = ''
      runs = 0
      call self%file%get_text('task', task)
      if (task /= 'study') then
         call raise(error, system_error, path//': is the result of one run, and not a study')
      else if (.not. self%file%has_attribute(marks_name)) then
         call raise(error, system_error, path//': is a study that tiltpad-collect wrote')
      else
         call self%file%get_flag('runs', runs)
         call self%file%get_text(marks_name, marks)
      end if
      if (allocated(self%file%failure)) then
         other = .false.
         call raise(error, system_error, path//': damaged: '//self%file%failure)
      end if
      if (.not. allocated(error)) call check_marks(path, runs, marks, study, other, error)
      if (allocated(error)) return
      call read_guarded(self, path, runs, rows, error)
   end subroutine open_table

   !> Reads the status of the runs of a table, or its layout, in a child process first, which then reads all texts, too.
   subroutine read_guarded(self, path, runs, rows, error)
      class(open_table_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer, intent(in) :: runs
      logical, intent(in) :: rows
      type(error_type), allocatable, intent(out) :: error
      integer :: child
      child = new_reader()
      if (child == 0) then
         call read_part(self, runs, rows)
         if (rows .and. .not. allocated(self%file%failure)) call read_all_texts(self)
         call end_child(merge(1, 0, allocated(self%file%failure)))
      else if (child < 0) then
         call raise(error, system_error, 'cannot read '//path//': no process could be started for it')
      else if (exit_status(child) /= 0) then
         call raise(error, system_error, path//': damaged: its rows cannot be read')
      else
         call read_part(self, runs, rows)
         if (rows .and. .not. allocated(self%file%failure)) call check_columns(self, path, error)
         if (allocated(self%file%failure)) call raise(error, system_error, path//': damaged: '//self%file%failure)
      end if
   end subroutine read_guarded

   !> The layout for the rows of a table, or the status of its runs alone.
   subroutine read_part(self, runs, rows)
      class(open_table_type), intent(inout) :: self
      integer, intent(in) :: runs
      logical, intent(in) :: rows
      if (rows) then
         call read_layout(self, runs)
      else
         call read_status(self, runs)
      end if
   end subroutine read_part

   subroutine check_columns(self, path, error)
      class(open_table_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: marked
      marked = to_text(self%layout%mark())
      ! earlier versions wrote none
      if (self%file%has_attribute(columns_mark)) call self%file%get_text(columns_mark, marked)
      if (marked /= to_text(self%layout%mark())) call raise(error, system_error, path//': its columns have other ' &
         & //'names, units or labels than the program gave them; something else has changed them')
   end subroutine check_columns

   subroutine read_all_texts(self)
      class(open_table_type), intent(inout) :: self
      type(hdf5_texts_type) :: list
      type(text_type), allocatable :: texts(:)
      integer :: i
      do i = 1, size(text_names)
         if (.not. self%file%has(trim(text_names(i)))) cycle
         call list%open(self%file, trim(text_names(i)))
         call list%read(self%file, 1, list%length, texts)
         call list%close(self%file)
      end do
   end subroutine read_all_texts

   !> Reads which columns a table has, and opens them: all numbers over its runs but status and parameters.
   subroutine read_layout(self, runs)
      class(open_table_type), intent(inout) :: self
      integer, intent(in) :: runs
      type(item_type), allocatable :: found(:)
      type(hdf5_rows_type) :: column
      character(len=:), allocatable :: parameters, scales
      integer :: i, k
      call self%file%get_text('parameters', parameters)
      call list_items(self%file, found)
      allocate (self%layout%dimensions(0), self%layout%columns(0), self%columns(0))
      do i = 1, size(found)
         if (.not. found(i)%is_scale .or. found(i)%path == run_scale) cycle
         self%layout%dimensions = [self%layout%dimensions, dimension_of(self%file, found(i))]
      end do
      do i = 1, size(found)
         if (.not. found(i)%is_dataset .or. found(i)%is_scale .or. found(i)%of_texts) cycle
         if (index(' '//parameters//' ', ' '//found(i)%path//' ') > 0) cycle
         scales = scales_of(self%file, found(i), found)
         if (allocated(self%file%failure)) return
         if (word(scales, 1) /= run_scale .or. found(i)%path == 'status') cycle
         call column%open(self%file, found(i)%path)
         if (allocated(self%file%failure)) return
         if (column%rows /= runs) call self%file%check_read(-1, 'find as many rows as there are runs')
         self%columns = [self%columns, column]
         self%layout%columns = [self%layout%columns, column_of(self%file, found(i)%path, self%layout, &
            & [(self%layout%find_dimension(word(scales, k)), k=2, scale_count(scales))])]
         if (allocated(self%file%failure)) return
         if (any(column%extents /= self%layout%extents(size(self%columns)))) call self%file%check_read(-1, &
            & 'find the labels of '//found(i)%path)
      end do
      if (self%layout%find('complete') == 0) call self%file%check_read(-1, 'find the columns of a study')
      call self%layout%place()
      call read_status(self, runs)
   end subroutine read_layout

   !> Reads the status of each run.
   subroutine read_status(self, runs)
      class(open_table_type), intent(inout) :: self
      integer, intent(in) :: runs
      type(hdf5_rows_type) :: column
      real(wp), allocatable :: values(:, :)
      call column%open(self%file, 'status')
      if (allocated(self%file%failure)) return
      if (column%rows /= runs) call self%file%check_read(-1, 'find as many rows as there are runs')
      if (allocated(self%file%failure)) return
      call column%read(self%file, 1, runs, values)
      call column%close(self%file)
      if (.not. allocated(self%file%failure)) call take_status(self, values(1, :))
   end subroutine read_status

   subroutine take_status(self, values)
      class(open_table_type), intent(inout) :: self
      real(wp), intent(in) :: values(:)
      integer :: k
      logical :: known
      known = .not. any(ieee_is_nan(values))
      if (known) known = all([(any(abs(values(k) - [-2, -1, 0, 1, 2, 3, 4]) <= 0), k=1, size(values))])
      if (.not. known) then
         call self%file%check_read(-1, 'find the status of runs')
         return
      end if
      self%status = nint(values)
   end subroutine take_status

   !> A column of a table, over these dimensions of its layout.
   function column_of(file, name, layout, over) result(column)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      type(layout_type), intent(in) :: layout
      integer, intent(in) :: over(:)
      type(column_type) :: column
      column%name = name
      column%over = over
      call read_about(file, name, column%units, column%long_name)
      if (any(over < 1 .or. over > size(layout%dimensions))) call file%check_read(-1, 'find the dimensions of '//name)
   end function column_of

   !> The dimension that a scale of a table is.
   function dimension_of(file, item) result(found)
      class(hdf5_type), intent(inout) :: file
      type(item_type), intent(in) :: item
      type(dimension_type) :: found
      type(hdf5_texts_type) :: list
      type(hdf5_rows_type) :: column
      real(wp), allocatable :: values(:, :)
      found%name = item%path
      found%has_texts = item%of_texts
      call read_about(file, item%path, found%units, found%long_name)
      if (item%of_texts) then
         call list%open(file, item%path)
         if (list%length > most_labels) call file%check_read(-1, 'take memory for '//item%path)
         call list%read(file, 1, min(list%length, most_labels), found%texts)
         call list%close(file)
         found%numbers = [real(wp) ::]
      else
         call column%open(file, item%path)
         if (column%rows > most_labels) call file%check_read(-1, 'take memory for '//item%path)
         call column%read(file, 1, min(column%rows, most_labels), values)
         call column%close(file)
         found%numbers = [values]
         allocate (found%texts(0))
      end if
      if (found%has_twice()) call file%check_read(-1, 'tell the labels of '//item%path//' from each other')
   end function dimension_of

   !> Adds the rows of a table that are wanted to a log, some at a time.
   subroutine take_table(self, path, wanted, log, error)
      class(open_table_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      logical, intent(in) :: wanted(:)
      type(study_log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      type(hdf5_texts_type) :: lists(size(text_names))
      type(packet_type) :: packed
      integer :: i, first, description
      if (.not. any(wanted)) return
      call self%layout%exchange(packed)
      call log%describe(packed%bytes(), description, error)
      if (allocated(error)) return
      do i = 1, size(lists)
         if (self%file%has(trim(text_names(i)))) call lists(i)%open(self%file, trim(text_names(i)))
      end do
      do first = 1, size(wanted), most_rows
         if (.not. any(wanted(first:min(first + most_rows - 1, size(wanted))))) cycle
         call take_some(self, lists, first, wanted(first:min(first + most_rows - 1, size(wanted))), description, log, &
            & error)
         if (allocated(self%file%failure)) call raise(error, system_error, path//': damaged: '//self%file%failure)
         if (allocated(error)) exit
      end do
      do i = 1, size(lists)
         call lists(i)%close(self%file)
      end do
   end subroutine take_table

   !> The same of the rows from the `first` on.
   subroutine take_some(self, lists, first, wanted, description, log, error)
      class(open_table_type), intent(inout) :: self
      type(hdf5_texts_type), intent(in) :: lists(:)
      integer, intent(in) :: first, description
      logical, intent(in) :: wanted(:)
      type(study_log_type), intent(inout) :: log
      type(error_type), allocatable, intent(out) :: error
      type(text_type), allocatable :: texts(:)
      type(row_type) :: rows(size(wanted))
      real(wp), allocatable :: values(:, :), part(:, :)
      integer :: c, k
      allocate (values(self%layout%width, size(wanted)))
      do c = 1, size(self%columns)
         associate (own => self%layout%columns(c))
            call self%columns(c)%read(self%file, first, size(wanted), part)
            if (allocated(self%file%failure)) return
            values(own%before + 1:own%before + own%width, :) = part
         end associate
      end do
      do c = 1, size(lists)
         if (lists(c)%id < 0) then
            texts = spread(text_type(''), 1, size(wanted))
         else
            call lists(c)%read(self%file, first, size(wanted), texts)
         end if
         do k = 1, size(wanted)
            rows(k)%texts(c) = texts(k)
         end do
      end do
      do k = 1, size(wanted)
         if (.not. wanted(k) .or. allocated(self%file%failure)) cycle
         rows(k)%run = first + k - 1
         rows(k)%status = self%status(first + k - 1)
         rows(k)%description = description
         rows(k)%numbers = values(:, k)
         call log%add(rows(k), error)
         if (allocated(error)) return
      end do
   end subroutine take_some

   subroutine close_table(self)
      class(open_table_type), intent(inout) :: self
      integer :: c
      if (allocated(self%columns)) then
         do c = 1, size(self%columns)
            call self%columns(c)%close(self%file)
         end do
         deallocate (self%columns)
      end if
      call self%file%close()
   end subroutine close_table
end module study_source
