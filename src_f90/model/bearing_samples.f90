!> What is sampled of bearings and other elements in a motion.
module bearing_samples
   use kinds, only: wp
   use case_groups, only: mount_type
   use case_inputs, only: case_type
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, of_journal
   use tilting_pad, only: pad_coordinates_type
   use tilting_pad_bearing, only: pad_sample, sloped_sample
   use sloped_bearing, only: moment_on_journal
   use equations_of_motion, only: machine_model
   implicit none (type, external)
   private
   public :: bearing_sample, take_sample, element_forces, element_positions, eccentricities

   !> What is sampled of a bearing at a time, s: shaft angle, rad; speed, rad/s; journal; states and loads of the pads.
   type :: bearing_sample
      real(wp) :: time = 0, shaft_angle = 0, speed = 0
      !> What the pads do; whether they have bristle deflections, and whether their asperities may touch.
      class(pad_coordinates_type), allocatable :: coordinates
      logical :: bristles = .false., asperities = .false.
      type(journal_motion) :: journal
      type(pad_state), allocatable :: states(:)
      type(pad_sample), allocatable :: loads(:)
      !> Where slopes count, else not allocated; moments on the journal against its slopes along y and z, N m.
      type(sloped_sample), allocatable :: slopes(:)
      real(wp) :: moment(2) = 0
      !> Whether slopes of an elastic shaft count in its films.
      logical :: inclined = .false.
   end type bearing_sample

contains

   !> What is sampled of bearing b at (t, y), where these outputs are known; no film is evaluated. The record may be
   !> used again.
   pure subroutine take_sample(model, t, y, output, b, sample)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: t, y(:), output(:)
      integer, intent(in) :: b
      type(bearing_sample), intent(inout) :: sample
      associate (of => model%layout%elements(b), bearing => model%bearings(b))
         if (.not. allocated(sample%coordinates)) sample%coordinates = bearing%coordinates
         sample%bristles = of%bristles
         sample%asperities = bearing%asperities%act()
         sample%inclined = of%of_rotor > of_journal
         sample%time = t
         sample%shaft_angle = model%point%shaft_angle(t)
         sample%speed = model%point%speed(t)
         sample%journal = model%rotor%journal(y(:model%rotor%states), b)
         if (.not. allocated(sample%states)) then
            allocate (sample%states(of%pads), sample%loads(of%pads))
            if (allocated(bearing%sloped)) allocate (sample%slopes(of%pads))
         end if
         call of%take_pads(y, sample%states)
         call bearing%take_samples(sample%journal, sample%states, sample%speed, &
            & output(model%pad_outputs*(of%first_pad - 1) + 1:model%pad_outputs*of%last_pad), sample%loads, &
            & sample%slopes)
         if (allocated(sample%slopes)) sample%moment = moment_on_journal(bearing, sample%journal, sample%states, &
            & sample%slopes)
      end associate
   end subroutine take_sample

   !> Forces on the rotor, (2, element), N, of what acts on it beside its bearings, its own elements first, at (t, y).
   pure function element_forces(model, t, y) result(forces)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: t, y(:)
      real(wp) :: forces(of_journal, model%rotor%elements + size(model%others))
      integer :: e
      forces(:, :model%rotor%elements) = model%rotor%element_forces(y, model%point, t)
      do e = 1, size(model%others)
         associate (of => model%layout%elements(size(model%bearings) + e))
            forces(:, model%rotor%elements + e) = model%others(e)%of%sampled_force(model%rotor%journal( &
               & y(:model%rotor%states), of%pair()), of%pad_states(y), model%point%speed(t))
         end associate
      end do
   end function element_forces

   !> How far the station of each of these is displaced from its other end, (2, element), m; of a damper where its ring
   !> is in the clearance.
   pure function element_positions(model, y) result(positions)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      real(wp) :: positions(of_journal, model%rotor%elements + size(model%others))
      integer :: e
      positions(:, :model%rotor%elements) = model%rotor%element_positions(y)
      do e = 1, size(model%others)
         associate (of => model%layout%elements(size(model%bearings) + e))
            positions(:, model%rotor%elements + e) = model%others(e)%of%sampled_position(model%rotor%journal( &
               & y(:model%rotor%states), of%pair()))
         end associate
      end do
   end function element_positions

   !> Over the clearances of the dampers, where their rings are, (2, damper), m.
   pure function eccentricities(inputs, positions) result(ratios)
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: positions(:, :)
      real(wp) :: ratios(size(positions, 2))
      integer :: i
      type(mount_type), allocatable :: mounts(:)
      mounts = inputs%mounts()
      associate (dampers => inputs%dampers())
         ratios = [(norm2(positions(:, i))/mounts(dampers(i))%damper%clearance, i=1, size(dampers))]
      end associate
   end function eccentricities
end module bearing_samples
