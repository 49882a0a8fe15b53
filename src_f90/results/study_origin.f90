!> What the file of a study says of itself and of its runs before any of them is run.
module study_origin
   use kinds, only: wp
   use errors, only: error_type
   use build_info, only: program_version
   use case_inputs, only: case_type
   use namelist_writer, only: namelist_of
   use parameter_study, only: study_type
   use hdf5_file, only: hdf5_type
   use hdf5_rows, only: hdf5_rows_type, most_rows
   use provenance, only: format_version, machine_version, now
   use study_columns, only: run_scale
   use study_marks, only: put_marks
   use study_parameters, only: parameter_type
   implicit none (type, external)
   private
   public :: put_origin, names_of, write_runs

contains

   !> What the file is and who made it.
   subroutine put_origin(file, study, parameters)
      class(hdf5_type), intent(inout) :: file
      type(study_type), intent(in) :: study
      type(parameter_type), intent(in) :: parameters(:)
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      character(len=:), allocatable :: names
      integer :: k, i
      call file%put_text('program', 'tiltpad')
      call file%put_text('version', program_version)
      call file%put_text('created', now())
      call file%put_text('task', 'study')
      ! the first run that is possible; runs that are not become rows with their reason
      do k = 1, study%runs
         call study%inputs(k, inputs, error)
         if (.not. allocated(error)) exit
      end do
      call file%put_flag('format_version', merge(format_version, machine_version, inputs%rotor%is_rigid()))
      if (allocated(error)) then
         call file%put_text('title', '')
         call file%put_text('input', '')
      else
         call file%put_text('title', inputs%about%title)
         call file%put_text('input', namelist_of(inputs))
      end if
      call file%put_text('parameters', names_of(parameters))
      names = ''
      do i = 1, size(parameters)
         if (i > 1) names = names//achar(10)
         names = names//parameters(i)%variable
      end do
      call file%put_text('variables', names)
      call put_marks(file, study)
      call file%put_flag('finished', 0)
      call file%put_text('missing', '')
   end subroutine put_origin

   !> The names of the parameters, separated by blanks.
   pure function names_of(parameters) result(names)
      type(parameter_type), intent(in) :: parameters(:)
      character(len=:), allocatable :: names
      integer :: i
      names = ''
      do i = 1, size(parameters)
         if (i > 1) names = names//' '
         names = names//parameters(i)%name
      end do
   end function names_of

   !> Writes the numbers of the runs `first` to `last` into their scale: a new one for this number of runs, or, with
   !> `again`, one that has fewer.
   subroutine write_runs(file, runs, first, last, again)
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: runs, first, last
      logical, intent(in) :: again
      type(hdf5_rows_type) :: scale
      integer :: from, to, i
      if (again) then
         call scale%open(file, run_scale)
         call scale%resize(file, [integer ::], runs)
      else
         call scale%create(file, run_scale, [integer ::], runs, 0.0_wp, .true.)
         call file%describe(scale%id, '1', 'number of the run', run_scale, run_scale)
      end if
      do from = first, last, most_rows
         to = min(from + most_rows - 1, last)
         call scale%write(file, from, reshape([(real(i, wp), i=from, to)], [1, to - from + 1]))
      end do
      call scale%close(file)
   end subroutine write_runs
end module study_origin
