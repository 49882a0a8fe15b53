!> How the file of a study is recognised: opening one, its marks, and which runs it lacks.
module study_marks
   use text, only: to_text
   use errors, only: error_type, raise, system_error
   use parameter_study, only: study_type, run_tag
   use hdf5_file, only: hdf5_type
   use hdf5_texts, only: text_type
   use guarded_open, only: new_reader
   use processes, only: end_child, exit_status
   use restart, only: open_result
   use hdf5_scales, only: word => scale_name
   use study_rows, only: study_rows_type
   implicit none (type, external)
   private
   public :: put_marks, check_marks, is_collected, open_study, open_rows, missing_runs

   character(len=*), parameter :: marks_name = 'study_marks'

contains

   !> Notes how many runs the study has, and its checksums: of what all runs have in common, and of all runs.
   subroutine put_marks(file, study)
      class(hdf5_type), intent(inout) :: file
      type(study_type), intent(in) :: study
      type(run_tag) :: first, last
      call study%tag(1, first)
      call study%tag(study%runs, last)
      call file%put_flag('runs', study%runs)
      call file%put_text(marks_name, trim(word(first%marks, 1)//' '//word(last%marks, 3)))
   end subroutine put_marks

   !> Refuses a file, which is open, of another study than this one, or of one with more runs.
   subroutine check_marks(path, file, study, error)
      character(len=*), intent(in) :: path
      class(hdf5_type), intent(inout) :: file
      type(study_type), intent(in) :: study
      type(error_type), allocatable, intent(out) :: error
      type(run_tag) :: first, last
      character(len=:), allocatable :: marks
      integer :: runs
      if (.not. file%has_attribute(marks_name)) then
         call raise(error, system_error, path//': is a study that tiltpad-collect wrote')
         return
      end if
      call file%get_flag('runs', runs)
      call file%get_text(marks_name, marks)
      if (allocated(file%failure)) then
         call raise(error, system_error, path//': damaged: '//file%failure)
      else if (runs > study%runs) then
         call raise(error, system_error, path//': is of a study with '//to_text(runs)//' runs; this one has ' &
            & //to_text(study%runs))
      else if (runs < 1) then
         call raise(error, system_error, path//': damaged: a study without runs')
      else
         call study%tag(1, first)
         call study%tag(runs, last)
         if (marks == '' .or. first%marks == '') return
         if (word(first%marks, 1) /= word(marks, 1)) then
            call raise(error, system_error, path//': is the study of another case, or of files that have ' &
               & //'changed since')
         else if (word(last%marks, 2) /= word(marks, 2)) then
            call raise(error, system_error, path//': is of another study: its runs have other values')
         end if
      end if
   end subroutine check_marks

   !> Whether a file is a study that tiltpad-collect made of results.
   logical function is_collected(path)
      character(len=*), intent(in) :: path
      type(hdf5_type) :: file
      type(error_type), allocatable :: error
      character(len=:), allocatable :: task
      is_collected = .false.
      call open_result(path, file, error)
      if (allocated(error)) return
      call file%get_text('task', task)
      if (task == 'study') is_collected = .not. file%has_attribute(marks_name)
      call file%close()
   end function is_collected

   !> Opens a study for reading, once a child process has read all of its structure and texts.
   subroutine open_study(path, file, error)
      character(len=*), intent(in) :: path
      class(hdf5_type), intent(inout) :: file
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: task
      integer :: child
      call open_result(path, file, error)
      if (allocated(error)) return
      call file%get_text('task', task)
      if (allocated(file%failure)) then
         call raise(error, system_error, path//': damaged: '//file%failure)
      else if (task /= 'study') then
         call raise(error, system_error, path//': is the result of one run, and not a study')
      else
         child = new_reader()
         if (child == 0) then
            call read_all(file)
            call end_child(merge(1, 0, allocated(file%failure)))
         else if (child > 0) then
            if (exit_status(child) /= 0) call raise(error, system_error, path//': damaged: its rows cannot be read')
         end if
      end if
      if (allocated(error)) call file%close()
   end subroutine open_study

   subroutine read_all(file)
      class(hdf5_type), intent(inout) :: file
      type(study_rows_type) :: rows
      type(text_type), allocatable :: texts(:)
      character(len=:), allocatable :: names
      call file%get_text('parameters', names)
      call rows%read_layout(file, names)
      if (allocated(file%failure)) return
      call rows%reasons%read(file, 1, rows%reasons%length, texts)
      if (rows%files%id >= 0) call rows%files%read(file, 1, rows%files%length, texts)
   end subroutine read_all

   !> Opens a file of this study, which may have fewer runs, and reads which rows and columns it has.
   subroutine open_rows(path, study, file, rows, error)
      character(len=*), intent(in) :: path
      type(study_type), intent(in) :: study
      class(hdf5_type), intent(inout) :: file
      type(study_rows_type), intent(inout) :: rows
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: names
      call open_study(path, file, error)
      if (allocated(error)) return
      call check_marks(path, file, study, error)
      if (.not. allocated(error)) then
         call file%get_text('parameters', names)
         call rows%read_layout(file, names)
         if (rows%table%runs > study%runs) call file%check_read(-1, 'find as many rows as there are runs')
         if (.not. allocated(file%failure)) return
         call raise(error, system_error, path//': damaged: '//file%failure)
         call rows%close(file)
      end if
      call file%close()
   end subroutine open_rows

   !> The numbers of runs that are missing, in few words: "3, 7-9".
   pure function missing_runs(missing) result(text)
      logical, intent(in) :: missing(:)
      character(len=:), allocatable :: text
      character(len=:), allocatable :: more
      integer :: first, last, length
      allocate (character(len=64) :: text)
      length = 0
      first = 1
      do
         first = first - 1 + findloc([missing(first:), .true.], .true., dim=1)
         if (first > size(missing)) exit
         last = first
         do while (last < size(missing))
            if (.not. missing(last + 1)) exit
            last = last + 1
         end do
         more = to_text(first)
         if (last > first) more = more//'-'//to_text(last)
         if (length > 0) more = ', '//more
         if (length + len(more) > len(text)) text = text//repeat(' ', len(text) + len(more))
         text(length + 1:length + len(more)) = more
         length = length + len(more)
         first = last + 1
         if (first > size(missing)) exit
      end do
      text = text(:length)
   end function missing_runs
end module study_marks
