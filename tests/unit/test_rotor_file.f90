!> Rotors whose matrices are read from a file.
program test_rotor_file
   use kinds, only: wp, rpm
   use errors, only: error_type, input_error
   use case_groups, only: unset, given_rotor_type
   use case_inputs, only: case_type
   use linear_algebra, only: identity
   use sparse_matrix, only: sparse_matrix_type
   use rotor_component, only: rotor_component_type, shaft_component
   use rotor_reduction, only: rotor_matrices_type
   use rotor_factory, only: find_rotor
   use rotor_file, only: read_rotor
   use hdf5_file, only: hdf5_type
   use hdf5_expectations, only: put_real, put_list, put_table
   use scratch, only: scratch_path, write_bytes
   use example_machine, only: turbine, rotor_of, put_disc, put_bearings, unbalance_response, static_stations
   use check, only: runs, expect, expect_close, expect_no_error, expect_error, report
   implicit none (type, external)
   real(wp), parameter :: springs(4) = [6e8_wp, 3e8_wp, 5e8_wp, 2e8_wp], dampers(4) = 1e6_wp
   character(len=:), allocatable :: path

   path = scratch_path('rotor.h5')
   if (runs('the same rotor')) call try_same_rotor()
   if (runs('files that are refused')) call try_files()
   if (runs('matrices that are refused')) call try_matrices()
   open (unit=10, file=path)
   close (10, status='delete')
   call report()

contains

   !> A turbine's matrices, its displacements from the last one to the first.
   function turned_round() result(rotor)
      type(given_rotor_type) :: rotor
      type(rotor_component_type) :: shaft
      type(case_type) :: machine
      integer :: n, i
      machine = turbine()
      shaft = shaft_component(machine%rotor%elastic)
      n = shaft%mass%rows
      rotor%mass = turned(shaft%mass, [(i, i=n, 1, -1)])
      rotor%damping = turned(shaft%damping, [(i, i=n, 1, -1)])
      rotor%gyroscopic = turned(shaft%gyroscopic, [(i, i=n, 1, -1)])
      rotor%stiffness = turned(shaft%stiffness, [(i, i=n, 1, -1)])
      rotor%station = turned(shaft%station, [(i, i=1, n/2)])
      rotor%slope = turned(shaft%slope, [(i, i=1, n/2)])
      rotor%weighed = shaft%weighed(n:1:-1)
      rotor%total_mass = shaft%total_mass
   end function turned_round

   !> These rows of a matrix in full, its columns from the last one to the first.
   function turned(matrix, rows)
      type(sparse_matrix_type), intent(in) :: matrix
      integer, intent(in) :: rows(:)
      real(wp), allocatable :: turned(:, :), full(:, :)
      full = matrix%times(identity(matrix%columns))
      turned = full(rows, matrix%columns:1:-1)
   end function turned

   !> Writes a file, whose matrices h5py shows as they are here.
   subroutine write_rotor(rotor)
      type(given_rotor_type), intent(in) :: rotor
      type(hdf5_type) :: file
      call file%create(path)
      call put_table(file, 'mass', transpose(rotor%mass), 'kg', '', '')
      call put_table(file, 'damping', transpose(rotor%damping), 'N s/m', '', '')
      call put_table(file, 'gyroscopic', transpose(rotor%gyroscopic), 'kg', '', '')
      call put_table(file, 'stiffness', transpose(rotor%stiffness), 'N/m', '', '')
      call put_table(file, 'station', transpose(rotor%station), '1', '', '')
      call put_table(file, 'slope', transpose(rotor%slope), '1/m', '', '')
      call put_list(file, 'weighed', rotor%weighed, 'kg', '', '')
      call put_real(file, 'total_mass', rotor%total_mass, 'kg', '')
      call file%close()
   end subroutine write_rotor

   !> A turbine whose rotor is in the file.
   function from_file() result(machine)
      type(case_type) :: machine
      machine = turbine()
      associate (elastic => machine%rotor%elastic)
         elastic%shaft%length = [unset]
         deallocate (elastic%discs)
         allocate (elastic%discs(0))
         elastic%rotor_file = path
      end associate
   end function from_file

   !> The same vibrations and static deflections as the shaft itself.
   subroutine try_same_rotor()
      type(case_type) :: machine
      type(rotor_matrices_type) :: rotor, expected
      type(error_type), allocatable :: error
      complex(wp), allocatable :: response(:)
      call write_rotor(turned_round())
      machine = from_file()
      call read_rotor(machine%rotor, error)
      call expect_no_error(error, 'the file is read')
      if (allocated(error)) return
      ! each plane has modes of its own here
      rotor = rotor_of(machine, 6500*rpm, 8)
      expected = rotor_of(turbine(), 6500*rpm, 4)
      response = unbalance_response(expected, 5000*rpm, springs, dampers)
      call expect(maxval(abs(unbalance_response(rotor, 5000*rpm, springs, dampers) - response)) &
         & < 1e-8_wp*maxval(abs(response)), 'unbalance response')
      call expect(maxval(abs(static_stations(rotor, springs) - static_stations(expected, springs))) < 1e-12_wp, &
         & 'static deflection')
      call expect_close(rotor%total_mass, expected%total_mass, 1e-9_wp, 'mass')
      rotor = rotor_of(machine, 6500*rpm)
      call expect(size(rotor%mode_frequency) >= 6 .and. rotor%truncation_error <= 1e-4_wp, 'modes are chosen')
   end subroutine try_same_rotor

   subroutine try_files()
      type(case_type) :: machine
      type(given_rotor_type) :: rotor
      type(error_type), allocatable :: error
      call write_bytes(path, 'no matrices')
      machine = from_file()
      call read_rotor(machine%rotor, error)
      call expect_error(error, input_error, 'not an HDF5 file', 'another file')
      rotor = turned_round()
      rotor%mass = rotor%mass(:40, :40)
      call write_rotor(rotor)
      machine = from_file()
      call read_rotor(machine%rotor, error)
      call expect_error(error, input_error, 'mass: has 1600 numbers: must have 52 x 52', 'a matrix of another size')
      rotor = turned_round()
      rotor%station = rotor%station(:25, :)
      call write_rotor(rotor)
      machine = from_file()
      call read_rotor(machine%rotor, error)
      call expect_error(error, input_error, 'station: has 1300 numbers', 'half a station')
      machine%rotor%elastic%rotor_file = path//'x'
      deallocate (machine%rotor%elastic%given)
      call read_rotor(machine%rotor, error)
      call expect_error(error, input_error, 'rotor.h5x'': there is no such file', 'a file that does not exist')
   end subroutine try_files

   subroutine try_matrices()
      type(case_type) :: machine
      machine = from_file()
      machine%rotor%elastic%given = turned_round()
      machine%rotor%elastic%given%mass(3, 4) = machine%rotor%elastic%given%mass(3, 4) + 1
      call refused(machine, 'mass: must be symmetric')
      machine%rotor%elastic%given = turned_round()
      machine%rotor%elastic%given%mass(3, 3) = -1
      call refused(machine, 'mass: must be positive definite')
      machine%rotor%elastic%given = turned_round()
      machine%rotor%elastic%given%stiffness(3, 6) = 1e9_wp
      call refused(machine, 'stiffness: must be symmetric')
      machine%rotor%elastic%given = turned_round()
      machine%rotor%elastic%given%gyroscopic = abs(machine%rotor%elastic%given%gyroscopic)
      call refused(machine, 'gyroscopic: must change its sign')
      machine%rotor%elastic%given = turned_round()
      machine%rotor%elastic%given%station(3, 3) = 0.5_wp
      call refused(machine, 'station: row 3, of a bearing')
      machine%rotor%elastic%given = turned_round()
      call put_bearings(machine, [2, 14])
      call refused(machine, 'has 13 stations, but station = 14')
      call put_bearings(machine, [2, 12])
      call put_disc(machine, 3, 1.0_wp, 1.0_wp, 1.0_wp)
      call refused(machine, 'disc')
      deallocate (machine%rotor%elastic%given)
      call refused(machine, 'is not read here')
   end subroutine try_matrices

   subroutine refused(machine, words)
      type(case_type), intent(in) :: machine
      character(len=*), intent(in) :: words
      type(rotor_matrices_type) :: rotor
      type(error_type), allocatable :: error
      call find_rotor(machine, 600.0_wp, rotor, error)
      call expect_error(error, input_error, words, words)
   end subroutine refused
end program test_rotor_file
