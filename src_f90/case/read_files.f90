!> What a case has read from files that its input names, as checksums of the numbers: whether they have changed since.
module read_files
   use kinds, only: wp, i8
   use text, only: to_text, checksum
   use case_inputs, only: case_type
   implicit none (type, external)
   private
   public :: file_marks, changed_file, marks_name

   !> What the list of marks is called in a result.
   character(len=*), parameter :: marks_name = 'file_marks'
   character(len=*), parameter :: newline = achar(10)

contains

   !> A line for each file that was read: the variable that names it, and the checksum of its numbers. Empty where none
   !> was.
   pure function file_marks(inputs) result(lines)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: lines
      integer :: i
      lines = ''
      do i = 1, size(inputs%bearings)
         associate (own => inputs%bearings(i))
            if (allocated(own%pivot%points)) lines = lines//line('pivot'//own%suffix()//'%file', &
               & mark([own%pivot%points], 0_i8))
         end associate
      end do
      if (.not. inputs%rotor%is_rigid()) then
         if (allocated(inputs%rotor%elastic%given)) then
            associate (g => inputs%rotor%elastic%given)
               lines = lines//line('rotor%file', mark([g%total_mass, g%weighed], mark([g%mass], mark([g%damping], &
                  & mark([g%gyroscopic], mark([g%stiffness], mark([g%station], mark([g%slope], 0_i8))))))))
            end associate
         end if
      end if
      if (.not. allocated(inputs%excitations)) return
      do i = 1, size(inputs%excitations)
         associate (x => inputs%excitations(i))
            if (.not. allocated(x%table)) cycle
            lines = lines//line('excitation('//to_text(i)//')%file', mark(x%time, mark([x%table], 0_i8)))
         end associate
      end do
   end function file_marks

   pure function line(variable, number)
      character(len=*), intent(in) :: variable
      integer(i8), intent(in) :: number
      character(len=:), allocatable :: line
      line = variable//' '//to_text(number)//newline
   end function line

   !> Checksum of numbers, to the last bit, behind that of others.
   pure integer(i8) function mark(numbers, before)
      real(wp), intent(in) :: numbers(:)
      integer(i8), intent(in) :: before
      integer :: i
      mark = before
      do i = 1, size(numbers)
         mark = checksum(transfer(numbers(i), repeat(' ', storage_size(numbers)/8)), mark)
      end do
   end function mark

   !> The variable that names a file whose numbers are others than they were, by both lists of marks; empty where there
   !> is none. What either list lacks was not read.
   pure function changed_file(marks, before) result(variable)
      character(len=*), intent(in) :: marks, before
      character(len=:), allocatable :: variable
      integer :: first, last
      first = 1
      do while (first <= len(marks))
         last = first + index(marks(first:), newline) - 1
         associate (own => marks(first:last))
            variable = own(:index(own, ' '))
            if (index(newline//before, newline//variable) > 0 .and. index(newline//before, newline//own) == 0) then
               variable = trim(variable)
               return
            end if
         end associate
         first = last + 1
      end do
      variable = ''
   end function changed_file
end module read_files
