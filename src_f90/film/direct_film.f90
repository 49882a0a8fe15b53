!> Axial modes while the film is full; for what cavitation changes, for a pad at an instant, the equations of
!> over-relaxation solved by elimination.
!>
!> Where the film cavitates the force is that of the finite volumes with cavitation, plus c times (Fourier - finite
!> volumes without cavitation), with c = 1 up to a tension of the full film of a tenth of its maximum pressure,
!> and 0 where they are the same. So at the onset the force does not jump by the difference of the two
!> discretisations, a loaded pad keeps the modes' accuracy, and an empty pad is left to the finite volumes alone.
module direct_film
   use kinds, only: wp
   use film_solver, only: film_solver_type, film_motion, film_oil, film_response, film_ok
   use pad_gap, only: pad_gap_type
   use fourier_film, only: fourier_film_type, new_fourier_film
   use elimination_film, only: elimination_film_type, new_elimination_film
   use film_adapted_grid, only: new_following_film
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

   type, extends(film_solver_type) :: direct_film_type
      private
      type(pad_gap_type), allocatable :: gaps(:)
      real(wp), allocatable :: cavitation_pressure(:), clearance(:)
      type(fourier_film_type) :: fourier
      type(elimination_film_type), allocatable :: volumes(:)
      !> Whether the elimination looks for cavitation: as the solver was made; in force.
      logical :: made_to_project = .true., projects = .true.
   contains
      procedure :: cavitates
      procedure :: set_cavitation
      procedure :: forget
      procedure :: evaluate
      procedure :: field
      procedure :: fine_field
   end type direct_film_type

contains

   !> Both solvers for the same gaps: cells along the arc and modes of the one; cells along the arc and
   !> along half the width of the other. With the condition of Reynolds or Guembel, or none; only the first needs
   !> the other solver. The tolerance is that of the modes (new_fourier_film).
   function new_direct_film(gaps, cells, modes, columns, rows, reynolds, gumbel, tolerance) result(solver)
      type(pad_gap_type), intent(in) :: gaps(:)
      integer, intent(in) :: cells, modes, columns, rows
      logical, intent(in) :: reynolds, gumbel
      real(wp), intent(in), optional :: tolerance
      type(direct_film_type) :: solver
      integer :: i
      solver%made_to_project = reynolds
      solver%projects = reynolds
      solver%gaps = gaps
      solver%cavitation_pressure = gaps%cavitation_pressure
      solver%clearance = gaps%machined_clearance
      solver%fourier = new_fourier_film(gaps, cells, modes, gumbel, tolerance)
      if (.not. reynolds) return
      allocate (solver%volumes(size(gaps)))
      do i = 1, size(gaps)
         solver%volumes(i) = new_elimination_film(gaps(i), columns, rows)
      end do
   end function new_direct_film

   pure logical function cavitates(self)
      class(direct_film_type), intent(in) :: self
      cavitates = self%projects .or. self%fourier%cavitates()
   end function cavitates

   pure subroutine set_cavitation(self, allowed)
      class(direct_film_type), intent(inout) :: self
      logical, intent(in) :: allowed
      self%projects = self%made_to_project .and. allowed
      call self%fourier%set_cavitation(allowed)
   end subroutine set_cavitation

   pure subroutine forget(self)
      class(direct_film_type), intent(inout) :: self
      integer :: i
      if (.not. allocated(self%volumes)) return
      do i = 1, size(self%volumes)
         call self%volumes(i)%start_from()
      end do
   end subroutine forget

   subroutine evaluate(self, motion, oil, speed, want_derivatives, response, chosen)
      class(direct_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_response), intent(inout) :: response(:)
      logical, intent(in), optional :: chosen(:)
      type(film_response) :: changed
      real(wp) :: force(2)
      integer :: i
      logical :: is_local
      call self%fourier%evaluate(motion, oil, speed, want_derivatives, response, chosen)
      do i = 1, size(motion)
         if (present(chosen)) then
            if (.not. chosen(i)) cycle
         end if
         if (response(i)%status /= film_ok) cycle
         if (.not. (self%projects .and. is_cavitated(self%cavitation_pressure(i), response(i)))) then
            self%counters%fourier = self%counters%fourier + 1
            cycle
         end if
         self%counters%volumes = self%counters%volumes + 1
         is_local = .false.
         if (.not. share_of_modes(self%cavitation_pressure(i), response(i)) < 1) then
            call self%volumes(i)%force_of_cavitation(motion(i), oil(i), speed, self%counters, force, is_local)
         end if
         if (is_local) then
            if (want_derivatives) response(i)%derivatives = response(i)%derivatives &
               & + derivatives_of_cavitation(self, i, motion(i), oil(i), speed, force)
            response(i)%force = response(i)%force + force
            response(i)%min_pressure = self%cavitation_pressure(i)
         else
            call change_of_cavitation(self, i, motion(i), oil, speed, want_derivatives, response(i), changed)
            response(i) = changed
         end if
      end do
   end subroutine evaluate

   !> Derivatives of what slight cavitation adds to a pad's force, by differences: it is solved exactly, and cheaper
   !> four times than its adjoints once. Where a neighbour is not slight any more its derivative is left out.
   function derivatives_of_cavitation(self, i, motion, oil, speed, force) result(derivatives)
      class(direct_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      type(film_oil), intent(in) :: oil
      real(wp), intent(in) :: speed, force(2)
      real(wp) :: derivatives(2, 4), step(4), moved_force(2)
      integer :: k
      logical :: is_local
      step = steps(self%clearance(i), speed)
      derivatives = 0
      do k = 1, 4
         call self%volumes(i)%force_of_cavitation(moved(motion, k, step(k)), oil, speed, &
            & self%counters, moved_force, is_local)
         if (is_local) derivatives(:, k) = (moved_force - force)/step(k)
      end do
   end function derivatives_of_cavitation

   !> Derivatives of c of a pad, by differences of the pressures of its modes.
   function derivatives_of_share(self, i, motion, oil, speed, c) result(derivatives)
      class(direct_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed, c
      real(wp) :: derivatives(4), step(4)
      type(film_motion) :: beside(size(self%gaps))
      type(film_response) :: fourier(size(self%gaps))
      integer :: k, n
      step = steps(self%clearance(i), speed)
      derivatives = 0
      do k = 1, 4
         beside = moved(motion, k, step(k))
         call self%fourier%evaluate(beside, oil, speed, .false., fourier, [(n == i, n=1, size(beside))])
         if (fourier(i)%status == film_ok) derivatives(k) = &
            & (share_of_modes(self%cavitation_pressure(i), fourier(i)) - c)/step(k)
      end do
   end function derivatives_of_share

   !> Steps of differences along e_y, e_z, m, and their rates, m/s.
   pure function steps(clearance, speed)
      real(wp), intent(in) :: clearance, speed
      real(wp) :: steps(4)
      steps = difference*clearance*[1.0_wp, 1.0_wp, max(1.0_wp, abs(speed)), max(1.0_wp, abs(speed))]
   end function steps

   !> A motion with a step along the k-th of these.
   pure type(film_motion) function moved(motion, k, step)
      type(film_motion), intent(in) :: motion
      integer, intent(in) :: k
      real(wp), intent(in) :: step
      moved = motion
      if (k <= 2) moved%position(k) = moved%position(k) + step
      if (k > 2) moved%velocity(k - 2) = moved%velocity(k - 2) + step
   end function moved

   !> A pad's cavitated film by elimination, from that of the modes.
   subroutine change_of_cavitation(self, i, motion, oil, speed, want_derivatives, fourier, cavitated)
      class(direct_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_response), intent(in) :: fourier
      type(film_response), intent(out) :: cavitated
      type(film_response) :: whole
      real(wp) :: c, differing(2), slopes(4)
      integer :: k
      c = share_of_modes(self%cavitation_pressure(i), fourier)
      call self%volumes(i)%evaluate(motion, oil(i), speed, .true., want_derivatives, self%counters, cavitated)
      if (cavitated%status /= film_ok .or. .not. c > 0) return
      call self%volumes(i)%evaluate(motion, oil(i), speed, .false., want_derivatives, self%counters, whole)
      differing = fourier%force - whole%force
      cavitated%force = cavitated%force + c*differing
      if (want_derivatives) cavitated%derivatives = cavitated%derivatives + c*(fourier%derivatives - whole%derivatives)
      if (want_derivatives .and. c < 1 .and. norm2(differing) > coarse*norm2(cavitated%force)) then
         slopes = derivatives_of_share(self, i, motion, oil, speed, c)
         do k = 1, 4
            cavitated%derivatives(:, k) = cavitated%derivatives(:, k) + slopes(k)*differing
         end do
      end if
      cavitated%max_pressure = cavitated%max_pressure + c*(fourier%max_pressure - whole%max_pressure)
   end subroutine change_of_cavitation

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

   subroutine field(self, motion, oil, speed, phi, z, pressure)
      class(direct_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed, phi(:, :), z(:)
      real(wp), intent(out) :: pressure(:, :, :)
      call rebuild(self, .false., motion, oil, speed, phi, z, pressure)
   end subroutine field

   !> The field, where it cavitates as accurate as the force from tables.
   subroutine fine_field(self, motion, oil, speed, phi, z, pressure)
      class(direct_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed, phi(:, :), z(:)
      real(wp), intent(out) :: pressure(:, :, :)
      call rebuild(self, .true., motion, oil, speed, phi, z, pressure)
   end subroutine fine_field

   !> The field. Where the film cavitates, that of film-adapted volumes; or as the force: that of the finite volumes
   !> with cavitation and, outside the cavitation, c times (modes - finite volumes without cavitation).
   subroutine rebuild(self, follows, motion, oil, speed, phi, z, pressure)
      class(direct_film_type), intent(inout) :: self
      logical, intent(in) :: follows
      type(film_motion), intent(in) :: motion(:)
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed, phi(:, :), z(:)
      real(wp), intent(out) :: pressure(:, :, :)
      type(elimination_film_type) :: film
      type(film_response) :: response(size(motion))
      real(wp), dimension(size(z), size(phi, 1)) :: cavitated, whole
      real(wp) :: c
      integer :: i
      call self%fourier%evaluate(motion, oil, speed, .false., response)
      call self%fourier%field(motion, oil, speed, phi, z, pressure)
      if (.not. self%projects) return
      do i = 1, size(motion)
         associate (lowest => self%cavitation_pressure(i))
            if (.not. is_cavitated(lowest, response(i))) then
               pressure(:, :, i) = max(lowest, pressure(:, :, i))
            else if (follows) then
               film = new_following_film(self%gaps(i), motion(i), speed, fine_rows)
               call film%field(motion(i), oil(i), speed, .true., phi(:, i), z, pressure(:, :, i))
            else
               c = share_of_modes(lowest, response(i))
               call self%volumes(i)%field(motion(i), oil(i), speed, .true., phi(:, i), z, cavitated)
               call self%volumes(i)%field(motion(i), oil(i), speed, .false., phi(:, i), z, whole)
               where (cavitated > lowest) cavitated = max(lowest, cavitated + c*(pressure(:, :, i) - whole))
               pressure(:, :, i) = cavitated
            end if
         end associate
      end do
   end subroutine rebuild
end module direct_film
