!> The file of a study or of a block of it: opened with the rows that there are, and joined from the files of blocks.
module joined_blocks
   use clock, only: wall_clock
   use text, only: to_text
   use errors, only: error_type, raise, stopped
   use files, only: is_regular
   use parameter_study, only: study_type
   use stop_signals, only: stop_requested, stop_reason
   use study_file, only: study_file_type
   use study_source, only: take_rows, is_collected, is_study
   use study_blocks, only: block_type, path_type, block_paths, state_of, stays_there, delete_block
   use study_log, only: not_run
   use run_case, only: way_out
   implicit none (type, external)
   private
   public :: study_place_type, open_study, delete_blocks, join_blocks, find_rows

   !> Where a study is written: NAME.h5, and where runs have files the folder NAME.
   type :: study_place_type
      character(len=:), allocatable :: name
      !> Whether runs have files, from which tiltpad-collect may have made one.
      logical :: filed = .false.
      logical :: overwrite = .false., quiet = .false.
   end type study_place_type

contains

   !> Adds to `status` that of the runs that have rows in the file of a block or of the whole study, as `take_rows`.
   subroutine find_rows(study, place, path, way, status, error, columns)
      type(study_type), intent(in) :: study
      type(study_place_type), intent(in) :: place
      !> The file, and what a message says of replacing it.
      character(len=*), intent(in) :: path, way
      integer, intent(inout) :: status(:)
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in), optional :: columns
      logical :: other
      if (is_made_anew(place, path)) return
      call take_rows(path, study, status, other, error, columns=columns)
      if (allocated(error)) call refuse(other, place%overwrite, way, error)
   end subroutine find_rows

   !> Whether a file is one that tiltpad-collect made of the files of runs.
   logical function is_made_anew(place, path) result(is)
      type(study_place_type), intent(in) :: place
      character(len=*), intent(in) :: path
      is = place%filed
      if (is) is = is_regular(path)
      if (is) is = is_collected(path)
   end function is_made_anew

   !> Keeps the error that a file is in the way, unless it is of another study and may be overwritten: what cannot be
   !> read never is.
   subroutine refuse(other, overwrite, way, error)
      logical, intent(in) :: other, overwrite
      character(len=*), intent(in) :: way
      type(error_type), allocatable, intent(inout) :: error
      if (.not. other) then
         error%message = error%message//'; it is not replaced'
      else if (overwrite) then
         deallocate (error)
      else
         error%message = error%message//way
      end if
   end subroutine refuse

   !> Opens the file of a study or of a block, with the rows that there are under its name and, for a whole study, in
   !> the files of blocks. These are `taken`: of no use any more once the table is published.
   subroutine open_study(study, place, share, table, taken, error)
      type(study_type), intent(in) :: study
      type(study_place_type), intent(in) :: place
      type(block_type), intent(in) :: share
      type(study_file_type), intent(inout) :: table
      type(path_type), allocatable, intent(out) :: taken(:)
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: path
      integer :: i
      logical :: other, marked
      allocate (taken(0))
      path = share%path(place%name)
      call table%claim(path, error)
      if (allocated(error)) return
      associate (taken_from => table%working%lock%taken_from)
         if (.not. place%quiet .and. taken_from /= '') print '(a)', path//': '//taken_from//', which wrote it, has ' &
            & //'ended'
      end associate
      ! behind the lock, as another may have joined them
      if (share%of == 1) taken = block_paths(place%name)
      call table%begin(study, share%first(study%runs), share%last(study%runs), error)
      do i = 0, size(taken)
         if (allocated(error)) exit
         if (i > 0) then
            path = taken(i)%path
            taken(i)%state = state_of(path)
         else
            if (is_made_anew(place, path)) cycle
         end if
         call table%working%heartbeat(int(wall_clock()))
         call table%take(study, path, other, error)
         if (allocated(error)) then
            call refuse(other, place%overwrite, way_out, error)
            ! the result of a run whose name is like a block's
            if (i > 0 .and. .not. allocated(error)) then
               if (.not. is_study(path, marked)) taken(i)%state = stays_there
            end if
         end if
         if (.not. allocated(error) .and. stop_requested()) call raise(error, stopped, stop_reason()//' while rows ' &
            & //'were read')
      end do
      if (allocated(error)) then
         call table%abandon()
         return
      end if
      call table%start(error)
      if (allocated(error) .or. place%quiet) return
      if (table%lost() > 0) print '(a)', table%name//'.rows: the last '//to_text(table%lost())//' bytes were no ' &
         & //'whole row; its run is performed again'
      if (size(taken) > 0) print '(a)', table%name//': takes the rows of '//to_text(size(taken))//' files of blocks'
   end subroutine open_study

   !> Deletes files whose rows have been published.
   subroutine delete_blocks(taken)
      type(path_type), intent(in) :: taken(:)
      integer :: i
      do i = 1, size(taken)
         call delete_block(taken(i))
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
      call open_study(study, place, block_type(), table, taken, error)
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
   !> block, as they mostly end in their order. Columns are looked at where rows are taken.
   subroutine ask_all(study, place, of, all_finished, error)
      type(study_type), intent(in) :: study
      type(study_place_type), intent(in) :: place
      integer, intent(in) :: of
      logical, intent(out) :: all_finished
      type(error_type), allocatable, intent(out) :: error
      type(block_type) :: share
      character(len=:), allocatable :: path
      integer, allocatable :: status(:)
      integer :: j
      allocate (status(study%runs), source=not_run)
      call find_rows(study, place, place%name//'.h5', way_out, status, error, columns=.false.)
      all_finished = .not. allocated(error)
      do j = of, 1, -1
         if (.not. all_finished) return
         share = block_type(j, of)
         path = share%path(place%name)
         call find_rows(study, place, path, '; --block '//to_text(j)//'/'//to_text(of)//' --overwrite replaces it', &
            & status, error, columns=.false.)
         ! joined and deleted by another program meanwhile
         if (allocated(error)) then
            if (.not. is_regular(path)) deallocate (error)
         end if
         all_finished = all(status(share%first(study%runs):share%last(study%runs)) /= not_run) &
            & .and. .not. allocated(error)
      end do
   end subroutine ask_all
end module joined_blocks
