!> Cavitated films on film-adapted grids of finite volumes: half of their columns lie on each side of where the source
!> of pressure changes its sign, all of them are narrow where the film is thin. For what is asked for seldom and has to
!> be close: the film of a state that is linearised, losses, fields.
!>
!> A film is extrapolated from two such grids, the second twice as fine. How much its force and derivatives change from
!> the next coarser pair tells its error in the state itself: even a method of first order errs less. Where that is too
!> much, all grids are refined.
module following_film
   use kinds, only: wp
   use film_solver, only: film_motion, film_law_type, film_response, film_counters, film_ok, film_not_resolved
   use pad_gap, only: pad_gap_type
   use elimination_film, only: elimination_film_type, new_elimination_film
   use dimensionless_pad, only: dimensionless_pad_type, unit_oil, new_dimensionless_pad, mid_arc_frame_type, &
      & middle_motion, new_mid_arc_frame
   implicit none (type, external)
   private
   public :: following_film_type, new_following_film, new_following_grid, following_angles

   !> Columns of a grid for every row.
   integer, parameter :: columns_a_row = 8
   !> Where the source changes its sign beside the arc or close to an edge, the columns change there, over half the arc.
   real(wp), parameter :: farthest = 0.8_wp
   !> Rows of the finest of the three grids, at first and at most.
   integer, parameter :: usual_rows = 24, most_rows = 96

   !> One pad's film.
   type :: following_film_type
      private
      type(pad_gap_type) :: gap
      !> Error of force, derivatives over position and over velocity, each over its own norm or, where that is larger,
      !> over that of the film without cavitation.
      real(wp) :: tolerance = 0
      integer :: rows = usual_rows
   contains
      procedure :: evaluate
      procedure :: forget
   end type following_film_type

contains

   !> The films in a gap with the condition of Reynolds, to a tolerance.
   pure type(following_film_type) function new_following_film(gap, tolerance) result(self)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: tolerance
      self%gap = gap
      self%tolerance = tolerance
   end function new_following_film

   !> Starts from the coarsest grids again.
   pure subroutine forget(self)
      class(following_film_type), intent(inout) :: self
      self%rows = usual_rows
   end subroutine forget

   !> The film with cavitation and without, at a motion that leaves it open and a journal speed, rad/s. The error is
   !> looked at where derivatives are wanted; grids that have become fine stay so.
   subroutine evaluate(self, motion, oil, speed, want_derivatives, counters, cavitated, whole)
      class(following_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_counters), intent(inout) :: counters
      type(film_response), intent(out) :: cavitated, whole
      type(film_response) :: answers(0:2), wholes(2), coarser
      real(wp) :: error
      do
         call solve_grids(self, motion, oil, speed, want_derivatives, counters, answers, wholes)
         cavitated = extrapolated(answers(1), answers(2))
         whole = extrapolated(wholes(1), wholes(2))
         if (cavitated%status /= film_ok .or. .not. want_derivatives) return
         coarser = extrapolated(answers(0), answers(1))
         error = largest_change(coarser, cavitated, whole)
         if (error <= self%tolerance) return
         if (2*self%rows > most_rows) exit
         self%rows = 2*self%rows
      end do
      cavitated%status = film_not_resolved
      cavitated%residual = error
   end subroutine evaluate

   !> The film on three grids, the coarsest of which counts only for derivatives; and without cavitation on two.
   subroutine solve_grids(self, motion, oil, speed, want_derivatives, counters, answers, wholes)
      class(following_film_type), intent(in) :: self
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_counters), intent(inout) :: counters
      type(film_response), intent(out) :: answers(0:2), wholes(2)
      type(elimination_film_type) :: grids(0:2)
      integer :: first, k
      first = merge(0, 1, want_derivatives)
      do k = first, 2
         grids(k) = new_following_grid(self%gap, motion, speed, self%rows/2**(2 - k))
         grids(k)%ends_between = .true.
         if (k > 0) call grids(k)%evaluate(motion, oil, speed, .false., want_derivatives, counters, wholes(k))
         if (k > first) call grids(k)%start_from(grids(k - 1))
         call grids(k)%evaluate(motion, oil, speed, .true., want_derivatives, counters, answers(k))
      end do
   end subroutine solve_grids

   !> What two grids, the second twice as fine, tell of one that is infinitely fine.
   pure type(film_response) function extrapolated(coarse, fine) result(film)
      type(film_response), intent(in) :: coarse, fine
      film = fine
      film%status = max(coarse%status, fine%status)
      film%force = (4*fine%force - coarse%force)/3
      film%derivatives = (4*fine%derivatives - coarse%derivatives)/3
      film%max_pressure = (4*fine%max_pressure - coarse%max_pressure)/3
   end function extrapolated

   !> The largest of the relative changes of force, derivatives over position and over velocity.
   pure real(wp) function largest_change(before, after, whole)
      type(film_response), intent(in) :: before, after, whole
      associate (k => after%derivatives(:, :2), c => after%derivatives(:, 3:))
         largest_change = max(norm2(after%force - before%force)/max(norm2(after%force), norm2(whole%force)), &
            & norm2(k - before%derivatives(:, :2))/max(norm2(k), norm2(whole%derivatives(:, :2))), &
            & norm2(c - before%derivatives(:, 3:))/max(norm2(c), norm2(whole%derivatives(:, 3:))))
      end associate
   end function largest_change

   !> The film-adapted grid with this number of rows at a motion that leaves the film open and a journal speed, rad/s.
   type(elimination_film_type) function new_following_grid(gap, motion, speed, rows) result(film)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      integer, intent(in) :: rows
      associate (half => columns_a_row*rows/2)
         film = new_elimination_film(gap, 2*half, rows, following_angles(gap, motion, speed, half))
      end associate
   end function new_following_grid

   !> Angles from the pivot, rad, from the trailing to the leading edge, between twice this number of columns of such a
   !> grid.
   pure function following_angles(gap, motion, speed, half) result(angles)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      integer, intent(in) :: half
      real(wp) :: angles(0:2*half), zero, e(2)
      type(dimensionless_pad_type) :: pad
      type(mid_arc_frame_type) :: frame
      type(middle_motion) :: seen
      pad = new_dimensionless_pad(gap)
      frame = new_mid_arc_frame(gap, pad)
      seen = frame%motion(motion, unit_oil, speed)
      zero = -atan2(sign(1.0_wp, seen%w(1))*seen%w(2), abs(seen%w(1)))
      zero = min(max(zero, -farthest*pad%half_arc), farthest*pad%half_arc)
      ! not from the thickness at the edges, which does not tell the position on half a circle
      associate (d => gap%directions())
         e = motion%position/gap%machined_clearance
         e = [e(1)*d%middle(2) - e(2)*d%middle(1), dot_product(e, d%middle)]
      end associate
      angles(:half) = pad%spread_angles(e, -pad%half_arc, zero, half)
      angles(half:) = pad%spread_angles(e, zero, pad%half_arc, half)
      angles = 0.5_wp*(gap%leading_angle - gap%trailing_angle) + angles
   end function following_angles
end module following_film
