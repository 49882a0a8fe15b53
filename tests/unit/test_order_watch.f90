!> When a march tries low orders of BDF, keeps them or leaves them, and how low they must be.
program test_order_watch
   use kinds, only: wp, i8
   use text, only: to_text
   use order_watch, only: order_watch_type, stable_order
   use check, only: runs, expect, report
   implicit none (type, external)

   if (runs('long_steps')) call long_steps()
   if (runs('stays')) call stays()
   if (runs('returns')) call returns()
   if (runs('in_vain')) call in_vain()
   if (runs('orders')) call orders()
   if (runs('many_modes')) call many_modes()
   call report()

contains

   !> Goes on from a step with steps of this length, s, until the orders change; the number of the step then.
   subroutine go_on(watch, t, steps, length, last)
      type(order_watch_type), intent(inout) :: watch
      real(wp), intent(inout) :: t
      integer(i8), intent(inout) :: steps
      real(wp), intent(in) :: length
      integer(i8), intent(in) :: last
      do while (steps < last)
         t = t + length
         steps = steps + 1
         if (watch%changes(t, steps)) exit
      end do
   end subroutine go_on

   !> Where the steps are long nothing is tried, nor where they are not short for long.
   subroutine long_steps()
      type(order_watch_type) :: watch
      real(wp) :: t
      integer(i8) :: steps
      integer :: k
      t = 5
      steps = 0
      watch = order_watch_type(1.0_wp, t)
      do k = 1, 20
         call go_on(watch, t, steps, merge(0.1_wp, 1.1_wp, modulo(k, 4) > 0), 250_i8*k)
      end do
      call expect(steps == 5000 .and. .not. watch%low, 'no trial at step '//to_text(steps))
   end subroutine long_steps

   !> Low orders that go twice as far stay, until high ones are tried; these stay where they go as far as low ones, and
   !> low ones are then tried as soon as at first.
   subroutine stays()
      type(order_watch_type) :: watch
      real(wp) :: t
      integer(i8) :: steps
      t = 5
      steps = 0
      watch = order_watch_type(1.0_wp, t)
      call go_on(watch, t, steps, 0.1_wp, 100000_i8)
      call expect(watch%low .and. steps == 1000, 'a trial at step '//to_text(steps))
      call expect(abs(watch%mean_step - 0.1_wp) < 1e-9_wp, 'after a mean step of '//to_text(watch%mean_step))
      call go_on(watch, t, steps, 0.06_wp, 1500_i8)
      call expect(watch%low .and. steps == 1500, 'its second half is waited for: '//to_text(steps))
      call go_on(watch, t, steps, 0.2_wp, 100000_i8)
      call expect(.not. watch%low .and. steps == 12000, 'low orders stay until step '//to_text(steps))
      call expect(abs(watch%mean_step - 0.2_wp) < 1e-9_wp, 'they had a mean step of '//to_text(watch%mean_step))
      call go_on(watch, t, steps, 0.21_wp, 13000_i8)
      call expect(.not. watch%low .and. steps == 13000, 'high orders that go as far stay: '//to_text(steps))
      call go_on(watch, t, steps, 0.1_wp, 100000_i8)
      call expect(watch%low .and. steps == 14000, 'the next trial at step '//to_text(steps))
   end subroutine stays

   !> High orders that go less far than low ones are left, and tried again after a longer wait.
   subroutine returns()
      type(order_watch_type) :: watch
      real(wp) :: t
      integer(i8) :: steps
      t = 0
      steps = 0
      watch = order_watch_type(1.0_wp, t)
      call go_on(watch, t, steps, 0.1_wp, 1000_i8)
      call go_on(watch, t, steps, 0.2_wp, 100000_i8)
      call go_on(watch, t, steps, 0.19_wp, 100000_i8)
      call expect(watch%low .and. steps == 13000, 'high orders are left at step '//to_text(steps))
      call go_on(watch, t, steps, 0.2_wp, 100000_i8)
      call expect(.not. watch%low .and. steps == 53000, 'and tried again at step '//to_text(steps))
   end subroutine returns

   !> Low orders that go much less far are left after half the trial, those that go hardly further after the whole. The
   !> waits grow.
   subroutine in_vain()
      type(order_watch_type) :: watch
      real(wp) :: t
      integer(i8) :: steps
      t = 0
      steps = 0
      watch = order_watch_type(1.0_wp, t)
      call go_on(watch, t, steps, 0.1_wp, 1000_i8)
      call go_on(watch, t, steps, 0.04_wp, 100000_i8)
      call expect(.not. watch%low .and. steps == 1500, 'much less far: until step '//to_text(steps))
      call go_on(watch, t, steps, 0.1_wp, 100000_i8)
      call expect(watch%low .and. steps == 5500, 'the second trial at step '//to_text(steps))
      call go_on(watch, t, steps, 0.14_wp, 100000_i8)
      call expect(.not. watch%low .and. steps == 6500, 'hardly further: until step '//to_text(steps))
      call go_on(watch, t, steps, 0.1_wp, 100000_i8)
      call expect(watch%low .and. steps == 22500, 'the third trial at step '//to_text(steps))
   end subroutine in_vain

   !> BDF of the orders 3, 4 and 5 is stable in any vibration from damping ratios of 0.069, 0.287 and 0.618 on (the
   !> cosines of its angles of stability, 86.0, 73.4 and 51.8 degrees).
   subroutine orders()
      real(wp), parameter :: damping(8) = [-0.01_wp, 0.0_wp, 0.06_wp, 0.08_wp, 0.28_wp, 0.3_wp, 0.6_wp, 0.7_wp]
      integer, parameter :: expected(8) = [2, 2, 2, 3, 3, 4, 4, 5]
      integer :: k, found
      do k = 1, size(damping)
         found = stable_order(vibration(100.0_wp, damping(k)), 0.01_wp)
         call expect(found == expected(k), 'order '//to_text(found)//' at damping ratio '//to_text(damping(k)))
         found = stable_order(vibration(100.0_wp, damping(k)), 0.001_wp)
         call expect(found == 5, 'order '//to_text(found)//' where steps resolve it, at '//to_text(damping(k)))
      end do
   end subroutine orders

   !> The lightest vibration decides, whatever else there is: decay, growth, states that stay.
   subroutine many_modes()
      real(wp) :: jacobian(8, 8)
      integer :: found
      jacobian = 0
      jacobian(1:2, 1:2) = vibration(1.0_wp, 0.01_wp)
      jacobian(3:4, 3:4) = vibration(500.0_wp, 0.4_wp)
      jacobian(5, 5) = -1e6_wp
      jacobian(6, 6) = 10
      found = stable_order(jacobian, 0.01_wp)
      call expect(found == 4, 'order '//to_text(found)//' with one fast vibration')
      jacobian(7:8, 7:8) = vibration(3000.0_wp, 0.1_wp)
      found = stable_order(jacobian, 0.01_wp)
      call expect(found == 3, 'order '//to_text(found)//' with a lighter one')
   end subroutine many_modes

   !> x'' + 2 damping frequency x' + frequency**2 x = 0.
   pure function vibration(frequency, damping) result(matrix)
      real(wp), intent(in) :: frequency, damping
      real(wp) :: matrix(2, 2)
      matrix(1, :) = [0.0_wp, 1.0_wp]
      matrix(2, :) = [-frequency**2, -2*damping*frequency]
   end function vibration
end program test_order_watch
