!> What a run reads in a result file before it continues or replaces it.
module restart
   use kinds, only: wp
   use text, only: to_text, replaced
   use errors, only: error_type, raise, add_context, system_error, numerics_error
   use case_inputs, only: case_type
   use read_files, only: file_marks, changed_file, marks_name
   use variable_table, only: variable_type, variable_table_type, lines_of
   use case_fields, only: list_variables, checkpoint_variable
   use case_namelist, only: case_from_text
   use hdf5_file, only: hdf5_type
   use verification_results, only: states_figure
   use guarded_open, only: try_reading, new_reader
   use processes, only: end_child, exit_status
   use provenance, only: format_version, machine_version
   use parameter_study, only: run_tag
   use files, only: is_regular
   implicit none (type, external)
   private
   public :: restart_type, read_restart, read_result, open_result, refuse_other_case, is_of_other_study

   type :: restart_type
      !> Resolved namelist of the run.
      type(case_type) :: inputs
      !> What it has read from other files.
      character(len=:), allocatable, private :: files
      !> Which run of a study it is.
      type(run_tag) :: tag
      !> True where an earlier version of the program wrote it; the rest is not known then.
      logical :: older = .false.
      !> True where nothing is left to do; states whose films were solved closely afterwards.
      logical :: complete = .false.
      real(wp) :: verified_states = 0
      !> How the run ended, and whether there is a checkpoint.
      integer, private :: status = 0
      character(len=:), allocatable, private :: reason
      logical, private :: checkpoint = .false.
   contains
      procedure :: refuse_end
      procedure :: can_go_on
   end type restart_type

   character(len=*), parameter :: newline = achar(10)

contains

   !> Reads a result file that is to be continued. It is refused with one line if it is no result, damaged, of another
   !> format, without a checkpoint, or (a numerics error) if the numerics of its run failed: they would fail again.
   subroutine read_restart(path, found, error)
      character(len=*), intent(in) :: path
      type(restart_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      call read_result(path, found, error, texts_alone=.false.)
      if (.not. allocated(error)) call found%refuse_end(path, error)
   end subroutine read_restart

   !> Reads a result file, however its run ended; with `texts_alone` all but its verified states, and much faster.
   subroutine read_result(path, found, error, texts_alone)
      character(len=*), intent(in) :: path
      type(restart_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in) :: texts_alone
      type(hdf5_type) :: file
      character(len=:), allocatable :: input, task, of_paper
      integer :: complete
      task = ''
      call open_result(path, file, error, found%older, texts_alone)
      if (allocated(error)) return
      if (file%has_attribute('task')) call file%get_text('task', task)
      if (task == 'study') then
         call raise(error, system_error, path//': a study, which goes on when its case is run again')
         call file%close()
         return
      end if
      call file%get_flag('complete', complete)
      call file%get_text('input', input)
      found%files = ''
      if (file%has_attribute(marks_name)) call file%get_text(marks_name, found%files)
      if (file%has_attribute('of_paper')) call file%get_text('of_paper', of_paper)
      found%checkpoint = file%has('checkpoint/time')
      if (.not. texts_alone) then
         if (file%has('summary/'//states_figure)) found%verified_states = file%get_real('summary/'//states_figure)
      end if
      found%reason = ''
      if (file%has_attribute('exit_status')) call file%get_flag('exit_status', found%status)
      if (found%status /= 0) call file%get_text('reason', found%reason)
      call read_tag(file, found%tag)
      if (allocated(file%failure)) call raise(error, system_error, path//': damaged: '//file%failure)
      call file%close()
      if (allocated(error)) return
      call case_from_text(input, path, found%inputs, error, of_result=.true.)
      if (allocated(error)) then
         error%status = system_error
         call add_context(error, path//': its input cannot be read')
      end if
      call move_alloc(of_paper, found%inputs%about%of_paper)
      found%complete = complete == 1
   end subroutine read_result

   !> Which run of a study a result is, if any.
   subroutine read_tag(file, tag)
      type(hdf5_type), intent(inout) :: file
      type(run_tag), intent(out) :: tag
      if (.not. file%has_attribute('run')) return
      call file%get_flag('run', tag%number)
      call file%get_text('sweep', tag%study)
      tag%marks = ''
      if (file%has_attribute('study_marks')) call file%get_text('study_marks', tag%marks)
   end subroutine read_tag

   !> True for a result that can be read and is not this run of this study, of which it may have fewer. Nothing is read
   !> but that, by a child process, so that it costs little beside a short run.
   logical function is_of_other_study(path, tag) result(other)
      character(len=*), intent(in) :: path
      type(run_tag), intent(in) :: tag
      integer, parameter :: is_other = 100
      type(hdf5_type) :: file
      type(run_tag) :: found
      type(error_type), allocatable :: error
      integer :: child
      other = .false.
      if (.not. is_regular(path)) return
      child = new_reader()
      if (child < 0) return
      if (child == 0) then
         call open_known(path, file, error)
         if (.not. allocated(error)) then
            call read_tag(file, found)
            other = .not. allocated(file%failure)
            if (other .and. found%number == tag%number) other = .not. found%same_up_to(tag)
         end if
         call end_child(merge(is_other, 0, other))
      end if
      other = exit_status(child) == is_other
   end function is_of_other_study

   !> True for a run that ended at a checkpoint.
   pure logical function can_go_on(self)
      class(restart_type), intent(in) :: self
      can_go_on = self%checkpoint .and. .not. self%complete .and. self%status /= numerics_error
   end function can_go_on

   !> Refuses to continue a run that cannot be continued.
   subroutine refuse_end(self, path, error)
      class(restart_type), intent(in) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      if (self%complete) return
      if (self%status == numerics_error) then
         call raise(error, numerics_error, path//': the run cannot be resumed; '//self%reason)
      else if (.not. self%checkpoint) then
         call raise(error, system_error, path//': holds no checkpoint to go on from')
      end if
   end subroutine refuse_end

   !> Opens the file for reading if it is a result that this program knows.
   subroutine open_result(path, file, error, older, texts_alone)
      character(len=*), intent(in) :: path
      class(hdf5_type), intent(inout) :: file
      type(error_type), allocatable, intent(out) :: error
      !> True where it is refused because an earlier version wrote it.
      logical, intent(out), optional :: older
      !> Where nothing but its texts will be read (guarded_open).
      logical, intent(in), optional :: texts_alone
      character(len=:), allocatable :: refusal
      logical :: exists
      if (present(older)) older = .false.
      inquire (file=path, exist=exists)
      if (.not. exists) then
         call raise(error, system_error, path//': no such file')
         return
      end if
      if (.not. is_regular(path)) then
         call raise(error, system_error, path//': a directory, device or pipe, not a result file')
         return
      end if
      call try_reading(path, refusal, texts_alone)
      if (refusal /= '') then
         call raise(error, system_error, path//': '//refusal)
      else
         call open_known(path, file, error, older)
      end if
   end subroutine open_result

   !> The same of a file that may crash the program or has been tried.
   subroutine open_known(path, file, error, older)
      character(len=*), intent(in) :: path
      class(hdf5_type), intent(inout) :: file
      type(error_type), allocatable, intent(out) :: error
      logical, intent(out), optional :: older
      character(len=:), allocatable :: program
      integer :: version
      if (present(older)) older = .false.
      call file%open(path, writing=.false.)
      if (file%id < 0) then
         call raise(error, system_error, path//': not a result file (HDF5); tiltpad CASE.nml runs a case')
         return
      end if
      program = ''
      if (file%has_attribute('program')) call file%get_text('program', program)
      if (program /= 'tiltpad' .and. .not. allocated(file%failure)) then
         call raise(error, system_error, path//': not a result of tiltpad')
      else
         call file%get_flag('format_version', version)
         if (version > machine_version) then
            call raise(error, system_error, path//': format_version '//to_text(version) &
               & //', written by a later version of tiltpad; update the program')
         else if (version < format_version .and. .not. allocated(file%failure)) then
            call raise(error, system_error, path//': format_version '//to_text(version) &
               & //', written by an earlier version of tiltpad; only Python reads it')
            if (present(older)) older = .true.
         end if
      end if
      if (.not. allocated(error) .and. allocated(file%failure)) call raise(error, system_error, path//': damaged: ' &
         & //file%failure)
      if (allocated(error)) call file%close()
   end subroutine open_known

   !> Refuses a case that is not that of the file, and names the variable. Only the time between checkpoints may
   !> differ. A run of a study must have been this one also; the study may have grown. What belongs to no study may be
   !> the same run continued, `go_on`, but replaces no run.
   subroutine refuse_other_case(path, ours, tag, go_on, found, error)
      character(len=*), intent(in) :: path
      type(case_type), intent(in) :: ours
      type(run_tag), intent(in) :: tag
      logical, intent(in) :: go_on
      type(restart_type), intent(in) :: found
      type(error_type), allocatable, intent(out) :: error
      type(variable_table_type) :: here, there
      character(len=:), allocatable :: changed
      integer :: i
      call list_variables(ours, here)
      call list_variables(found%inputs, there)
      if (.not. same_variables(here, there)) then
         call raise(error, system_error, path//': is the result of another case; there it has other groups of a ' &
            & //'machine (tiltpad --check --resume '//path//' prints it)')
         return
      end if
      do i = 1, here%count
         associate (v => here%variables(i), w => there%variables(i))
            if (lines_of(v, '') == lines_of(w, '') .or. v%group//'%'//v%name == checkpoint_variable) cycle
            call raise(error, system_error, path//': is the result of another case; '//v%group//'%' &
               & //v%name//' = '//value_of(w)//' there, '//value_of(v)//' here')
            return
         end associate
      end do
      changed = changed_file(file_marks(ours), found%files)
      if (changed /= '') then
         call raise(error, system_error, path//': is the result of another case; the file that '//changed &
            & //' names has changed since')
         return
      end if
      if (tag%number == 0) then
         if (found%tag%number > 0 .and. .not. go_on) call raise(error, system_error, path//': is run ' &
            & //to_text(found%tag%number)//' of a study')
      else if (found%tag%number == 0) then
         call raise(error, system_error, path//': is the result of the same case, but no run of a study')
      else if (found%tag%number /= tag%number .or. found%tag%study /= tag%study) then
         call raise(error, system_error, path//': is run '//to_text(found%tag%number)//' of another study; ' &
            & //replaced(found%tag%study, newline, ', ')//' there, '//replaced(tag%study, newline, ', ')//' here')
      end if
   end subroutine refuse_other_case

   !> Whether two cases have the same variables, whatever their values.
   pure logical function same_variables(here, there) result(same)
      type(variable_table_type), intent(in) :: here, there
      integer :: i
      same = here%count == there%count
      do i = 1, here%count
         if (same) same = here%variables(i)%group == there%variables(i)%group &
            & .and. here%variables(i)%name == there%variables(i)%name
      end do
   end function same_variables

   !> The value of a variable, on one line.
   pure function value_of(v) result(value)
      type(variable_type), intent(in) :: v
      character(len=:), allocatable :: value
      value = lines_of(v, '')
      value = value(index(value, '=') + 2:index(value, newline) - 1)
      if (value == '') value = 'not set'
   end function value_of
end module restart
