!> What each pad does at the end of a run: whether it carries load, lifts off its pivot, flutters or rubs; and whether
!> the journal whirls.
module pad_behaviour
   ! heap: arrays as long as a run
   use kinds, only: wp, pi
   use spectra, only: one_sided_amplitude
   implicit none (type, external)
   private
   public :: pad_behaviour_type, behaviour_of, whirl_of, dominant

   type :: pad_behaviour_type
      !> Mean contact force of the pivot, N; shares of the time in which it carries nothing, and in which the film is so
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

   !> What the pads do by the samples (pad, time) of contact force, N, tilt, rad, and asperity force, N, over so many
   !> whole revolutions at one speed; 0 where there are no whole revolutions.
   function behaviour_of(contact, tilt, asperity, revolutions, edge) result(found)
      real(wp), intent(in) :: contact(:, :), tilt(:, :), asperity(:, :)
      integer, intent(in) :: revolutions
      !> Tilt that moves the pad's edge by the clearance, rad.
      real(wp), intent(in) :: edge(:)
      type(pad_behaviour_type) :: found(size(contact, 1))
      integer :: i, n
      n = size(contact, 2)
      do i = 1, size(found)
         found(i)%load = sum(contact(i, :))/n
         found(i)%lifted = count(contact(i, :) <= 0)/real(n, wp)
         found(i)%rubbing = count(asperity(i, :) > 0)/real(n, wp)
         if (revolutions < enough) cycle
         call dominant(tilt(i, :), revolutions, found(i)%order, found(i)%amplitude)
         found(i)%flutters = found(i)%amplitude > visible*edge(i) &
            & .and. abs(found(i)%order - anint(found(i)%order)) > off_whole
      end do
      found%unloaded = found%load < smallest_share*max(sum(found%load), tiny(1.0_wp))
   end function behaviour_of

   !> Order and amplitude, m, of the largest part of the journal's motion (y, z), m, over whole revolutions, along that
   !> of both directions in which it is larger; and whether it is a whirl other than that of the unbalance.
   subroutine whirl_of(y, z, revolutions, clearance, order, amplitude, whirls)
      real(wp), intent(in) :: y(:), z(:), clearance
      integer, intent(in) :: revolutions
      real(wp), intent(out) :: order, amplitude
      logical, intent(out) :: whirls
      real(wp) :: other_order, other
      order = -1
      amplitude = 0
      if (revolutions >= enough) then
         call dominant(y, revolutions, order, amplitude)
         call dominant(z, revolutions, other_order, other)
         if (other > amplitude) order = other_order
         amplitude = max(amplitude, other)
      end if
      whirls = amplitude > visible*clearance .and. abs(order - anint(order)) > off_whole
   end subroutine whirl_of

   !> Order and amplitude of the largest part of values at equal steps over whole revolutions. A Hann window and the
   !> higher neighbour tell them between the lines of the spectrum. Mean and drift do not count.
   subroutine dominant(values, revolutions, order, amplitude)
      real(wp), intent(in) :: values(:)
      integer, intent(in) :: revolutions
      real(wp), intent(out) :: order, amplitude
      real(wp) :: weighted(size(values)), lines(0:size(values)/2), ratio, beside, lost
      integer :: k, n, top, side
      n = size(values)
      order = -1
      amplitude = 0
      weighted = (values - sum(values)/n)*[(2*sin(pi*k/n)**2, k=0, n - 1)]
      lines = one_sided_amplitude(weighted)
      lines(:min(drift, size(lines)) - 1) = 0
      top = maxloc(lines(:n/2 - 1), dim=1) - 1
      if (top < 1) return
      if (.not. lines(top) > 0) return
      side = merge(1, -1, lines(top + 1) >= lines(top - 1))
      ratio = lines(top + side)/lines(top)
      beside = max(0.0_wp, (2*ratio - 1)/(ratio + 1))
      lost = 1
      if (beside > 0) lost = sin(pi*beside)/(pi*beside*(1 - beside**2))
      order = (top + side*beside)/revolutions
      amplitude = lines(top)/lost
   end subroutine dominant
end module pad_behaviour
