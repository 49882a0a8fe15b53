!> Cells of film tables: keys of places and the hash that finds their entries; the logarithmic grid: every number in one
!> interval, ends exact, finer levels within coarser ones.
program test_table_cells
   use, intrinsic :: iso_fortran_env, only: int64
   use text, only: to_text
   use cell_index, only: cell_index_type, cell_key, interval, lower_end
   use kinds, only: wp
   use cell_polynomials, only: terms, cubic_transform
   use check, only: runs, expect, between, report
   implicit none (type, external)
   integer, parameter :: finest = 8
   real(wp) :: transform(terms, terms)

   if (runs('keys_differ')) call keys_differ()
   if (runs('far_places')) call far_places()
   if (runs('it_grows')) call it_grows()
   if (runs('nothing_there')) call nothing_there()
   if (runs('clear')) call clear()
   if (runs('every_number')) call every_number()
   if (runs('ends_belong_above')) call ends_belong_above()
   if (runs('ends_are_shared')) call ends_are_shared()
   if (runs('equal_lengths')) call equal_lengths()
   transform = cubic_transform()
   call report()

contains

   !> Every place of a block around the origin has a key of its own: each is added once and found again.
   subroutine keys_differ()
      type(cell_index_type) :: index
      integer :: level, i, j, k, n, taken, lost
      n = 0
      taken = 0
      do level = 0, 3
         do i = -6, 5
            do j = -6, 5
               do k = 0, 9
                  if (index%find(cell_key(level, i, j, k/2, mod(k, 2) - 1)) > 0) taken = taken + 1
                  n = n + 1
                  call index%add(cell_key(level, i, j, k/2, mod(k, 2) - 1), n)
               end do
            end do
         end do
      end do
      n = 0
      lost = 0
      do level = 0, 3
         do i = -6, 5
            do j = -6, 5
               do k = 0, 9
                  n = n + 1
                  if (index%find(cell_key(level, i, j, k/2, mod(k, 2) - 1)) /= n) lost = lost + 1
               end do
            end do
         end do
      end do
      call expect(taken == 0, to_text(taken)//' keys are not their place''s own')
      call expect(lost == 0, to_text(lost)//' of '//to_text(n)//' entries are lost')
   end subroutine keys_differ

   !> Thicknesses from 2^-60 to 2^60 at level 6 and the last corner along T: no bit runs into another field.
   subroutine far_places()
      integer, parameter :: far = 60*2**6, last = 2**7
      integer, parameter :: places(4, 8) = reshape([6, -far, -far, 0, 6, far, far, last, 0, -far, far, last, &
         & 31, far, -far, 0, 6, -1, 0, last, 6, 0, -1, last, 6, 0, 0, last, 31, -far, -far, last], [4, 8])
      integer(int64) :: keys(8)
      integer :: i, k
      do i = 1, 8
         keys(i) = cell_key(places(1, i), places(2, i), places(3, i), places(4, i), -1)
         do k = 1, i - 1
            call expect(keys(i) /= keys(k), 'places '//to_text(k)//' and '//to_text(i)//' have keys of their own')
         end do
      end do
   end subroutine far_places

   !> As many entries as need many doublings; those of before stay, also where the numbers of entries do not rise.
   subroutine it_grows()
      integer, parameter :: many = 20000
      type(cell_index_type) :: index
      integer :: i, lost
      do i = 1, many
         call index%add(cell_key(mod(i, 7), i/100 - 100, mod(i, 100), mod(i, 3), 0), many + 1 - i)
      end do
      lost = 0
      do i = 1, many
         if (index%find(cell_key(mod(i, 7), i/100 - 100, mod(i, 100), mod(i, 3), 0)) /= many + 1 - i) lost = lost + 1
      end do
      call expect(lost == 0, to_text(lost)//' entries are lost')
   end subroutine it_grows

   !> The key 0 is a place like others.
   subroutine nothing_there()
      type(cell_index_type) :: index
      integer :: i
      call expect(index%find(cell_key(0, 0, 0, 0, 0)) == 0, 'a new index is empty')
      do i = 1, 1000
         call index%add(cell_key(1, i, 0, 0, 0), i)
      end do
      call expect(index%find(cell_key(0, 0, 0, 0, 0)) == 0, 'no entry at the origin')
      call expect(index%find(cell_key(1, 0, 500, 0, 0)) == 0, 'none along the other axis')
      call index%add(cell_key(0, 0, 0, 0, 0), 7)
      call expect(index%find(cell_key(0, 0, 0, 0, 0)) == 7, 'one at the origin')
   end subroutine nothing_there

   subroutine clear()
      type(cell_index_type) :: index
      integer :: i
      do i = 1, 1000
         call index%add(cell_key(1, i, 0, 0, 0), i)
      end do
      call index%clear()
      call expect(all([(index%find(cell_key(1, i, 0, 0, 0)), i=1, 1000)] == 0), 'a cleared index is empty')
      call index%add(cell_key(1, 17, 0, 0, 0), 3)
      call expect(index%find(cell_key(1, 17, 0, 0, 0)) == 3, 'and is filled anew')
      call expect(index%find(cell_key(1, 18, 0, 0, 0)) == 0, 'with nothing from before')
   end subroutine clear

   !> A number of any size lies between the ends of its interval, at every level.
   subroutine every_number()
      integer :: trial, level, k, outside(0:finest)
      real(wp) :: x
      outside = 0
      do trial = 1, 2000
         x = 2**between(-50.0_wp, 30.0_wp)
         do level = 0, finest
            k = interval(x, level)
            if (.not. (lower_end(k, level) <= x .and. x < lower_end(k + 1, level))) outside(level) = outside(level) + 1
         end do
      end do
      do level = 0, finest
         call expect(outside(level) == 0, to_text(outside(level))//' numbers outside, level '//to_text(level))
      end do
   end subroutine every_number

   !> An end is in the interval above it, and the number just below it in the one below.
   subroutine ends_belong_above()
      integer :: level, k, wrong
      do level = 0, finest
         wrong = 0
         do k = -3*2**level, 3*2**level
            associate (x => lower_end(k, level))
               if (interval(x, level) /= k .or. interval(nearest(x, -1.0_wp), level) /= k - 1) wrong = wrong + 1
            end associate
         end do
         call expect(wrong == 0, to_text(wrong)//' ends in a wrong interval, level '//to_text(level))
      end do
   end subroutine ends_belong_above

   !> To the last bit, so that cells that are cut meet their neighbours at the same corners.
   subroutine ends_are_shared()
      integer :: level, k, apart
      apart = 0
      do level = 0, finest - 1
         do k = -5*2**level, 5*2**level
            if (abs(lower_end(k, level) - lower_end(2*k, level + 1)) > 0) apart = apart + 1
         end do
      end do
      call expect(apart == 0, to_text(apart)//' ends differ between levels')
   end subroutine ends_are_shared

   !> An octave begins at a power of 2 and is cut evenly.
   subroutine equal_lengths()
      integer :: octave, k
      do octave = -4, 4
         do k = 0, 7
            call expect(abs(lower_end(interval(2.0_wp**octave, 3) + k, 3) - 2.0_wp**octave*(1 + k/8.0_wp)) <= 0, &
               & 'end '//to_text(k)//' of octave '//to_text(octave))
         end do
      end do
   end subroutine equal_lengths
end program test_table_cells
