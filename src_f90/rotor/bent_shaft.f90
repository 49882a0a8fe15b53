!> What turns with a shaft beside its unbalances: the forces of a shaft that is bent without any load, and the moments
!> of discs whose axes are not that of the shaft.
module bent_shaft
   use kinds, only: wp
   use linear_algebra, only: dpbtrf, dpbtrs
   use sparse_matrix, only: sparse_matrix_type
   use case_groups, only: elastic_type, unbalance_type
   use rotor_component, only: rotor_component_type, unbalance_moments
   implicit none (type, external)
   private
   public :: bow_forces, skew_moments

contains

   !> Forces K q on all displacements, N, (n, 2): at the shaft angle phi bow(:, 1)*cos(phi) + bow(:, 2)*sin(phi).
   !> q is the shape of the least energy of bending through the displacements that are given and through the stations
   !> of bearings, where none is. There must be two of these.
   function bow_forces(rotor, bearings, component) result(force)
      type(elastic_type), intent(in) :: rotor
      !> Their stations.
      integer, intent(in) :: bearings(:)
      type(rotor_component_type), intent(in) :: component
      real(wp), allocatable :: force(:, :), moments(:, :), q(:, :), factor(:, :), x(:, :)
      type(sparse_matrix_type) :: inner
      logical :: given(component%station%columns)
      integer, allocatable :: free(:), at(:)
      integer :: i, k, info
      associate (bows => rotor%bows, station => component%station)
         moments = unbalance_moments([(unbalance_type(bows(i)%station, bows(i)%displacement, bows(i)%angle_deg), i=1, &
            & size(bows))], station%rows, component%sense)
         q = reshape([station%transposed_times(moments(1, :)), station%transposed_times(moments(2, :))], &
            & [station%columns, 2])
         at = [bearings, bows%station]
         given = .false.
         do i = 1, size(at)
            do k = 2*at(i) - 1, 2*at(i)
               given(station%column(station%first(k))) = .true.
            end do
         end do
      end associate
      free = pack([(i, i=1, size(given))], .not. given)
      force = component%stiffness%times(q)
      x = -force(free, :)
      inner = component%stiffness%part(free, free)
      k = inner%half_band_width()
      factor = inner%band(0, k)
      call dpbtrf('U', size(free), k, factor, k + 1, info)
      call dpbtrs('U', size(free), k, 2, factor, k + 1, x, size(free), info)
      q(free, :) = x
      force = component%stiffness%times(q)
   end function bow_forces

   !> Moments of skew discs over the slopes of stations, kg m^2, (2, slopes): they act as moments of unbalances do over
   !> displacements. A disc whose axis is turned by tau has the moment (I_d - I_p) tau Omega^2 in the sense of tau.
   pure function skew_moments(rotor, n, sense) result(moments)
      type(elastic_type), intent(in) :: rotor
      integer, intent(in) :: n
      real(wp), intent(in) :: sense
      real(wp) :: moments(2, n)
      integer :: i
      associate (d => rotor%discs)
         moments = unbalance_moments([(unbalance_type(d(i)%station, (d(i)%diametral_inertia - d(i)%polar_inertia) &
            & *d(i)%skew, d(i)%skew_angle_deg), i=1, size(d))], n, sense)
      end associate
   end function skew_moments
end module bent_shaft
