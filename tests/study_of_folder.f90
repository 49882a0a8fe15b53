!> Makes the study file of a case from the files of its runs: study_of_folder CASE FOLDER OUTPUT.
program study_of_folder
   use, intrinsic :: iso_fortran_env, only: error_unit
   use errors, only: error_type
   use hdf5_file, only: hdf5_type
   use record, only: record_type
   use record_reader, only: read_record
   use parameter_study, only: study_type, read_study
   use study_file, only: study_file_type
   use text, only: to_text
   implicit none (type, external)
   type(study_type) :: study
   type(study_file_type) :: table
   type(error_type), allocatable :: error
   type(hdf5_type) :: file
   type(record_type) :: record
   character(len=:), allocatable :: number, reason
   integer :: k, status

   call read_study(argument(1), [character ::], study, error)
   call check()
   call study%mark('')
   call table%claim(argument(3), error)
   call check()
   call table%begin(study, error)
   call check()
   do k = 1, study%runs
      number = to_text(k)
      call file%open(argument(2)//'/'//repeat('0', 4 - len(number))//number//'.h5', writing=.false.)
      if (allocated(file%failure)) cycle
      call read_record(file, record)
      call file%get_flag('exit_status', status)
      call file%get_text('reason', reason)
      call file%close()
      if (allocated(file%failure)) error = error_type(3, file%failure)
      call check()
      call table%add(k, status, reason, record, 1)
   end do
   call table%finish(error)
   call check()

contains

   function argument(k) result(text)
      integer, intent(in) :: k
      character(len=:), allocatable :: text
      integer :: length
      call get_command_argument(k, length=length)
      allocate (character(len=length) :: text)
      call get_command_argument(k, text)
   end function argument

   subroutine check()
      if (.not. allocated(error)) return
      write (error_unit, '(a)') error%message
      error stop 1, quiet=.true.
   end subroutine check
end program study_of_folder
