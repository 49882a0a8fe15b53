!> How a result file was made: program, compiler, machine, times, every stretch of running and its end.
module provenance
   use, intrinsic :: iso_fortran_env, only: compiler_version
   use kinds, only: wp
   use text, only: to_text
   use build_info, only: program_version, program_commit, program_flags
   use record, only: record_type
   use processes, only: host_name
   implicit none (type, external)
   private
   public :: provenance_type, running, format_version, machine_version, now

   !> Version of the names in a file. A new one needs its former names in post/tiltpad/files/former_names.py.
   integer, parameter :: format_version = 3
   !> That of the file of a machine, whose bearings have groups: what knows only one bearing must not read it.
   integer, parameter :: machine_version = 4
   !> The exit status in a file whose run has not ended, or was killed.
   integer, parameter :: running = -1

   type :: provenance_type
      private
      !> When and from which simulated time this stretch runs, and the lines of those before.
      character(len=:), allocatable :: started, earlier
      real(wp) :: from = 0
      integer :: resumes = 0
   contains
      procedure :: begin
      procedure :: resume
      procedure :: note
   end type provenance_type

contains

   !> Notes the start of a new file, of a machine or of one bearing.
   subroutine begin(self, file, of_machine)
      class(provenance_type), intent(inout) :: self
      class(record_type), intent(inout) :: file
      logical, intent(in) :: of_machine
      self%started = now()
      self%earlier = ''
      call file%put_flag('format_version', merge(machine_version, format_version, of_machine))
      call file%put_text('program', 'tiltpad')
      call file%put_text('created', self%started)
      call put_maker(self, file)
   end subroutine begin

   !> Notes that a file is continued from simulated time t, s.
   subroutine resume(self, file, t)
      class(provenance_type), intent(inout) :: self
      class(record_type), intent(inout) :: file
      real(wp), intent(in) :: t
      self%started = now()
      self%from = t
      call file%get_text('history', self%earlier)
      call file%get_flag('resumes', self%resumes)
      self%resumes = self%resumes + 1
      call put_maker(self, file)
   end subroutine resume

   subroutine put_maker(self, file)
      class(provenance_type), intent(in) :: self
      class(record_type), intent(inout) :: file
      call file%put_text('version', program_version)
      call file%put_text('commit', program_commit)
      call file%put_text('compiler', compiler_version())
      call file%put_text('flags', program_flags)
      call file%put_text('host', host_name())
      call file%put_flag('resumes', self%resumes)
   end subroutine put_maker

   !> Notes how far this stretch has come, simulated time t, s, and how it ended: exit status (or `running`) and why.
   subroutine note(self, file, t, status, reason)
      class(provenance_type), intent(in) :: self
      class(record_type), intent(inout) :: file
      real(wp), intent(in) :: t
      integer, intent(in) :: status
      character(len=*), intent(in) :: reason
      character(len=:), allocatable :: line
      line = self%started//' to '//now()//', '//host_name()//', '//program_version//' ('//program_commit//'), t = ' &
         & //to_text(self%from)//' to '//to_text(t)//' s, '
      if (status == running) then
         line = line//'last checkpoint'
      else
         line = line//'exit status '//to_text(status)
      end if
      if (reason /= '') line = line//': '//reason
      if (self%earlier /= '') line = self%earlier//achar(10)//line
      call file%put_text('history', line)
      if (status == running) then
         call file%put_text('ended', '')
      else
         call file%put_text('ended', now())
      end if
      call file%put_flag('exit_status', status)
      call file%put_text('reason', reason)
   end subroutine note

   !> ISO 8601, with the offset from UTC.
   function now()
      character(len=25) :: now
      integer :: clock(8)
      call date_and_time(values=clock)
      write (now, '(ss,i4.4,2("-",i2.2),"T",i2.2,2(":",i2.2),sp,i3.2,":",ss,i2.2)') clock(1:3), clock(5:7), &
         & clock(4)/60, mod(abs(clock(4)), 60)
   end function now
end module provenance
