!> The shape of a bearing in operation: radii and clearances after its pads have bent and shaft, pads and housing have
!> expanded; and this shape as a coupled field, as pressures and temperatures want other lengths (docs/theory/heat.md,
!> *Bent pads* and *Warm clearances*).
module bearing_shape
   use kinds, only: wp
   use text, only: filled, to_text
   use errors, only: error_type, raise, add_context, numerics_error
   use case_groups, only: bearing_type, is_set
   use case_inputs, only: case_type
   use tilting_pad_bearing, only: tilting_pad_bearing_type
   use film_energy, only: solid_layers
   use film_oils, only: film_oil
   use film_network, only: warm_films_type, film_field_type
   use heat_balance, only: oil_temperatures_type
   use heat_balance_equations, only: state_balance_type, find_temperatures
   use equations_of_motion, only: machine_model
   use fixed_point, only: coupled_field, most_rounds
   use pad_gap, only: pad_gap_type
   implicit none (type, external)
   private
   public :: bearing_shape_type, bending_type, part_temperatures_type, new_shape, cold_shapes, apply_shapes, &
      & check_shape, shape_field_type, points_along, points_across, bending_points, bent_by_pressure, bent_by_heat


   !> By how much bending changes the clearance of each pad, m.
   type :: bending_type
      real(wp), allocatable :: elastic(:), thermal(:)
   end type bending_type

   !> C; not allocated where nothing expands.
   type :: part_temperatures_type
      real(wp) :: shaft = 0, housing = 0
      real(wp), allocatable :: pads(:)
   end type part_temperatures_type

   type :: bearing_shape_type
      !> m; but for the radius one a pad.
      real(wp) :: journal_radius = 0
      real(wp), allocatable :: machined_clearance(:), assembled_clearance(:), pivot_distance(:)
      !> What has made it.
      type(bending_type) :: bending
      type(part_temperatures_type) :: temperatures
   contains
      procedure :: lengths
   end type bearing_shape_type


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

   !> The shape of a bearing whose pads bend, with these temperatures of its parts.
   pure type(bearing_shape_type) function new_shape(b, bending, temperatures) result(shape)
      type(bearing_type), intent(in) :: b
      type(bending_type), intent(in) :: bending
      type(part_temperatures_type), intent(in) :: temperatures
      real(wp) :: of_shaft, of_housing
      real(wp), dimension(b%pad_count()) :: of_pads
      of_shaft = 1
      of_housing = 1
      of_pads = 1
      associate (p => b%pads, t => temperatures)
         if (allocated(t%pads)) then
            of_shaft = 1 + b%shaft_expansion*(t%shaft - b%clearance_temperature)
            of_housing = 1 + b%housing_expansion*(t%housing - b%clearance_temperature)
            of_pads = 1 + p%expansion*(t%pads - b%clearance_temperature)
         end if
         shape%journal_radius = of_shaft*b%journal_radius
         shape%machined_clearance = of_pads*(b%journal_radius + b%machined_clearance) + bending%elastic &
            & + bending%thermal - shape%journal_radius
         shape%pivot_distance = of_pads*p%pivot_distance
         shape%assembled_clearance = of_housing*(b%journal_radius + b%assembled_clearance + p%pivot_distance) &
            & - shape%pivot_distance - shape%journal_radius
      end associate
      shape%bending = bending
      shape%temperatures = temperatures
   end function new_shape

   !> Its lengths in a row, m.
   pure function lengths(self)
      class(bearing_shape_type), intent(in) :: self
      real(wp), allocatable :: lengths(:)
      lengths = [self%journal_radius, self%machined_clearance, self%assembled_clearance, self%pivot_distance]
   end function lengths

   !> Refuses a shape of a bearing whose clearance is gone, or of which a pad bends by more than its clearance.
   subroutine check_shape(self, bearing, error)
      type(bearing_shape_type), intent(in) :: self
      type(bearing_type), intent(in) :: bearing
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      do i = 1, size(self%machined_clearance)
         associate (bent => self%bending%elastic(i) + self%bending%thermal(i), &
            & c => bearing%machined_clearance(i))
            if (abs(bent) > c) then
               call raise(error, numerics_error, filled('pad {} bends by {u.1} um, more than its clearance of {u.1} ' &
                  & //'um: {u.1} um by pressure, {u.1} um by heat; ', [real(wp) :: i, bent, c, &
                  & self%bending%elastic(i), self%bending%thermal(i)]) &
                  & //reason(i, self%bending%thermal(i) > self%bending%elastic(i)))
            else if (.not. self%machined_clearance(i) > 0) then
               call raise(error, numerics_error, gone('bearing%machined_clearance', c, self%machined_clearance(i)))
            else if (.not. self%assembled_clearance(i) > 0) then
               call raise(error, numerics_error, gone('bearing%assembled_clearance', &
                  & bearing%assembled_clearance(i), self%assembled_clearance(i)))
            end if
         end associate
         if (allocated(error)) return
      end do
   contains
      !> What bends pad i so far: heat or pressure.
      function reason(i, by_heat)
         integer, intent(in) :: i
         logical, intent(in) :: by_heat
         character(len=:), allocatable :: reason
         reason = filled('it is too thin (pads%thickness = {} m)', [bearing%pads%thickness(i)])
         if (by_heat) reason = filled('too much heat goes through it (pads%thickness = {} m, pads%conductivity = {} ' &
            & //'W/(m K), oil%back_coefficient = {} W/(m^2 K))', [bearing%pads%thickness(i), &
            & bearing%pads%conductivity(i), bearing%oil%back_coefficient])
      end function reason

      function gone(name, cold, warm) result(message)
         character(len=*), intent(in) :: name
         real(wp), intent(in) :: cold, warm
         character(len=:), allocatable :: message
         message = filled('the clearance of pad {} is gone: '//name//' = {u.1} um becomes {u.1} um', [real(wp) :: i, &
            & cold, warm])
         if (.not. is_set(bearing%clearance_temperature)) return
         associate (t => self%temperatures)
            message = message//filled(' with the shaft at {.1} C, the pad at {.1} C and the housing at {.1} C', &
               & [t%shaft, t%pads(i), t%housing])
         end associate
      end function gone
   end subroutine check_shape

   !> The shapes of all bearings of a case before anything bends or expands.
   function cold_shapes(inputs) result(shapes)
      type(case_type), intent(in) :: inputs
      type(bearing_shape_type), allocatable :: shapes(:)
      real(wp), allocatable :: none(:)
      integer :: b
      allocate (shapes(size(inputs%bearings)))
      do b = 1, size(shapes)
         none = 0*inputs%bearings(b)%machined_clearance
         shapes(b) = new_shape(inputs%bearings(b), bending_type(none, none), part_temperatures_type())
      end do
   end function cold_shapes

   !> Gives the bearings of a case whose shape changes these shapes.
   subroutine apply_shapes(shapes, inputs)
      type(bearing_shape_type), intent(in) :: shapes(:)
      type(case_type), intent(inout) :: inputs
      integer :: b
      do b = 1, size(shapes)
         if (.not. inputs%bearings(b)%changes_shape()) cycle
         associate (bearing => inputs%bearings(b), shape => shapes(b))
            bearing%journal_radius = shape%journal_radius
            bearing%machined_clearance = shape%machined_clearance
            bearing%assembled_clearance = shape%assembled_clearance
            bearing%pads%pivot_distance = shape%pivot_distance
         end associate
      end do
   end subroutine apply_shapes

   !> Refuses shapes of a case as `check_shape` does.
   subroutine check_shapes(shapes, inputs, error)
      type(bearing_shape_type), intent(in) :: shapes(:)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(out) :: error
      integer :: b
      do b = 1, size(shapes)
         call check_shape(shapes(b), inputs%bearings(b), error)
         call add_context(error, inputs%bearings(b)%label())
         if (allocated(error)) return
      end do
   end subroutine check_shapes

   !> The lengths of all shapes of a case in a row, over the least clearance that it gives each bearing.
   pure function all_lengths(shapes, inputs)
      type(bearing_shape_type), intent(in) :: shapes(:)
      type(case_type), intent(in) :: inputs
      real(wp), allocatable :: all_lengths(:)
      integer :: b
      allocate (all_lengths(0))
      do b = 1, size(shapes)
         all_lengths = [all_lengths, shapes(b)%lengths()/least_clearance(inputs, b)]
      end do
   end function all_lengths

   !> Gives them lengths in this order.
   pure subroutine set_all_lengths(shapes, lengths, inputs)
      type(bearing_shape_type), intent(inout) :: shapes(:)
      real(wp), intent(in) :: lengths(:)
      type(case_type), intent(in) :: inputs
      integer :: b, at
      at = 1
      do b = 1, size(shapes)
         associate (n => size(shapes(b)%pivot_distance), of => shapes(b), unit => least_clearance(inputs, b))
            of%journal_radius = lengths(at)*unit
            of%machined_clearance = lengths(at + 1:at + n)*unit
            of%assembled_clearance = lengths(at + n + 1:at + 2*n)*unit
            of%pivot_distance = lengths(at + 2*n + 1:at + 3*n)*unit
            at = at + 3*n + 1
         end associate
      end do
   end subroutine set_all_lengths

   !> The least clearance that a case gives bearing b, m.
   pure real(wp) function least_clearance(inputs, b)
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      associate (own => inputs%bearings(b))
         least_clearance = minval([own%machined_clearance, own%assembled_clearance])
      end associate
   end function least_clearance

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
      integer :: b, i
      shapes = cold_shapes(cold)
      call find_part_temperatures()
      do b = 1, size(shapes)
         associate (own => cold%bearings(b))
            if (.not. own%changes_shape()) cycle
            bending = shapes(b)%bending
            if (any(own%pads%bending == ['elastic', 'both   '])) call bend_elastically(own, static%bearings(b), &
               & bending%elastic)
            if (any(own%pads%bending == ['thermal', 'both   '])) then
               associate (pads => own%pads, fields => films(b)%fields)
                  bending%thermal = [(bent_by_heat(static%bearings(b)%pads(i)%gap, pads%thickness(i), &
                     & pads%expansion(i), (fields(solid_layers, :, i) - fields(1, :, i)) &
                     & /(pads%thickness(i)*(1 - 1.0_wp/solid_layers))), i=1, size(bending%thermal))]
               end associate
            end if
            shapes(b) = new_shape(own, bending, parts(b))
         end associate
      end do

   contains

      !> Temperatures of shaft, pads and housing of each bearing, given or of the state y; those of pads are not
      !> allocated where nothing expands.
      subroutine find_part_temperatures()
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
end module bearing_shape
