!> The heat balance as equations beside the balance of forces: the residual of the viscosities of a state, to those that
!> its losses and flows lead to, how this changes with positions and viscosities, and which balances are refused.
!> Derivatives are differences.
module heat_balance_equations
   use kinds, only: wp
   use errors, only: error_type, raise, add_context, numerics_error
   use pad_gap, only: pad_gap_type
   use bearing_losses, only: bearing_losses_type, pad_loss, new_bearing_losses
   use heat_balance, only: heat_balance_type, oil_temperatures_type, new_heat_balance, check_boiling
   use equations_of_motion, only: machine_model
   use bearing_samples, only: bearing_sample, take_sample
   use force_balance, only: forces
   implicit none (type, external)
   private
   public :: state_balance_type, has_warm_oil, find_losses, find_residual, find_residual_slopes, find_force_slopes, &
      & find_temperatures, check_heat, check_oil

   !> The difference of positions over the thinnest film, and of the logarithms of viscosities. Losses and flows are
   !> known to 1e-5; what they miss changes slowly.
   real(wp), parameter :: difference = 1e-3_wp

   !> What finds losses takes time to make; the gaps that it was made for.
   type :: bearing_heat_type
      type(heat_balance_type) :: heat
      type(bearing_losses_type), private :: finder
      type(pad_gap_type), allocatable, private :: gaps(:)
   end type bearing_heat_type

   !> A state's heat balance, of the pads of all bearings. It may be used for one state after another.
   type :: state_balance_type
      type(bearing_heat_type), allocatable :: bearings(:)
      type(pad_loss), allocatable :: losses(:)
      !> The logarithms of the viscosities that the state leads to, over those that it has; 0 where neither flow nor
      !> shaft carries the heat off, which is then not balanced.
      real(wp), allocatable :: residual(:)
      logical :: balanced = .false.
   end type state_balance_type

contains

   !> True where the oil of a model has temperatures.
   pure logical function has_warm_oil(model)
      type(machine_model), intent(in) :: model
      has_warm_oil = model%inputs%thermal%model /= 'none'
   end function has_warm_oil

   !> Losses and flows of the state y of a model with its viscosities.
   subroutine find_losses(model, y, balance)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(state_balance_type), intent(inout) :: balance
      logical :: stays
      integer :: b
      if (.not. allocated(balance%bearings)) allocate (balance%bearings(size(model%bearings)))
      do b = 1, size(model%bearings)
         associate (of => balance%bearings(b), gaps => model%bearings(b)%pads%gap, own => model%inputs%bearings(b))
            stays = allocated(of%gaps)
            if (stays) stays = .not. any(of%gaps%differs(gaps))
            if (.not. stays) then
               of%finder = new_bearing_losses(own)
               of%gaps = gaps
            end if
            of%heat = new_heat_balance(own, model%inputs%sense())
         end associate
      end do
      if (.not. allocated(balance%losses)) allocate (balance%losses(model%layout%pads), &
         & balance%residual(model%layout%pads))
      call find_again(model, y, balance, balance%losses)
   end subroutine find_losses

   !> The same beside a state whose losses were found.
   subroutine find_again(model, y, balance, losses)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(state_balance_type), intent(inout) :: balance
      type(pad_loss), intent(out) :: losses(:)
      integer :: b
      do b = 1, size(model%bearings)
         associate (of => model%layout%elements(b), first => model%layout%elements(b)%first_pad, &
            & last => model%layout%elements(b)%last_pad)
            call balance%bearings(b)%finder%find(model%bearings(b), model%rotor%journal(y(:model%rotor%states), b), &
               & of%pad_states(y), model%oil(first:last), model%point%speed(0.0_wp), losses(first:last))
         end associate
      end do
   end subroutine find_again

   !> The residual of the viscosities in a state y.
   subroutine find_residual(model, y, balance, kept)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(state_balance_type), intent(inout) :: balance
      !> Where grooves and shaft keep their temperatures: these, of each bearing.
      type(oil_temperatures_type), intent(in), optional :: kept(:)
      call find_losses(model, y, balance)
      call set_residual(model, balance, balance%losses, model%oil%viscosity, balance%residual, balance%balanced, kept)
   end subroutine find_residual

   !> The same with these losses of films of these viscosities.
   subroutine set_residual(model, balance, losses, films, residual, ok, kept)
      type(machine_model), intent(in) :: model
      type(state_balance_type), intent(in) :: balance
      type(pad_loss), intent(in) :: losses(:)
      real(wp), intent(in) :: films(:)
      real(wp), intent(out) :: residual(:)
      logical, intent(out) :: ok
      type(oil_temperatures_type), intent(in), optional :: kept(:)
      type(oil_temperatures_type), allocatable :: kept_here
      real(wp) :: wanted(size(films))
      integer :: b
      residual = 0
      do b = 1, size(model%bearings)
         associate (first => model%layout%elements(b)%first_pad, last => model%layout%elements(b)%last_pad)
            if (present(kept)) kept_here = kept(b)
            call balance%bearings(b)%heat%viscosities(losses(first:last), films(first:last), &
               & model%point%speed(0.0_wp), wanted(first:last), ok, kept_here)
         end associate
         if (.not. ok) return
      end do
      residual = log(wanted/films)
   end subroutine set_residual

   !> The derivatives of the residual in the state y, whose balance was found, over positions and then over the
   !> logarithms of the viscosities; positions over their sizes, which are such that a film that is one bearing
   !> clearance thick changes by as much. Pads are moved together: the losses of each follow from the journal and from
   !> its own state.
   subroutine find_residual_slopes(model, y, balance, sizes, slopes)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:), sizes(:)
      type(state_balance_type), intent(inout) :: balance
      real(wp), intent(out) :: slopes(:, :)
      type(bearing_sample) :: sample
      type(pad_loss) :: moved(model%layout%pads)
      ! not size(moved), which gfortran takes for 0 where procedures are contained
      real(wp), dimension(model%layout%pads) :: films, thicker
      integer, allocatable :: x(:), own(:)
      real(wp) :: none(model%outputs), change
      integer :: i, k, b
      slopes = 0
      none = 0
      change = huge(change)
      do b = 1, size(model%bearings)
         if (allocated(sample%states)) deallocate (sample%states, sample%loads)
         call take_sample(model, 0.0_wp, y, none, b, sample)
         change = min(change, difference*minval(sample%loads%min_film_thickness)/model%bearings(b)%clearance)
      end do
      films = model%oil%viscosity
      thicker = films*exp(difference)
      x = model%layout%positions()
      do k = 1, 2*size(model%bearings)
         call find_moved([k])
         call set_slope(k, moved, films, change)
      end do
      do b = 1, size(model%bearings)
         associate (of => model%layout%elements(b))
            do k = 0, of%coordinates - 1
               own = k + [(of%first_position(i), i=1, of%pads)]
               call find_moved(own)
               do i = 1, size(own)
                  call set_slope(own(i), merge_loss(of%first_pad + i - 1), films, change)
               end do
            end do
         end associate
      end do
      model%oil%viscosity = thicker
      call find_again(model, y, balance, moved)
      model%oil%viscosity = films
      do i = 1, size(moved)
         call set_slope(size(x) + i, merge_loss(i), [films(:i - 1), thicker(i), films(i + 1:)], difference)
      end do

   contains

      !> The losses where these positions are moved.
      subroutine find_moved(which)
         integer, intent(in) :: which(:)
         real(wp) :: there(size(y))
         there = y
         there(x(which)) = there(x(which)) + change*sizes(which)
         call find_again(model, there, balance, moved)
      end subroutine find_moved

      !> The losses where one pad alone is moved.
      pure function merge_loss(pad) result(losses)
         integer, intent(in) :: pad
         type(pad_loss) :: losses(model%layout%pads)
         losses = balance%losses
         losses(pad) = moved(pad)
      end function merge_loss

      subroutine set_slope(column, losses, viscosities, by)
         integer, intent(in) :: column
         type(pad_loss), intent(in) :: losses(:)
         real(wp), intent(in) :: viscosities(:), by
         real(wp) :: there(model%layout%pads)
         logical :: ok
         call set_residual(model, balance, losses, viscosities, there, ok)
         if (ok) slopes(:, column) = (there - balance%residual)/by
      end subroutine set_slope
   end subroutine find_residual_slopes

   !> The derivatives of the forces at the state y over the logarithms of the viscosities. The model is evaluated there
   !> with its viscosities at the end.
   subroutine find_force_slopes(model, y, slopes)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      real(wp), intent(out) :: slopes(:, :)
      real(wp) :: films(model%layout%pads), now(size(slopes, 1))
      integer :: i
      logical :: ok
      films = model%oil%viscosity
      now = forces(model, 0.0_wp, y)
      do i = 1, size(films)
         model%oil%viscosity = [films(:i - 1), films(i)*exp(difference), films(i + 1:)]
         call model%evaluate(0.0_wp, y, .false., ok)
         slopes(:, i) = (forces(model, 0.0_wp, y) - now)/difference
      end do
      model%oil%viscosity = films
      call model%evaluate(0.0_wp, y, .false., ok)
   end subroutine find_force_slopes

   !> The temperatures of the oil in each bearing in a state y whose heat has a balance.
   subroutine find_temperatures(model, y, balance, oil, kept)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(state_balance_type), intent(inout) :: balance
      type(oil_temperatures_type), intent(out) :: oil(:)
      type(oil_temperatures_type), intent(in), optional :: kept(:)
      call find_losses(model, y, balance)
      call take_temperatures(model, balance, oil, balance%balanced, kept)
   end subroutine find_temperatures

   !> Those of losses that were found.
   subroutine take_temperatures(model, balance, oil, ok, kept)
      type(machine_model), intent(in) :: model
      type(state_balance_type), intent(in) :: balance
      type(oil_temperatures_type), intent(out) :: oil(:)
      logical, intent(out) :: ok
      type(oil_temperatures_type), intent(in), optional :: kept(:)
      type(oil_temperatures_type), allocatable :: kept_here
      integer :: b
      do b = 1, size(model%bearings)
         if (present(kept)) kept_here = kept(b)
         associate (pads => model%layout%elements(b)%all_pads())
            call balance%bearings(b)%heat%temperatures(balance%losses(pads), model%oil(pads)%viscosity, &
               & model%point%speed(0.0_wp), oil(b), ok, kept_here)
         end associate
         if (.not. ok) return
      end do
   end subroutine take_temperatures

   !> Refuses a state whose heat, found last by find_residual, has no balance, or at which oil boils.
   subroutine check_heat(model, balance, error, kept)
      type(machine_model), intent(in) :: model
      type(state_balance_type), intent(in) :: balance
      type(error_type), allocatable, intent(out) :: error
      type(oil_temperatures_type), intent(in), optional :: kept(:)
      type(oil_temperatures_type) :: oil(size(model%bearings))
      logical :: ok
      ok = balance%balanced
      if (ok) call take_temperatures(model, balance, oil, ok, kept)
      if (.not. ok) then
         call raise(error, numerics_error, 'the oil has no heat balance: neither its flow nor the shaft carries the ' &
            & //'heat of the films off; it needs fresh oil (oil%carry_over below 1) or exchange with the shaft ' &
            & //'(oil%shaft_nusselt)')
         return
      end if
      call check_oil(model, oil, error)
   end subroutine check_heat

   !> Refuses oil that boils in one of the bearings.
   subroutine check_oil(model, oil, error)
      type(machine_model), intent(in) :: model
      type(oil_temperatures_type), intent(in) :: oil(:)
      type(error_type), allocatable, intent(out) :: error
      integer :: b
      do b = 1, size(oil)
         call check_boiling(oil(b), error)
         call add_context(error, model%inputs%bearings(b)%label())
         if (allocated(error)) return
      end do
   end subroutine check_oil
end module heat_balance_equations
