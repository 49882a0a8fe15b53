!> The table of a study from its log alone: of one that is being performed or was killed, or of runs that others have
!> put into a log.
module table_of_log
   use errors, only: error_type, raise, system_error
   use files, only: is_regular
   use hdf5_file, only: hdf5_type
   use restart, only: open_result
   use study_file, only: make_table
   use study_log, only: study_log_type
   use study_source, only: log_ending
   use working_file, only: working_file_type
   implicit none (type, external)
   private
   public :: write_table_of

contains

   !> Makes the table of a log under a name, by default that of the log without its ending; no file but a study is
   !> replaced.
   subroutine write_table_of(log_file, output, error)
      character(len=*), intent(in) :: log_file, output
      type(error_type), allocatable, intent(out) :: error
      type(study_log_type) :: log
      type(working_file_type) :: working
      character(len=:), allocatable :: path
      logical :: exchanged
      path = output
      if (path == '') path = log_file(:max(1, len(log_file) - len(log_ending)))
      if (output == '' .and. path//log_ending /= log_file) then
         call raise(error, system_error, log_file//': the log of a study is called NAME.h5'//log_ending &
            & //'; of another name, --output must say what to write')
         return
      end if
      call log%open(log_file, error)
      if (.not. allocated(error)) call working%claim(path, error)
      if (.not. allocated(error)) then
         if (is_regular(path)) call expect_study(path, error)
         if (.not. allocated(error)) call working%make_part(error)
         if (.not. allocated(error)) call make_table(log, working%part, path, error)
         if (.not. allocated(error)) call working%publish(exchanged, error)
         call working%release()
      end if
      call log%close()
   end subroutine write_table_of

   !> An error where a file is no study.
   subroutine expect_study(path, error)
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      type(hdf5_type) :: file
      character(len=:), allocatable :: task
      call open_result(path, file, error)
      if (allocated(error)) then
         error%message = error%message//'; it is not replaced'
         return
      end if
      call file%get_text('task', task)
      call file%close()
      if (task /= 'study') call raise(error, system_error, path//': it is not a study, and is not replaced')
   end subroutine expect_study
end module table_of_log
