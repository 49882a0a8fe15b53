!> The input variables of single tasks, for the list of all (case_fields).
module task_fields
   use kinds, only: wp
   use field_visitor, only: visitor_type, field, choice, logical_words
   use case_inputs, only: coefficients_type, periodic_type, branch_type, most_ratios
   implicit none (type, external)
   private
   public :: visit_coefficients, visit_periodic, visit_branch

contains

   subroutine visit_coefficients(coefficients, v)
      type(coefficients_type), intent(inout) :: coefficients
      class(visitor_type), intent(inout) :: v
      call v%group('coefficients', 'Stiffness, damping and stability, for the task coefficients')
      call v%list(coefficients%frequency_ratio, most_ratios, field('frequency_ratio', 0.0_wp, 1e6_wp, '1', &
         & 'whirl frequencies over the speed of the shaft, of the coefficients of the journal'))
      call v%number(coefficients%threshold_up_to_rpm, field('threshold_up_to_rpm', 0.0_wp, 1e6_wp, 'rpm', &
         & '> 0: the speed at which stability is lost is sought from speed_rpm up to this one'))
      call v%number(coefficients%cross_stiffness, field('cross_stiffness', -1e15_wp, 1e15_wp, 'N/m', &
         & 'Q: cross-coupled stiffness at the journal beside the bearing''s, for the modes; > 0 drives forward whirl'))
   end subroutine visit_coefficients

   subroutine visit_periodic(periodic, v)
      type(periodic_type), intent(inout) :: periodic
      class(visitor_type), intent(inout) :: v
      call v%group('periodic', 'A periodic orbit and its stability, for the tasks periodic and branch')
      call v%whole(periodic%revolutions, field('revolutions', 1.0_wp, 1000.0_wp, '1', &
         & 'revolutions of the shaft in a period'))
      call v%number(periodic%tolerance, field('tolerance', 1e-12_wp, 1e-2_wp, '1', &
         & 'how far from the orbit Newton''s method may end, over the characteristic scale of each state'))
      call v%whole(periodic%max_iterations, field('max_iterations', 1.0_wp, 1e6_wp, '1', &
         & 'maximum number of iterations of Newton''s method; more is a failure'))
   end subroutine visit_periodic

   subroutine visit_branch(branch, v)
      type(branch_type), intent(inout) :: branch
      class(visitor_type), intent(inout) :: v
      call v%group('branch', 'Equilibria or periodic orbits over a number of the input, for the task branch')
      call v%word(branch%of, choice('of', 'periodic equilibrium', &
         & 'periodic: orbits, as the task periodic finds them; equilibrium: equilibria without friction in the pivots'))
      call v%word(branch%parameter, choice('parameter', '', &
         & 'the number that changes, from the value that the case gives it: ''operation%speed_rpm''; with an ' &
         & //'element where there are several, ''rotor%static_load(1)''; of values of the pads all without one. ' &
         & //'Numbers of rotor, operation, bearing, oil, pads, pivot, friction and asperity'))
      call v%number(branch%last, field('last', -1e15_wp, 1e15_wp, '', 'its value where the branch ends; it also ends ' &
         & //'where it comes back to the first value'))
      call v%number(branch%step, field('step', -1e15_wp, 1e15_wp, '', 'its first change; later steps are as long as ' &
         & //'the iteration allows'))
      call v%number(branch%max_step, field('max_step', 0.0_wp, 1e15_wp, '', 'its largest change from point to ' &
         & //'point; 0: ten times the first'))
      call v%whole(branch%max_points, field('max_points', 2.0_wp, 1e5_wp, '1', 'maximum number of points of a branch'))
      call v%flag(branch%switch, choice('switch', logical_words, &
         & 'periodic: whether the orbits of double period are followed, too, where the period doubles'))
   end subroutine visit_branch
end module task_fields
