!> Which dimension scales datasets have, and what a file contains.
module hdf5_scales
   use hdf5, only: hid_t, hsize_t, h5gn_members_f, h5gget_obj_info_idx_f, h5g_group_f, h5g_dataset_f, h5dopen_f, &
      & h5dclose_f, h5dget_space_f, h5sget_simple_extent_ndims_f, h5sget_simple_extent_dims_f, h5sclose_f, &
      & h5s_unlimited_f, h5aexists_f, h5dget_type_f, h5tget_class_f, h5tclose_f, h5t_string_f
   use h5ds, only: h5dsis_scale_f, h5dsis_attached_f
   use hdf5_file, only: hdf5_type
   implicit none (type, external)
   private
   public :: member_type, members, scales_of, read_about

   !> Only a damaged file has longer names or more dimensions.
   integer, parameter :: longest_name = 200, most_dimensions = 32

   !> A dataset or group of a file.
   type :: member_type
      character(len=:), allocatable :: path
      logical :: is_group = .false., is_scale = .false.
      !> Of a dataset: whether it has texts, its sizes, the fastest first, and whether it may become longer.
      logical :: of_texts = .false.
      integer(hsize_t), allocatable :: extents(:)
      logical :: grows = .false.
   end type member_type

contains

   !> The datasets and groups of a group; of the file itself where its name is empty.
   function members(file, group) result(found)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: group
      type(member_type), allocatable :: found(:)
      character(len=longest_name) :: name
      character(len=:), allocatable :: place
      integer :: count, i, kind, status, n
      allocate (found(0))
      if (allocated(file%failure)) return
      place = group
      if (group == '') place = '/'
      call h5gn_members_f(file%id, place, count, status)
      call file%check_read(status, 'list the datasets of '//place)
      if (status < 0) return
      deallocate (found)
      allocate (found(count))
      n = 0
      do i = 0, count - 1
         call h5gget_obj_info_idx_f(file%id, place, i, name, kind, status)
         if (status < 0 .or. kind /= h5g_group_f .and. kind /= h5g_dataset_f) cycle
         n = n + 1
         found(n)%path = trim(name)
         if (group /= '') found(n)%path = group//'/'//trim(name)
         found(n)%is_group = kind == h5g_group_f
         if (kind == h5g_dataset_f) call measure(file, found(n))
      end do
      found = found(:n)
   end function members

   !> Size of a dataset, and whether it is a scale.
   subroutine measure(file, member)
      class(hdf5_type), intent(inout) :: file
      type(member_type), intent(inout) :: member
      integer(hsize_t) :: dims(most_dimensions), most(most_dimensions)
      integer(hid_t) :: dataset, space, kind
      integer :: status, rank, class, ignored
      logical :: there
      allocate (member%extents(0))
      call h5dopen_f(file%id, member%path, dataset, status)
      call file%check_read(status, 'open '//member%path)
      if (status < 0) return
      call h5dget_space_f(dataset, space, status)
      call h5sget_simple_extent_ndims_f(space, rank, status)
      if (status >= 0 .and. rank > 0) call h5sget_simple_extent_dims_f(space, dims(:rank), most(:rank), status)
      call file%check_read(status, 'read the size of '//member%path)
      if (status >= 0 .and. rank > 0) then
         member%extents = dims(:rank)
         member%grows = any(most(:rank) == h5s_unlimited_f)
      end if
      call h5dget_type_f(dataset, kind, status)
      call h5tget_class_f(kind, class, ignored)
      member%of_texts = status >= 0 .and. class == h5t_string_f
      if (status >= 0) call h5tclose_f(kind, ignored)
      ! asking for it is an error for a dataset without any
      call h5aexists_f(dataset, 'CLASS', there, ignored)
      if (there) call h5dsis_scale_f(dataset, member%is_scale, ignored)
      call h5sclose_f(space, ignored)
      call h5dclose_f(dataset, ignored)
   end subroutine measure

   !> The scales of a dataset as hdf5_file names them: slowest dimension first, separated by blanks; its own path for a
   !> scale, and empty for a single number and where a dimension has none of these scales.
   function scales_of(file, member, scales) result(names)
      class(hdf5_type), intent(inout) :: file
      type(member_type), intent(in) :: member, scales(:)
      character(len=:), allocatable :: names
      integer(hid_t) :: dataset
      integer :: k, i, status, rank
      logical :: found
      names = ''
      if (member%is_scale) names = member%path
      if (member%is_scale .or. size(member%extents) == 0 .or. allocated(file%failure)) return
      call h5dopen_f(file%id, member%path, dataset, status)
      call file%check_read(status, 'open '//member%path)
      if (status < 0) return
      rank = size(member%extents)
      call h5aexists_f(dataset, 'DIMENSION_LIST', found, status)
      if (.not. found) rank = 0
      do k = 1, rank
         do i = 1, size(scales)
            if (scales(i)%extents(1) /= member%extents(rank + 1 - k)) cycle
            if (is_attached(file, dataset, scales(i)%path, k)) exit
         end do
         if (i > size(scales)) then
            names = ''
            exit
         end if
         names = names//scales(i)%path
         if (k < rank) names = names//' '
      end do
      call h5dclose_f(dataset, status)
   end function scales_of

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
