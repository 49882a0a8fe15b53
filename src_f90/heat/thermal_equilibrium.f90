!> Thermal equilibrium: the bearing comes to equilibrium with some viscosities, a heat balance of its losses and flows
!> there gives others, until they agree. Broyden's method finds them: Newton's with the differences of
!> heat_balance_equations takes 1.3 times the time on input/examples/warm_five_pads.nml, and 1.8 times on
!> warm_paper.nml; with differences that serve several rounds, 1.08 times on 154 bearings of ordinary_bearings.py, and
!> it heeds neither pads that are held nor grooves that keep their temperatures.
module thermal_equilibrium
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error, asked_to_stop, asked
   use film_oils, only: even_oil
   use case_inputs, only: case_type
   use heat_balance, only: oil_temperatures_type
   use oil_properties, only: viscosity
   use equations_of_motion, only: machine_model
   use heat_balance_equations, only: state_balance_type, has_warm_oil, find_losses, find_lack, &
      & find_temperatures, check_heat
   use static_model, only: solve_equilibrium, start
   use film_network, only: warm_films_type, new_warm_films
   use film_equilibrium, only: solve_warm_films
   implicit none (type, external)
   private
   public :: guess_oil, guesses, solve_thermal_equilibrium

   !> Difference of the logarithms of viscosities and of those that the balance wants, at the end; what leaps of
   !> cavitated films may leave.
   real(wp), parameter :: agreement = 1e-8_wp, largest_leap = 1e-4_wp
   !> The same where temperatures along and across the films follow, which are changed by ten times as much.
   real(wp), parameter :: rough = 1e-2_wp
   !> Largest change of such a logarithm in a round, and least that is worth a try; most rounds.
   real(wp), parameter :: longest_step = 1, shortest_step = 1e-2_wp
   integer, parameter :: most_rounds = 60
   !> Warming that is guessed where nothing better is known, K.
   real(wp), parameter :: some_warming = 20
   !> Guesses of viscosities; the start of a search at which the first is made.
   integer, parameter :: guesses = 3, middle_start = 3

contains

   !> Gives the oil viscosities to search with: those that it would have at one of the starts of a search; those of some
   !> warming; those of cold oil.
   subroutine guess_oil(model, guess)
      type(machine_model), intent(inout) :: model
      integer, intent(in) :: guess
      type(state_balance_type) :: balance
      real(wp), dimension(model%layout%pads) :: wanted, balanced
      logical :: ok
      associate (oil => model%inputs%oil)
         wanted = viscosity(oil, oil%supply_temperature + (guesses - guess)*some_warming)
      end associate
      if (guess == 1) then
         call find_losses(model, start(model, middle_start), balance)
         call balance%bearings(1)%heat%viscosities(balance%losses, model%oil%viscosity, model%point%speed(0.0_wp), &
            & balanced, ok)
         if (ok) wanted = balanced
      end if
      model%oil = even_oil(wanted)
   end subroutine guess_oil

   !> Brings a state that is near equilibrium to equilibrium, as solve_equilibrium does, and the oil, where it is warm,
   !> to the temperatures of this equilibrium: the model then has its viscosities.
   subroutine solve_thermal_equilibrium(model, y, residual, error, give_up, held, kept, films)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      !> Pads that are held where they are.
      logical, intent(in), optional :: held(:)
      !> Where grooves and shaft keep their temperatures: these, of each bearing.
      type(oil_temperatures_type), intent(in), optional :: kept(:)
      !> The temperatures of the films of each bearing, where the case wants them along and across.
      type(warm_films_type), allocatable, intent(out), optional :: films(:)
      type(warm_films_type), allocatable :: found(:)
      type(state_balance_type) :: balance
      type(oil_temperatures_type) :: oil(size(model%bearings))
      real(wp), dimension(model%layout%pads) :: last, step
      real(wp) :: inverse(size(step), size(step))
      logical :: films_follow
      integer :: round
      if (.not. has_warm_oil(model)) then
         call solve_equilibrium(model, y, residual, error, give_up, held)
         return
      end if
      films_follow = model%inputs%thermal%model == 'film'
      ! one temperature for each pad leads to those along and across
      model%oil = even_oil(model%oil%viscosity)
      step = 0
      do round = 1, most_rounds
         call follow(model, y, step, residual, error, give_up, held)
         if (allocated(error)) return
         call find_lack(model, y, balance, kept)
         associate (lack => balance%lack)
            if (maxval(abs(lack)) <= merge(rough, agreement, films_follow)) exit
            call improve(round, lack, last, step, inverse)
            last = lack
            step = matmul(inverse, lack)
         end associate
         step = step*min(1.0_wp, longest_step/maxval(abs(step)))
      end do
      call check_heat(model, balance, error, kept)
      if (allocated(error)) return
      associate (lack => maxval(abs(balance%lack)))
         if (.not. lack <= merge(rough, largest_leap, films_follow)) then
            call raise(error, numerics_error, 'the temperatures of the oil do not settle: after ' &
               & //to_text(most_rounds)//' rounds its viscosity still changes by '//to_text(100*lack)//' %')
         end if
      end associate
      if (allocated(error) .or. .not. films_follow) return
      call find_temperatures(model, y, balance, oil)
      call make_films(model%inputs, oil, found)
      call solve_warm_films(model, y, found, residual, error, give_up, held)
      if (present(films)) call move_alloc(found, films)
   end subroutine solve_thermal_equilibrium

   !> Films of all bearings of a case that have the mean temperatures of this oil.
   subroutine make_films(inputs, oil, films)
      type(case_type), intent(in) :: inputs
      type(oil_temperatures_type), intent(in) :: oil(:)
      type(warm_films_type), allocatable, intent(out) :: films(:)
      type(case_type) :: own
      integer :: b
      allocate (films(size(oil)))
      do b = 1, size(oil)
         own = inputs%of_bearing(b)
         films(b) = new_warm_films(own, oil(b)%mean)
      end do
   end subroutine make_films

   !> Brings a state in equilibrium to equilibrium again after a step of the logarithms of the viscosities, or after the
   !> longest part of it that Newton's method can follow.
   subroutine follow(model, y, step, residual, error, give_up, held)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:), step(:)
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      logical, intent(in), optional :: held(:)
      real(wp) :: trial(size(y)), before(size(step))
      before = model%oil%viscosity
      model%oil%viscosity = before*exp(step)
      do
         trial = y
         call solve_equilibrium(model, trial, residual, error, give_up, held)
         if (.not. allocated(error)) exit
         if (asked(give_up) .or. .not. maxval(abs(step)) > shortest_step) return
         step = step/4
         model%oil%viscosity = before*exp(step)
      end do
      y = trial
   end subroutine follow

   !> The inverse Jacobian of Broyden's method after a step that has changed what lacks. In the first round, after a
   !> step for the worse, and where it would turn against what lacks, it is that of a fixed point: viscosities that
   !> would run away from their balance are none to look for.
   pure subroutine improve(round, lack, last, step, inverse)
      integer, intent(in) :: round
      real(wp), intent(in) :: lack(:), last(:), step(:)
      real(wp), intent(inout) :: inverse(:, :)
      real(wp) :: answer(size(lack)), along
      integer :: i
      if (round > 1) then
         if (norm2(lack) < 2*norm2(last)) then
            answer = -matmul(inverse, lack - last)
            along = dot_product(step, answer)
            if (abs(along) > 1e-3_wp*norm2(step)*norm2(answer)) then
               inverse = inverse + spread((step - answer)/along, 2, size(lack)) &
                  & *spread(matmul(step, inverse), 1, size(lack))
               if (dot_product(lack, matmul(inverse, lack)) > 0) return
            end if
         end if
      end if
      inverse = 0
      do i = 1, size(lack)
         inverse(i, i) = 1
      end do
   end subroutine improve
end module thermal_equilibrium
