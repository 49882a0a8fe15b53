!> What eddies make of the profiles of a film whose temperature changes along the arc and across it
!> (docs/theory/heat.md, *Turbulent films*): velocities, heat and conduction have the shapes of a viscosity
!> mu + mu_h w eps across the film; heat and flows as a whole are those of the film's law.
module film_eddies
   use kinds, only: wp
   use case_groups, only: oil_type
   use turbulence_closure, only: closure_type, closure_factors, wall_law_type, new_wall_law, along, shear
   use film_law, only: film_law_type
   use turbulent_film, only: turbulent_film_type
   use film_streams, only: film_stream
   use film_energy, only: film_profile, new_profile, film_heat_type, pad_heat, solve_energy
   implicit none (type, external)
   private
   public :: solve_film, with_eddies

   !> Gauss's two points in each half of a layer, over its thickness.
   integer, parameter :: points = 4
   real(wp), parameter :: place(points) = 0.25_wp*[1 - 1/sqrt(3.0_wp), 1 + 1/sqrt(3.0_wp), 3 - 1/sqrt(3.0_wp), &
      & 3 + 1/sqrt(3.0_wp)]

contains

   !> The energy equation of a film of this law with this stream, an oil and the profiles of the stations without
   !> eddies, at a speed of the journal's surface, m/s.
   subroutine solve_film(heat, stream, law, oil, profiles, surface_speed, found)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(in) :: stream
      class(film_law_type), intent(in) :: law
      type(oil_type), intent(in) :: oil
      type(film_profile), intent(in) :: profiles(:)
      real(wp), intent(in) :: surface_speed
      type(pad_heat), intent(out) :: found
      select type (law)
      type is (turbulent_film_type)
         call solve_energy(heat, stream, with_eddies(law%closure, oil, heat%zeta, stream%h, surface_speed, profiles), &
            & surface_speed, found)
      class default
         call solve_energy(heat, stream, profiles, surface_speed, found)
      end select
   end subroutine solve_film

   !> The profiles of stations of these film thicknesses, m, at a speed of the journal's surface, m/s, of an oil between
   !> these faces of the layers; those that are given have no eddies.
   function with_eddies(closure, oil, zeta, h, surface_speed, laminar) result(profiles)
      type(closure_type), intent(in) :: closure
      type(oil_type), intent(in) :: oil
      real(wp), intent(in) :: zeta(:), h(:), surface_speed
      type(film_profile), intent(in) :: laminar(:)
      type(film_profile) :: profiles(size(laminar))
      type(wall_law_type) :: wall
      type(closure_factors) :: of
      real(wp), dimension(points, size(zeta) - 1) :: places, eddies
      real(wp) :: reynolds, share
      integer :: i, j
      wall = new_wall_law()
      do j = 1, size(places, 2)
         places(:, j) = zeta(j) + (zeta(j + 1) - zeta(j))*place
      end do
      do i = 1, size(profiles)
         reynolds = oil%density*abs(surface_speed)*h(i)/laminar(i)%f0
         share = closure%turbulent_share(reynolds)
         if (.not. share > 0) then
            profiles(i) = laminar(i)
            cycle
         end if
         of = closure%at(log(reynolds))
         eddies = share*laminar(i)%f0*reshape(wall%eddies_at(reynolds, [places]), shape(places))
         profiles(i) = thickened(laminar(i), zeta, eddies, exp(of%value(0, shear)), exp(of%value(0, along)))
         profiles(i)%conduction = conduction(zeta, oil%conductivity + oil%specific_heat*eddies/oil%turbulent_prandtl)
      end do
   end function with_eddies

   !> A profile with the viscosity of eddies, Pa s, (point, layer), whose shear and mobility along the film grow by
   !> these factors.
   pure type(film_profile) function thickened(laminar, zeta, eddies, shear_factor, mobility_factor) result(profile)
      type(film_profile), intent(in) :: laminar
      real(wp), intent(in) :: zeta(:), eddies(:, :), shear_factor, mobility_factor
      real(wp) :: fluidity(size(eddies, 2))
      integer :: j
      do j = 1, size(fluidity)
         associate (viscosity => (zeta(j + 1) - zeta(j))*laminar%f0**2/laminar%shear(j))
            fluidity(j) = sum(1/(viscosity + eddies(:, j)))/points
         end associate
      end do
      profile = new_profile(zeta, fluidity)
      profile%shear = profile%shear*(shear_factor*laminar%f0/profile%f0)
      associate (factor => mobility_factor*laminar%f2/profile%f2)
         profile%driven = factor*profile%driven
         profile%pressure = factor*profile%pressure
      end associate
      profile%f0 = shear_factor*laminar%f0
      profile%f1 = laminar%f1
      profile%f2 = mobility_factor*laminar%f2
   end function thickened

   !> How well heat crosses from the pad to the middle of the first layer, between the middles of layers and on to the
   !> journal, over a unit of zeta, W/(m K), with these conductivities, W/(m K), (point, layer).
   pure function conduction(zeta, conductivity)
      real(wp), intent(in) :: zeta(:), conductivity(:, :)
      real(wp) :: conduction(size(zeta)), resistance(size(zeta))
      resistance = 0
      associate (n => size(zeta) - 1, each => (zeta(2:) - zeta(:size(zeta) - 1))/points)
         resistance(:n) = each*sum(1/conductivity(:2, :), dim=1)
         resistance(2:) = resistance(2:) + each*sum(1/conductivity(3:, :), dim=1)
      end associate
      conduction = 1/resistance
   end function conduction
end module film_eddies
