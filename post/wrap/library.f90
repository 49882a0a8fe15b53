!> What Python calls of the library (post/tiltpad/library.py): numbers, texts and arrays of explicit shape, by f2py.
!>
!> A case comes as the text of a namelist, read and checked as the program reads it; `name` stands for it in
!> messages. `status` is 0, or the exit status of the program for the `message`. SI units.
module tiltpad_library
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use errors, only: error_type, raise, input_error, numerics_error
   use text, only: to_text
   use case_inputs, only: case_type
   use case_namelist, only: case_from_text
   use read_files, only: read_tables
   use film_oils, only: uneven_oil
   use factories, only: make_law, make_friction, converged_films
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state
   use tilting_pad_bearing, only: pad_sample
   use bearing_losses, only: bearing_losses_type, pad_loss, new_bearing_losses
   use equations_of_motion, only: machine_model, new_machine_model
   use contact_law, only: contact_law_type, contact_point
   use friction, only: friction_law, friction_response
   use kinds, only: degree
   implicit none (type, external)
   private
   public :: film_pressure, power_losses, contact, contact_pressure, friction_force

contains

   !> Pressure of every pad's film, and what the program samples of it, in one state of the bearing.
   subroutine film_pressure(text, name, viscosity, weights, time, journal, motion, along, across, phi, z, &
       pressure, force, max_pressure, min_film_thickness, status, message, pads, n, m)
      integer(c_int), intent(in) :: pads, n, m
      character(len=*), intent(in) :: text, name
      !> Of the oil on each pad, Pa s; 0: that of the case.
      real(c_double), intent(in) :: viscosity(pads)
      !> Coefficients of ln(12 mu f2), f1 and ln(f0/mu) along the arcs; 0 where all of the oil has its viscosity.
      real(c_double), intent(in) :: weights(5, 3, pads)
      !> s, of which the speed follows; y, z of the journal, m, and their rates, m/s.
      real(c_double), intent(in) :: time, journal(4)
      !> Tilt, rad, pivot deflection, m, pitch and yaw, rad, each with its rate; what pads do not have does not matter.
      real(c_double), intent(in) :: motion(2, 4, pads)
      !> Points: share of the arc from the trailing edge (0) to the leading one (1); share of half the width from the
      !> middle plane.
      real(c_double), intent(in) :: along(n), across(m)
      !> Angles from the pivot, rad; axial places, m; pressure there, Pa.
      real(c_double), intent(out) :: phi(n, pads), z(m, pads), pressure(m, n, pads)
      !> Force on the journal in the pad frame, N; highest pressure at the solver's own points, Pa; least film
      !> thickness, m.
      real(c_double), intent(out) :: force(2, pads), max_pressure(pads), min_film_thickness(pads)
      integer(c_int), intent(out) :: status
      character(len=2000), intent(out) :: message
      type(error_type), allocatable :: error
      type(case_type) :: inputs
      type(machine_model) :: model
      type(pad_sample) :: samples(pads)
      real(c_double), allocatable :: y(:)
      integer :: i
      logical :: ok
      call read_bearing(text, name, viscosity, weights, inputs, model, error)
      if (.not. allocated(error)) then
         y = model%state(journal_motion(journal(:2), journal(3:4)), states_of(motion))
         call model%evaluate(time, y, .false., ok)
         if (.not. ok) call raise(error, numerics_error, name//': '//model%refusal)
      end if
      if (.not. allocated(error)) then
         associate (bearing => inputs%bearings(1), arc => inputs%bearings(1)%pads%arc_deg*degree)
            do i = 1, pads
               phi(:, i) = (along - 1 + bearing%pads%pivot_ratio(i))*arc(i)
               z(:, i) = 0.5_c_double*bearing%axial_length(i)*across
            end do
         end associate
         samples = model%bearings(1)%sampled()
         force(1, :) = samples%film_force(1)
         force(2, :) = samples%film_force(2)
         max_pressure = samples%max_pressure
         min_film_thickness = samples%min_film_thickness
         call model%bearings(1)%pressure_field(phi, z, pressure)
      end if
      call tell(error, status, message)
   end subroutine film_pressure

   !> Loads, losses and flows of all pads in n states of the bearing.
   subroutine power_losses(text, name, viscosity, weights, time, journal, motion, losses, status, message, pads, n)
      integer(c_int), intent(in) :: pads, n
      character(len=*), intent(in) :: text, name
      !> As in film_pressure, state by state.
      real(c_double), intent(in) :: viscosity(pads), weights(5, 3, pads), time(n), journal(4, n), &
         motion(2, 4, pads, n)
      !> Load, N; Couette, pressure and boundary loss, W; drag on the journal and on the pad, N m; inlet, outlet and
      !> side flow, m^3/s. No numbers where a film is closed.
      real(c_double), intent(out) :: losses(9, pads, n)
      integer(c_int), intent(out) :: status
      character(len=2000), intent(out) :: message
      type(error_type), allocatable :: error
      type(case_type) :: inputs
      type(machine_model) :: model
      type(bearing_losses_type) :: finder
      type(pad_loss) :: found(pads)
      integer :: i, k
      call read_bearing(text, name, viscosity, weights, inputs, model, error)
      if (.not. allocated(error)) then
         finder = new_bearing_losses(inputs%bearings(1))
         do k = 1, n
            call finder%find(model%bearings(1), journal_motion(journal(:2, k), journal(3:4, k)), &
               & states_of(motion(:, :, :, k)), model%oil, model%point%speed(time(k)), found)
            do i = 1, pads
               associate (pad => found(i))
                  losses(:, i, k) = [pad%load, pad%couette, pad%pressure, pad%boundary, pad%journal_drag, &
                     & pad%pad_drag, pad%inlet, pad%outlet, pad%side]
               end associate
            end do
         end do
      end if
      call tell(error, status, message)
   end subroutine power_losses

   !> States of pads with this motion, (displacement and rate, kind, pad).
   pure function states_of(motion) result(states)
      real(c_double), intent(in) :: motion(:, :, :)
      type(pad_state) :: states(size(motion, 3))
      integer :: i
      do i = 1, size(states)
         states(i)%x = motion(1, :, i)
         states(i)%v = motion(2, :, i)
      end do
   end function states_of

   !> Contact of the pivot of a pad at pivot deflections, m; all zero where these are not positive.
   subroutine contact(text, name, pad, pivot_deflection, force, slope, radius, exponent, peak_pressure, status, &
      message, n)
      integer(c_int), intent(in) :: pad, n
      character(len=*), intent(in) :: text, name
      real(c_double), intent(in) :: pivot_deflection(n)
      !> N; N/m; projected radius of the contact, m; exponent and peak, Pa, of the pressure (11).
      real(c_double), intent(out) :: force(n), slope(n), radius(n), exponent(n), peak_pressure(n)
      integer(c_int), intent(out) :: status
      character(len=2000), intent(out) :: message
      type(error_type), allocatable :: error
      type(contact_point) :: points(n)
      call find_contacts(text, name, pad, pivot_deflection, points, error)
      force = points%force
      slope = points%stiffness
      radius = points%radius
      exponent = points%exponent
      peak_pressure = points%peak_pressure
      call tell(error, status, message)
   end subroutine contact

   !> Contact pressure (11), Pa, at pivot deflections, m, and projected distances r from the axis, m, one each.
   subroutine contact_pressure(text, name, pad, pivot_deflection, r, pressure, status, message, n)
      integer(c_int), intent(in) :: pad, n
      character(len=*), intent(in) :: text, name
      real(c_double), intent(in) :: pivot_deflection(n), r(n)
      real(c_double), intent(out) :: pressure(n)
      integer(c_int), intent(out) :: status
      character(len=2000), intent(out) :: message
      type(error_type), allocatable :: error
      type(contact_point) :: points(n)
      integer :: i
      call find_contacts(text, name, pad, pivot_deflection, points, error)
      do i = 1, n
         pressure(i) = points(i)%pressure(r(i))
      end do
      call tell(error, status, message)
   end subroutine contact_pressure

   !> Friction force, N, and rate of the bristle deflection, m/s, at sliding velocities, m/s, bristle deflections, m
   !> (LuGre), and normal forces, N.
   subroutine friction_force(text, name, pad, velocity, deflection, normal, force, rate, status, message, n)
      integer(c_int), intent(in) :: pad, n
      character(len=*), intent(in) :: text, name
      real(c_double), intent(in) :: velocity(n), deflection(n), normal(n)
      real(c_double), intent(out) :: force(n), rate(n)
      integer(c_int), intent(out) :: status
      character(len=2000), intent(out) :: message
      type(error_type), allocatable :: error
      type(case_type) :: inputs
      class(friction_law), allocatable :: law
      type(friction_response) :: response
      integer :: i
      call read_pad(text, name, pad, inputs, error)
      if (.not. allocated(error)) then
         call make_friction(inputs%bearings(1)%friction, pad, law)
         do i = 1, n
            call law%evaluate(velocity(i), deflection(i), normal(i), response)
            force(i) = response%force
            rate(i) = response%rate
         end do
      end if
      call tell(error, status, message)
   end subroutine friction_force

   !> The bearing of a namelist text, which has to have as many pads as viscosities are given. Tasks without motion have
   !> the films of their equilibrium; few states of a motion are not worth a table.
   subroutine read_bearing(text, name, viscosity, weights, inputs, model, error)
      character(len=*), intent(in) :: text, name
      real(c_double), intent(in) :: viscosity(:), weights(0:, :, :)
      type(case_type), intent(out) :: inputs
      type(machine_model), intent(out) :: model
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      call case_from_text(text, name, inputs, error, of_result=.true.)
      if (.not. allocated(error)) call read_tables(inputs, error)
      if (allocated(error)) return
      if (inputs%bearings(1)%pad_count() /= size(viscosity)) then
         call raise(error, input_error, name//': '//to_text(inputs%bearings(1)%pad_count()) &
            & //' pads, but states of '//to_text(size(viscosity)))
         return
      end if
      if (any(inputs%about%task == ['equilibrium ', 'coefficients'])) then
         model = new_machine_model(inputs, converged_films)
      else
         if (inputs%bearings(1)%film%solver == 'auto') inputs%bearings(1)%film%solver = 'direct'
         model = new_machine_model(inputs)
      end if
      if (all(viscosity > 0)) model%oil = [(uneven_oil(viscosity(i), weights(:, :, i)), i=1, size(viscosity))]
   end subroutine read_bearing

   !> The contact at each pivot deflection, m; that of no force where it is not positive.
   subroutine find_contacts(text, name, pad, pivot_deflection, points, error)
      character(len=*), intent(in) :: text, name
      integer, intent(in) :: pad
      real(c_double), intent(in) :: pivot_deflection(:)
      type(contact_point), intent(out) :: points(:)
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: inputs
      class(contact_law_type), allocatable :: law
      integer :: i
      call read_pad(text, name, pad, inputs, error)
      if (allocated(error)) return
      call make_law(inputs%bearings(1)%pivot, pad, law)
      do i = 1, size(points)
         if (pivot_deflection(i) > 0) points(i) = law%at(pivot_deflection(i))
      end do
   end subroutine find_contacts

   !> The case of a namelist text, which has to have this pad.
   subroutine read_pad(text, name, pad, inputs, error)
      character(len=*), intent(in) :: text, name
      integer, intent(in) :: pad
      type(case_type), intent(out) :: inputs
      type(error_type), allocatable, intent(out) :: error
      call case_from_text(text, name, inputs, error, of_result=.true.)
      if (.not. allocated(error)) call read_tables(inputs, error)
      if (allocated(error)) return
      if (pad < 1 .or. pad > inputs%bearings(1)%pad_count()) call raise(error, input_error, name//': no pad ' &
         & //to_text(pad) &
         & //', of '//to_text(inputs%bearings(1)%pad_count()))
   end subroutine read_pad

   !> An error as status and message, or neither.
   subroutine tell(error, status, message)
      type(error_type), allocatable, intent(in) :: error
      integer(c_int), intent(out) :: status
      character(len=2000), intent(out) :: message
      status = 0
      message = ''
      if (.not. allocated(error)) return
      status = int(error%status, c_int)
      message = error%message
   end subroutine tell
end module tiltpad_library
