!> The forces on rotor and elements, their derivatives over positions and rates, and the masses: not divided by each
!> other, in the order of layout%positions(); the eigenvalues of small vibrations about an equilibrium, what they say of
!> it, and what moves in a mode, in words: 'journal, forward', 'shaft, backward', 'pad 3, tilt', 'pads, pivot
!> deflection'.
module force_balance
   use kinds, only: wp
   use text, only: to_text, replaced
   use state_layout, only: of_journal, tilt
   use abstract_element, only: element_pointer, element_type
   use equations_of_motion, only: machine_model
   use linear_algebra, only: find_eigenvalues, solve
   use friction, only: friction_response
   implicit none (type, external)
   private
   public :: mode_name_length, mode_name, is_of_rotor, at_stations, position_lengths, position_names
   public :: forces, force_derivatives, bearing_derivatives, other_derivatives, part_derivatives, masses, add_sticking
   public :: stability_type, stability_at, stability_of, find_vibrations, no_growth


   !> Lengths of the names of modes, and of positions.
   integer, parameter :: mode_name_length = 100, longest_position = 19
   !> Pads that tilt follow the journal, so that their tilts are as large as its displacement in its own modes, and many
   !> times as large in those of pads: a mode is the rotor's if its displacement is this part of the largest, or more.
   real(wp), parameter :: share_of_rotor = 0.25_wp
   !> A mode is of several pads if a second one moves this part of the largest, or more.
   real(wp), parameter :: share_of_pad = 0.5_wp
   !> Shorter over longer axis of an ellipse below which a mode is planar; what is left of the areas of all stations,
   !> those that go backward taken off, from which on they go one way.
   real(wp), parameter :: narrowest = 0.05_wp, one_way = 0.5_wp

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

   !> The name of a mode of this shape: by its largest part, as its positions are displaced times the lengths that stand
   !> for 1 rad of a tilt. What a vibration of the rotor does stands behind it.
   function mode_name(model, shape, lengths, vibrates) result(name)
      type(machine_model), intent(in), target :: model
      complex(wp), intent(in) :: shape(:)
      real(wp), intent(in) :: lengths(:)
      logical, intent(in) :: vibrates
      character(len=mode_name_length) :: name
      real(wp) :: sizes(size(shape)), of_pad, largest, second
      type(element_pointer), allocatable :: elements(:)
      integer :: b, i, bearing, pad
      sizes = abs(shape)*lengths
      if (maxval(sizes(:model%rotor%positions)) >= share_of_rotor*maxval(sizes)) then
         name = merge('shaft  ', 'journal', model%rotor%stations > 0)
         if (vibrates) name = trim(name)//', '//whirl_word(model, shape)
         return
      end if
      largest = 0
      second = 0
      do b = 1, size(model%layout%elements)
         do i = 1, model%layout%elements(b)%pads
            if (model%layout%elements(b)%coordinates == 0) cycle
            of_pad = maxval(sizes(model%layout%elements(b)%own_positions(i)))
            second = max(second, min(of_pad, largest))
            if (of_pad <= largest) cycle
            largest = of_pad
            bearing = b
            pad = i
         end do
      end do
      name = 'pads'
      if (second < share_of_pad*largest) then
         name = 'pad '//to_text(pad)
         if (bearing <= size(model%bearings)) then
            name = model%inputs%bearings(bearing)%label(', ')//name
         else
            name = 'element '//to_text(bearing - size(model%bearings))//', '//name
         end if
      end if
      elements = model%elements()
      associate (of => model%layout%elements(bearing))
         name = trim(name)//', '//replaced(elements(bearing)%to%position_name(maxloc(sizes(of%own_positions(pad)), &
            & dim=1)), '_', ' ')
      end associate
   end function mode_name

   !> What stands for a unit of each position, m: of a rotor's coordinate that is no displacement how far it moves a
   !> station; of a pad's tilt the distance from the pivot to the centre of its arc; 1 for others.
   function position_lengths(model) result(lengths)
      type(machine_model), intent(in) :: model
      real(wp), allocatable :: lengths(:)
      allocate (lengths(model%layout%n_positions()), source=1.0_wp)
      associate (n => 2*model%rotor%journals, m => model%rotor%positions)
         lengths(n + 1:m) = model%least_clearance()/model%scale(n + 1:m)
      end associate
      lengths(model%rotor%positions + 1:) = model%own_lengths()
   end function position_lengths

   !> Names of the displacements of a bearing's journal and pads, in the order of all_positions of its layout.
   function position_names(model, b) result(names)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: b
      character(len=longest_position) :: names(model%layout%elements(b)%of_rotor + model%layout%elements(b)%pads &
         & *model%layout%elements(b)%coordinates)
      integer :: i, k
      names(:of_journal) = ['y', 'z']
      associate (n => model%layout%elements(b)%coordinates, of_rotor => model%layout%elements(b)%of_rotor)
         if (of_rotor > of_journal) names(of_journal + 1:of_rotor) = ['slope_y', 'slope_z']
         do i = 1, model%layout%elements(b)%pads
            do k = 1, n
               names(of_rotor + (i - 1)*n + k) = model%bearings(b)%position_name(k)//'_'//to_text(i)
            end do
         end do
      end associate
   end function position_names

   !> Whether a mode of this name is one of the rotor, and not of pads.
   elemental logical function is_of_rotor(name)
      character(len=*), intent(in) :: name
      is_of_rotor = index(name, 'journal') == 1 .or. index(name, 'shaft') == 1
   end function is_of_rotor

   !> How the stations of a shaft, or the journal, go round: forward, in the sense of rotation, or backward; planar
   !> where their paths are lines or narrow ellipses; mixed where some go forward and others backward.
   pure function whirl_word(model, shape) result(word)
      type(machine_model), intent(in) :: model
      complex(wp), intent(in) :: shape(:)
      character(len=:), allocatable :: word
      complex(wp) :: places(2, max(1, model%rotor%stations))
      real(wp) :: turned(size(places, 2))
      if (model%rotor%stations > 0) then
         places = at_stations(model, shape)
      else
         places(:, 1) = shape(:2)
      end if
      ! of an ellipse the product of its semi-axes, whose squares sum to |y|**2 + |z|**2
      turned = -model%point%sense*aimag(conjg(places(1, :))*places(2, :))
      if (sum(abs(turned)) < narrowest*sum(abs(places)**2)) then
         word = 'planar'
      else if (abs(sum(turned)) < one_way*sum(abs(turned))) then
         word = 'mixed'
      else
         word = trim(merge('forward ', 'backward', sum(turned) > 0))
      end if
   end function whirl_word

   !> Stations of the rotor's displacements, which turn, m.
   pure function at_stations(model, positions) result(stations)
      type(machine_model), intent(in) :: model
      complex(wp), intent(in) :: positions(:)
      complex(wp) :: stations(2, model%rotor%stations)
      real(wp) :: states(model%rotor%states), still(2, model%rotor%stations)
      real(wp), dimension(2, model%rotor%stations) :: re, im
      associate (n => model%rotor%positions)
         states = 0
         still = model%rotor%station_displacements(states)
         states(:n) = positions(:n)%re
         re = model%rotor%station_displacements(states) - still
         states(:n) = positions(:n)%im
         im = model%rotor%station_displacements(states) - still
      end associate
      stations = cmplx(re, im, wp)
   end function at_stations

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
            if (of%of_rotor > of_journal) call elements(e)%to%add_moment(forces(of%slopes(1):of%slopes(of_journal)))
            do i = 1, of%pads
               forces(of%own_positions(i)) = [(elements(e)%to%own_force(i, k), k=1, of%coordinates)]
            end do
         end associate
      end do
   end function forces

   !> Derivatives of these forces over positions and over rates, where the derivatives of the elements were taken last,
   !> with those of friction in the state evaluated last.
   subroutine force_derivatives(model, over_positions, over_rates, at_rest)
      type(machine_model), intent(in), target :: model
      real(wp), intent(out) :: over_positions(:, :), over_rates(:, :)
      !> Those of the forces that act at the equilibrium; left out: in motion about it.
      logical, intent(in), optional :: at_rest
      real(wp), dimension(model%rotor%positions, model%rotor%positions) :: stiffness, damping
      call add_elements(model, 1, size(model%layout%elements), over_positions, over_rates)
      call model%rotor%force_derivatives(model%point%speed(0.0_wp), stiffness, damping, at_rest)
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

   !> Those of what acts on the rotor beside them.
   subroutine other_derivatives(model, over_positions, over_rates)
      type(machine_model), intent(in), target :: model
      real(wp), intent(out) :: over_positions(:, :), over_rates(:, :)
      call add_elements(model, size(model%bearings) + 1, size(model%layout%elements), over_positions, over_rates)
   end subroutine other_derivatives

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

   !> What a part of an element, with n displacements, adds to these, with friction: derivatives of the forces on what
   !> it knows of the rotor and of the part's own forces over the displacements of both and over their rates.
   pure subroutine part_derivatives(element, part, n, over_positions, over_rates)
      class(element_type), intent(in) :: element
      integer, intent(in) :: part, n
      real(wp), allocatable, intent(out) :: over_positions(:, :), over_rates(:, :)
      real(wp) :: over_bristle(element%of_rotor + n - of_journal)
      associate (m => element%of_rotor + n)
         allocate (over_positions(m, m), over_rates(m, m))
         call element%part_derivatives(part, m, .false., over_positions, over_rates)
         call element%add_late(part, m, .false., over_positions, over_rates, over_bristle)
      end associate
   end subroutine part_derivatives

   !> Adds to the derivatives of the forces at rest what friction adds where the pivots stick, under the pivot loads
   !> evaluated last: bristles that are not deflected move with the pivot; a law without them has its slope at no
   !> velocity.
   pure subroutine add_sticking(model, over_positions, over_rates)
      type(machine_model), intent(in) :: model
      real(wp), intent(inout) :: over_positions(:, :), over_rates(:, :)
      type(friction_response) :: friction
      integer :: b, i, k, at
      do b = 1, size(model%bearings)
         associate (bearing => model%bearings(b))
            do i = 1, size(bearing%pads)
               if (.not. model%layout%elements(b)%has(tilt)) cycle
               call bearing%pivots(i)%friction%evaluate(0.0_wp, 0.0_wp, bearing%loads(i)%contact, friction)
               associate (square => bearing%pads(i)%ball_radius**2, of => model%layout%elements(b))
                  do k = 1, of%rotations
                     at = of%first_position(i) - 1 + of%rotation(k)
                     over_positions(at, at) = over_positions(at, at) &
                        & - square*friction%force_deflection*friction%rate_velocity
                     over_rates(at, at) = over_rates(at, at) - square*friction%force_velocity
                  end do
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
      complex(wp), allocatable :: vectors(:, :)
      integer :: i
      associate (n => size(mass, 1))
         per_mass(:, :n) = stiffness
         per_mass(:, n + 1:) = damping
         call solve(n, 2*n, mass, per_mass, ok)
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
