!> A record for another process, in two parts: what its datasets are, which seldom changes, and their numbers.
module record_message
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_value, ieee_quiet_nan
   use kinds, only: wp
   use text, only: to_text
   use record, only: record_type, dataset_type, of_texts
   implicit none (type, external)
   private
   public :: description, take_description, numbers, take_numbers

   character(len=*), parameter :: tab = achar(9)

contains

   !> What all datasets are, those too that this run has not: kind, sizes, path, units, meaning, scales and texts of
   !> each.
   function description(self) result(text)
      type(record_type), intent(in) :: self
      character(len=:), allocatable :: text
      integer :: k, i
      text = ''
      do k = 1, self%count
         associate (own => self%datasets(k))
            text = text//to_text(own%kind)//tab//to_text(size(own%extents))//tab
            do i = 1, size(own%extents)
               text = text//to_text(own%extents(i))//tab
            end do
            text = text//own%path//tab//own%units//tab//own%long_name//tab//own%scales//tab//own%texts//tab
         end associate
      end do
   end function description

   !> Becomes a record with the datasets of a description.
   subroutine take_description(self, text)
      type(record_type), intent(inout) :: self
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: path, units, long_name, scales, texts
      integer, allocatable :: extents(:)
      integer :: at, kind, i
      self%count = 0
      self%version = self%version + 1
      at = 1
      do while (at <= len(text))
         kind = whole(word())
         allocate (extents(whole(word())))
         do i = 1, size(extents)
            extents(i) = whole(word())
         end do
         path = word()
         units = word()
         long_name = word()
         scales = word()
         texts = word()
         call self%put_dataset(path, kind, spread(0.0_wp, 1, merge(0, product(extents), kind == of_texts)), extents, &
            & units, long_name, scales, texts)
         deallocate (extents)
      end do
   contains
      !> What stands before the next tab.
      function word()
         character(len=:), allocatable :: word
         integer :: length
         length = index(text(at:), tab) - 1
         word = text(at:at + length - 1)
         at = at + length + 1
      end function word

      integer function whole(digits)
         character(len=*), intent(in) :: digits
         read (digits, *) whole
      end function whole
   end subroutine take_description

   !> The numbers of all datasets; not a number where the run has none. Of texts, one: whether the run has them.
   function numbers(self) result(values)
      type(record_type), intent(in) :: self
      real(wp), allocatable :: values(:)
      integer :: k, n
      allocate (values(sum([(length(self%datasets(k)), k=1, self%count)])))
      n = 0
      do k = 1, self%count
         associate (own => self%datasets(k))
            if (.not. own%there) then
               values(n + 1:n + length(own)) = ieee_value(1.0_wp, ieee_quiet_nan)
            else if (own%kind == of_texts) then
               values(n + 1) = 1
            else
               values(n + 1:n + length(own)) = own%values
            end if
            n = n + length(own)
         end associate
      end do
   end function numbers

   !> How many numbers of a message are of this dataset.
   pure integer function length(dataset)
      type(dataset_type), intent(in) :: dataset
      length = merge(1, size(dataset%values), dataset%kind == of_texts)
   end function length

   !> Takes the numbers of a record with the same datasets.
   subroutine take_numbers(self, values)
      type(record_type), intent(inout) :: self
      real(wp), intent(in) :: values(:)
      integer :: k, n
      n = 0
      do k = 1, self%count
         associate (own => self%datasets(k))
            own%there = .true.
            if (own%kind == of_texts) then
               own%there = .not. ieee_is_nan(values(n + 1))
            else
               own%values = values(n + 1:n + length(own))
            end if
            n = n + length(own)
         end associate
      end do
   end subroutine take_numbers
end module record_message
