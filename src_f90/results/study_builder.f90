!> Makes the table of a study, its HDF5 file, from its log: a row for each run, at its number from the beginning, with
!> the parameters of all runs. It has the columns, and along its dimensions the labels, that any of its rows has.
module study_builder
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_nan
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type, raise, system_error
   use packet, only: text_type
   use hdf5_file, only: hdf5_type
   use hdf5_rows, only: hdf5_rows_type, most_rows
   use hdf5_texts, only: hdf5_texts_type
   use study_layout, only: layout_type, column_type
   use study_log, only: study_log_type, row_type, not_run, unreadable, text_names, text_meanings
   implicit none (type, external)
   private
   public :: write_table, missing_runs, run_scale, columns_mark

   !> The scale of the runs, and of the pads.
   character(len=*), parameter :: run_scale = 'run', pads = 'pad'
   !> The attribute with a checksum of what columns it has.
   character(len=*), parameter :: columns_mark = 'columns_mark'
   character(len=*), parameter :: status_meaning = 'exit status: 0 done, 2 numerics, 3 system, 4 stopped, ' &
      & //'-1 not ended, -2 not run yet; nan: its file cannot be read'
   !> Numbers that are held at a time, and layouts.
   integer, parameter :: most_numbers = 1000000, most_known = 16

   !> What rows of a description have, which of its columns are in the table, and the places of their numbers there.
   type :: known_type
      integer :: number = 0
      type(layout_type) :: layout
      logical, allocatable :: taken(:)
      integer, allocatable :: at(:)
   end type known_type

   type :: table_type
      type(layout_type) :: layout
      type(known_type) :: known(most_known)
      !> Which of the texts it has: reasons in any case.
      logical :: has_texts(size(text_names)) = text_names == 'reason'
   end type table_type

contains

   !> Writes all of a log into a new file that is open. The file keeps what fails in writing it.
   subroutine write_table(log, file, error)
      type(study_log_type), intent(inout) :: log
      class(hdf5_type), intent(inout) :: file
      type(error_type), allocatable, intent(out) :: error
      type(table_type) :: table
      call put_origin(log, file)
      call put_parameters(log, file)
      call find_columns(log, table, error)
      if (allocated(error)) return
      if (.not. log%header%is_collected) call file%put_text(columns_mark, to_text(table%layout%mark()))
      call put_dimensions(table%layout, file)
      call put_status(log, file)
      call put_rows(log, table, file, error)
   end subroutine write_table

   !> What the file is and who made it, and which runs it lacks.
   subroutine put_origin(log, file)
      type(study_log_type), intent(in) :: log
      class(hdf5_type), intent(inout) :: file
      associate (header => log%header)
         call file%put_flag('format_version', header%format_version)
         call file%put_text('program', 'tiltpad')
         call file%put_text('version', header%version)
         call file%put_text('created', header%created)
         call file%put_text('task', 'study')
         call file%put_text('title', header%title)
         call file%put_text('input', header%input)
         call file%put_text('parameters', header%names())
         call file%put_text('variables', header%variables())
         call file%put_flag('runs', header%runs)
         if (header%is_collected) then
            call file%put_text('missing', header%missing)
         else
            call file%put_text('study_marks', header%marks)
            call file%put_flag('finished', merge(0, 1, any(log%status == not_run)))
            call file%put_text('missing', missing_runs(log%status == not_run))
         end if
      end associate
   end subroutine put_origin

   !> The numbers of the runs, and their values of the parameters.
   subroutine put_parameters(log, file)
      type(study_log_type), intent(in) :: log
      class(hdf5_type), intent(inout) :: file
      integer :: i
      call put_numbers(file, run_scale, log%header%numbers, 0.0_wp, .true., '1', 'number of the run', run_scale, '')
      do i = 1, size(log%header%parameters)
         associate (own => log%header%parameters(i))
            if (own%is_text) then
               call put_list(file, own%name, own%texts, own%units, own%long_name, run_scale)
            else
               call put_numbers(file, own%name, own%numbers, ieee_value(1.0_wp, ieee_quiet_nan), .false., own%units, &
                  & own%long_name, run_scale, '')
            end if
         end associate
      end do
   end subroutine put_parameters

   !> A dataset of one number a row, or a scale. Where all of a stretch is `fill` it takes no room.
   subroutine put_numbers(file, name, values, fill, whole, units, long_name, scales, coordinates)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name, units, long_name, scales, coordinates
      real(wp), intent(in) :: values(:), fill
      logical, intent(in) :: whole
      type(hdf5_rows_type) :: column
      integer :: first, last
      call column%create(file, name, [integer ::], size(values), fill, whole)
      call file%describe(column%id, units, long_name, scales, name)
      if (coordinates /= '') call file%write_attribute(column%id, 'coordinates', coordinates)
      do first = 1, size(values), most_rows
         last = min(first + most_rows - 1, size(values))
         associate (part => values(first:last))
            ! bit for bit, as this may be not a number
            if (all(transfer(part, [0_i8]) == transfer(fill, 0_i8))) cycle
            call column%write(file, first, reshape(part, [1, size(part)]))
         end associate
      end do
      call column%close(file)
   end subroutine put_numbers

   !> A dataset of one text a row, or a scale of texts.
   subroutine put_list(file, name, texts, units, long_name, scales)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name, units, long_name, scales
      type(text_type), intent(in) :: texts(:)
      type(hdf5_texts_type) :: list
      integer :: first
      call create_list(file, name, size(texts), units, long_name, scales, '', list)
      do first = 1, size(texts), most_rows
         call write_texts(file, list, first, texts(first:min(first + most_rows - 1, size(texts))))
      end do
      call list%close(file)
   end subroutine put_list

   subroutine create_list(file, name, rows, units, long_name, scales, coordinates, list)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name, units, long_name, scales, coordinates
      integer, intent(in) :: rows
      type(hdf5_texts_type), intent(inout) :: list
      call list%create(file, name, rows)
      if (allocated(file%failure)) return
      call file%describe(list%id, units, long_name, scales, name)
      if (coordinates /= '') call file%write_attribute(list%id, 'coordinates', coordinates)
   end subroutine create_list

   !> Writes texts from the `first` row on, unless all are empty.
   subroutine write_texts(file, list, first, texts)
      class(hdf5_type), intent(inout) :: file
      type(hdf5_texts_type), intent(in) :: list
      integer, intent(in) :: first
      type(text_type), intent(in) :: texts(:)
      integer :: i
      if (any([(len(texts(i)%text) > 0, i=1, size(texts))])) call list%write(file, first, texts)
   end subroutine write_texts

   !> Finds the columns of the table: those that have a number in any row.
   subroutine find_columns(log, table, error)
      type(study_log_type), intent(inout) :: log
      type(table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error
      type(row_type) :: row
      integer :: k, i
      allocate (table%layout%dimensions(0))
      ! every study has it
      table%layout%columns = [column_type('complete', '1', '1 where the run reached its end')]
      allocate (table%layout%columns(1)%over(0))
      do k = 1, size(log%status)
         if (log%status(k) == not_run) cycle
         call read_row(log, table, k, row, i, error)
         if (allocated(error)) return
         call take_columns(table%layout, table%known(i), row%numbers)
         table%has_texts = table%has_texts .or. [(row%texts(i)%text /= '', i=1, size(row%texts))]
      end do
      call table%layout%place()
      do i = 1, most_known
         table%known(i)%number = 0
      end do
   end subroutine find_columns

   !> Reads a row; what it has is that of known(i).
   subroutine read_row(log, table, k, row, i, error)
      type(study_log_type), intent(inout) :: log
      type(table_type), intent(inout) :: table
      integer, intent(in) :: k
      type(row_type), intent(out) :: row
      integer, intent(out) :: i
      type(error_type), allocatable, intent(out) :: error
      integer :: c
      i = 1
      call log%row(k, row, error)
      if (allocated(error)) return
      i = 1 + mod(row%description, most_known)
      associate (own => table%known(i))
         if (own%number /= row%description) then
            call log%layout(row%description, own%layout, error)
            if (allocated(error)) return
            own%number = row%description
            own%taken = spread(.false., 1, size(own%layout%columns))
            own%at = spread(0, 1, own%layout%width)
            do c = 1, size(own%layout%columns)
               associate (column => own%layout%columns(c))
                  own%at(column%before + 1:column%before + column%width) = table%layout%places_of(own%layout, c)
               end associate
            end do
         end if
         if (size(row%numbers) /= own%layout%width) call raise(error, system_error, 'damaged: run '//to_text(k) &
            & //' has another number of results than it says')
      end associate
   end subroutine read_row

   !> Takes the columns of a row that have a number, and with the first of them all pads.
   subroutine take_columns(layout, own, numbers)
      type(layout_type), intent(inout) :: layout
      type(known_type), intent(inout) :: own
      real(wp), intent(in) :: numbers(:)
      integer :: c, d
      do c = 1, size(own%taken)
         if (own%taken(c)) cycle
         associate (column => own%layout%columns(c))
            if (all(ieee_is_nan(numbers(column%before + 1:column%before + column%width)))) cycle
         end associate
         call layout%take_column(own%layout, c)
         if (count(own%taken) == 1) then
            do d = 1, size(own%layout%dimensions)
               associate (name => own%layout%dimensions(d)%name)
                  if (name(index(name, '/', back=.true.) + 1:) == pads) call layout%take_dimension( &
                     & own%layout%dimensions(d))
               end associate
            end do
         end if
         own%taken(c) = .true.
      end do
   end subroutine take_columns

   subroutine put_dimensions(layout, file)
      type(layout_type), intent(in) :: layout
      class(hdf5_type), intent(inout) :: file
      integer :: d
      do d = 1, size(layout%dimensions)
         associate (own => layout%dimensions(d))
            if (own%has_texts) then
               call put_list(file, own%name, own%texts, own%units, own%long_name, own%name)
            else
               call put_numbers(file, own%name, own%numbers, ieee_value(1.0_wp, ieee_quiet_nan), .false., own%units, &
                  & own%long_name, own%name, '')
            end if
         end associate
      end do
   end subroutine put_dimensions

   subroutine put_status(log, file)
      type(study_log_type), intent(in) :: log
      class(hdf5_type), intent(inout) :: file
      real(wp) :: status(size(log%status))
      status = log%status
      where (log%status == unreadable) status = ieee_value(1.0_wp, ieee_quiet_nan)
      call put_numbers(file, 'status', status, real(not_run, wp), .not. log%header%is_collected, '1', status_meaning, &
         & run_scale, log%header%names())
   end subroutine put_status

   !> Writes the numbers and texts of all rows, some rows at a time.
   subroutine put_rows(log, table, file, error)
      type(study_log_type), intent(inout) :: log
      type(table_type), intent(inout) :: table
      class(hdf5_type), intent(inout) :: file
      type(error_type), allocatable, intent(out) :: error
      type(hdf5_rows_type) :: columns(size(table%layout%columns))
      type(hdf5_texts_type) :: lists(size(text_names))
      type(text_type), allocatable :: texts(:, :)
      real(wp), allocatable :: values(:, :)
      integer :: c, first, last, block
      call create_columns(log, table%layout, file, columns)
      do c = 1, size(lists)
         if (table%has_texts(c)) call create_list(file, trim(text_names(c)), size(log%status), '', &
            & trim(text_meanings(c)), run_scale, log%header%names(), lists(c))
      end do
      block = max(1, min(most_rows, most_numbers/table%layout%width))
      do first = 1, size(log%status), block
         last = min(first + block - 1, size(log%status))
         if (all(log%status(first:last) == not_run)) cycle
         call read_rows(log, table, first, last, values, texts, error)
         if (allocated(error) .or. allocated(file%failure)) exit
         do c = 1, size(columns)
            associate (own => table%layout%columns(c))
               call columns(c)%write(file, first, values(own%before + 1:own%before + own%width, :))
            end associate
         end do
         do c = 1, size(lists)
            if (table%has_texts(c)) call write_texts(file, lists(c), first, texts(:, c))
         end do
      end do
      do c = 1, size(columns)
         call columns(c)%close(file)
      end do
      do c = 1, size(lists)
         call lists(c)%close(file)
      end do
   end subroutine put_rows

   !> Numbers, values(width, row), and texts of the rows from the `first` to the `last`; not a number and empty where
   !> there are none.
   subroutine read_rows(log, table, first, last, values, texts, error)
      type(study_log_type), intent(inout) :: log
      type(table_type), intent(inout) :: table
      integer, intent(in) :: first, last
      real(wp), allocatable, intent(out) :: values(:, :)
      type(text_type), allocatable, intent(out) :: texts(:, :)
      type(error_type), allocatable, intent(out) :: error
      type(row_type) :: row
      integer :: k, i, c
      allocate (values(table%layout%width, first:last), source=ieee_value(1.0_wp, ieee_quiet_nan))
      allocate (texts(first:last, size(text_names)), source=text_type(''))
      do k = first, last
         if (log%status(k) == not_run) cycle
         call read_row(log, table, k, row, i, error)
         if (allocated(error)) return
         associate (at => table%known(i)%at)
            do c = 1, size(at)
               if (at(c) > 0) values(at(c), k) = row%numbers(c)
            end do
         end associate
         texts(k, :) = row%texts
      end do
   end subroutine read_rows

   subroutine create_columns(log, layout, file, columns)
      type(study_log_type), intent(in) :: log
      type(layout_type), intent(in) :: layout
      class(hdf5_type), intent(inout) :: file
      type(hdf5_rows_type), intent(inout) :: columns(:)
      character(len=:), allocatable :: scales
      integer :: c, d
      do c = 1, size(columns)
         associate (own => layout%columns(c))
            scales = run_scale
            do d = 1, size(own%over)
               scales = scales//' '//layout%dimensions(own%over(d))%name
            end do
            call columns(c)%create(file, own%name, layout%extents(c), size(log%status), &
               & ieee_value(1.0_wp, ieee_quiet_nan), .false.)
            call file%describe(columns(c)%id, own%units, own%long_name, scales, own%name)
            if (log%header%names() /= '') call file%write_attribute(columns(c)%id, 'coordinates', log%header%names())
         end associate
      end do
   end subroutine create_columns

   !> The numbers of runs that are missing, in few words: "3, 7-9".
   pure function missing_runs(missing) result(text)
      logical, intent(in) :: missing(:)
      character(len=:), allocatable :: text
      character(len=:), allocatable :: more
      integer :: first, last, length
      allocate (character(len=64) :: text)
      length = 0
      first = 1
      do
         first = first - 1 + findloc([missing(first:), .true.], .true., dim=1)
         if (first > size(missing)) exit
         last = first
         do while (last < size(missing))
            if (.not. missing(last + 1)) exit
            last = last + 1
         end do
         more = to_text(first)
         if (last > first) more = more//'-'//to_text(last)
         if (length > 0) more = ', '//more
         if (length + len(more) > len(text)) text = text//repeat(' ', len(text) + len(more))
         text(length + 1:length + len(more)) = more
         length = length + len(more)
         first = last + 1
         if (first > size(missing)) exit
      end do
      text = text(:length)
   end function missing_runs
end module study_builder
