!> The vibrations of rotor and pads on a bearing that is linearised in equilibrium, in an order, and what is said of
!> each.
module vibration_modes
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp, pi
   use small_vibrations, only: find_vibrations
   use linear_bearing, only: linear_bearing_type
   implicit none (type, external)
   private
   public :: vibration_modes_type, find_modes, rotor_eigenvalues

   !> The modes in the order of their damping ratios, the least first, so that the first says whether the rest is
   !> stable; of a pair of eigenvalues the one with a positive imaginary part; among ratios of 1 the slowest first.
   type :: vibration_modes_type
      !> 1/s.
      complex(wp), allocatable :: eigenvalue(:)
      !> (position, mode): m, and rad of tilts. Times the length that stands for a tilt, the largest is 1 m, and has
      !> no phase; of positions that do not move it is 0.
      complex(wp), allocatable :: shape(:, :)
      !> -Re/|eigenvalue|; -2 pi Re/Im, no number where nothing vibrates.
      real(wp), allocatable :: damping_ratio(:), log_decrement(:)
   end type vibration_modes_type

   !> Positions of the journal.
   integer, parameter :: journal = 2

contains

   !> The modes of a bearing with a rotor of this mass, kg, and cross-coupled stiffness, N/m. `ok` is false where the
   !> eigenvalues are not found.
   subroutine find_modes(bearing, rotor_mass, cross_stiffness, lengths, modes, ok)
      type(linear_bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: rotor_mass, cross_stiffness
      !> What stands for 1 rad of a position's, m; 1 where it is a displacement.
      real(wp), intent(in) :: lengths(:)
      type(vibration_modes_type), intent(out) :: modes
      logical, intent(out) :: ok
      complex(wp), allocatable :: values(:), shapes(:, :)
      real(wp), allocatable :: ratio(:)
      integer, allocatable :: kept(:)
      logical, allocatable :: waiting(:)
      integer :: i, n, next
      kept = pack([(i, i=1, size(bearing%moves))], bearing%moves)
      call rotor_eigenvalues(bearing, rotor_mass, cross_stiffness, values, ok, shapes)
      if (.not. ok) return
      ratio = damping_ratio(values)
      waiting = values%im >= 0
      n = count(waiting)
      allocate (modes%eigenvalue(n), modes%shape(size(bearing%moves), n))
      modes%shape = 0
      do i = 1, n
         next = least(ratio, abs(values), waiting)
         waiting(next) = .false.
         modes%eigenvalue(i) = values(next)
         modes%shape(kept, i) = normalised(shapes(:, next), lengths(kept))
      end do
      modes%damping_ratio = damping_ratio(modes%eigenvalue)
      allocate (modes%log_decrement(n), source=ieee_value(1.0_wp, ieee_quiet_nan))
      where (modes%eigenvalue%im > 0) modes%log_decrement = -2*pi*modes%eigenvalue%re/modes%eigenvalue%im
   end subroutine find_modes

   !> The eigenvalues, 1/s, of a bearing with a rotor as above, and the shapes of the positions that move.
   subroutine rotor_eigenvalues(bearing, rotor_mass, cross_stiffness, values, ok, shapes)
      type(linear_bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: rotor_mass, cross_stiffness
      complex(wp), allocatable, intent(out) :: values(:)
      logical, intent(out) :: ok
      complex(wp), allocatable, intent(out), optional :: shapes(:, :)
      real(wp), allocatable, dimension(:, :) :: mass, stiffness
      integer, allocatable :: kept(:)
      integer :: i
      kept = pack([(i, i=1, size(bearing%moves))], bearing%moves)
      allocate (values(2*size(kept)))
      if (present(shapes)) allocate (shapes(size(kept), 2*size(kept)))
      mass = bearing%mass(kept, kept)
      stiffness = bearing%stiffness(kept, kept)
      do i = 1, journal
         mass(i, i) = mass(i, i) + rotor_mass
      end do
      ! what is displaced along y is pushed along z, and what is displaced along z against y: forward
      stiffness(1, 2) = stiffness(1, 2) + cross_stiffness
      stiffness(2, 1) = stiffness(2, 1) - cross_stiffness
      call find_vibrations(mass, -stiffness, -bearing%damping(kept, kept), values, ok, shapes)
   end subroutine rotor_eigenvalues

   !> The one of least ratio, and of these the one of least size.
   pure integer function least(ratio, length, waiting)
      real(wp), intent(in) :: ratio(:), length(:)
      logical, intent(in) :: waiting(:)
      real(wp) :: lowest
      lowest = minval(ratio, mask=waiting)
      least = minloc(length, dim=1, mask=waiting .and. ratio <= lowest)
   end function least

   !> 1 where nothing moves.
   elemental real(wp) function damping_ratio(value)
      complex(wp), intent(in) :: value
      damping_ratio = 1
      if (.not. abs(value) <= 0) damping_ratio = -value%re/abs(value)
   end function damping_ratio

   !> A shape over its largest element, each times the length that stands for it.
   pure function normalised(shape, lengths)
      complex(wp), intent(in) :: shape(:)
      real(wp), intent(in) :: lengths(:)
      complex(wp) :: normalised(size(shape))
      associate (largest => maxloc(abs(shape)*lengths, dim=1))
         normalised = shape/(shape(largest)*lengths(largest))
      end associate
   end function normalised
end module vibration_modes
