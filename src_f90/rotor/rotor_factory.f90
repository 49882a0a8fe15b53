!> Builds the rotor of a case: a rigid journal, or a shaft on its journals, reduced to few displacements.
module rotor_factory
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, rpm
   use text, only: to_text, list_text
   use errors, only: error_type, input_error, raise, require
   use case_inputs, only: case_type
   use rigid_rotor, only: rotor_type, new_rigid_rotor
   use elastic_rotor, only: elastic_rotor_type, new_elastic_rotor
   use case_groups, only: mount_type, given_rotor_type
   use sparse_matrix, only: sparse_matrix_type
   use rotor_component, only: rotor_component_type, shaft_component, given_component
   use fixed_interface, only: fixed_interface_type, find_fixed_interface
   use rotor_reduction, only: mode_selection_type, select_modes, damped_above, most_modes, &
      & rotor_matrices_type, reduced_rotor
   use linear_algebra, only: dpbtrf, dpbtrs
   implicit none (type, external)
   private
   public :: make_rotor, find_rotor

   !> How symmetric a matrix must be, relative to its largest element.
   real(wp), parameter :: symmetry = 1e-8_wp
   !> How closely a translation by 1 and the mass must follow from a mass matrix, which may be ill-conditioned.
   real(wp), parameter :: alike = 1e-4_wp

contains

   !> The rotor of a case. A shaft that has no equations is refused.
   subroutine make_rotor(inputs, rotor, refusal, before)
      type(case_type), intent(in) :: inputs
      class(rotor_type), allocatable, intent(out) :: rotor
      !> Not allocated where there is a rotor.
      character(len=:), allocatable, intent(out) :: refusal
      !> A rotor of as many displacements; where it is left out the shaft has as many as the highest speed needs.
      class(rotor_type), intent(in), optional :: before
      type(rotor_matrices_type) :: matrices
      type(elastic_rotor_type) :: elastic
      type(error_type), allocatable :: error
      integer, allocatable :: modes
      logical :: ok, has_mass
      if (inputs%rotor%is_rigid()) then
         allocate (rotor, source=new_rigid_rotor(inputs%rotor%mass))
         return
      end if
      if (present(before)) then
         select type (before)
         type is (elastic_rotor_type)
            modes = size(before%matrices%mode_frequency) - before%matrices%residual_modes
         end select
      end if
      call find_rotor(inputs, highest_speed(inputs), matrices, error, modes)
      if (allocated(error)) then
         refusal = error%message
         return
      end if
      call new_elastic_rotor(matrices, inputs%unbalance(), inputs%operation%speed_rpm*rpm, elastic, ok)
      has_mass = .true.
      if (ok .and. elastic%elements > 0) has_mass = is_positive_definite(matrices%mass)
      if (.not. ok) then
         refusal = 'machine: nothing holds its shaft: stiffness of bearings and elements leave it free in a direction'
      else if (.not. has_mass) then
         refusal = 'element%mass: takes away more mass in a direction than the machine has'
      else if (any(inputs%excitations%station > elastic%stations)) then
         refusal = 'excitation: station = '//to_text(maxval(inputs%excitations%station))//': the rotor has '// &
            & to_text(elastic%stations)//' stations'
      else
         allocate (rotor, source=elastic)
      end if
   end subroutine make_rotor

   !> Of a square matrix its symmetric part, by Cholesky's factor.
   logical function is_positive_definite(matrix)
      real(wp), intent(in) :: matrix(:, :)
      real(wp) :: band(size(matrix, 1), size(matrix, 1))
      integer :: info, j, n
      n = size(matrix, 1)
      do j = 1, n
         band(n - j + 1:, j) = (matrix(:j, j) + matrix(j, :j))/2
      end do
      call dpbtrf('U', n, n - 1, band, n, info)
      is_positive_definite = info == 0
   end function is_positive_definite

   !> Highest speed of a task, rad/s, with those of a branch over the speed and of a search of threshold speeds.
   pure real(wp) function highest_speed(inputs)
      type(case_type), intent(in) :: inputs
      highest_speed = inputs%highest_speed()
      associate (task => inputs%about%task)
         if (task == 'coefficients') highest_speed = max(highest_speed, inputs%coefficients%threshold_up_to_rpm*rpm)
         if (task == 'branch') highest_speed = maxval([highest_speed, inputs%branch%speeds()*rpm])
      end associate
   end function highest_speed

   ! The elastic rotor of a case on its journals: shaft, discs and supports, reduced to few displacements.

   !> The equations of a case's rotor for runs up to a speed, rad/s.
   subroutine find_rotor(inputs, highest_speed, matrices, error, modes)
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: highest_speed
      type(rotor_matrices_type), intent(out) :: matrices
      type(error_type), allocatable, intent(out) :: error
      !> Modes with the journals held that are kept, in a plane of a shaft; left out, they are chosen.
      integer, intent(in), optional :: modes
      type(rotor_component_type) :: component
      type(fixed_interface_type) :: fixed
      type(mode_selection_type) :: selection
      type(mount_type), allocatable :: mounts(:)
      integer, allocatable :: border(:)
      logical :: held
      associate (rotor => inputs%rotor%elastic)
         if (rotor%rotor_file == '') then
            component = shaft_component(rotor)
            call require(all(ieee_is_finite([component%mass%value, component%stiffness%value, &
               & component%gyroscopic%value])), 'shaft: its mass or stiffness is too large for a ' &
               & //'number: lengths and diameters are in m, moduli in Pa', error)
         else if (allocated(rotor%given)) then
            call check_given(inputs, rotor%given, component, error)
         else
            call raise(error, input_error, 'rotor%file = '''//rotor%rotor_file//''': is not read here')
         end if
      end associate
      if (allocated(error)) return
      call component%turn_in(inputs%sense())
      mounts = inputs%mounts()
      border = [displacements_at(mounts%station, component%station), &
         & displacements_at(mounts(inputs%inclined())%station, component%slope)]
      call find_fixed_interface(component, border, fixed, held)
      if (.not. held) call raise(error, input_error, 'machine: its bearings (at the stations ' &
         & //list_text(real(mounts%station, wp))//') do not hold the shaft: it needs two at different ' &
         & //'stations, and sections with stiffness between them')
      if (allocated(error)) return
      selection%damped_above = damped_above(inputs, highest_speed)
      if (present(modes)) then
         selection%modes = min(modes, size(fixed%frequency))
         call fixed%find_modes(selection%modes)
      else
         call select_modes(inputs, component, fixed, border, highest_speed, selection)
         if (fixed%planes*selection%modes > most_modes) call raise(error, input_error, 'reduction%frequency = ' &
            & //to_text(inputs%rotor%elastic%reduction%frequency)//': '//to_text(fixed%planes*selection%modes) &
            & //' modes are below it, those of both planes; a machine keeps at most '//to_text(most_modes))
         if (allocated(error)) return
      end if
      matrices = reduced_rotor(inputs, component, fixed, selection)
   end subroutine find_rotor

   !> Displacements y and z, or slopes, of these stations among those of the rotor.
   pure function displacements_at(stations, over) result(border)
      integer, intent(in) :: stations(:)
      !> component%station or component%slope, whose rows there have one element.
      type(sparse_matrix_type), intent(in) :: over
      integer :: border(2*size(stations)), b, p
      do b = 1, size(stations)
         do p = 1, 2
            border(2*(b - 1) + p) = over%column(over%first(2*(stations(b) - 1) + p))
         end do
      end do
   end function displacements_at

   ! What matrices that another program made must be so that they are those of a rotor.

   !> The rotor of a case of these matrices. An error for the first requirement that they do not meet, behind the name
   !> of the file.
   subroutine check_given(inputs, given, component, error)
      type(case_type), intent(in) :: inputs
      type(given_rotor_type), intent(in) :: given
      type(rotor_component_type), intent(out) :: component
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: file
      real(wp), allocatable :: translation(:)
      file = 'rotor%file = '''//inputs%rotor%elastic%rotor_file//''': '
      associate (r => given)
         call require(all(ieee_is_finite(r%mass)) .and. all(ieee_is_finite(r%damping)) .and. &
            & all(ieee_is_finite(r%gyroscopic)) .and. all(ieee_is_finite(r%stiffness)) .and. &
            & all(ieee_is_finite(r%station)) .and. all(ieee_is_finite(r%slope)) .and. &
            & all(ieee_is_finite(r%weighed)) .and. ieee_is_finite(r%total_mass), &
            & file//'its numbers must be finite', error)
         if (allocated(error)) return
         call require(symmetric(r%mass, 1.0_wp), file//'mass: must be symmetric', error)
         call require(symmetric(r%stiffness, 1.0_wp), file//'stiffness: must be symmetric', error)
         call require(symmetric(r%gyroscopic, -1.0_wp), file//'gyroscopic: must change its sign when it ' &
            & //'is transposed', error)
      end associate
      if (allocated(error)) return
      component = given_component(given)
      call check_translation(component, file, translation, error)
      if (.not. allocated(error)) call check_free(component, file, translation, error)
      if (.not. allocated(error)) call check_stations(inputs, component, file, error)
   end subroutine check_given

   !> The mass matrix is that of a body whose translation along y moves all stations, weighs `weighed` and has its mass.
   subroutine check_translation(component, file, translation, error)
      type(rotor_component_type), intent(in) :: component
      character(len=*), intent(in) :: file
      real(wp), allocatable, intent(out) :: translation(:)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), allocatable :: factor(:, :), right(:, :), moved(:, :)
      integer :: n, k, info
      n = component%mass%rows
      k = component%mass%half_band_width()
      factor = component%mass%band(0, k)
      call dpbtrf('U', n, k, factor, k + 1, info)
      call require(info == 0, file//'mass: must be positive definite', error)
      if (allocated(error)) return
      right = reshape(component%weighed, [n, 1])
      call dpbtrs('U', n, k, 1, factor, k + 1, right, n, info)
      translation = right(:, 1)
      moved = reshape(component%station%times(translation), [2, component%station%rows/2])
      call require(all(abs(moved(1, :) - 1) <= alike) .and. all(abs(moved(2, :)) <= alike), file &
         & //'weighed: must be mass times a translation that moves all stations by 1 along y', error)
      associate (mass => dot_product(component%weighed, translation))
         call require(abs(component%total_mass - mass) <= alike*mass, file//'total_mass = ' &
            & //to_text(component%total_mass)//': must be that of the translation in weighed, '//to_text(mass) &
            & //' kg', error)
      end associate
   end subroutine check_translation

   !> A shaft that bearings alone hold does not resist being moved as a whole.
   subroutine check_free(component, file, translation, error)
      type(rotor_component_type), intent(in) :: component
      character(len=*), intent(in) :: file
      real(wp), intent(in) :: translation(:)
      type(error_type), allocatable, intent(inout) :: error
      type(sparse_matrix_type) :: terms
      real(wp) :: force(size(translation))
      force = component%stiffness%times(translation)
      terms = component%stiffness
      terms%value = abs(terms%value)
      associate (spring => dot_product(translation, force))
         call require(maxval(abs(force)) <= alike*maxval(terms%times(abs(translation))), file &
            & //'stiffness: resists a translation along y with '//to_text(spring)//' N/m; must be that of a free ' &
            & //'shaft, without springs to ground, which would carry what bearings are to carry', error)
      end associate
   end subroutine check_free

   !> Stations of the case exist; those of bearings are displacements of their own.
   subroutine check_stations(inputs, component, file, error)
      type(case_type), intent(in) :: inputs
      type(rotor_component_type), intent(in) :: component
      character(len=*), intent(in) :: file
      type(error_type), allocatable, intent(inout) :: error
      type(mount_type), allocatable :: mounts(:)
      integer :: stations, highest, b, row
      mounts = inputs%mounts()
      stations = component%station%rows/2
      highest = max(maxval(mounts%station), 0)
      associate (rotor => inputs%rotor%elastic)
         if (size(rotor%unbalances) > 0) highest = max(highest, maxval(rotor%unbalances%station))
         if (size(rotor%loads) > 0) highest = max(highest, maxval(rotor%loads%station))
         if (size(rotor%elements) > 0) highest = max(highest, maxval(rotor%elements%station), &
            & maxval(rotor%elements%to_station))
      end associate
      call require(highest <= stations, file//'has '//to_text(stations)//' stations, but station = ' &
         & //to_text(highest)//' is asked for', error)
      call require(size(inputs%rotor%elastic%discs) == 0, file//'a group disc has no effect: its matrices contain ' &
         & //'the discs', error)
      if (allocated(error)) return
      call check_rows('station', component%station, mounts%station, '')
      call check_rows('slope', component%slope, mounts(inputs%inclined())%station, &
         & '; bearing%shaft_slope = ''ignored'' needs none')
   contains
      subroutine check_rows(name, over, stations, otherwise)
         character(len=*), intent(in) :: name, otherwise
         type(sparse_matrix_type), intent(in) :: over
         integer, intent(in) :: stations(:)
         do b = 1, size(stations)
            do row = 2*stations(b) - 1, 2*stations(b)
               associate (elements => over%value(over%first(row):over%first(row + 1) - 1))
                  call require(size(elements) == 1 .and. all(abs(elements - 1) <= 0), file//name//': row ' &
                     & //to_text(row)//', of a bearing, must have one element 1 and otherwise 0'//otherwise, error)
               end associate
            end do
         end do
      end subroutine check_rows
   end subroutine check_stations

   !> Whether a matrix is `sign` times its transpose.
   pure logical function symmetric(matrix, sign)
      real(wp), intent(in) :: matrix(:, :), sign
      symmetric = maxval(abs(matrix - sign*transpose(matrix))) <= symmetry*maxval(abs(matrix))
   end function symmetric
end module rotor_factory
