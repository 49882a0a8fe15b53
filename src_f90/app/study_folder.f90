!> The folder of a study: the names of its files, and that they are of one study.
module study_folder
   use text, only: to_text
   use errors, only: error_type, raise, system_error, stopped
   use case_inputs, only: case_type
   use parameter_study, only: study_type, run_tag
   use files, only: is_regular, make_folder, remove_folder, other_number
   use study_blocks, only: block_type
   use restart, only: restart_type, read_result, refuse_other_case, is_of_other_study
   use run_case, only: way_out
   use stop_signals, only: stop_requested, stop_reason
   implicit none (type, external)
   private
   public :: result_path, prepare_folder, check_folder, check_neighbours

contains

   !> Result file of a run: FOLDER/0001.h5, with as many digits as the last one needs.
   function result_path(folder, k, runs) result(path)
      character(len=*), intent(in) :: folder
      integer, intent(in) :: k, runs
      character(len=:), allocatable :: path, number
      number = to_text(k)
      path = folder//'/'//repeat('0', name_width(runs) - len(number))//number//'.h5'
   end function result_path

   !> Digits in the names of the files.
   integer function name_width(runs)
      integer, intent(in) :: runs
      name_width = max(4, len(to_text(runs)))
   end function name_width

   !> Makes the folder of the runs if it is not there, and tries to write into it.
   subroutine prepare_folder(folder, error)
      character(len=*), intent(in) :: folder
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: refusal, trial
      ! one name for all, so that what a killed program leaves is removed by the next
      trial = folder//'/.tiltpad.part'
      call make_folder(folder, refusal)
      if (refusal == '') then
         call make_folder(trial, refusal)
         call remove_folder(trial)
      end if
      if (refusal /= '') call raise(error, system_error, 'cannot write into the folder '//folder//': '//refusal)
   end subroutine prepare_folder

   !> Refuses a folder with results of another study: results that are not those of a block of this study's runs,
   !> unless they may be overwritten, and numbers that this study does not have. The study may have grown. What cannot
   !> be read is left to its run.
   subroutine check_folder(study, share, folder, overwrite, error)
      type(study_type), intent(in) :: study
      type(block_type), intent(in) :: share
      character(len=*), intent(in) :: folder
      logical, intent(in) :: overwrite
      type(error_type), allocatable, intent(out) :: error
      type(restart_type) :: found
      type(case_type) :: inputs
      type(run_tag) :: tag
      character(len=:), allocatable :: path, other
      integer :: k
      other = other_number(folder, name_width(study%runs), study%runs)
      if (other /= '') call raise(error, system_error, folder//'/'//other//': is no run of this study, which has ' &
         & //to_text(study%runs)//'; remove it, or name another folder with --output')
      if (overwrite) return
      do k = share%first(study%runs), share%last(study%runs)
         if (stop_requested()) call raise(error, stopped, stop_reason()//'; no run was started')
         if (allocated(error)) return
         path = result_path(folder, k, study%runs)
         if (.not. is_readable(path, found)) cycle
         call study%inputs(k, inputs, error)
         if (allocated(error)) return
         call study%tag(k, tag)
         call refuse_other_case(path, inputs, tag, .true., found, error)
         if (allocated(error)) error%message = error%message//way_out
      end do
   end subroutine check_folder

   !> The same for the k-th run alone, which looks at the results of its neighbours only, as a study may
   !> have very many.
   subroutine check_neighbours(study, folder, k, error)
      type(study_type), intent(in) :: study
      character(len=*), intent(in) :: folder
      integer, intent(in) :: k
      type(error_type), allocatable, intent(out) :: error
      type(run_tag) :: tag
      character(len=:), allocatable :: path
      integer :: i
      do i = max(1, k - 1), min(study%runs, k + 1)
         if (i == k) cycle
         path = result_path(folder, i, study%runs)
         call study%tag(i, tag)
         if (.not. is_of_other_study(path, tag)) cycle
         call raise(error, system_error, path//': is of another study than run '//to_text(k)//way_out)
         return
      end do
   end subroutine check_neighbours

   !> True where there is a result of this name that can be read.
   logical function is_readable(path, found)
      character(len=*), intent(in) :: path
      type(restart_type), intent(out) :: found
      type(error_type), allocatable :: error
      is_readable = is_regular(path)
      if (.not. is_readable) return
      call read_result(path, found, error, texts_alone=.true.)
      is_readable = .not. allocated(error)
   end function is_readable
end module study_folder
