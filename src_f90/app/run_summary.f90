!> What a run prints of its results.
module run_summary
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp, i8, pi, degree
   use text, only: to_text, fixed_text, micro, list_text
   use case_groups, only: bearing_type
   use case_inputs, only: case_type
   use result_size, only: size_note
   use case_remarks, only: behind
   use heat_balance, only: oil_temperatures_type
   use bearing_numbers, only: load, specific_load, sommerfeld_number, of_supply
   use state_layout, only: pad_state, tilt, pivot_deflection
   use force_balance, only: stability_type
   use equilibrium_record, only: equilibrium_type
   use static_figures, only: static_figures_type
   use record, only: record_type
   use summary_group, only: figure, pad_figures, has_figure
   implicit none (type, external)
   private
   public :: print_remarks, print_size, print_shaft, print_stations, print_start, print_equilibrium, stability_text, &
      & bearing_title, print_misalignment, print_figures, print_temperatures
   public :: print_march, print_cost

   !> s.
   real(wp), parameter :: thousand_hours = 3.6e6_wp

contains

   !> "bearing 'drive_end' at station 2: load y -19620.0, z 0.0 N, "; empty for a bearing without name.
   function bearing_title(bearing, load) result(title)
      type(bearing_type), intent(in) :: bearing
      !> Along y and z, N.
      real(wp), intent(in), optional :: load(2)
      character(len=:), allocatable :: title
      title = bearing%label(' at station '//to_text(bearing%station)//': ')
      if (present(load)) title = title//'load y '//fixed_text(load(1), 1)//', z '//fixed_text(load(2), 1)//' N, '
   end function bearing_title

   !> The rotor of a machine: its mass, its kept modes and what those that are left out change.
   subroutine print_shaft(file)
      class(record_type), intent(in) :: file
      real(wp), allocatable :: frequencies(:)
      character(len=:), allocatable :: modes
      frequencies = file%get_all('rotor/mode_frequency')
      modes = 'no modes besides'
      if (size(frequencies) > 0) modes = to_text(size(frequencies))//' modes up to ' &
         & //fixed_text(maxval(frequencies), 1)//' Hz'
      print '(a)', 'rotor: '//fixed_text(file%get_real('rotor/total_mass'), 1)//' kg, '//modes &
         & //'; amplitudes err by '//to_text(file%get_real('rotor/truncation_error'))//' by modes left out and by ' &
         & //to_text(file%get_real('rotor/damping_error'))//' by their damping'
   end subroutine print_shaft

   !> The stations that move most in the last revolution.
   subroutine print_stations(file)
      class(record_type), intent(in) :: file
      real(wp), allocatable :: y(:), z(:)
      integer :: of_y, of_z
      y = file%get_all('summary/station_y_size')
      z = file%get_all('summary/station_z_size')
      of_y = maxloc(y, dim=1)
      of_z = maxloc(z, dim=1)
      print '(a)', 'last revolution, shaft: moves most at station '//to_text(of_y)//' along y, ' &
         & //micro(y(of_y))//' um peak to peak, and at station '//to_text(of_z)//' along z, '//micro(z(of_z))//' um'
   end subroutine print_stations

   !> Remarks, a line each.
   subroutine print_remarks(lines)
      character(len=*), intent(in) :: lines
      write (*, '(a)', advance='no') behind('remark: ', lines)
   end subroutine print_remarks

   !> That the results of a case are large.
   subroutine print_size(inputs)
      type(case_type), intent(in) :: inputs
      if (size_note(inputs, 1) /= '') print '(a)', size_note(inputs, 1)
   end subroutine print_size

   !> Where a march starts that does not start at the equilibrium itself: displacements of the journals, which stand
   !> first, m, and states of the pads of all bearings.
   subroutine print_start(inputs, journals, pads)
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: journals(:)
      type(pad_state), intent(in) :: pads(:)
      character(len=:), allocatable :: tilts
      integer :: b, before
      before = 0
      do b = 1, size(inputs%bearings)
         associate (own => inputs%bearings(b))
            tilts = ''
            if (own%tilting()) tilts = ', tilts ' &
               & //list_text(1e3_wp*pads(before + 1:before + own%pad_count())%x(tilt), 4)//' mrad'
            before = before + own%pad_count()
            print '(a)', 'start from '''//inputs%start%from//''': '//bearing_title(own)//'journal y ' &
               & //micro(journals(2*b - 1))//', z '//micro(journals(2*b))//' um'//tilts
         end associate
      end do
   end subroutine print_start

   !> An equilibrium of a bearing, behind this title; `ending` ends its first line.
   subroutine print_equilibrium(title, static, tilting, ending)
      character(len=*), intent(in) :: title, ending
      type(equilibrium_type), intent(in) :: static
      logical, intent(in) :: tilting
      character(len=:), allocatable :: pivot
      integer :: i
      print '(a)', title//'journal y '//micro(static%rotor(1))//', z '//micro(static%rotor(2))//' um'//ending
      do i = 1, size(static%pads)
         pivot = ''
         if (tilting) pivot = 'tilt '//milli(static%pads(i)%x(tilt))//' mrad, pivot deflection ' &
            & //micro(static%pads(i)%x(pivot_deflection))//' um, contact '//fixed_text(static%pivot_load(i), 1)//' N, '
         print '(a)', '  pad '//to_text(i)//': '//pivot//'minimum film thickness ' &
            & //micro(static%min_film_thickness(i))//' um, maximum pressure '//mega(static%max_pressure(i))//' MPa'
      end do
   end subroutine print_equilibrium

   !> What the slope of the shaft in a bearing, rad, changes of its films, as a part of the minimum thickness.
   subroutine print_misalignment(slope, misalignment)
      real(wp), intent(in) :: slope, misalignment
      print '(a)', '  shaft slope '//milli(slope)//' mrad: from the middle to the end of the bearing the films ' &
         & //'change by '//fixed_text(100*misalignment, 1)//' % of the minimum thickness, which is left out'
   end subroutine print_misalignment

   !> "the journal is stable, the pads are unstable: oscillatory instability, eigenvalue 69.4 1/s at 37.0 Hz"; what is
   !> told of the pads where they tilt.
   function stability_text(found, rotor, tilting) result(text)
      type(stability_type), intent(in) :: found
      !> "journal" or "shaft".
      character(len=*), intent(in) :: rotor
      logical, intent(in) :: tilting
      character(len=:), allocatable :: text
      text = 'the '//rotor//' is'//verdict(found%rotor_grows)
      if (tilting) text = text//', the pads are'//verdict(found%pads_grow)
      text = text//': '
      if (found%name /= 'stable') text = text//found%name//', '
      text = text//'eigenvalue '//fixed_text(found%eigenvalue%re, 1)//' 1/s at ' &
         & //fixed_text(found%eigenvalue%im/(2*pi), 1)//' Hz'
   contains
      function verdict(grows)
         logical, intent(in) :: grows
         character(len=:), allocatable :: verdict
         verdict = trim(merge(' unstable', ' stable  ', grows))
      end function verdict
   end function stability_text

   !> Where the journal lies at the equilibrium, loads, losses and flows.
   subroutine print_figures(inputs, figures)
      type(case_type), intent(in) :: inputs
      type(static_figures_type), intent(in) :: figures
      character(len=:), allocatable :: of_load
      integer :: i
      of_load = ''
      if (load(inputs) > 0) of_load = ', attitude angle '//fixed_text(figures%attitude_angle/degree, 2) &
         & //' deg, specific load '//mega(specific_load(inputs))//' MPa, Sommerfeld number ' &
         & //fixed_text(sommerfeld_number(inputs), 4)//' ('//of_supply(inputs%bearings(1))//')'
      print '(a)', '  eccentricity ratio '//fixed_text(figures%eccentricity_ratio, 4)//of_load
      do i = 1, size(figures%pads)
         associate (pad => figures%pads(i))
            print '(a)', '  pad '//to_text(i)//': load '//fixed_text(pad%load, 1)//' N, loss ' &
               & //fixed_text(pad%power(), 1)//' W, oil in '//micro(pad%inlet)//', out '//micro(pad%outlet) &
               & //' and at the sides '//micro(pad%side)//' ml/s, Reynolds number ' &
               & //fixed_text(figures%reynolds_number(i), 1)
         end associate
      end do
      associate (pads => figures%pads)
         print '(a)', '  all pads: loss '//fixed_text(sum(pads%power()), 1)//' W, oil in '//micro(sum(pads%inlet)) &
            & //', at the sides '//micro(sum(pads%side))//' ml/s'//warmer(figures%rise_fresh, ', oil warmer by ', &
            & 'fresh at every pad')//warmer(figures%rise_side, ' to ', 'fresh for the sides alone')
      end associate

   contains

      !> By how many K, and where; nothing where next to no oil flows.
      function warmer(rise, before, where_fresh)
         real(wp), intent(in) :: rise
         character(len=*), intent(in) :: before, where_fresh
         character(len=:), allocatable :: warmer
         warmer = ''
         if (.not. ieee_is_nan(rise)) warmer = before//fixed_text(rise, 1)//' K ('//where_fresh//')'
      end function warmer
   end subroutine print_figures

   !> Temperatures of warm oil, C, and the viscosity of each pad's film, Pa s.
   subroutine print_temperatures(oil, viscosity)
      type(oil_temperatures_type), intent(in) :: oil
      real(wp), intent(in) :: viscosity(:)
      integer :: i
      do i = 1, size(viscosity)
         print '(a)', '  pad '//to_text(i)//': oil comes in at '//fixed_text(oil%inlet(i), 1)//' C, leaves at ' &
            & //fixed_text(oil%outlet(i), 1)//' C, mean '//fixed_text(oil%mean(i), 1)//' C, ' &
            & //fixed_text(1e3_wp*viscosity(i), 2)//' mPa s, pad at most '//fixed_text(oil%maximum(i), 1)//' C'
      end do
      print '(a)', '  all pads: oil drains at '//fixed_text(oil%drain, 1)//' C, shaft at '//fixed_text(oil%shaft, 1) &
         & //' C'
   end subroutine print_temperatures

   !> Figures of a bearing in the last revolution (or in what there is), behind this title; of pivots where pads tilt.
   subroutine print_march(title, file, tilting)
      character(len=*), intent(in) :: title
      class(record_type), intent(in) :: file
      logical, intent(in) :: tilting
      character(len=:), allocatable :: before, after
      integer :: i
      print '(a)', title//'journal y '//micro(figure(file, 'journal_y_min'))//' to ' &
         & //micro(figure(file, 'journal_y_max'))//', z '//micro(figure(file, 'journal_z_min'))//' to ' &
         & //micro(figure(file, 'journal_z_max'))//' um'
      before = ''
      after = ''
      associate (lowest => pad_figures(file, 'pad_tilt_min'), highest => pad_figures(file, 'pad_tilt_max'), &
            & contact => pad_figures(file, 'pad_contact_force'), work => pad_figures(file, 'pad_friction_work'), &
            & worn => pad_figures(file, 'pad_wear_rate'), deep => pad_figures(file, 'pad_wear_depth_rate'), &
            & film => pad_figures(file, 'pad_min_film_thickness'), pressure => pad_figures(file, 'pad_max_pressure'))
         do i = 1, size(film)
            if (tilting) then
               before = 'tilt '//milli(lowest(i))//' to '//milli(highest(i))//' mrad, '
               after = ', mean contact '//fixed_text(contact(i), 1)//' N'
               if (has_figure(file, 'pad_friction_work')) after = after//', friction work ' &
                  & //fixed_text(1e3_wp*work(i), 3)//' mJ'
               if (has_figure(file, 'pad_wear_rate')) after = after//', wear ' &
                  & //fixed_text(1e9_wp*thousand_hours*worn(i), 2)//' mm^3'//depth_text(deep(i))//' in 1000 h'
            end if
            print '(a)', '  pad '//to_text(i)//': '//before//'minimum film thickness '//micro(film(i)) &
               & //' um, maximum pressure '//mega(pressure(i))//' MPa'//after
         end do
      end associate
   end subroutine print_march

   !> Depth worn off at this rate, m/s, " and 2.68 um"; empty where it is not known.
   function depth_text(rate) result(text)
      real(wp), intent(in) :: rate
      character(len=:), allocatable :: text
      text = ''
      if (.not. ieee_is_nan(rate)) text = ' and '//fixed_text(1e6_wp*thousand_hours*rate, 2)//' um'
   end function depth_text

   !> What a run cost.
   subroutine print_cost(file)
      class(record_type), intent(in) :: file
      print '(a)', 'cost: '//number('steps')//' steps, '//number('rhs_evaluations')//' right-hand sides, ' &
         & //number('jacobian_evaluations')//' Jacobians, films '//number('film_table')//' from tables (' &
         & //number('film_cells')//' cells, '//number('film_nodes')//' cavitated nodes), '//number('film_fourier') &
         & //' by axial Fourier expansion and '//number('film_volumes')//' on finite volumes ('//number('film_passes') &
         & //' passes over their cells)'
      print '(a)', '  wall time '//duration('wall_seconds')//' s, of which film '//duration('film_seconds') &
         & //' s and samples '//duration('output_seconds')//' s'
   contains
      function number(name)
         character(len=*), intent(in) :: name
         character(len=:), allocatable :: number
         number = to_text(nint(file%get_real('statistics/'//name), i8))
      end function number

      function duration(name)
         character(len=*), intent(in) :: name
         character(len=:), allocatable :: duration
         duration = fixed_text(file%get_real('statistics/'//name), 2)
      end function duration
   end subroutine print_cost

   !> Radians as milliradians, pascals as megapascals.
   function milli(x)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: milli
      milli = fixed_text(1e3_wp*x, 4)
   end function milli

   function mega(x)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: mega
      mega = fixed_text(1e-6_wp*x, 3)
   end function mega
end module run_summary
