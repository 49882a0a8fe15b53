!> Why a bearing has no equilibrium to start from, and what may help: in one line.
module equilibrium_refusal
   use kinds, only: wp, degree, pi
   use text, only: to_text
   use state_layout, only: tilt
   use kinematics, only: in_mirror
   use equations_of_motion, only: machine_model
   use force_balance, only: masses, force_derivatives, find_vibrations
   implicit none (type, external)
   private
   public :: search_traces, note_divergence, refusal, listed

   !> What the searches left behind.
   type :: search_traces
      !> What the first search said at its end.
      character(len=:), allocatable :: last_words
      !> Pads that found no equilibrium where the journal and the others did.
      logical, allocatable :: without_equilibrium(:)
      !> Growth, 1/s, of the last statically unstable equilibrium, 0: none was found; pads that leave it.
      real(wp) :: divergence = 0
      logical, allocatable :: leaving(:)
      !> Pads that are held in the partial equilibrium; not allocated where there is none.
      logical, allocatable :: held(:)
      !> Whether the first search ended at a film that did not converge: no other search would help.
      logical :: films_fail = .false.
   end type search_traces

   !> A pad leaves an equilibrium if its edge moves at least by this part of what moves most.
   real(wp), parameter :: moves = 0.5_wp
   !> Cosine of the angle between load and pivot below which one pad carries a load that points past it.
   real(wp), parameter :: through_pivot = 0.999_wp
   !> What changes the load of a bearing.
   character(len=*), parameter :: of_load = 'rotor%static_load; in a machine bearing%offset and load%force'

contains

   !> The message of a refusal: the cause, what the searches found, and what may help.
   function refusal(model, traces) result(message)
      type(machine_model), intent(in) :: model
      type(search_traces), intent(in) :: traces
      character(len=:), allocatable :: message
      message = 'no equilibrium found at '//to_text(model%point%speed_rpm)//' rpm: '
      if (traces%films_fail) then
         message = message//traces%last_words
         return
      end if
      message = message//cause(model, traces)
      if (traces%divergence > 0) then
         message = message//' (an equilibrium that was found is statically unstable (divergence): a small motion '
         if (any(traces%leaving)) message = message//'of '//listed(traces%leaving)//' '
         message = message//'grows by '//to_text(traces%divergence)//' 1/s)'
      else if (allocated(traces%last_words)) then
         message = message//' ('//traces%last_words//')'
      end if
   end function refusal

   !> Notes how a statically unstable equilibrium is left, in which the derivatives of the model were taken last.
   subroutine note_divergence(model, traces)
      type(machine_model), intent(in) :: model
      type(search_traces), intent(inout) :: traces
      real(wp), dimension(model%layout%n_positions(), model%layout%n_positions()) :: stiffness, damping
      complex(wp) :: values(2*size(stiffness, 1)), shapes(size(stiffness, 1), 2*size(stiffness, 1))
      real(wp) :: edge(model%layout%pads)
      integer :: i, k
      logical :: ok
      call force_derivatives(model, stiffness, damping)
      call find_vibrations(masses(model), stiffness, damping, values, ok, shapes)
      if (.not. ok) return
      k = maxloc(values%re, dim=1, mask=abs(values%im) <= 0)
      traces%divergence = values(k)%re
      edge = 0
      do i = 1, merge(size(edge), 0, model%layout%elements(1)%has(tilt))
         associate (gap => model%bearings(1)%pads(i)%gap)
            edge(i) = abs(shapes(model%layout%elements(1)%first_position(i), k))*0.5_wp*gap%arc()*gap%pad_radius()
         end associate
      end do
      traces%leaving = edge >= moves*max(maxval(edge), norm2(abs(shapes(:2, k))))
   end subroutine note_divergence

   !> The most likely cause with what helps.
   function cause(model, traces)
      type(machine_model), intent(in) :: model
      type(search_traces), intent(in) :: traces
      character(len=:), allocatable :: cause
      integer :: pads
      pads = model%layout%pads
      if (.not. norm2(model%point%load) > 0 .and. pads <= 2) then
         cause = 'without load '//to_text(pads)//trim(merge(' pad pushes', ' pads push ', pads == 1)) &
            & //' the journal away; give it a load or pads on all sides'
      else if (.not. model%layout%elements(1)%has(tilt) .and. load_on_pads(model)) then
         cause = 'the films do not hold the journal; try another load ('//of_load//') or clearance'
      else if (pads == 1 .and. .not. load_on_pads(model)) then
         cause = 'the load points past the only pad; turn the load ('//of_load//') or the pad ' &
            & //'(pads%pivot_angle_deg)'
      else if (pads == 1) then
         cause = 'one pad: the journal rolls off it; add a second pad (pads%pivot_angle_deg) or fix ' &
            & //'it (pads%motion = ''fixed'')'
      else if (.not. load_on_pads(model)) then
         cause = 'the load points to '//to_text(load_angle(model))//' deg, where no pad is; turn the load ' &
            & //'('//of_load//') or add a pad there (pads%pivot_angle_deg)'
      else if (allocated(traces%without_equilibrium)) then
         cause = listed(traces%without_equilibrium) &
            & //trim(merge(' has ', ' have', count(traces%without_equilibrium) == 1)) &
            & //' no equilibrium (unloaded)'//help(model, traces)
      else if (pads == 2) then
         cause = 'two pads that push the journal away; try another angle between them (pads%pivot_angle_deg) ' &
            & //'or another pads%pivot_ratio'
      else if (traces%divergence > 0) then
         cause = 'the motion leaves every equilibrium that was found'//help(model, traces)
      else if (any_held(traces)) then
         cause = listed(traces%held)//' (unloaded) did not come to equilibrium'//help(model, traces)
      else
         cause = 'the search did not end; try another load or clearance'
         if (model%layout%elements(1)%has(tilt)) cause = cause//', or'//other_start(model, traces)
      end if
   end function cause

   !> What helps pads that no film holds.
   function help(model, traces)
      type(machine_model), intent(in) :: model
      type(search_traces), intent(in) :: traces
      character(len=:), allocatable :: help
      help = '; try more preload, or'//other_start(model, traces)
   end function help

   !> Where a march can start without an equilibrium.
   function other_start(model, traces)
      type(machine_model), intent(in) :: model
      type(search_traces), intent(in) :: traces
      character(len=:), allocatable :: other_start
      other_start = ' (but not in a machine) a march from another start ('
      if (model%inputs%about%task /= 'march') other_start = other_start//'case%task = ''march'', '
      other_start = other_start//'start%from = '''//merge('partial', 'centred', allocated(traces%held))//''')'
   end function other_start

   !> Whether pads are held in a partial equilibrium.
   pure logical function any_held(traces)
      type(search_traces), intent(in) :: traces
      any_held = .false.
      if (allocated(traces%held)) any_held = any(traces%held)
   end function any_held

   !> The angle to which the load points, deg, counted as that of a pivot.
   real(wp) function load_angle(model)
      type(machine_model), intent(in) :: model
      load_angle = anint(10*atan2(model%point%load(1), model%point%load(2))/degree)/10
   end function load_angle

   !> True where pads can carry the load: a pad that tilts carries through its pivot, so that the load must lie between
   !> pivots less than half a turn apart (or, of one pad, point through it); a fixed pad carries with all its arc.
   pure logical function load_on_pads(model)
      type(machine_model), intent(in) :: model
      real(wp), allocatable :: angles(:)
      real(wp) :: load(2), first(2), second(2), turn, part(2)
      integer :: i, k
      load_on_pads = .true.
      if (.not. norm2(model%point%load) > 0) return
      associate (pads => model%bearings(1)%pads)
         load = in_mirror(pads(1)%position%mirrored, model%point%load/norm2(model%point%load))
         angles = pads%position%angle
         if (.not. model%layout%elements(1)%has(tilt)) then
            angles = [angles - pads%gap%trailing_angle, angles + pads%gap%leading_angle]
            if (any(pads%gap%arc() >= pi)) return
         end if
      end associate
      do i = 1, size(angles)
         first = [sin(angles(i)), cos(angles(i))]
         if (dot_product(first, load) >= through_pivot) return
         do k = i + 1, size(angles)
            second = [sin(angles(k)), cos(angles(k))]
            turn = first(1)*second(2) - first(2)*second(1)
            if (.not. abs(turn) > 0) cycle
            part = [load(1)*second(2) - load(2)*second(1), first(1)*load(2) - first(2)*load(1)]/turn
            if (all(part >= 0)) return
         end do
      end do
      load_on_pads = .false.
   end function load_on_pads

   !> "pad 4" or "pads 4, 5".
   function listed(chosen)
      logical, intent(in) :: chosen(:)
      character(len=:), allocatable :: listed
      integer :: i
      listed = ''
      do i = 1, size(chosen)
         if (chosen(i)) listed = listed//', '//to_text(i)
      end do
      listed = trim(merge('pad ', 'pads', count(chosen) == 1))//' '//listed(3:)
   end function listed
end module equilibrium_refusal
