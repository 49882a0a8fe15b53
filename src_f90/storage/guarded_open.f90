!> Reads an HDF5 file in a child process first: if it is damaged, the library may crash or run for ever.
module guarded_open
   use kinds, only: wp
   use hdf5_base, only: start_hdf5
   use hdf5_file, only: hdf5_type
   use hdf5_scales, only: member_type, list_members
   use hdf5_rows, only: hdf5_rows_type
   use record, only: record_type
   use record_file, only: read_record
   use processes, only: new_process, end_child, limit_child, exit_status
   use files, only: is_readable
   use system_texts, only: system_reason
   implicit none (type, external)
   private
   public :: try_reading, new_reader

   !> Seconds of time, and of the processor's time, after which the reading is given up, and megabytes that it may take.
   integer, parameter :: seconds = 60, work = 3, room = 300

contains

   !> Why the file cannot be read; empty where reading all of its structure, its texts, and the end of each dataset,
   !> or with `texts_alone` no more than its texts and whether it has a checkpoint, does not fail, crash or take too
   !> long. What is missing, or refused before it is read, will be told when it is needed.
   subroutine try_reading(path, refusal, texts_alone)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: refusal
      logical, intent(in), optional :: texts_alone
      integer :: child
      if (.not. is_readable(path)) then
         refusal = 'cannot be read: '//system_reason()
         return
      end if
      child = new_reader()
      if (child < 0) then
         refusal = 'not looked at, as no process could be started for it: '//system_reason()
         return
      else if (child == 0) then
         call read_all(path, texts_alone)
         call end_child(0)
      end if
      refusal = ''
      if (exit_status(child) /= 0) refusal = 'no HDF5 file, or damaged'
   end subroutine try_reading

   !> Starts a child that may read any file: 0 in the child, which ends itself; else as `new_process`.
   integer function new_reader() result(child)
      ! done here once, it saves each child the time
      call start_hdf5()
      child = new_process()
      ! the library and the runtime would report the crash
      if (child == 0) call limit_child(seconds, work, room)
   end function new_reader

   subroutine read_all(path, texts_alone)
      character(len=*), intent(in) :: path
      logical, intent(in), optional :: texts_alone
      type(hdf5_type) :: file
      character(len=*), parameter :: texts(*) = [character(len=11) :: 'program', 'input', 'reason', 'history', &
         & 'sweep', 'study_marks', 'file_marks', 'of_paper', 'task']
      character(len=:), allocatable :: text
      type(record_type) :: results
      integer :: i
      logical :: there
      call file%open(path, writing=.false.)
      if (file%id < 0) return
      text = ''
      do i = 1, size(texts)
         if (file%has_attribute(trim(texts(i)))) call file%get_text(trim(texts(i)), text)
         ! the texts of others, who will be told, are not read
         if (i == 1 .and. text /= 'tiltpad') exit
      end do
      if (allocated(file%failure)) call end_child(1)
      there = file%has('checkpoint/time')
      if (present(texts_alone)) then
         if (texts_alone) return
      end if
      call read_group(file, '/')
      ! what a run reads that goes on; a study has a child of its own for its rows
      if (text /= 'study') call read_record(file, results)
      call file%close()
   end subroutine read_all

   recursive subroutine read_group(file, group)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: group
      type(hdf5_rows_type) :: data
      real(wp), allocatable :: values(:, :)
      type(member_type), allocatable :: members(:)
      character(len=:), allocatable :: path
      integer :: i, status
      call list_members(file%id, group, members, status)
      do i = 1, size(members)
         path = group//trim(members(i)%name)
         if (members(i)%is_group) then
            if (group == '/') call read_group(file, path//'/')
         else
            call data%open(file, path)
            if (allocated(file%failure)) then
               deallocate (file%failure)
            else
               if (data%length > 0) call data%read_behind(file, data%length - 1, 1, values)
               if (allocated(file%failure)) call end_child(1)
            end if
            call data%close(file)
         end if
      end do
   end subroutine read_group
end module guarded_open
