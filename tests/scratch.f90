!> Files of a test's own, in the folder for temporary files.
module scratch
   use text, only: to_text
   use processes, only: process_id
   implicit none (type, external)
   private
   public :: scratch_path, for_shell, file_there, write_bytes, bytes_of

contains

   !> A path that no other test and no other run has.
   function scratch_path(name) result(path)
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: path
      character(len=200) :: folder
      call get_environment_variable('TMPDIR', folder)
      if (folder == '') folder = '/tmp'
      path = trim(folder)//'/tiltpad''s test '//to_text(process_id())//'_'//name
   end function scratch_path

   !> A path as one word of a shell.
   function for_shell(path) result(word)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: word
      integer :: i
      word = "'"
      do i = 1, len(path)
         word = word//path(i:i)
         if (path(i:i) == "'") word = word//"\''"
      end do
      word = word//"'"
   end function for_shell

   logical function file_there(path)
      character(len=*), intent(in) :: path
      inquire (file=path, exist=file_there)
   end function file_there

   !> Replaces a file by one of these bytes.
   subroutine write_bytes(path, bytes)
      character(len=*), intent(in) :: path, bytes
      integer :: unit
      open (newunit=unit, file=path, access='stream', form='unformatted', status='replace', action='write')
      write (unit) bytes
      close (unit)
   end subroutine write_bytes

   !> All bytes of a file; '(none)' where there is none.
   function bytes_of(path) result(bytes)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: bytes
      integer :: unit, length
      bytes = '(none)'
      if (.not. file_there(path)) return
      open (newunit=unit, file=path, access='stream', form='unformatted', status='old', action='read')
      inquire (unit=unit, size=length)
      deallocate (bytes)
      allocate (character(len=length) :: bytes)
      if (length > 0) read (unit) bytes
      close (unit)
   end function bytes_of
end module scratch
