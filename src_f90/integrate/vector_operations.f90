!> Operations on CVODE's serial vectors where the states are few: a step calls some dozens of them, and those of
!> SUNDIALS are made for long vectors (Debian packs them without optimisation besides).
module vector_operations
   use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_funloc, c_int, c_ptr
   use sundials_context, only: index_kind, n_vector, n_vector_ops
   implicit none (type, external)
   private
   public :: use_own_operations, numbers, error_norm

   !> What a serial vector holds, as nvector_serial.h says.
   type, bind(c) :: serial_content
      integer(index_kind) :: length
      integer(c_int) :: own_data
      type(c_ptr) :: data
   end type serial_content

contains

   !> Gives a serial vector the operations of this module; vectors that are cloned from it inherit them. Operations that
   !> steps do not need stay those of SUNDIALS.
   subroutine use_own_operations(vector)
      type(n_vector), intent(in) :: vector
      type(n_vector_ops), pointer :: ops
      call c_f_pointer(vector%ops, ops)
      ops%nvlinearsum = c_funloc(linear_sum)
      ops%nvconst = c_funloc(set_all)
      ops%nvscale = c_funloc(multiply)
      ops%nvwrmsnorm = c_funloc(weighted_norm)
      ops%nvscaleaddmulti = c_funloc(add_multiples)
      ops%nvscalevectorarray = c_funloc(multiply_each)
   end subroutine use_own_operations

   !> The numbers of a vector.
   function numbers(vector) result(x)
      type(n_vector), intent(in) :: vector
      real(c_double), pointer, contiguous :: x(:)
      type(serial_content), pointer :: content
      call c_f_pointer(vector%content, content)
      call c_f_pointer(content%data, x, [content%length])
   end function numbers

   !> The vector at an address.
   function vector_at(address) result(vector)
      type(c_ptr), intent(in) :: address
      type(n_vector), pointer :: vector
      call c_f_pointer(address, vector)
   end function vector_at

   !> z = a x + b y. As in all operations here z may be x or y.
   subroutine linear_sum(a, x_vector, b, y_vector, z_vector) bind(c)
      real(c_double), value :: a, b
      type(n_vector), intent(in) :: x_vector, y_vector, z_vector
      real(c_double), pointer, contiguous :: x(:), y(:), z(:)
      integer :: i
      x => numbers(x_vector)
      y => numbers(y_vector)
      z => numbers(z_vector)
      !$omp simd
      do i = 1, size(z)
         z(i) = a*x(i) + b*y(i)
      end do
   end subroutine linear_sum

   !> z = a.
   subroutine set_all(a, z_vector) bind(c)
      real(c_double), value :: a
      type(n_vector), intent(in) :: z_vector
      real(c_double), pointer, contiguous :: z(:)
      z => numbers(z_vector)
      z = a
   end subroutine set_all

   !> z = a x.
   subroutine multiply(a, x_vector, z_vector) bind(c)
      real(c_double), value :: a
      type(n_vector), intent(in) :: x_vector, z_vector
      real(c_double), pointer, contiguous :: x(:), z(:)
      integer :: i
      x => numbers(x_vector)
      z => numbers(z_vector)
      !$omp simd
      do i = 1, size(z)
         z(i) = a*x(i)
      end do
   end subroutine multiply

   !> The root mean square of x w, in CVODE with error weights w.
   real(c_double) function weighted_norm(x_vector, w_vector) bind(c)
      type(n_vector), intent(in) :: x_vector, w_vector
      weighted_norm = error_norm(numbers(x_vector), numbers(w_vector))
   end function weighted_norm

   pure real(c_double) function error_norm(x, w)
      real(c_double), intent(in), contiguous :: x(:), w(:)
      real(c_double) :: total
      integer :: i
      total = 0
      !$omp simd reduction(+: total)
      do i = 1, size(x)
         total = total + (x(i)*w(i))**2
      end do
      error_norm = sqrt(total/size(x))
   end function error_norm

   !> z = a x + y for each of n numbers a, vectors y and vectors z; 0: done.
   integer(c_int) function add_multiples(n, a, x_vector, y_vectors, z_vectors) bind(c)
      integer(c_int), value :: n
      real(c_double), intent(in) :: a(n)
      type(n_vector), intent(in) :: x_vector
      type(c_ptr), intent(in) :: y_vectors(n), z_vectors(n)
      integer :: k
      do k = 1, n
         call linear_sum(a(k), x_vector, 1.0_c_double, vector_at(y_vectors(k)), vector_at(z_vectors(k)))
      end do
      add_multiples = 0
   end function add_multiples

   !> z = a x for each of n numbers a, vectors x and vectors z; 0: done.
   integer(c_int) function multiply_each(n, a, x_vectors, z_vectors) bind(c)
      integer(c_int), value :: n
      real(c_double), intent(in) :: a(n)
      type(c_ptr), intent(in) :: x_vectors(n), z_vectors(n)
      integer :: k
      do k = 1, n
         call multiply(a(k), vector_at(x_vectors(k)), vector_at(z_vectors(k)))
      end do
      multiply_each = 0
   end function multiply_each
end module vector_operations
