!> Builds the film solver, contact law, friction law and pads of a bearing: the only module that turns names of the
!> input into types.
module factories
   use kinds, only: wp, degree
   use case_inputs, only: case_type
   use case_groups, only: bearing_type, film_type, pivot_type, friction_type, asperity_type, is_set
   use pad_gap, only: pad_gap_type
   use film_solver, only: film_solver_type, cavitation_none, cavitation_gumbel, cavitation_reynolds
   use fourier_film, only: new_fourier_film
   use film_resolution, only: enough_cells, enough_modes, usual_error
   use sloped_film, only: sloped_film_type, new_sloped_film
   use small_slopes, only: small_slopes_type, new_small_slopes
   use direct_film, only: direct_film_type, new_direct_film
   use table_film, only: new_table_film
   use film_losses, only: film_losses_type, new_film_losses
   use film_law, only: film_law_type
   use film_oils, only: film_oil
   use turbulence_closure, only: new_closure
   use turbulent_film, only: turbulent_film_type
   use sor_film, only: new_sor_film, sor_options
   use contact_law, only: contact_law_type, make_contact_law, new_measured_contact, &
      & new_linear_contact, new_rocker_contact
   use contact_table, only: contact_table_type, new_contact_table, new_untabulated_contact
   use friction, only: friction_law, bengisu_akay_friction, lugre_friction, default_bristle_damping, never_sticks
   use asperity_contact, only: asperity_contact_type, new_asperity_contact, no_asperities
   use tilting_pad, only: tilting_pad_type
   implicit none (type, external)
   private
   public :: make_film, make_sloped_film, make_laws, law_changes, usual_arc, march_films, static_films, &
      & converged_films, quick_films, filled_films, of_march, new_losses, make_law, make_friction, new_asperities, &
      & new_pads, pad_pivot, make_contacts

   !> What films are for: a march; the search for an equilibrium, which goes far and stays nowhere; what is linearised
   !> at a single state, with converged films; long ways of which only the end counts; a few states of a march, with
   !> the films that a long march has, whose tables are filled.
   integer, parameter :: march_films = 1, static_films = 2, converged_films = 3, quick_films = 4, filled_films = 5

   !> Finite volumes along the arc and along half the width where the input leaves them to the solver, by the
   !> errors in docs/benchmarks.md.
   integer, parameter :: sor_volumes(2) = [60, 15], cavitation_volumes(2) = [80, 8]
   !> Of converged films, errors of full films, of clipped ones and of cavitated ones (test_film_accuracy); of volumes
   !> where no table knows the film.
   real(wp), parameter :: converged_full_error = 4e-7_wp, converged_error = 1e-6_wp, &
      & converged_cavitated_error = 1.3e-5_wp, converged_volumes_error = 2e-3_wp
   !> Error of quick films.
   real(wp), parameter :: quick_error = 1e-2_wp
   !> Residual and sweeps of over-relaxation in statics: a tenth of the unbalanced force that an equilibrium may leave
   !> (static_model).
   real(wp), parameter :: static_residual = 1e-9_wp
   integer, parameter :: static_sweeps = 100000
   !> This number of volumes serves an arc of this length, rad, and shorter ones.
   real(wp), parameter :: usual_arc = 120*degree
   !> Of forces from tables: what rounding leaves.
   real(wp), parameter :: least_tolerance = 1e-12_wp
   !> Residual of over-relaxation over the relative tolerance of the march, at most, and what rounding leaves: films
   !> solved less well shake stiff pivots, and the steps become short.
   real(wp), parameter :: sor_tolerance = 1e-3_wp, least_residual = 1e-13_wp

   type :: pad_pivot
      type(contact_table_type) :: contact
      class(friction_law), allocatable :: friction
   end type pad_pivot

contains

   !> The film solver of all pads. No function: gfortran never frees the result of one whose type is chosen within,
   !> and Python makes a solver for every instant.
   subroutine make_film(bearing, tolerance, accuracy, film, law_changes)
      type(bearing_type), intent(in) :: bearing
      !> The relative one of a march.
      real(wp), intent(in) :: tolerance
      !> One of the five above.
      integer, intent(in) :: accuracy
      class(film_solver_type), allocatable, intent(out) :: film
      !> Whether the law of the films changes in a march, so that no table holds.
      logical, intent(in), optional :: law_changes
      type(pad_gap_type) :: gaps(bearing%pad_count())
      character(len=:), allocatable :: solver
      integer :: cells, modes, volumes(2), condition
      real(wp), allocatable :: error, of_volumes
      real(wp) :: of_tables
      type(direct_film_type) :: direct
      gaps = new_gaps(bearing)
      associate (f => bearing%film)
         condition = cavitation_of(f%cavitation)
         cells = merge(f%circumferential_cells, enough_cells(gaps), f%circumferential_cells > 0)
         modes = merge(f%axial_modes, enough_modes(gaps), f%axial_modes > 0)
         ! what the input sets stays the same for every film
         if (f%circumferential_cells + f%axial_modes == 0) error = merge(quick_error, usual_error, &
            & accuracy == quick_films)
         if (allocated(error) .and. accuracy == converged_films) error = converged_error
         volumes = volumes_of(f, gaps, cavitation_volumes)
         if (accuracy == converged_films .and. f%circumferential_cells + f%axial_cells == 0) then
            of_volumes = converged_volumes_error
         end if
         solver = f%solver
         if (accuracy == quick_films .or. solver == 'auto' .and. accuracy == static_films) solver = 'direct'
         if (present(law_changes)) then
            if (law_changes .and. solver == 'auto') solver = 'direct'
         end if
         select case (solver)
         case ('sor')
            film = new_sor_film(gaps, sor_settings(f, gaps, tolerance, accuracy))
         case ('fourier')
            film = new_fourier_film(gaps, cells, modes, condition == cavitation_gumbel, error)
         case ('direct')
            film = new_direct_film(gaps, cells, modes, volumes(1), volumes(2), condition, error, of_volumes)
         case default
            direct = new_direct_film(gaps, cells, modes, volumes(1), volumes(2), condition, error, of_volumes)
            of_tables = max(f%table_tolerance, least_tolerance)
            if (of_march(accuracy)) then
               ! cavitated films by volumes are dear, by modes they are cheap
               associate (usual => merge(1, 4, condition == cavitation_gumbel)*tolerance)
                  film = new_table_film(direct, .true., merge(of_tables, usual, f%table_tolerance > 0), &
                     & filled=accuracy == filled_films, fixed=.not. bearing%tilting())
               end associate
            else if (f%table_tolerance > 0) then
               film = new_table_film(direct, .false., of_tables)
            else
               film = new_table_film(direct, .false., merge(converged_error, converged_cavitated_error, &
                  & condition == cavitation_gumbel), converged_full_error)
            end if
         end select
      end associate
   end subroutine make_film

   !> The films of all pads where slopes of the journal count, and tables of small slopes but where films are to be
   !> close.
   subroutine make_sloped_film(bearing, accuracy, film, small)
      type(bearing_type), intent(in) :: bearing
      !> One of the five above.
      integer, intent(in) :: accuracy
      type(sloped_film_type), intent(out) :: film
      type(small_slopes_type), allocatable, intent(inout) :: small
      associate (closely => any(accuracy == [static_films, converged_films]), &
         & condition => cavitation_of(bearing%film%cavitation))
         film = new_sloped_film(new_gaps(bearing), condition, closely)
         if (allocated(small)) deallocate (small)
         if (.not. closely) small = new_small_slopes(new_gaps(bearing), condition)
      end associate
   end subroutine make_sloped_film

   !> The laws of the films of this number of pads, unless they are these already.
   subroutine make_laws(film, pads, laws)
      type(film_type), intent(in) :: film
      integer, intent(in) :: pads
      class(film_law_type), allocatable, intent(inout) :: laws(:)
      type(turbulent_film_type), allocatable :: turbulent(:)
      if (film%turbulence == 'none') then
         if (allocated(laws)) then
            if (same_type_as(laws, film_oil())) return
            deallocate (laws)
         end if
         allocate (film_oil :: laws(pads))
         return
      end if
      if (allocated(laws)) then
         select type (laws)
         type is (turbulent_film_type)
            if (laws(1)%closure%is_that_of(film%turbulence, film%laminar_below, film%turbulent_above)) return
         end select
         deallocate (laws)
      end if
      allocate (turbulent(pads))
      turbulent%closure = new_closure(film%turbulence, film%laminar_below, film%turbulent_above)
      call move_alloc(turbulent, laws)
   end subroutine make_laws

   !> Whether films of a bearing are turbulent at speeds or with viscosities that change in a march.
   pure logical function law_changes(inputs, bearing)
      type(case_type), intent(in) :: inputs
      type(bearing_type), intent(in) :: bearing
      law_changes = bearing%film%turbulence /= 'none' .and. .not. (inputs%is_steady() &
         & .and. inputs%thermal%march == 'frozen')
   end function law_changes

   !> True for the films of a march.
   elemental logical function of_march(accuracy)
      integer, intent(in) :: accuracy
      of_march = any(accuracy == [march_films, filled_films])
   end function of_march

   !> Volumes along the longest arc and along half the width, from those of a usual arc, unless the input names them.
   pure function volumes_of(film, gaps, usual) result(volumes)
      type(film_type), intent(in) :: film
      type(pad_gap_type), intent(in) :: gaps(:)
      integer, intent(in) :: usual(2)
      integer :: volumes(2)
      associate (given => [film%circumferential_cells, film%axial_cells])
         volumes = merge(given, usual*[max(1, nint(maxval(gaps%arc())/usual_arc)), 1], given > 0)
      end associate
   end function volumes_of

   pure type(sor_options) function sor_settings(f, gaps, tolerance, accuracy) result(options)
      type(film_type), intent(in) :: f
      type(pad_gap_type), intent(in) :: gaps(:)
      real(wp), intent(in) :: tolerance
      integer, intent(in) :: accuracy
      integer :: volumes(2)
      volumes = volumes_of(f, gaps, sor_volumes)
      options = sor_options(volumes(1), volumes(2), f%relaxation, &
         & min(f%tolerance, max(least_residual, sor_tolerance*tolerance)), f%max_sweeps, cavitation_of(f%cavitation))
      if (of_march(accuracy)) return
      options%tolerance = min(options%tolerance, static_residual)
      options%max_sweeps = max(options%max_sweeps, static_sweeps)
   end function sor_settings

   !> The number by which films know a condition of cavitation.
   pure integer function cavitation_of(name) result(cavitation)
      character(*), intent(in) :: name
      select case (name)
      case ('none')
         cavitation = cavitation_none
      case ('gumbel')
         cavitation = cavitation_gumbel
      case default
         cavitation = cavitation_reynolds
      end select
   end function cavitation_of

   !> What finds losses and flows of the films of all pads: by converged films, whatever solver the motion takes.
   pure function new_losses(bearing) result(losses)
      type(bearing_type), intent(in) :: bearing
      type(film_losses_type) :: losses(bearing%pad_count())
      type(pad_gap_type) :: gaps(bearing%pad_count())
      integer :: i
      gaps = new_gaps(bearing)
      do i = 1, size(gaps)
         losses(i) = new_film_losses(gaps(i), cavitation_of(bearing%film%cavitation))
      end do
   end function new_losses

   !> The gaps between pads and journal.
   pure function new_gaps(b) result(gaps)
      type(bearing_type), intent(in) :: b
      type(pad_gap_type) :: gaps(b%pad_count())
      integer :: i
      associate (p => b%pads)
         do i = 1, size(gaps)
            gaps(i) = pad_gap_type(b%journal_radius, b%machined_clearance(i), b%axial_length(i), &
               & p%pivot_ratio(i)*p%arc_deg(i)*degree, (1 - p%pivot_ratio(i))*p%arc_deg(i)*degree, &
               & b%supply_pressure, b%ambient_pressure, b%cavitation_pressure)
         end do
      end associate
   end function new_gaps

   !> The contact law of a pad's pivot.
   subroutine make_law(v, pad, law)
      type(pivot_type), intent(in) :: v
      integer, intent(in) :: pad
      class(contact_law_type), allocatable, intent(out) :: law
      select case (v%law)
      case ('table')
         allocate (law, source=new_measured_contact(v%measured(pad)%points, v%socket_radius(pad), &
            & v%radius_difference(pad)))
      case ('rocker')
         allocate (law, source=new_rocker_contact(v%contact_length(pad), v%socket_radius(pad), &
            & v%radius_difference(pad), v%young_modulus, v%poisson_ratio))
      case ('linear')
         allocate (law, source=new_linear_contact(v%stiffness(pad), v%socket_radius(pad), v%radius_difference(pad)))
      case default
         call make_contact_law(v%law, v%socket_radius(pad), v%radius_difference(pad), v%young_modulus, &
            & v%poisson_ratio, v%deflection_factor, law)
      end select
   end subroutine make_law

   !> The friction law of a pad's pivot.
   subroutine make_friction(f, pad, law)
      type(friction_type), intent(in) :: f
      integer, intent(in) :: pad
      class(friction_law), allocatable, intent(out) :: law
      real(wp) :: damping
      select case (f%model)
      case ('bengisu_akay')
         law = bengisu_akay_friction(.false., f%static_coefficient(pad), f%dynamic_coefficient(pad), &
            & f%critical_velocity, f%decay)
      case ('lugre')
         damping = f%bristle_damping
         if (.not. is_set(damping)) damping = default_bristle_damping(f%bristle_stiffness, f%characteristic_load)
         law = lugre_friction(.true., f%static_coefficient(pad), f%dynamic_coefficient(pad), never_sticks, &
            & f%stribeck_velocity, f%stribeck_exponent, f%bristle_stiffness, damping, f%viscous_coefficient)
      case default
         law = friction_law()
      end select
   end subroutine make_friction

   !> The contact of pads and journal, whose surface has this highest speed, m/s.
   pure type(asperity_contact_type) function new_asperities(a, surface_speed) result(contact)
      type(asperity_type), intent(in) :: a
      real(wp), intent(in) :: surface_speed
      if (a%model == 'none') then
         contact = no_asperities
      else
         contact = new_asperity_contact(a%roughness, a%elastic_modulus, a%factor, a%friction_coefficient, surface_speed)
      end if
   end function new_asperities

   !> The pads, for a shaft that turns in this sense, under gravity, m/s^2.
   pure function new_pads(b, sense, gravity) result(pads)
      type(bearing_type), intent(in) :: b
      real(wp), intent(in) :: sense, gravity
      type(tilting_pad_type) :: pads(b%pad_count())
      integer :: i
      pads%gap = new_gaps(b)
      do i = 1, size(pads)
         associate (p => b%pads, v => b%pivot, pad => pads(i), position => pads(i)%position)
            position%mirrored = sense < 0
            position%angle = merge(180 - p%pivot_angle_deg(i), p%pivot_angle_deg(i), position%mirrored)*degree
            position%sin_angle = sin(position%angle)
            position%cos_angle = cos(position%angle)
            position%pivot_radius = b%journal_radius + b%assembled_clearance(i) + p%pivot_distance(i)
            position%centre_distance = b%journal_radius + b%machined_clearance(i) + p%pivot_distance(i)
            pad%directions = pad%gap%directions()
            pad%largest_tilt = 0.5_wp*p%arc_deg(i)*degree
            pad%ball_radius = v%socket_radius(i) - v%radius_difference(i)
            if (.not. b%tilting()) cycle
            pad%mass = p%mass(i)
            pad%inertia = p%inertia(i)
            pad%weight = p%mass(i)*gravity
            pad%centre_tangential = p%centre_tangential(i)
            pad%centre_radial = p%centre_radial(i)
            pad%inertia_pitch = p%inertia_pitch(i)
            pad%inertia_yaw = p%inertia_yaw(i)
            pad%axial_offset = p%pivot_axial_offset(i)
            pad%rotational_stiffness = v%rotational_stiffness(i)
         end associate
      end do
   end function new_pads

   !> The contact of every pivot, which takes time to make: equal ones are made once; with a table where they move: a
   !> task without motion looks up too seldom.
   subroutine make_contacts(v, moves, pivots)
      type(pivot_type), intent(in) :: v
      logical, intent(in) :: moves
      type(pad_pivot), intent(inout) :: pivots(:)
      class(contact_law_type), allocatable :: law
      integer :: i, k
      do i = 1, size(pivots)
         do k = 1, i - 1
            if (v%is_like(i, v, k)) exit
         end do
         if (k < i) then
            pivots(i)%contact = pivots(k)%contact
            cycle
         end if
         call make_law(v, i, law)
         ! points and springs are looked up as quickly, and a table would round where cubics meet
         if (moves .and. .not. any(v%law == ['table ', 'linear'])) then
            pivots(i)%contact = new_contact_table(law)
         else
            pivots(i)%contact = new_untabulated_contact(law)
         end if
      end do
   end subroutine make_contacts
end module factories
