!> Cells of film tables: keys of places and the hash that finds their entries; the logarithmic grid: every number in one
!> interval, ends exact, finer levels within coarser ones; cubics over a cell: exact to the third degree, continuous, of
!> order four.
program test_table_cells
   use, intrinsic :: iso_fortran_env, only: int64
   use text, only: to_text
   use cell_index, only: cell_index_type, cell_key
   use kinds, only: wp
   use logarithmic_grid, only: interval, lower_end
   use cubic_patch, only: simd_width, terms, corner_data, corners, cubic_transform, evaluate_cubic
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)
   integer, parameter :: finest = 8
   real(wp), parameter :: rounding = 1e-12_wp
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
   if (runs('corner_values')) call corner_values()
   if (runs('slopes')) call slopes()
   if (runs('cubics')) call cubics()
   if (runs('across_faces')) call across_faces()
   if (runs('order')) call order()
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
                  if (index%find(cell_key(level, i, j, k)) > 0) taken = taken + 1
                  n = n + 1
                  call index%add(cell_key(level, i, j, k), n)
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
                  if (index%find(cell_key(level, i, j, k)) /= n) lost = lost + 1
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
         keys(i) = cell_key(places(1, i), places(2, i), places(3, i), places(4, i))
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
         call index%add(cell_key(mod(i, 7), i/100 - 100, mod(i, 100), mod(i, 3)), many + 1 - i)
      end do
      lost = 0
      do i = 1, many
         if (index%find(cell_key(mod(i, 7), i/100 - 100, mod(i, 100), mod(i, 3))) /= many + 1 - i) lost = lost + 1
      end do
      call expect(lost == 0, to_text(lost)//' entries are lost')
   end subroutine it_grows

   !> The key 0 is a place like others.
   subroutine nothing_there()
      type(cell_index_type) :: index
      integer :: i
      call expect(index%find(cell_key(0, 0, 0, 0)) == 0, 'a new index is empty')
      do i = 1, 1000
         call index%add(cell_key(1, i, 0, 0), i)
      end do
      call expect(index%find(cell_key(0, 0, 0, 0)) == 0, 'no entry at the origin')
      call expect(index%find(cell_key(1, 0, 500, 0)) == 0, 'none along the other axis')
      call index%add(cell_key(0, 0, 0, 0), 7)
      call expect(index%find(cell_key(0, 0, 0, 0)) == 7, 'one at the origin')
   end subroutine nothing_there

   subroutine clear()
      type(cell_index_type) :: index
      integer :: i
      do i = 1, 1000
         call index%add(cell_key(1, i, 0, 0), i)
      end do
      call index%clear()
      call expect(all([(index%find(cell_key(1, i, 0, 0)), i=1, 1000)] == 0), 'a cleared index is empty')
      call index%add(cell_key(1, 17, 0, 0), 3)
      call expect(index%find(cell_key(1, 17, 0, 0)) == 3, 'and is filled anew')
      call expect(index%find(cell_key(1, 18, 0, 0)) == 0, 'with nothing from before')
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

   !> Terms of functions with these data at the corners.
   function terms_of(data) result(c)
      real(wp), intent(in) :: data(simd_width, corner_data, 0:corners - 1)
      real(wp) :: c(simd_width, terms)
      c = matmul(reshape(data, [simd_width, terms]), transpose(transform))
   end function terms_of

   pure function place(corner)
      integer, intent(in) :: corner
      real(wp) :: place(3)
      place = real(ibits(corner, [0, 1, 2], 1), wp)
   end function place

   !> Whatever values and derivatives the corners have, the functions have them there.
   subroutine corner_values()
      real(wp) :: data(simd_width, corner_data, 0:corners - 1), value(simd_width), slope(simd_width, 3), &
         & c(simd_width, terms)
      integer :: corner
      call random_number(data)
      c = terms_of(data)
      do corner = 0, corners - 1
         call evaluate_cubic(c, place(corner), .true., value, slope)
         call expect_close(norm2(value - data(:, 1, corner)), 0.0_wp, rounding, 'value at corner '//to_text(corner))
         call expect_close(norm2(slope - data(:, 2:4, corner)), 0.0_wp, rounding, 'slopes at corner '//to_text(corner))
      end do
   end subroutine corner_values

   !> Central differences of step e err by the third derivative times e^2/6, and by rounding over e.
   subroutine slopes()
      real(wp), parameter :: step = 1e-5_wp
      real(wp) :: c(simd_width, terms), value(simd_width), slope(simd_width, 3), unused(simd_width, 3), &
         & back(simd_width), shift(3), s(3)
      integer :: trial, axis
      do trial = 1, 10
         call random_number(c)
         call random_number(s)
         call evaluate_cubic(c, s, .true., value, slope)
         do axis = 1, 3
            shift = 0
            shift(axis) = step
            call evaluate_cubic(c, s + shift, .true., value, unused)
            call evaluate_cubic(c, s - shift, .true., back, unused)
            call expect_close(norm2((value - back)/(2*step) - slope(:, axis)), 0.0_wp, 1e-8_wp, 'slope '//to_text(axis))
         end do
      end do
   end subroutine slopes

   !> Every product of powers of a total degree up to three is met.
   subroutine cubics()
      real(wp) :: data(simd_width, corner_data, 0:corners - 1), value(simd_width), slope(simd_width, 3), &
         & c(simd_width, terms), s(3)
      integer :: i, j, k, corner
      do k = 0, 3
         do j = 0, 3 - k
            do i = 0, 3 - k - j
               data = 0
               do corner = 0, corners - 1
                  data(1, :, corner) = monomial([i, j, k], place(corner))
               end do
               c = terms_of(data)
               s = [between(0.0_wp, 1.0_wp), between(0.0_wp, 1.0_wp), between(0.0_wp, 1.0_wp)]
               call evaluate_cubic(c, s, .true., value, slope)
               call expect_close(norm2([value(1), slope(1, :)] - monomial([i, j, k], s)), 0.0_wp, rounding, &
                  & 'powers '//to_text(i)//' '//to_text(j)//' '//to_text(k))
            end do
         end do
      end do
   end subroutine cubics

   !> Value and derivatives of s1^i s2^j s3^k.
   pure function monomial(powers, s) result(data)
      integer, intent(in) :: powers(3)
      real(wp), intent(in) :: s(3)
      real(wp) :: data(corner_data)
      integer :: axis, other(3)
      data(1) = product(s**powers)
      do axis = 1, 3
         other = powers
         other(axis) = max(0, powers(axis) - 1)
         data(1 + axis) = powers(axis)*product(s**other)
      end do
   end function monomial

   !> On a face, values and the slopes along it follow from the corners of this face: what the other four corners have
   !> changes nothing, so that neighbours agree.
   subroutine across_faces()
      real(wp) :: data(simd_width, corner_data, 0:corners - 1), other(simd_width, corner_data, 0:corners - 1)
      real(wp), dimension(simd_width, 3) :: slope, slope_there
      real(wp) :: value(simd_width), value_there(simd_width), s(3), there(3)
      integer :: axis, corner, trial
      do axis = 1, 3
         call random_number(data)
         call random_number(other)
         ! the neighbour's lower face is the upper one of this box
         do corner = 0, corners - 1
            if (ibits(corner, axis - 1, 1) == 0) other(:, :, corner) = data(:, :, ibset(corner, axis - 1))
         end do
         do trial = 1, 5
            call random_number(s)
            there = s
            s(axis) = 1
            there(axis) = 0
            call evaluate_cubic(terms_of(data), s, .true., value, slope)
            call evaluate_cubic(terms_of(other), there, .true., value_there, slope_there)
            slope(:, axis) = slope_there(:, axis)
            call expect_close(norm2(value - value_there), 0.0_wp, rounding, 'values across axis '//to_text(axis))
            call expect_close(norm2(slope - slope_there), 0.0_wp, 10*rounding, 'slopes along the face, axis ' &
               & //to_text(axis))
         end do
      end do
   end subroutine across_faces

   !> Half the box leaves a sixteenth of the error, of slopes an eighth.
   subroutine order()
      real(wp), parameter :: rate(3) = [1.0_wp, -0.7_wp, 0.5_wp]
      real(wp) :: data(simd_width, corner_data, 0:corners - 1), value(simd_width), slope(simd_width, 3), &
         & c(simd_width, terms), s(3)
      real(wp) :: errors(2, 0:1), size, found
      integer :: halving, corner, trial
      errors = 0
      do halving = 0, 1
         size = 0.5_wp**halving
         data = 0
         do corner = 0, corners - 1
            data(1, :, corner) = exp(size*dot_product(rate, place(corner)))*[1.0_wp, size*rate]
         end do
         c = terms_of(data)
         do trial = 0, 728
            s = real([mod(trial, 9), mod(trial/9, 9), trial/81], wp)/8
            call evaluate_cubic(c, s, .true., value, slope)
            associate (exact => exp(size*dot_product(rate, s)))
               errors(1, halving) = max(errors(1, halving), abs(value(1) - exact))
               errors(2, halving) = max(errors(2, halving), norm2(slope(1, :)/size - rate*exact))
            end associate
         end do
      end do
      found = log(errors(1, 0)/errors(1, 1))/log(2.0_wp)
      call expect_close(found, 4.0_wp, 0.5_wp, 'order of the values: '//to_text(found))
      found = log(errors(2, 0)/errors(2, 1))/log(2.0_wp)
      call expect_close(found, 3.0_wp, 0.5_wp, 'order of the slopes: '//to_text(found))
   end subroutine order
end program test_table_cells
