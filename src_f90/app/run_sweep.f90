!> Runs the members of a sweep, each in a process of its own, as many at a time as are asked for.
module run_sweep
   use, intrinsic :: iso_fortran_env, only: output_unit, error_unit
   use kinds, only: wp
   use text, only: to_text, fixed_text, on_one_line
   use errors, only: error_type, raise, system_error, stopped
   use scene, only: scene_type
   use sweep, only: sweep_type, member_tag
   use posix, only: process_id
   use processes, only: record_length, new_process, end_child, end_with_parent, open_pipe, send_record, &
      & receive_record, wait_for_record, ended, stop_process, make_folder, remove_folder
   use hdf5_base, only: start_hdf5
   use signals, only: stop_requested, stop_signal
   use progress, only: progress_type, new_progress, wall_clock
   implicit none (type, external)
   private
   public :: run_members, check_members, member_file, prepare_folder, member_runner

   abstract interface
      !> Runs one member to its result file, saying nothing.
      subroutine member_runner(scene, path, tag, error)
         import :: scene_type, member_tag, error_type
         type(scene_type), intent(in) :: scene
         character(len=*), intent(in) :: path
         type(member_tag), intent(in) :: tag
         type(error_type), allocatable, intent(out) :: error
      end subroutine member_runner
   end interface

   !> Milliseconds between two looks at children that may have ended without a word.
   integer, parameter :: pause = 100
   !> Bytes of number and status in a member's last word; its message follows.
   integer, parameter :: head = 24

   !> A member under way.
   type :: child_type
      integer :: process = 0, member = 0
      !> How it ended, where that is known before its last word was read.
      character(len=:), allocatable :: how
   end type child_type

   !> What became of the members so far.
   type :: tally_type
      integer :: done = 0, failed = 0, stopped = 0
      !> Status and message of each failed member.
      type(error_type), allocatable :: errors(:)
   end type tally_type

contains

   !> Reads and checks every member; the error is the first bad member's, or that a signal came.
   subroutine check_members(sweep, error)
      type(sweep_type), intent(in) :: sweep
      type(error_type), allocatable, intent(out) :: error
      type(scene_type) :: scene
      integer :: k
      do k = 1, sweep%members
         call sweep%scene(k, scene, error)
         if (stop_requested()) call raise(error, stopped, 'stopped by signal '//to_text(stop_signal()) &
            & //'; no member was started')
         if (allocated(error)) return
      end do
   end subroutine check_members

   !> The folder of the members is made if it is not there, and tried.
   subroutine prepare_folder(folder, error)
      character(len=*), intent(in) :: folder
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: trouble, trial
      trial = folder//'/.part'//to_text(int(process_id()))
      call make_folder(folder, trouble)
      if (trouble == '') then
         call make_folder(trial, trouble)
         call remove_folder(trial)
      end if
      if (trouble /= '') call raise(error, system_error, 'cannot write into the folder '//folder//': '//trouble)
   end subroutine prepare_folder

   !> Result file of a member: FOLDER/0001.h5, with as many digits as the last one needs.
   function member_file(folder, k, members) result(path)
      character(len=*), intent(in) :: folder
      integer, intent(in) :: k, members
      character(len=:), allocatable :: path, digits
      digits = to_text(k)
      path = folder//'/'//repeat('0', max(4, len(to_text(members))) - len(digits))//digits//'.h5'
   end function member_file

   !> Runs all members of a checked sweep into a prepared folder, `jobs` at a time. A failed member stops no other;
   !> a noted signal does: then those under way are told and waited for. `failures` has one error a failed member;
   !> `error` says how many failed, or which signal came.
   subroutine run_members(sweep, folder, jobs, quiet, run_member, failures, error)
      type(sweep_type), intent(in) :: sweep
      character(len=*), intent(in) :: folder
      integer, intent(in) :: jobs
      logical, intent(in) :: quiet
      procedure(member_runner) :: run_member
      type(error_type), allocatable, intent(out) :: failures(:)
      type(error_type), allocatable, intent(out) :: error
      type(child_type) :: children(min(jobs, sweep%members))
      type(tally_type) :: tally
      type(progress_type) :: progress
      real(wp) :: started
      integer :: pipe(2), next, i
      logical :: ok, told

      allocate (failures(0), tally%errors(sweep%members))
      call open_pipe(pipe, ok)
      if (.not. ok) then
         call raise(error, system_error, 'no pipe to be had for the members of the sweep')
         return
      end if
      call start_hdf5()
      started = wall_clock()
      progress = new_progress(0.0_wp, real(sweep%members, wp), quiet)
      next = 1
      told = .false.
      do
         do i = 1, size(children)
            if (children(i)%member /= 0 .or. next > sweep%members .or. stop_requested()) cycle
            call start(sweep, folder, next, pipe(2), run_member, children(i))
            if (children(i)%member == 0) then
               ! no process to be had: later, when one of ours has ended, if there is one
               if (any(children%member /= 0)) exit
               call note(next, system_error, 'no process to be had for it', tally)
            end if
            next = next + 1
         end do
         if (stop_requested() .and. .not. told) then
            told = .true.
            do i = 1, size(children)
               if (children(i)%member /= 0) call stop_process(children(i)%process)
            end do
         end if
         if (all(children%member == 0) .and. (next > sweep%members .or. stop_requested())) exit
         call look(children, pipe(1), tally)
         call progress%report_members(tally%done + tally%failed, tally%failed)
      end do
      call progress%clear()
      call conclude(sweep, tally, failures, error)
      if (.not. quiet) print '(a)', to_text(sweep%members)//' members: '//totals(sweep, tally)//'; ' &
         & //fixed_text(wall_clock() - started, 2)//' s; in '//folder
   end subroutine run_members

   !> Starts a member in a child process; `child` has no member where there is no process to be had.
   subroutine start(sweep, folder, k, pipe, run_member, child)
      type(sweep_type), intent(in) :: sweep
      character(len=*), intent(in) :: folder
      integer, intent(in) :: k, pipe
      procedure(member_runner) :: run_member
      type(child_type), intent(inout) :: child
      integer :: parent
      parent = int(process_id())
      ! what is buffered here would else be written by both
      flush (output_unit)
      flush (error_unit)
      if (allocated(child%how)) deallocate (child%how)
      child%member = k
      child%process = new_process()
      if (child%process == 0) then
         call end_with_parent(parent)
         call live(sweep, folder, k, pipe, run_member)
      else if (child%process < 0) then
         child%member = 0
      end if
   end subroutine start

   !> The child's life: runs the member, sends its last word and ends.
   subroutine live(sweep, folder, k, pipe, run_member)
      type(sweep_type), intent(in) :: sweep
      character(len=*), intent(in) :: folder
      integer, intent(in) :: k, pipe
      procedure(member_runner) :: run_member
      type(scene_type) :: scene
      type(member_tag) :: tag
      type(error_type), allocatable :: error
      character(len=record_length) :: record
      call sweep%tag(k, tag)
      call sweep%scene(k, scene, error)
      if (.not. allocated(error)) call run_member(scene, member_file(folder, k, sweep%members), tag, error)
      if (.not. allocated(error)) error = error_type(0, '')
      write (record, '(2i12,a)') k, error%status, error%message(:min(len(error%message), record_length - head))
      call send_record(pipe, record)
      call end_child(0)
   end subroutine live

   !> Waits for a last word, and a while at most, and takes note of the children that have ended.
   subroutine look(children, pipe, tally)
      type(child_type), intent(inout) :: children(:)
      integer, intent(in) :: pipe
      type(tally_type), intent(inout) :: tally
      character(len=record_length) :: record
      character(len=:), allocatable :: how
      integer :: i, k, status
      logical :: ok
      if (.not. wait_for_record(pipe, pause)) then
         do i = 1, size(children)
            if (children(i)%member == 0) cycle
            if (ended(children(i)%process, .false., how)) children(i)%how = how
         end do
      end if
      do while (wait_for_record(pipe, 0))
         call receive_record(pipe, record, ok)
         if (.not. ok) exit
         read (record(:head), '(2i12)') k, status
         call note(k, status, trim(record(head + 1:)), tally)
         i = findloc(children%member, k, dim=1)
         children(i)%member = 0
         if (.not. allocated(children(i)%how)) then
            if (ended(children(i)%process, .true., how)) children(i)%how = how
         end if
      end do
      ! what they had to say has been read
      do i = 1, size(children)
         if (children(i)%member == 0 .or. .not. allocated(children(i)%how)) cycle
         call note(children(i)%member, system_error, children(i)%how, tally)
         children(i)%member = 0
      end do
   end subroutine look

   !> Enters what became of a member.
   subroutine note(k, status, message, tally)
      integer, intent(in) :: k, status
      character(len=*), intent(in) :: message
      type(tally_type), intent(inout) :: tally
      select case (status)
      case (0)
         tally%done = tally%done + 1
      case (stopped)
         tally%stopped = tally%stopped + 1
      case default
         tally%failed = tally%failed + 1
         tally%errors(k)%status = status
         tally%errors(k)%message = message
      end select
   end subroutine note

   !> The failed members' errors, in order, and the error of the whole: 4 after a signal; else 3 if any had that;
   !> else the highest.
   subroutine conclude(sweep, tally, failures, error)
      type(sweep_type), intent(in) :: sweep
      type(tally_type), intent(in) :: tally
      type(error_type), allocatable, intent(out) :: failures(:)
      type(error_type), allocatable, intent(out) :: error
      type(member_tag) :: tag
      integer :: k, n
      allocate (failures(tally%failed))
      n = 0
      do k = 1, sweep%members
         if (tally%errors(k)%status == 0) cycle
         n = n + 1
         failures(n) = tally%errors(k)
         call sweep%tag(k, tag)
         failures(n)%message = 'member '//to_text(k)//' ('//on_one_line(tag%sweep)//'): '//failures(n)%message
      end do
      if (stop_requested()) then
         call raise(error, stopped, 'stopped by signal '//to_text(stop_signal())//'; of ' &
            & //to_text(sweep%members)//' members '//totals(sweep, tally))
      else if (tally%stopped > 0) then
         call raise(error, stopped, to_text(tally%stopped)//' of '//to_text(sweep%members) &
            & //' members were stopped by a signal')
      else if (n > 0) then
         call raise(error, maxval(failures%status), to_text(n)//' of '//to_text(sweep%members)//' members failed')
      end if
   end subroutine conclude

   !> "997 done, 3 failed".
   function totals(sweep, tally)
      type(sweep_type), intent(in) :: sweep
      type(tally_type), intent(in) :: tally
      character(len=:), allocatable :: totals
      integer :: rest
      totals = to_text(tally%done)//' done, '//to_text(tally%failed)//' failed'
      rest = sweep%members - tally%done - tally%failed - tally%stopped
      if (tally%stopped > 0) totals = totals//', '//to_text(tally%stopped)//' stopped'
      if (rest > 0) totals = totals//', '//to_text(rest)//' not started'
   end function totals
end module run_sweep
