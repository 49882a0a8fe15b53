!> What matrices that another program made must be so that they are those of a rotor.
module component_checks
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   ! heap: matrices of all displacements of a shaft
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, require
   use linear_algebra, only: dpotrf, dpotrs
   use case_inputs, only: case_type
   use rotor_component, only: rotor_component_type
   implicit none (type, external)
   private
   public :: check_component

   !> How symmetric a matrix must be, relative to its largest element.
   real(wp), parameter :: symmetry = 1e-8_wp
   !> How closely a translation by 1 and the mass must follow from a mass matrix, which may be ill-conditioned.
   real(wp), parameter :: alike = 1e-4_wp

contains

   !> Raises an error for the first requirement that the matrices of a case's rotor do not meet. The name of the file
   !> stands before it.
   subroutine check_component(inputs, component, error)
      type(case_type), intent(in) :: inputs
      type(rotor_component_type), intent(in) :: component
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: file
      file = 'rotor%file = '''//inputs%rotor%elastic%rotor_file//''': '
      associate (c => component)
         call require(all(ieee_is_finite(c%mass)) .and. all(ieee_is_finite(c%damping)) .and. &
            & all(ieee_is_finite(c%gyroscopic)) .and. all(ieee_is_finite(c%stiffness)) .and. &
            & all(ieee_is_finite(c%station)) .and. all(ieee_is_finite(c%slope)) .and. &
            & all(ieee_is_finite(c%weighed)) .and. ieee_is_finite(c%total_mass), &
            & file//'its numbers must be finite', error)
         if (allocated(error)) return
         call require(symmetric(c%mass, 1.0_wp), file//'mass: must be symmetric', error)
         call check_translation(c, file, error)
         call require(symmetric(c%stiffness, 1.0_wp), file//'stiffness: must be symmetric', error)
         call require(symmetric(c%gyroscopic, -1.0_wp), file//'gyroscopic: must change its sign when it ' &
            & //'is transposed', error)
         call check_stations(inputs, c%station, file, error)
      end associate
   end subroutine check_component

   !> The mass matrix is that of a body whose translation along y moves all stations, weighs `weighed` and has its mass.
   subroutine check_translation(component, file, error)
      type(rotor_component_type), intent(in) :: component
      character(len=*), intent(in) :: file
      type(error_type), allocatable, intent(inout) :: error
      real(wp), allocatable :: factor(:, :), translation(:, :), moved(:, :)
      integer :: n, info
      n = size(component%weighed)
      factor = component%mass
      call dpotrf('U', n, factor, n, info)
      call require(info == 0, file//'mass: must be positive definite', error)
      if (allocated(error)) return
      translation = reshape(component%weighed, [n, 1])
      call dpotrs('U', n, 1, factor, n, translation, n, info)
      moved = reshape(matmul(component%station, translation(:, 1)), [2, size(component%station, 1)/2])
      call require(all(abs(moved(1, :) - 1) <= alike) .and. all(abs(moved(2, :)) <= alike), file//'weighed: must be ' &
         & //'mass times a translation that moves all stations by 1 along y', error)
      associate (mass => dot_product(component%weighed, translation(:, 1)))
         call require(abs(component%total_mass - mass) <= alike*mass, file//'total_mass = ' &
            & //to_text(component%total_mass)//': must be that of the translation in weighed, '//to_text(mass)//' kg', &
            & error)
      end associate
   end subroutine check_translation

   !> Stations of the case exist; those of bearings are displacements of their own.
   subroutine check_stations(inputs, station, file, error)
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: station(:, :)
      character(len=*), intent(in) :: file
      type(error_type), allocatable, intent(inout) :: error
      integer :: stations, highest, b, row
      stations = size(station, 1)/2
      highest = max(maxval(inputs%bearings%station), 0)
      associate (rotor => inputs%rotor%elastic)
         if (size(rotor%unbalances) > 0) highest = max(highest, maxval(rotor%unbalances%station))
         if (size(rotor%loads) > 0) highest = max(highest, maxval(rotor%loads%station))
      end associate
      call require(highest <= stations, file//'has '//to_text(stations)//' stations, but station = '//to_text(highest) &
         & //' is asked for', error)
      call require(size(inputs%rotor%elastic%discs) == 0, file//'a group disc has no effect: its matrices contain ' &
         & //'the discs', error)
      if (allocated(error)) return
      do b = 1, size(inputs%bearings)
         do row = 2*inputs%bearings(b)%station - 1, 2*inputs%bearings(b)%station
            call require(abs(maxval(station(row, :)) - 1) <= 0 .and. count(abs(station(row, :)) > 0) == 1, file &
               & //'station: row '//to_text(row)//', of a bearing, must have one element 1 and otherwise 0', error)
         end do
      end do
   end subroutine check_stations

   !> Whether a matrix is `sign` times its transpose.
   pure logical function symmetric(matrix, sign)
      real(wp), intent(in) :: matrix(:, :), sign
      symmetric = maxval(abs(matrix - sign*transpose(matrix))) <= symmetry*maxval(abs(matrix))
   end function symmetric
end module component_checks
