!> The file of a record: its datasets and root attributes in HDF5.
module record_file
   use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_null_char, c_ptr
   use kinds, only: wp
   use hdf5_file, only: hdf5_type, opened_type
   use record, only: record_type, of_counts, of_texts, of_reals, lines
   use hdf5, only: hid_t, h5dclose_f, h5dread_f, h5dget_type_f, h5tis_variable_str_f, h5tclose_f, h5t_string_f, &
      & h5t_integer_f, h5t_float_f, h5t_native_double
   use hdf5_scales, only: item_type, list_items, scales_of, read_about
   implicit none (type, external)
   private
   public :: write_record, read_record

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
               call file%put(own)
            end associate
         end do
      end do
      if (allocated(self%attributes)) then
         do k = 1, size(self%attributes)
            associate (own => self%attributes(k))
               if (.not. own%there .or. .not. (all .or. own%unwritten)) cycle
               if (own%is_flag) then
                  call file%put_flag(own%name, own%flag)
               else
                  call file%put_text(own%name, own%text)
               end if
            end associate
         end do
      end if
      call self%note_written()
   end subroutine write_record

   !> Deletes what was deleted here; what was put there again is to be written again, as it may have another size.
   subroutine delete_groups(self, file)
      class(record_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      character(len=:), allocatable :: names(:)
      integer :: i, k
      if (.not. allocated(self%deleted)) return
      ! a new line stands before the first
      names = lines(self%deleted(2:))
      do i = 1, size(names)
         call file%delete(trim(names(i)))
         do k = 1, self%count
            if (index(self%datasets(k)%path//'/', trim(names(i))//'/') == 1) self%datasets(k)%unwritten = .true.
         end do
      end do
   end subroutine delete_groups

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
      type(opened_type) :: found
      type(c_ptr) :: buffer
      integer :: status, kind
      if (allocated(file%failure)) return
      if (product(real(item%extents, wp)) > most_numbers) call file%check_read(-1, 'take memory for '//item%path)
      if (allocated(file%failure)) return
      call read_about(file, item%path, units, long_name)
      call file%open_dataset(item%path, found)
      if (found%id < 0) return
      kind = merge(of_counts, of_reals, found%class == h5t_integer_f .and. size(found%extents) == 0)
      texts = ''
      allocate (values(merge(0, int(product(found%extents)), found%class == h5t_string_f)))
      if (found%class == h5t_string_f) then
         kind = of_texts
         call read_labels(file, found, item%path, texts)
      else if (found%class == h5t_integer_f .or. found%class == h5t_float_f) then
         buffer = c_loc(values)
         if (size(values) > 0) call h5dread_f(found%id, h5t_native_double, buffer, status)
         if (size(values) > 0) call file%check_read(status, 'read '//item%path)
      else
         call file%check_read(-1, 'find numbers in '//item%path)
      end if
      call h5dclose_f(found%id, status)
      if (allocated(file%failure)) return
      call record%put_dataset(item%path, kind, values, int(found%extents), units, long_name, scales, texts)
   end subroutine read_dataset

   !> Texts of one length, filled up with zero bytes: each with a new line behind it.
   subroutine read_labels(file, found, path, texts)
      class(hdf5_type), intent(inout) :: file
      type(opened_type), intent(in) :: found
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(inout) :: texts
      character(kind=c_char, len=:), allocatable, target :: bytes
      type(c_ptr) :: buffer
      integer(hid_t) :: kind
      integer :: status, length, i, ends
      logical :: variable
      call h5dget_type_f(found%id, kind, status)
      call h5tis_variable_str_f(kind, variable, status)
      if (status >= 0 .and. (variable .or. found%bytes > longest_label)) status = -1
      call file%check_read(status, 'find labels in '//path)
      if (status < 0) return
      length = int(found%bytes)
      allocate (character(kind=c_char, len=int(product(found%extents))*length) :: bytes)
      buffer = c_loc(bytes)
      call h5dread_f(found%id, kind, buffer, status)
      call file%check_read(status, 'read '//path)
      if (status < 0) return
      do i = 1, len(bytes), length
         ends = index(bytes(i:i + length - 1)//c_null_char, c_null_char) - 1
         texts = texts//trim(bytes(i:i + ends - 1))//achar(10)
      end do
      call h5tclose_f(kind, status)
   end subroutine read_labels
end module record_file
