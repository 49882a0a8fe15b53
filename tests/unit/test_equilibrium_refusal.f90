!> Each cause of a refusal is named, with what may help.
program test_equilibrium_refusal
   use kinds, only: wp
   use errors, only: error_type, numerics_error
   use case_inputs, only: case_type
   use equations_of_motion, only: new_bearing_model
   use equilibrium, only: equilibrium_type, find_equilibrium
   use equilibrium_refusal, only: search_traces, refusal
   use input_cases, only: case_of
   use check, only: runs, expect, expect_error, report
   implicit none (type, external)
   character(len=*), parameter :: upwards = ' &rotor static_load = 6e4, 0 /'

   if (runs('searched')) then
      call searched(upwards, 'points to 90 deg, where no pad is')
      call searched('&pads pivot_angle_deg = -90 /', 'one pad: the journal rolls off')
      call searched('&pads pivot_angle_deg = 90 /', 'past the only pad')
   end if
   if (runs('fixed_pads')) then
      call searched('&pads pivot_angle_deg = -90, motion = ''fixed'' /'//upwards, 'past the only pad')
      call searched('&pads motion = ''fixed'' /'//upwards, 'points to 90 deg, where no pad is')
   end if
   if (runs('from_traces')) call from_traces()
   call report()

contains

   !> The search in this case must end with these words.
   subroutine searched(case, words)
      character(len=*), intent(in) :: case, words
      type(equilibrium_type) :: found
      type(error_type), allocatable :: error
      call find_equilibrium(new_bearing_model(case_of(case)), found, error)
      call expect_error(error, numerics_error, words, 'refused: '//case)
   end subroutine searched

   !> What the searches left decides where the load does not; the load decides first.
   subroutine from_traces()
      type(search_traces) :: traces
      type(case_type) :: inputs
      inputs = case_of('&pads pivot_angle_deg = -54, 18, 90, 162, 234 /')
      call says(case_of('&rotor gravity = 0 /'), traces, 'without load 2 pads push the journal away')
      traces%last_words = 'after 400 iterations'
      call says(inputs, traces, 'the search did not end')
      call says(inputs, traces, '(after 400 iterations)')
      traces%divergence = 12.5_wp
      call says(inputs, traces, 'leaves every equilibrium')
      call says(inputs, traces, 'grows by 12.5 1/s')
      traces%without_equilibrium = [.false., .true., .true., .false., .false.]
      call says(inputs, traces, 'pads 2, 3 have no equilibrium (unloaded); try start%from = ''partial''')
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
      call expect(index(refusal(new_bearing_model(inputs), traces), words) > 0, words//', not ' &
         & //refusal(new_bearing_model(inputs), traces))
   end subroutine says
end program test_equilibrium_refusal
