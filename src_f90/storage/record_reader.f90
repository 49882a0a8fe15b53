!> stub
module record_reader
   use hdf5_file, only: hdf5_type
   use record, only: record_type
   implicit none (type, external)
   private
   public :: read_record
contains
   subroutine read_record(file, results)
      class(hdf5_type), intent(inout) :: file
      type(record_type), intent(inout) :: results
      if (results%count == 0) call file%check(0, '')
   end subroutine read_record
end module record_reader
