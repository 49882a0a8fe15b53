!> Errors as data: a library routine returns one, only the program stops. And the question whether a search is to stop.
!>
!> A routine that can fail has `type(error_type), allocatable, intent(out) :: error`;
!> the caller tests `allocated(error)` and may put context in front of the message.
module errors
   use kinds, only: wp
   use text, only: filled
   implicit none (type, external)
   private
   public :: error_type, raise, require, refuse, add_context, asked_to_stop, asked
   public :: input_error, numerics_error, system_error, stopped

   !> What is wrong, and the exit status that belongs to it.
   type :: error_type
      integer :: status = 0
      character(len=:), allocatable :: message
   end type error_type

   !> Exit statuses: usage or input; the numerics failed; file or system; stopped by a signal.
   integer, parameter :: input_error = 1, numerics_error = 2, system_error = 3, stopped = 4

   !> Keeps the first requirement that an input does not meet.
   interface require
      module procedure require_text, require_numbers
   end interface require

   abstract interface
      !> True once a search is to be given up; it then returns an error of status `stopped`.
      logical function asked_to_stop()
      end function asked_to_stop
   end interface

contains

   !> Sets an error.
   pure subroutine raise(error, status, message)
      type(error_type), allocatable, intent(out) :: error
      integer, intent(in) :: status
      character(len=*), intent(in) :: message
      error = error_type(status, message)
   end subroutine raise

   pure subroutine require_text(met, message, error)
      logical, intent(in) :: met
      character(len=*), intent(in) :: message
      type(error_type), allocatable, intent(inout) :: error
      if (.not. met) call refuse(message, error)
   end subroutine require_text

   !> The same with numbers in the places of a template (text, filled).
   pure subroutine require_numbers(met, template, numbers, error)
      logical, intent(in) :: met
      character(len=*), intent(in) :: template
      real(wp), intent(in) :: numbers(:)
      type(error_type), allocatable, intent(inout) :: error
      if (.not. met) call refuse(filled(template, numbers), error)
   end subroutine require_numbers

   !> The same of one that is not met. A study checks very many cases: what takes longer to write than to check is
   !> written only `if (...) call refuse(...)`.
   pure subroutine refuse(message, error)
      character(len=*), intent(in) :: message
      type(error_type), allocatable, intent(inout) :: error
      if (.not. allocated(error)) call raise(error, input_error, message)
   end subroutine refuse

   !> Puts "context: " in front of the message of a set error; does nothing to an unset one.
   pure subroutine add_context(error, context)
      type(error_type), allocatable, intent(inout) :: error
      character(len=*), intent(in) :: context
      if (allocated(error) .and. context /= '') error%message = context//': '//error%message
   end subroutine add_context

   !> The answer, where somebody is there to ask.
   logical function asked(give_up)
      procedure(asked_to_stop), pointer, intent(in) :: give_up
      asked = associated(give_up)
      if (asked) asked = give_up()
   end function asked
end module errors
