!> The file of a record: its datasets and root attributes in HDF5.
module record_file
   use kinds, only: i8
   use hdf5_file, only: hdf5_type
   use record, only: record_type, dataset_type, of_counts, of_texts
   implicit none (type, external)
   private
   public :: write_record, lines

   character(len=*), parameter :: newline = achar(10)

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
         if (size(own%extents) == 0) then
            call file%put_real(own%path, own%values(1), own%units, own%long_name)
         else
            call file%put_array(own%path, own%values, own%extents, own%units, own%long_name, own%scales)
         end if
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
end module record_file
