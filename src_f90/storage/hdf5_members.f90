!> What a group of an HDF5 file contains, also where it is damaged.
module hdf5_members
   use hdf5, only: hid_t, hsize_t, size_t, h5gn_members_f, h5lget_name_by_idx_f, h5_index_name_f, h5_iter_native_f, &
      & h5oget_info_by_name_f, h5o_info_t, h5o_type_group_f, h5o_type_dataset_f
   implicit none (type, external)
   private
   public :: member_type, list_members

   !> Only a damaged file has longer names, or more members in a group.
   integer, parameter :: longest_name = 200, most_members = 2000

   !> A dataset, a group, or, where it is neither, a link that leads nowhere or a type.
   type :: member_type
      character(len=longest_name) :: name = ''
      logical :: is_group = .false., is_dataset = .false.
   end type member_type

contains

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
end module hdf5_members
