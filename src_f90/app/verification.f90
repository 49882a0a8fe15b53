!> Option --verify: what a run may say of its own films. Of states of a complete result, spread over its samples, the
!> films of the run are compared with closely solved ones, and the file gets the differences. The result stays as it is
!> until all of them are there.
module verification
   use kinds, only: wp, i8
   use text, only: to_text, replaced
   use errors, only: error_type, raise, require, system_error, stopped
   use clock, only: wall_clock
   use case_inputs, only: case_type
   use result_size, only: sample_count
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state
   use equations_of_motion, only: machine_model
   use film_comparison, only: film_comparison_type, film_difference, new_film_comparison
   use static_model, only: make_fine
   use heat_balance_equations, only: has_warm_oil
   use run_file, only: run_file_type
   use last_state, only: read_states, all_finite
   use verification_results, only: put_verification
   use stop_signals, only: stop_requested, stop_reason
   use case_run, only: case_run_type
   use equilibrium_results, only: read_oil
   use run_start, only: restore_shape, restore_oil
   implicit none (type, external)
   private
   public :: check_verification, verify_films, sample_of

   !> By which part of a turn of the shaft the state goes on from one stretch of samples to the next: the golden ratio,
   !> whose multiples spread evenly over the turn, however few they are.
   real(wp), parameter :: golden = 0.5_wp*(sqrt(5.0_wp) - 1)

contains

   !> Refuses to verify machines, what keeps no states, or more states than a run has.
   subroutine check_verification(inputs, states, error)
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: states
      type(error_type), allocatable, intent(out) :: error
      integer(i8) :: samples
      call require(size(inputs%bearings) == 1, '--verify: compares the films of one bearing with a rigid journal, ' &
         & //'not those of a machine; run each bearing alone, with its load as rotor%static_load', error)
      if (size(inputs%bearings) == 1) call require(.not. inputs%has_slopes(1), '--verify: does not compare films in ' &
         & //'which slopes of the journal count (pads that pitch, bearing%slope)', error)
      call require(inputs%about%task /= 'branch', '--verify: the points of a branch keep no states to verify; run ' &
         & //'one of them with case%task = ''equilibrium'' or ''periodic''', error)
      call require(inputs%output%keep == 'all' .or. .not. any(inputs%about%task == ['march   ', 'periodic']), &
         & '--verify: needs the samples of the run; output%keep = '''//inputs%output%keep//''' must be ''all''', error)
      samples = states
      if (inputs%about%task == 'march') samples = max(0_i8, sample_count(inputs))
      if (inputs%about%task == 'periodic') samples = 1 + int(inputs%periodic%revolutions, i8) &
         & *inputs%output%samples_per_revolution
      call require(states <= samples, '--verify '//to_text(states)//': the run has '//to_text(samples) &
         & //' samples', error)
   end subroutine check_verification

   !> Verifies films of a complete run, whose file, if it has one, is closed. `remade`: the model was made anew, after
   !> the run.
   subroutine verify_films(run, remade, error)
      type(case_run_type), intent(inout) :: run
      logical, intent(in) :: remade
      type(error_type), allocatable, intent(out) :: error
      type(run_file_type), target :: file
      type(film_difference), allocatable :: found(:, :)
      real(wp), allocatable :: time(:)
      character(len=:), allocatable :: lines
      if (.not. run%file%filed) then
         call verify_equilibrium(run, run%file, time, found, error)
         if (allocated(error)) return
         call put_verification(run%file, time, found, norm2(run%model%point%load), lines)
         return
      end if
      call file%hdf5%claim(run%path, error)
      if (allocated(error)) return
      call file%reopen(run%inputs, error)
      if (.not. allocated(error)) call file%begin_series('time', 0_i8)
      if (.not. allocated(error) .and. remade) call restore_shape(run, file, error)
      if (.not. allocated(error) .and. remade .and. file%hdf5%samples > 0) call restore_oil(run, file, error)
      if (.not. allocated(error)) then
         if (file%hdf5%samples > 0) then
            call verify_samples(run, file, time, found, error)
         else
            call verify_equilibrium(run, file, time, found, error)
         end if
      end if
      if (.not. allocated(error)) call file%error_of(error)
      if (.not. allocated(error)) then
         call put_verification(file, time, found, norm2(run%model%point%load), lines)
         call file%publish(.false., error)
      else
         call file%abandon()
      end if
      if (.not. allocated(error)) then
         if (.not. run%quiet) print '(a)', replaced(lines, achar(10), achar(10)//'  ')
      else if (error%status == stopped) then
         error%message = stop_reason()//' while films were verified; '//run%path//' is complete without that'
      end if
   end subroutine verify_films

   !> The films at samples of a motion, one in each of as many stretches of equal length.
   subroutine verify_samples(run, file, time, found, error)
      type(case_run_type), intent(inout) :: run
      type(run_file_type), intent(inout) :: file
      real(wp), allocatable, intent(out) :: time(:)
      type(film_difference), allocatable, intent(out) :: found(:, :)
      type(error_type), allocatable, intent(out) :: error
      type(film_comparison_type) :: comparison
      type(journal_motion) :: journal
      type(pad_state) :: pads(run%model%layout%pads)
      real(wp), allocatable :: at(:, :)
      integer(i8) :: sample
      integer :: n, k
      n = int(min(int(run%verified_states, i8), file%hdf5%samples))
      allocate (time(n), found(size(pads), n))
      comparison = new_film_comparison(run%model)
      do k = 1, n
         sample = sample_of(k, n, file%hdf5%samples, run%inputs%output%samples_per_revolution)
         call file%hdf5%part_of_samples('time', sample, 1, at)
         time(k) = at(1, 1)
         call read_states(file%hdf5, '', run%model%bearings(1)%coordinates, &
            & run%model%layout%elements(1)%bristles, sample, journal, pads)
         call file%error_of(error)
         if (.not. allocated(error) .and. .not. all_finite(journal, pads)) call raise(error, system_error, run%path &
            & //': damaged: a state is not a number')
         if (allocated(error)) return
         if (stop_requested()) then
            call raise(error, stopped, '')
            return
         end if
         call comparison%compare(run%model, time(k), run%model%state(journal, pads), found(:, k))
         call file%heartbeat(int(wall_clock() - run%started))
      end do
   end subroutine verify_samples

   !> The sample, from 0, of the k-th of n states: one in the first revolution of each of n stretches of equal length.
   pure integer(i8) function sample_of(k, n, samples, of_revolution) result(sample)
      integer, intent(in) :: k, n
      !> In all, n at least, and in a revolution.
      integer(i8), intent(in) :: samples
      integer, intent(in) :: of_revolution
      integer(i8) :: length
      associate (first => (k - 1)*samples/n)
         length = min(k*samples/n - first, int(of_revolution, i8))
         ! at the same angle lie samples that are a revolution apart, from the first of the run on
         sample = first + modulo(int(modulo(k*golden, 1.0_wp)*length, i8) - first, length)
      end associate
   end function sample_of

   !> The films at the equilibrium, which are converged ones.
   subroutine verify_equilibrium(run, file, time, found, error)
      type(case_run_type), intent(inout) :: run
      type(run_file_type), intent(inout) :: file
      real(wp), allocatable, intent(out) :: time(:)
      type(film_difference), allocatable, intent(out) :: found(:, :)
      type(error_type), allocatable, intent(inout) :: error
      type(film_comparison_type) :: comparison
      type(machine_model) :: static
      type(pad_state) :: pads(run%model%layout%pads)
      real(wp) :: journal(2)
      integer :: k
      allocate (time(0), found(size(pads), 1))
      call make_fine(run%model, static)
      journal = [file%get_real('equilibrium/journal_y'), file%get_real('equilibrium/journal_z')]
      associate (coordinates => static%bearings(1)%coordinates)
         do k = 1, coordinates%n
            call file%get_list('equilibrium/'//trim(coordinates%words(k)%series), pads%x(coordinates%kind(k)))
         end do
      end associate
      if (has_warm_oil(static)) call read_oil(file, 'equilibrium/', static%oil, error)
      if (allocated(error)) return
      comparison = new_film_comparison(run%model)
      call comparison%compare(static, 0.0_wp, static%static_state(journal, pads), &
         & found(:, 1))
   end subroutine verify_equilibrium
end module verification
