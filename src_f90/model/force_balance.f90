!> The forces on rotor and elements, their derivatives over positions and rates, and the masses: not divided by each
!> other, in the order of layout%positions(); the eigenvalues of small vibrations about an equilibrium, and what they
!> say of it.
module force_balance
   use kinds, only: wp
   use linear_algebra, only: find_eigenvalues, dgesv
   use friction, only: friction_response
   use state_layout, only: tilt, of_journal
   use abstract_element, only: element_type, element_pointer
   use equations_of_motion, only: machine_model
   use mode_names, only: mode_name, is_of_rotor, position_lengths
   implicit none (type, external)
   private
   public :: forces, force_derivatives, bearing_derivatives, part_derivatives, masses, add_sticking
   public :: stability_type, stability_at, stability_of, find_vibrations

   !> How a state in equilibrium answers a small disturbance.
   type :: stability_type
      !> The eigenvalue of largest real part, 1/s; of a pair the one with positive imaginary part.
      complex(wp) :: eigenvalue = 0
      !> 'stable'; 'oscillatory instability': vibrations grow; 'static instability': it is left without vibration, and
      !> no motion dwells there.
      character(len=:), allocatable :: name
      !> Whether motions of journal or shaft grow, and motions of pads alone.
      logical :: rotor_grows = .false., pads_grow = .false.
   end type stability_type

   !> Growth in a radian of the shaft that counts as none: films without any stiffness leave eigenvalues of rounding.
   real(wp), parameter :: no_growth = 1e-6_wp

contains

   !> Forces on the displacements of the rotor, N, and along those of the elements (moments, N m, along tilts) in the
   !> state y, which was evaluated last, at time t, s.
   function forces(model, t, y)
      type(machine_model), intent(in), target :: model
      real(wp), intent(in) :: t, y(:)
      real(wp) :: forces(model%layout%n_positions())
      type(element_pointer), allocatable :: elements(:)
      integer :: e, i, k
      forces(:model%rotor%positions) = model%rotor%force(y(:model%rotor%states), model%point, t)
      elements = model%elements()
      do e = 1, size(elements)
         associate (of => model%layout%elements(e))
            call elements(e)%to%add_force(forces(of%journal(1):of%journal(of_journal)))
            do i = 1, of%pads
               forces(of%own_positions(i)) = [(elements(e)%to%own_force(i, k), k=1, of%coordinates)]
            end do
         end associate
      end do
   end function forces

   !> Derivatives of these forces over positions and over rates, where the derivatives of the elements were taken last,
   !> with those of friction in the state evaluated last.
   subroutine force_derivatives(model, over_positions, over_rates)
      type(machine_model), intent(in), target :: model
      real(wp), intent(out) :: over_positions(:, :), over_rates(:, :)
      real(wp), dimension(model%rotor%positions, model%rotor%positions) :: stiffness, damping
      call add_elements(model, 1, size(model%layout%elements), over_positions, over_rates)
      call model%rotor%force_derivatives(model%point%speed(0.0_wp), stiffness, damping)
      associate (n => model%rotor%positions)
         over_positions(:n, :n) = over_positions(:n, :n) + stiffness
         over_rates(:n, :n) = over_rates(:n, :n) + damping
      end associate
   end subroutine force_derivatives

   !> Those of the bearings' forces alone.
   subroutine bearing_derivatives(model, over_positions, over_rates)
      type(machine_model), intent(in), target :: model
      real(wp), intent(out) :: over_positions(:, :), over_rates(:, :)
      call add_elements(model, 1, size(model%bearings), over_positions, over_rates)
   end subroutine bearing_derivatives

   !> Those of the elements from one to another.
   subroutine add_elements(model, first, last, over_positions, over_rates)
      type(machine_model), intent(in), target :: model
      integer, intent(in) :: first, last
      real(wp), intent(out) :: over_positions(:, :), over_rates(:, :)
      type(element_pointer), allocatable :: elements(:)
      real(wp), allocatable, dimension(:, :) :: positions, rates
      integer :: e, i
      over_positions = 0
      over_rates = 0
      elements = model%elements()
      do e = first, last
         do i = 1, model%layout%elements(e)%parts
            call part_derivatives(elements(e)%to, i, model%layout%elements(e)%coordinates, positions, rates)
            associate (at => model%layout%elements(e)%positions_of(i))
               over_positions(at, at) = over_positions(at, at) + positions
               over_rates(at, at) = over_rates(at, at) + rates
            end associate
         end do
      end do
   end subroutine add_elements

   !> What a part of an element, with n displacements, adds to these, with friction: derivatives of the force on the
   !> pair, y and z, and of the part's own forces over the displacements of both and over their rates.
   pure subroutine part_derivatives(element, part, n, over_positions, over_rates)
      class(element_type), intent(in) :: element
      integer, intent(in) :: part, n
      real(wp), allocatable, intent(out) :: over_positions(:, :), over_rates(:, :)
      real(wp) :: over_bristle(n)
      allocate (over_positions(of_journal + n, of_journal + n), over_rates(of_journal + n, of_journal + n))
      call element%part_derivatives(part, of_journal + n, .false., over_positions, over_rates)
      call element%add_late(part, of_journal + n, .false., over_positions, over_rates, over_bristle)
   end subroutine part_derivatives

   !> Adds to the derivatives of the forces at rest what friction adds where the pivots stick, under the pivot loads
   !> evaluated last: bristles that are not deflected move with the pivot; a law without them has its slope at no
   !> velocity.
   pure subroutine add_sticking(model, over_positions, over_rates)
      type(machine_model), intent(in) :: model
      real(wp), intent(inout) :: over_positions(:, :), over_rates(:, :)
      type(friction_response) :: friction
      integer :: b, i, at
      do b = 1, size(model%bearings)
         associate (bearing => model%bearings(b))
            do i = 1, size(bearing%pads)
               if (.not. model%layout%elements(b)%has(tilt)) cycle
               at = model%layout%elements(b)%first_position(i)
               call bearing%pivots(i)%friction%evaluate(0.0_wp, 0.0_wp, bearing%loads(i)%contact, friction)
               associate (square => bearing%pads(i)%ball_radius**2)
                  over_positions(at, at) = over_positions(at, at) &
                     & - square*friction%force_deflection*friction%rate_velocity
                  over_rates(at, at) = over_rates(at, at) - square*friction%force_velocity
               end associate
            end do
         end associate
      end do
   end subroutine add_sticking

   !> Masses of the positions: those of the rotor, and of each pad the matrix of eqs (3)-(4).
   function masses(model)
      type(machine_model), intent(in), target :: model
      real(wp) :: masses(model%layout%n_positions(), model%layout%n_positions())
      type(element_pointer), allocatable :: elements(:)
      integer :: e, i, first, last
      masses = 0
      associate (n => model%rotor%positions)
         masses(:n, :n) = model%rotor%masses()
      end associate
      elements = model%elements()
      do e = 1, size(elements)
         associate (of => model%layout%elements(e))
            do i = 1, of%pads
               first = of%first_position(i)
               last = first + of%coordinates - 1
               call elements(e)%to%part_masses(i, of%coordinates, masses(first:last, first:last))
            end do
         end associate
      end do
   end function masses

   !> The stability of a model in equilibrium in the state y.
   subroutine stability_at(model, y, stability, ok)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      type(stability_type), intent(out) :: stability
      !> False where the films have no derivatives or the eigenvalues are not found.
      logical, intent(out) :: ok
      complex(wp) :: values(2*model%layout%n_positions())
      real(wp), dimension(model%layout%n_positions(), model%layout%n_positions()) :: stiffness, damping
      call model%evaluate(0.0_wp, y, .true., ok)
      if (.not. ok) return
      call force_derivatives(model, stiffness, damping)
      call find_vibrations(masses(model), stiffness, damping, values, ok)
      if (ok) stability = stability_of(values, no_growth*model%point%speed(0.0_wp))
      if (ok .and. stability%name /= 'stable') call find_what_grows()
   contains
      subroutine find_what_grows()
         complex(wp) :: shapes(size(stiffness, 1), size(values))
         logical :: of_rotor(size(values)), found
         integer :: k
         call find_vibrations(masses(model), stiffness, damping, values, found, shapes)
         if (.not. found) return
         of_rotor = [(is_of_rotor(mode_name(model, shapes(:, k), position_lengths(model), .false.)), k=1, size(values))]
         associate (grows => values%re > no_growth*model%point%speed(0.0_wp))
            stability%rotor_grows = any(grows .and. of_rotor)
            stability%pads_grow = any(grows .and. .not. of_rotor)
         end associate
      end subroutine find_what_grows
   end subroutine stability_at

   !> What eigenvalues, 1/s, say, with a growth, 1/s, that counts as none.
   pure type(stability_type) function stability_of(values, no_growth) result(stability)
      complex(wp), intent(in) :: values(:)
      real(wp), intent(in) :: no_growth
      stability%eigenvalue = values(maxloc(values%re, dim=1))
      stability%eigenvalue%im = abs(stability%eigenvalue%im)
      if (any(values%re > no_growth .and. abs(values%im) <= 0)) then
         stability%name = 'static instability'
      else if (stability%eigenvalue%re > no_growth) then
         stability%name = 'oscillatory instability'
      else
         stability%name = 'stable'
      end if
   end function stability_of

   !> Eigenvalues of M x'' = C x' + K x, with the derivatives of the forces over positions, K, and over rates, C.
   subroutine find_vibrations(mass, stiffness, damping, values, ok, shapes)
      real(wp), intent(in) :: mass(:, :), stiffness(:, :), damping(:, :)
      complex(wp), intent(out) :: values(2*size(mass, 1))
      logical, intent(out) :: ok
      !> The positions in the vibration of each eigenvalue, (position, eigenvalue), of any size and phase.
      complex(wp), intent(out), optional :: shapes(:, :)
      real(wp) :: matrix(2*size(mass, 1), 2*size(mass, 1)), per_mass(size(mass, 1), 2*size(mass, 1))
      real(wp) :: factors(size(mass, 1), size(mass, 1))
      complex(wp), allocatable :: vectors(:, :)
      integer :: pivots(size(mass, 1)), info, i
      associate (n => size(mass, 1))
         per_mass(:, :n) = stiffness
         per_mass(:, n + 1:) = damping
         factors = mass
         call dgesv(n, 2*n, factors, n, pivots, per_mass, n, info)
         ok = info == 0
         if (.not. ok) return
         matrix = 0
         do i = 1, n
            matrix(i, n + i) = 1
         end do
         matrix(n + 1:, :) = per_mass
         if (present(shapes)) allocate (vectors(2*n, 2*n))
         call find_eigenvalues(matrix, values, ok, vectors)
         if (present(shapes) .and. ok) shapes = vectors(:n, :)
      end associate
   end subroutine find_vibrations
end module force_balance
