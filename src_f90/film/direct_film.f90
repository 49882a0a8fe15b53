!> Axial modes while the film is full; for what cavitation changes, for a pad at an instant, the equations of
!> over-relaxation solved by elimination.
!>
!> Where the film cavitates the force is that of the finite volumes with cavitation, plus c times (Fourier - finite
!> volumes without cavitation), with c = 1 up to a tension of the full film of a tenth of its maximum pressure,
!> and 0 where they are the same. So at the onset the force does not jump by the difference of the two
!> discretisations, a loaded pad keeps the modes' accuracy, and an empty pad is left to the finite volumes alone.
module direct_film
   use kinds, only: wp, i8
   use film_solver, only: film_motion, film_law_type, film_response, film_counters, film_ok, cavitation_gumbel, &
      & cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use fourier_film, only: fourier_film_type, new_fourier_film
   use elimination_film, only: elimination_film_type, new_elimination_film
   use following_film, only: following_film_type, new_following_film, new_following_grid
   implicit none (type, external)
   private
   public :: direct_film_type, new_direct_film, is_cavitated, share_of_modes

   !> How far below the cavitation pressure the full film may fall, over its maximum pressure, before it
   !> counts as cavitated: the force left out is of the second order in it, below the discretisation error.
   real(wp), parameter :: slight_tension = 1e-4_wp

   !> Rows of the volumes of a fine field.
   integer, parameter :: fine_rows = 24
   !> Tension over the maximum pressure up to which a pad is loaded: c = 1.
   real(wp), parameter :: loaded_tension = 0.1_wp
   !> Step of the derivatives that are taken by differences, in clearances (times the speed).
   real(wp), parameter :: difference = 1e-6_wp
   !> Difference of the two discretisations over the force from which on the derivatives of c count: on grids too
   !> coarse for the film, where Newton's iteration fails without them.
   real(wp), parameter :: coarse = 0.02_wp

   type, extends(fourier_film_type) :: direct_film_type
      private
      !> Of every pad, with the condition of Reynolds: a grid that stays the same, or film-adapted ones.
      type(elimination_film_type), allocatable :: volumes(:)
      type(following_film_type), allocatable :: following(:)
   contains
      procedure :: forget
      procedure :: solve
      procedure :: field_of_pad
      procedure :: rebuild
   end type direct_film_type

contains

   !> Both solvers for the same gaps: cells along the arc and modes of the one; cells along the arc and
   !> along half the width of the other, which only the condition of Reynolds needs. The tolerance is that of the modes
   !> (new_fourier_film). With a tolerance of volumes, too, these lie on film-adapted grids, as fine as that asks for.
   function new_direct_film(gaps, cells, modes, columns, rows, condition, tolerance, of_volumes) result(solver)
      type(pad_gap_type), intent(in) :: gaps(:)
      integer, intent(in) :: cells, modes, columns, rows, condition
      real(wp), intent(in), optional :: tolerance, of_volumes
      type(direct_film_type) :: solver
      integer :: i
      solver%fourier_film_type = new_fourier_film(gaps, cells, modes, condition == cavitation_gumbel, tolerance)
      call solver%set_gaps(gaps, condition)
      if (condition /= cavitation_reynolds) return
      if (present(of_volumes)) then
         solver%following = [(new_following_film(gaps(i), of_volumes), i=1, size(gaps))]
         return
      end if
      allocate (solver%volumes(size(gaps)))
      do i = 1, size(gaps)
         solver%volumes(i) = new_elimination_film(gaps(i), columns, rows)
      end do
   end function new_direct_film

   pure subroutine forget(self)
      class(direct_film_type), intent(inout) :: self
      integer :: i
      do i = 1, size(self%gaps)
         if (allocated(self%volumes)) call self%volumes(i)%start_from()
         if (allocated(self%following)) call self%following(i)%forget()
      end do
   end subroutine forget

   subroutine solve(self, i, motion, oil, speed, want_derivatives, response)
      class(direct_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_response), intent(inout) :: response
      real(wp) :: force(2)
      integer(i8) :: others
      logical :: is_local
      others = self%counters%fourier
      call self%fourier_film_type%solve(i, motion, oil, speed, want_derivatives, response)
      if (self%condition /= cavitation_reynolds) return
      associate (lowest => self%gaps(i)%cavitation_pressure)
         if (.not. is_cavitated(lowest, response)) return
         self%counters%volumes = self%counters%volumes + 1
         is_local = .false.
         if (allocated(self%volumes) .and. .not. share_of_modes(lowest, response) < 1) then
            call self%volumes(i)%force_of_cavitation(motion, oil, speed, self%counters, force, is_local)
         end if
         if (is_local) then
            if (want_derivatives) response%derivatives = response%derivatives &
               & + derivatives_of_cavitation(self, i, motion, oil, speed, force)
            response%force = response%force + force
            response%min_pressure = lowest
         else
            call take_volumes(self, i, motion, oil, speed, want_derivatives, response)
         end if
      end associate
      self%counters%fourier = others
   end subroutine solve

   !> Derivatives of what slight cavitation adds to a pad's force, by differences: it is solved exactly, and cheaper
   !> four times than its adjoints once. Where a neighbour is not slight any more its derivative is left out.
   function derivatives_of_cavitation(self, i, motion, oil, speed, force) result(derivatives)
      class(direct_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed, force(2)
      real(wp) :: derivatives(2, 4), step, moved_force(2)
      type(film_motion) :: moved
      integer :: k
      logical :: is_local
      derivatives = 0
      do k = 1, 4
         call move(self%gaps(i), motion, speed, k, moved, step)
         call self%volumes(i)%force_of_cavitation(moved, oil, speed, self%counters, moved_force, is_local)
         if (is_local) derivatives(:, k) = (moved_force - force)/step
      end do
   end function derivatives_of_cavitation

   !> Derivatives of c of a pad, by differences of the pressures of its modes.
   function derivatives_of_share(self, i, motion, oil, speed, c) result(derivatives)
      class(direct_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed, c
      real(wp) :: derivatives(4), step
      type(film_motion) :: moved
      type(film_response) :: fourier
      integer :: k
      derivatives = 0
      do k = 1, 4
         call move(self%gaps(i), motion, speed, k, moved, step)
         call self%fourier_film_type%evaluate_pad(i, moved, oil, speed, .false., fourier)
         if (fourier%status == film_ok) derivatives(k) = &
            & (share_of_modes(self%gaps(i)%cavitation_pressure, fourier) - c)/step
      end do
   end function derivatives_of_share

   !> A motion after a step of differences along the k-th of e_y, e_z, m, and their rates, m/s.
   pure subroutine move(gap, motion, speed, k, moved, step)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      integer, intent(in) :: k
      type(film_motion), intent(out) :: moved
      real(wp), intent(out) :: step
      moved = motion
      step = difference*gap%machined_clearance
      if (k <= 2) then
         moved%position(k) = moved%position(k) + step
      else
         step = step*max(1.0_wp, abs(speed))
         moved%velocity(k - 2) = moved%velocity(k - 2) + step
      end if
   end subroutine move

   !> Makes the response of a pad's modes that of its cavitated film by elimination.
   subroutine take_volumes(self, i, motion, oil, speed, want_derivatives, response)
      class(direct_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_response), intent(inout) :: response
      type(film_response) :: fourier, whole
      real(wp) :: c, differing(2), slopes(4)
      integer :: k
      fourier = response
      c = share_of_modes(self%gaps(i)%cavitation_pressure, fourier)
      if (allocated(self%following)) then
         call self%following(i)%evaluate(motion, oil, speed, want_derivatives, self%counters, response, whole)
      else
         call self%volumes(i)%evaluate(motion, oil, speed, .true., want_derivatives, self%counters, response)
      end if
      response%min_film_thickness = fourier%min_film_thickness
      if (response%status /= film_ok .or. .not. c > 0) return
      if (allocated(self%volumes)) call self%volumes(i)%evaluate(motion, oil, speed, .false., want_derivatives, &
         & self%counters, whole)
      differing = fourier%force - whole%force
      response%force = response%force + c*differing
      response%max_pressure = response%max_pressure + c*(fourier%max_pressure - whole%max_pressure)
      if (.not. want_derivatives) return
      response%derivatives = response%derivatives + c*(fourier%derivatives - whole%derivatives)
      if (.not. (c < 1 .and. norm2(differing) > coarse*norm2(response%force))) return
      slopes = derivatives_of_share(self, i, motion, oil, speed, c)
      do k = 1, 4
         response%derivatives(:, k) = response%derivatives(:, k) + slopes(k)*differing
      end do
   end subroutine take_volumes

   !> True where a pad whose full film has the response `fourier` cavitates at this pressure, Pa.
   pure logical function is_cavitated(cavitation_pressure, fourier)
      real(wp), intent(in) :: cavitation_pressure
      type(film_response), intent(in) :: fourier
      is_cavitated = cavitation_pressure - fourier%min_pressure > slight_tension*(fourier%max_pressure &
         & - cavitation_pressure)
   end function is_cavitated

   !> c of a pad whose full film has the response `fourier`, where it cavitates at this pressure, Pa.
   pure real(wp) function share_of_modes(cavitation_pressure, fourier) result(c)
      real(wp), intent(in) :: cavitation_pressure
      type(film_response), intent(in) :: fourier
      real(wp) :: tension, height
      tension = cavitation_pressure - fourier%min_pressure
      height = fourier%max_pressure - cavitation_pressure
      c = 0
      if (tension < height) c = min(1.0_wp, (1 - tension/height)/(1 - loaded_tension))
   end function share_of_modes

   subroutine field_of_pad(self, i, motion, oil, speed, phi, z, pressure)
      class(direct_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed, phi(:), z(:)
      real(wp), intent(out) :: pressure(:, :)
      call self%rebuild(i, .false., motion, oil, speed, phi, z, pressure)
   end subroutine field_of_pad

   !> The field of a pad. Where the film cavitates, that of a film-adapted grid, as accurate as the force from
   !> tables; or as the force: that of the finite volumes with cavitation and, outside the cavitation, c times (modes -
   !> finite volumes without cavitation).
   subroutine rebuild(self, i, follows, motion, oil, speed, phi, z, pressure)
      class(direct_film_type), intent(inout) :: self
      integer, intent(in) :: i
      logical, intent(in) :: follows
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed, phi(:), z(:)
      real(wp), intent(out) :: pressure(:, :)
      type(elimination_film_type) :: film
      type(film_counters) :: counters
      type(film_response) :: response
      real(wp), dimension(size(z), size(phi)) :: cavitated, whole
      real(wp) :: c
      ! fields are not counted
      counters = self%counters
      call self%fourier_film_type%evaluate_pad(i, motion, oil, speed, .false., response)
      call self%fourier_film_type%field_of_pad(i, motion, oil, speed, phi, z, pressure)
      self%counters = counters
      if (self%condition /= cavitation_reynolds) return
      associate (lowest => self%gaps(i)%cavitation_pressure)
         if (.not. is_cavitated(lowest, response)) then
            pressure = max(lowest, pressure)
         else if (follows .or. allocated(self%following)) then
            film = new_following_grid(self%gaps(i), motion, speed, fine_rows)
            call film%field(motion, oil, speed, .true., phi, z, pressure)
         else
            c = share_of_modes(lowest, response)
            call self%volumes(i)%field(motion, oil, speed, .true., phi, z, cavitated)
            call self%volumes(i)%field(motion, oil, speed, .false., phi, z, whole)
            where (cavitated > lowest) cavitated = max(lowest, cavitated + c*(pressure - whole))
            pressure = cavitated
         end if
      end associate
   end subroutine rebuild
end module direct_film
