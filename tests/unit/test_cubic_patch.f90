!> Cubics over a box: exact to the third degree, the data at the corners, continuity between boxes, order four.
program test_cubic_patch
   use kinds, only: wp
   use text, only: to_text
   use cubic_patch, only: lanes, terms, corner_data, corners, cubic_transform, evaluate_cubic
   use check, only: runs, expect_close, between, report
   implicit none (type, external)

   real(wp), parameter :: rounding = 1e-12_wp
   real(wp) :: transform(terms, terms)

   transform = cubic_transform()
   if (runs('corner_values')) call corner_values()
   if (runs('slopes')) call slopes()
   if (runs('cubics')) call cubics()
   if (runs('across_faces')) call across_faces()
   if (runs('order')) call order()
   call report()

contains

   !> Terms of functions with these data at the corners.
   function terms_of(data) result(c)
      real(wp), intent(in) :: data(lanes, corner_data, 0:corners - 1)
      real(wp) :: c(lanes, terms)
      c = matmul(reshape(data, [lanes, terms]), transpose(transform))
   end function terms_of

   pure function place(corner)
      integer, intent(in) :: corner
      real(wp) :: place(3)
      place = real(ibits(corner, [0, 1, 2], 1), wp)
   end function place

   !> Whatever values and derivatives the corners have, the functions have them there.
   subroutine corner_values()
      real(wp) :: data(lanes, corner_data, 0:corners - 1), value(lanes), slope(lanes, 3), c(lanes, terms)
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
      real(wp) :: c(lanes, terms), value(lanes), slope(lanes, 3), unused(lanes, 3), back(lanes), shift(3), s(3)
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
      real(wp) :: data(lanes, corner_data, 0:corners - 1), value(lanes), slope(lanes, 3), c(lanes, terms), s(3)
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
      real(wp) :: data(lanes, corner_data, 0:corners - 1), other(lanes, corner_data, 0:corners - 1)
      real(wp), dimension(lanes, 3) :: slope, slope_there
      real(wp) :: value(lanes), value_there(lanes), s(3), there(3)
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
      real(wp) :: data(lanes, corner_data, 0:corners - 1), value(lanes), slope(lanes, 3), c(lanes, terms), s(3)
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
end program test_cubic_patch
