!> What tests put into HDF5 files, and what they expect of those that are damaged.
module hdf5_expectations
   use kinds, only: wp, i8
   use record, only: record_type
   use record_file, only: write_record
   use hdf5_file, only: hdf5_type
   use check, only: expect
   implicit none (type, external)
   private
   public :: put_real, put_list, put_table, put_count, expect_damaged

contains

   !> A number.
   subroutine put_real(file, path, value, units, long_name)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: path, units, long_name
      real(wp), intent(in) :: value
      type(record_type) :: record
      call record%put(path, value, units, long_name)
      call write_record(record, file, .true.)
   end subroutine put_real

   !> Numbers, over one scale or none.
   subroutine put_list(file, path, values, units, long_name, scales)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: path, units, long_name, scales
      real(wp), intent(in) :: values(:)
      type(record_type) :: record
      call record%put(path, values, units, long_name, scales)
      call write_record(record, file, .true.)
   end subroutine put_list

   !> Numbers over two scales or none.
   subroutine put_table(file, path, values, units, long_name, scales)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: path, units, long_name, scales
      real(wp), intent(in) :: values(:, :)
      type(record_type) :: record
      call record%put(path, values, units, long_name, scales)
      call write_record(record, file, .true.)
   end subroutine put_table

   !> A whole number.
   subroutine put_count(file, path, value, long_name)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: path, long_name
      integer(i8), intent(in) :: value
      type(record_type) :: record
      call record%put(path, value, long_name)
      call write_record(record, file, .true.)
   end subroutine put_count

   !> The file fails in reading, with these words; it is closed.
   subroutine expect_damaged(file, words)
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: words
      call expect(allocated(file%failure) .and. file%damaged, 'a failure in reading: '//words)
      if (allocated(file%failure)) call expect(index(file%failure, words) > 0, words//' in '//file%failure)
      call file%close()
   end subroutine expect_damaged
end module hdf5_expectations
