!> Builds the film solver, contact law, friction law and pads of a scene: the only module that turns names of the
!> input into types.
module components
   use kinds, only: wp, degree
   use scene, only: scene_type
   use pad_gap, only: pad_gap_type
   use film_solver, only: film_solver_type
   use modal_film, only: new_modal_film
   use film_resolution, only: enough_cells, enough_modes, usual_error
   use direct_film, only: direct_film_type, new_direct_film
   use table_film, only: new_table_film, has_tables
   use film_losses, only: film_losses_type, new_film_losses
   use sor_film, only: new_sor_film, sor_options, cavitation_none, cavitation_gumbel, cavitation_reynolds
   use contact_law, only: contact_law_type, make_contact_law
   use contact_table, only: contact_table_type, new_contact_table, new_untabulated_contact
   use friction, only: friction_law, no_friction, bengisu_akay_friction, lugre_friction, &
      & default_bristle_damping
   use asperity_contact, only: asperity_contact_type, new_asperity_contact, no_asperities
   use tilting_pad, only: tilting_pad_type
   implicit none (type, external)
   private
   public :: make_film, new_losses, make_law, make_contact, make_friction, new_asperities, new_pads

   !> Finite volumes along the arc and along half the width where the input leaves them to the solver, by the
   !> errors in docs/benchmarks.md.
   integer, parameter :: sor_volumes(2) = [60, 15], rupture_volumes(2) = [80, 8]
   !> The films of 'fine', which is no word of the input: for what is linearised at a single state. Errors of whole
   !> films, of clipped ones and of ruptured ones; volumes where no table knows the film.
   real(wp), parameter :: fine_whole_error = 4e-7_wp, fine_error = 1e-6_wp, fine_ruptured_error = 1.3e-5_wp
   integer, parameter :: fine_volumes(2) = [160, 16]
   !> Error of those of 'loose', which is no word of the input either: for ways that are long and of which only the end
   !> counts.
   real(wp), parameter :: loose_error = 1e-2_wp
   !> So many volumes serve an arc of this length, rad, and shorter ones.
   real(wp), parameter :: usual_arc = 120*degree
   !> Residual of over-relaxation over the relative tolerance of the march, at most, and what rounding leaves: films
   !> solved less well shake stiff pivots, and the steps become short.
   real(wp), parameter :: sor_tolerance = 1e-3_wp, least_residual = 1e-13_wp

contains

   !> The film solver of all pads. No function: gfortran never frees the result of one whose type is chosen within,
   !> and Python makes a solver for every instant.
   subroutine make_film(scene, film)
      type(scene_type), intent(in) :: scene
      class(film_solver_type), allocatable, intent(out) :: film
      type(pad_gap_type) :: gaps(scene%pad_count())
      type(direct_film_type), allocatable :: single(:)
      type(sor_options) :: options
      integer :: cavitation, cells, modes, volumes(2), i
      real(wp), allocatable :: error, whole_error
      real(wp) :: tolerance
      gaps = new_gaps(scene)
      associate (f => scene%film)
         cavitation = cavitation_of(f%cavitation)
         cells = merge(f%circumferential_cells, enough_cells(gaps), f%circumferential_cells > 0)
         modes = merge(f%axial_modes, enough_modes(gaps), f%axial_modes > 0)
         ! what the input sets stays the same for every film
         if (f%circumferential_cells + f%axial_modes == 0) error = merge(loose_error, usual_error, f%solver == 'loose')
         if (f%solver == 'fine') error = fine_error
         volumes = merge(sor_volumes, rupture_volumes, f%solver == 'sor')
         if (f%solver == 'fine' .and. .not. all(has_tables(gaps))) volumes = fine_volumes
         volumes(1) = volumes(1)*max(1, nint(maxval(gaps%arc())/usual_arc))
         associate (given => [f%circumferential_cells, f%axial_cells])
            volumes = merge(given, volumes, given > 0)
         end associate
         options = sor_options(volumes(1), volumes(2), f%relaxation, &
            & min(f%tolerance, max(least_residual, sor_tolerance*scene%integration%relative_tolerance)), &
            & f%max_sweeps, cavitation)
         if (f%solver == 'sor') then
            film = new_sor_film(gaps, options)
         else if (f%solver == 'modal') then
            film = new_modal_film(gaps, cells, modes, cavitation == cavitation_gumbel, error)
         else
            associate (reynolds => cavitation == cavitation_reynolds, gumbel => cavitation == cavitation_gumbel)
               if (f%solver == 'direct' .or. f%solver == 'loose') then
                  film = new_direct_film(gaps, cells, modes, volumes(1), volumes(2), reynolds, gumbel, error)
               else
                  ! one by one: gfortran never frees the elements of a list of them
                  allocate (single(size(gaps)))
                  do i = 1, size(gaps)
                     single(i) = &
                        & new_direct_film(gaps(i:i), cells, modes, volumes(1), volumes(2), reynolds, gumbel, error)
                  end do
                  ! ruptured films by volumes are dear, by modes they are cheap
                  tolerance = merge(1, 4, gumbel)*scene%integration%relative_tolerance
                  if (f%solver == 'fine') tolerance = merge(fine_error, fine_ruptured_error, gumbel)
                  if (f%table_tolerance > 0) then
                     tolerance = f%table_tolerance
                  else if (f%solver == 'fine') then
                     whole_error = fine_whole_error
                  end if
                  film = new_table_film(gaps, single, reynolds .or. gumbel, gumbel, tolerance, f%solver == 'fine', &
                     & whole_error)
               end if
            end associate
         end if
         film%tolerance = options%tolerance
         film%max_sweeps = options%max_sweeps
      end associate
   end subroutine make_film

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
   pure function new_losses(scene) result(losses)
      type(scene_type), intent(in) :: scene
      type(film_losses_type) :: losses(scene%pad_count())
      type(pad_gap_type) :: gaps(scene%pad_count())
      integer :: i
      gaps = new_gaps(scene)
      do i = 1, size(gaps)
         losses(i) = new_film_losses(gaps(i), scene%film%cavitation == 'reynolds', scene%film%cavitation == 'gumbel')
      end do
   end function new_losses

   !> The gaps between pads and journal.
   pure function new_gaps(scene) result(gaps)
      type(scene_type), intent(in) :: scene
      type(pad_gap_type) :: gaps(scene%pad_count())
      integer :: i
      associate (b => scene%bearing, p => scene%pads)
         do i = 1, size(gaps)
            gaps(i) = pad_gap_type(b%journal_radius, b%machined_clearance, b%axial_length, &
               & p%pivot_ratio(i)*p%arc_deg(i)*degree, (1 - p%pivot_ratio(i))*p%arc_deg(i)*degree, &
               & b%supply_pressure, b%ambient_pressure, b%cavitation_pressure)
         end do
      end associate
   end function new_gaps

   !> The contact law of the pivots.
   subroutine make_law(scene, law)
      type(scene_type), intent(in) :: scene
      class(contact_law_type), allocatable, intent(out) :: law
      associate (v => scene%pivot)
         call make_contact_law(v%law, v%socket_radius, v%radius_difference, v%young_modulus, &
            & v%poisson_ratio, v%penetration_factor, law)
      end associate
   end subroutine make_law

   !> The contact of the pivots, with a table for a motion: a task without one looks up too seldom.
   subroutine make_contact(scene, contact)
      type(scene_type), intent(in) :: scene
      type(contact_table_type), intent(out) :: contact
      class(contact_law_type), allocatable :: law
      call make_law(scene, law)
      if (scene%moves()) then
         contact = new_contact_table(law)
      else
         contact = new_untabulated_contact(law)
      end if
   end subroutine make_contact

   !> The friction law of the pivots.
   subroutine make_friction(scene, law)
      type(scene_type), intent(in) :: scene
      class(friction_law), allocatable, intent(out) :: law
      real(wp) :: damping
      associate (f => scene%friction)
         select case (f%model)
         case ('bengisu_akay')
            law = bengisu_akay_friction(.false., f%static_coefficient, f%dynamic_coefficient, &
               & f%critical_velocity, f%decay)
         case ('lugre')
            damping = f%bristle_damping
            if (damping < 0) damping = default_bristle_damping(f%bristle_stiffness, f%characteristic_load)
            law = lugre_friction(.true., f%static_coefficient, f%dynamic_coefficient, &
               & f%stribeck_velocity, f%stribeck_exponent, f%bristle_stiffness, damping, f%viscous_coefficient)
         case default
            law = no_friction()
         end select
      end associate
   end subroutine make_friction

   !> The contact of pads and journal.
   pure type(asperity_contact_type) function new_asperities(scene) result(contact)
      type(scene_type), intent(in) :: scene
      associate (a => scene%asperity)
         if (a%model == 'none') then
            contact = no_asperities
         else
            contact = new_asperity_contact(a%roughness, a%elastic_modulus, a%factor, a%friction_coefficient, &
               & scene%highest_speed()*scene%bearing%journal_radius)
         end if
      end associate
   end function new_asperities

   !> The pads.
   pure function new_pads(scene) result(pads)
      type(scene_type), intent(in) :: scene
      type(tilting_pad_type) :: pads(scene%pad_count())
      integer :: i
      pads%gap = new_gaps(scene)
      do i = 1, size(pads)
         associate (b => scene%bearing, p => scene%pads, v => scene%pivot, pad => pads(i), position => pads(i)%position)
            position%angle = p%pivot_angle_deg(i)*degree
            position%sin_angle = sin(position%angle)
            position%cos_angle = cos(position%angle)
            position%pivot_radius = b%journal_radius + b%assembled_clearance + p%pivot_distance(i)
            position%centre_distance = b%journal_radius + b%machined_clearance + p%pivot_distance(i)
            pad%directions = pad%gap%directions()
            pad%largest_tilt = 0.5_wp*p%arc_deg(i)*degree
            pad%ball_radius = v%socket_radius - v%radius_difference
            pad%tilts = scene%tilting()
            pad%radial = scene%tilting_radial()
            if (.not. pad%tilts) cycle
            pad%mass = p%mass(i)
            pad%inertia = p%inertia(i)
            pad%weight = p%mass(i)*scene%rotor%gravity
            pad%centre_tangential = p%centre_tangential(i)
            pad%centre_radial = p%centre_radial(i)
         end associate
      end do
   end function new_pads
end module components
