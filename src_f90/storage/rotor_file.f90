!> Reads the matrices of a rotor that another program wrote into an HDF5 file: datasets of 64-bit floats,
!> (row, column) as HDF5 shows them.
module rotor_file
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, input_error, raise, add_context
   use case_groups, only: rotor_type, given_rotor_type
   use guarded_open, only: try_reading
   use files, only: is_regular
   use hdf5_file, only: hdf5_type
   implicit none (type, external)
   private
   public :: read_rotor

   !> Most displacements of a rotor: its equations are solved as dense ones.
   integer, parameter :: most_displacements = 2000

contains

   !> Reads the file of an elastic rotor that is given as one, unless that is done.
   subroutine read_rotor(rotor, error)
      type(rotor_type), intent(inout) :: rotor
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: refusal
      type(hdf5_type) :: file
      logical :: exists
      if (rotor%is_rigid()) return
      associate (path => rotor%elastic%rotor_file)
         if (path == '' .or. allocated(rotor%elastic%given)) return
         refusal = 'there is no such file'
         inquire (file=path, exist=exists)
         if (exists) refusal = 'a directory, device or pipe, not a file of matrices'
         if (is_regular(path)) call try_reading(path, refusal)
         if (refusal /= '') then
            call raise(error, input_error, 'rotor%file = '''//path//''': '//refusal)
            return
         end if
         allocate (rotor%elastic%given)
         call file%open(path, writing=.false.)
         if (file%id < 0) then
            call raise(error, input_error, 'rotor%file = '''//path//''': not an HDF5 file')
            return
         end if
         call read_matrices(file, rotor%elastic%given, error)
         if (allocated(file%failure)) call raise(error, input_error, file%failure &
            & //'; all numbers must be 64-bit floats')
         call file%close()
         call add_context(error, 'rotor%file = '''//path//'''')
      end associate
   end subroutine read_rotor

   subroutine read_matrices(file, rotor, error)
      type(hdf5_type), intent(inout) :: file
      type(given_rotor_type), intent(inout) :: rotor
      type(error_type), allocatable, intent(inout) :: error
      real(wp), allocatable :: station(:)
      integer :: n, rows
      call file%get_list('weighed', rotor%weighed)
      call file%get_list('station', station)
      n = size(rotor%weighed)
      rows = size(station)
      if (allocated(file%failure)) return
      if (n < 1 .or. n > most_displacements) then
         call raise(error, input_error, 'weighed: has '//to_text(n)//' numbers: must be one for each displacement, ' &
            & //'1 to '//to_text(most_displacements))
      else if (mod(rows, 2*n) /= 0 .or. rows == 0) then
         call raise(error, input_error, 'station: has '//to_text(rows)//' numbers: must be rows of '//to_text(n) &
            & //' displacements, two for each station')
      end if
      if (allocated(error)) return
      rotor%total_mass = file%get_real('total_mass')
      rows = rows/n
      call read_matrix(file, 'mass', n, n, rotor%mass, error)
      call read_matrix(file, 'damping', n, n, rotor%damping, error)
      call read_matrix(file, 'gyroscopic', n, n, rotor%gyroscopic, error)
      call read_matrix(file, 'stiffness', n, n, rotor%stiffness, error)
      call read_matrix(file, 'station', rows, n, rotor%station, error)
      call read_matrix(file, 'slope', rows, n, rotor%slope, error)
   end subroutine read_matrices

   !> A matrix of this size; the first that has another one is refused.
   subroutine read_matrix(file, name, rows, columns, matrix, error)
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer, intent(in) :: rows, columns
      real(wp), allocatable, intent(out) :: matrix(:, :)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), allocatable :: numbers(:)
      if (allocated(error)) return
      call file%get_list(name, numbers)
      if (allocated(file%failure)) return
      if (size(numbers) /= rows*columns) then
         call raise(error, input_error, name//': has '//to_text(size(numbers))//' numbers: must have '//to_text(rows) &
            & //' x '//to_text(columns))
         return
      end if
      ! HDF5 has the last index first
      matrix = transpose(reshape(numbers, [columns, rows]))
   end subroutine read_matrix
end module rotor_file
