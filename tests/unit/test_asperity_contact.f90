!> Asperities in contact: pressure, forces and slopes; quadrature clipped where they touch.
program test_asperity_contact
   use kinds, only: wp, pi
   use text, only: to_text
   use clipped_quadrature, only: gregory_weights, clipped_weights
   use film_solver, only: film_motion
   use pad_gap, only: pad_gap_type, pad_directions
   use asperity_contact, only: asperity_contact_type, asperity_load, new_asperity_contact, no_asperities
   use paper_bearing, only: offset_pad, speed, clearance
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)
   real(wp), parameter :: roughness = 0.5e-6_wp, modulus = 5e10_wp, factor = 2e-3_wp, friction = 0.1_wp
   integer :: repeat

   if (runs('order')) call order()
   if (runs('gregory')) call gregory()
   if (runs('no_jumps')) call no_jumps()
   do repeat = 1, 3
      if (runs('loads_by_quadrature')) call loads_by_quadrature()
      if (runs('derivatives')) call derivatives()
   end do
   if (runs('nothing_above')) call nothing_above()
   if (runs('friction')) call friction_directions()
   if (runs('heat')) call heat_of_friction()
   if (runs('film_position')) call film_position()
   if (runs('wide_pad')) call wide_pad()
   call report()

contains

   !> The integral of max(f, 0) over nodes a step d apart.
   pure real(wp) function integral(f, d)
      real(wp), intent(in) :: f(:), d
      real(wp) :: weights(size(f))
      call clipped_weights(size(f) - 1, f, weights)
      integral = d*dot_product(weights, f)
   end function integral

   !> sin x - c over (0, pi), with x_c = asin c twice cos x_c - c (pi/2 - x_c). A cell integrates its cubic; the
   !> error of the formula is 11/720 d^5 of the fourth derivative, at most, in each.
   subroutine order()
      real(wp), parameter :: levels(3) = [0.1_wp, 0.45_wp, 0.83_wp]
      real(wp) :: exact, error
      integer :: k, i, n
      do k = 1, size(levels)
         associate (c => levels(k))
            exact = 2*(cos(asin(c)) - c*(pi/2 - asin(c)))
            n = 10
            do while (n <= 320)
               error = abs(integral([(sin(i*pi/n) - c, i=0, n)], pi/n) - exact)
               call expect(error < 11*pi/720*(pi/n)**4, 'error '//to_text(error)//' with '//to_text(n)//' cells')
               n = 2*n
            end do
         end associate
      end do
   end subroutine order

   !> Exact for powers up to the sixth, on lines as short as the formula.
   subroutine gregory()
      integer :: i, n, k
      do n = 6, 30, 4
         do k = 0, 6
            call expect_close(sum(gregory_weights(n)*[((real(i, wp)/n)**k, i=0, n)])/n, 1.0_wp/(k + 1), 1e-14_wp, &
               & 'power '//to_text(k)//' on '//to_text(n)//' cells')
         end do
      end do
   end subroutine gregory

   !> As the level moves through the nodes by 1e-4 the integral falls by at most 1e-4 times the length.
   subroutine no_jumps()
      integer, parameter :: n = 12, steps = 10000
      real(wp) :: now, before, largest, least
      integer :: i, k
      largest = 0
      least = 0
      before = integral([(sin(i*pi/n), i=0, n)], pi/n)
      do k = 1, steps
         now = integral([(sin(i*pi/n) - real(k, wp)/steps, i=0, n)], pi/n)
         largest = max(largest, before - now)
         least = min(least, before - now)
         before = now
      end do
      call expect(largest <= 1.001_wp*pi/steps, 'largest step '//to_text(largest))
      call expect(least >= -1e-2_wp*pi/steps, 'it rises nowhere by more than 1 % of that, by '//to_text(least))
      call expect_close(before, 0.0_wp, 1e-12_wp, 'nothing at the top')
   end subroutine no_jumps

   type(asperity_contact_type) function steel_on_metal(coefficient) result(contact)
      real(wp), intent(in) :: coefficient
      contact = new_asperity_contact(roughness, modulus, factor, coefficient, speed*49.9e-3_wp)
   end function steel_on_metal

   !> The load at a position, m.
   type(asperity_load) function load_at(contact, gap, position, shaft_speed) result(load)
      type(asperity_contact_type), intent(in) :: contact
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: position(2)
      real(wp), intent(in), optional :: shaft_speed
      real(wp) :: used
      used = speed
      if (present(shaft_speed)) used = shaft_speed
      call contact%evaluate(gap, gap%directions(), film_motion(position), used, load)
   end function load_at

   !> A position whose minimum film thickness is given, m: at an angle from the pivot inside the arc, or at an edge of
   !> it with a journal that lies beyond by some degrees.
   function thin_at(gap, phi, thickness) result(position)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: phi, thickness
      real(wp) :: position(2), beyond
      beyond = max(phi - gap%leading_angle, -gap%trailing_angle - phi, 0.0_wp)
      position = (gap%machined_clearance - thickness)/cos(beyond)*[sin(phi), cos(phi)]
   end function thin_at

   !> Normal force and force by the midpoint rule over the whole arc: intervals of 1e-6 rad err by their square over 24
   !> of the pressure's slope at an edge, 1e-7 of the force on a contact of 0.005 rad.
   pure subroutine plain_loads(gap, position, coefficient, normal, force)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: position(2), coefficient
      real(wp), intent(out) :: normal, force(2)
      integer, parameter :: n = 1000000
      real(wp) :: phi, h, p, step
      integer :: i
      normal = 0
      force = 0
      step = gap%arc()/n
      do i = 1, n
         phi = -gap%trailing_angle + (i - 0.5_wp)*step
         h = gap%machined_clearance - position(1)*sin(phi) - position(2)*cos(phi)
         if (h >= 4*roughness) cycle
         p = factor*modulus*4.4086e-5_wp*(4 - h/roughness)**6.804_wp*gap%pad_radius()*gap%axial_length*step
         normal = normal + p
         force = force + p*([-sin(phi), -cos(phi)] + coefficient*[cos(phi), -sin(phi)])
      end do
   end subroutine plain_loads

   !> In the middle of the arc, next to its edge, and at both edges.
   subroutine loads_by_quadrature()
      type(pad_gap_type) :: gap
      type(asperity_load) :: load
      real(wp) :: angles(5), position(2), normal, force(2)
      integer :: i
      gap = offset_pad()
      angles = [0.1_wp, gap%leading_angle - 0.05_wp, gap%leading_angle + 0.3_wp, -gap%trailing_angle - 0.6_wp, &
         & 0.02_wp - gap%trailing_angle]
      do i = 1, size(angles)
         position = thin_at(gap, angles(i), between(-2.0_wp, 3.0_wp)*roughness)
         load = load_at(steel_on_metal(friction), gap, position)
         call plain_loads(gap, position, friction, normal, force)
         call expect(load%touches .and. normal > 0, 'asperities touch at '//to_text(angles(i)))
         call expect_close(load%normal, normal, 1e-6_wp*normal, 'normal force at '//to_text(angles(i)))
         call expect_close(norm2(load%force - force), 0.0_wp, 1e-6_wp*normal, 'force at '//to_text(angles(i)))
         call expect_close(load%moment, friction*gap%pad_radius()*normal, 1e-6_wp*load%moment, 'moment of friction')
      end do
   end subroutine loads_by_quadrature

   !> Of force, moment and film position, by five-point differences of 0.02 sigma: error 1e-7 times the fifth
   !> derivative over (4 sigma)**5, some 1e4, over 30: 1e-6 of what 0.02 sigma changes; rounding of positions 1e-4 m
   !> against 1e-8 m: 1e-12.
   subroutine derivatives()
      real(wp), parameter :: h = 0.02_wp*roughness, offsets(4) = [-2*h, -h, h, 2*h]
      real(wp), parameter :: weights(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/(12*h)
      type(pad_gap_type) :: gap
      type(asperity_load) :: load, moved
      real(wp) :: angles(3), position(2), shifted(2), force(2, 2), moment(2), film(2, 2)
      integer :: i, k, column
      gap = offset_pad()
      angles = [0.1_wp, gap%leading_angle + 0.3_wp, -gap%trailing_angle - 0.6_wp]
      do i = 1, size(angles)
         position = thin_at(gap, angles(i), between(-2.0_wp, 1.8_wp)*roughness)
         load = load_at(steel_on_metal(friction), gap, position)
         force = 0
         moment = 0
         film = 0
         do column = 1, 2
            do k = 1, size(offsets)
               shifted = position
               shifted(column) = shifted(column) + offsets(k)
               moved = load_at(steel_on_metal(friction), gap, shifted)
               force(:, column) = force(:, column) + weights(k)*moved%force
               moment(column) = moment(column) + weights(k)*moved%moment
               film(:, column) = film(:, column) + weights(k)*moved%film_position
            end do
         end do
         call expect_close(norm2(load%force_slopes - force), 0.0_wp, 1e-5_wp*norm2(force), 'of the force')
         call expect_close(norm2(load%moment_slopes - moment), 0.0_wp, 1e-5_wp*norm2(moment), 'of the moment')
         call expect_close(norm2(load%film_slopes - film), 0.0_wp, 1e-5_wp*norm2(film), 'of the film''s position')
      end do
   end subroutine derivatives

   !> Not a newton from 4 sigma on, as little as possible below it, and never with the model 'none'.
   subroutine nothing_above()
      type(pad_gap_type) :: gap
      type(asperity_load) :: load
      real(wp), parameter :: thickness(3) = [4.0001_wp, 3.9_wp, 3.8_wp]*roughness
      real(wp) :: thick
      integer :: i
      gap = offset_pad()
      do i = 1, 3
         thick = thickness(i)
         load = load_at(steel_on_metal(friction), gap, thin_at(gap, 0.1_wp, thick))
         call expect_close(load%thickness, thick, 1e-18_wp, 'minimum film thickness')
         call expect((i == 1) .neqv. load%touches, 'touches below 4 sigma alone: '//to_text(thick))
         if (i == 1) call expect_close(load%carried(), 0.0_wp, 0.0_wp, 'and carries nothing above')
      end do
      ! the pressure is 0.05**6.804 = 1e-9 of that at 3 sigma where 4 - h/sigma is 0.05
      call expect_close(carried_at(3.95_wp)/carried_at(3.0_wp), 1.4e-9_wp*sqrt(0.05_wp), 0.2e-9_wp, 'rises gently')
      call expect(carried_at(-3.9_wp) > 50*carried_at(0.0_wp), 'goes on below 0')
      call expect_close(carried_at(-4.1_wp), 0.0_wp, 0.0_wp, 'until a film is no film')
      load = load_at(no_asperities, gap, thin_at(gap, 0.1_wp, 0.5_wp*roughness))
      call expect(.not. load%touches .and. .not. load%carried() > 0, 'there may be no asperities')
      load = load_at(no_asperities, gap, thin_at(gap, 0.1_wp, -0.5_wp*roughness))
      call expect(.not. load%touches, 'nor in a closed film')
   end subroutine nothing_above

   !> Normal force with a film of this many sigma inside the arc, N.
   real(wp) function carried_at(sigmas)
      real(wp), intent(in) :: sigmas
      type(asperity_load) :: load
      load = load_at(steel_on_metal(friction), offset_pad(), thin_at(offset_pad(), 0.1_wp, sigmas*roughness))
      carried_at = load%carried()
   end function carried_at

   !> Friction drags the pad with the journal's surface, which moves towards -phi, and holds the journal; it is the
   !> coefficient times the normal force, and none at rest. It works against the sliding: the power on journal and pad
   !> of a turning journal is negative, with the pad's force at its surface.
   subroutine friction_directions()
      type(pad_gap_type) :: gap
      type(asperity_load) :: with, without
      gap = offset_pad()
      with = load_at(steel_on_metal(friction), gap, thin_at(gap, 0.0_wp, roughness))
      without = load_at(steel_on_metal(0.0_wp), gap, thin_at(gap, 0.0_wp, roughness))
      call expect_close(without%moment, 0.0_wp, 0.0_wp, 'no moment without friction')
      call expect_close(without%force(1), 0.0_wp, 1e-9_wp*without%normal, 'nor a tangential force')
      call expect(without%force(2) < 0, 'the journal is pushed inward')
      call expect_close(with%force(1)/with%normal, friction, 1e-3_wp*friction, 'the journal is held')
      call expect(with%moment > 0, 'the pad is turned with the journal')
      with = load_at(steel_on_metal(friction), gap, thin_at(gap, 0.0_wp, roughness), 0.0_wp)
      call expect_close(norm2(with%force - without%force) + abs(with%moment), 0.0_wp, 0.0_wp, 'no friction at rest')
   end subroutine friction_directions

   !> Parts of the arc have the heat that the moment of friction makes, where the surfaces touch.
   subroutine heat_of_friction()
      type(pad_gap_type) :: gap
      type(asperity_load) :: load
      type(asperity_contact_type) :: contact
      real(wp) :: position(2), heat(40), power, places(3)
      integer :: i
      gap = offset_pad()
      contact = steel_on_metal(friction)
      places = [0.1_wp, gap%leading_angle + 0.01_wp, -gap%trailing_angle - 0.01_wp]
      do i = 1, 3
         position = thin_at(gap, places(i), roughness)
         load = load_at(contact, gap, position)
         power = load%moment/gap%pad_radius()*speed*gap%journal_radius
         heat = contact%heat(gap, position, speed*gap%journal_radius, size(heat))
         call expect(power > 0 .and. all(heat >= 0), 'heat')
         call expect_close(sum(heat), power, 1e-6_wp*power, 'all of it at '//to_text(places(i)))
         call expect_close(real(maxloc(heat, 1), wp), min(40.0_wp, max(1.0_wp, ceiling((gap%leading_angle - places(i)) &
            & /gap%arc()*size(heat))*1.0_wp)), 1.0_wp, 'where the film is thinnest')
      end do
   end subroutine heat_of_friction

   !> The film is taken where the journal is 2 sigma away, and less close below, by the mean gap; never at 0.
   subroutine film_position()
      type(pad_gap_type) :: gap
      type(pad_directions) :: directions
      type(asperity_load) :: load
      real(wp) :: angles(3), position(2), seen, last, sigmas
      integer :: i, k
      gap = offset_pad()
      directions = gap%directions()
      angles = [0.1_wp, gap%leading_angle + 0.3_wp, -gap%trailing_angle - 0.3_wp]
      do k = 1, 3
         last = 0
         do i = -39, 39
            sigmas = 0.1_wp*i
            position = thin_at(gap, angles(k), sigmas*roughness)
            load = load_at(steel_on_metal(friction), gap, position)
            seen = gap%min_film_thickness(film_motion(load%film_position), directions)/roughness
            call expect(seen > last .and. seen > 0, 'the film''s thickness grows with the distance')
            last = seen
            if (i > 20) call expect_close(norm2(load%film_position - position), 0.0_wp, 0.0_wp, 'the true film')
            ! 2/(1 + u + u**2 + u**3) with u = 1/2
            if (i == 10) call expect_close(seen, 2/1.875_wp, 1e-9_wp, 'mean gap at 1 sigma')
            if (i == 0) call expect_close(seen, 0.5_wp, 1e-9_wp, 'mean gap at 0')
         end do
      end do
   end subroutine film_position

   !> A pad of 300 degrees touches at both ends where the journal lies opposite its middle, and all over where the
   !> clearance is small.
   subroutine wide_pad()
      type(pad_gap_type) :: gap
      type(asperity_load) :: load
      real(wp) :: normal, force(2), position(2)
      integer :: i
      gap = offset_pad()
      gap%leading_angle = 150*pi/180
      gap%trailing_angle = 150*pi/180
      do i = 1, 2
         if (i == 1) position = [0.0_wp, -(clearance - roughness)/cos(gap%leading_angle - pi)]
         if (i == 2) gap%machined_clearance = 2*roughness
         if (i == 2) position = [0.5_wp, 0.7_wp]*roughness
         load = load_at(steel_on_metal(friction), gap, position)
         call plain_loads(gap, position, friction, normal, force)
         ! twelve points over 300 degrees
         call expect_close(load%normal, normal, 1e-5_wp*normal, 'normal force of a wide pad')
         call expect_close(norm2(load%force - force), 0.0_wp, 1e-5_wp*normal, 'force of a wide pad')
      end do
   end subroutine wide_pad
end program test_asperity_contact
