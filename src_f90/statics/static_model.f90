!> What is common to searches of an equilibrium: the model without unbalance and friction, its way to equilibrium from
!> nearby, and where the searches start.
module static_model
   use kinds, only: wp
   use operating_point, only: operating_point_type
   use factories, only: converged_films, quick_films
   use abstract_rotor, only: journal_motion
   use state_layout, only: pad_state, tilt, pivot_deflection
   use kinematics, only: pad_frame, frame_of, in_mirror
   use equations_of_motion, only: machine_model, new_machine_model
   use errors, only: error_type, add_context, stopped, asked_to_stop
   use pseudo_transient, only: follow_motion, newtons
   implicit none (type, external)
   private
   public :: make_static, make_quick, make_fine, solve_equilibrium, start, starts, name_bearing

   !> Unbalanced force over the reference force that leaps of cavitated films may leave.
   real(wp), parameter :: largest_leap = 1e-5_wp

   !> Positions of the journal to start from, in bearing clearances down the load.
   real(wp), parameter :: fractions(*) = [-0.6_wp, -0.3_wp, 0.0_wp, 0.3_wp, 0.6_wp, 0.9_wp]
   integer, parameter :: starts = size(fractions)

contains

   !> A copy of the model at the static operating point, its films solved closely.
   subroutine make_static(model, cavitation, static)
      type(machine_model), intent(in) :: model
      logical, intent(in) :: cavitation
      type(machine_model), intent(out) :: static
      integer :: b
      static = model
      call stand_still(static, cavitation)
      do b = 1, size(static%bearings)
         call static%bearings(b)%use_in_statics(static%inputs, b)
      end do
   end subroutine make_static

   subroutine stand_still(model, cavitation)
      type(machine_model), intent(inout) :: model
      logical, intent(in) :: cavitation
      type(operating_point_type) :: point
      point = model%point%static()
      point%cavitation = cavitation
      call model%set_point(point)
   end subroutine stand_still

   !> The same as a static model with quick films, which are nearly the case's.
   subroutine make_quick(static, quick)
      type(machine_model), intent(in) :: static
      type(machine_model), intent(out) :: quick
      quick = new_machine_model(static%inputs, quick_films, static%others)
      call stand_still(quick, static%point%cavitation)
      quick%oil%viscosity = static%oil%viscosity
   end subroutine make_quick

   !> The same with films that are converged, where the case leaves their solver to the program.
   subroutine make_fine(model, fine)
      type(machine_model), intent(in) :: model
      type(machine_model), intent(out) :: fine
      fine = new_machine_model(model%inputs, converged_films, model%others)
      call stand_still(fine, model%point%cavitation)
   end subroutine make_fine

   !> Brings a state that is near equilibrium to equilibrium by Newton's method. Volumes of cavitated films make their
   !> force leap by less than its error; where the equilibrium lies in a leap, y ends beside it.
   subroutine solve_equilibrium(model, y, residual, error, give_up, held, most, enough)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      !> Pads that are held where they are.
      logical, intent(in), optional :: held(:)
      !> Iterations at most, if they are fewer than usual.
      integer, intent(in), optional :: most
      !> Residual at which it ends, if that is larger than usual.
      real(wp), intent(in), optional :: enough
      logical :: ok
      call follow_motion(model, y, residual, error, give_up, held, newtons, most, enough)
      if (.not. allocated(error) .or. residual > largest_leap) return
      if (error%status == stopped) return
      call model%evaluate(0.0_wp, y, .false., ok)
      if (ok) deallocate (error)
   end subroutine solve_equilibrium

   !> Start k: the journal at its fraction of the clearance down the load (among fixed pads from the middle of their
   !> bores), pivots carrying a share of it, and pads that tilt tilted so that every film converges.
   function start(model, k) result(y)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: k
      real(wp) :: y(model%n)
      type(journal_motion) :: journal
      type(pad_state) :: pads(model%layout%pads)
      type(pad_frame) :: frame
      integer :: i
      associate (load => model%point%load)
         if (norm2(load) > 0) then
            journal%position = fractions(k)*model%bearings(1)%clearance*load/norm2(load)
            if (model%layout%elements(1)%has(pivot_deflection)) then
               do i = 1, size(pads)
                  pads(i)%x(pivot_deflection) = model%bearings(1)%pivots(i)%contact%law%pivot_deflection(norm2(load) &
                     & /size(pads))
               end do
            end if
         end if
         if (.not. model%layout%elements(1)%has(tilt)) journal%position = journal%position + middle_of_bores(model)
         do i = 1, size(pads)
            associate (position => model%bearings(1)%pads(i)%position)
               frame = frame_of(position, journal, pads(i))
               pads(i)%x(tilt) = (frame%along + model%inputs%bearings(1)%machined_clearance(i)/3) &
                  & /position%centre_distance
            end associate
         end do
      end associate
      y = model%state(journal, pads)
   end function start

   !> The mean of the places, m, at which the journal lies in the middle of a pad's bore, among pads without tilt.
   pure function middle_of_bores(model) result(middle)
      type(machine_model), intent(in) :: model
      real(wp) :: middle(2)
      associate (pads => model%bearings(1)%pads, &
         & out => model%inputs%bearings(1)%machined_clearance - model%inputs%bearings(1)%assembled_clearance)
         ! equal pads add nothing to the first term
         middle = -out(1)/size(pads)*[sum(pads%position%sin_angle), sum(pads%position%cos_angle)] &
            & - [dot_product(out - out(1), pads%position%sin_angle), &
            & dot_product(out - out(1), pads%position%cos_angle)]/size(pads)
         middle = in_mirror(pads(1)%position%mirrored, middle)
      end associate
   end function middle_of_bores

   !> Puts the name of the bearing in front of the message of a set error, where it has one.
   subroutine name_bearing(model, b, error)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: b
      type(error_type), allocatable, intent(inout) :: error
      call add_context(error, model%inputs%bearings(b)%label())
   end subroutine name_bearing
end module static_model
