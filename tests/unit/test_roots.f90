!> Roots on an interval, and how fast they are found.
program test_roots
   use kinds, only: wp
   use text, only: to_text
   use roots, only: root_bracket
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   if (runs('linear')) call linear()
   if (runs('curved')) call curved()
   if (runs('one_sided')) call one_sided()
   call report()

contains

   !> One evaluation finds the root of a line.
   subroutine linear()
      type(root_bracket) :: bracket
      bracket = root_bracket([1.0_wp, 4.0_wp], [2.0_wp, -4.0_wp])
      call expect_close(bracket%estimate(), 2.0_wp, 1e-15_wp, 'the root of a line')
      call expect_close(bracket%width(), 3.0_wp, 1e-15_wp, 'the width')
   end subroutine linear

   !> Plain false position would keep one end here, and need hundreds of evaluations.
   subroutine curved()
      type(root_bracket) :: bracket
      real(wp) :: x
      integer :: k
      bracket = root_bracket([0.0_wp, 3.0_wp], [-1.0_wp, 80.0_wp])
      do k = 1, 40
         x = bracket%estimate()
         if (abs(x - bracket%place(2)) < 1e-12_wp) exit
         call expect(x >= minval(bracket%place) .and. x <= maxval(bracket%place), 'the estimate lies between the ends')
         call bracket%narrow(x, x**4 - 1)
      end do
      call expect_close(bracket%estimate(), 1.0_wp, 1e-14_wp, 'the root')
      call expect(k < 20, 'evaluations: '//to_text(k))
   end subroutine curved

   !> The end that stays counts half each time that it stays, and no more once it is replaced.
   subroutine one_sided()
      type(root_bracket) :: bracket
      bracket = root_bracket([0.0_wp, 8.0_wp], [-4.0_wp, 4.0_wp])
      call bracket%narrow(4.0_wp, 4.0_wp)
      call expect(all(abs(bracket%value - [-2.0_wp, 4.0_wp]) <= 0), 'the end that stays counts half')
      call bracket%narrow(2.0_wp, -1.0_wp)
      call expect(all(abs(bracket%place - [4.0_wp, 2.0_wp]) <= 0 .and. abs(bracket%value - [4.0_wp, -1.0_wp]) <= 0), &
         & 'the last two places, with their values')
   end subroutine one_sided
end program test_roots
