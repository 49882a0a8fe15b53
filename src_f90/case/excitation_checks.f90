!> What follows from the excitations of a case, and checks of them: what no single value can tell.
module excitation_checks
   use kinds, only: wp, rpm, pi
   use text, only: to_text
   use errors, only: error_type, require, refuse
   use case_groups, only: is_set
   use case_inputs, only: case_type
   use excitations, only: excitation_type
   implicit none (type, external)
   private
   public :: complete_excitations, check_excitations

   !> Most revolutions in the period of an orbit that an excitation leads to, and how closely a number of its periods
   !> must be that of revolutions.
   integer, parameter :: most_revolutions = 100
   real(wp), parameter :: closeness = 1e-9_wp

contains

   !> Finds the ends that are left out and needed, and makes the period of an orbit one of all excitations.
   subroutine complete_excitations(inputs, error)
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      do i = 1, size(inputs%excitations)
         associate (x => inputs%excitations(i), revolutions => inputs%periodic%revolutions)
            if (any(x%kind == ['chirp', 'ramp ']) .and. .not. is_set(x%end)) x%end = inputs%operation%duration
            if (.not. inputs%seeks_orbits() .or. x%kind /= 'harmonic') cycle
            if (is_set(x%frequency_hz) .eqv. is_set(x%frequency_ratio)) cycle
            revolutions = common_multiple(revolutions, revolutions_of(x, inputs%operation%speed_rpm*rpm))
            if (revolutions < 1 .or. revolutions > most_revolutions) call refuse(name_of(i)//given_frequency(x) &
               & //': must be a fraction of the speed of the shaft whose period is at most ' &
               & //to_text(most_revolutions)//' revolutions for case%task = '''//inputs%about%task//''', with ' &
               & //'periodic%revolutions and the other excitations; its frequency over the speed is ' &
               & //to_text(ratio(x, inputs%operation%speed_rpm*rpm)), error)
         end associate
         if (allocated(error)) return
      end do
   end subroutine complete_excitations

   !> Frequency over that of the shaft, which has this speed, rad/s.
   pure real(wp) function ratio(x, speed)
      type(excitation_type), intent(in) :: x
      real(wp), intent(in) :: speed
      ratio = x%frequency_ratio
      if (is_set(x%frequency_hz)) ratio = 2*pi*x%frequency_hz/speed
   end function ratio

   !> The fewest revolutions that are a number of periods of an excitation; 0 where there are none.
   pure integer function revolutions_of(x, speed) result(revolutions)
      type(excitation_type), intent(in) :: x
      real(wp), intent(in) :: speed
      real(wp) :: periods
      do revolutions = 1, most_revolutions
         periods = revolutions*ratio(x, speed)
         if (periods > 0.5_wp .and. abs(periods - anint(periods)) <= closeness*periods) return
      end do
      revolutions = 0
   end function revolutions_of

   pure integer function common_multiple(a, b)
      integer, intent(in) :: a, b
      integer :: large, small, rest
      common_multiple = 0
      if (min(a, b) < 1) return
      large = a
      small = b
      do while (small > 0)
         rest = mod(large, small)
         large = small
         small = rest
      end do
      common_multiple = a/large*b
   end function common_multiple

   pure function name_of(i) result(name)
      integer, intent(in) :: i
      character(len=:), allocatable :: name
      name = 'excitation('//to_text(i)//')%'
   end function name_of

   !> "frequency_hz = 50"
   pure function given_frequency(x) result(text)
      type(excitation_type), intent(in) :: x
      character(len=:), allocatable :: text
      text = 'frequency_ratio = '//to_text(x%frequency_ratio)
      if (is_set(x%frequency_hz)) text = 'frequency_hz = '//to_text(x%frequency_hz)
   end function given_frequency

   !> Raises an error for the first requirement that the excitations of a case do not meet.
   subroutine check_excitations(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      if (size(inputs%excitations) == 0) return
      call require(inputs%about%task /= 'branch', 'excitation: has no effect with case%task = ''branch''; a study ' &
         & //'varies a number of the input', error)
      if (inputs%about%task == 'march' .and. inputs%integration%stop_when_periodic > 0) call refuse( &
         & 'integration%stop_when_periodic = '//to_text(inputs%integration%stop_when_periodic) &
         & //': must be 0 with excitations; the task periodic finds the orbit under them', error)
      do i = 1, size(inputs%excitations)
         call check_values(inputs%excitations(i), name_of(i), error)
         call check_times(inputs, inputs%excitations(i), name_of(i), error)
         if (allocated(error)) return
      end do
   end subroutine check_excitations

   !> What each kind needs, and what it has no use for.
   subroutine check_values(x, name, error)
      type(excitation_type), intent(in) :: x
      character(len=*), intent(in) :: name
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: with
      logical :: vibrates
      with = ' with kind = '''//x%kind//''''
      vibrates = x%kind == 'harmonic' .or. x%kind == 'chirp'
      call need(x%kind == 'table', x%file /= '', 'file = '''//x%file//'''')
      call need(x%kind /= 'table', is_set(x%amplitude), 'amplitude')
      call need(x%kind == 'chirp', is_set(x%final_frequency_hz), 'final_frequency_hz')
      if (x%kind == 'chirp') call need(.true., is_set(x%frequency_hz), 'frequency_hz')
      if (x%kind /= 'harmonic') call need(.false., is_set(x%frequency_ratio), 'frequency_ratio')
      if (.not. vibrates) call need(.false., is_set(x%frequency_hz), 'frequency_hz')
      if (.not. vibrates) call need(.false., x%rotating /= 'no', 'rotating = '''//x%rotating//'''')
      if (.not. vibrates) call need(.false., abs(x%phase_deg) > 0, 'phase_deg')
      if (x%kind == 'table') call need(.false., abs(x%direction_deg) > 0, 'direction_deg')
      if (x%kind /= 'harmonic') return
      call require(is_set(x%frequency_hz) .or. is_set(x%frequency_ratio), name//'frequency_hz: must be given, or ' &
         & //'frequency_ratio', error)
      call require(.not. (is_set(x%frequency_hz) .and. is_set(x%frequency_ratio)), name//'frequency_ratio = ' &
         & //to_text(x%frequency_ratio)//': frequency_hz is given too; give one of them', error)
   contains
      subroutine need(is_needed, is_given, variable)
         logical, intent(in) :: is_needed, is_given
         character(len=*), intent(in) :: variable
         call require(is_given .or. .not. is_needed, name//variable//': must be given'//with, error)
         call require(is_needed .or. .not. is_given, name//variable//': has no effect'//with, error)
      end subroutine need
   end subroutine check_values

   !> It acts before the run ends, and one of a periodic orbit always.
   subroutine check_times(inputs, x, name, error)
      type(case_type), intent(in) :: inputs
      type(excitation_type), intent(in) :: x
      character(len=*), intent(in) :: name
      type(error_type), allocatable, intent(inout) :: error
      if (is_set(x%end) .and. .not. x%end > x%start) call refuse(name//'end = '//to_text(x%end)//': must be above ' &
         & //name//'start = '//to_text(x%start)//' (both in s)', error)
      if (inputs%about%task == 'march' .and. .not. x%start < inputs%operation%duration) call refuse(name//'start = ' &
         & //to_text(x%start)//': must be below operation%duration = '//to_text(inputs%operation%duration) &
         & //', when the run ends (both in s)', error)
      if (.not. inputs%seeks_orbits()) return
      call require(x%kind == 'harmonic', name//'kind = '''//x%kind//''': must be ''harmonic'' for a periodic orbit', &
         & error)
      if (x%start > 0 .or. is_set(x%end)) call refuse(name//'start = '//to_text(x%start)//': must be 0 for a ' &
         & //'periodic orbit, and there is no end', error)
   end subroutine check_times
end module excitation_checks
