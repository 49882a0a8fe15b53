!> Versions of the names in a run's file: the present one, and what makes an older file like a present one.
module file_format
   use hdf5_file, only: hdf5_type
   implicit none (type, external)
   private
   public :: format_version, upgrade

   !> Version 2 calls film_volumes and film_passes what version 1 called film_sor and sor_sweeps.
   integer, parameter :: format_version = 2

contains

   !> Gives a file of an older version, open for writing, the present names.
   subroutine upgrade(file)
      type(hdf5_type), intent(inout) :: file
      call file%rename('statistics/film_sor', 'statistics/film_volumes')
      call file%rename('statistics/sor_sweeps', 'statistics/film_passes')
      call file%put_flag('format_version', format_version)
   end subroutine upgrade
end module file_format
