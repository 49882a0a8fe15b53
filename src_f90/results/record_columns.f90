!> Which datasets of a run are columns of a study, and what they are called there.
module record_columns
   use record, only: record_type, dataset_type, of_texts
   use hdf5_scales, only: scale_count
   use study_columns, only: new_column_type
   implicit none (type, external)
   private
   public :: columns_of, record_column_type

   !> A dataset of a record and the column that it is.
   type :: record_column_type
      integer :: dataset = 0
      !> Whether only a run that was done has it.
      logical :: of_done = .false.
      type(new_column_type) :: column
   end type record_column_type

   !> Groups whose datasets are columns, and what stands before their names there.
   character(len=*), parameter :: groups(*) = [character(len=13) :: 'summary', 'by_revolution', 'coefficients', &
      & 'modes', 'statistics', 'equilibrium', 'periodic', 'response', 'synchronous']
   character(len=*), parameter :: prefixes(*) = [character(len=12) :: '', '', '', '', '', 'equilibrium_', 'periodic_', &
      & 'response_', 'synchronous_']
   !> Groups that a run has which was not done, but for the figures of its equilibrium and its speed.
   character(len=*), parameter :: of_motion = ' summary by_revolution '
   character(len=*), parameter :: of_any(*) = [character(len=12) :: 'speed', 'time_reached', 'equilibrium_']
   !> The scale of the pads, and what the names of their columns begin with.
   character(len=*), parameter :: pads = 'pad', of_pads = 'pad_'
   !> Above the groups of a machine's bearings.
   character(len=*), parameter :: bearings = 'bearings/'

contains

   !> The columns that a record has or had. A name that is `taken` (separated by blanks) gets its group before it.
   !> Those of a bearing of a machine are in its group and have the names of those of one bearing there.
   function columns_of(record, taken) result(found)
      type(record_type), intent(in) :: record
      character(len=*), intent(in) :: taken
      type(record_column_type), allocatable :: found(:)
      character(len=:), allocatable :: own, name, bearing, group
      integer :: k, n
      allocate (found(count([(is_column(record%datasets(k)), k=1, record%count)])))
      n = 0
      do k = 1, record%count
         associate (dataset => record%datasets(k))
            if (.not. is_column(dataset)) cycle
            bearing = bearing_of(dataset)
            group = trim(groups(group_of(dataset)))
            own = dataset%path(index(dataset%path, '/', back=.true.) + 1:)
            name = trim(prefixes(group_of(dataset)))//own
            if (dataset%scales == bearing//pads .and. index(own, of_pads) /= 1) name = of_pads//name
            name = bearing//name
            if (index(' '//taken//' ', ' '//name//' ') > 0) name = group//'_'//name
            n = n + 1
            found(n)%dataset = k
            found(n)%of_done = index(of_motion, ' '//group//' ') > 0 .and. .not. begins(own)
            found(n)%column%name = name
            found(n)%column%units = dataset%units
            found(n)%column%long_name = dataset%long_name
            found(n)%column%scales = dataset%scales
         end associate
      end do
   end function columns_of

   !> Whether a dataset is one; each of its dimensions has a scale.
   pure logical function is_column(dataset)
      type(dataset_type), intent(in) :: dataset
      is_column = group_of(dataset) > 0 .and. dataset%kind /= of_texts &
         & .and. size(dataset%extents) == scale_count(dataset%scales)
   end function is_column

   !> Which of the groups a dataset is in, of the whole run or of a bearing; 0 for another.
   pure integer function group_of(dataset) result(g)
      type(dataset_type), intent(in) :: dataset
      character(len=:), allocatable :: group
      group = dataset%group()
      group = group(min(len(bearing_of(dataset)), len(group)) + 1:)
      do g = size(groups), 1, -1
         if (groups(g) == group) return
      end do
   end function group_of

   !> The group of the bearing of a machine that a dataset is in, with a slash at its end; empty for others.
   pure function bearing_of(dataset) result(bearing)
      type(dataset_type), intent(in) :: dataset
      character(len=:), allocatable :: bearing
      integer :: slash
      bearing = ''
      if (index(dataset%path, bearings) /= 1) return
      slash = index(dataset%path(len(bearings) + 1:), '/')
      bearing = dataset%path(:len(bearings) + slash)
   end function bearing_of

   !> Whether a figure is one of those that also a run has that was not done.
   pure logical function begins(name)
      character(len=*), intent(in) :: name
      integer :: i
      begins = .false.
      do i = 1, size(of_any)
         begins = begins .or. index(name, trim(of_any(i))) == 1
      end do
   end function begins
end module record_columns
