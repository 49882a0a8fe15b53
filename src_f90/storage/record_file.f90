!> The file of a record: its datasets and root attributes in HDF5.
module record_file
   use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_null_char, c_ptr
   use kinds, only: i8, wp
   use hdf5_file, only: hdf5_type
   use record, only: record_type, dataset_type, of_counts, of_texts, of_reals
   use hdf5, only: hid_t, size_t, h5dclose_f, h5dread_f, h5dget_type_f, h5tget_class_f, h5tget_size_f, &
      & h5tis_variable_str_f, h5tclose_f, h5t_string_f, h5t_integer_f, h5t_float_f, h5t_native_double
   use hdf5_scales, only: item_type, list_items, scales_of, read_about
   implicit none (type, external)
   private
   public :: write_record, lines, read_record

   character(len=*), parameter :: newline = achar(10)

   !> Most numbers of a dataset, and most bytes of a label; only a damaged file says more.
   integer, parameter :: most_numbers = 10000000, longest_label = 30000
   !> Root attributes that are read: numbers, and texts that a run adds to when it goes on.
   character(len=*), parameter :: flags(*) = [character(len=11) :: 'complete', 'exit_status', 'resumes']
   character(len=*), parameter :: texts(*) = [character(len=11) :: 'history', 'branch_ends']

contains

   !> Writes into an open file what was put since it was written last; with `all` everything, for a file that may lack
   !> more. The file keeps what fails.
   subroutine write_record(self, file, all)
      class(record_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      logical, intent(in) :: all
      character(len=:), allocatable :: last
      integer :: k, turn
      call delete_groups(self, file)
      last = ''
      ! scales first
      do turn = 1, 2
         do k = 1, self%count
            associate (own => self%datasets(k))
               if (.not. own%there .or. .not. (all .or. own%unwritten)) cycle
               if (own%scales == own%path .neqv. turn == 1) cycle
               if (own%group() /= last) call file%make_group(own%group())
               last = own%group()
               call write_dataset(own, file)
            end associate
         end do
      end do
      if (self%count > 0) self%datasets(:self%count)%unwritten = .false.
      if (.not. allocated(self%attributes)) return
      do k = 1, size(self%attributes)
         associate (own => self%attributes(k))
            if (.not. own%there .or. .not. (all .or. own%unwritten)) cycle
            if (own%is_flag) then
               call file%put_flag(own%name, own%flag)
            else
               call file%put_text(own%name, own%text)
            end if
            own%unwritten = .false.
         end associate
      end do
   end subroutine write_record

   !> Deletes what was deleted here; what was put there again is to be written again, as it may have another size.
   subroutine delete_groups(self, file)
      class(record_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer :: first, length, k
      if (.not. allocated(self%deleted)) return
      first = 2
      do while (first <= len(self%deleted))
         length = index(self%deleted(first:), newline) - 1
         associate (name => self%deleted(first:first + length - 1))
            call file%delete(name)
            do k = 1, self%count
               if (index(self%datasets(k)%path//'/', name//'/') == 1) self%datasets(k)%unwritten = .true.
            end do
         end associate
         first = first + length + 1
      end do
   end subroutine delete_groups

   subroutine write_dataset(own, file)
      type(dataset_type), intent(in) :: own
      class(hdf5_type), intent(inout) :: file
      select case (own%kind)
      case (of_texts)
         call file%put_labels(own%path, lines(own%texts), own%extents, own%long_name, own%scales)
      case (of_counts)
         call file%put_count(own%path, nint(own%values(1), i8), own%long_name)
      case default
         call file%put_array(own%path, own%values, own%extents, own%units, own%long_name, own%scales)
      end select
   end subroutine write_dataset

   !> The lines of a text, each of which ends with a new line, filled up with blanks.
   pure function lines(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: lines(:)
      integer :: first, length, count, longest, k
      count = 0
      longest = 1
      length = 0
      do k = 1, len(text)
         length = length + 1
         if (text(k:k) /= newline) cycle
         count = count + 1
         longest = max(longest, length - 1)
         length = 0
      end do
      allocate (character(len=longest) :: lines(count))
      first = 1
      do k = 1, count
         length = index(text(first:), newline) - 1
         lines(k) = text(first:first + length - 1)
         first = first + length + 1
      end do
   end function lines

   ! Reads the results of a run from its file into a record: what `write_record` wrote, without the series over time
   ! and over the points of a branch, which may be very long.

   !> Reads an open result file. The file keeps what fails.
   subroutine read_record(file, record)
      class(hdf5_type), intent(inout) :: file
      type(record_type), intent(inout) :: record
      type(item_type), allocatable :: found(:)
      character(len=:), allocatable :: text
      integer :: i, value
      call record%clear()
      call list_items(file, found)
      do i = 1, size(found)
         if (.not. found(i)%is_dataset .or. found(i)%grows) cycle
         call read_dataset(file, found(i), scales_of(file, found(i), found), record)
      end do
      do i = 1, size(flags)
         if (.not. file%has_attribute(trim(flags(i)))) cycle
         call file%get_flag(trim(flags(i)), value)
         call record%put_flag(trim(flags(i)), value)
      end do
      do i = 1, size(texts)
         if (.not. file%has_attribute(trim(texts(i)))) cycle
         call file%get_text(trim(texts(i)), text)
         call record%put_text(trim(texts(i)), text)
      end do
      call record%note_written()
   end subroutine read_record

   subroutine read_dataset(file, item, scales, record)
      class(hdf5_type), intent(inout) :: file
      type(item_type), intent(in) :: item
      character(len=*), intent(in) :: scales
      type(record_type), intent(inout) :: record
      character(len=:), allocatable :: units, long_name, texts
      real(wp), allocatable, target :: values(:)
      integer(hid_t) :: dataset, kind
      type(c_ptr) :: buffer
      integer :: status, class
      if (allocated(file%failure)) return
      if (product(real(item%extents, wp)) > most_numbers) call file%check_read(-1, 'take memory for '//item%path)
      if (allocated(file%failure)) return
      call read_about(file, item%path, units, long_name)
      call file%open_dataset(item%path, dataset, status)
      if (status < 0) return
      call h5dget_type_f(dataset, kind, status)
      call h5tget_class_f(kind, class, status)
      allocate (values(merge(0, int(product(item%extents)), class == h5t_string_f)))
      texts = ''
      if (status >= 0 .and. class == h5t_string_f) then
         call read_labels(file, dataset, kind, item, texts)
      else if (status >= 0 .and. (class == h5t_integer_f .or. class == h5t_float_f)) then
         buffer = c_loc(values)
         if (size(values) > 0) call h5dread_f(dataset, h5t_native_double, buffer, status)
         call file%check_read(status, 'read '//item%path)
      else
         call file%check_read(-1, 'find numbers in '//item%path)
      end if
      call h5tclose_f(kind, status)
      call h5dclose_f(dataset, status)
      if (allocated(file%failure)) return
      kind = merge(of_texts, merge(of_counts, of_reals, class == h5t_integer_f .and. size(item%extents) == 0), &
         & class == h5t_string_f)
      call record%put(item%path, int(kind), values, int(item%extents), units, long_name, scales, texts)
   end subroutine read_dataset

   !> Texts of one length, filled up with zero bytes: each with a new line behind it.
   subroutine read_labels(file, dataset, kind, item, texts)
      class(hdf5_type), intent(inout) :: file
      integer(hid_t), intent(in) :: dataset, kind
      type(item_type), intent(in) :: item
      character(len=:), allocatable, intent(inout) :: texts
      character(kind=c_char, len=:), allocatable, target :: bytes
      type(c_ptr) :: buffer
      integer(size_t) :: length
      integer :: status, count, i, ends
      logical :: variable
      call h5tis_variable_str_f(kind, variable, status)
      if (status >= 0) call h5tget_size_f(kind, length, status)
      if (status >= 0 .and. (variable .or. length > longest_label)) status = -1
      call file%check_read(status, 'find labels in '//item%path)
      if (status < 0) return
      count = int(product(item%extents))
      allocate (character(kind=c_char, len=count*int(length)) :: bytes)
      buffer = c_loc(bytes)
      call h5dread_f(dataset, kind, buffer, status)
      call file%check_read(status, 'read '//item%path)
      if (status < 0) return
      do i = 1, count
         associate (label => bytes((i - 1)*int(length) + 1:i*int(length)))
            ends = index(label//c_null_char, c_null_char) - 1
            texts = texts//trim(label(:ends))//achar(10)
         end associate
      end do
   end subroutine read_labels
end module record_file
