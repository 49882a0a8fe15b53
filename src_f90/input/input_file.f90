!> Reads the text of an input file whole, and tells what is no text.
module input_file
   use kinds, only: i8
   use text, only: to_text, newline
   use errors, only: error_type, raise, require, input_error, system_error
   use files, only: is_regular
   implicit none (type, external)
   private
   public :: read_input, require_text, control_character, tab, carriage

   character(len=*), parameter :: tab = achar(9), carriage = achar(13)

contains

   !> The text of a file. `what` it should be, "case", and hints for a folder and for a result in its place are for
   !> messages.
   subroutine read_input(file, what, longest, folder_hint, result_hint, text, error)
      character(len=*), intent(in) :: file, what, folder_hint, result_hint
      !> Most bytes.
      integer, intent(in) :: longest
      character(len=:), allocatable, intent(out) :: text
      type(error_type), allocatable, intent(out) :: error
      character(len=200) :: message
      logical :: exists
      integer :: unit, status
      integer(i8) :: length
      ! Fortran leaves blanks at the end of a name away
      call require(len_trim(file) == len(file), file//': the name of a '//what//' must not end in a blank', error)
      inquire (file=file, exist=exists)
      call require(exists, file//': no such file', error)
      call require(logical(is_regular(file)), file//': a directory, device or pipe, where a '//what//' belongs' &
         & //folder_hint, error)
      if (allocated(error)) return
      open (newunit=unit, file=file, access='stream', form='unformatted', action='read', status='old', &
         & iostat=status, iomsg=message)
      if (status == 0) then
         inquire (unit=unit, size=length)
         if (length < 0) then
            status = -1
            message = 'the system does not tell its size'
         else if (starts_as_result(unit, length)) then
            call raise(error, input_error, file//': a result or study (an HDF5 file), where a '//what//' belongs' &
               & //result_hint)
         else if (length > longest) then
            call raise(error, input_error, file//': '//to_text(length)//' bytes; a '//what//' has at most ' &
               & //to_text(longest))
         else
            allocate (character(len=length) :: text)
            if (length > 0) read (unit, pos=1, iostat=status, iomsg=message) text
         end if
         close (unit)
      end if
      if (status /= 0) call raise(error, system_error, file//': cannot be read: '//trim(message))
   end subroutine read_input

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

   !> Refuses text with a control character.
   pure subroutine require_text(text, file, error)
      character(len=*), intent(in) :: text, file
      type(error_type), allocatable, intent(inout) :: error
      integer :: at
      at = control_character(text)
      if (at > 0) call raise(error, input_error, file//': not a text file (byte '//to_text(at)//' is a control ' &
         & //'character)')
   end subroutine require_text

   !> Position of the first character that is no text; 0 if there is none. A carriage return that ends no line is such a
   !> character: it would neither end a comment nor count as a line.
   pure integer function control_character(text) result(at)
      character(len=*), intent(in) :: text
      character :: c
      do at = 1, len(text)
         c = text(at:at)
         if (c == carriage .and. at < len(text)) then
            if (text(at + 1:at + 1) /= newline) return
         else if (c == achar(127) .or. c < ' ' .and. c /= newline .and. c /= tab) then
            return
         end if
      end do
      at = 0
   end function control_character
end module input_file
