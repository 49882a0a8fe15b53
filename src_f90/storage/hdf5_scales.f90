!> Which dimension scales datasets have, and what a file contains.
module hdf5_scales
   use hdf5, only: hid_t, hsize_t, h5gn_members_f, h5gget_obj_info_idx_f, h5g_group_f, h5g_dataset_f, h5dopen_f, &
      & h5dclose_f, h5dget_space_f, h5sget_simple_extent_ndims_f, h5sget_simple_extent_dims_f, h5sclose_f, &
      & h5s_unlimited_f, h5aexists_f, h5dget_type_f, h5tget_class_f, h5tclose_f, h5t_string_f
   use h5ds, only: h5dsis_scale_f, h5dsis_attached_f
   use hdf5_file, only: hdf5_type
   implicit none (type, external)
   private
   public :: item_type, list_items, scales_of, read_about, scale_name, scale_count

   !> Only a damaged file has longer names or more dimensions.
   integer, parameter :: longest_name = 200, most_dimensions = 32

   !> A dataset or group of a file.
   type :: item_type
      character(len=:), allocatable :: path
      logical :: is_group = .false., is_dataset = .false., is_scale = .false.
      !> Of a dataset: whether it has texts, its sizes, the fastest first, and whether it may become longer.
      logical :: of_texts = .false.
      integer(hsize_t), allocatable :: extents(:)
      logical :: grows = .false.
   end type item_type

contains

   !> The groups of a file, and its datasets, those in the groups too.
   subroutine list_items(file, found)
      class(hdf5_type), intent(inout) :: file
      type(item_type), allocatable, intent(out) :: found(:)
      type(item_type), allocatable :: top(:)
      integer :: i, n, count, status
      call list_group(file, '/', top)
      n = size(top)
      do i = 1, size(top)
         if (.not. top(i)%is_group) cycle
         call h5gn_members_f(file%id, top(i)%path, count, status)
         if (status >= 0) n = n + count
      end do
      allocate (found(n))
      found(:size(top)) = top
      n = size(top)
      do i = 1, size(found)
         if (i > n) exit
         if (found(i)%is_group .and. index(found(i)%path, '/') == 0) call add_group(file, found(i)%path, found, n)
      end do
   end subroutine list_items

   !> Adds the items of a group to a list of n.
   subroutine add_group(file, group, found, n)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: group
      type(item_type), intent(inout) :: found(:)
      integer, intent(inout) :: n
      type(item_type), allocatable :: inner(:)
      call list_group(file, group, inner)
      found(n + 1:n + size(inner)) = inner
      n = n + size(inner)
   end subroutine add_group

   !> The datasets and groups of a group.
   subroutine list_group(file, group, found)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: group
      type(item_type), allocatable, intent(out) :: found(:)
      character(len=longest_name) :: name
      integer :: count, i, kind, status
      count = 0
      if (.not. allocated(file%failure)) then
         call h5gn_members_f(file%id, group, count, status)
         call file%check_read(status, 'list the datasets of '//group)
         if (status < 0) count = 0
      end if
      allocate (found(count))
      do i = 1, count
         allocate (found(i)%extents(0))
         found(i)%path = ''
         call h5gget_obj_info_idx_f(file%id, group, i - 1, name, kind, status)
         if (status < 0) cycle
         found(i)%path = trim(name)
         if (group /= '/') found(i)%path = group//'/'//trim(name)
         found(i)%is_group = kind == h5g_group_f
         found(i)%is_dataset = kind == h5g_dataset_f
         if (found(i)%is_dataset) call measure(file, found(i))
      end do
   end subroutine list_group

   !> Size of a dataset, and whether it is a scale.
   subroutine measure(file, item)
      class(hdf5_type), intent(inout) :: file
      type(item_type), intent(inout) :: item
      integer(hsize_t) :: dims(most_dimensions), most(most_dimensions)
      integer(hid_t) :: dataset, space, kind
      integer :: status, rank, class, ignored
      logical :: there
      call h5dopen_f(file%id, item%path, dataset, status)
      call file%check_read(status, 'open '//item%path)
      if (status < 0) return
      call h5dget_space_f(dataset, space, status)
      call h5sget_simple_extent_ndims_f(space, rank, status)
      if (status >= 0 .and. rank > 0) call h5sget_simple_extent_dims_f(space, dims(:rank), most(:rank), status)
      call file%check_read(status, 'read the size of '//item%path)
      if (status >= 0 .and. rank > 0) then
         item%extents = dims(:rank)
         item%grows = any(most(:rank) == h5s_unlimited_f)
      end if
      call h5dget_type_f(dataset, kind, status)
      call h5tget_class_f(kind, class, ignored)
      item%of_texts = status >= 0 .and. class == h5t_string_f
      if (status >= 0) call h5tclose_f(kind, ignored)
      ! asking for it is an error for a dataset without any
      call h5aexists_f(dataset, 'CLASS', there, ignored)
      if (there) call h5dsis_scale_f(dataset, item%is_scale, ignored)
      call h5sclose_f(space, ignored)
      call h5dclose_f(dataset, ignored)
   end subroutine measure

   !> The scales of a dataset as hdf5_file names them: slowest dimension first, separated by blanks; its own path for a
   !> scale, and empty for a single number and where a dimension has no scale.
   function scales_of(file, item, all) result(names)
      class(hdf5_type), intent(inout) :: file
      !> The dataset, and all items of the file.
      type(item_type), intent(in) :: item, all(:)
      character(len=:), allocatable :: names
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
         do i = 1, size(all)
            if (.not. all(i)%is_scale) cycle
            if (all(i)%extents(1) /= item%extents(rank + 1 - k)) cycle
            if (is_attached(file, dataset, all(i)%path, k)) exit
         end do
         if (i > size(all)) then
            names = ''
            exit
         end if
         names = names//all(i)%path
         if (k < rank) names = names//' '
      end do
      call h5dclose_f(dataset, status)
   end function scales_of

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
      call attributes%get_text('units', units)
      call attributes%get_text('long_name', long_name)
      if (allocated(attributes%failure)) call file%check_read(-1, 'read what '//path//' is')
      call h5dclose_f(attributes%id, status)
   end subroutine read_about

   !> Whether a scale is that of the k-th dimension, the slowest first.
   logical function is_attached(file, dataset, scale, k)
      class(hdf5_type), intent(inout) :: file
      integer(hid_t), intent(in) :: dataset
      character(len=*), intent(in) :: scale
      integer, intent(in) :: k
      integer(hid_t) :: opened
      integer :: status
      is_attached = .false.
      call h5dopen_f(file%id, scale, opened, status)
      call file%check_read(status, 'open '//scale)
      if (status < 0) return
      call h5dsis_attached_f(dataset, opened, k, is_attached, status)
      call file%check_read(status, 'find the scales of a dataset')
      call h5dclose_f(opened, status)
   end function is_attached
end module hdf5_scales
