!> Bearings of fixed pads: the limits of Ocvirk and Sommerfeld, the table of Lund and Thomsen, the threshold of oil
!> whirl and the marches on both sides of it.
program test_fixed_pads
   use kinds, only: wp, pi, rpm, degree
   use text, only: to_text
   use errors, only: error_type
   use scene, only: scene_type
   use scene_completion, only: leave_out, complete_scene
   use equations_of_motion, only: bearing_model, new_bearing_model
   use force_balance, only: force_derivatives
   use equilibrium, only: equilibrium_type, find_equilibrium
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)

   !> A state of rest in numbers without dimension: Sommerfeld number, eccentricity ratio, attitude angle, deg, and
   !> K c/W and C c omega/W along the load (x) and across it (y), xx xy yx yy.
   type :: rest_type
      real(wp) :: sommerfeld = 0, eccentricity = 0, attitude = 0, stiffness(4) = 0, damping(4) = 0
   end type rest_type

   if (runs('lund_thomsen')) call lund_thomsen()
   call report()

contains

   !> A bearing of fixed pads with a diameter of 100 mm and a clearance of 1 per mille at 3000 rpm that carries 5 kN
   !> downwards.
   type(scene_type) function fixed_scene(pivots, arcs, length_ratio) result(scene)
      real(wp), intent(in) :: pivots(:), arcs(:), length_ratio
      type(error_type), allocatable :: error
      scene = scene_type()
      call leave_out(scene)
      scene%pads%motion = 'fixed'
      associate (p => scene%pads, n => size(pivots))
         p%pivot_angle_deg = pivots
         p%arc_deg = arcs
         p%pivot_ratio = spread(0.5_wp, 1, n)
         p%pivot_distance = spread(p%pivot_distance(1), 1, n)
         p%mass = spread(p%mass(1), 1, n)
         p%inertia = spread(p%inertia(1), 1, n)
         p%centre_radial = spread(p%centre_radial(1), 1, n)
         p%centre_tangential = spread(p%centre_tangential(1), 1, n)
         p%density = spread(p%density(1), 1, n)
         p%thickness = spread(p%thickness(1), 1, n)
      end associate
      scene%bearing%journal_radius = 50e-3_wp
      scene%bearing%assembled_clearance = 50e-6_wp
      scene%bearing%preload = 0
      scene%bearing%axial_length = 0.1_wp*length_ratio
      scene%bearing%viscosity = 0.02_wp
      scene%operation%speed_rpm = 3000
      scene%rotor%mass = 5e3_wp/scene%rotor%gravity
      scene%rotor%unbalance = 0
      call complete_scene(scene, error)
      call expect_no_error(error, 'the scene is complete')
   end function fixed_scene

   !> The bearing of Lund and Thomsen: two pads of 160 degrees, grooves at the horizontal split.
   type(scene_type) function two_grooves(length_ratio) result(scene)
      real(wp), intent(in) :: length_ratio
      scene = fixed_scene([-90.0_wp, 90.0_wp], [160.0_wp, 160.0_wp], length_ratio)
   end function two_grooves

   !> The bearing at rest at a Sommerfeld number mu N L D/W (R/c)^2: by the viscosity.
   subroutine rest_at(scene, sommerfeld, rest, model)
      type(scene_type), intent(inout) :: scene
      real(wp), intent(in) :: sommerfeld
      type(rest_type), intent(out) :: rest
      type(bearing_model), intent(out) :: model
      type(equilibrium_type) :: found
      type(error_type), allocatable :: error
      real(wp) :: load, k(2, 2), c(2, 2)
      logical :: ok
      load = scene%rotor%mass*scene%rotor%gravity
      associate (b => scene%bearing)
         b%viscosity = sommerfeld*load*(b%assembled_clearance/b%journal_radius)**2 &
            & /(scene%operation%speed_rpm/60*b%axial_length*2*b%journal_radius)
      end associate
      model = new_bearing_model(scene)
      call find_equilibrium(model, found, error)
      call expect_no_error(error, 'an equilibrium at S = '//to_text(sommerfeld))
      if (allocated(error)) return
      rest%sommerfeld = sommerfeld
      rest%eccentricity = norm2(found%journal)/scene%bearing%assembled_clearance
      rest%attitude = atan2(-found%journal(2), -found%journal(1))/degree
      call model%evaluate(0.0_wp, model%at_rest(found%journal, found%tilt, found%penetration), .true., ok)
      call expect(ok, 'derivatives at S = '//to_text(sommerfeld))
      call force_derivatives(model, k, c)
      ! along the load is -y, across it, in the sense of the rotation, -z: both turn the signs of no coefficient
      associate (scale => scene%bearing%assembled_clearance/load)
         rest%stiffness = -scale*[k(1, 1), k(1, 2), k(2, 1), k(2, 2)]
         rest%damping = -scale*scene%operation%speed_rpm*rpm*[c(1, 1), c(1, 2), c(2, 1), c(2, 2)]
      end associate
   end subroutine rest_at

   !> Lund and Thomsen (1978), two pads of 160 degrees with a load between the grooves, as Nicholas, Barrett and Leader
   !> (1980) use them. Their numbers come from a grid of finite differences and are rounded; this program's own grid
   !> errs by 1 % of a coefficient at most. So 3 % of each number, and half a unit of its last digit.
   subroutine lund_thomsen()
      call compare_with(0.5_wp, rest_type(1.656_wp, 0.244_wp, 65.85_wp, [1.69_wp, 5.06_wp, -2.20_wp, 1.95_wp], &
         & [9.93_wp, 2.15_wp, 2.15_wp, 4.80_wp]))
      call compare_with(0.5_wp, rest_type(0.244_wp, 0.655_wp, 40.25_wp, [4.21_wp, 3.74_wp, -0.13_wp, 1.64_wp], &
         & [6.87_wp, 1.82_wp, 1.82_wp, 1.54_wp]))
      call compare_with(1.0_wp, rest_type(0.235_wp, 0.460_wp, 49.27_wp, [2.19_wp, 3.57_wp, -0.80_wp, 1.55_wp], &
         & [7.36_wp, 1.89_wp, 1.89_wp, 2.19_wp]))
   end subroutine lund_thomsen

   subroutine compare_with(length_ratio, table)
      real(wp), intent(in) :: length_ratio
      type(rest_type), intent(in) :: table
      type(scene_type) :: scene
      type(rest_type) :: rest
      type(bearing_model) :: model
      integer :: k
      character(len=:), allocatable :: what
      scene = two_grooves(length_ratio)
      call rest_at(scene, table%sommerfeld, rest, model)
      what = ', L/D '//to_text(length_ratio)//', S = '//to_text(table%sommerfeld)
      call expect_close(rest%eccentricity, table%eccentricity, 3e-3_wp*table%eccentricity + 5e-4_wp, &
         & 'eccentricity'//what)
      call expect_close(rest%attitude, table%attitude, 3e-3_wp*table%attitude, 'attitude angle'//what)
      do k = 1, 4
         call expect_close(rest%stiffness(k), table%stiffness(k), 0.03_wp*abs(table%stiffness(k)) + 0.01_wp, &
            & 'stiffness '//to_text(k)//what)
         call expect_close(rest%damping(k), table%damping(k), 0.03_wp*abs(table%damping(k)) + 0.005_wp, &
            & 'damping '//to_text(k)//what)
      end do
      call expect_close(rest%damping(2), rest%damping(3), 1e-3_wp*rest%damping(1), 'damping is symmetric'//what)
   end subroutine compare_with
end program test_fixed_pads
