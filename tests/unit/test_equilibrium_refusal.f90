!> Each cause of a refusal is named, with what may help.
program test_equilibrium_refusal
   use kinds, only: wp
   use errors, only: error_type, numerics_error
   use scene, only: scene_type
   use equations_of_motion, only: new_bearing_model
   use equilibrium, only: equilibrium_type, find_equilibrium
   use equilibrium_refusal, only: search_traces, refusal
   use check, only: runs, expect, report
   implicit none (type, external)

   if (runs('searched')) then
      call searched(loaded(bearing([-45.0_wp, 225.0_wp]), [6e4_wp, 0.0_wp]), 'points to 90 deg, where no pad is')
      call searched(loaded(bearing([-90.0_wp]), [0.0_wp, 0.0_wp]), 'one pad: the journal rolls off')
      call searched(loaded(bearing([90.0_wp]), [0.0_wp, 0.0_wp]), 'past the only pad')
   end if
   if (runs('fixed_pads')) then
      call searched(fixed(loaded(bearing([-90.0_wp]), [6e4_wp, 0.0_wp])), 'past the only pad')
      call searched(fixed(loaded(bearing([-45.0_wp, 225.0_wp]), [6e4_wp, 0.0_wp])), 'points to 90 deg, where no pad is')
   end if
   if (runs('from_traces')) call from_traces()
   call report()

contains

   !> The paper's pads at some angles, deg.
   type(scene_type) function bearing(angles) result(scene)
      real(wp), intent(in) :: angles(:)
      integer :: i
      integer :: one(size(angles))
      one = [(1, i=1, size(angles))]
      scene = scene_type()
      scene%pads%arc_deg = scene%pads%arc_deg(one)
      scene%pads%pivot_ratio = scene%pads%pivot_ratio(one)
      scene%pads%pivot_distance = scene%pads%pivot_distance(one)
      scene%pads%mass = scene%pads%mass(one)
      scene%pads%inertia = scene%pads%inertia(one)
      scene%pads%centre_tangential = scene%pads%centre_tangential(one)
      scene%pads%centre_radial = scene%pads%centre_radial(one)
      scene%pads%pivot_angle_deg = angles
   end function bearing

   !> With an extra load along y and z, N.
   type(scene_type) function loaded(bare, load) result(scene)
      type(scene_type), intent(in) :: bare
      real(wp), intent(in) :: load(2)
      scene = bare
      scene%rotor%static_load = load
   end function loaded

   type(scene_type) function fixed(tilting)
      type(scene_type), intent(in) :: tilting
      fixed = tilting
      fixed%pads%motion = 'fixed'
   end function fixed

   type(scene_type) function weightless(bare) result(scene)
      type(scene_type), intent(in) :: bare
      scene = bare
      scene%rotor%gravity = 0
   end function weightless

   subroutine searched(scene, words)
      type(scene_type), intent(in) :: scene
      character(len=*), intent(in) :: words
      type(equilibrium_type) :: found
      type(error_type), allocatable :: error
      call find_equilibrium(new_bearing_model(scene), found, error)
      call expect(allocated(error), 'refused: '//words)
      if (.not. allocated(error)) return
      call expect(error%status == numerics_error, 'an error of the numerics: '//words)
      call expect(index(error%message, words) > 0, words//', not '//error%message)
   end subroutine searched

   !> What the searches left decides where the load does not; the load decides first.
   subroutine from_traces()
      type(search_traces) :: traces
      type(scene_type) :: scene
      scene = bearing([-54.0_wp, 18.0_wp, 90.0_wp, 162.0_wp, 234.0_wp])
      call says(weightless(bearing([-45.0_wp, 225.0_wp])), traces, 'without load 2 pads push the journal away')
      traces%last_words = 'after 400 iterations'
      call says(scene, traces, 'the search did not end')
      call says(scene, traces, '(after 400 iterations)')
      traces%divergence = 12.5_wp
      call says(scene, traces, 'leaves every rest')
      call says(scene, traces, 'grows by 12.5 1/s')
      traces%restless = [.false., .true., .true., .false., .false.]
      call says(scene, traces, 'pads 2, 3 have no rest position (unloaded); try start%from = ''partial''')
      traces%restless = [.false., .false., .true., .false., .false.]
      call says(scene, traces, 'pad 3 has no rest position (unloaded)')
      traces%last_words = 'the film of pad 1 did not converge'
      traces%films_fail = .true.
      call says(scene, traces, 'rpm: the film of pad 1 did not converge')
   end subroutine from_traces

   subroutine says(scene, traces, words)
      type(scene_type), intent(in) :: scene
      type(search_traces), intent(in) :: traces
      character(len=*), intent(in) :: words
      call expect(index(refusal(new_bearing_model(scene), traces), words) > 0, words//', not ' &
         & //refusal(new_bearing_model(scene), traces))
   end subroutine says
end program test_equilibrium_refusal
