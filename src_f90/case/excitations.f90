!> A force over time that excites a rotor: the namelist group excitation, and the force at a time.
module excitations
   use kinds, only: wp, pi, degree
   use rising_numbers, only: number_up_to
   use case_groups, only: unset, is_set
   implicit none (type, external)
   private
   public :: excitation_type, make_excitations

   !> Kinds as numbers.
   integer, parameter :: vibration = 1, step = 2, ramp = 3, table = 4

   type :: excitation_type
      !> Of the shaft of a machine; 0 where a rigid journal is excited.
      integer :: station = 0
      !> Harmonic, chirp, step, ramp or table; a direction that turns with the phase: forward, backward, or no.
      character(len=:), allocatable :: kind, rotating
      !> N; direction from +y towards +z.
      real(wp) :: amplitude = unset, direction_deg = 0
      !> Of harmonic and chirp: frequency, or over the speed of the shaft; of a chirp that at its end; phase at the
      !> start.
      real(wp) :: frequency_hz = unset, frequency_ratio = unset, final_frequency_hz = unset, phase_deg = 0
      !> When it acts, s; it has no end where that is unset.
      real(wp) :: start = 0, end = unset
      !> CSV file of a table, and what was read from it: times after the start, s, rising, and forces along y and z, N.
      character(len=:), allocatable :: file
      real(wp), allocatable :: time(:), table(:, :)
      !> By prepare, as a march evaluates the force at each step: its kind, whether it turns with the phase, its
      !> direction, and that a quarter turn of the phase later.
      integer, private :: law = 0
      logical, private :: rotates = .false.
      real(wp), private :: along(2) = 0, across(2) = 0
   contains
      procedure :: prepare
      procedure :: evaluate
      procedure :: next_switch
      procedure :: highest_frequency
   end type excitation_type

contains

   !> Excitations of which nothing is given yet.
   pure subroutine make_excitations(number, made)
      integer, intent(in) :: number
      type(excitation_type), allocatable, intent(out) :: made(:)
      integer :: i
      allocate (made(number))
      do i = 1, number
         made(i)%kind = 'harmonic'
         made(i)%rotating = 'no'
         made(i)%file = ''
      end do
   end subroutine make_excitations

   !> Finds what its force needs and what follows from its variables.
   elemental subroutine prepare(self, sense)
      class(excitation_type), intent(inout) :: self
      !> Of the shaft: 1 clockwise, -1 anticlockwise.
      real(wp), intent(in) :: sense
      real(wp) :: towards
      ! as the numbers of the kinds are in this order
      self%law = vibration + findloc([character(len=5) :: 'step', 'ramp', 'table'] == self%kind, .true., dim=1)
      towards = self%direction_deg*degree
      self%rotates = self%rotating /= 'no'
      self%along = [cos(towards), sin(towards)]
      self%across = merge(sense, -sense, self%rotating == 'forward')*[-sin(towards), cos(towards)]
   end subroutine prepare

   !> Whether it acts at time t, s.
   pure logical function acts(self, t)
      class(excitation_type), intent(in) :: self
      real(wp), intent(in) :: t
      acts = t >= self%start
      if (is_set(self%end) .and. self%law /= ramp) acts = acts .and. t < self%end
   end function acts

   !> Its phase at time t, rad, where the shaft has turned by an angle, rad, since the start of the excitation; and the
   !> rate of the phase, rad/s, at a speed of the shaft, rad/s.
   pure subroutine phase(self, t, turned, speed, angle, rate)
      class(excitation_type), intent(in) :: self
      real(wp), intent(in) :: t, turned, speed
      real(wp), intent(out) :: angle, rate
      real(wp) :: after, slope
      after = t - self%start
      if (is_set(self%frequency_ratio)) then
         angle = self%frequency_ratio*turned
         rate = self%frequency_ratio*speed
      else
         slope = 0
         if (is_set(self%final_frequency_hz)) slope = (self%final_frequency_hz - self%frequency_hz) &
            & /(self%end - self%start)
         angle = 2*pi*(self%frequency_hz + 0.5_wp*slope*after)*after
         rate = 2*pi*(self%frequency_hz + slope*after)
      end if
      angle = angle + self%phase_deg*degree
   end subroutine phase

   !> Highest frequency of the vibration, Hz, up to a speed of the shaft, rad/s; 0 of what does not vibrate.
   elemental real(wp) function highest_frequency(self, highest_speed)
      class(excitation_type), intent(in) :: self
      real(wp), intent(in) :: highest_speed
      highest_frequency = 0
      if (is_set(self%frequency_ratio)) highest_frequency = self%frequency_ratio*highest_speed/(2*pi)
      if (is_set(self%frequency_hz)) highest_frequency = self%frequency_hz
      if (is_set(self%final_frequency_hz)) highest_frequency = max(highest_frequency, self%final_frequency_hz)
   end function highest_frequency

   !> The force along y and z of amplitude 1 at a phase, rad; its derivative over the phase is that a quarter turn
   !> later.
   pure function direction(self, angle)
      class(excitation_type), intent(in) :: self
      real(wp), intent(in) :: angle
      real(wp) :: direction(2)
      direction = cos(angle)*self%along
      if (self%rotates) direction = direction + sin(angle)*self%across
   end function direction

   !> Between which rows of its table a time after its start, s, lies: the number of the first; 0 outside.
   pure integer function interval(self, after) result(low)
      class(excitation_type), intent(in) :: self
      real(wp), intent(in) :: after
      low = number_up_to(self%time, after)
      if (low == size(self%time)) low = 0
   end function interval

   !> Force along y and z at time t, s, N, and how it changes with time, N/s, where the shaft has turned by an angle,
   !> rad, since the start of the excitation and has a speed, rad/s.
   pure subroutine evaluate(self, t, turned, speed, force, force_rate)
      class(excitation_type), intent(in) :: self
      real(wp), intent(in) :: t, turned, speed
      real(wp), intent(out) :: force(2), force_rate(2)
      real(wp) :: angle, rate
      integer :: k
      force = 0
      force_rate = 0
      if (.not. acts(self, t)) return
      select case (self%law)
      case (table)
         k = interval(self, t - self%start)
         if (k == 0) return
         force_rate = (self%table(:, k + 1) - self%table(:, k))/(self%time(k + 1) - self%time(k))
         force = self%table(:, k) + (t - self%start - self%time(k))*force_rate
      case (step)
         force = self%amplitude*self%along
      case (ramp)
         force = self%amplitude*min(1.0_wp, (t - self%start)/(self%end - self%start))*self%along
         if (t < self%end) force_rate = self%amplitude/(self%end - self%start)*self%along
      case default
         call phase(self, t, turned, speed, angle, rate)
         force = self%amplitude*direction(self, angle)
         force_rate = self%amplitude*rate*direction(self, angle + 0.5_wp*pi)
      end select
   end subroutine evaluate

   !> Makes `next` the first time after t, s, at which the force jumps or its rate does, where that is before `next`;
   !> `jumps` tells whether it is the force.
   pure subroutine next_switch(self, t, next, jumps)
      class(excitation_type), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(inout) :: next
      logical, intent(inout) :: jumps
      integer :: k
      call take_earlier(self%start, self%law < ramp, t, next, jumps)
      if (is_set(self%end)) call take_earlier(self%end, self%law /= ramp, t, next, jumps)
      if (self%law /= table) return
      do k = 1, size(self%time)
         call take_earlier(self%start + self%time(k), k == 1 .or. k == size(self%time), t, next, jumps)
      end do
   end subroutine next_switch

   !> Takes a time, s, if it is after t and before `next`; of two at the same time the jump.
   pure subroutine take_earlier(time, jump, t, next, jumps)
      real(wp), intent(in) :: time, t
      logical, intent(in) :: jump
      real(wp), intent(inout) :: next
      logical, intent(inout) :: jumps
      if (time <= t .or. time > next) return
      jumps = jump .or. jumps .and. .not. time < next
      next = time
   end subroutine take_earlier
end module excitations
