!> A case file, read and split into assignments.
module case_text
   use kinds, only: i8
   use text, only: to_text
   use errors, only: error_type, raise, require, input_error
   use assignments, only: namelist_type
   use namelist_text, only: parse_namelist, parse_override
   use files, only: is_regular
   implicit none (type, external)
   private
   public :: read_text, parse_case

   !> Longest input file, bytes.
   integer, parameter :: longest_file = 100000

contains

   !> The text of a case file.
   subroutine read_text(file, text, error)
      character(len=*), intent(in) :: file
      character(len=:), allocatable, intent(out) :: text
      type(error_type), allocatable, intent(out) :: error
      character(len=200) :: message
      logical :: exists
      integer :: unit, status
      integer(i8) :: length
      ! Fortran leaves blanks at the end of a name away
      call require(len_trim(file) == len(file), file//': the name of a case must not end in a blank', error)
      inquire (file=file, exist=exists)
      call require(exists, file//': no such file', error)
      call require(logical(is_regular(file)), file//': a directory, device or pipe, where a case belongs; ' &
         & //'tiltpad-collect makes a study of a folder of results', error)
      if (allocated(error)) return
      open (newunit=unit, file=file, access='stream', form='unformatted', action='read', status='old', &
         & iostat=status, iomsg=message)
      if (status == 0) then
         inquire (unit=unit, size=length)
         if (starts_as_result(unit, length)) then
            call raise(error, input_error, file//': a result or study (an HDF5 file), where a case belongs; ' &
               & //'tiltpad-plot draws it, tiltpad --resume '//file//' continues a result')
         else if (length > longest_file) then
            call raise(error, input_error, file//': '//to_text(length)//' bytes; an input file has at most ' &
               & //to_text(longest_file))
         else
            allocate (character(len=max(length, 0_i8)) :: text)
            if (length > 0) read (unit, pos=1, iostat=status, iomsg=message) text
         end if
         close (unit)
      end if
      if (status /= 0) call raise(error, input_error, file//': cannot be read: '//trim(message))
   end subroutine read_text

   !> True for an HDF5 file, by its first bytes.
   logical function starts_as_result(unit, length)
      integer, intent(in) :: unit
      integer(i8), intent(in) :: length
      character(len=*), parameter :: signature = char(137)//'HDF'
      character(len=len(signature)) :: first
      integer :: status
      starts_as_result = .false.
      if (length < len(signature)) return
      read (unit, pos=1, iostat=status) first
      if (status == 0) starts_as_result = first == signature
   end function starts_as_result

   !> The assignments of a case's text, with the overrides ("group%name=value"); `file` is for messages.
   subroutine parse_case(text, file, overrides, parsed, error)
      character(len=*), intent(in) :: text, file, overrides(:)
      type(namelist_type), intent(out) :: parsed
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      call parse_namelist(text, file, parsed, error)
      do i = 1, size(overrides)
         if (.not. allocated(error)) call parse_override(trim(overrides(i)), parsed, error)
      end do
   end subroutine parse_case
end module case_text
