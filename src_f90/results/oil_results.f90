!> The oil of the films in the file of a run, from which they can be solved again: viscosities and, where oil is uneven,
!> its polynomials, as docs/results.md lists them.
module oil_results
   use kinds, only: wp
   use errors, only: error_type, raise, system_error
   use film_oils, only: film_oil, uneven_oil, weights_degree, polynomials
   use record, only: record_type
   implicit none (type, external)
   private
   public :: put_oil, read_oil

   !> The polynomials (film_oils), in their order.
   character(len=*), parameter :: names(polynomials) = [character(len=15) :: 'flow_weights', 'sliding_weights', &
      & 'shear_weights']
   character(len=*), parameter :: meanings(polynomials) = [character(len=12) :: 'ln(12 mu f2)', 'f1', 'ln(f0/mu)']

contains

   !> Writes the oil of every pad's film; `group` is empty or ends with a slash.
   subroutine put_oil(file, group, oil)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: group
      type(film_oil), intent(in) :: oil(:)
      real(wp) :: c(0:weights_degree, polynomials, size(oil))
      integer :: i, k
      call file%put(group//'viscosity', oil%viscosity, 'Pa s', 'viscosity of the film', 'pad')
      if (.not. any(oil%varies)) return
      do i = 1, size(oil)
         c(:, :, i) = oil(i)%coefficients()
      end do
      call file%put('film_degree', [(real(k, wp), k=0, weights_degree)], '1', &
         & 'power of the place on the arc, from the leading edge (-1) to the trailing edge (1)', 'film_degree')
      do k = 1, polynomials
         call file%put(group//trim(names(k)), c(:, k, :), '1', 'coefficients of '//trim(meanings(k)) &
            & //' along the arc', 'pad film_degree')
      end do
   end subroutine put_oil

   !> The oil that a file has; an error where it has none.
   subroutine read_oil(file, group, oil, error)
      class(record_type), intent(in) :: file
      character(len=*), intent(in) :: group
      type(film_oil), intent(out) :: oil(:)
      type(error_type), allocatable, intent(inout) :: error
      real(wp) :: c(0:weights_degree, size(oil), polynomials), values(size(oil)*(weights_degree + 1)), mu(size(oil))
      integer :: i, k
      call file%get_list(group//'viscosity', mu)
      c = 0
      if (file%has(group//trim(names(1)))) then
         do k = 1, polynomials
            call file%get_list(group//trim(names(k)), values)
            c(:, :, k) = reshape(values, shape(c(:, :, k)))
         end do
      end if
      if (.not. all(mu > 0) .or. .not. all(abs(c) < huge(c))) then
         call raise(error, system_error, 'damaged: '//group//'viscosity is not that of an oil')
         return
      end if
      do i = 1, size(oil)
         oil(i) = uneven_oil(mu(i), c(:, i, :))
      end do
   end subroutine read_oil
end module oil_results
