!> What a run writes and prints of its equilibrium: of each bearing the same, of a machine besides what is of the whole.
module equilibrium_notes
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp, pi, degree
   use text, only: filled
   use case_groups, only: bearing_type, station_element_type
   use case_inputs, only: case_type, longest_label
   use bearing_numbers, only: load, load_on_journal, specific_load, sommerfeld_number, of_supply
   use state_layout, only: tilt, pivot_deflection, pitch, yaw, of_journal
   use force_balance, only: stability_type
   use bearing_shape, only: bearing_shape_type
   use heat_balance, only: oil_temperatures_type
   use bearing_losses, only: pad_loss
   use equilibrium_record, only: equilibrium_type, static_figures_type, find_static_figures
   use equations_of_motion, only: machine_model
   use equilibrium, only: bearing_alone, part_of, bearing_loads
   use bearing_file, only: bearing_file_type
   use namelist_writer, only: first_equal
   use equilibrium_results, only: put_equilibrium, put_misalignment, put_journal_slope, put_stability, put_figures, &
      & put_temperatures, put_film_temperatures, put_oil
   use machine_results, only: put_machine_equilibrium, put_elements
   use bearing_samples, only: element_forces, element_positions, eccentricities
   use record, only: record_type
   use case_run, only: case_run_type
   implicit none (type, external)
   private
   public :: note_equilibrium

contains

   !> Writes an equilibrium with its losses, flows and remarks, and gives the films of the run its viscosities.
   subroutine note_equilibrium(run, static)
      type(case_run_type), intent(inout) :: run
      type(equilibrium_type), intent(in) :: static
      real(wp), allocatable :: loads(:, :), slopes(:)
      character(len=:), allocatable :: title
      integer :: b, as
      run%model%oil = static%oil
      run%computed = .true.
      call run%note_shapes()
      if (run%model%rotor%stations == 0) then
         call note_bearing(run, run%model, static, 1, 'equilibrium: ', .not. run%quiet, '; ' &
            & //stability_text(static%stability, 'journal', run%inputs%bearings(1)%tilting()))
         call put_stability(run%file, static)
         if (.not. run%quiet) call run%note_remarks(shown=.true.)
         return
      end if
      call put_stability(run%file, static)
      loads = bearing_loads(run%model, static)
      slopes = norm2(run%model%rotor%station_slopes(static%rotor), dim=1)
      slopes = slopes(run%inputs%bearings%station)
      call put_machine_equilibrium(run%file, run%model%rotor, static%rotor, loads)
      call note_elements(run, static)
      if (.not. run%quiet) call print_shaft(run%file)
      if (.not. run%quiet) print '(a)', 'equilibrium: '//stability_text(static%stability, 'shaft', &
         & any(run%inputs%bearings%tilting()))
      do b = 1, size(loads, 2)
         as = b
         if (.not. run%quiet) as = same_equilibrium(run, static, loads, slopes, b)
         title = run%inputs%bearings(b)%title()//filled('load y {.1}, z {.1} N, ', loads(:, b))
         call note_bearing(run, bearing_alone(run%model, b, loads(:, b), static%rotor), part_of(run%model, static, b), &
            & b, title, as == b .and. .not. run%quiet, '')
         call note_misalignment(run, static, slopes(b), b, as == b .and. .not. run%quiet)
         if (as < b .and. .not. run%quiet) print '(a)', title//'all else as of '//run%inputs%bearings(as)%label()
      end do
      if (.not. run%quiet) call run%note_remarks(shown=.true.)
   end subroutine note_equilibrium

   !> What acts on a machine beside its films: forces of elements, and where the rings of dampers are.
   subroutine note_elements(run, static)
      type(case_run_type), intent(inout) :: run
      type(equilibrium_type), intent(in) :: static
      type(machine_model) :: still
      real(wp), allocatable :: y(:), forces(:, :), positions(:, :), ratios(:)
      character(len=longest_label), allocatable :: labels(:)
      type(station_element_type), allocatable :: elements(:)
      integer :: i, n
      n = run%model%rotor%elements
      if (n + size(run%model%others) == 0) return
      y = run%model%static_state(static%rotor, static%pads)
      still = run%model
      call still%set_point(run%model%point%static())
      forces = element_forces(still, 0.0_wp, y)
      positions = element_positions(still, y)
      labels = run%inputs%element_labels()
      ratios = eccentricities(run%inputs, positions(:, n + 1:))
      call put_elements(run%file, forces, positions, ratios)
      if (run%quiet) return
      elements = run%inputs%station_elements()
      do i = 1, n
         print '(a)', trim(labels(i))//filled(' at station {}: force on the shaft y {.1}, z {.1} N', &
            & [real(wp) :: elements(i)%station, forces(:, i)])
      end do
      do i = 1, size(ratios)
         print '(a)', trim(labels(n + i))//filled(': ring at y {u.2}, z {u.2} um, eccentricity ratio {.4}', &
            & [positions(:, n + i), ratios(i)])
      end do
   end subroutine note_elements

   !> The first bearing that is as bearing b and whose films, journal and shaft are in the same equilibrium, but for
   !> digits that are not printed: it, or one before it.
   integer function same_equilibrium(run, static, loads, slopes, b) result(first)
      type(case_run_type), intent(in) :: run
      type(equilibrium_type), intent(in) :: static
      !> Of each bearing, N and rad.
      real(wp), intent(in) :: loads(:, :), slopes(:)
      integer, intent(in) :: b
      type(equilibrium_type) :: one, own
      own = part_of(run%model, static, b)
      do first = 1, b - 1
         if (first_equal(run%inputs, b) /= first_equal(run%inputs, first)) cycle
         one = part_of(run%model, static, first)
         if (agree(loads(:, first), loads(:, b)) .and. agree(one%rotor, own%rotor) &
            & .and. agree(one%pads%x(tilt), own%pads%x(tilt)) &
            & .and. agree(one%min_film_thickness, own%min_film_thickness) &
            & .and. agree([slopes(first)], [slopes(b)]) .and. .not. allocated(own%slopes)) return
      end do
   end function same_equilibrium

   !> Whether numbers of one kind are the same but for the digits that are not printed.
   pure logical function agree(one, other)
      real(wp), intent(in) :: one(:), other(:)
      agree = maxval(abs(one - other)) <= 1e-5_wp*maxval(abs(other))
   end function agree

   !> What the slope of the shaft in bearing b of a machine, rad, does to its films where they leave it out; else it.
   subroutine note_misalignment(run, static, slope, b, shown)
      type(case_run_type), intent(inout) :: run
      type(equilibrium_type), intent(in) :: static
      real(wp), intent(in) :: slope
      integer, intent(in) :: b
      logical, intent(in) :: shown
      type(bearing_file_type) :: file
      real(wp) :: misalignment
      file = run%bearing(b)
      associate (of => run%model%layout%elements(b))
         if (of%of_rotor > of_journal) then
            call put_journal_slope(file, static%rotor(of%slopes))
            if (shown) print '(a)', filled('  shaft slope in the bearing, which its films have: y {m.4}, z {m.4} ' &
               & //'mrad', static%rotor(of%slopes))
            return
         end if
      end associate
      misalignment = maxval(slope*run%inputs%bearings(b)%axial_length/2 &
         & /static%min_film_thickness(run%model%layout%elements(b)%all_pads()))
      call put_misalignment(file, misalignment)
      if (shown) print '(a)', filled('  shaft slope {m.4} mrad: from the middle to the end of the bearing the films ' &
         & //'change by {c.1} % of the minimum thickness, which is left out', [slope, misalignment])
   end subroutine note_misalignment

   !> Bearing b, of this model of it alone. `shown`: it is printed, too; title and ending are those of its first line.
   subroutine note_bearing(run, model, static, b, title, shown, ending)
      type(case_run_type), intent(inout) :: run
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(in) :: static
      integer, intent(in) :: b
      character(len=*), intent(in) :: title, ending
      logical, intent(in) :: shown
      type(static_figures_type) :: figures
      type(bearing_file_type) :: file
      file = run%bearing(b)
      associate (inputs => model%inputs, bearing => run%inputs%bearings(b))
         call put_equilibrium(file, static, model%bearings(1)%coordinates)
         call find_static_figures(model, static, figures)
         call put_figures(file, inputs, figures)
         if (allocated(figures%oil)) then
            call put_temperatures(file, figures%oil)
            call put_oil(file, 'equilibrium/', static%oil)
         end if
         if (allocated(static%films)) call put_film_temperatures(file, static%films(1))
         if (.not. shown) return
         call print_equilibrium(title, static, bearing, held_by()//ending)
         call print_figures(inputs, figures)
         if (allocated(figures%oil)) call print_temperatures(figures%oil, static%oil%viscosity)
         if (bearing%changes_shape()) call print_shape(bearing, run%shapes(b))
      end associate
   contains
      !> What holds a journal that is held.
      function held_by() result(said)
         character(len=:), allocatable :: said
         said = ''
         if (run%inputs%held%is_wanted()) said = filled(', held by a load of y {.1}, z {.1} N', &
            & load_on_journal(model%inputs))
      end function held_by
   end subroutine note_bearing

   !> The rotor of a machine: its mass, its kept modes and what those that are left out change.
   subroutine print_shaft(file)
      class(record_type), intent(in) :: file
      real(wp), allocatable :: frequencies(:)
      character(len=:), allocatable :: modes, damped
      frequencies = file%get_all('rotor/mode_frequency')
      modes = 'no modes besides'
      if (size(frequencies) > 0) modes = filled('{} modes up to {.1} Hz', [real(size(frequencies), wp), &
         & maxval(frequencies)])
      damped = ''
      associate (error => file%get_real('rotor/damping_error'))
         if (error > 0) damped = filled(' and by {} by their damping', [error])
         print '(a)', filled('rotor: {.1} kg, '//modes//'; amplitudes err by {} by modes left out (all stations: {})', &
            & [file%get_real('rotor/total_mass'), file%get_real('rotor/truncation_error'), &
            & file%get_real('rotor/station_error')])//damped
      end associate
   end subroutine print_shaft

   !> An equilibrium of a bearing, behind this title; `ending` ends its first line.
   subroutine print_equilibrium(title, static, bearing, ending)
      character(len=*), intent(in) :: title, ending
      type(equilibrium_type), intent(in) :: static
      type(bearing_type), intent(in) :: bearing
      character(len=:), allocatable :: pivot
      integer :: i
      print '(a)', title//filled('journal y {u.2}, z {u.2} um', static%rotor(:2))//ending
      do i = 1, size(static%pads)
         pivot = ''
         if (bearing%tilting()) pivot = filled('tilt {m.3} mrad, pivot deflection {u.2} um, contact {.1} N, ', &
            & [static%pads(i)%x(tilt), static%pads(i)%x(pivot_deflection), static%pivot_load(i)])
         if (bearing%pitching()) pivot = pivot//filled('pitch {m.4} mrad, ', static%pads(i)%x([pitch]))
         if (bearing%yawing()) pivot = pivot//filled('yaw {m.4} mrad, ', static%pads(i)%x([yaw]))
         if (allocated(static%slopes)) pivot = pivot//filled('films at both ends {u.2}, {u.2} um, ', &
            & static%slopes(i)%edge_films)
         print '(a)', filled('  pad {}: '//pivot//'minimum film thickness {u.2} um, maximum pressure {M.3} MPa', &
            & [real(wp) :: i, static%min_film_thickness(i), static%max_pressure(i)])
      end do
      if (allocated(static%moments)) print '(a)', filled('  moments on the journal against its slopes: y {.3}, ' &
         & //'z {.3} N m', static%moments(:, 1))
   end subroutine print_equilibrium

   !> "the journal is stable, the pads are unstable: oscillatory instability, eigenvalue 69.4 1/s at 37.0 Hz"; what is
   !> told of the pads where they tilt.
   function stability_text(found, rotor, tilting) result(text)
      type(stability_type), intent(in) :: found
      !> "journal" or "shaft".
      character(len=*), intent(in) :: rotor
      logical, intent(in) :: tilting
      character(len=:), allocatable :: text
      text = 'the '//rotor//' is'//trim(merge(' unstable', ' stable  ', found%rotor_grows))
      if (tilting) text = text//', the pads are'//trim(merge(' unstable', ' stable  ', found%pads_grow))
      text = text//': '
      if (found%name /= 'stable') text = text//found%name//', '
      text = text//filled('eigenvalue {.1} 1/s at {.1} Hz', [found%eigenvalue%re, found%eigenvalue%im/(2*pi)])
   end function stability_text

   !> Where the journal lies at the equilibrium, loads, losses and flows.
   subroutine print_figures(inputs, figures)
      type(case_type), intent(in) :: inputs
      type(static_figures_type), intent(in) :: figures
      character(len=:), allocatable :: of_load
      integer :: i
      of_load = ''
      if (load(inputs) > 0) of_load = filled(', attitude angle {.2} deg, specific load {M.3} MPa, Sommerfeld number ' &
         & //'{.4} (', [figures%attitude_angle/degree, specific_load(inputs), sommerfeld_number(inputs)]) &
         & //of_supply(inputs%bearings(1))//')'
      print '(a)', filled('  eccentricity ratio {.4}', [figures%eccentricity_ratio])//of_load
      associate (pads => figures%pads)
         do i = 1, size(pads)
            print '(a)', filled('  pad {}: load {.1} N, loss {.1} W, oil in {u.2}, out {u.2} and at the sides {u.2} ' &
               & //'ml/s, Reynolds number {.1}', [real(wp) :: i, pads(i)%load, pads(i)%power(), pads(i)%inlet, &
               & pads(i)%outlet, pads(i)%side, figures%reynolds_number(i)])//turbulence(pads(i))
         end do
         print '(a)', filled('  all pads: loss {.1} W, oil in {u.2}, at the sides {u.2} ml/s', [sum(pads%power()), &
            & sum(pads%inlet), sum(pads%side)])//warmer(figures%rise_fresh, ', oil warmer by ', 'fresh at every pad') &
            & //warmer(figures%rise_side, ' to ', 'fresh for the sides alone')
      end associate
   contains
      !> How turbulent a film is, where it may be.
      function turbulence(pad) result(said)
         type(pad_loss), intent(in) :: pad
         character(len=:), allocatable :: said
         said = ''
         if (inputs%bearings(1)%film%turbulence /= 'none') said = filled(' (at most {.1}; {.1} % turbulent)', &
            & [pad%largest_reynolds, 100*pad%turbulent_share])
      end function turbulence

      !> By how many K, and where; nothing where next to no oil flows.
      function warmer(rise, before, where_fresh)
         real(wp), intent(in) :: rise
         character(len=*), intent(in) :: before, where_fresh
         character(len=:), allocatable :: warmer
         warmer = ''
         if (.not. ieee_is_nan(rise)) warmer = before//filled('{.1} K (', [rise])//where_fresh//')'
      end function warmer
   end subroutine print_figures

   !> Temperatures of warm oil, C, and the viscosity of each pad's film, Pa s.
   subroutine print_temperatures(oil, viscosity)
      type(oil_temperatures_type), intent(in) :: oil
      real(wp), intent(in) :: viscosity(:)
      integer :: i
      do i = 1, size(viscosity)
         print '(a)', filled('  pad {}: oil comes in at {.1} C, leaves at {.1} C, mean {.1} C, {m.2} mPa s, pad at ' &
            & //'most {.1} C', [real(wp) :: i, oil%inlet(i), oil%outlet(i), oil%mean(i), viscosity(i), oil%maximum(i)])
      end do
      print '(a)', filled('  all pads: oil drains at {.1} C, shaft at {.1} C', [oil%drain, oil%shaft])
   end subroutine print_temperatures

   !> The clearances of a bearing and those in operation.
   subroutine print_shape(b, shape)
      type(bearing_type), intent(in) :: b
      type(bearing_shape_type), intent(in) :: shape
      character(len=:), allocatable :: bends
      integer :: i
      associate (t => shape%temperatures)
         do i = 1, size(shape%machined_clearance)
            bends = ''
            if (b%pads%bending /= 'none') bends = filled('; bends by {u.2} um by pressure and {u.2} um by heat', &
               & [shape%bending%elastic(i), shape%bending%thermal(i)])
            if (allocated(t%pads)) bends = bends//filled('; at {.1} C', [t%pads(i)])
            print '(a)', filled('  pad {}: pad clearance {u.2} um, in operation {u.2}; at the pivot {u.2} um, in ' &
               & //'operation {u.2}', [real(wp) :: i, b%machined_clearance(i), shape%machined_clearance(i), &
               & b%assembled_clearance(i), shape%assembled_clearance(i)])//bends
         end do
         if (allocated(t%pads)) print '(a)', filled('  all pads: clearances of {.1} C, the shaft at {.1} C and the ' &
            & //'housing at {.1} C', [b%clearance_temperature, t%shaft, t%housing])
      end associate
   end subroutine print_shape
end module equilibrium_notes
