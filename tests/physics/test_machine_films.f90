!> Machines with temperatures along and across their films: each bearing has those that it has alone under its load,
!> whatever the order of the bearings, and oil that does not thin is cold oil.
program test_machine_films
   use kinds, only: wp
   use text, only: to_text
   use input_cases, only: case_of
   use equations_of_motion, only: machine_model
   use equilibrium_record, only: equilibrium_type
   use equilibrium, only: bearing_loads, part_of
   use linear_bearing, only: bearing_coefficients_type
   use linear_analysis, only: analyse
   use check, only: runs, expect, report
   implicit none (type, external)

   !> A shaft with an overhung disc in three bearings that share its weight by their stiffness; they differ in pads,
   !> clearances and oil.
   character(len=*), parameter :: shaft = '&case task = ''coefficients''/ &operation speed_rpm = 5000/' &
      & //'&shaft length = 2*0.05, 8*0.15, 0.05, 0.15, diameter = 2*0.0998, 8*0.2, 2*0.0998/' &
      & //'&disc station = 6, mass = 1500, polar_inertia = 200, diametral_inertia = 110/' &
      & //'&disc station = 13, mass = 60, polar_inertia = 2, diametral_inertia = 1/'
   character(len=*), parameter :: left = '&bearing name = ''left'', station = 2/ &pads bearing = ''left'',' &
      & //' motion = ''tilting_only''/'
   character(len=*), parameter :: middle = '&bearing name = ''middle'', station = 9, assembled_clearance = 110e-6,' &
      & //' offset = -20e-6, 5e-6/ &pads bearing = ''middle'', pivot_angle_deg = -54, 18, 90, 162, 234, arc_deg = 60/'
   character(len=*), parameter :: right = '&bearing name = ''right'', station = 12/'
   character(len=*), parameter :: oils = '&film cavitation = ''none''/ &oil grade = 46/' &
      & //'&oil bearing = ''middle'', grade = 32, supply_temperature = 50, shaft_temperature = 60/' &
      & //'&oil bearing = ''right'', grade = 68, carry_over = 0.5/'
   character(len=*), parameter :: warm = '&thermal model = ''film''/'
   !> Relative to the journal's displacement and to coefficients: temperatures agree to 1e-6 K, which are 1e-7 of a
   !> viscosity, and loads to 1e-6 of themselves.
   real(wp), parameter :: of_displacements = 1e-6_wp, of_coefficients = 1e-5_wp
   !> Of temperatures, K.
   real(wp), parameter :: of_temperatures = 1e-4_wp

   if (runs('alone')) call alone()
   if (runs('order')) call order()
   if (runs('even_oil')) call even_oil()
   call report()

contains

   !> Each bearing by itself, with a rigid journal under the load that the machine lays on it, has the same films.
   subroutine alone()
      type(machine_model) :: model, one
      type(equilibrium_type) :: static, rigid
      type(bearing_coefficients_type) :: found, linear
      real(wp) :: loads(2, 3)
      integer :: b
      call analyse(case_of(shaft//left//middle//right//oils//warm), 'a machine', found, static, model)
      if (.not. allocated(static%films)) return
      loads = bearing_loads(model, static)
      call expect(minval(loads(1, :)) < 2*maxval(loads(1, :)), 'loads differ')
      do b = 1, 3
         call analyse(model%inputs%alone(b, loads(:, b)), 'alone', linear, rigid, one)
         call expect_same(part_of(model, static, b), rigid, 'bearing '//to_text(b))
         call expect_close_all(found, b, linear, 1, 'bearing '//to_text(b))
      end do
   end subroutine alone

   !> The bearings in another order.
   subroutine order()
      type(machine_model) :: model, other_model
      type(equilibrium_type) :: static, other
      type(bearing_coefficients_type) :: found, linear
      integer, parameter :: places(3) = [2, 3, 1]
      integer :: b
      call analyse(case_of(shaft//left//middle//right//oils//warm), 'a machine', found, static, model)
      call analyse(case_of(shaft//oils//right//left//middle//warm), 'in another order', linear, other, other_model)
      if (.not. (allocated(static%films) .and. allocated(other%films))) return
      do b = 1, 3
         call expect_same(part_of(other_model, other, places(b)), part_of(model, static, b), 'bearing '//to_text(b))
         call expect_close_all(linear, places(b), found, b, 'bearing '//to_text(b))
      end do
   end subroutine order

   !> Oil whose viscosity does not depend on its temperature.
   subroutine even_oil()
      type(machine_model) :: model
      type(equilibrium_type) :: static, cold
      type(bearing_coefficients_type) :: found, linear
      character(len=*), parameter :: even = '&oil reference_viscosity = 0.02, temperature_exponent = 0/' &
         & //'&film solver = ''direct'', cavitation = ''none''/'
      integer :: b
      call analyse(case_of(shaft//left//middle//right//even), 'cold', linear, cold)
      call analyse(case_of(shaft//left//middle//right//even//warm), 'warm', found, static, model)
      if (.not. allocated(static%films)) return
      call expect(maxval(abs(static%rotor - cold%rotor)) < 1e-8_wp*maxval(abs(cold%rotor)), 'journals')
      do b = 1, 3
         call expect_close_all(found, b, linear, b, 'bearing '//to_text(b))
         call expect(all(static%films(b)%oil%maximum > 45), 'it warms')
      end do
   end subroutine even_oil

   !> Equilibria of a bearing are the same.
   subroutine expect_same(found, other, what)
      type(equilibrium_type), intent(in) :: found, other
      character(len=*), intent(in) :: what
      call expect(maxval(abs(found%rotor - other%rotor)) < of_displacements*maxval(abs(other%rotor)), &
         & what//': journal')
      call expect(maxval(abs(found%films(1)%fields - other%films(1)%fields)) < of_temperatures, what//': temperatures')
      call expect(abs(found%films(1)%oil%shaft - other%films(1)%oil%shaft) < of_temperatures, what//': shaft')
   end subroutine expect_same

   !> So are stiffness and damping of bearing b and those of another one.
   subroutine expect_close_all(found, b, other, c, what)
      type(bearing_coefficients_type), intent(in) :: found, other
      integer, intent(in) :: b, c
      character(len=*), intent(in) :: what
      call expect(norm2(found%stiffness(:, :, :, :, b) - other%stiffness(:, :, :, :, c)) &
         & < of_coefficients*norm2(other%stiffness(:, :, :, :, c)), what//': stiffness')
      call expect(norm2(found%damping(:, :, :, :, b) - other%damping(:, :, :, :, c)) &
         & < of_coefficients*norm2(other%damping(:, :, :, :, c)), what//': damping')
   end subroutine expect_close_all
end program test_machine_films
