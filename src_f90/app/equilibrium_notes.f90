!> What a run writes and prints of its equilibrium: of each bearing the same, of a machine besides what is of the whole.
module equilibrium_notes
   use kinds, only: wp
   use state_layout, only: tilt
   use equilibrium_record, only: equilibrium_type
   use equations_of_motion, only: machine_model
   use static_figures, only: static_figures_type, find_static_figures
   use bearings_alone, only: bearing_alone, part_of, bearing_loads
   use bearing_file, only: bearing_file_type
   use checked_case, only: first_equal
   use equilibrium_results, only: put_equilibrium, put_misalignment, put_stability, put_figures, put_temperatures, &
      & put_film_temperatures
   use oil_results, only: put_oil
   use machine_results, only: put_machine_equilibrium
   use shape_results, only: print_shape
   use case_run, only: case_run_type
   use run_summary, only: print_shaft, print_equilibrium, stability_text, print_figures, print_temperatures, &
      & print_misalignment, bearing_title
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
         call run%note_remarks(shown=.true.)
         return
      end if
      call put_stability(run%file, static)
      loads = bearing_loads(run%model, static)
      slopes = bearing_slopes(run, static)
      call put_machine_equilibrium(run%file, run%model%rotor, static%rotor, loads)
      if (.not. run%quiet) call print_shaft(run%file)
      if (.not. run%quiet) print '(a)', 'equilibrium: '//stability_text(static%stability, 'shaft', &
         & any(run%inputs%bearings%tilting()))
      do b = 1, size(loads, 2)
         as = b
         if (.not. run%quiet) as = same_equilibrium(run, static, loads, slopes, b)
         title = bearing_title(run%inputs%bearings(b), loads(:, b))
         call note_bearing(run, bearing_alone(run%model, b, loads(:, b)), part_of(run%model, static, b), b, title, &
            & as == b .and. .not. run%quiet, '')
         call note_misalignment(run, static, slopes(b), b, as == b .and. .not. run%quiet)
         if (as < b .and. .not. run%quiet) print '(a)', title//'all else as of '//run%inputs%bearings(as)%label()
      end do
      call run%note_remarks(shown=.true.)
   end subroutine note_equilibrium

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
            & .and. agree([slopes(first)], [slopes(b)])) return
      end do
   end function same_equilibrium

   !> Whether numbers of one kind are the same but for the digits that are not printed.
   pure logical function agree(one, other)
      real(wp), intent(in) :: one(:), other(:)
      agree = maxval(abs(one - other)) <= 1e-5_wp*maxval(abs(other))
   end function agree

   !> Slope of the shaft in each bearing, rad.
   function bearing_slopes(run, static) result(slopes)
      type(case_run_type), intent(in) :: run
      type(equilibrium_type), intent(in) :: static
      real(wp) :: slopes(size(run%inputs%bearings)), at_stations(2, run%model%rotor%stations)
      at_stations = run%model%rotor%station_slopes(static%rotor)
      slopes = norm2(at_stations(:, run%inputs%bearings%station), dim=1)
   end function bearing_slopes

   !> What the slope of the shaft in bearing b of a machine, rad, does to its films, which leave it out.
   subroutine note_misalignment(run, static, slope, b, shown)
      type(case_run_type), intent(inout) :: run
      type(equilibrium_type), intent(in) :: static
      real(wp), intent(in) :: slope
      integer, intent(in) :: b
      logical, intent(in) :: shown
      type(bearing_file_type) :: file
      real(wp) :: misalignment
      file = run%bearing(b)
      misalignment = maxval(slope*run%inputs%bearings(b)%axial_length/2 &
         & /static%min_film_thickness(run%model%layout%elements(b)%all_pads()))
      call put_misalignment(file, misalignment)
      if (shown) call print_misalignment(slope, misalignment)
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
         call print_equilibrium(title, static, bearing%tilting(), ending)
         call print_figures(inputs, figures)
         if (allocated(figures%oil)) call print_temperatures(figures%oil, static%oil%viscosity)
         if (bearing%changes_shape()) call print_shape(bearing, run%shapes(b))
      end associate
   end subroutine note_bearing
end module equilibrium_notes
