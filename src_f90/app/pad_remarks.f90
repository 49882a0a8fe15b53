!> What a run prints of pads that carry no load, lift off their pivots, flutter or rub, and of a journal that whirls.
module pad_remarks
   use kinds, only: wp, i8, degree
   use text, only: to_text, fixed_text
   use scene, only: scene_type
   use pad_behaviour, only: pad_behaviour_type, behaviour_of, whirl_of
   use run_file, only: run_file_type
   implicit none (type, external)
   private
   public :: print_pad_remarks, pad_words

contains

   !> A line for each pad that does what a loaded pad does not, by the last revolutions in the file. Fixed pads can only
   !> rub; on them the journal may whirl.
   subroutine print_pad_remarks(file, scene)
      type(run_file_type), intent(inout) :: file
      type(scene_type), intent(in) :: scene
      type(pad_behaviour_type) :: found(scene%pad_count())
      real(wp), allocatable :: contact(:, :), tilt(:, :), asperity(:, :)
      integer :: revolutions, i, n
      associate (samples => scene%output%samples_per_revolution, b => scene%bearing)
         revolutions = int(min(int(scene%output%spectrum_revolutions, i8), file%samples()/samples))
         n = revolutions*samples
         if (n < 2 .or. abs(scene%operation%final_speed_rpm - scene%operation%speed_rpm) > 0) then
            revolutions = 0
            n = int(min(int(samples, i8), file%samples()))
         end if
         if (file%file%has('asperity_force')) then
            call file%last_samples('asperity_force', n, asperity)
         else
            allocate (asperity(size(found), n), source=0.0_wp)
         end if
         if (scene%tilting()) then
            call file%last_samples('contact_force', n, contact)
            call file%last_samples('pad_tilt', n, tilt)
            found = behaviour_of(contact, tilt, asperity, revolutions, &
               & b%assembled_clearance/(0.5_wp*scene%pads%arc_deg*degree*b%journal_radius))
         else
            found%rubbing = count(asperity > 0, dim=2)/real(n, wp)
            call print_whirl(file, n, revolutions, b%assembled_clearance)
         end if
      end associate
      do i = 1, size(found)
         if (pad_words(found(i)) /= '') print '(a)', '  pad '//to_text(i)//' '//pad_words(found(i))
      end do
   end subroutine print_pad_remarks

   !> "journal whirls at 0.47 of the shaft speed, ...", by so many samples over whole revolutions.
   subroutine print_whirl(file, n, revolutions, clearance)
      type(run_file_type), intent(inout) :: file
      integer, intent(in) :: n, revolutions
      real(wp), intent(in) :: clearance
      real(wp), allocatable :: y(:, :), z(:, :)
      real(wp) :: order, amplitude
      logical :: whirls
      call file%last_samples('journal_y', n, y)
      call file%last_samples('journal_z', n, z)
      call whirl_of(y(1, :), z(1, :), revolutions, clearance, order, amplitude, whirls)
      if (whirls) print '(a)', '  the journal whirls at '//fixed_text(order, 3)//' of the shaft speed, amplitude ' &
         & //fixed_text(1e6_wp*amplitude, 3)//' um'
   end subroutine print_whirl

   !> "carries no load (mean 12 N); it flutters at 0.48 of the shaft speed, ..."; empty for a pad like others.
   function pad_words(pad) result(words)
      type(pad_behaviour_type), intent(in) :: pad
      character(len=:), allocatable :: words
      words = ''
      if (pad%unloaded) call say('carries no load (mean '//fixed_text(pad%load, 1)//' N)')
      if (pad%lifted > 0) call say('is lifted off its pivot '//percent(pad%lifted))
      if (pad%flutters) call say('flutters at '//fixed_text(pad%order, 3)//' of the shaft speed, amplitude of the ' &
         & //'tilt '//fixed_text(1e3_wp*pad%amplitude, 4)//' mrad')
      if (pad%rubbing > 0) call say('rubs on the journal '//percent(pad%rubbing))
   contains
      subroutine say(what)
         character(len=*), intent(in) :: what
         if (words /= '') words = words//'; it '
         words = words//what
      end subroutine say

      function percent(share)
         real(wp), intent(in) :: share
         character(len=:), allocatable :: percent
         percent = fixed_text(100*share, 1)//' % of the time'
      end function percent
   end function pad_words
end module pad_remarks
