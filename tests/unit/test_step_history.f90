!> Values between steps: the polynomial of the step's order through the last points.
program test_step_history
   use kinds, only: wp
   use text, only: to_text
   use step_history, only: step_history_type, new_step_history
   use check, only: runs, expect_close, report
   implicit none (type, external)
   if (runs('polynomials')) call polynomials()
   if (runs('youngest_points')) call youngest_points()
   if (runs('few_points')) call few_points()
   call report()

contains

   !> A polynomial of the step's order comes back to rounding, on uneven steps, at both ends and between.
   subroutine polynomials()
      type(step_history_type) :: history
      real(wp), parameter :: times(8) = [0.0_wp, 0.1_wp, 0.25_wp, 0.3_wp, 0.5_wp, 0.52_wp, 0.7_wp, 1.0_wp]
      real(wp) :: t, found(2)
      integer :: order, k
      do order = 0, 5
         history = new_step_history(2)
         do k = 1, size(times)
            call history%add(times(k), [times(k)**order], [3 - 2*times(k)**order])
         end do
         do k = 0, 4
            t = 0.7_wp + 0.075_wp*k
            call history%at(t, order, found)
            call expect_close(found(1), t**order, 1e-12_wp, 'order '//to_text(order)//' at '//to_text(t))
            call expect_close(found(2), 3 - 2*t**order, 1e-12_wp, 'its second value at '//to_text(t))
         end do
      end do
   end subroutine polynomials

   !> A step of first order looks at its two ends alone: no older kink is seen.
   subroutine youngest_points()
      type(step_history_type) :: history
      real(wp) :: found(1)
      integer :: k
      history = new_step_history(1)
      do k = 0, 9
         call history%add(real(k, wp), [max(0.0_wp, k - 8.0_wp)], [real(wp) ::])
      end do
      call history%at(8.25_wp, 1, found)
      call expect_close(found(1), 0.25_wp, 1e-14_wp, 'a line between the ends of the step')
   end subroutine youngest_points

   !> At the start there are fewer points than the order asks for.
   subroutine few_points()
      type(step_history_type) :: history
      real(wp) :: found(1)
      history = new_step_history(1)
      call history%add(0.0_wp, [real(wp) ::], [2.0_wp])
      call history%at(0.0_wp, 3, found)
      call expect_close(found(1), 2.0_wp, 0.0_wp, 'one point')
      call history%add(1.0_wp, [real(wp) ::], [4.0_wp])
      call history%at(0.5_wp, 3, found)
      call expect_close(found(1), 3.0_wp, 1e-14_wp, 'two points')
   end subroutine few_points
end program test_step_history
