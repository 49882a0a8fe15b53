!> The operations on CVODE's vectors, called as CVODE calls them, against plain Fortran.
program test_vector_operations
   use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int, c_loc, c_ptr, c_associated
   use kinds, only: wp
   use text, only: to_text
   use sundials_context, only: index_kind, new_context, free_context, n_vector, n_vector_ops, fn_vdestroy
   use fnvector_serial_mod, only: fn_vmake_serial
   use vector_operations, only: use_own_operations, numbers
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   interface
      subroutine linear_sum(a, x, b, y, z) bind(c, name='N_VLinearSum')
         import :: c_double, n_vector
         real(c_double), value :: a, b
         type(n_vector), intent(in) :: x, y, z
      end subroutine linear_sum
      subroutine set_all(a, z) bind(c, name='N_VConst')
         import :: c_double, n_vector
         real(c_double), value :: a
         type(n_vector), intent(in) :: z
      end subroutine set_all
      subroutine multiply(a, x, z) bind(c, name='N_VScale')
         import :: c_double, n_vector
         real(c_double), value :: a
         type(n_vector), intent(in) :: x, z
      end subroutine multiply
      real(c_double) function weighted_norm(x, w) bind(c, name='N_VWrmsNorm')
         import :: c_double, n_vector
         type(n_vector), intent(in) :: x, w
      end function weighted_norm
      integer(c_int) function add_multiples(n, a, x, y, z) bind(c, name='N_VScaleAddMulti')
         import :: c_double, c_int, c_ptr, n_vector
         integer(c_int), value :: n
         real(c_double), intent(in) :: a(n)
         type(n_vector), intent(in) :: x
         type(c_ptr), intent(in) :: y(n), z(n)
      end function add_multiples
      integer(c_int) function multiply_each(n, a, x, z) bind(c, name='N_VScaleVectorArray')
         import :: c_double, c_int, c_ptr
         integer(c_int), value :: n
         real(c_double), intent(in) :: a(n)
         type(c_ptr), intent(in) :: x(n), z(n)
      end function multiply_each
      type(c_ptr) function clone(x) bind(c, name='N_VClone')
         import :: c_ptr, n_vector
         type(n_vector), intent(in) :: x
      end function clone
   end interface

   !> A vector, and the numbers that it has.
   type :: pair_type
      type(n_vector), pointer :: vector => null()
      real(wp), pointer, contiguous :: values(:) => null()
   end type pair_type

   integer :: n
   if (runs('operations')) then
      do n = 1, 37
         call operations(n)
      end do
   end if
   call report()

contains

   !> On vectors of n numbers, all cloned from one; also where the result replaces an operand.
   subroutine operations(n)
      integer, intent(in) :: n
      type(c_ptr) :: context
      type(n_vector), pointer :: first
      type(n_vector_ops), pointer :: ops, inherited
      type(pair_type) :: x, y, z
      real(wp), target :: storage(n)
      real(wp) :: a(n), b(n)
      integer :: i
      context = new_context()
      first => fn_vmake_serial(int(n, index_kind), storage, context)
      call use_own_operations(first)
      x = twin(first)
      y = twin(first)
      z = twin(first)
      call c_f_pointer(first%ops, ops)
      call c_f_pointer(x%vector%ops, inherited)
      call expect(c_associated(ops%nvlinearsum, inherited%nvlinearsum), 'clones inherit the operations')
      a = [(sin(1.3_wp*i), i=1, n)]
      b = [(2 + cos(0.7_wp*i), i=1, n)]
      x%values = a
      y%values = b
      call linear_sum(0.3_wp, x%vector, -1.7_wp, y%vector, z%vector)
      call same(z, 0.3_wp*a - 1.7_wp*b, 'sum')
      call linear_sum(1.0_wp, z%vector, 2.0_wp, y%vector, z%vector)
      call same(z, 0.3_wp*a + 0.3_wp*b, 'sum in place of its first')
      call linear_sum(1.0_wp, x%vector, 2.0_wp, z%vector, z%vector)
      call same(z, 1.6_wp*a + 0.6_wp*b, 'sum in place of its second')
      call multiply(-3.0_wp, x%vector, z%vector)
      call same(z, -3*a, 'multiple')
      call multiply(0.5_wp, z%vector, z%vector)
      call same(z, -1.5_wp*a, 'multiple in place')
      call set_all(4.0_wp, z%vector)
      call same(z, [(4.0_wp, i=1, n)], 'constant')
      call expect_close(weighted_norm(x%vector, y%vector), sqrt(sum((a*b)**2)/n), 1e-14_wp, 'norm of '//to_text(n))
      call expect_close(real(add_multiples(2, [2.0_wp, -0.5_wp], x%vector, [c_loc(y%vector), c_loc(z%vector)], &
         & [c_loc(y%vector), c_loc(z%vector)]), wp), 0.0_wp, 0.0_wp, 'done')
      call same(y, b + 2*a, 'first of two sums')
      call same(z, 4 - 0.5_wp*a, 'second of two sums')
      call expect_close(real(multiply_each(2, [3.0_wp, -1.0_wp], [c_loc(y%vector), c_loc(x%vector)], &
         & [c_loc(y%vector), c_loc(z%vector)]), wp), 0.0_wp, 0.0_wp, 'done')
      call same(y, 3*b + 6*a, 'first of two multiples')
      call same(z, -a, 'second of two multiples')
      call same(x, a, 'what was only read')
      call fn_vdestroy(x%vector)
      call fn_vdestroy(y%vector)
      call fn_vdestroy(z%vector)
      call fn_vdestroy(first)
      call free_context(context)
   end subroutine operations

   !> A clone of a vector.
   type(pair_type) function twin(vector)
      type(n_vector), intent(in) :: vector
      call c_f_pointer(clone(vector), twin%vector)
      twin%values => numbers(twin%vector)
   end function twin

   subroutine same(found, expected, what)
      type(pair_type), intent(in) :: found
      real(wp), intent(in) :: expected(:)
      character(len=*), intent(in) :: what
      call expect(size(found%values) == size(expected), 'as many numbers')
      call expect_close(maxval(abs(found%values - expected)), 0.0_wp, 1e-14_wp, what//' of '//to_text(size(expected)))
   end subroutine same
end program test_vector_operations
