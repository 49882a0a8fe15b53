!> What the file of a run says of its periodic orbit: names, dimensions and units as docs/results.md lists them.
module periodic_results
   use kinds, only: wp, i8
   use hdf5_file, only: hdf5_type
   use summary_group, only: put_figure
   use periodic_orbit, only: periodic_orbit_type, are_stable
   implicit none (type, external)
   private
   public :: put_periodic

contains

   subroutine put_periodic(file, found, revolutions)
      class(hdf5_type), intent(inout) :: file
      type(periodic_orbit_type), intent(in) :: found
      integer, intent(in) :: revolutions
      integer :: k
      associate (values => found%multipliers)
         call file%put_list('multiplier', [(real(k, wp), k=1, size(values))], '1', 'multiplier number', 'multiplier')
         call file%make_group('periodic')
         call file%put_real('periodic/period', found%period, 's', 'period of the orbit')
         call file%put_count('periodic/revolutions', int(revolutions, i8), 'revolutions of the shaft in a period')
         call file%put_real('periodic/residual', found%residual, '1', &
            & 'largest residual of the equations, over the size of the states')
         call file%put_count('periodic/iterations', int(found%iterations, i8), 'iterations of Newton''s method')
         call file%put_count('periodic/intervals', int(found%orbit%intervals(), i8), 'intervals of the collocation')
         call file%put_count('periodic/evaluations', found%evaluations, &
            & 'evaluations of the equations with their derivatives in all iterations')
         call file%put_count('periodic/marched_periods', int(found%marched, i8), 'periods of the march before them')
         call put_figure(file, 'leading_multiplier_real', values(1)%re, '1', 'leading multiplier, real part')
         call put_figure(file, 'leading_multiplier_imag', values(1)%im, '1', 'leading multiplier, imaginary part')
         call put_figure(file, 'leading_multiplier_modulus', abs(values(1)), '1', 'leading multiplier, modulus')
         call file%put_list('periodic/multiplier_real', values%re, '1', 'multiplier, real part', 'multiplier')
         call file%put_list('periodic/multiplier_imag', values%im, '1', 'multiplier, imaginary part', 'multiplier')
         call file%put_count('periodic/stable', merge(1_i8, 0_i8, are_stable(found%multipliers)), &
            & '1 where all multipliers are inside the unit circle')
      end associate
   end subroutine put_periodic
end module periodic_results
