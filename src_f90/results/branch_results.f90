!> What the file of a run says of its branches: names, dimensions and units as docs/results.md lists them.
module branch_results
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, i8, pi
   use errors, only: error_type, raise, system_error
   use text, only: to_text
   use newton_method, only: branch_point_type, curve_place_type
   use bifurcation_curve, only: curve_type
   use continuation, only: bifurcation_type, kinds_of_points, kind_length
   use heat_balance, only: oil_temperatures_type
   use state_layout, only: tilt
   use equations_of_motion, only: machine_model
   use orbit_figures, only: orbit_figures_type, whirl_figures_type, bearing_figures_type
   use record, only: record_type
   use run_file, only: run_file_type
   use bearing_file, only: bearing_file_type, new_bearing_file
   use branch_progress, only: branch_progress_type
   implicit none (type, external)
   private
   public :: noted_point_type, begin_branches, add_point, put_bifurcations, noted, put_branches, get_branches

   !> A bifurcation point as the file has it: its number among all points and among the kinds, and where it is.
   type :: noted_point_type
      integer :: point = 0, kind = 0, branch = 1
      !> Of the first and, on a curve, the second parameter.
      real(wp) :: parameters(2) = 0
      complex(wp) :: value = 0
   end type noted_point_type

   !> Points of a usual file.
   integer(i8), parameter :: usual_points = 100

contains

   !> Series over points follow, with this many eigenvalues or (of periodic orbits) multipliers.
   subroutine begin_branches(file, orbits, modes)
      type(run_file_type), intent(inout) :: file
      logical, intent(in) :: orbits
      integer, intent(in) :: modes
      if (.not. file%has('mode')) call file%put_scale('mode', modes, merge('multiplier number', 'eigenvalue number', &
         & orbits))
      call file%begin_series('point', usual_points)
   end subroutine begin_branches

   !> Adds a point of a branch of a model; of oil that has no temperatures without `oil`.
   subroutine add_point(file, model, branches, point, figures, error, oil, viscosity)
      type(run_file_type), intent(inout), target :: file
      type(machine_model), intent(in) :: model
      type(branch_progress_type), intent(in) :: branches
      type(branch_point_type), intent(in) :: point
      type(orbit_figures_type), intent(in) :: figures
      type(error_type), allocatable, intent(out) :: error
      !> In each bearing.
      type(oil_temperatures_type), intent(in), optional :: oil(:)
      !> Of warm oil on every pad, Pa s.
      real(wp), intent(in), optional :: viscosity(:)
      type(bearing_file_type) :: part
      character(len=:), allocatable :: frozen
      real(wp), allocatable :: all_values(:)
      real(wp) :: values(2)
      logical :: first
      integer :: b
      ! long: a list of what the file has of a point
      first = .not. file%hdf5%declared
      all_values = [real(wp) ::]
      frozen = ''
      if (present(oil)) frozen = ', at frozen viscosity'
      part = new_bearing_file(file)
      call one('point', real(file%hdf5%samples + 1, wp), '1', 'point number')
      call one('branch', real(branches%branch, wp), '1', 'branch number: 1 the first, then those of double period')
      values = branches%values_at(point)
      associate (parameter => branches%parameter)
         call one('parameter', values(1), trim(parameter%unit), parameter%meaning)
      end associate
      call one('arc_length', point%arc_length, '1', 'length of the branch')
      if (allocated(branches%curve)) then
         call put_curve(branches%curve, point%curve)
      else
         call one('stable', merge(1.0_wp, 0.0_wp, all(point%growth < 0)), '1', &
            & '1 where small disturbances die away'//frozen)
      end if
      call one('iterations', real(point%iterations, wp), '1', 'iterations of Newton''s method')
      if (figures%revolutions > 0) then
         call one('period', figures%period, 's', 'period of the orbit')
         call one('revolutions', figures%revolutions, '1', 'revolutions of the shaft in a period')
         if (figures%is_cycle) call put_cycle()
         call one('intervals', real(figures%intervals, wp), '1', 'intervals of the collocation')
         call each('multiplier_real', real(point%values, wp), '1', 'multiplier, real part'//frozen, 'mode')
         call each('multiplier_imag', aimag(point%values), '1', 'multiplier, imaginary part'//frozen, 'mode')
      else
         call each('eigenvalue_real', real(point%values, wp), '1/s', 'eigenvalue, real part'//frozen, 'mode')
         call each('eigenvalue_imag', aimag(point%values), '1/s', 'eigenvalue, imaginary part'//frozen, 'mode')
      end if
      call put_whirls('station_', figures%stations, 'displacement of the station', 'vibration of the station', &
         & 'station')
      call put_elements()
      do b = 1, size(figures%bearings)
         part = new_bearing_file(file, model%inputs%bearings(b))
         call put_bearing(figures%bearings(b), model%layout%elements(b)%has(tilt))
         if (present(oil)) call put_oil(oil(b), viscosity(model%layout%elements(b)%all_pads()))
      end do
      call file%hdf5%add(all_values)
      call file%error_of(error)
   contains
      !> Of a point of a curve, whose orbit is none on its stable side.
      subroutine put_curve(curve, at)
         type(curve_type), intent(in) :: curve
         type(curve_place_type), intent(in) :: at
         real(wp) :: frequency, rotation
         call one('second_parameter', values(2), trim(curve%line%second%unit), curve%line%second%meaning)
         call one('stable', merge(1.0_wp, 0.0_wp, at%others_stable), '1', '1 where small disturbances die away on ' &
            & //'the stable side'//frozen)
         call one('stable_side', at%stable_side, '1', '1: at larger values of the parameter, -1: at smaller ones; of ' &
            & //'folds where the two solutions are that meet')
         frequency = 0
         if (curve%kind == 'hopf') frequency = abs(at%value%im)/(2*pi)
         if (curve%of_multipliers) then
            rotation = merge(1.0_wp, atan2(abs(at%value%im), at%value%re)/(2*pi), figures%is_cycle)
            frequency = rotation/figures%period
         end if
         if (curve%kind == 'hopf') call one('born_side', born_side(at), '1', '1: the small limit cycles that begin ' &
            & //'there are at larger values of the parameter, -1: at smaller ones; 0: not known')
         if (curve%kind == 'neimark_sacker') call one('rotation_number', rotation, '1', 'angle of the multipliers ' &
            & //'over the full circle: turns of a disturbance in a period of the orbit, or whole ones more or less')
         if (curve%kind /= 'fold' .or. figures%is_cycle) then
            call one('frequency', frequency, 'Hz', 'frequency of the vibration that begins')
            call one('frequency_ratio', 2*pi*frequency/branches%speed(), '1', 'this frequency over that of ' &
               & //'the shaft')
         end if
      end subroutine put_curve

      !> Where cycles are of a Hopf point.
      pure real(wp) function born_side(at)
         type(curve_place_type), intent(in) :: at
         born_side = 0
         if (abs(at%tests(5)) > 0) born_side = at%stable_side*sign(1.0_wp, at%tests(5))
      end function born_side

      subroutine put_elements()
         call put_whirls('element_', figures%elements, 'displacement of the element''s station from its other end', &
            & 'vibration of the element', 'element')
         call each('damper_eccentricity', figures%eccentricities, '1', 'largest displacement of the damper''s ring ' &
            & //'over its clearance', 'damper')
      end subroutine put_elements

      subroutine put_cycle()
         call one('whirl_ratio', 1/figures%revolutions, '1', 'frequency of the limit cycle over that of the shaft')
         call one('trivial_multiplier_error', figures%trivial_error, '1', 'error of the multiplier along the ' &
            & //'motion, which is 1 and is left out')
      end subroutine put_cycle

      subroutine put_bearing(of, tilting)
         type(bearing_figures_type), intent(in) :: of
         logical, intent(in) :: tilting
         call put_whirls('journal_', [of%journal], 'journal displacement', 'journal vibration', '')
         if (tilting) then
            call each('pad_tilt_max', of%highest_tilt, 'rad', 'highest pad tilt', 'pad')
            call each('pad_tilt_min', of%lowest_tilt, 'rad', 'lowest pad tilt', 'pad')
         end if
         call each('min_film_thickness', of%film, 'm', 'minimum film thickness', 'pad')
      end subroutine put_bearing

      !> How far stations or a journal go along y and z, and in an orbit their vibration.
      subroutine put_whirls(name, whirls, displacement, vibration, across)
         character(len=*), intent(in) :: name, displacement, vibration, across
         type(whirl_figures_type), intent(in) :: whirls(:)
         character(len=*), parameter :: directions(2) = [character(len=10) :: 'vertical', 'horizontal']
         character(len=:), allocatable :: series, direction, with
         integer :: axis, i
         with = ' with the shaft'
         if (figures%is_cycle) with = ' at the frequency of the limit cycle'
         do axis = 1, 2
            series = name//'yz'(axis:axis)
            direction = trim(directions(axis))
            call each(series//'_max', [(whirls(i)%highest(axis), i=1, size(whirls))], 'm', &
               & 'highest '//displacement//', '//direction, across)
            call each(series//'_min', [(whirls(i)%lowest(axis), i=1, size(whirls))], 'm', &
               & 'lowest '//displacement//', '//direction, across)
            if (.not. figures%revolutions > 0) cycle
            call each(series//'_amplitude', [(whirls(i)%amplitude(axis), i=1, size(whirls))], 'm', &
               & direction//' '//vibration//with//', amplitude', across)
            if (figures%is_cycle) cycle
            call each(series//'_phase', [(whirls(i)%phase(axis), i=1, size(whirls))], 'rad', &
               & direction//' '//vibration//with//', phase behind the unbalance', across)
         end do
      end subroutine put_whirls

      subroutine put_oil(oil, viscosity)
         type(oil_temperatures_type), intent(in) :: oil
         real(wp), intent(in) :: viscosity(:)
         call each('inlet_temperature', oil%inlet, 'degC', 'temperature of the oil at the leading edge', 'pad')
         call each('mean_temperature', oil%mean, 'degC', 'mean temperature of the film', 'pad')
         call each('outlet_temperature', oil%outlet, 'degC', 'temperature of the oil at the trailing edge', 'pad')
         call each('maximum_temperature', oil%maximum, 'degC', 'maximum temperature of the pad', 'pad')
         call each('viscosity', viscosity, 'Pa s', 'viscosity of the film', 'pad')
         call one('shaft_temperature', oil%shaft, 'degC', 'temperature of the shaft')
         call one('drain_temperature', oil%drain, 'degC', 'temperature of the oil that leaves the bearing')
      end subroutine put_oil

      subroutine one(name, value, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: value
         call each(name, [value], units, long_name, '')
      end subroutine one

      !> Of the run or of a bearing.
      subroutine each(name, values, units, long_name, across)
         character(len=*), intent(in) :: name, units, long_name, across
         real(wp), intent(in) :: values(:)
         if (size(values) == 0) return
         if (first) call part%declare(name, size(values), units, long_name, across)
         all_values = [all_values, values]
      end subroutine each
   end subroutine add_point

   !> How a bifurcation point of a branch is noted that is the last point of the file.
   type(noted_point_type) function noted(file, branches, special)
      type(run_file_type), intent(in) :: file
      type(branch_progress_type), intent(in) :: branches
      type(bifurcation_type), intent(in) :: special
      noted = noted_point_type(int(file%hdf5%samples), findloc(kinds_of_points, special%kind, dim=1), &
         & branches%branch, branches%values_at(special%point), special%value)
   end function noted

   !> Writes the bifurcation points anew, if there are any.
   subroutine put_bifurcations(file, special, branches)
      class(record_type), intent(inout) :: file
      type(noted_point_type), intent(in) :: special(:)
      type(branch_progress_type), intent(in) :: branches
      character(len=*), parameter :: over = 'bifurcations/point'
      character(len=kind_length) :: kinds(size(special))
      call file%delete('bifurcations')
      if (size(special) == 0) return
      kinds = kinds_of_points(special%kind)
      call file%put(over, real(special%point, wp), '1', 'number of the point', over)
      call file%put('bifurcations/kind', kinds, 'kind of bifurcation point')
      associate (parameter => branches%parameter)
         call file%put('bifurcations/parameter', special%parameters(1), trim(parameter%unit), parameter%meaning, over)
      end associate
      if (allocated(branches%curve)) call file%put('bifurcations/second_parameter', special%parameters(2), &
         & trim(branches%curve%line%second%unit), branches%curve%line%second%meaning, over)
      call file%put('bifurcations/branch', real(special%branch, wp), '1', 'branch number', over)
      call file%put('bifurcations/value_real', real(special%value, wp), '1', &
         & 'multiplier or eigenvalue (1/s) that crosses, real part', over)
      call file%put('bifurcations/value_imag', aimag(special%value), '1', &
         & 'multiplier or eigenvalue (1/s) that crosses, imaginary part', over)
   end subroutine put_bifurcations

   ! The checkpoint of a run of branches in its file: from it they go on to the last bit.

   !> Into the group of the checkpoint, which is there; the file has the bifurcation points, too.
   subroutine put_branches(file, branches, special)
      class(record_type), intent(inout) :: file
      type(branch_progress_type), intent(in) :: branches
      type(noted_point_type), intent(in) :: special(:)
      type(branch_point_type) :: point
      logical :: ok
      integer :: k
      call file%put('checkpoint/branch', int(branches%branch, i8), 'number of the branch that is followed')
      call file%put('checkpoint/points', int(branches%points, i8), 'its points so far')
      call file%put('checkpoint/step', branches%length, '1', 'length of its next step')
      if (size(special) > 0) call file%put('checkpoint/special_kinds', real(special%kind, wp), '1', &
         & 'kind of each bifurcation point: number in the list of all kinds')
      point = branches%here
      call pass_point(file, 'checkpoint/point', branches, point, .false., ok)
      do k = 1, size(branches%period_doublings)
         point = branches%period_doublings(k)
         call pass_point(file, doubling_name(k), branches, point, .false., ok)
      end do
   end subroutine put_branches

   !> The group of a period doubling from which a branch is still to be followed.
   function doubling_name(k) result(name)
      integer, intent(in) :: k
      character(len=:), allocatable :: name
      name = 'checkpoint/flip_'//to_text(k)
   end function doubling_name

   !> A point, into a group or, with `reading`, out of it: the one list of what is kept of it. `ok` becomes false where
   !> a number that was read is none.
   subroutine pass_point(file, group, branches, point, reading, ok)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: group
      type(branch_progress_type), intent(in) :: branches
      type(branch_point_type), intent(inout) :: point
      logical, intent(in) :: reading
      logical, intent(inout) :: ok
      character(len=:), allocatable :: units
      integer :: k
      call number('value', point%parameter, trim(branches%parameter%unit), branches%parameter%meaning)
      call number('arc_length', point%arc_length, '1', 'length of the branch up to the point')
      call number('along', point%along, '1', 'length of the step to it')
      call numbers('change', point%change, '1', 'correction from where the equations were linearised')
      call numbers('tangent', point%tangent, '1', 'unit tangent of the branch')
      call numbers('growth', point%growth, '1', 'how far each eigenvalue or multiplier is on the unstable side')
      if (allocated(branches%curve)) call pass_curve(point%curve)
      if (reading) call branches%problem%get_place(point%place)
      do k = 1, size(point%place)
         associate (part => point%place(k))
            units = trim(part%units)
            if (units == '') units = trim(branches%parameter%unit)
            call numbers(trim(part%name), part%values, units, trim(part%long_name))
         end associate
      end do
   contains
      !> What the next step depends on.
      subroutine pass_curve(at)
         type(curve_place_type), intent(inout) :: at
         real(wp), allocatable :: list(:)
         list = [at%origin, at%line, at%ahead, at%direction, at%turn, at%slope, at%value%re, at%value%im, at%tests]
         k = size(list)
         call numbers('curve', list, '1', 'line across the curve, where the curve leads, its slope, its value, tests')
         ok = ok .and. size(list) == k
         if (.not. (reading .and. ok)) return
         at = curve_place_type(list(1:2), list(3:4), list(5:6), list(7:8), list(9), list(10), cmplx(list(11), &
            & list(12), wp), list(13:17))
      end subroutine pass_curve

      subroutine number(name, value, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(inout) :: value
         if (reading) then
            value = file%get_real(group//'/'//name)
            ok = ok .and. ieee_is_finite(value)
         else
            call file%put(group//'/'//name, value, units, long_name)
         end if
      end subroutine number

      subroutine numbers(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), allocatable, intent(inout) :: values(:)
         if (reading) then
            values = file%get_all(group//'/'//name)
            ok = ok .and. all(ieee_is_finite(values))
         else if (size(values) > 0) then
            call file%put(group//'/'//name, values, units, long_name)
         end if
      end subroutine numbers
   end subroutine pass_point

   !> The same of branches that are ready to go on. An error where the file holds none of these numbers; `ok` is false
   !> where they cannot be a checkpoint.
   subroutine get_branches(file, path, branches, special, ok, error)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: path
      type(branch_progress_type), intent(inout) :: branches
      type(noted_point_type), allocatable, intent(out) :: special(:)
      logical, intent(out) :: ok
      type(error_type), allocatable, intent(out) :: error
      type(branch_point_type) :: point
      character(len=:), allocatable :: group
      ok = .false.
      if (.not. file%has('checkpoint/point')) then
         call raise(error, system_error, path//': its checkpoint is of another version of tiltpad; start the run anew')
         return
      end if
      branches%branch = nint(file%get_real('checkpoint/branch'))
      branches%points = nint(file%get_real('checkpoint/points'))
      branches%length = file%get_real('checkpoint/step')
      call get_special(file, special, ok)
      if (.not. file%has('checkpoint/step')) ok = .false.
      ok = ok .and. branches%branch > 0 .and. branches%points >= 0 .and. ieee_is_finite(branches%length)
      if (ok) call pass_point(file, 'checkpoint/point', branches, point, .true., ok)
      if (.not. ok) return
      branches%here = point
      do
         group = doubling_name(size(branches%period_doublings) + 1)
         if (.not. file%has(group)) exit
         call pass_point(file, group, branches, point, .true., ok)
         if (.not. ok) return
         branches%period_doublings = [branches%period_doublings, point]
      end do
   end subroutine get_branches

   subroutine get_special(file, special, ok)
      class(record_type), intent(inout) :: file
      type(noted_point_type), allocatable, intent(out) :: special(:)
      logical, intent(out) :: ok
      real(wp), allocatable, dimension(:) :: kind, point, branch, first, second, re, im
      integer :: k
      ok = .true.
      allocate (special(0))
      if (.not. file%has('checkpoint/special_kinds')) return
      kind = file%get_all('checkpoint/special_kinds')
      point = file%get_all('bifurcations/point')
      branch = file%get_all('bifurcations/branch')
      first = file%get_all('bifurcations/parameter')
      second = 0*first
      if (file%has('bifurcations/second_parameter')) second = file%get_all('bifurcations/second_parameter')
      re = file%get_all('bifurcations/value_real')
      im = file%get_all('bifurcations/value_imag')
      ok = all([size(point), size(branch), size(first), size(second), size(re), size(im)] == size(kind))
      if (ok) ok = all(kind >= 1 .and. kind <= size(kinds_of_points)) .and. all(abs([point, branch]) < huge(1))
      if (ok) special = [(noted_point_type(nint(point(k)), nint(kind(k)), nint(branch(k)), &
         & [first(k), second(k)], cmplx(re(k), im(k), wp)), k=1, size(kind))]
   end subroutine get_special
end module branch_results
