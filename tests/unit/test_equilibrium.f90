!> Partial equilibria: pads without equilibrium are held at zero tilt on their pivots, the rest is in balance; where
!> every pad has one, it is the equilibrium. Refusals: each cause is named, with what may help.
program test_equilibrium
   use kinds, only: wp
   use errors, only: error_type, numerics_error
   use case_inputs, only: case_type
   use state_layout, only: tilt, pivot_deflection
   use equations_of_motion, only: machine_model, new_machine_model
   use force_balance, only: forces
   use equilibrium_record, only: equilibrium_type
   use bearing_equilibrium, only: find_partial_equilibrium, search_traces, refusal
   use equilibrium, only: find_equilibrium
   use input_cases, only: case_of
   use check, only: runs, expect, expect_close, expect_no_error, expect_error, report
   implicit none (type, external)
   character(len=*), parameter :: upwards = ' &rotor static_load = 6e4, 0 /'
   character(len=*), parameter :: above = '&pads pivot_angle_deg = 90 / '
   character(len=*), parameter :: reynolds = '&film cavitation = ''reynolds'' /'

   if (runs('nothing_held')) call nothing_held()
   if (runs('pad_held')) call pad_held()
   if (runs('no_partial')) call no_partial()
   if (runs('searched')) then
      call searched(upwards, 'points to 90 deg, where no pad is')
      call searched('&pads pivot_angle_deg = -90 /', 'one pad: the journal rolls off')
      call searched('&pads pivot_angle_deg = 90 /', 'past the only pad')
   end if
   if (runs('pushed_away')) then
      ! films that only push tell at once; where they may also pull, or reach below the load, they are solved
      call searched(above//reynolds, 'past the only pad', at_once=.true.)
      call searched(above//reynolds//'&oil grade = 32 / &thermal model = ''film'' /', 'past the only pad', &
         & at_once=.true.)
      call searched(above//'&film cavitation = ''gumbel'' /', 'past the only pad', at_once=.true.)
      call searched('&pads motion = ''fixed'', pivot_angle_deg = 80, arc_deg = 60 /'//reynolds, 'past the only pad', &
         & at_once=.true.)
      call searched('&pads pivot_angle_deg = -140, arc_deg = 120 /'//reynolds, 'past the only pad', at_once=.false.)
      call searched(above//'&film cavitation = ''none'' /', 'past the only pad', at_once=.false.)
      call searched(above//reynolds//'&bearing ambient_pressure = 1e5 /', 'past the only pad', at_once=.false.)
   end if
   if (runs('fixed_pads')) then
      call searched('&pads pivot_angle_deg = -90, motion = ''fixed'' /'//upwards, 'past the only pad')
      call searched('&pads motion = ''fixed'' /'//upwards, 'points to 90 deg, where no pad is')
   end if
   if (runs('from_traces')) call from_traces()
   call report()

contains

   !> The paper's bearing: both pads are loaded. Both searches end at 1e-8 of the load, 1e-7 of the clearance or less.
   subroutine nothing_held()
      type(equilibrium_type) :: part, whole
      logical, allocatable :: held(:)
      type(error_type), allocatable :: error
      call find_partial_equilibrium(new_machine_model(case_type()), part, held, error)
      call expect_no_error(error, 'the paper''s bearing')
      if (.not. allocated(held)) return
      call expect(.not. any(held), 'no pad is held')
      call find_equilibrium(new_machine_model(case_type()), whole, error)
      call expect_close(norm2(part%rotor - whole%rotor), 0.0_wp, 1e-11_wp, 'the same place')
      call expect_close(maxval(abs(part%pads%x(tilt) - whole%pads%x(tilt))), 0.0_wp, 1e-9_wp, 'the same tilts')
   end subroutine nothing_held

   !> A third pad on top, so far from the journal that its film does not carry its weight, and heavy on one side: it
   !> would turn over. Journal and lower pads are in balance, to 1e-8 of 2e4 N, with it at zero tilt.
   subroutine pad_held()
      type(case_type) :: inputs
      type(machine_model) :: model
      type(equilibrium_type) :: found
      logical, allocatable :: held(:)
      type(error_type), allocatable :: error
      real(wp), allocatable :: force(:)
      logical :: ok
      ! its films are those of the search
      inputs = case_of('&pads pivot_angle_deg = -45, 225, 90 / &film solver = ''direct'' /')
      inputs%bearings(1)%pads%centre_tangential(3) = 60e-3_wp
      model = new_machine_model(inputs)
      call find_partial_equilibrium(model, found, held, error)
      call expect_no_error(error, 'with a pad on top')
      if (.not. allocated(held)) return
      call expect(all(held .eqv. [.false., .false., .true.]), 'the top pad is held')
      call expect_close(found%pads(3)%x(tilt), 0.0_wp, 0.0_wp, 'at zero tilt')
      call expect_close(found%pads(3)%x(pivot_deflection), 0.0_wp, 0.0_wp, 'on its pivot')
      call model%set_point(model%point%static())
      call model%evaluate(0.0_wp, model%static_state(found%rotor, found%pads), .false., ok)
      force = forces(model, 0.0_wp, model%static_state(found%rotor, found%pads))
      call expect_close(maxval(abs(force(:2))), 0.0_wp, 1e-3_wp, 'the journal is in balance')
      call expect_close(maxval(abs(force([4, 6]))), 0.0_wp, 1e-3_wp, 'so are the loaded pads along their radius')
      call expect(abs(force(7)) > 1e-3_wp, 'and the held pad is not')
   end subroutine pad_held

   !> A load that points away from both pads.
   subroutine no_partial()
      type(equilibrium_type) :: found
      logical, allocatable :: held(:)
      type(error_type), allocatable :: error
      call find_partial_equilibrium(new_machine_model(case_of('&rotor static_load = 58860, 0 /')), found, held, error)
      call expect_error(error, numerics_error, 'no partial equilibrium found', 'nothing carries the load')
   end subroutine no_partial

   !> The search in this case must end with these words.
   subroutine searched(case, words, at_once)
      character(len=*), intent(in) :: case, words
      !> Whether no search is needed to tell: true or false.
      logical, intent(in), optional :: at_once
      type(equilibrium_type) :: found
      type(error_type), allocatable :: error
      call find_equilibrium(new_machine_model(case_of(case)), found, error)
      call expect_error(error, numerics_error, words, 'refused: '//case)
      if (.not. present(at_once) .or. .not. allocated(error)) return
      call expect(at_once .neqv. index(error%message, 'iterations') > 0, 'with or without a search: '//case)
   end subroutine searched

   !> What the searches left decides where the load does not; the load decides first.
   subroutine from_traces()
      type(search_traces) :: traces
      type(case_type) :: inputs
      inputs = case_of('&pads pivot_angle_deg = -54, 18, 90, 162, 234 /')
      call says(case_of('&rotor gravity = 0 /'), traces, 'without load 2 pads push the journal away')
      traces%last_words = 'after 400 iterations'
      call says(inputs, traces, 'the search did not end')
      call says(inputs, traces, 'start%from = ''centred''')
      call says(inputs, traces, '(after 400 iterations)')
      traces%held = [.false., .true., .true., .false., .false.]
      call says(inputs, traces, 'pads 2, 3 (unloaded) did not come to equilibrium')
      call says(inputs, traces, 'start%from = ''partial''')
      traces%divergence = 12.5_wp
      traces%leaving = [.false., .true., .false., .true., .false.]
      call says(inputs, traces, 'leaves every equilibrium')
      call says(inputs, traces, 'a small motion of pads 2, 4 grows by 12.5 1/s')
      traces%leaving = .false.
      call says(inputs, traces, 'a small motion grows by 12.5 1/s')
      traces%without_equilibrium = [.false., .true., .true., .false., .false.]
      call says(inputs, traces, 'pads 2, 3 have no equilibrium (unloaded); try more preload')
      traces%without_equilibrium = [.false., .false., .true., .false., .false.]
      call says(inputs, traces, 'pad 3 has no equilibrium (unloaded)')
      traces%last_words = 'the film of pad 1 did not converge'
      traces%films_fail = .true.
      call says(inputs, traces, 'rpm: the film of pad 1 did not converge')
   end subroutine from_traces

   subroutine says(inputs, traces, words)
      type(case_type), intent(in) :: inputs
      type(search_traces), intent(in) :: traces
      character(len=*), intent(in) :: words
      call expect(index(refusal(new_machine_model(inputs), traces), words) > 0, words//', not ' &
         & //refusal(new_machine_model(inputs), traces))
   end subroutine says
end program test_equilibrium
