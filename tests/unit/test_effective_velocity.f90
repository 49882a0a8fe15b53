!> The drive of a cavitated film: its slopes. That films with it are right is for test_film_accuracy.
program test_effective_velocity
   use kinds, only: wp, degree
   use text, only: to_text
   use pad_gap, only: pad_gap_type
   use dimensionless_pad, only: dimensionless_pad_type, new_dimensionless_pad
   use effective_velocity, only: effective_velocity_type, drive_type, new_effective_velocity
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   real(wp), parameter :: half_arc = 35*degree
   real(wp), parameter :: tolerance = 1e-4_wp
   !> Thicknesses at the edges, and T.
   real(wp), parameter :: films(3, 4) = reshape([0.8_wp, 0.4_wp, 0.15_wp, 0.5_wp, 0.9_wp, 0.4_wp, &
      & 0.3_wp, 0.3_wp, 0.7_wp, 1.5_wp, 0.2_wp, 0.3_wp], [3, 4])
   type(dimensionless_pad_type) :: pad
   integer :: i

   associate (gap => pad_gap_type(0.0_wp, 1.0_wp, 2.0_wp, half_arc, half_arc, 0.0_wp, 0.0_wp, 0.0_wp))
      pad = new_dimensionless_pad(gap)
   end associate
   do i = 1, size(films, 2)
      if (runs('slopes')) call slopes(.false., films(:2, i), films(3, i))
      if (runs('slopes')) call slopes(.true., films(:2, i), films(3, i))
      if (runs('rim')) call rim(films(:2, i), films(3, i))
   end do
   if (runs('closed')) call closed(.false.)
   if (runs('closed')) call closed(.true.)
   call report()

contains

   !> Slopes against central differences over 0.02: of cells that cavitate one by one the differences keep the noise,
   !> some of the tolerance over the step; measured over the force at onset, as in the table.
   subroutine slopes(gumbel, edges, t)
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: edges(2), t
      real(wp), parameter :: step = 0.02_wp
      type(effective_velocity_type) :: solver
      type(drive_type) :: drive, ahead, back, shorter_ahead, shorter_back
      real(wp) :: shift(3), difference(2), shorter(2)
      integer :: k
      solver = new_effective_velocity(pad, gumbel, 0.1_wp*tolerance)
      associate (w_2 => pad%tangent*(1 - 2*t))
         drive = solver%at(edges, w_2)
         do k = 1, 3
            shift = 0
            shift(k) = step*merge(minval(edges), pad%tangent, k < 3)
            ahead = solver%at(edges + shift(:2), w_2 + shift(3))
            back = solver%at(edges - shift(:2), w_2 - shift(3))
            difference = (ahead%value - back%value)/(2*shift(k))
            shorter_ahead = solver%at(edges + 0.5_wp*shift(:2), w_2 + 0.5_wp*shift(3))
            shorter_back = solver%at(edges - 0.5_wp*shift(:2), w_2 - 0.5_wp*shift(3))
            shorter = (shorter_ahead%value - shorter_back%value)/shift(k)
            ! the error of the longer difference is 4/3 of how far the two are apart, and the noise comes to it
            call expect_close(norm2(matmul(drive%weight, drive%slopes(:, k) - (4*shorter - difference)/3))*shift(k), &
               & 0.0_wp, 0.5_wp*tolerance, 'slope '//to_text(k)//merge(' gumbel  ', ' reynolds', gumbel)//' T = ' &
               & //to_text(t))
         end do
      end associate
   end subroutine slopes

   !> Slopes fall with the square of the cells like forces: extrapolated ones of 12 rows are within 4e-4 of those of 48,
   !> over the force at onset. Without the end of the film between the cells they are up to 5e-3 apart.
   subroutine rim(edges, t)
      real(wp), intent(in) :: edges(2), t
      type(effective_velocity_type) :: solver
      type(drive_type) :: drive, finer
      integer :: k
      solver = new_effective_velocity(pad, .false., 1.8e-5_wp)
      drive = solver%at(edges, pad%tangent*(1 - 2*t))
      solver = new_effective_velocity(pad, .false., 1.1e-6_wp)
      finer = solver%at(edges, pad%tangent*(1 - 2*t))
      do k = 1, 3
         call expect_close(norm2(matmul(finer%weight, drive%slopes(:, k) - finer%slopes(:, k))) &
            & *merge(edges(min(k, 2)), pad%tangent, k < 3), 0.0_wp, 5e-4_wp, 'slope '//to_text(k)//', T = '//to_text(t))
      end do
   end subroutine rim

   !> A film that closes between its edges has none.
   subroutine closed(gumbel)
      logical, intent(in) :: gumbel
      type(effective_velocity_type) :: solver
      type(drive_type) :: drive
      solver = new_effective_velocity(pad, gumbel, tolerance)
      drive = solver%at([0.1_wp, 0.1_wp], 0.0_wp)
      call expect(.not. drive%ok, 'a closed film')
   end subroutine closed
end program test_effective_velocity
