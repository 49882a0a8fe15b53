!> A case file, read and split into assignments.
module case_text
   use errors, only: error_type
   use assignments, only: namelist_type
   use namelist_text, only: parse_namelist, parse_override
   use input_file, only: read_input
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
      call read_input(file, 'case', longest_file, '; tiltpad-collect makes a study of a folder of results', &
         & '; tiltpad-plot draws it, tiltpad --resume '//file//' continues a result', text, error)
   end subroutine read_text

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
