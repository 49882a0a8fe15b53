!> Reads the results of a run from its file into a record: what `write_record` wrote, without the series over time and
!> over the points of a branch, which may be very long.
module record_reader
   use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_null_char, c_ptr
   use hdf5, only: hid_t, size_t, h5dclose_f, h5dread_f, h5dget_type_f, h5tget_class_f, h5tget_size_f, &
      & h5tis_variable_str_f, h5tclose_f, h5t_string_f, h5t_integer_f, h5t_float_f, h5t_native_double
   use kinds, only: wp
   use hdf5_file, only: hdf5_type
   use hdf5_scales, only: item_type, list_items, scales_of, read_about
   use record, only: record_type, of_reals, of_counts, of_texts
   implicit none (type, external)
   private
   public :: read_record

   !> Most numbers of a dataset, and most bytes of a label; only a damaged file says more.
   integer, parameter :: most_numbers = 10000000, longest_label = 30000
   !> Root attributes that are read: numbers, and texts that a run adds to when it goes on.
   character(len=*), parameter :: flags(*) = [character(len=11) :: 'complete', 'exit_status', 'resumes']
   character(len=*), parameter :: texts(*) = [character(len=11) :: 'history', 'branch_ends']

contains

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
end module record_reader
