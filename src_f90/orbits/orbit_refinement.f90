!> Closes an orbit on mesh after mesh, until its leading multiplier hardly changes any longer: the steps of a march
!> follow the motion, but what becomes of a small disturbance may need shorter intervals where a film begins to carry or
!> a pad leaves its pivot.
module orbit_refinement
   use kinds, only: wp
   use errors, only: error_type, raise, numerics_error
   use linear_algebra, only: find_eigenvalues
   use newton_method, only: newton_options, branch_point_type, correct
   use orbit_polynomials, only: orbit_type
   use orbit_problem, only: orbit_problem_type
   implicit none (type, external)
   private
   public :: refined_orbit_type, close_on_meshes, linearize_along, allowed_error

   type :: refined_orbit_type
      !> Multipliers, that of largest modulus first, and their errors: by how much each differs from the nearest one of
      !> the mesh before, and of the leading one what the changes on all intervals, one mesh after the other, leave.
      complex(wp), allocatable :: multipliers(:)
      real(wp), allocatable :: errors(:)
      !> Iterations of Newton's method on all meshes; whether those on the last one were as many as allowed.
      integer :: iterations = 0
      logical :: exhausted = .false.
   end type refined_orbit_type

   !> What remains of a mesh when another has taken its place: times of its ends, s, multipliers, and how the state at
   !> each end follows from that at the end before, (to, from, interval).
   type :: mesh_type
      real(wp), allocatable :: time(:), transition(:, :, :)
      complex(wp), allocatable :: multipliers(:)
   end type mesh_type

   !> Error of the leading multiplier, over its modulus where that is above 1.
   real(wp), parameter :: allowed = 1e-3_wp
   !> Most meshes, and most intervals over those of the first mesh. A switching point inside of an interval leaves an
   !> error as large as the interval is long: six meshes of quarters leave 1/4000.
   integer, parameter :: most_meshes = 8, most_growth = 16

contains

   !> The error of a leading multiplier that is allowed.
   pure real(wp) function allowed_error(multiplier)
      complex(wp), intent(in) :: multiplier
      allowed_error = allowed*max(1.0_wp, abs(multiplier))
   end function allowed_error

   !> Closes the orbit at which a problem stands: first on every second interval of its mesh, none longer than the
   !> longest, s, which costs half and leaves a good start; then on the halves, and on quarters of those that still
   !> change the leading multiplier. An error where it does not close on the first two meshes.
   subroutine close_on_meshes(problem, newton, longest, found, error)
      type(orbit_problem_type), intent(inout) :: problem
      type(newton_options), intent(in) :: newton
      real(wp), intent(in) :: longest
      type(refined_orbit_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      type(orbit_type) :: coarse
      type(branch_point_type) :: closed
      type(mesh_type) :: before
      real(wp), allocatable :: changes(:)
      real(wp) :: change
      logical, allocatable :: chosen(:)
      integer :: mesh, most
      change = 0
      call problem%orbit%change_mesh(first_mesh(problem%orbit%time, longest))
      call correct(problem, newton, closed, error)
      found%iterations = closed%iterations
      found%exhausted = closed%iterations == newton%max_iterations
      most = most_growth*problem%orbit%intervals()
      allocate (chosen(problem%orbit%intervals()), source=.true.)
      do mesh = 2, most_meshes
         if (allocated(error)) return
         coarse = problem%orbit
         before%time = [problem%orbit%time]
         before%transition = problem%equations%transitions()
         before%multipliers = closed%values
         call cut(problem, chosen, merge(2, 4, mesh == 2))
         call correct(problem, newton, closed, error)
         found%iterations = found%iterations + closed%iterations
         found%exhausted = closed%iterations == newton%max_iterations
         if (allocated(error)) then
            if (mesh == 2 .or. error%status /= numerics_error) return
            ! what the mesh before has, with its error
            deallocate (error)
            problem%orbit = coarse
            return
         end if
         call move_alloc(closed%values, found%multipliers)
         found%errors = distances(found%multipliers, before%multipliers)
         closed%values = found%multipliers
         changes = changes_by()
         found%errors(1) = error_left(sum(changes), change)
         change = sum(changes)
         if (found%errors(1) <= allowed_error(found%multipliers(1))) return
         call choose_intervals()
         if (problem%orbit%intervals() + 3*count(chosen) > most .or. .not. any(chosen)) return
      end do

   contains

      !> By how much each interval of the mesh before changes the leading multiplier, mu, now that it is cut. To first
      !> order this is w (Phi - Phi_before) v / (w v), with the left and the right eigenvector of mu that have come to
      !> its end and to its start.
      function changes_by() result(changes)
         real(wp) :: changes(size(before%transition, 3))
         real(wp), allocatable :: transition(:, :, :)
         complex(wp), allocatable :: v(:, :), w(:, :)
         integer, allocatable :: ends(:)
         integer :: k, n
         n = problem%orbit%intervals()
         transition = problem%equations%transitions()
         ends = same_ends()
         allocate (v(problem%n, 0:n), w(problem%n, 0:n))
         v(:, 0) = eigenvector(problem%orbit%monodromy, found%multipliers(1))
         w(:, n) = eigenvector(transpose(problem%orbit%monodromy), found%multipliers(1))
         do k = 1, n
            v(:, k) = matmul(transition(:, :, k), v(:, k - 1))
         end do
         do k = n, 1, -1
            w(:, k - 1) = matmul(w(:, k), transition(:, :, k))
         end do
         do k = 1, size(changes)
            associate (first => ends(k), last => ends(k + 1))
               changes(k) = abs(sum(w(:, last)*(v(:, last) - matmul(before%transition(:, :, k), v(:, first)))) &
                  & /sum(w(:, n)*v(:, 0)))
            end associate
         end do
      end function changes_by

      !> The intervals in those of the mesh before that change the leading multiplier most: all others together change
      !> it by less than the error that is allowed.
      subroutine choose_intervals()
         integer :: ends(size(before%time)), k
         ends = same_ends()
         deallocate (chosen)
         allocate (chosen(problem%orbit%intervals()))
         do k = 1, size(changes)
            chosen(ends(k) + 1:ends(k + 1)) = .not. changes(k) < allowed/size(changes)
         end do
      end subroutine choose_intervals

      !> The ends of intervals, from 0 on, that are nearest to those of the mesh before.
      function same_ends() result(ends)
         integer :: ends(size(before%time)), k
         ends = [(minloc(abs(problem%orbit%time - before%time(k)), dim=1) - 1, k=1, size(ends))]
      end function same_ends
   end subroutine close_on_meshes

   !> What is left of an error by a mesh that made a change, where the mesh before made another (0: none), as the limit
   !> of a geometric series of changes; at most the change itself.
   pure real(wp) function error_left(change, before)
      real(wp), intent(in) :: change, before
      error_left = change
      if (change < 0.5_wp*before) error_left = change**2/(before - change)
   end function error_left

   !> The multipliers along the motion at which a problem stands, as it is, and by how much they change from half as
   !> many intervals.
   subroutine linearize_along(problem, found, error)
      type(orbit_problem_type), intent(in) :: problem
      type(refined_orbit_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      type(orbit_problem_type) :: along
      complex(wp), allocatable :: before(:)
      real(wp), allocatable :: growth(:)
      real(wp) :: matrix(problem%n, problem%n), b(problem%n)
      integer :: mesh
      logical :: ok
      do mesh = 1, 2
         along = problem
         if (mesh == 1) call along%orbit%change_mesh(first_mesh(problem%orbit%time, huge(1.0_wp)))
         call along%linearize(matrix, b, error)
         if (allocated(error)) return
         if (mesh == 2) call move_alloc(found%multipliers, before)
         call along%spectrum(found%multipliers, growth, ok)
         if (.not. ok) call raise(error, numerics_error, 'the eigenvalues that tell stability were not found')
         if (.not. ok) return
      end do
      found%errors = distances(found%multipliers, before)
   end subroutine linearize_along

   !> Every second end of a mesh, and as many between them as leave no interval longer than the longest.
   pure function first_mesh(time, longest) result(mesh)
      real(wp), intent(in) :: time(:), longest
      real(wp), allocatable :: mesh(:), ends(:)
      integer :: i, k, pieces
      ends = [time(1:size(time) - 1:2), time(size(time))]
      mesh = ends(1:1)
      do k = 2, size(ends)
         associate (length => ends(k) - ends(k - 1))
            pieces = ceiling(length/longest)
            mesh = [mesh, (ends(k - 1) + length*i/pieces, i=1, pieces - 1), ends(k)]
         end associate
      end do
   end function first_mesh

   !> Cuts the chosen intervals of the orbit into a number of pieces.
   pure subroutine cut(problem, chosen, pieces)
      type(orbit_problem_type), intent(inout) :: problem
      logical, intent(in) :: chosen(:)
      integer, intent(in) :: pieces
      real(wp) :: time(size(chosen) + (pieces - 1)*count(chosen) + 1)
      integer :: switching_point(size(time)), k, i, l, parts
      time(1) = problem%orbit%time(0)
      switching_point = 0
      i = 1
      do k = 1, size(chosen)
         parts = merge(pieces, 1, chosen(k))
         associate (ends => problem%orbit%time(k - 1:k))
            do l = 1, parts - 1
               time(i + l) = ends(1) + l*(ends(2) - ends(1))/parts
            end do
            i = i + parts
            time(i) = ends(2)
         end associate
         switching_point(i) = problem%orbit%switching_point(k)
      end do
      call problem%orbit%change_mesh(time, switching_point)
   end subroutine cut

   !> How far each number is from the nearest of others.
   pure function distances(numbers, others)
      complex(wp), intent(in) :: numbers(:), others(:)
      real(wp) :: distances(size(numbers))
      integer :: i
      distances = [(minval(abs(numbers(i) - others)), i=1, size(numbers))]
   end function distances

   !> The eigenvector of a matrix whose eigenvalue is nearest to mu.
   function eigenvector(matrix, mu) result(vector)
      real(wp), intent(in) :: matrix(:, :)
      complex(wp), intent(in) :: mu
      complex(wp) :: vector(size(matrix, 1)), vectors(size(matrix, 1), size(matrix, 1)), values(size(matrix, 1))
      logical :: ok
      call find_eigenvalues(matrix, values, ok, vectors)
      vector = 1
      if (ok) vector = vectors(:, minloc(abs(values - mu), dim=1))
   end function eigenvector
end module orbit_refinement
