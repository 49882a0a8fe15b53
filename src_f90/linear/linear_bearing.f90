!> Bearings linearised where they are in equilibrium: masses, stiffness and damping of all positions, for each way that
!> their pivots may behave; what a journal meets of its bearing that whirls at one frequency; and the vibrations of
!> rotor and pads, in an order, and what is said of each. What a case asks for of all these.
module linear_bearing
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp, pi
   use linear_algebra, only: solve_complex
   use errors, only: error_type, raise, numerics_error
   use state_layout, only: tilt, of_journal, element_layout_type
   use equations_of_motion, only: machine_model
   use force_balance, only: mode_name, mode_name_length, position_lengths, force_derivatives, &
      & bearing_derivatives, part_derivatives, add_sticking, masses, find_vibrations, no_growth
   use static_model, only: make_static
   use elastic_rotor, only: elastic_rotor_type
   use own_frequencies, only: take_own_frequencies
   implicit none (type, external)
   private
   public :: linear_bearing_type, linear_bearing_of, pivot_name, vibration_modes_type, rotor_eigenvalues, &
      & bearing_coefficients_type, find_coefficients, cross_stiffness_of, begin_to_carry, find_modes, &
      & take_high_damping

   !> Length of the names of pivots.
   integer, parameter :: pivot_name = 6
   !> A small vibration, over the clearance.
   real(wp), parameter :: small = 1e-3_wp

   !> In the order of layout%positions(), the first of which are the rotor's.
   type :: linear_bearing_type
      !> 'free': the pivots slide without friction; 'stuck': as their law of friction has it in equilibrium; 'locked':
      !> no pad tilts.
      character(len=pivot_name) :: pivot = ''
      !> kg, kg m, kg m^2; -dF/dx and -dF/dv of the forces and moments F.
      real(wp), allocatable :: mass(:, :), stiffness(:, :), damping(:, :)
      !> Positions that move.
      logical, allocatable :: moves(:)
   contains
      procedure :: condense
      procedure :: condense_slopes
   end type linear_bearing_type

   !> The modes in the order of their damping ratios, the least first, so that the first says whether the equilibrium is
   !> stable; of a pair of eigenvalues the one with a positive imaginary part; among ratios of 1 the slowest first.
   type :: vibration_modes_type
      !> 1/s.
      complex(wp), allocatable :: eigenvalue(:)
      !> (position, mode): m, and rad of tilts. Times the length that stands for a tilt, the largest is 1 m, and has
      !> no phase; of positions that do not move it is 0.
      complex(wp), allocatable :: shape(:, :)
      !> -Re/|eigenvalue|; -2 pi Re/Im, no number where nothing vibrates.
      real(wp), allocatable :: damping_ratio(:), log_decrement(:)
      !> What moves; only of the modes of a machine with its pads.
      character(len=mode_name_length), allocatable :: name(:)
   end type vibration_modes_type

   !> One element, or the last dimension, for each way that the pivots may behave.
   type :: bearing_coefficients_type
      !> The bearings alone; with the rotor.
      type(linear_bearing_type), allocatable :: bearings(:), with_rotor(:)
      !> Of each journal, N/m and N s/m, (row, column, frequency, pivot, bearing).
      real(wp), allocatable :: stiffness(:, :, :, :, :), damping(:, :, :, :, :)
      !> Where they are asked for, the same of y, z and the slopes of the journal along these, with moments on it: N,
      !> N m, m and rad.
      real(wp), allocatable :: slope_stiffness(:, :, :, :, :), slope_damping(:, :, :, :, :)
      type(vibration_modes_type), allocatable :: modes(:)
      !> Threshold speeds of stability, rpm, where they are asked for, and up to where they were sought.
      real(wp), allocatable :: thresholds(:)
      real(wp) :: sought_up_to = 0
   end type bearing_coefficients_type

   !> Least whirl frequency over the speed of the shaft: slower whirl is taken there, as the coefficients have a limit.
   real(wp), parameter :: slowest = 1e-6_wp

contains

   !> The coefficients that the case asks for, of a model without friction in equilibrium in y.
   subroutine find_coefficients(model, y, found, error)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      type(bearing_coefficients_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      logical :: ok
      integer :: i, k, b
      associate (given => model%inputs%coefficients, speed => model%point%speed(0.0_wp))
         call linearize(model, y, found%bearings, found%with_rotor, ok)
         if (.not. ok) then
            call raise(error, numerics_error, 'at the equilibrium '//model%refusal)
            return
         end if
         associate (pivots => size(found%bearings), ratios => size(given%frequency_ratio), n => size(model%bearings))
            allocate (found%stiffness(2, 2, ratios, pivots, n), found%damping(2, 2, ratios, pivots, n), &
               & found%modes(pivots))
            if (given%slopes) allocate (found%slope_stiffness(4, 4, ratios, pivots, n), &
               & found%slope_damping(4, 4, ratios, pivots, n))
            do i = 1, pivots
               each_bearing: do b = 1, n
                  do k = 1, ratios
                     call found%bearings(i)%condense(model%layout%elements(b), &
                        & given%frequency_ratio(k), speed, found%stiffness(:, :, k, i, b), &
                        & found%damping(:, :, k, i, b), ok)
                     if (ok .and. given%slopes) call found%bearings(i)%condense_slopes(model, b, &
                        & given%frequency_ratio(k), found%slope_stiffness(:, :, k, i, b), &
                        & found%slope_damping(:, :, k, i, b), ok)
                     if (.not. ok) exit each_bearing
                  end do
               end do each_bearing
               if (ok) call find_modes(found%with_rotor(i), cross_stiffness_of(model), position_lengths(model), &
                  & found%modes(i), ok, model, error)
               if (allocated(error)) return
               if (.not. ok) then
                  call raise(error, numerics_error, 'the linear equations of the pads with '//found%bearings(i)%pivot &
                     & //' pivots are singular')
                  return
               end if
               associate (modes => found%modes(i))
                  modes%name = [(mode_name(model, modes%shape(:, k), position_lengths(model), &
                     & modes%eigenvalue(k)%im > 0), k=1, size(modes%eigenvalue))]
               end associate
            end do
         end associate
      end associate
   end subroutine find_coefficients

   !> The cross-coupled stiffness of the task at a rigid journal, N/m, forward where the shaft turns clockwise; elements
   !> have that of a machine.
   pure real(wp) function cross_stiffness_of(model)
      type(machine_model), intent(in) :: model
      cross_stiffness_of = merge(model%point%sense*model%inputs%coefficients%cross_stiffness, 0.0_wp, &
         & model%inputs%rotor%is_rigid())
   end function cross_stiffness_of

   !> Pads whose film only just begins to carry in the equilibrium y of a model, so that its stiffness and damping are
   !> those of a motion to one side: with a film that does not cavitate a small vibration would change the force by more
   !> than there is.
   function begin_to_carry(model, y) result(begin)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      logical :: begin(model%layout%pads)
      type(machine_model) :: whole
      real(wp), allocatable, dimension(:, :) :: over_positions, over_rates
      logical :: ok
      integer :: b, i
      begin = .false.
      if (.not. any([(model%bearings(b)%film%cavitates(), b=1, size(model%bearings))])) return
      call make_static(model, .false., whole)
      call whole%evaluate(0.0_wp, y, .true., ok)
      if (.not. ok) return
      do b = 1, size(whole%bearings)
         if (.not. model%bearings(b)%film%cavitates()) cycle
         associate (bearing => whole%bearings(b), of => whole%layout%elements(b))
            do i = 1, of%pads
               if (bearing%pads(i)%gap%ambient_pressure > bearing%pads(i)%gap%cavitation_pressure) cycle
               call part_derivatives(bearing, i, of%coordinates, over_positions, over_rates)
               begin(of%first_pad + i - 1) = norm2(bearing%loads(i)%journal) &
                  & < small*bearing%clearance*norm2(over_positions(:of_journal, :of_journal))
            end do
         end associate
      end do
   end function begin_to_carry

   !> The bearings of a model without friction in equilibrium in the state y, alone and with the rotor, for each way
   !> that the pivots of its case may behave. `ok` is false where the films have no derivatives.
   subroutine linearize(model, y, alone, with_rotor, ok)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      type(linear_bearing_type), allocatable, intent(out) :: alone(:), with_rotor(:)
      logical, intent(out) :: ok
      real(wp), dimension(model%layout%n_positions(), model%layout%n_positions()) :: over_positions, over_rates
      integer :: i
      call model%evaluate(0.0_wp, y, .true., ok)
      if (.not. ok) return
      associate (pivots => pivots_of(model))
         call force_derivatives(model, over_positions, over_rates)
         with_rotor = [(linear_bearing_of(model, pivots(i), over_positions, over_rates), i=1, size(pivots))]
         do i = 1, size(pivots)
            call take_high_damping(model, with_rotor(i)%damping)
         end do
         call bearing_derivatives(model, over_positions, over_rates)
         alone = [(linear_bearing_of(model, pivots(i), over_positions, over_rates), i=1, size(pivots))]
      end associate
      associate (n => model%rotor%positions)
         do i = 1, size(alone)
            alone(i)%mass(:n, :n) = 0
         end do
      end associate
   end subroutine linearize

   !> A model with pivots that behave in one of these ways, from the derivatives of the forces in the state where it was
   !> evaluated last.
   type(linear_bearing_type) function linear_bearing_of(model, pivot, over_positions, over_rates) result(bearing)
      type(machine_model), intent(in) :: model
      character(len=*), intent(in) :: pivot
      real(wp), intent(in) :: over_positions(:, :), over_rates(:, :)
      bearing%pivot = pivot
      allocate (bearing%moves(size(over_rates, 1)), source=.true.)
      if (pivot == 'locked') bearing%moves(model%layout%turning()) = .false.
      bearing%mass = masses(model)
      bearing%stiffness = over_positions
      bearing%damping = over_rates
      if (pivot == 'stuck') call add_sticking(model, bearing%stiffness, bearing%damping)
      bearing%stiffness = -bearing%stiffness
      bearing%damping = -bearing%damping
   end function linear_bearing_of

   !> The ways that the pivots of a model's case may behave; fixed pads have one.
   pure function pivots_of(model) result(pivots)
      type(machine_model), intent(in) :: model
      character(len=pivot_name), allocatable :: pivots(:)
      integer :: b
      if (size(model%layout%tilts()) == 0) then
         pivots = [character(len=pivot_name) :: 'locked']
      else if (.not. any([(model%layout%elements(b)%has(tilt) .and. &
         & model%bearings(b)%pivots(1)%friction%static_coefficient > 0, b=1, size(model%bearings))])) then
         pivots = [character(len=pivot_name) :: 'free', 'locked']
      else
         pivots = [character(len=pivot_name) :: 'free', 'stuck', 'locked']
      end if
   end function pivots_of

   !> Stiffness, N/m, and damping, N s/m, that a journal meets which whirls at a frequency over the speed of the shaft,
   !> rad/s: Z_jj - Z_jp Z_pp^-1 Z_pj with Z = K + i nu C - nu^2 M of journal and pads of a layout; 2 x 2, or with
   !> slopes that act in it, which are else held, 4 x 4. `ok` is false where a vibration of the pads without damping has
   !> this frequency.
   subroutine condense(self, layout, ratio, speed, stiffness, damping, ok)
      class(linear_bearing_type), intent(in) :: self
      type(element_layout_type), intent(in) :: layout
      real(wp), intent(in) :: ratio, speed
      real(wp), intent(out) :: stiffness(:, :), damping(:, :)
      logical, intent(out) :: ok
      integer, allocatable :: kept(:)
      kept = layout%all_positions()
      associate (n => size(stiffness, 1))
         kept = [kept(:n), pack(kept(layout%of_rotor + 1:), self%moves(kept(layout%of_rotor + 1:)))]
         call reduce(self%stiffness(kept, kept), self%damping(kept, kept), self%mass(kept, kept), &
            & max(slowest, ratio)*speed, n, stiffness, damping, ok)
      end associate
   end subroutine condense

   !> The same of the first n positions, from these matrices of all, at a whirl frequency, rad/s.
   subroutine reduce(all_stiffness, all_damping, mass, frequency, n, stiffness, damping, ok)
      real(wp), intent(in) :: all_stiffness(:, :), all_damping(:, :), mass(:, :), frequency
      integer, intent(in) :: n
      real(wp), intent(out) :: stiffness(n, n), damping(n, n)
      logical, intent(out) :: ok
      complex(wp), allocatable :: z(:, :), response(:, :)
      complex(wp) :: left(n, n)
      z = cmplx(all_stiffness - frequency**2*mass, frequency*all_damping, wp)
      response = z(n + 1:, :n)
      call solve_complex(size(response, 1), n, z(n + 1:, n + 1:), response, ok)
      left = z(:n, :n) - matmul(z(:n, n + 1:), response)
      stiffness = left%re
      damping = left%im/frequency
   end subroutine reduce

   !> Stiffness and damping of y, z and the slopes of the journal of bearing b, where the derivatives of the model were
   !> taken last.
   subroutine condense_slopes(self, model, b, ratio, stiffness, damping, ok)
      class(linear_bearing_type), intent(in) :: self
      type(machine_model), intent(in) :: model
      integer, intent(in) :: b
      real(wp), intent(in) :: ratio
      real(wp), dimension(2*of_journal, 2*of_journal), intent(out) :: stiffness, damping
      logical, intent(out) :: ok
      real(wp), allocatable, dimension(:, :) :: k, c, m
      integer, allocatable :: places(:), at(:), kept(:), unsloped(:)
      integer, parameter :: slopes(of_journal) = [3, 4]
      integer :: i, j, n
      if (model%layout%elements(b)%of_rotor > of_journal) then
         call self%condense(model%layout%elements(b), ratio, model%point%speed(0.0_wp), stiffness, damping, ok)
         return
      end if
      places = model%layout%elements(b)%all_positions()
      n = size(places) + of_journal
      unsloped = [1, 2, (i, i=2*of_journal + 1, n)]
      allocate (k(n, n), c(n, n), m(n, n), source=0.0_wp)
      k(unsloped, unsloped) = self%stiffness(places, places)
      c(unsloped, unsloped) = self%damping(places, places)
      m(unsloped, unsloped) = self%mass(places, places)
      associate (own => model%layout%elements(b)%coordinates)
         do i = 1, model%layout%elements(b)%pads
            associate (of => model%bearings(b)%sloped%derivatives(i))
               at = [(j, j=1, 2*of_journal), (2*of_journal + (i - 1)*own + j, j=1, own)]
               k(slopes, at) = k(slopes, at) - of%over_positions(slopes, :size(at))
               c(slopes, at) = c(slopes, at) - of%over_rates(slopes, :size(at))
               associate (others => [1, 2, (j, j=2*of_journal + 1, size(at))])
                  k(at(others), slopes) = k(at(others), slopes) - of%over_positions(others, slopes)
                  c(at(others), slopes) = c(at(others), slopes) - of%over_rates(others, slopes)
               end associate
            end associate
         end do
      end associate
      kept = [1, 2, slopes, pack([(i, i=2*of_journal + 1, n)], self%moves(places(of_journal + 1:)))]
      call reduce(k(kept, kept), c(kept, kept), m(kept, kept), max(slowest, ratio)*model%point%speed(0.0_wp), &
         & 2*of_journal, stiffness, damping, ok)
   end subroutine condense_slopes

   !> The modes of rotor and pads with a cross-coupled stiffness, N/m. `ok` is false where the eigenvalues are not
   !> found.
   subroutine find_modes(bearing, cross_stiffness, lengths, modes, ok, model, error)
      type(linear_bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: cross_stiffness
      !> What stands for 1 rad of a position's, m; 1 where it is a displacement.
      real(wp), intent(in) :: lengths(:)
      type(vibration_modes_type), intent(out) :: modes
      logical, intent(out) :: ok
      !> Where it is given, elements that depend on the frequency of a whirl have that of each mode, else that of the
      !> speed; an error where there is none.
      type(machine_model), intent(in), optional :: model
      type(error_type), allocatable, intent(inout), optional :: error
      complex(wp), allocatable :: values(:), shapes(:, :)
      real(wp), allocatable :: ratio(:)
      integer, allocatable :: kept(:)
      logical, allocatable :: waiting(:)
      integer :: i, n, next
      kept = pack([(i, i=1, size(bearing%moves))], bearing%moves)
      call rotor_eigenvalues(bearing, cross_stiffness, values, ok, shapes)
      if (.not. ok) return
      if (present(model)) then
         select type (rotor => model%rotor)
         type is (elastic_rotor_type)
            call take_own_frequencies(rotor, model%point%speed(0.0_wp), bearing%stiffness(kept, kept), &
               & bearing%damping(kept, kept), bearing%mass(kept, kept), values, shapes, error)
         end select
      end if
      ratio = damping_ratio(values)
      ! what neither a film nor a damper holds, as a pad without load on a flexure pivot, has growths of rounding
      where (abs(ratio) <= no_growth)
         ratio = 0
         values = cmplx(0.0_wp, values%im, wp)
      end where
      waiting = values%im >= 0
      n = count(waiting)
      allocate (modes%eigenvalue(n), modes%shape(size(bearing%moves), n))
      modes%shape = 0
      do i = 1, n
         ! the one of least ratio, and of these the one of least size
         next = minloc(abs(values), dim=1, mask=waiting .and. ratio <= minval(ratio, mask=waiting))
         waiting(next) = .false.
         modes%eigenvalue(i) = values(next)
         modes%shape(kept, i) = normalised(shapes(:, next), lengths(kept))
      end do
      ! + 0: none of them is -0
      modes%damping_ratio = damping_ratio(modes%eigenvalue) + 0.0_wp
      allocate (modes%log_decrement(n), source=ieee_value(1.0_wp, ieee_quiet_nan))
      where (modes%eigenvalue%im > 0) modes%log_decrement = -2*pi*modes%eigenvalue%re/modes%eigenvalue%im + 0.0_wp
   end subroutine find_modes

   !> The eigenvalues, 1/s, of rotor and pads as above, and the shapes of the positions that move.
   subroutine rotor_eigenvalues(bearing, cross_stiffness, values, ok, shapes)
      type(linear_bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: cross_stiffness
      complex(wp), allocatable, intent(out) :: values(:)
      logical, intent(out) :: ok
      complex(wp), allocatable, intent(out), optional :: shapes(:, :)
      real(wp), allocatable, dimension(:, :) :: stiffness
      integer, allocatable :: kept(:)
      integer :: i
      kept = pack([(i, i=1, size(bearing%moves))], bearing%moves)
      allocate (values(2*size(kept)))
      if (present(shapes)) allocate (shapes(size(kept), 2*size(kept)))
      stiffness = bearing%stiffness(kept, kept)
      ! what is displaced along y is pushed along z, and what is displaced along z against y: forward where the shaft
      ! turns clockwise
      stiffness(1, 2) = stiffness(1, 2) + cross_stiffness
      stiffness(2, 1) = stiffness(2, 1) - cross_stiffness
      call find_vibrations(bearing%mass(kept, kept), -stiffness, -bearing%damping(kept, kept), values, ok, shapes)
   end subroutine rotor_eigenvalues

   !> 1 where nothing moves.
   elemental real(wp) function damping_ratio(value)
      complex(wp), intent(in) :: value
      damping_ratio = 1
      if (.not. abs(value) <= 0) damping_ratio = -value%re/abs(value)
   end function damping_ratio

   !> A shape over its largest element, each times the length that stands for it.
   pure function normalised(shape, lengths)
      complex(wp), intent(in) :: shape(:)
      real(wp), intent(in) :: lengths(:)
      complex(wp) :: normalised(size(shape))
      associate (largest => maxloc(abs(shape)*lengths, dim=1))
         normalised = shape/(shape(largest)*lengths(largest))
      end associate
   end function normalised

   !> Takes away the damping that the reduction gives to the high modes of the shaft: marches alone need it.
   pure subroutine take_high_damping(model, damping)
      type(machine_model), intent(in) :: model
      real(wp), intent(inout) :: damping(:, :)
      integer :: i
      select type (rotor => model%rotor)
      type is (elastic_rotor_type)
         do i = 1, rotor%positions
            damping(i, i) = damping(i, i) - rotor%matrices%high_damping(i)
         end do
      end select
   end subroutine take_high_damping
end module linear_bearing
