!> The shape of bearings as a coupled field: where pads bend, or shaft, pads and housing expand, pressures and
!> temperatures want other lengths (docs/theory/heat.md, *Bent pads* and *Warm clearances*).
module shape_field
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error
   use case_groups, only: bearing_type, is_set
   use case_inputs, only: case_type
   use bearing_shape, only: bearing_shape_type, bending_type, part_temperatures_type, new_shape, cold_shapes, &
      & apply_shapes, check_shapes, all_lengths, set_all_lengths
   use tilting_pad_bearing, only: tilting_pad_bearing_type
   use film_conduction, only: solid_layers
   use film_oils, only: film_oil
   use film_network, only: warm_films_type
   use heat_balance, only: oil_temperatures_type
   use heat_balance_equations, only: state_balance_type, find_temperatures
   use equations_of_motion, only: machine_model
   use fixed_point, only: coupled_field, most_rounds
   use film_field, only: film_field_type
   use pad_gap, only: pad_gap_type
   implicit none (type, external)
   private
   public :: shape_field_type, points_along, points_across, bending_points, bent_by_pressure, bent_by_heat

   !> Its values are the lengths of the shapes, over the least clearance that the case gives the bearing.
   type, extends(coupled_field) :: shape_field_type
      !> The case with the shapes that it gives, and the shapes that are wanted; the largest change to these.
      type(case_type), private :: cold
      type(bearing_shape_type), allocatable :: wanted(:)
      real(wp), private :: change = 0
      !> The temperatures of the films, where they have some.
      type(film_field_type), pointer, private :: films => null()
   contains
      procedure :: begin
      procedure :: apply
      procedure :: find_wanted
      procedure :: check
      procedure :: explain
   end type shape_field_type

   !> Largest change of a length at the end, and longest step, over the clearance.
   real(wp), parameter :: agreement = 1e-7_wp, longest = 0.25_wp

   !> Intervals from the pivot to an edge and along half the width, of Simpson's rule.
   integer, parameter :: intervals = 64, intervals_across = 16
   integer, parameter :: points_along = 2*intervals + 1, points_across = intervals_across + 1

contains

   !> Begins with the shapes of a case, whose films may have temperatures.
   subroutine begin(self, cold, films)
      class(shape_field_type), intent(inout) :: self
      type(case_type), intent(in) :: cold
      type(film_field_type), intent(in), target :: films
      self%agreement = agreement
      self%longest = longest
      self%cold = cold
      self%values = all_lengths(cold_shapes(cold), cold)
      self%films => films
   end subroutine begin

   subroutine apply(self, model)
      class(shape_field_type), intent(inout) :: self
      type(machine_model), intent(inout) :: model
      type(bearing_shape_type), allocatable :: shapes(:)
      type(case_type) :: inputs
      type(film_oil) :: oil(size(model%oil))
      shapes = cold_shapes(self%cold)
      call set_all_lengths(shapes, self%values, self%cold)
      inputs = self%cold
      call apply_shapes(shapes, inputs)
      oil = model%oil
      call model%adopt(inputs, .true.)
      model%oil = oil
   end subroutine apply

   subroutine find_wanted(self, model, y, wanted, error)
      class(shape_field_type), intent(inout) :: self
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      real(wp), intent(out) :: wanted(:)
      type(error_type), allocatable, intent(out) :: error
      call find_shapes(self%cold, model, y, self%films%films, self%wanted)
      wanted = all_lengths(self%wanted, self%cold)
      self%change = maxval(abs(wanted - self%values))
   end subroutine find_wanted

   !> Refuses shapes in which a bearing cannot run, and those that do not settle.
   subroutine check(self, model, agrees, error)
      class(shape_field_type), intent(in) :: self
      type(machine_model), intent(in) :: model
      logical, intent(in) :: agrees
      type(error_type), allocatable, intent(out) :: error
      call check_shapes(self%wanted, self%cold, error)
      if (.not. (allocated(error) .or. agrees)) call raise(error, numerics_error, 'the shape of the bearing does not ' &
         & //'settle: after '//to_text(most_rounds)//' rounds its clearances still change by ' &
         & //to_text(100*self%change)//' %')
   end subroutine check

   !> The reason of a shape, where a search in one on the way to it has failed.
   subroutine explain(self, model, y, first, error)
      class(shape_field_type), intent(in) :: self
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      logical, intent(in) :: first
      type(error_type), allocatable, intent(inout) :: error
      type(error_type), allocatable :: reason
      if (allocated(self%wanted)) call check_shapes(self%wanted, self%cold, reason)
      if (allocated(reason)) then
         call move_alloc(reason, error)
      else
         call add_context(error, 'while pads bend and parts expand')
      end if
   end subroutine explain

   !> The shapes of a case to which the state y of a model leads, where it was evaluated last.
   subroutine find_shapes(cold, static, y, films, shapes)
      type(case_type), intent(in) :: cold
      type(machine_model), intent(inout) :: static
      real(wp), intent(in) :: y(:)
      !> Of each bearing, where films have temperatures.
      type(warm_films_type), allocatable, intent(in) :: films(:)
      type(bearing_shape_type), allocatable, intent(out) :: shapes(:)
      type(part_temperatures_type) :: parts(size(static%bearings))
      type(bending_type) :: bending
      integer :: b
      shapes = cold_shapes(cold)
      call find_part_temperatures(cold, static, y, films, parts)
      do b = 1, size(shapes)
         associate (own => cold%bearings(b))
            if (.not. own%changes_shape()) cycle
            bending = shapes(b)%bending
            if (any(own%pads%bending == ['elastic', 'both   '])) call bend_elastically(own, static%bearings(b), &
               & bending%elastic)
            if (any(own%pads%bending == ['thermal', 'both   '])) bending%thermal = bent_films(own, static%bearings(b), &
               & films(b))
            shapes(b) = new_shape(own, bending, parts(b))
         end associate
      end do
   end subroutine find_shapes

   !> Changes of the clearances of a bearing by the pressure of its films, m.
   subroutine bend_elastically(cold, bearing, elastic)
      type(bearing_type), intent(in) :: cold
      type(tilting_pad_bearing_type), intent(inout) :: bearing
      real(wp), intent(out) :: elastic(:)
      real(wp) :: phi(points_along, size(elastic)), z(points_across, size(elastic))
      real(wp) :: pressure(points_across, points_along, size(elastic))
      integer :: i
      do i = 1, size(elastic)
         call bending_points(bearing%pads(i)%gap, phi(:, i), z(:, i))
      end do
      call bearing%pressure_field(phi, z, pressure)
      do i = 1, size(elastic)
         associate (gap => bearing%pads(i)%gap, p => cold%pads)
            elastic(i) = bent_by_pressure(gap, p%thickness(i), p%young_modulus(i), p%poisson_ratio(i), &
               & pressure(:, :, i) - gap%ambient_pressure)
         end associate
      end do
   end subroutine bend_elastically

   !> Changes of the clearances of a bearing by the temperatures across its pads, m.
   function bent_films(cold, bearing, films) result(thermal)
      type(bearing_type), intent(in) :: cold
      type(tilting_pad_bearing_type), intent(in) :: bearing
      type(warm_films_type), intent(in) :: films
      real(wp) :: thermal(cold%pad_count())
      integer :: i
      associate (p => cold%pads)
         do i = 1, size(thermal)
            thermal(i) = bent_by_heat(bearing%pads(i)%gap, p%thickness(i), p%expansion(i), &
               & (films%fields(solid_layers, :, i) - films%fields(1, :, i))/(p%thickness(i)*(1 - 1.0_wp/solid_layers)))
         end do
      end associate
   end function bent_films

   !> Temperatures of shaft, pads and housing of each bearing, given or of the state y; those of pads are not allocated
   !> where nothing expands.
   subroutine find_part_temperatures(cold, static, y, films, parts)
      type(case_type), intent(in) :: cold
      type(machine_model), intent(in) :: static
      real(wp), intent(in) :: y(:)
      type(warm_films_type), allocatable, intent(in) :: films(:)
      type(part_temperatures_type), intent(out) :: parts(:)
      type(state_balance_type) :: balance
      type(oil_temperatures_type) :: oil(size(parts))
      integer :: b
      do b = 1, size(parts)
         if (.not. is_set(cold%bearings(b)%clearance_temperature)) cycle
         associate (housing => cold%bearings(b)%housing_temperature, given => cold%bearings(b)%pads%temperature, &
            & oil_given => cold%bearings(b)%oil, part => parts(b))
            part%housing = merge(housing, oil_given%supply_temperature, is_set(housing))
            part%pads = given
            if (allocated(films)) then
               associate (solid => films(b)%fields(:solid_layers, :, :))
                  where (.not. is_set(given)) part%pads = sum(sum(solid, 1), 1)/(size(solid, 1)*size(solid, 2))
               end associate
               part%shaft = films(b)%oil%shaft
            else if (is_set(oil_given%shaft_temperature)) then
               part%shaft = oil_given%shaft_temperature
            else
               if (.not. allocated(oil(b)%mean)) call find_temperatures(static, y, balance, oil)
               part%shaft = oil(b)%shaft
            end if
         end associate
      end do
   end subroutine find_part_temperatures

   ! How far pads bend: the change of the radius of a pad's bore by the pressure of its film, and by the heat that flows
   ! through it (docs/theory/heat.md, *Bent pads*).
   !
   ! A pad is a curved beam on its pivot, of the radius R_m in the middle of its thickness t. Where its curvature
   ! changes by k, its bore moves outward by w, w'' + w = R_m^2 k over the angle from the pivot. A pressure p per area
   ! bends it by k = M/(E' I), E' = E/(1 - nu^2), I = t^3/12, with the moment M(phi) of what acts from phi to the edge,
   ! a gradient of temperature by k = alpha dT/dr. The bore that counts goes through the pivot and both edges.

   !> Where the pressure is asked for: angles from the pivot, from the trailing to the leading edge, rad, and distances
   !> from the middle plane, m.
   pure subroutine bending_points(gap, phi, z)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(out) :: phi(:), z(:)
      integer :: i
      do i = 0, intervals
         phi(intervals + 1 + i) = gap%leading_angle*i/intervals
         phi(intervals + 1 - i) = -gap%trailing_angle*i/intervals
      end do
      z = [(0.5_wp*gap%axial_length*i/intervals_across, i=0, intervals_across)]
   end subroutine bending_points

   !> Change of the bore's radius, m, by pressures above ambient at these points, Pa, (axial position, angle), of a pad
   !> of this thickness, m, Young's modulus, Pa, and Poisson's ratio.
   pure real(wp) function bent_by_pressure(gap, thickness, modulus, poisson, pressure) result(change)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: thickness, modulus, poisson, pressure(:, :)
      real(wp) :: along(-intervals:intervals), unit, middle
      along = matmul(simpson(intervals_across), pressure)
      middle = gap%pad_radius() + thickness/2
      unit = gap%pad_radius()*middle**3/(modulus/(1 - poisson**2)*thickness**3/12)
      change = radius_change(gap, unit*edge(along(0:), gap%leading_angle), &
         & unit*edge(along(0:-intervals:-1), gap%trailing_angle))
   contains
      !> The integral of the pressure, from the pivot to an edge at this angle, times what a force of 1 moves that edge:
      !> the integral over s from 0 to phi of sin(edge - s) sin(phi - s).
      pure real(wp) function edge(pressure, angle)
         real(wp), intent(in) :: pressure(0:), angle
         real(wp) :: phi(0:intervals)
         integer :: i
         phi = [(angle*i/intervals, i=0, intervals)]
         edge = angle*sum(simpson(intervals)*pressure*0.5_wp*(phi*cos(angle - phi) - cos(angle)*sin(phi)))
      end function edge
   end function bent_by_pressure

   !> The same by gradients of the temperature from back to bore, K/m, at even stations from the leading edge on, of a
   !> pad of this thickness, m, and linear expansion, 1/K.
   pure real(wp) function bent_by_heat(gap, thickness, expansion, gradient) result(change)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: thickness, expansion, gradient(:)
      real(wp) :: unit
      integer :: n
      n = size(gradient)
      unit = expansion*(gap%pad_radius() + thickness/2)**2
      change = radius_change(gap, unit*edge(gradient, gap%leading_angle), &
         & unit*edge(gradient(n:1:-1), gap%trailing_angle))
   contains
      !> The integral of the gradient times sin(edge - phi), from the pivot to the edge before the first station.
      pure real(wp) function edge(gradient, angle)
         real(wp), intent(in) :: gradient(:), angle
         real(wp) :: from_edge(0:size(gradient))
         integer :: i
         from_edge = [(min(gap%arc()*i/size(gradient), angle), i=0, size(gradient))]
         edge = sum(gradient*(cos(from_edge(:size(gradient) - 1)) - cos(from_edge(1:))))
      end function edge
   end function bent_by_heat

   !> Of the circle through the pivot and both edges where the edges move outward: w = change (1 - cos phi)
   !> + turn sin phi.
   pure real(wp) function radius_change(gap, leading, trailing) result(change)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: leading, trailing
      associate (a => gap%leading_angle, b => gap%trailing_angle)
         change = (leading*sin(b) + trailing*sin(a))/((1 - cos(a))*sin(b) + (1 - cos(b))*sin(a))
      end associate
   end function radius_change

   !> Weights of Simpson's rule for the mean over an even number of intervals.
   pure function simpson(intervals) result(weights)
      integer, intent(in) :: intervals
      real(wp) :: weights(intervals + 1)
      integer :: i
      weights = [(real(2 + 2*mod(i, 2), wp), i=0, intervals)]
      weights([1, intervals + 1]) = 1
      weights = weights/(3*intervals)
   end function simpson
end module shape_field
