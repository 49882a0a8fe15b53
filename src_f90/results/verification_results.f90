!> What the file of a run says of its films beside the same films solved closely: figures of each pad, and the same in
!> words, root attribute `verification`, which console and report tell.
module verification_results
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp
   use text, only: to_text
   use film_comparison, only: film_difference
   use record, only: record_type
   use summary_group, only: put_figure
   implicit none (type, external)
   private
   public :: put_verification, states_figure

   !> Name of the number of states among the figures.
   character(len=*), parameter :: states_figure = 'verified_states'
   character(len=*), parameter :: of_force = 'difference of the film force from the closely solved one over what ' &
      & //'the pad carries'

   !> Of a pad in all states; not a number where no film could be compared.
   type :: pad_verification
      !> Difference of the force over what the pad carries: median, largest, and where this is, s; and over the load.
      real(wp) :: median, largest, at, of_load
      !> Largest difference of the maximum pressure over the highest of all states; largest estimated error of the
      !> closely solved force over what the pad carries.
      real(wp) :: pressure, left
      !> States whose film could not be solved, and where and why the first of them.
      real(wp) :: unknown
      character(len=:), allocatable :: why
   end type pad_verification

contains

   !> Writes the differences of the films of a run in some states, (pad, state), at these times, s, or, without them, in
   !> an equilibrium; with this load on the journal, N. `lines` says the same.
   subroutine put_verification(file, time, found, load, lines)
      class(record_type), intent(inout) :: file
      real(wp), intent(in) :: time(:), load
      type(film_difference), intent(in) :: found(:, :)
      character(len=:), allocatable, intent(out) :: lines
      type(pad_verification) :: pads(size(found, 1))
      integer :: i
      do i = 1, size(pads)
         call set_figures(found(i, :), time, load, pads(i))
      end do
      call put_figure(file, states_figure, real(size(found, 2), wp), '1', 'states whose films were solved closely, too')
      call put_figure(file, 'pad_film_error', pads%median, '1', of_force//', median')
      call put_figure(file, 'pad_film_error_max', pads%largest, '1', of_force//', largest')
      if (size(time) > 0) call put_figure(file, 'pad_film_error_time', pads%at, 's', 'time of the largest film error')
      if (load > 0) call put_figure(file, 'pad_film_error_of_load', pads%of_load, '1', 'difference of the film force ' &
         & //'from the closely solved one over the load on the journal, largest')
      call put_figure(file, 'pad_film_error_pressure', pads%pressure, '1', 'difference of the maximum pressure from ' &
         & //'the closely solved one over the highest of these states, largest')
      call put_figure(file, 'pad_film_error_left', pads%left, '1', 'estimated error of the closely solved film force ' &
         & //'over what the pad carries, largest')
      call put_figure(file, 'pad_film_error_unknown', pads%unknown, '1', 'states whose film could not be compared')
      lines = 'films in '//to_text(size(found, 2))//trim(merge(' state ', ' states', size(found, 2) == 1)) &
         & //' against closely solved ones: difference of the force over what the pad carries'
      do i = 1, size(pads)
         lines = lines//achar(10)//'pad '//to_text(i)//': '//in_words(pads(i), size(found, 2), size(time) > 0, load > 0)
      end do
      call file%put_text('verification', lines)
   end subroutine put_verification

   !> The figures of a pad from its differences in all states.
   pure subroutine set_figures(found, time, load, pad)
      type(film_difference), intent(in) :: found(:)
      real(wp), intent(in) :: time(:), load
      type(pad_verification), intent(out) :: pad
      logical :: solved(size(found))
      real(wp) :: over(size(found)), none
      integer :: k
      solved = [(found(k)%refusal == '', k=1, size(found))]
      none = ieee_value(none, ieee_quiet_nan)
      pad = pad_verification(none, none, none, none, none, none, real(count(.not. solved), wp), '')
      k = findloc(solved, .false., dim=1)
      if (k > 0) pad%why = found(k)%refusal
      if (k > 0 .and. size(time) > 0) pad%why = 'at t = '//to_text(time(k))//' s '//pad%why
      if (.not. any(solved)) return
      over = 0
      where (solved) over = found%force/found%carried
      k = maxloc(over, dim=1, mask=solved)
      pad%median = median(pack(over, solved))
      pad%largest = over(k)
      if (size(time) > 0) pad%at = time(k)
      if (load > 0) pad%of_load = maxval(found%force, mask=solved)/load
      pad%pressure = maxval(found%pressure, mask=solved)/max(maxval(abs(found%highest_pressure), mask=solved), &
         & maxval(found%pressure, mask=solved), tiny(load))
      where (solved) over = found%left/found%carried
      pad%left = maxval(over, mask=solved)
   end subroutine set_figures

   !> The middle one of some values, or the mean of the two in the middle.
   pure real(wp) function median(values)
      real(wp), intent(in) :: values(:)
      real(wp) :: rest(size(values)), low
      integer :: k, least
      rest = values
      low = 0
      median = 0
      do k = 0, size(values)/2
         low = median
         least = minloc(rest, dim=1)
         median = rest(least)
         rest(least) = huge(low)
      end do
      if (mod(size(values), 2) == 0) median = 0.5_wp*(low + median)
   end function median

   !> "median 1.2e-5, largest 3.4e-5 at t = 0.1 s, of the load 2.1e-5; ..."
   function in_words(pad, states, has_time, has_load) result(words)
      type(pad_verification), intent(in) :: pad
      integer, intent(in) :: states
      logical, intent(in) :: has_time, has_load
      character(len=:), allocatable :: words
      words = ''
      if (nint(pad%unknown) < states) then
         words = short(pad%largest)
         if (states > 1) words = 'median '//short(pad%median)//', largest '//words
         if (states > 1 .and. has_time) words = words//' at t = '//to_text(pad%at)//' s'
         if (has_load) words = words//', of the load '//short(pad%of_load)
         words = words//'; of the maximum pressure '//short(pad%pressure)//'; estimated error of the closely solved ' &
            & //trim(merge('film  ', 'films ', states == 1))//' '//short(pad%left)
      end if
      if (.not. pad%unknown > 0) return
      if (words /= '') words = words//'; '
      words = words//to_text(nint(pad%unknown))//' of '//to_text(states)//' films could not be compared: '//pad%why
   end function in_words

   !> Two significant digits.
   pure function short(x) result(text)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: text
      real(wp) :: unit
      unit = 1
      if (x > 0) unit = 10.0_wp**(floor(log10(x)) - 1)
      text = to_text(unit*anint(x/unit))
   end function short
end module verification_results
