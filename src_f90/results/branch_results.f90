!> What the file of a run says of its branches: names, dimensions and units as docs/results.md lists them.
module branch_results
   use kinds, only: wp, i8
   use errors, only: error_type
   use scene_parameter, only: scene_parameter_type
   use continuation, only: branch_point_type
   use special_points, only: special_point_type, kinds_of_points, kind_length
   use heat_balance, only: oil_temperatures_type
   use orbit_figures, only: orbit_figures_type
   use hdf5_file, only: hdf5_type
   use run_file, only: run_file_type
   implicit none (type, external)
   private
   public :: noted_point_type, branch_orbit_type, begin_branches, add_point, put_special_points, noted

   !> A special point as the file has it: its number among all points and among the kinds, and where it is.
   type :: noted_point_type
      integer :: point = 0, kind = 0, branch = 1
      real(wp) :: parameter = 0
      complex(wp) :: value = 0
   end type noted_point_type

   !> What an orbit has beside its figures: revolutions of the shaft, period, s, and intervals of its collocation.
   type :: branch_orbit_type
      integer :: revolutions = 1, intervals = 0
      real(wp) :: period = 0
   end type branch_orbit_type

   !> Points of a usual file.
   integer(i8), parameter :: usual_points = 100

contains

   !> Declares the series, over points, that `add_point` fills, in the same order.
   subroutine begin_branches(file, parameter, orbits, tilting, warm, pads, modes)
      type(run_file_type), intent(inout) :: file
      type(scene_parameter_type), intent(in) :: parameter
      !> Whether the branches are of periodic orbits; whether the pads tilt; whether the oil has temperatures.
      logical, intent(in) :: orbits, tilting, warm
      integer, intent(in) :: pads, modes
      character(len=:), allocatable :: frozen
      integer :: i
      frozen = ''
      if (warm) frozen = ', at frozen viscosity'
      if (.not. file%file%has('mode')) call file%file%put_list('mode', [(real(i, wp), i=1, modes)], '1', &
         & merge('multiplier number', 'eigenvalue number', orbits), 'mode')
      call file%begin_series('point', usual_points)
      call one('point', '1', 'point number')
      call one('branch', '1', 'branch number: 1 the first, then those of double period')
      call one('parameter', parameter%unit, parameter%meaning)
      call one('arc_length', '1', 'length of the branch')
      call one('stable', '1', '1 where small disturbances die away'//frozen)
      call one('iterations', '1', 'iterations of Newton''s method')
      call one('journal_y_max', 'm', 'highest journal displacement, vertical')
      call one('journal_y_min', 'm', 'lowest journal displacement, vertical')
      call one('journal_z_max', 'm', 'highest journal displacement, horizontal')
      call one('journal_z_min', 'm', 'lowest journal displacement, horizontal')
      if (tilting) then
         call each('pad_tilt_max', 'rad', 'highest pad tilt', pads, 'pad')
         call each('pad_tilt_min', 'rad', 'lowest pad tilt', pads, 'pad')
      end if
      call each('min_film_thickness', 'm', 'minimum film thickness', pads, 'pad')
      if (warm) then
         call each('inlet_temperature', 'degC', 'temperature of the oil at the leading edge', pads, 'pad')
         call each('mean_temperature', 'degC', 'mean temperature of the film', pads, 'pad')
         call each('outlet_temperature', 'degC', 'temperature of the oil at the trailing edge', pads, 'pad')
         call each('maximum_temperature', 'degC', 'maximum temperature of the pad', pads, 'pad')
         call each('viscosity', 'Pa s', 'viscosity of the film', pads, 'pad')
         call one('shaft_temperature', 'degC', 'temperature of the shaft')
         call one('drain_temperature', 'degC', 'temperature of the oil that leaves the bearing')
      end if
      if (orbits) then
         call one('journal_y_amplitude', 'm', 'vertical journal vibration with the shaft, amplitude')
         call one('journal_y_phase', 'rad', 'angle by which it comes after the unbalance')
         call one('journal_z_amplitude', 'm', 'horizontal journal vibration with the shaft, amplitude')
         call one('journal_z_phase', 'rad', 'angle by which it comes after the unbalance')
         call one('period', 's', 'period of the orbit')
         call one('revolutions', '1', 'revolutions of the shaft in a period')
         call one('intervals', '1', 'intervals of the collocation')
         call each('multiplier_real', '1', 'multiplier, real part'//frozen, modes, 'mode')
         call each('multiplier_imag', '1', 'multiplier, imaginary part'//frozen, modes, 'mode')
      else
         call each('eigenvalue_real', '1/s', 'eigenvalue, real part'//frozen, modes, 'mode')
         call each('eigenvalue_imag', '1/s', 'eigenvalue, imaginary part'//frozen, modes, 'mode')
      end if
   contains
      subroutine one(name, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         call file%table%declare(file%file, name, 1, '', units, long_name)
      end subroutine one

      subroutine each(name, units, long_name, width, across)
         character(len=*), intent(in) :: name, units, long_name, across
         integer, intent(in) :: width
         call file%table%declare(file%file, name, width, across, units, long_name)
      end subroutine each
   end subroutine begin_branches

   !> Adds a point of a branch; of an equilibrium without `orbit`, of oil that has no temperatures without `oil`.
   subroutine add_point(file, branch, point, figures, tilting, error, oil, viscosity, orbit)
      type(run_file_type), intent(inout) :: file
      integer, intent(in) :: branch
      type(branch_point_type), intent(in) :: point
      type(orbit_figures_type), intent(in) :: figures
      logical, intent(in) :: tilting
      type(error_type), allocatable, intent(out) :: error
      type(oil_temperatures_type), intent(in), optional :: oil
      !> Of warm oil on every pad, Pa s.
      real(wp), intent(in), optional :: viscosity(:)
      type(branch_orbit_type), intent(in), optional :: orbit
      real(wp), allocatable :: values(:)
      associate (f => figures)
         values = [real(file%samples() + 1, wp), real(branch, wp), point%parameter, point%arc_length, &
            & merge(1.0_wp, 0.0_wp, all(point%growth < 0)), real(point%iterations, wp), f%highest(1), f%lowest(1), &
            & f%highest(2), f%lowest(2)]
         if (tilting) values = [values, f%highest_tilt, f%lowest_tilt]
         values = [values, f%film]
         if (present(oil)) values = [values, oil%inlet, oil%mean, oil%outlet, oil%maximum, viscosity, oil%shaft, &
            & oil%drain]
         if (present(orbit)) values = [values, f%amplitude(1), f%phase(1), f%amplitude(2), f%phase(2), orbit%period, &
            & real(orbit%revolutions, wp), real(orbit%intervals, wp)]
         values = [values, point%values%re, point%values%im]
      end associate
      call file%table%add(file%file, values)
      call file%error_of(error)
   end subroutine add_point

   !> How a special point of a branch is noted that is the last point of the file.
   type(noted_point_type) function noted(file, branch, special)
      type(run_file_type), intent(in) :: file
      integer, intent(in) :: branch
      type(special_point_type), intent(in) :: special
      noted = noted_point_type(int(file%samples()), findloc(kinds_of_points, special%kind, dim=1), branch, &
         & special%point%parameter, special%value)
   end function noted

   !> Writes the special points anew, if there are any.
   subroutine put_special_points(file, special, parameter)
      type(hdf5_type), intent(inout) :: file
      type(noted_point_type), intent(in) :: special(:)
      type(scene_parameter_type), intent(in) :: parameter
      character(len=*), parameter :: over = 'special_points/point'
      character(len=kind_length) :: kinds(size(special))
      call file%delete('special_points')
      if (size(special) == 0) return
      call file%make_group('special_points')
      kinds = kinds_of_points(special%kind)
      call file%put_list(over, real(special%point, wp), '1', 'number of the point', over)
      call file%put_labels('special_points/kind', kinds, 'kind of special point')
      call file%put_list('special_points/parameter', special%parameter, parameter%unit, parameter%meaning, over)
      call file%put_list('special_points/branch', real(special%branch, wp), '1', 'branch number', over)
      call file%put_list('special_points/value_real', special%value%re, '1', &
         & 'multiplier or eigenvalue (1/s) that crosses, real part', over)
      call file%put_list('special_points/value_imag', special%value%im, '1', &
         & 'multiplier or eigenvalue (1/s) that crosses, imaginary part', over)
   end subroutine put_special_points
end module branch_results
