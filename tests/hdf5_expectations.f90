!> What tests expect of HDF5 files that are damaged.
module hdf5_expectations
   use hdf5_file, only: hdf5_type
   use check, only: expect
   implicit none (type, external)
   private
   public :: expect_damaged

contains

   !> The file fails in reading, with these words; it is closed.
   subroutine expect_damaged(file, words)
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: words
      call expect(allocated(file%failure) .and. file%damaged, 'a failure in reading: '//words)
      if (allocated(file%failure)) call expect(index(file%failure, words) > 0, words//' in '//file%failure)
      call file%close()
   end subroutine expect_damaged
end module hdf5_expectations
