!> Joins two files of one study: the rows of one are added to the other.
module study_join
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp
   use errors, only: error_type, system_error
   use hdf5_file, only: hdf5_type
   use hdf5_rows, only: rows_a_chunk
   use hdf5_texts, only: text_type
   use study_dimensions, only: list_type, positions
   use study_columns, only: column_type, new_column_type
   use study_rows, only: study_rows_type, not_run
   use parameter_study, only: study_type
   use study_marks, only: open_rows
   implicit none (type, external)
   private
   public :: join_rows

contains

   !> Adds the rows of another file of the same study to those of an open file, where it has none, or only one of a run
   !> that the system failed. The other may have fewer runs. One that cannot be read any more once rows were added is a
   !> failure of the open file.
   subroutine join_rows(file, rows, study, path, error)
      class(hdf5_type), intent(inout) :: file
      type(study_rows_type), intent(inout) :: rows
      type(study_type), intent(in) :: study
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      type(hdf5_type) :: other_file
      type(study_rows_type) :: other
      logical, allocatable :: wanted(:)
      integer :: i
      call open_rows(path, study, other_file, other, error)
      if (allocated(error)) return
      call rows%flush(file)
      associate (status => rows%status(:size(other%status)))
         wanted = other%status /= not_run .and. (status == not_run .or. status == system_error)
      end associate
      if (any(wanted)) then
         call rows%table%extend(file, rows%status /= not_run, other%table%dimensions, &
            & spread(.true., 1, size(other%table%dimensions)), &
            & [(new_of(other, other%table%columns(i)), i=1, size(other%table%columns))])
         do i = 1, size(rows%table%columns)
            call join_column(file, rows, i, other_file, other, wanted)
         end do
         call join_texts(file, rows, other_file, other, wanted)
         where (wanted) rows%status(:size(wanted)) = other%status
         if (allocated(other_file%failure) .and. .not. allocated(file%failure)) file%failure = path//': damaged: ' &
            & //other_file%failure
      end if
      call other%close(other_file)
      call other_file%close()
   end subroutine join_rows

   !> What another study must have to have a column.
   function new_of(rows, column) result(new)
      type(study_rows_type), intent(in) :: rows
      type(column_type), intent(in) :: column
      type(new_column_type) :: new
      integer :: i
      new%name = column%name
      new%units = column%units
      new%long_name = column%long_name
      new%scales = ''
      do i = 1, size(column%over)
         if (i > 1) new%scales = new%scales//' '
         new%scales = new%scales//rows%table%dimensions(column%over(i))%name
      end do
   end function new_of

   !> Copies the wanted rows of a column, some at a time. Where the other study has no such column they are without it.
   subroutine join_column(file, rows, i, other_file, other, wanted)
      class(hdf5_type), intent(inout) :: file
      type(study_rows_type), intent(in) :: rows
      integer, intent(in) :: i
      type(hdf5_type), intent(inout) :: other_file
      type(study_rows_type), intent(in) :: other
      logical, intent(in) :: wanted(:)
      real(wp), allocatable :: from(:, :), to(:, :)
      integer, allocatable :: at(:)
      integer :: first, last, n, c
      associate (column => rows%table%columns(i))
         c = places_in(rows, other, column, at)
         first = 1
         do
            call next_stretch(wanted, rows_a_chunk(rows%table%runs, column%width), first, last)
            if (first > size(wanted) .or. allocated(file%failure) .or. allocated(other_file%failure)) exit
            n = last - first + 1
            if (c > 0 .or. any(rows%status(first:last) /= not_run)) then
               allocate (to(column%width, n), source=ieee_value(1.0_wp, ieee_quiet_nan))
               if (c > 0) then
                  call other%table%columns(c)%data%read(other_file, first, n, from)
                  if (.not. allocated(other_file%failure)) to(at, :) = from
               end if
               if (.not. allocated(other_file%failure)) call column%data%write(file, first, to)
               deallocate (to)
            end if
            first = last + 1
         end do
      end associate
   end subroutine join_column

   !> The column that another study has for one of ours, and the places of its values in a row of ours; 0 where it has
   !> none over the same dimensions.
   integer function places_in(rows, other, column, at) result(c)
      type(study_rows_type), intent(in) :: rows, other
      type(column_type), intent(in) :: column
      integer, allocatable, intent(out) :: at(:)
      type(list_type) :: lists(size(column%over))
      integer :: k
      c = other%table%find(column%name)
      if (c == 0) return
      associate (over => other%table%columns(c)%over)
         if (size(over) /= size(column%over)) then
            c = 0
            return
         end if
         do k = 1, size(over)
            associate (ours => rows%table%dimensions(column%over(k)), theirs => other%table%dimensions(over(k)))
               if (ours%name /= theirs%name) c = 0
               lists(k)%at = ours%places(theirs)
            end associate
         end do
      end associate
      at = positions(lists, rows%table%extents(column%over))
   end function places_in

   !> Copies reasons, remarks and names of files.
   subroutine join_texts(file, rows, other_file, other, wanted)
      class(hdf5_type), intent(inout) :: file
      type(study_rows_type), intent(inout) :: rows
      type(study_rows_type), intent(in) :: other
      type(hdf5_type), intent(inout) :: other_file
      logical, intent(in) :: wanted(:)
      type(text_type), allocatable :: texts(:)
      integer :: first, last, i
      first = 1
      do
         call next_stretch(wanted, rows_a_chunk(size(wanted), 1), first, last)
         if (first > size(wanted) .or. allocated(file%failure) .or. allocated(other_file%failure)) exit
         call other%reasons%read(other_file, first, last - first + 1, texts)
         do i = first, last
            associate (text => texts(i - first + 1:i - first + 1))
               if (text(1)%text /= '' .or. rows%status(i) /= not_run) call rows%reasons%write(file, i, text)
            end associate
         end do
         if (other%remarks%id >= 0) then
            call other%remarks%read(other_file, first, last - first + 1, texts)
            if (.not. allocated(other_file%failure)) call rows%put_remarks(file, first, texts)
         end if
         if (other%files%id >= 0) then
            call other%files%read(other_file, first, last - first + 1, texts)
            if (.not. allocated(other_file%failure)) call rows%put_files(file, first, texts)
         end if
         first = last + 1
      end do
   end subroutine join_texts

   !> The next runs that are all wanted, from `first` on, and in one block of the file; `first` is behind the last run
   !> where there are none.
   pure subroutine next_stretch(wanted, block, first, last)
      logical, intent(in) :: wanted(:)
      integer, intent(in) :: block
      integer, intent(inout) :: first
      integer, intent(out) :: last
      do while (first <= size(wanted))
         if (wanted(first)) exit
         first = first + 1
      end do
      last = first
      do while (last < size(wanted))
         if (.not. wanted(last + 1) .or. mod(last, block) == 0) exit
         last = last + 1
      end do
   end subroutine next_stretch
end module study_join
