!> The equilibrium of a run: the result of one task, and where others start.
module equilibrium_start
   use kinds, only: wp
   use errors, only: error_type, stopped
   use equilibrium, only: equilibrium_type, find_equilibrium
   use namelist_writer, only: namelist_of
   use heat_balance_equations, only: static_figures_type, find_static_figures
   use equilibrium_results, only: put_equilibrium, put_figures, put_temperatures
   use stop_signals, only: stop_requested, stop_reason
   use case_run, only: case_run_type
   use run_summary, only: print_equilibrium, print_figures, print_temperatures
   implicit none (type, external)
   private
   public :: create_file, start_at_equilibrium, seek_equilibrium, note_equilibrium, nothing_computed

   !> Said of a signal that stops a run before its march.
   character(len=*), parameter :: nothing_computed = ' before the march; nothing was computed yet'

contains

   !> Creates the file of a run.
   subroutine create_file(run, error)
      type(case_run_type), intent(inout) :: run
      type(error_type), allocatable, intent(out) :: error
      call run%file%create(run%inputs, namelist_of(run%inputs), error)
      if (.not. allocated(error) .and. run%tag%number > 0) call run%file%put_tag(run%tag)
   end subroutine create_file

   !> Creates the file, finds the equilibrium and writes it; y is its state.
   subroutine start_at_equilibrium(run, y, error)
      type(case_run_type), intent(inout) :: run
      real(wp), allocatable, intent(out) :: y(:)
      type(error_type), allocatable, intent(out) :: error
      type(equilibrium_type) :: static
      call seek_equilibrium(run, static, error)
      if (allocated(error)) return
      call note_equilibrium(run, static)
      y = run%model%static_state(static%journal, static%tilt, static%pivot_deflection)
   end subroutine start_at_equilibrium

   !> Creates the file and finds the equilibrium.
   subroutine seek_equilibrium(run, static, error)
      type(case_run_type), intent(inout) :: run
      type(equilibrium_type), intent(out) :: static
      type(error_type), allocatable, intent(out) :: error
      call create_file(run, error)
      if (allocated(error)) return
      call find_equilibrium(run%model, static, error, stop_requested)
      if (.not. allocated(error)) return
      if (error%status == stopped) error%message = stop_reason()//nothing_computed
   end subroutine seek_equilibrium

   !> Writes an equilibrium with its losses and flows, and gives the films of the run its viscosities.
   subroutine note_equilibrium(run, static)
      type(case_run_type), intent(inout) :: run
      type(equilibrium_type), intent(in) :: static
      type(static_figures_type) :: figures
      run%model%oil%viscosity = static%viscosity
      call put_equilibrium(run%file%file, static, run%inputs%tilting(), run%inputs%tilting_radial())
      call find_static_figures(run%model, static, figures)
      call put_figures(run%file%file, run%inputs, figures)
      if (allocated(figures%oil)) call put_temperatures(run%file%file, figures%oil, static%viscosity)
      run%computed = .true.
      if (run%quiet) return
      call print_equilibrium(static, run%inputs)
      call print_figures(run%inputs, figures)
      if (allocated(figures%oil)) call print_temperatures(figures%oil, static%viscosity)
   end subroutine note_equilibrium
end module equilibrium_start
