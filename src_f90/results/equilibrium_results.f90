!> What the file of a run says of its equilibrium, of the oil of its films and of the shape of its bearings: names,
!> dimensions and units as docs/results.md lists them.
module equilibrium_results
   use kinds, only: wp
   use errors, only: error_type, raise, system_error
   use record, only: record_type
   use case_inputs, only: case_type
   use heat_balance, only: oil_temperatures_type
   use film_network, only: warm_films_type
   use film_energy, only: solid_layers
   use film_oils, only: film_oil, uneven_oil, weights_degree, polynomials
   use bearing_shape, only: bearing_shape_type
   use bearing_numbers, only: load, load_on_journal, specific_load, sommerfeld_number
   use tilting_pad, only: pad_coordinates_type
   use equilibrium_record, only: equilibrium_type, static_figures_type
   use summary_group, only: put_figure
   implicit none (type, external)
   private
   public :: put_equilibrium, put_misalignment, put_journal_slope, put_stability, put_figures, put_temperatures, &
      & put_film_temperatures
   public :: put_oil, read_oil, put_shape, read_shape

   !> The polynomials (film_oils), in their order.
   character(len=*), parameter :: names(polynomials) = [character(len=15) :: 'flow_weights', 'sliding_weights', &
      & 'shear_weights']
   character(len=*), parameter :: meanings(polynomials) = [character(len=12) :: 'ln(12 mu f2)', 'f1', 'ln(f0/mu)']

contains

   !> Writes the equilibrium of a bearing whose pads have these coordinates.
   subroutine put_equilibrium(file, found, coordinates)
      class(record_type), intent(inout) :: file
      type(equilibrium_type), intent(in) :: found
      class(pad_coordinates_type), intent(in) :: coordinates
      integer :: k
      call file%put('equilibrium/journal_y', found%rotor(1), 'm', 'journal displacement, vertical')
      call file%put('equilibrium/journal_z', found%rotor(2), 'm', 'journal displacement, horizontal')
      do k = 1, coordinates%n
         associate (of => coordinates%words(k))
            call file%put('equilibrium/'//trim(of%series), found%pads%x(coordinates%kind(k)), trim(of%units), &
               & trim(of%label), 'pad')
         end associate
      end do
      if (coordinates%n > 0) call file%put('equilibrium/pivot_load', found%pivot_load, 'N', 'pivot load', 'pad')
      call file%put('equilibrium/min_film_thickness', found%min_film_thickness, 'm', 'minimum film thickness', 'pad')
      call file%put('equilibrium/max_pressure', found%max_pressure, 'Pa', 'maximum film pressure', 'pad')
      if (allocated(found%slopes)) call put_slopes(file, found)
      call put_figure(file, 'equilibrium_min_film_thickness', minval(found%min_film_thickness), 'm', &
         & 'minimum film thickness at the equilibrium')
      call put_figure(file, 'equilibrium_max_pressure', maxval(found%max_pressure), 'Pa', &
         & 'maximum pressure at the equilibrium')
   end subroutine put_equilibrium

   !> Writes films at both ends, moments on the journal and where the pressure is highest.
   subroutine put_slopes(file, found)
      class(record_type), intent(inout) :: file
      type(equilibrium_type), intent(in) :: found
      call file%put('equilibrium/journal_moment_y', found%moments(1, 1), 'N m', &
         & 'moment on the journal against its vertical slope')
      call file%put('equilibrium/journal_moment_z', found%moments(2, 1), 'N m', &
         & 'moment on the journal against its horizontal slope')
      associate (slopes => found%slopes)
         call put('start_film_thickness', slopes%edge_films(1), 'm', 'minimum film thickness at the end of lower x')
         call put('end_film_thickness', slopes%edge_films(2), 'm', 'minimum film thickness at the end of higher x')
         call put('max_pressure_angle', slopes%place(1), 'rad', 'angle of the maximum pressure from the pivot')
         call put('max_pressure_axial', slopes%place(2), 'm', &
            & 'distance of the maximum pressure from the middle along the shaft')
      end associate
   contains
      subroutine put(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(:)
         call file%put('equilibrium/'//name, values, units, long_name, 'pad')
      end subroutine put
   end subroutine put_slopes

   !> Writes the slope of an elastic shaft in a bearing whose films have it, rad.
   subroutine put_journal_slope(file, slope)
      class(record_type), intent(inout) :: file
      real(wp), intent(in) :: slope(2)
      call file%put('equilibrium/journal_slope_y', slope(1), 'rad', 'slope of the shaft in the bearing, vertical')
      call file%put('equilibrium/journal_slope_z', slope(2), 'rad', 'slope of the shaft in the bearing, horizontal')
   end subroutine put_journal_slope

   !> Writes how much the slope of an elastic shaft in the bearing, which films leave out, changes their thickness.
   subroutine put_misalignment(file, misalignment)
      class(record_type), intent(inout) :: file
      real(wp), intent(in) :: misalignment
      call put_figure(file, 'misalignment', misalignment, '1', 'part of the minimum film thickness by which the ' &
         & //'slope of the shaft changes the film from the middle of the bearing to its end')
   end subroutine put_misalignment

   !> Writes how well forces balance at an equilibrium, and whether it is stable.
   subroutine put_stability(file, found)
      class(record_type), intent(inout) :: file
      type(equilibrium_type), intent(in) :: found
      call file%put('equilibrium/residual', found%residual, '1', 'unbalanced force over load')
      call file%put('equilibrium/eigenvalue_real', found%stability%eigenvalue%re, '1/s', &
         & 'growth of the small motion that grows most')
      call file%put('equilibrium/eigenvalue_imag', found%stability%eigenvalue%im, '1/s', &
         & 'angular frequency of the small motion that grows most')
      call file%put_text('equilibrium_stability', found%stability%name)
      call file%put_text('equilibrium_search', found%search)
      call put_figure(file, 'equilibrium_stable', merge(1.0_wp, 0.0_wp, found%stability%name == 'stable'), '1', &
         & '1 where the equilibrium is stable')
      call put_figure(file, 'equilibrium_rotor_stable', merge(0.0_wp, 1.0_wp, found%stability%rotor_grows), '1', &
         & '1 where journal or shaft is stable there, whatever the pads do')
   end subroutine put_stability

   !> Writes where the journal lies in the one bearing of a case, what the pads carry, losses, flows and temperature
   !> rises.
   subroutine put_figures(file, inputs, figures)
      class(record_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      type(static_figures_type), intent(in) :: figures
      call put('eccentricity_ratio', figures%eccentricity_ratio, '1', 'journal displacement over bearing clearance')
      call put('specific_load', specific_load(inputs), 'Pa', 'load over diameter and axial length')
      if (load(inputs) > 0) then
         call put('attitude_angle', figures%attitude_angle, 'rad', &
            & 'angle from the load to the journal displacement, in the sense of rotation')
         call put('sommerfeld_number', sommerfeld_number(inputs), '1', &
            & 'mu N L D/W (R_J/c_r)^2, mu of the oil as supplied')
      end if
      if (inputs%held%is_wanted()) then
         associate (force => load_on_journal(inputs))
            call put('bearing_load_y', force(1), 'N', 'load that holds the journal, vertical')
            call put('bearing_load_z', force(2), 'N', 'load that holds the journal, horizontal')
         end associate
      end if
      associate (pads => figures%pads)
         call put('load', pads%load, 'N', 'force of film and asperities on the journal')
         call put('power_loss', pads%power(), 'W', 'power loss')
         call put('couette_loss', pads%couette, 'W', 'Couette loss: power loss by the shear of sliding')
         call put('poiseuille_loss', pads%pressure, 'W', &
            & 'Poiseuille loss: power loss by the shear of the flow that pressure drives')
         if (inputs%bearings(1)%asperity%model /= 'none') call put('boundary_loss', pads%boundary, 'W', &
            & 'power loss by boundary friction of asperities')
         call put('journal_drag', pads%journal_drag, 'N m', &
            & 'moment of the film''s shear against the journal''s rotation')
         call put('pad_drag', pads%pad_drag, 'N m', &
            & 'moment of the film''s shear on the pad about the centre of its arc')
         call put('inlet_flow', pads%inlet, 'm^3/s', 'flow in at the leading edge')
         call put('outlet_flow', pads%outlet, 'm^3/s', 'flow out at the trailing edge')
         call put('side_flow', pads%side, 'm^3/s', 'flow out at both sides')
         call put('reformation_flow', pads%reformation, 'm^3/s', &
            & 'flow that the film takes up at the reformation boundary beyond what reaches it')
         call put('temperature_rise', figures%temperature_rise, 'K', 'warming of the oil from leading to trailing edge')
         call put('reynolds_number', figures%reynolds_number, '1', 'rho U h/mu with the mean film thickness')
         if (inputs%bearings(1)%film%turbulence /= 'none') then
            call put('largest_reynolds_number', pads%largest_reynolds, '1', 'largest local rho U h/mu of the film')
            call put('turbulent_share', pads%turbulent_share, '1', &
               & 'share of turbulence, mean over the arc')
         end if
         call put('total_power_loss', sum(pads%power()), 'W', 'power loss of all pads')
         call put('total_inlet_flow', sum(pads%inlet), 'm^3/s', 'flow in at all leading edges')
         call put('total_outlet_flow', sum(pads%outlet), 'm^3/s', 'flow out at all trailing edges')
         call put('total_side_flow', sum(pads%side), 'm^3/s', 'flow out at the sides of all pads')
      end associate
      call put('temperature_rise_fresh', figures%rise_fresh, 'K', &
         & 'warming of the oil if every pad draws fresh oil alone')
      call put('temperature_rise_side', figures%rise_side, 'K', &
         & 'warming of the oil if fresh oil replaces only what leaves at the sides')
   contains
      !> A number, or one of each pad.
      subroutine put(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(..)
         call file%put('equilibrium/'//name, values, units, long_name, 'pad')
      end subroutine put
   end subroutine put_figures

   !> Writes the temperatures of warm oil, C.
   subroutine put_temperatures(file, oil)
      class(record_type), intent(inout) :: file
      type(oil_temperatures_type), intent(in) :: oil
      call file%put('equilibrium/inlet_temperature', oil%inlet, 'degC', 'temperature of the oil at the leading edge', &
         & 'pad')
      call file%put('equilibrium/mean_temperature', oil%mean, 'degC', 'mean temperature of the film', 'pad')
      call file%put('equilibrium/outlet_temperature', oil%outlet, 'degC', &
         & 'temperature of the oil at the trailing edge', 'pad')
      call file%put('equilibrium/maximum_temperature', oil%maximum, 'degC', 'maximum temperature of the pad', 'pad')
      call put_figure(file, 'equilibrium_maximum_temperature', maxval(oil%maximum), 'degC', &
         & 'maximum temperature of all pads')
      call file%put('equilibrium/shaft_temperature', oil%shaft, 'degC', 'temperature of the shaft')
      call file%put('equilibrium/drain_temperature', oil%drain, 'degC', &
         & 'temperature of the oil that leaves the bearing')
   end subroutine put_temperatures

   !> Writes the temperatures along and across the films, and of the pads' surfaces, C.
   subroutine put_film_temperatures(file, films)
      class(record_type), intent(inout) :: file
      type(warm_films_type), intent(in) :: films
      integer :: i
      associate (n => size(films%surfaces, 1), zeta => films%heat(1)%zeta, &
         & film => films%fields(solid_layers + 1:, :, :))
         call file%put('film_arc', [((i - 0.5_wp)/n, i=1, n)], '1', &
            & 'place on the arc, from the leading edge (0) to the trailing edge (1)', 'film_arc')
         call file%put('film_height', (zeta(:size(zeta) - 1) + zeta(2:))/2, '1', &
            & 'height in the film, from the pad (0) to the journal (1)', 'film_height')
         call file%put('equilibrium/film_temperature', film, 'degC', 'temperature of the oil', &
            & 'pad film_arc film_height')
         call file%put('equilibrium/surface_temperature', films%surfaces, 'degC', &
            & 'temperature of the pad where it meets the film', 'pad film_arc')
         call file%put('equilibrium/heat_to_shaft', films%to_shaft, 'W', 'heat from the film to the shaft', 'pad')
         call file%put('equilibrium/heat_to_pad', films%to_pad, 'W', &
            & 'heat from the film to the pad, which goes out at its back and ends', 'pad')
      end associate
   end subroutine put_film_temperatures

   ! The oil of the films, from which they can be solved again: viscosities and, where oil is uneven, its polynomials.

   !> Writes the oil of every pad's film; `group` is empty or ends with a slash.
   subroutine put_oil(file, group, oil)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: group
      type(film_oil), intent(in) :: oil(:)
      real(wp) :: c(0:weights_degree, polynomials, size(oil))
      integer :: i, k
      call file%put(group//'viscosity', oil%viscosity, 'Pa s', 'viscosity of the film', 'pad')
      if (.not. any(oil%varies)) return
      do i = 1, size(oil)
         c(:, :, i) = oil(i)%coefficients()
      end do
      call file%put('film_degree', [(real(k, wp), k=0, weights_degree)], '1', &
         & 'power of the place on the arc, from the leading edge (-1) to the trailing edge (1)', 'film_degree')
      do k = 1, polynomials
         call file%put(group//trim(names(k)), c(:, k, :), '1', 'coefficients of '//trim(meanings(k)) &
            & //' along the arc', 'pad film_degree')
      end do
   end subroutine put_oil

   !> The oil that a file has; an error where it has none.
   subroutine read_oil(file, group, oil, error)
      class(record_type), intent(in) :: file
      character(len=*), intent(in) :: group
      type(film_oil), intent(out) :: oil(:)
      type(error_type), allocatable, intent(inout) :: error
      real(wp) :: c(0:weights_degree, size(oil), polynomials), values(size(oil)*(weights_degree + 1)), mu(size(oil))
      integer :: i, k
      call file%get_list(group//'viscosity', mu)
      c = 0
      if (file%has(group//trim(names(1)))) then
         do k = 1, polynomials
            call file%get_list(group//trim(names(k)), values)
            c(:, :, k) = reshape(values, shape(c(:, :, k)))
         end do
      end if
      if (.not. all(mu > 0) .or. .not. all(abs(c) < huge(c))) then
         call raise(error, system_error, 'damaged: '//group//'viscosity is not that of an oil')
         return
      end if
      do i = 1, size(oil)
         oil(i) = uneven_oil(mu(i), c(:, i, :))
      end do
   end subroutine read_oil

   ! The shape of a bearing in operation.

   !> Writes radius, clearances and what has changed them.
   subroutine put_shape(file, shape)
      class(record_type), intent(inout) :: file
      type(bearing_shape_type), intent(in) :: shape
      call put('journal_radius', shape%journal_radius, 'm', 'radius of the journal in operation')
      call put('machined_clearance', shape%machined_clearance, 'm', 'clearance between bore and journal in operation')
      call put('assembled_clearance', shape%assembled_clearance, 'm', 'clearance at the pivots in operation')
      call put('pivot_distance', shape%pivot_distance, 'm', 'distance from the bore to the pivot in operation')
      call put('elastic_bending', shape%bending%elastic, 'm', &
         & 'change of the pad clearance as the pressure bends the pad')
      call put('thermal_bending', shape%bending%thermal, 'm', 'change of the pad clearance as heat bends the pad')
      call put_figure(file, 'equilibrium_bearing_clearance', minval(shape%assembled_clearance), 'm', &
         & 'bearing clearance in operation')
      associate (t => shape%temperatures)
         if (.not. allocated(t%pads)) return
         call put('shaft_temperature', t%shaft, 'degC', 'temperature of the shaft that expands')
         call put('housing_temperature', t%housing, 'degC', 'temperature of the housing that expands')
         call put('pad_temperature', t%pads, 'degC', 'temperature of the pad that expands')
      end associate
   contains
      !> A number, or one of each pad.
      subroutine put(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(..)
         call file%put('shape/'//name, values, units, long_name, 'pad')
      end subroutine put
   end subroutine put_shape

   !> Gives a shape the lengths that the file of its bearing has; an error where it has none.
   subroutine read_shape(file, shape, error)
      class(record_type), intent(in) :: file
      type(bearing_shape_type), intent(inout) :: shape
      type(error_type), allocatable, intent(inout) :: error
      shape%journal_radius = file%get_real('shape/journal_radius')
      call file%get_list('shape/machined_clearance', shape%machined_clearance)
      call file%get_list('shape/assembled_clearance', shape%assembled_clearance)
      call file%get_list('shape/pivot_distance', shape%pivot_distance)
      associate (lengths => shape%lengths())
         if (.not. (all(lengths > 0) .and. all(lengths < huge(lengths)))) call raise(error, system_error, &
            & 'damaged: shape is not that of a bearing')
      end associate
   end subroutine read_shape
end module equilibrium_results
