!> What each pad does at the end of a run: whether it carries load, lifts off its pivot, flutters or rubs; and whether
!> the journal whirls.
module pad_behaviour
   use kinds, only: wp, pi
   use spectra, only: one_sided_amplitude, windowed
   implicit none (type, external)
   private
   public :: pad_behaviour_type, behaviour_of, whirl_of, dominant, evenly, smallest_share

   type :: pad_behaviour_type
      !> Mean pivot load of the pivot, N; shares of the time in which it carries nothing, and in which the film is so
      !> thin that the surfaces touch.
      real(wp) :: load = 0, lifted = 0, rubbing = 0
      !> Order of the largest part of the tilt, < 0 where it is not known, and its amplitude, rad.
      real(wp) :: order = -1, amplitude = 0
      !> Whether the pad carries no load, and whether the tilt's largest part is a flutter.
      logical :: unloaded = .false., flutters = .false.
   end type pad_behaviour_type

   !> A pad is unloaded below this share of the load of all pads.
   real(wp), parameter :: smallest_share = 0.01_wp
   !> A pad flutters, and a journal whirls, if the dominant order is so far from a whole number, and the pad's edge or
   !> the journal moves so far, in clearances.
   real(wp), parameter :: off_whole = 0.03_wp, visible = 0.01_wp
   !> Revolutions that an order needs; lines of a spectrum that belong to mean and drift.
   integer, parameter :: enough = 8, drift = 3

contains

   !> What the pads do beside rubbing, by samples (pad, time) of pivot load, N, and tilt, rad, this at equal steps of
   !> the shaft angle, over this many revolutions.
   subroutine behaviour_of(found, contact, tilt, revolutions, edge)
      type(pad_behaviour_type), intent(inout) :: found(:)
      real(wp), intent(in) :: contact(:, :), tilt(:, :)
      real(wp), intent(in) :: revolutions
      !> Tilt that moves the pad's edge by the clearance, rad.
      real(wp), intent(in) :: edge(:)
      real(wp), dimension(size(found)) :: order, amplitude
      integer :: i, n
      n = size(contact, 2)
      if (revolutions >= enough) call dominant(transpose(tilt), revolutions, 0.0_wp, order, amplitude)
      do i = 1, size(found)
         found(i)%load = sum(contact(i, :))/n
         found(i)%lifted = count(contact(i, :) <= 0)/real(n, wp)
         if (revolutions < enough) cycle
         found(i)%order = order(i)
         found(i)%amplitude = amplitude(i)
         found(i)%flutters = found(i)%amplitude > visible*edge(i) &
            & .and. abs(found(i)%order - anint(found(i)%order)) > off_whole
      end do
      found%unloaded = found%load < smallest_share*max(sum(found%load), tiny(1.0_wp))
   end subroutine behaviour_of

   !> Order and amplitude, m, of the largest part of the journal's motion (y, z), m, that is no multiple of the shaft's,
   !> at equal steps of the shaft angle, along that of both directions in which it is larger; and whether it is seen.
   subroutine whirl_of(y, z, revolutions, clearance, order, amplitude, whirls)
      real(wp), intent(in) :: y(:), z(:), revolutions, clearance
      real(wp), intent(out) :: order, amplitude
      logical, intent(out) :: whirls
      real(wp), dimension(2) :: orders, amplitudes
      order = -1
      amplitude = 0
      if (revolutions >= enough) then
         call dominant(reshape([y, z], [size(y), 2]), revolutions, max(off_whole, drift/revolutions), orders, &
            & amplitudes)
         order = orders(maxloc(amplitudes, dim=1))
         amplitude = maxval(amplitudes)
      end if
      whirls = amplitude > visible*clearance
   end subroutine whirl_of

   !> Of each signal, (sample, signal), at equal steps over a number of revolutions, the order and the amplitude of its
   !> largest part. A Hann window and the higher neighbour tell them between the lines of the spectrum. Mean and drift
   !> do not count, nor do orders that are closer to a whole number than `apart`.
   subroutine dominant(signals, revolutions, apart, order, amplitude)
      real(wp), intent(in) :: signals(:, :), revolutions, apart
      real(wp), intent(out) :: order(:), amplitude(:)
      real(wp) :: lines(0:size(signals, 1)/2, size(signals, 2))
      integer :: i
      lines = one_sided_amplitude(windowed(signals))
      lines(:min(drift, size(lines, 1)) - 1, :) = 0
      do i = 1, size(signals, 2)
         call largest(lines(:, i), revolutions, apart, order(i), amplitude(i))
      end do
   end subroutine dominant

   !> The same of one signal by the lines of its spectrum, from 0.
   pure subroutine largest(lines, revolutions, apart, order, amplitude)
      real(wp), intent(in) :: lines(0:), revolutions, apart
      real(wp), intent(out) :: order, amplitude
      real(wp) :: ratio, beside, lost
      integer :: k, top, side
      order = -1
      amplitude = 0
      top = 0
      do k = 1, ubound(lines, 1) - 1
         if (lines(k) <= lines(top)) cycle
         if (abs(k/revolutions - anint(k/revolutions)) >= apart) top = k
      end do
      if (top < 1) return
      if (.not. lines(top) > 0) return
      side = merge(1, -1, lines(top + 1) >= lines(top - 1))
      ratio = lines(top + side)/lines(top)
      beside = max(0.0_wp, (2*ratio - 1)/(ratio + 1))
      lost = 1
      if (beside > 0) lost = sin(pi*beside)/(pi*beside*(1 - beside**2))
      order = (top + side*beside)/revolutions
      amplitude = lines(top)/lost
   end subroutine largest

   !> Values at equal steps of the rising angle, by the cubic through the four nearest samples.
   pure function evenly(angle, values) result(even)
      real(wp), intent(in) :: angle(:), values(:)
      real(wp) :: even(size(values)), at, weight
      integer :: i, k, other, n, first
      n = size(angle)
      even = values
      if (n < 4) return
      first = 1
      do i = 2, n - 1
         at = angle(1) + (i - 1)*(angle(n) - angle(1))/(n - 1)
         do while (first < n - 3 .and. angle(first + 2) < at)
            first = first + 1
         end do
         even(i) = 0
         do k = first, first + 3
            weight = 1
            do other = first, first + 3
               if (other /= k) weight = weight*(at - angle(other))/(angle(k) - angle(other))
            end do
            even(i) = even(i) + weight*values(k)
         end do
      end do
   end function evenly
end module pad_behaviour
