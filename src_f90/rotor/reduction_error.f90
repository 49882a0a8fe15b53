!> How well a reduced rotor vibrates: amplitudes of forced vibrations, compared with those of the whole one.
module reduction_error
   ! heap: matrices of all displacements of a shaft
   use kinds, only: wp
   use linear_algebra, only: zgesv
   implicit none (type, external)
   private
   public :: response_problem_type, amplitudes, amplitude_error

   !> A forced vibration at one frequency: D q = loads.
   type :: response_problem_type
      !> Dynamic stiffness, (n, n), N/m, without bearings.
      complex(wp), allocatable :: stiffness(:, :)
      !> (n, loads), and displacements that matter: matmul(observed, q).
      real(wp), allocatable :: loads(:, :), observed(:, :)
      !> Displacements of the journals, and the dynamic stiffness of their bearings, N/m.
      integer, allocatable :: journals(:)
      complex(wp), allocatable :: bearings(:)
   contains
      procedure :: reduced
   end type response_problem_type

contains

   !> The same problem in displacements x with q = matmul(basis, x), of which the first are those of the journals.
   pure function reduced(self, basis) result(problem)
      class(response_problem_type), intent(in) :: self
      real(wp), intent(in) :: basis(:, :)
      type(response_problem_type) :: problem
      integer :: i
      problem%stiffness = matmul(transpose(basis), matmul(self%stiffness, basis))
      problem%loads = matmul(transpose(basis), self%loads)
      problem%observed = matmul(self%observed, basis)
      problem%journals = [(i, i=1, size(self%journals))]
      problem%bearings = self%bearings
   end function reduced

   !> Amplitudes of the first n displacements' motion, the others being held: (observed, load), m.
   function amplitudes(problem, n)
      type(response_problem_type), intent(in) :: problem
      integer, intent(in) :: n
      complex(wp), allocatable :: amplitudes(:, :), matrix(:, :), x(:, :)
      integer :: pivots(n), i, info
      matrix = problem%stiffness(:n, :n)
      do i = 1, size(problem%journals)
         associate (element => matrix(problem%journals(i), problem%journals(i)))
            element = element + problem%bearings(i)
         end associate
      end do
      x = cmplx(problem%loads(:n, :), kind=wp)
      call zgesv(n, size(x, 2), matrix, n, pivots, x, n, info)
      ! a growing vibration on dampers has no resonance
      amplitudes = matmul(problem%observed(:, :n), x)
   end function amplitudes

   !> The largest error of amplitudes, relative to the largest amplitude under the same load.
   pure real(wp) function amplitude_error(found, exact) result(error)
      complex(wp), intent(in) :: found(:, :), exact(:, :)
      integer :: i
      error = 0
      do i = 1, size(exact, 2)
         error = max(error, maxval(abs(found(:, i) - exact(:, i)))/max(maxval(abs(exact(:, i))), tiny(1.0_wp)))
      end do
   end function amplitude_error
end module reduction_error
