!> The blocks of a study, whose runs are performed by several programs, each into a file of its own that is joined with
!> the others when all are finished.
module study_blocks
   use kinds, only: i8
   use text, only: to_text
   use errors, only: error_type
   use files, only: delete_file, block_names, file_identity
   use working_file, only: working_file_type
   use study_source, only: log_path, log_ending
   implicit none (type, external)
   private
   public :: block_type, path_type, block_paths, refuse_written, state_of, stays_there, delete_block

   !> The state of a file that is no block's, and never deleted.
   character(len=*), parameter :: stays_there = ''

   !> One of some blocks of runs that follow each other, whose sizes differ by one at most.
   type :: block_type
      integer :: number = 1, of = 1
   contains
      !> Its first and last run of this number; the last is before the first in an empty block.
      procedure :: first
      procedure :: last
      procedure :: path
   end type block_type

   !> A file; of a block whose rows were read, `state` is what its files were then.
   type :: path_type
      character(len=:), allocatable :: path, state
   end type path_type

contains

   pure integer function first(self, runs)
      class(block_type), intent(in) :: self
      integer, intent(in) :: runs
      first = int((self%number - 1_i8)*runs/self%of) + 1
   end function first

   pure integer function last(self, runs)
      class(block_type), intent(in) :: self
      integer, intent(in) :: runs
      last = int(int(self%number, i8)*runs/self%of)
   end function last

   !> The file of its rows: NAME.03of16.h5; NAME.h5 where the block is the whole study.
   pure function path(self, name)
      class(block_type), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: path, number
      number = to_text(self%number)
      path = name
      if (self%of > 1) path = path//'.'//repeat('0', len(to_text(self%of)) - len(number))//number//'of' &
         & //to_text(self%of)
      path = path//'.h5'
   end function path

   !> The files of blocks that there are of the study NAME, however many blocks it was given; of one that was killed
   !> there may be its log alone.
   function block_paths(name) result(paths)
      character(len=*), intent(in) :: name
      type(path_type), allocatable :: paths(:)
      type(path_type), allocatable :: logs(:)
      integer :: i, k
      paths = paths_with('.h5', name)
      logs = paths_with('.h5'//log_ending, name)
      do i = 1, size(logs)
         associate (own => logs(i)%path(:len(logs(i)%path) - len(log_ending)))
            if (.not. any([(paths(k)%path == own, k=1, size(paths))])) paths = [paths, path_type(own, '')]
         end associate
      end do
   end function block_paths

   !> The files beside a study that are named like its blocks' with this ending.
   function paths_with(ending, name) result(paths)
      character(len=*), intent(in) :: ending, name
      type(path_type), allocatable :: paths(:)
      character(len=:), allocatable :: names, folder
      integer :: i, from, length
      folder = name(:index(name, '/', back=.true.))
      names = block_names(name, ending)
      allocate (paths(count([(names(i:i) == '/', i=1, len(names))])))
      from = 1
      do i = 1, size(paths)
         length = index(names(from:), '/')
         paths(i)%path = folder//names(from:from + length - 2)
         from = from + length
      end do
   end function paths_with

   !> An error where somebody writes the rows of a block of the study NAME.
   subroutine refuse_written(name, error)
      character(len=*), intent(in) :: name
      type(error_type), allocatable, intent(out) :: error
      type(path_type), allocatable :: locks(:)
      type(working_file_type) :: work
      integer :: i
      locks = paths_with('.h5.lock', name)
      do i = 1, size(locks)
         associate (lock => locks(i)%path)
            call work%claim(lock(:len(lock) - len('.lock')), error)
         end associate
         if (allocated(error)) return
         call work%release()
      end do
   end subroutine refuse_written

   !> Differs once somebody has written the table or the log of a block: a table gets a new file, and a log grows.
   function state_of(path) result(state)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: state
      integer(i8) :: length
      inquire (file=log_path(path), size=length)
      state = file_identity(path)//' '//file_identity(log_path(path))//' '//to_text(length)
   end function state_of

   !> Deletes the files of a block and what a killed program has left beside them, unless somebody writes them, or has
   !> written them since their rows were read.
   subroutine delete_block(block)
      type(path_type), intent(in) :: block
      type(working_file_type) :: work
      type(error_type), allocatable :: held
      ! whoever holds it may still be there
      work%lock%watch_held = 0
      call work%claim(block%path, held)
      if (allocated(held)) return
      if (state_of(block%path) == block%state) then
         call delete_file(log_path(block%path))
         call delete_file(block%path)
      end if
      call work%release()
   end subroutine delete_block
end module study_blocks
