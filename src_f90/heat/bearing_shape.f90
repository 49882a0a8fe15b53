!> The shape of a bearing in operation: radii and clearances after its pads have bent and shaft, pads and housing have
!> expanded (docs/theory/heat.md, *Bent pads* and *Warm clearances*).
module bearing_shape
   use kinds, only: wp
   use text, only: filled
   use errors, only: error_type, raise, add_context, numerics_error
   use case_groups, only: bearing_type, is_set
   use case_inputs, only: case_type
   implicit none (type, external)
   private
   public :: bearing_shape_type, bending_type, part_temperatures_type, new_shape
   public :: cold_shapes, apply_shapes, check_shapes, all_lengths, set_all_lengths

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
      procedure, private :: apply
      procedure :: lengths
      procedure, private :: set_lengths
      procedure :: check
   end type bearing_shape_type

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

   !> Gives a bearing the shape.
   pure subroutine apply(self, bearing)
      class(bearing_shape_type), intent(in) :: self
      type(bearing_type), intent(inout) :: bearing
      bearing%journal_radius = self%journal_radius
      bearing%machined_clearance = self%machined_clearance
      bearing%assembled_clearance = self%assembled_clearance
      bearing%pads%pivot_distance = self%pivot_distance
   end subroutine apply

   !> Its lengths in a row, m.
   pure function lengths(self)
      class(bearing_shape_type), intent(in) :: self
      real(wp), allocatable :: lengths(:)
      lengths = [self%journal_radius, self%machined_clearance, self%assembled_clearance, self%pivot_distance]
   end function lengths

   !> Gives it lengths in this order.
   pure subroutine set_lengths(self, lengths)
      class(bearing_shape_type), intent(inout) :: self
      real(wp), intent(in) :: lengths(:)
      associate (n => size(self%pivot_distance))
         self%journal_radius = lengths(1)
         self%machined_clearance = lengths(2:n + 1)
         self%assembled_clearance = lengths(n + 2:2*n + 1)
         self%pivot_distance = lengths(2*n + 2:)
      end associate
   end subroutine set_lengths

   !> Refuses a shape of a bearing whose clearance is gone, or of which a pad bends by more than its clearance.
   subroutine check(self, bearing, error)
      class(bearing_shape_type), intent(in) :: self
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
   end subroutine check

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
         if (inputs%bearings(b)%changes_shape()) call shapes(b)%apply(inputs%bearings(b))
      end do
   end subroutine apply_shapes

   !> Refuses shapes of a case as `check` does.
   subroutine check_shapes(shapes, inputs, error)
      type(bearing_shape_type), intent(in) :: shapes(:)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(out) :: error
      integer :: b
      do b = 1, size(shapes)
         call shapes(b)%check(inputs%bearings(b), error)
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
      integer :: b, first, last
      last = 0
      do b = 1, size(shapes)
         first = last + 1
         last = last + size(shapes(b)%lengths())
         call shapes(b)%set_lengths(lengths(first:last)*least_clearance(inputs, b))
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
end module bearing_shape
