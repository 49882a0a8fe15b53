!> Films of pads with small slopes, for a march: those without slopes and what slopes change in them, by tables
!> (docs/theory/pitch_and_yaw.md, *Tables of small slopes*): moments, and changes of force and highest pressure, which
!> are cubics of s = (gamma, v). Where slopes are not small films are solved.
module small_slopes
   use kinds, only: wp, pi
   use film_solver, only: film_solver_type, film_law_type, film_ok, cavitation_none, cavitation_reynolds
   use pad_gap, only: pad_gap_type, first_like
   use sloped_gap, only: sloped_motion, sloped_response, edge_films, driving_velocity, add_rotation
   use sloped_film, only: sloped_film_type
   use table_film, only: has_tables
   use slope_expansion, only: of_force, of_moment, coefficients
   use slope_table, only: slope_table_type, new_slope_table, diverging_part
   implicit none (type, external)
   private
   public :: small_slopes_type, new_small_slopes

   !> By which part slopes change the least thickness at most; v half the width, over w; with the condition of Reynolds
   !> by which part they change what is left of the film, 1 - T, for T up to the first of these, and from the second
   !> on: beyond, films err by more than 1e-3 (test_small_slopes).
   real(wp), parameter :: largest_slope = 0.25_wp, largest_drive = 1.0_wp, largest_change(2) = [0.3_wp, 0.05_wp], &
      & slight(2) = [0.1_wp, 0.25_wp]
   !> Share of these from which on more and more of the film is solved, so that the force does not leap.
   real(wp), parameter :: begin = 0.8_wp
   !> Of all shapes: 60 MB.
   integer, parameter :: most_cells = 2000

   !> A motion as the tables have it.
   type :: small_motion
      !> Film thicknesses at both edges over the clearance, and direction of w, rad (slope_table).
      real(wp) :: place(3)
      !> w, m/s, and its amount.
      real(wp) :: w(2), amount
      !> T: 0 where the film does not cavitate, 1 and more where nothing of it is left.
      real(wp) :: part
      !> Slope times half the width over the mean thickness, and v times half the width over w, both over 1 - T.
      real(wp) :: s(4)
      !> What forces are over, which falls with the power 4 of 1 - T.
      real(wp) :: force_scale
      !> How much of the film the tables have; whether its pressure has one hill.
      real(wp) :: share = 0
      logical :: one_hill = .true.
      !> The cell it is in; 0: none.
      integer :: cell = 0
   end type small_motion

   type :: small_slopes_type
      private
      !> Those of equal pads are those of the first of them; which ones a pad has, 0: none; where it was seen last.
      type(slope_table_type), allocatable :: tables(:)
      integer, allocatable :: table(:)
      type(small_motion), allocatable :: seen(:)
   contains
      procedure :: evaluate_pad
      procedure :: take_pressures
   end type small_slopes_type

contains

   !> Empty tables of pads, with a condition of cavitation.
   type(small_slopes_type) function new_small_slopes(gaps, condition) result(self)
      type(pad_gap_type), intent(in) :: gaps(:)
      integer, intent(in) :: condition
      integer :: i, k
      allocate (self%tables(size(gaps)), self%seen(size(gaps)))
      self%table = [(merge(first_like(gaps, i), 0, has_table(gaps(i), condition)), i=1, size(gaps))]
      do i = 1, size(gaps)
         if (self%table(i) == i) self%tables(i) = new_slope_table(gaps(i), condition, most_cells &
            & /count(self%table == [(k, k=1, size(gaps))]))
      end do
   end function new_small_slopes

   !> Whether the film of a pad depends on motion and viscosity alone, and changes smoothly where it begins to cavitate.
   pure logical function has_table(gap, condition)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: condition
      has_table = has_tables(gap) .and. .not. abs(gap%supply_pressure - gap%ambient_pressure) > 0
      if (has_table .and. condition /= cavitation_none) has_table = condition == cavitation_reynolds &
         & .and. .not. abs(gap%ambient_pressure - gap%cavitation_pressure) > 0
   end function has_table

   !> The film of pad i: from that of the same pad without slopes, `aligned`, where the tables know what slopes add; its
   !> pressures are left to `take_pressures` then. Else `films` solve it, which solve nodes, too.
   subroutine evaluate_pad(self, i, motion, oil, speed, want_derivatives, films, aligned, response)
      class(small_slopes_type), intent(inout) :: self
      integer, intent(in) :: i
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      class(sloped_film_type), intent(inout) :: films
      class(film_solver_type), intent(inout) :: aligned
      type(sloped_response), intent(inout) :: response
      type(sloped_response) :: solved
      associate (seen => self%seen(i))
         seen%share = 0
         if (self%table(i) > 0 .and. films%condition == films%own_condition .and. .not. oil%varies) then
            associate (table => self%tables(self%table(i)))
               response%edge_films = edge_films(table%gap, table%directions, motion)
               call see(table, motion, minval(response%edge_films), oil, speed, seen)
               if (seen%share > 0 .and. seen%part < 1) then
                  call table%find_cell(i, seen%place, films, seen%cell)
                  if (seen%cell == 0) seen%share = 0
               end if
            end associate
         end if
         if (seen%share < 1) call films%evaluate_pad(i, motion, oil, speed, want_derivatives, solved)
         if (.not. seen%share > 0) then
            response = solved
            return
         end if
         call aligned%evaluate_pad(i, motion%middle, oil, speed, want_derivatives, response%film)
         response%lacks_pressures = response%film%status == film_ok
         if (.not. response%lacks_pressures) return
         call add(self%tables(self%table(i)), seen, speed, want_derivatives, response)
         response%film%min_film_thickness = minval(response%edge_films)
         if (.not. seen%share < 1) return
         associate (share => seen%share)
            solved%film%force = share*response%film%force + (1 - share)*solved%film%force
            solved%moment = share*response%moment + (1 - share)*solved%moment
            solved%derivatives = share*response%derivatives + (1 - share)*solved%derivatives
         end associate
         response = solved
      end associate
   end subroutine evaluate_pad

   !> Takes the highest pressures, and their places, of films from tables that were evaluated last.
   subroutine take_pressures(self, motion, oil, speed, films, aligned, response)
      class(small_slopes_type), intent(inout) :: self
      type(sloped_motion), intent(in) :: motion(:)
      class(film_law_type), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      class(sloped_film_type), intent(inout) :: films
      class(film_solver_type), intent(inout) :: aligned
      type(sloped_response), intent(inout) :: response(:)
      type(sloped_response) :: solved
      integer :: i
      if (.not. any(response%lacks_pressures)) return
      call aligned%take_pressures(motion%middle, oil, speed, response%film)
      do i = 1, size(response)
         if (.not. response(i)%lacks_pressures) cycle
         associate (film => response(i)%film)
            if (self%seen(i)%part >= 1) then
               response(i)%place = 0
            else if (self%seen(i)%one_hill) then
               ! the cell may have been forgotten
               call self%tables(self%table(i))%find_cell(i, self%seen(i)%place, films, self%seen(i)%cell)
               if (self%seen(i)%cell > 0) call raise(self%tables(self%table(i)), self%seen(i), response(i))
            else
               call films%evaluate_pad(i, motion(i), oil(i), speed, .false., solved)
               film%max_pressure = solved%film%max_pressure
               response(i)%place = solved%place
            end if
         end associate
         response(i)%lacks_pressures = .false.
      end do
   end subroutine take_pressures

   !> A motion as the tables have it, and how much of its film that is.
   subroutine see(self, motion, least, oil, speed, seen)
      type(slope_table_type), intent(in) :: self
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      !> Least film thickness, m.
      real(wp), intent(in) :: least, speed
      !> That of the pad before, whose cell it may be in; its share is 0.
      type(small_motion), intent(inout) :: seen
      real(wp) :: u(4), without, part(-1:1), amount, angle
      associate (c => self%gap%machined_clearance, half => 0.5_wp*self%gap%axial_length, d => self%directions, &
         & e => motion%middle%position)
         without = self%gap%min_film_thickness(motion%middle, d)
         u = driving_velocity(self%gap, motion, speed)
         seen%w = u(:2)
         seen%amount = norm2(seen%w)
         if (.not. (least > 0 .and. seen%amount > 0)) return
         amount = max((1 - least/without)/largest_slope, norm2(u(3:))*half/(largest_drive*seen%amount))
         if (.not. amount < 1) return
         part = [diverging_part(d, u(:2) - half*u(3:)), diverging_part(d, u(:2)), diverging_part(d, u(:2) + half*u(3:))]
         seen%one_hill = self%condition /= cavitation_none .or. maxval(part) < 0.5_wp
         seen%part = merge(max(part(0), 0.0_wp), 0.0_wp, self%condition /= cavitation_none)
         if (self%condition /= cavitation_none .and. minval(part) >= 1) then
            seen%share = 1
            return
         end if
         if (self%condition /= cavitation_none .and. maxval(part) > 0) then
            if (part(0) >= 1) return
            associate (change => 0.5_wp*(maxval(part) - minval(part))/(1 - part(0)), &
               & more => min(1.0_wp, max(0.0_wp, (part(0) - slight(1))/(slight(2) - slight(1)))))
               amount = max(amount, change/((1 - more)*largest_change(1) + more*largest_change(2)))
            end associate
            if (amount >= 1) return
         end if
         angle = atan2(dot_product(seen%w, d%middle), seen%w(1)*d%middle(2) - seen%w(2)*d%middle(1))
         if (angle < -0.5_wp*self%gap%arc()) angle = angle + 2*pi
         seen%place = [1 - dot_product(e, d%leading)/c, 1 - dot_product(e, d%trailing)/c, angle]
         associate (mean => sqrt(product(seen%place(:2))), room => 1 - seen%part)
            seen%s = half/room*[motion%slope/(c*mean), u(3:)/seen%amount]
            seen%force_scale = oil%viscosity*seen%amount*room**4/mean**3
         end associate
         seen%share = 1
         if (amount > begin) then
            associate (x => (1 - amount)/(1 - begin))
               seen%share = x**2*(3 - 2*x)
            end associate
         end if
      end associate
   end subroutine see

   !> Adds what slopes change in the film without them, to which `see` found the cell.
   pure subroutine add(self, seen, speed, want_derivatives, response)
      type(slope_table_type), intent(in) :: self
      type(small_motion), intent(in) :: seen
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(sloped_response), intent(inout) :: response
      !> Coefficients, and their derivatives over the axes; force and moment, and derivatives over s.
      real(wp) :: c(coefficients, 0:3), f(4), over_s(4, 4), of_place(4, 3), d(4, 8), unused(4, 4)
      integer :: k
      response%moment = 0
      response%derivatives = 0
      response%derivatives(:2, [1, 2, 5, 6]) = response%film%derivatives
      if (seen%part >= 1) return
      call self%loads_at(seen%cell, seen%place, want_derivatives, c)
      call apply_cubic(c(:, 0), seen%s, want_derivatives, f, over_s)
      associate (half => 0.5_wp*self%gap%axial_length)
         f(3:) = half*f(3:)
         response%film%force = response%film%force + seen%force_scale*f(:2)
         response%moment = seen%force_scale*f(3:)
         if (.not. want_derivatives) return
         do k = 1, 3
            call apply_cubic(c(:, k), seen%s, .false., of_place(:, k), unused)
         end do
         of_place(3:, :) = half*of_place(3:, :)
         over_s(3:, :) = half*over_s(3:, :)
         if (seen%part > 0) of_place(:, 3) = of_place(:, 3) - (4*f - matmul(over_s, seen%s))*turning(self, seen) &
            & /(1 - seen%part)
         associate (w => seen%w/seen%amount, s => seen%s, arm => half/(1 - seen%part))
            do k = 1, 2
               ! the mean thickness falls with both
               of_place(:, k) = of_place(:, k) - (1.5_wp*f + 0.5_wp*matmul(over_s(:, :2), s(:2)))/seen%place(k)
            end do
            associate (c_m => self%gap%machined_clearance, edges => self%directions, along => [-w(2), w(1)], &
               & of_amount => f - matmul(over_s(:, 3:), s(3:)))
               do k = 1, 2
                  d(:, k) = -(of_place(:, 1)*edges%leading(k) + of_place(:, 2)*edges%trailing(k))/c_m
                  d(:, 2 + k) = over_s(:, k)*arm/(c_m*sqrt(product(seen%place(:2))))
                  d(:, 4 + k) = (of_amount*w(k) + of_place(:, 3)*along(k))/seen%amount
                  d(:, 6 + k) = over_s(:, 2 + k)*arm/seen%amount
               end do
            end associate
         end associate
      end associate
      d = seen%force_scale*d
      call add_rotation(self%gap, speed, d)
      response%derivatives = response%derivatives + d
   end subroutine add

   !> Derivative of T, 0 < T < 1, over the direction of w, 1/rad.
   pure real(wp) function turning(self, seen)
      type(slope_table_type), intent(in) :: self
      type(small_motion), intent(in) :: seen
      associate (h => self%directions%half)
         turning = -0.5_wp*sign(1.0_wp, cos(seen%place(3)))*h(2)/(h(1)*cos(seen%place(3))**2)
      end associate
   end function turning

   !> Makes the highest pressure of the film without slopes that with them, and tells where it is.
   pure subroutine raise(self, seen, response)
      type(slope_table_type), intent(in) :: self
      type(small_motion), intent(in) :: seen
      type(sloped_response), intent(inout) :: response
      real(wp) :: z
      associate (c => self%pressures_at(seen%cell, seen%place))
         associate (slope => dot_product(c(3:6), seen%s), bend => c(2), &
            & middle => dot_product(seen%s(1)*c(7:10) + seen%s(2)*c(11:14), seen%s))
            z = slope/max(bend, abs(slope), tiny(slope))
            response%place = [c(1), 0.5_wp*self%gap%axial_length*z]
            response%film%max_pressure = response%film%max_pressure + seen%force_scale*(middle + z*(slope &
               & - 0.5_wp*bend*z))
         end associate
      end associate
   end subroutine raise

   !> Force and moment from coefficients and s, and their derivatives over s.
   pure subroutine apply_cubic(c, s, want_slopes, f, over_s)
      real(wp), intent(in) :: c(coefficients), s(4)
      logical, intent(in) :: want_slopes
      real(wp), intent(out) :: f(4), over_s(4, 4)
      real(wp) :: square(0:3), of_square(0:3, 2)
      integer :: a, k
      square = [1.0_wp, s(1)**2, s(1)*s(2), s(2)**2]
      over_s = 0
      do k = 1, 2
         associate (g => c(of_force*(k - 1) + 1:of_force*k), &
            & m => c(2*of_force + of_moment*(k - 1) + 1:2*of_force + of_moment*k))
            ! rows of s: over_s is, until here, what multiplies s
            over_s(k, :) = s(1)*g(1:4) + s(2)*g(5:8)
            over_s(2 + k, :) = m(1:4) + square(1)*m(5:8) + square(2)*m(9:12) + square(3)*m(13:16)
         end associate
      end do
      f = matmul(over_s, s)
      if (.not. want_slopes) return
      of_square(:, 1) = [0.0_wp, 2*s(1), s(2), 0.0_wp]
      of_square(:, 2) = [0.0_wp, 0.0_wp, s(1), 2*s(2)]
      do k = 1, 2
         associate (g => c(of_force*(k - 1) + 1:of_force*k), &
            & m => c(2*of_force + of_moment*(k - 1) + 1:2*of_force + of_moment*k))
            over_s(k, 1) = over_s(k, 1) + dot_product(g(1:4), s)
            over_s(k, 2) = over_s(k, 2) + dot_product(g(5:8), s)
            do a = 1, 3
               over_s(2 + k, :2) = over_s(2 + k, :2) + dot_product(m(4*a + 1:4*a + 4), s)*of_square(a, :)
            end do
         end associate
      end do
   end subroutine apply_cubic

end module small_slopes
