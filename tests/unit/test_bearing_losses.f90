!> Losses of all pads of a bearing in a state: each that of its own film, boundary friction apart, and no numbers where
!> there is no film.
program test_bearing_losses
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp, rpm
   use errors, only: error_type
   use case_inputs, only: case_type
   use case_namelist, only: case_from_text
   use film_solver, only: film_motion, cavitation_reynolds
   use film_losses, only: film_losses_type, film_loss, new_film_losses
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, tilt
   use kinematics, only: pad_frame, frame_of, motion_of
   use equations_of_motion, only: machine_model, new_machine_model
   use bearing_losses, only: bearing_losses_type, pad_loss, new_bearing_losses
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)

   real(wp), parameter :: speed = 6500*rpm

   if (runs('each_pad')) call each_pad()
   if (runs('any_solver')) call any_solver()
   if (runs('boundary_friction')) call boundary_friction()
   if (runs('standing_shaft')) call standing_shaft()
   if (runs('closed_film')) call closed_film()
   call report()

contains

   subroutine make(text, model, losses)
      character(len=*), intent(in) :: text
      type(machine_model), intent(out) :: model
      type(bearing_losses_type), intent(out) :: losses
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      call case_from_text(text, 'case', inputs, error)
      call expect_no_error(error, 'case')
      model = new_machine_model(inputs)
      losses = new_bearing_losses(inputs%bearings(1))
   end subroutine make

   !> Two pads that differ, in motion.
   subroutine each_pad()
      type(machine_model) :: model
      type(bearing_losses_type) :: losses
      type(film_losses_type) :: single
      type(film_loss) :: film
      type(pad_loss) :: found(2)
      type(journal_motion) :: journal
      type(pad_state) :: pads(2)
      type(film_motion) :: motion
      integer, parameter :: points = 1000
      real(wp) :: angles(points), mean
      integer :: i, k
      call make('&pads arc_deg=69.3, 60, pivot_ratio=0.5, 0.6 /', model, losses)
      journal = journal_motion([-40e-6_wp, 5e-6_wp], [1e-3_wp, -2e-3_wp])
      pads = [pad_state(-1e-4_wp, 0.1_wp, 7e-6_wp, 1e-3_wp), pad_state(8e-4_wp, -0.1_wp, 6e-6_wp, 0.0_wp)]
      call losses%find(model%bearings(1), journal, pads, model%oil, speed, found)
      do i = 1, 2
         associate (pad => model%bearings(1)%pads(i))
            motion = motion_of(pad%position, frame_of(pad%position, journal, pads(i)), journal, pads(i))
            single = new_film_losses(pad%gap, cavitation_reynolds)
            call single%find(motion, model%oil(i), speed, film)
            call expect_close(found(i)%load, norm2(film%force), 0.0_wp, 'load')
            call expect_close(found(i)%power(), film%couette + film%pressure, 1e-12_wp*film%couette, 'power')
            call expect(all(abs([found(i)%inlet - film%inlet, found(i)%outlet - film%outlet, found(i)%side &
               & - film%side]) <= 0), 'flows')
            ! what pressure adds on the journal it takes from the pad, but for the film between their radii
            call expect_close(speed*(found(i)%journal_drag + found(i)%pad_drag*pad%gap%journal_radius &
               & /pad%gap%pad_radius()), 2*film%couette, 1e-12_wp*film%couette, 'drag')
            call expect_close(speed*found(i)%journal_drag, film%couette + film%wedge, 1e-12_wp*film%couette, 'drive')
            call expect(.not. abs(found(i)%boundary) > 0, 'nothing touches')
            ! the midpoint rule errs by (step of phi)^2/24 of what h varies
            angles = [((k - 0.5_wp)/points*pad%gap%arc() - pad%gap%trailing_angle, k=1, points)]
            mean = sum(pad%gap%thickness(motion, sin(angles), cos(angles)))/points
            call expect_close(found(i)%mean_film_thickness, mean, 1e-7_wp*mean, 'mean film thickness')
            call expect_close(found(i)%reynolds_number(speed*pad%gap%journal_radius, 860.0_wp, 0.02_wp), 860*speed &
               & *pad%gap%journal_radius*mean/0.02_wp, 1e-3_wp, 'Reynolds number')
         end associate
      end do
      call expect(abs(found(1)%couette - found(2)%couette) > 1, 'the pads differ')
   end subroutine each_pad

   !> Films are those of converged films, whatever solver the motion takes.
   subroutine any_solver()
      type(machine_model) :: model
      type(bearing_losses_type) :: losses
      type(pad_loss) :: found(2, 2)
      type(pad_state) :: pads(2)
      integer :: k
      pads = pad_state(5e-4_wp, 0.0_wp, 7e-6_wp)
      do k = 1, 2
         call make('&film solver='''//merge('auto', 'sor ', k == 1)//''' /', model, losses)
         call losses%find(model%bearings(1), journal_motion([-50e-6_wp, 0.0_wp]), pads, model%oil, speed, found(:, k))
      end do
      call expect(all(abs(found(:, 1)%power() - found(:, 2)%power()) <= 0), 'the same')
   end subroutine any_solver

   !> The coefficient of friction times the force that the asperities bear times the speed of the surface; the film is
   !> that of the mean gap in the valleys, which stays open.
   subroutine boundary_friction()
      type(machine_model) :: model
      type(bearing_losses_type) :: losses
      type(pad_loss) :: found(2)
      type(journal_motion) :: journal
      type(pad_state) :: pads(2)
      type(pad_frame) :: frame
      character(len=:), allocatable :: refusal
      integer :: i
      logical :: ok
      call make('&asperity friction_coefficient=0.2 /', model, losses)
      ! down to half a micrometre short of the pads, which turn until their middles lie closest
      journal = journal_motion([-79.5e-6_wp*sqrt(2.0_wp), 0.0_wp])
      do i = 1, 2
         frame = frame_of(model%bearings(1)%pads(i)%position, journal, pads(i))
         pads(i)%x(tilt) = frame%along/model%bearings(1)%pads(i)%position%centre_distance
      end do
      call losses%find(model%bearings(1), journal, pads, model%oil, speed, found)
      refusal = ''
      call model%bearings(1)%evaluate(journal, pads, model%oil, speed, .false., refusal, ok)
      call expect(ok .and. all(model%bearings(1)%asperity%touches), 'they touch')
      call expect_close(found(1)%boundary, 0.2_wp*model%bearings(1)%asperity(1)%carried()*speed*49.9e-3_wp, &
         & 1e-3_wp*found(1)%boundary, 'boundary friction')
      call expect_close(found(1)%power(), found(1)%couette + found(1)%pressure + found(1)%boundary, &
         & 1e-12_wp*found(1)%power(), 'apart')
      call expect(found(1)%load > model%bearings(1)%asperity(1)%carried(), 'film and asperities carry')
      call make('&asperity friction_coefficient=0 /', model, losses)
      call losses%find(model%bearings(1), journal, pads, model%oil, speed, found)
      call expect(found(1)%boundary <= 0 .and. found(1)%couette > 0, 'none')
   end subroutine boundary_friction

   !> A shaft that stands has no drag; squeezing the film makes heat all the same.
   subroutine standing_shaft()
      type(machine_model) :: model
      type(bearing_losses_type) :: losses
      type(pad_loss) :: found(2)
      type(pad_state) :: pads(2)
      call make('&film cavitation=''none'' /', model, losses)
      call losses%find(model%bearings(1), journal_motion([-30e-6_wp, 0.0_wp], [-1e-2_wp, 0.0_wp]), pads, model%oil, &
         & 0.0_wp, found)
      call expect(all(found%couette <= 0 .and. abs(found%journal_drag) <= 0 .and. found%pressure > 0), 'squeeze')
      call expect(all(found%side > 0 .and. found%outlet > 0 .and. found%inlet < 0), 'it flows out everywhere')
   end subroutine standing_shaft

   subroutine closed_film()
      type(machine_model) :: model
      type(bearing_losses_type) :: losses
      type(pad_loss) :: found(2)
      type(pad_state) :: pads(2)
      call make('&asperity model=''none'' /', model, losses)
      call losses%find(model%bearings(1), journal_motion([0.0_wp, 130e-6_wp]), pads, model%oil, speed, found)
      call expect(ieee_is_nan(found(1)%power()) .and. ieee_is_nan(found(1)%inlet), 'no numbers')
      call expect(found(2)%power() > 0, 'the other pad has them')
   end subroutine closed_film
end program test_bearing_losses
