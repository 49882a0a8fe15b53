!> What a run cost, over all its stretches.
module run_statistics
   use kinds, only: wp, i8
   use hdf5_file, only: hdf5_type
   implicit none (type, external)
   private
   public :: run_statistics_type

   type :: run_statistics_type
      !> Of the march.
      integer(i8) :: steps = 0, rhs_evaluations = 0, jacobian_evaluations = 0
      integer(i8) :: error_test_failures = 0, convergence_failures = 0
      !> Pads solved by axial modes and on finite volumes, and sweeps, in the march.
      integer(i8) :: film_modal = 0, film_sor = 0, sor_sweeps = 0
      !> Wall time, s.
      real(wp) :: film_seconds = 0, output_seconds = 0, checkpoint_seconds = 0, wall_seconds = 0
   contains
      procedure :: put
      procedure :: get
      procedure, private :: plus
      generic :: operator(+) => plus
   end type run_statistics_type

contains

   subroutine put(self, file)
      class(run_statistics_type), intent(in) :: self
      type(hdf5_type), intent(inout) :: file
      if (.not. file%has('statistics')) call file%make_group('statistics')
      call file%put_count('statistics/steps', self%steps, 'time steps')
      call file%put_count('statistics/rhs_evaluations', self%rhs_evaluations, 'right-hand sides')
      call file%put_count('statistics/jacobian_evaluations', self%jacobian_evaluations, 'Jacobians')
      call file%put_count('statistics/error_test_failures', self%error_test_failures, &
         & 'steps refused by the error test')
      call file%put_count('statistics/convergence_failures', self%convergence_failures, &
         & 'Newton iterations that failed')
      call file%put_count('statistics/film_modal', self%film_modal, 'pads solved by axial modes in the march')
      call file%put_count('statistics/film_sor', self%film_sor, 'pads solved on finite volumes in the march')
      call file%put_count('statistics/sor_sweeps', self%sor_sweeps, &
         & 'sweeps of over-relaxation, or eliminations, in the march')
      call file%put_real('statistics/film_seconds', self%film_seconds, 's', 'wall time of the film in the march')
      call file%put_real('statistics/output_seconds', self%output_seconds, 's', 'wall time of sampling')
      call file%put_real('statistics/checkpoint_seconds', self%checkpoint_seconds, 's', &
         & 'wall time of the checkpoints before the last')
      call file%put_real('statistics/wall_seconds', self%wall_seconds, 's', 'wall time of the run')
   end subroutine put

   subroutine get(self, file)
      class(run_statistics_type), intent(out) :: self
      type(hdf5_type), intent(inout) :: file
      self%steps = file%get_count('statistics/steps')
      self%rhs_evaluations = file%get_count('statistics/rhs_evaluations')
      self%jacobian_evaluations = file%get_count('statistics/jacobian_evaluations')
      self%error_test_failures = file%get_count('statistics/error_test_failures')
      self%convergence_failures = file%get_count('statistics/convergence_failures')
      self%film_modal = file%get_count('statistics/film_modal')
      self%film_sor = file%get_count('statistics/film_sor')
      self%sor_sweeps = file%get_count('statistics/sor_sweeps')
      self%film_seconds = file%get_real('statistics/film_seconds')
      self%output_seconds = file%get_real('statistics/output_seconds')
      self%checkpoint_seconds = file%get_real('statistics/checkpoint_seconds')
      self%wall_seconds = file%get_real('statistics/wall_seconds')
   end subroutine get

   pure function plus(self, other) result(sum)
      class(run_statistics_type), intent(in) :: self, other
      type(run_statistics_type) :: sum
      sum%steps = self%steps + other%steps
      sum%rhs_evaluations = self%rhs_evaluations + other%rhs_evaluations
      sum%jacobian_evaluations = self%jacobian_evaluations + other%jacobian_evaluations
      sum%error_test_failures = self%error_test_failures + other%error_test_failures
      sum%convergence_failures = self%convergence_failures + other%convergence_failures
      sum%film_modal = self%film_modal + other%film_modal
      sum%film_sor = self%film_sor + other%film_sor
      sum%sor_sweeps = self%sor_sweeps + other%sor_sweeps
      sum%film_seconds = self%film_seconds + other%film_seconds
      sum%output_seconds = self%output_seconds + other%output_seconds
      sum%checkpoint_seconds = self%checkpoint_seconds + other%checkpoint_seconds
      sum%wall_seconds = self%wall_seconds + other%wall_seconds
   end function plus
end module run_statistics
