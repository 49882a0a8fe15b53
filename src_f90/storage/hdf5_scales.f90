!> Which dimension scales datasets have, and what a file contains.
module hdf5_scales
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_funloc, c_funptr, c_int, c_int64_t, c_loc, c_null_ptr, c_ptr
   use hdf5, only: hid_t, hsize_t, size_t, h5dopen_f, h5dclose_f, h5aexists_f, h5t_string_f, h5gn_members_f, &
      & h5lget_name_by_idx_f, h5_index_name_f, h5_iter_native_f, h5oget_info_by_name_f, h5o_info_t, h5o_type_group_f, &
      & h5o_type_dataset_f
   use h5ds, only: h5dsis_scale_f, h5dsget_scale_name_f
   use hdf5_file, only: hdf5_type, opened_type, scale_name, scale_count
   implicit none (type, external)
   private
   public :: item_type, list_items, scales_of, read_about, scale_name, scale_count, member_type, list_members

   !> Only a damaged file has longer names, more members in a group, or groups in groups of groups.
   integer, parameter :: longest_name = 200, most_members = 2000, deepest = 4

   !> A dataset, a group, or, where it is neither, a link that leads nowhere or a type.
   type :: member_type
      character(len=longest_name) :: name = ''
      logical :: is_group = .false., is_dataset = .false.
   end type member_type

   !> A dataset or group of a file.
   type :: item_type
      character(len=:), allocatable :: path
      logical :: is_group = .false., is_dataset = .false., is_scale = .false.
      !> Of a dataset: whether it has texts, its sizes, the fastest first, and whether it may become longer.
      logical :: of_texts = .false.
      integer(hsize_t), allocatable :: extents(:)
      logical :: grows = .false.
   end type item_type

   !> The name of a scale that was found, and whether it could be read.
   type :: visit_type
      character(len=longest_name) :: name = ''
      integer :: status = 0
   end type visit_type

   interface
      !> Calls a function with each scale of a dimension, from 0, until it gives another number than 0.
      integer(c_int) function iterate_scales(dataset, dimension, first, visitor, visit) &
         & bind(c, name='H5DSiterate_scales')
         import :: c_funptr, c_int, c_int64_t, c_ptr
         integer(c_int64_t), value :: dataset
         integer(c_int), value :: dimension
         type(c_ptr), value :: first, visit
         type(c_funptr), value :: visitor
      end function iterate_scales
   end interface

contains

   !> The groups of a file, and its datasets, those in the groups too.
   subroutine list_items(file, found)
      class(hdf5_type), intent(inout) :: file
      type(item_type), allocatable, intent(out) :: found(:)
      type(item_type), allocatable :: inner(:), more(:)
      integer :: i
      call list_group(file, '/', found)
      i = 1
      do while (i <= size(found))
         if (found(i)%is_group .and. depth(found(i)%path) < deepest) then
            call list_group(file, found(i)%path, inner)
            allocate (more(size(found) + size(inner)))
            more(:size(found)) = found
            more(size(found) + 1:) = inner
            call move_alloc(more, found)
         end if
         i = i + 1
      end do
   end subroutine list_items

   !> How many groups a path goes through, its own name with them.
   pure integer function depth(path)
      character(len=*), intent(in) :: path
      integer :: i
      depth = 1
      do i = 1, len(path)
         if (path(i:i) == '/') depth = depth + 1
      end do
   end function depth

   !> The datasets and groups of a group.
   subroutine list_group(file, group, found)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: group
      type(item_type), allocatable, intent(out) :: found(:)
      type(member_type), allocatable :: members(:)
      integer :: i, status
      allocate (members(0))
      if (.not. allocated(file%failure)) then
         call list_members(file%id, group, members, status)
         call file%check_read(status, 'list the datasets of '//group)
      end if
      allocate (found(size(members)))
      do i = 1, size(members)
         allocate (found(i)%extents(0))
         found(i)%path = trim(members(i)%name)
         if (group /= '/') found(i)%path = group//'/'//found(i)%path
         found(i)%is_group = members(i)%is_group
         found(i)%is_dataset = members(i)%is_dataset
         if (found(i)%is_dataset) call measure(file, found(i))
      end do
   end subroutine list_group

   !> Size of a dataset, and whether it is a scale.
   subroutine measure(file, item)
      class(hdf5_type), intent(inout) :: file
      type(item_type), intent(inout) :: item
      type(opened_type) :: found
      integer :: ignored
      logical :: there
      call file%open_dataset(item%path, found)
      if (found%id < 0) return
      item%extents = found%extents
      item%grows = found%grows
      item%of_texts = found%class == h5t_string_f
      ! asking for it is an error for a dataset without any
      call h5aexists_f(found%id, 'CLASS', there, ignored)
      if (there) call h5dsis_scale_f(found%id, item%is_scale, ignored)
      call h5dclose_f(found%id, ignored)
   end subroutine measure

   !> The scales of a dataset as hdf5_file names them: slowest dimension first, separated by blanks; its own path for a
   !> scale, and empty for a single number and where a dimension has no scale.
   function scales_of(file, item, all) result(names)
      class(hdf5_type), intent(inout) :: file
      !> The dataset, and all items of the file.
      type(item_type), intent(in) :: item, all(:)
      character(len=:), allocatable :: names, name
      integer(hid_t) :: dataset
      integer :: k, i, status, rank
      logical :: found
      names = ''
      if (item%is_scale) names = item%path
      if (item%is_scale .or. size(item%extents) == 0 .or. allocated(file%failure)) return
      call h5dopen_f(file%id, item%path, dataset, status)
      call file%check_read(status, 'open '//item%path)
      if (status < 0) return
      rank = size(item%extents)
      call h5aexists_f(dataset, 'DIMENSION_LIST', found, status)
      if (.not. found) rank = 0
      do k = 1, rank
         call find_scale(file, dataset, k, name)
         ! one in its own group stands before one of all
         i = place_of_scale(item%path(:index(item%path, '/', back=.true.))//name, all)
         if (i == 0) i = place_of_scale(name, all)
         if (i > 0) then
            if (all(i)%extents(1) /= item%extents(rank + 1 - k)) i = 0
         end if
         if (i == 0) then
            names = ''
            exit
         end if
         names = names//all(i)%path
         if (k < rank) names = names//' '
      end do
      call h5dclose_f(dataset, status)
   end function scales_of

   pure integer function place_of_scale(path, all) result(i)
      character(len=*), intent(in) :: path
      type(item_type), intent(in) :: all(:)
      do i = size(all), 1, -1
         if (all(i)%is_scale .and. all(i)%path == path) return
      end do
   end function place_of_scale

   !> Units and meaning of a dataset.
   subroutine read_about(file, path, units, long_name)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: units, long_name
      type(hdf5_type) :: attributes
      integer :: status
      units = ''
      long_name = ''
      if (allocated(file%failure)) return
      ! attributes of a dataset are read as those of a file
      call h5dopen_f(file%id, path, attributes%id, status)
      call file%check_read(status, 'open '//path)
      if (status < 0) return
      if (attributes%has_attribute('units')) call attributes%get_text('units', units)
      if (attributes%has_attribute('long_name')) call attributes%get_text('long_name', long_name)
      if (allocated(attributes%failure)) call file%check_read(-1, 'read what '//path//' is')
      call h5dclose_f(attributes%id, status)
   end subroutine read_about

   !> Name of the scale of the k-th dimension, the slowest first; empty where it has none. What the scale knows of its
   !> datasets is not asked for: those that were deleted may be among them.
   subroutine find_scale(file, dataset, k, name)
      class(hdf5_type), intent(inout) :: file
      integer(hid_t), intent(in) :: dataset
      integer, intent(in) :: k
      character(len=:), allocatable, intent(out) :: name
      type(visit_type), target :: visit
      integer(c_int) :: status
      status = iterate_scales(int(dataset, c_int64_t), int(k - 1, c_int), c_null_ptr, c_funloc(take_name), c_loc(visit))
      if (status > 0) status = visit%status
      call file%check_read(int(status), 'find the scales of a dataset')
      name = trim(visit%name)
   end subroutine find_scale

   !> Notes the name of the first scale of a dimension.
   integer(c_int) function take_name(dataset, dimension, scale, visit) bind(c) result(ends)
      integer(c_int64_t), value :: dataset, scale
      integer(c_int), value :: dimension
      type(c_ptr), value :: visit
      type(visit_type), pointer :: own
      integer(size_t) :: length
      integer :: status
      call c_f_pointer(visit, own)
      length = len(own%name)
      call h5dsget_scale_name_f(int(scale, hid_t), own%name, length, status)
      if (length > len(own%name) .or. dataset < 0 .or. dimension < 0) status = -1
      own%status = min(0, status)
      ends = 1
   end function take_name

   ! What a group of an HDF5 file contains, also where it is damaged.

   !> The members of a group, in the order of the alphabet, without those whose name cannot be read; status < 0: the
   !> group itself cannot be read. The library is asked for names in its own order: for any other it makes a table of
   !> them first, and where one is damaged it frees names that it has not read (HDF5 1.10 to 1.14,
   !> H5G__dense_build_table).
   subroutine list_members(file, group, members, status)
      integer(hid_t), intent(in) :: file
      character(len=*), intent(in) :: group
      type(member_type), allocatable, intent(out) :: members(:)
      integer, intent(out) :: status
      type(member_type) :: member
      type(h5o_info_t) :: information
      integer(size_t) :: length
      integer :: count, i, k, taken, flag
      count = 0
      call h5gn_members_f(file, group, count, status)
      if (count > most_members) status = -1
      if (status < 0) count = 0
      allocate (members(count))
      taken = 0
      do i = 1, count
         call h5lget_name_by_idx_f(file, group, h5_index_name_f, h5_iter_native_f, int(i - 1, hsize_t), member%name, &
            & flag, length)
         if (flag < 0 .or. length > longest_name) cycle
         call h5oget_info_by_name_f(file, group//'/'//trim(member%name), information, flag)
         member%is_group = flag >= 0 .and. information%type == h5o_type_group_f
         member%is_dataset = flag >= 0 .and. information%type == h5o_type_dataset_f
         ! each to its place among those before it
         k = taken
         do while (k > 0)
            if (members(k)%name <= member%name) exit
            members(k + 1) = members(k)
            k = k - 1
         end do
         members(k + 1) = member
         taken = taken + 1
      end do
      members = members(:taken)
   end subroutine list_members
end module hdf5_scales
