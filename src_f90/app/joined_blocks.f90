!> The file of a study or of a block of it: opened, and joined from the files of blocks.
module joined_blocks
   use clock, only: wall_clock
   use text, only: to_text
   use errors, only: error_type, raise, stopped
   use files, only: is_regular
   use hdf5_file, only: hdf5_type
   use parameter_study, only: study_type
   use restart, only: open_result
   use stop_signals, only: stop_requested, stop_reason
   use study_file, only: study_file_type
   use study_marks, only: is_collected
   use study_blocks, only: block_type, path_type, block_paths, read_status, delete_block
   use study_rows, only: not_run
   use run_case, only: way_out
   implicit none (type, external)
   private
   public :: study_place_type, open_table, open_joined, delete_blocks, join_blocks, status_elsewhere

   !> Where a study is written: NAME.h5, and where runs have files the folder NAME.
   type :: study_place_type
      character(len=:), allocatable :: name
      !> Whether runs have files, from which tiltpad-collect may have made one.
      logical :: filed = .false.
      logical :: overwrite = .false., quiet = .false.
   end type study_place_type

contains

   !> Opens the file of a study or of a block: a new one, or that of the same study to go on with.
   subroutine open_table(study, place, share, table, error)
      type(study_type), intent(in) :: study
      type(study_place_type), intent(in) :: place
      type(block_type), intent(in) :: share
      type(study_file_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: path
      path = share%path(place%name)
      call table%claim(path, error)
      if (allocated(error)) return
      associate (taken_from => table%working%lock%taken_from)
         if (.not. place%quiet .and. taken_from /= '') print '(a)', path//': '//taken_from//', which wrote it, has ' &
            & //'ended'
      end associate
      if (has_rows(place, path)) then
         call table%reopen(study, error)
         if (.not. allocated(error)) return
         call refuse(path, place%overwrite, way_out, error)
         if (.not. allocated(error)) call table%claim(path, error)
         if (allocated(error)) return
      end if
      call table%begin(study, error, share%first(study%runs), share%last(study%runs))
   end subroutine open_table

   !> Whether there is a file of a study that goes on: not one that is made anew of the same files.
   logical function has_rows(place, path) result(has)
      type(study_place_type), intent(in) :: place
      character(len=*), intent(in) :: path
      has = is_regular(path)
      if (.not. (has .and. place%filed)) return
      has = .not. is_collected(path)
   end function has_rows

   !> Keeps the error that a file is in the way, unless it may be overwritten; what is no result never is.
   subroutine refuse(path, overwrite, way, error)
      character(len=*), intent(in) :: path, way
      logical, intent(in) :: overwrite
      type(error_type), allocatable, intent(inout) :: error
      type(error_type), allocatable :: foreign
      type(hdf5_type) :: file
      logical :: older
      call open_result(path, file, foreign, older)
      if (allocated(foreign) .and. .not. older) then
         error%message = error%message//'; it is not replaced'
      else if (overwrite) then
         deallocate (error)
      else
         error%message = error%message//way
      end if
      call file%close()
   end subroutine refuse

   !> Opens the file of the whole study, and adds the rows of all blocks that there are. They are `taken`: of no use any
   !> more once the table is published.
   subroutine open_joined(study, place, table, taken, error)
      type(study_type), intent(in) :: study
      type(study_place_type), intent(in) :: place
      type(study_file_type), intent(inout) :: table
      type(path_type), allocatable, intent(out) :: taken(:)
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      call open_table(study, place, block_type(), table, error)
      ! behind the lock, as another may have joined them
      taken = block_paths(place%name)
      do i = 1, size(taken)
         if (allocated(error)) exit
         call table%working%beat(int(wall_clock()))
         call table%join(study, taken(i)%path, error)
         if (allocated(error)) then
            if (.not. allocated(table%failure)) call refuse(taken(i)%path, place%overwrite, way_out, error)
         else if (stop_requested()) then
            call raise(error, stopped, stop_reason()//' while blocks were joined')
         end if
      end do
      if (allocated(error) .or. place%quiet .or. size(taken) == 0) return
      print '(a)', table%name//': takes the rows of '//to_text(size(taken))//' files of blocks'
   end subroutine open_joined

   !> Deletes files whose rows have been published.
   subroutine delete_blocks(taken)
      type(path_type), intent(in) :: taken(:)
      integer :: i
      do i = 1, size(taken)
         call delete_block(taken(i)%path)
      end do
   end subroutine delete_blocks

   !> Joins all blocks to the study's file where all are finished, unless another program does so.
   subroutine join_blocks(study, place, of, error)
      type(study_type), intent(in) :: study
      type(study_place_type), intent(in) :: place
      integer, intent(in) :: of
      type(error_type), allocatable, intent(out) :: error
      type(study_file_type) :: table
      type(path_type), allocatable :: taken(:)
      logical :: all_finished
      call ask_all(study, place, of, all_finished, error)
      if (allocated(error)) return
      if (.not. all_finished) then
         if (.not. place%quiet) print '(a)', place%name//'.h5: follows when all '//to_text(of)//' blocks are finished'
         return
      end if
      if (size(block_paths(place%name)) == 0) return
      call open_joined(study, place, table, taken, error)
      if (.not. allocated(error)) call table%publish(error)
      if (.not. allocated(error)) then
         call delete_blocks(taken)
      else if (table%held_by() /= '') then
         ! two that end at the same time find the same
         deallocate (error)
         if (.not. place%quiet) print '(a)', place%name//'.h5: '//table%held_by()//' is writing it'
      end if
      call table%abandon()
   end subroutine join_blocks

   !> Whether all blocks are finished: each run has a row in its block's file or in the study's. Begins with the last
   !> block, as they mostly end in their order.
   subroutine ask_all(study, place, of, all_finished, error)
      type(study_type), intent(in) :: study
      type(study_place_type), intent(in) :: place
      integer, intent(in) :: of
      logical, intent(out) :: all_finished
      type(error_type), allocatable, intent(out) :: error
      type(block_type) :: share
      character(len=:), allocatable :: path
      integer, allocatable :: status(:), own(:)
      integer :: j
      allocate (status(study%runs), own(study%runs))
      call status_elsewhere(study, place, status, error)
      all_finished = .not. allocated(error)
      do j = of, 1, -1
         if (.not. all_finished) return
         share = block_type(j, of)
         path = share%path(place%name)
         own = not_run
         if (is_regular(path)) call read_status(path, study, own, error)
         ! joined and deleted by another program meanwhile
         if (allocated(error)) then
            if (.not. is_regular(path)) deallocate (error)
         end if
         if (allocated(error)) call refuse(path, place%overwrite, '; --block '//to_text(j)//'/'//to_text(of) &
            & //' --overwrite replaces it', error)
         associate (first => share%first(study%runs), last => share%last(study%runs))
            all_finished = all(max(status(first:last), own(first:last)) /= not_run) .and. .not. allocated(error)
         end associate
      end do
   end subroutine ask_all

   !> The exit status of each run in the study's own file, `not_run` where it has no row or there is no file.
   subroutine status_elsewhere(study, place, status, error)
      type(study_type), intent(in) :: study
      type(study_place_type), intent(in) :: place
      integer, intent(out) :: status(:)
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: path
      path = place%name//'.h5'
      status = not_run
      if (.not. has_rows(place, path)) return
      call read_status(path, study, status, error)
      if (allocated(error)) call refuse(path, place%overwrite, way_out, error)
   end subroutine status_elsewhere
end module joined_blocks
