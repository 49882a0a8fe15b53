!> An HDF5 file with datasets and dimension scales. After a failure every routine does nothing; `failure` says what
!> failed first. Datasets whose values lie in other files are refused, and those whose chunks claim too much memory.
module hdf5_file
   use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_null_char, c_ptr
   use hdf5, only: hid_t, hsize_t, size_t, h5screate_f, h5screate_simple_f, h5sclose_f, h5s_scalar_f, h5s_unlimited_f, &
      & h5sget_simple_extent_dims_f, h5sget_simple_extent_ndims_f, h5tclose_f, h5tcopy_f, h5tequal_f, &
      & h5tget_class_f, h5tget_size_f, h5tset_size_f, h5tset_strpad_f, h5t_fortran_s1, h5t_str_nullpad_f, &
      & h5dcreate_f, h5dopen_f, h5dwrite_f, h5dread_f, h5dclose_f, h5dget_space_f, h5dget_type_f, &
      & h5dget_create_plist_f, h5pget_layout_f, h5pget_chunk_f, h5pget_external_count_f, h5pclose_f, h5d_virtual_f, &
      & h5d_chunked_f, h5p_default_f, h5t_native_double, h5kind_to_type, h5_integer_kind
   use h5ds, only: h5dsset_scale_f, h5dsattach_scale_f
   use kinds, only: wp, i8
   use hdf5_base, only: hdf5_base_type
   use record, only: dataset_type, of_counts, of_texts, lines
   implicit none (type, external)
   private
   public :: hdf5_type, opened_type, is_of_kind, scale_name, scale_count

   !> Most bytes of a chunk (ours have 32 kB a value of a sample), and most dimensions of a dataset.
   real(wp), parameter :: largest_chunk = 2.0_wp**26
   integer, parameter :: most_dimensions = 32

   !> A scale that is open, and its name.
   type :: open_scale_type
      integer(hid_t) :: id = -1
      character(len=:), allocatable :: name
   end type open_scale_type

   type, extends(hdf5_base_type) :: hdf5_type
      !> The scales of each dimension that were attached last: opening one takes as long as attaching it.
      type(open_scale_type), private :: scales(2)
   contains
      procedure :: close => close_with_scales
      procedure :: delete
      !> Writes a dataset as a record has it; one of the name and size is overwritten. Its scales are named slowest
      !> dimension first, as h5py shows them, separated by blanks; a dataset whose only scale is itself becomes that
      !> scale.
      procedure :: put
      !> Numbers by path.
      procedure :: get_real
      procedure :: get_list
      !> For modules that build on it: opens a dataset; describes one.
      procedure :: open_dataset
      procedure :: describe
   end type hdf5_type

   !> A dataset that is open.
   type :: opened_type
      integer(hid_t) :: id = -1
      !> HDF5's number of the class of its values, and bytes of a value.
      integer :: class = -1
      integer(size_t) :: bytes = 0
      !> Its size in each dimension, the fastest first, and whether it may become longer.
      integer(hsize_t), allocatable :: extents(:)
      logical :: grows = .false.
   end type opened_type

   !> Numbers in a list; only a damaged file says more.
   integer(hsize_t), parameter :: largest_list = 100000000

contains

   subroutine put(self, own)
      class(hdf5_type), intent(inout) :: self
      type(dataset_type), intent(in), target :: own
      integer(i8), target :: counts(size(own%values))
      character(kind=c_char, len=:), allocatable, target :: letters
      character(len=:), allocatable :: labels(:)
      integer(hid_t) :: kind
      integer :: status, i
      select case (own%kind)
      case (of_texts)
         ! all of one length in the file, filled up with zero bytes
         labels = lines(own%texts)
         allocate (character(kind=c_char, len=len(labels)*size(labels)) :: letters)
         do i = 1, size(labels)
            letters((i - 1)*len(labels) + 1:i*len(labels)) = trim(labels(i)) &
               & //repeat(c_null_char, len(labels) - len_trim(labels(i)))
         end do
         call h5tcopy_f(h5t_fortran_s1, kind, status)
         call h5tset_size_f(kind, len(labels, size_t), status)
         call h5tset_strpad_f(kind, h5t_str_nullpad_f, status)
         call write_all(self, own, kind, c_loc(letters))
         call h5tclose_f(kind, status)
      case (of_counts)
         counts = nint(own%values, i8)
         call write_all(self, own, h5kind_to_type(i8, h5_integer_kind), c_loc(counts))
      case default
         call write_all(self, own, h5t_native_double, c_loc(own%values))
      end select
   end subroutine put

   !> Opens a dataset whose values are in this file, in chunks of a size that HDF5 may take memory for; a failure, and
   !> a negative number, where there is none.
   subroutine open_dataset(self, path, found, access)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(opened_type), intent(out) :: found
      !> How it is accessed, HDF5's list of properties.
      integer(hid_t), intent(in), optional :: access
      integer(hid_t) :: creation, chosen
      integer :: layout, files, status, ignored
      allocate (found%extents(0))
      if (allocated(self%failure)) return
      chosen = h5p_default_f
      if (present(access)) chosen = access
      call h5dopen_f(self%id, path, found%id, status, chosen)
      call self%check_read(status, 'open '//path)
      if (status >= 0) then
         call h5dget_create_plist_f(found%id, creation, status)
         call h5pget_layout_f(creation, layout, status)
         if (status >= 0) call h5pget_external_count_f(creation, files, status)
         if (status >= 0 .and. (layout == h5d_virtual_f .or. files > 0)) status = -1
         call self%check_read(status, 'take the values of '//path//', which are in other files')
         ! even the size is looked for in other files, and opening a pipe would wait
         if (status >= 0) call measure(found, status)
         call self%check_read(status, 'read the size of '//path)
         if (status >= 0 .and. layout == h5d_chunked_f) then
            if (chunk_bytes(found, creation) > largest_chunk) status = -1
            call self%check_read(status, 'take memory for the chunks of '//path)
         end if
         call h5pclose_f(creation, ignored)
         if (allocated(self%failure)) call h5dclose_f(found%id, ignored)
      end if
      if (allocated(self%failure)) found%id = -1
   end subroutine open_dataset

   !> What the values of an open dataset are, and how many.
   subroutine measure(found, status)
      type(opened_type), intent(inout) :: found
      integer, intent(out) :: status
      integer(hsize_t) :: dims(most_dimensions), most(most_dimensions)
      integer(hid_t) :: kind, space
      integer :: rank, ignored
      call h5dget_type_f(found%id, kind, status)
      if (status < 0) return
      call h5tget_class_f(kind, found%class, status)
      call h5tget_size_f(kind, found%bytes, ignored)
      call h5tclose_f(kind, ignored)
      call h5dget_space_f(found%id, space, status)
      call h5sget_simple_extent_ndims_f(space, rank, status)
      if (rank > most_dimensions) status = -1
      if (status >= 0 .and. rank > 0) then
         call h5sget_simple_extent_dims_f(space, dims(:rank), most(:rank), status)
         found%extents = dims(:rank)
         found%grows = any(most(:rank) == h5s_unlimited_f)
      end if
      call h5sclose_f(space, ignored)
   end subroutine measure

   !> Bytes of a chunk of a dataset, by its properties; very many where it does not say.
   real(wp) function chunk_bytes(found, creation) result(bytes)
      type(opened_type), intent(in) :: found
      integer(hid_t), intent(in) :: creation
      integer(hsize_t) :: chunk(most_dimensions)
      integer :: status
      bytes = huge(bytes)
      call h5pget_chunk_f(creation, size(found%extents), chunk, status)
      if (status == size(found%extents) .and. status > 0) bytes = product(real(chunk(:status), wp))*found%bytes
   end function chunk_bytes

   !> Whether the numbers of a dataset are stored as in memory: HDF5 would convert the rubbish in a damaged file.
   logical function is_of_kind(dataset, kind) result(is)
      integer(hid_t), intent(in) :: dataset, kind
      integer(hid_t) :: found
      integer :: status
      is = .false.
      call h5dget_type_f(dataset, found, status)
      if (status < 0) return
      call h5tequal_f(found, kind, is, status)
      call h5tclose_f(found, status)
   end function is_of_kind

   !> Writes all of a dataset, and makes it where it is not there. One that is there must be the same: a damaged type
   !> may claim numbers of any size.
   subroutine write_all(self, own, kind, buffer)
      class(hdf5_type), intent(inout) :: self
      type(dataset_type), intent(in) :: own
      integer(hid_t), intent(in) :: kind
      type(c_ptr), intent(in) :: buffer
      type(opened_type) :: found
      integer(hid_t) :: dataset, space
      integer :: status
      if (allocated(self%failure)) return
      if (self%has(own%path)) then
         call self%open_dataset(own%path, found)
         dataset = found%id
         if (.not. is_of_kind(dataset, kind)) call self%check_read(-1, 'find numbers of the right kind in '//own%path)
         if (product(found%extents) /= product(own%extents)) call self%check_read(-1, &
            & 'find the right size of '//own%path)
      else
         if (size(own%extents) == 0) then
            call h5screate_f(h5s_scalar_f, space, status)
         else
            call h5screate_simple_f(size(own%extents), int(own%extents, hsize_t), space, status)
         end if
         call h5dcreate_f(self%id, own%path, kind, space, dataset, status)
         call self%check(status, 'create '//own%path)
         call self%describe(dataset, own%units, own%long_name, own%scales, own%path)
         call h5sclose_f(space, status)
      end if
      if (.not. allocated(self%failure)) call h5dwrite_f(dataset, kind, buffer, status)
      if (.not. allocated(self%failure)) call self%check(status, 'write '//own%path)
      call h5dclose_f(dataset, status)
      ! some of it is written only now
      call self%check(status, 'write '//own%path)
   end subroutine write_all

   !> A number; 0, and a failure, where there is none.
   real(wp) function get_real(self, path)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      real(wp), allocatable :: values(:)
      get_real = 0
      call self%get_list(path, values)
      if (size(values) /= 1) call self%check_read(-1, 'find the right size of '//path)
      if (.not. allocated(self%failure)) get_real = values(1)
   end function get_real

   !> All numbers of a dataset; none, and a failure, where it is not there or has other ones.
   subroutine get_list(self, path, values)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      real(wp), allocatable, target, intent(out) :: values(:)
      type(opened_type) :: found
      type(c_ptr) :: buffer
      integer :: status
      if (.not. self%has(path)) call self%check_read(-1, 'find '//path)
      call self%open_dataset(path, found)
      if (found%id >= 0) then
         if (product(real(found%extents, wp)) > largest_list) call self%check_read(-1, 'find the size of '//path)
         if (.not. is_of_kind(found%id, h5t_native_double)) call self%check_read(-1, &
            & 'find numbers of the right kind in '//path)
         if (.not. allocated(self%failure)) then
            allocate (values(int(product(found%extents))), source=0.0_wp)
            buffer = c_loc(values)
            call h5dread_f(found%id, h5t_native_double, buffer, status)
            call self%check_read(status, 'read '//path)
         end if
         call h5dclose_f(found%id, status)
      end if
      if (allocated(self%failure)) values = [real(wp) ::]
   end subroutine get_list

   !> Units, long name and dimension scales of a dataset.
   subroutine describe(self, dataset, units, long_name, scales, path)
      class(hdf5_type), intent(inout) :: self
      integer(hid_t), intent(in) :: dataset
      character(len=*), intent(in) :: units, long_name, scales, path
      integer :: status, k
      if (allocated(self%failure)) return
      call self%write_attribute(dataset, 'units', units)
      call self%write_attribute(dataset, 'long_name', long_name)
      if (scales == path) then
         call h5dsset_scale_f(dataset, status, path(index(path, '/', back=.true.) + 1:))
         call self%check(status, 'make '//path//' a scale')
         return
      end if
      do k = 1, scale_count(scales)
         associate (scale => self%scales(min(k, size(self%scales))))
            call open_scale(self%id, scale_name(scales, k), scale)
            call h5dsattach_scale_f(dataset, scale%id, k, status)
         end associate
         call self%check(status, 'attach '//scale_name(scales, k)//' to '//path)
      end do
   end subroutine describe

   !> Opens the scale of this name in a file, unless it is the one that is open.
   subroutine open_scale(file, name, scale)
      integer(hid_t), intent(in) :: file
      character(len=*), intent(in) :: name
      type(open_scale_type), intent(inout) :: scale
      integer :: status
      if (scale%id >= 0) then
         if (scale%name == name) return
         call h5dclose_f(scale%id, status)
      end if
      call h5dopen_f(file, name, scale%id, status)
      if (status < 0) scale%id = -1
      scale%name = name
   end subroutine open_scale

   subroutine close_scales(self)
      class(hdf5_type), intent(inout) :: self
      integer :: k, status
      do k = 1, size(self%scales)
         if (self%scales(k)%id >= 0) call h5dclose_f(self%scales(k)%id, status)
         self%scales(k)%id = -1
      end do
   end subroutine close_scales

   !> HDF5 closes no file with open scales.
   subroutine close_with_scales(self)
      class(hdf5_type), intent(inout) :: self
      call close_scales(self)
      call self%hdf5_base_type%close()
   end subroutine close_with_scales

   !> A scale may be among what is deleted.
   subroutine delete(self, path)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      call close_scales(self)
      call self%hdf5_base_type%delete(path)
   end subroutine delete

   !> The k-th of scales whose names are separated by blanks; empty where there are fewer.
   pure function scale_name(names, k) result(name)
      character(len=*), intent(in) :: names
      integer, intent(in) :: k
      character(len=:), allocatable :: name
      integer :: first, i
      first = 1
      do i = 2, k
         first = min(first + index(names(first:)//' ', ' '), len(names) + 1)
      end do
      name = names(first:)
      name = name(:index(name//' ', ' ') - 1)
   end function scale_name

   pure integer function scale_count(names) result(number)
      character(len=*), intent(in) :: names
      number = 0
      do while (scale_name(names, number + 1) /= '')
         number = number + 1
      end do
   end function scale_count
end module hdf5_file
