!> A list of texts of any length, UTF-8; empty where nothing was written. After a failure, which the file keeps, every
!> routine does nothing.
module hdf5_texts
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_loc, c_null_char, c_null_ptr, c_ptr
   use hdf5, only: hid_t, hsize_t, h5screate_simple_f, h5sclose_f, h5dcreate_f, h5dwrite_f, &
      & h5dread_f, h5dclose_f, h5dget_type_f, h5pcreate_f, h5pclose_f, h5pset_chunk_f, &
      & h5p_dataset_create_f, h5tclose_f
   use hdf5_base, only: is_of_texts, kind_of_texts, c_free
   use kinds, only: i8
   use packet, only: text_type
   use hdf5_file, only: hdf5_type, opened_type
   use hdf5_rows, only: rows_a_chunk, small_transfers, select_part, max_dimensions
   use system_texts, only: fortran_text
   implicit none (type, external)
   private
   public :: hdf5_texts_type

   type :: hdf5_texts_type
      integer(hid_t) :: id = -1
      integer :: length = 0
   contains
      procedure :: create
      procedure :: open => open_texts
      procedure :: close => close_texts
      procedure :: write => write_texts
      procedure :: read => read_texts
   end type hdf5_texts_type

contains

   subroutine create(self, file, name, length)
      class(hdf5_texts_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer, intent(in) :: length
      integer(hid_t) :: space, properties, kind
      integer :: status
      if (allocated(file%failure)) return
      self%length = length
      kind = kind_of_texts()
      call h5screate_simple_f(1, int([length], hsize_t), space, status, max_dimensions(int([length], hsize_t)))
      call h5pcreate_f(h5p_dataset_create_f, properties, status)
      call h5pset_chunk_f(properties, 1, int([rows_a_chunk(length, 1)], hsize_t), status)
      call file%make_group(name(:index(name, '/', back=.true.) - 1))
      call h5dcreate_f(file%id, name, kind, space, self%id, status, properties)
      call file%check(status, 'create '//name)
      if (status < 0) self%id = -1
      call h5pclose_f(properties, status)
      call h5sclose_f(space, status)
      call h5tclose_f(kind, status)
   end subroutine create

   !> An existing list; a failure for what is none.
   subroutine open_texts(self, file, name)
      class(hdf5_texts_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      type(opened_type) :: found
      call file%open_dataset(name, found)
      self%id = found%id
      if (self%id < 0) return
      if (.not. are_texts(self%id)) call file%check_read(-1, 'find texts in '//name)
      if (size(found%extents) /= 1 .or. any(found%extents > huge(1))) call file%check_read(-1, &
         & 'read the size of '//name)
      if (allocated(file%failure)) then
         call self%close(file)
      else
         self%length = int(found%extents(1))
      end if
   end subroutine open_texts

   !> Whether a dataset has texts of any length.
   logical function are_texts(dataset)
      integer(hid_t), intent(in) :: dataset
      integer(hid_t) :: kind
      integer :: status
      are_texts = .false.
      call h5dget_type_f(dataset, kind, status)
      if (status < 0) return
      are_texts = is_of_texts(kind)
      call h5tclose_f(kind, status)
   end function are_texts

   !> Writes texts from the `first` on.
   subroutine write_texts(self, file, first, texts)
      class(hdf5_texts_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: first
      type(text_type), intent(in) :: texts(:)
      character(kind=c_char, len=:), allocatable, target :: bytes
      type(c_ptr), target :: pointers(size(texts))
      integer :: starts(size(texts) + 1), i, status
      integer(hid_t) :: memory, space, kind, transfer
      if (allocated(file%failure) .or. size(texts) == 0) return
      starts(1) = 1
      do i = 1, size(texts)
         starts(i + 1) = starts(i) + len(texts(i)%text) + 1
      end do
      allocate (character(kind=c_char, len=starts(size(starts)) - 1) :: bytes)
      do i = 1, size(texts)
         bytes(starts(i):starts(i + 1) - 1) = texts(i)%text//c_null_char
         pointers(i) = c_loc(bytes(starts(i):starts(i)))
      end do
      kind = kind_of_texts()
      transfer = small_transfers()
      call select_part(self%id, first - 1_i8, [size(texts, kind=hsize_t)], memory, space, status)
      if (status >= 0) call h5dwrite_f(self%id, kind, c_loc(pointers), status, memory, space, transfer)
      call file%check(status, 'write texts')
      call h5sclose_f(space, status)
      call h5sclose_f(memory, status)
      call h5pclose_f(transfer, status)
      call h5tclose_f(kind, status)
   end subroutine write_texts

   !> Reads n texts from the `first` on.
   subroutine read_texts(self, file, first, n, texts)
      class(hdf5_texts_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: first, n
      type(text_type), allocatable, intent(out) :: texts(:)
      type(c_ptr), allocatable, target :: pointers(:)
      type(c_ptr) :: buffer
      integer :: i, status
      integer(hid_t) :: memory, space, kind, transfer
      allocate (texts(n), pointers(n))
      texts = text_type('')
      if (allocated(file%failure) .or. n == 0) return
      pointers = c_null_ptr
      buffer = c_loc(pointers)
      kind = kind_of_texts()
      transfer = small_transfers()
      call select_part(self%id, first - 1_i8, [int(n, hsize_t)], memory, space, status)
      if (status >= 0) call h5dread_f(self%id, kind, buffer, status, memory, space, transfer)
      call file%check_read(status, 'read texts')
      do i = 1, n
         if (.not. c_associated(pointers(i))) cycle
         texts(i)%text = fortran_text(pointers(i))
         call c_free(pointers(i))
      end do
      call h5sclose_f(space, status)
      call h5sclose_f(memory, status)
      call h5pclose_f(transfer, status)
      call h5tclose_f(kind, status)
   end subroutine read_texts

   subroutine close_texts(self, file)
      class(hdf5_texts_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer :: status
      if (self%id < 0) return
      call h5dclose_f(self%id, status)
      call file%check(status, 'close a list of texts')
      self%id = -1
   end subroutine close_texts
end module hdf5_texts
