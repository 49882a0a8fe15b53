!> What a number would be if it were meant in another unit than that of the input, behind refusals and in remarks; usual
!> sizes of numbers.
module other_units
   use kinds, only: wp
   use text, only: to_text
   implicit none (type, external)
   private
   public :: in_other_units, usual_size, usual_type

   !> Usual sizes of variables. A name that ends in % stands for all of its group, an empty one for all that have the
   !> unit; the first that fits holds. Whether a number beside them is worth a remark where it is allowed; 0 never is.
   type :: usual_type
      character(len=8) :: unit = ''
      character(len=30) :: name = ''
      real(wp) :: low = -huge(1.0_wp), high = huge(1.0_wp)
      logical :: told = .false.
   end type usual_type

   type(usual_type), parameter :: usual(*) = [ &
      & usual_type('m', 'bearing%journal_radius', 2.5e-3_wp, 1.0_wp, told=.true.), &
      & usual_type('m', 'bearing%machined_clearance', 5e-6_wp, 5e-3_wp), &
      & usual_type('m', 'bearing%assembled_clearance', 5e-6_wp, 5e-3_wp), &
      & usual_type('m', 'pivot%radius_difference', 1e-7_wp, 0.01_wp), &
      & usual_type('m', 'asperity%', 1e-8_wp, 1e-5_wp), &
      & usual_type('m', 'deflection', 1e-8_wp, 5e-4_wp), &
      & usual_type('m', '', 2e-3_wp, 10.0_wp), &
      & usual_type('kg', 'pads%mass', 0.01_wp, 1e4_wp), &
      & usual_type('Pa s', '', 1e-4_wp, 10.0_wp, told=.true.), &
      & usual_type('deg', 'pads%arc_deg', 10.0_wp, 360.0_wp, told=.true.), &
      & usual_type('C', '', -60.0_wp, 150.0_wp, told=.true.), &
      & usual_type('Pa', 'bearing%', 100.0_wp, 1e6_wp, told=.true.), &
      & usual_type('Pa', '', 2e9_wp, 2e12_wp, told=.true.), &
      & usual_type('W/(m K)', 'oil%', 1e-3_wp, 10.0_wp, told=.true.), &
      & usual_type('J/(kg K)', '', 1e3_wp, 5e3_wp), &
      & usual_type('kg/m^3', 'oil%', 500.0_wp, 2e3_wp), &
      & usual_type('kg/m^3', 'impeller%', 0.05_wp, 600.0_wp), &
      & usual_type('kg/m^3', '', 1e3_wp, 2.5e4_wp, told=.true.), &
      & usual_type('N', '', 1.0_wp, 1e8_wp), &
      & usual_type('rpm', '', 10.0_wp, 2e5_wp), &
      & usual_type('N/m', 'pivot%', 1e6_wp, 1e13_wp, told=.true.), &
      & usual_type('N/m', 'support%', 1e4_wp, 1e13_wp, told=.true.)]

   !> A unit that data sheets have instead of that of the input, which is offset + factor times the number; `custom`
   !> for those of inch and pound, and for turns a second.
   type :: other_unit_type
      character(len=13) :: of
      character(len=12) :: name
      real(wp) :: factor
      real(wp) :: offset = 0
      logical :: custom = .false.
   end type other_unit_type

   type(other_unit_type), parameter :: known(*) = [ &
      & other_unit_type('m', 'mm', 1e-3_wp), &
      & other_unit_type('m', 'um', 1e-6_wp), &
      & other_unit_type('m', 'in', 0.0254_wp, custom=.true.), &
      & other_unit_type('m', 'mil', 2.54e-5_wp, custom=.true.), &
      & other_unit_type('kg', 'g', 1e-3_wp), &
      & other_unit_type('kg', 't', 1e3_wp), &
      & other_unit_type('kg', 'lb', 0.453592_wp, custom=.true.), &
      & other_unit_type('N', 'kN', 1e3_wp), &
      & other_unit_type('N', 'lbf', 4.44822_wp, custom=.true.), &
      & other_unit_type('rpm', 'rad/s', 9.549297_wp), &
      & other_unit_type('rpm', 'Hz', 60.0_wp, custom=.true.), &
      & other_unit_type('kg m', 'g mm', 1e-6_wp), &
      & other_unit_type('kg m', 'oz in', 7.2008e-4_wp, custom=.true.), &
      & other_unit_type('kg m^2', 'kg cm^2', 1e-4_wp), &
      & other_unit_type('kg m^2', 'kg mm^2', 1e-6_wp), &
      & other_unit_type('kg m^2', 'lb in^2', 2.9264e-4_wp, custom=.true.), &
      & other_unit_type('kg/m^3', 'g/cm^3', 1e3_wp), &
      & other_unit_type('kg/m^3', 'lb/in^3', 27679.9_wp, custom=.true.), &
      & other_unit_type('kg/m^3', 'lb/ft^3', 16.0185_wp, custom=.true.), &
      & other_unit_type('Pa', 'GPa', 1e9_wp), &
      & other_unit_type('Pa', 'MPa', 1e6_wp), &
      & other_unit_type('Pa', 'bar', 1e5_wp), &
      & other_unit_type('Pa', 'psi', 6894.76_wp, custom=.true.), &
      & other_unit_type('Pa s', 'mPa s', 1e-3_wp), &
      & other_unit_type('Pa s', 'reyn', 6894.76_wp, custom=.true.), &
      & other_unit_type('m^2/s', 'mm^2/s', 1e-6_wp), &
      & other_unit_type('J/(kg K)', 'kJ/(kg K)', 1e3_wp), &
      & other_unit_type('J/(kg K)', 'Btu/(lb F)', 4186.8_wp, custom=.true.), &
      & other_unit_type('W/(m K)', 'mW/(m K)', 1e-3_wp), &
      & other_unit_type('N/m', 'N/um', 1e6_wp), &
      & other_unit_type('N/m', 'lbf/in', 175.127_wp, custom=.true.), &
      & other_unit_type('deg', 'rad', 57.29578_wp), &
      & other_unit_type('C', 'K', 1.0_wp, -273.15_wp), &
      & other_unit_type('C', 'F', 5/9.0_wp, -160/9.0_wp, custom=.true.)]

   !> Numbers beyond it are mistakes of another kind.
   real(wp), parameter :: largest = 1e30_wp

contains

   !> "; 50.8 mm are 0.0508", of each kind of units the first in which a variable is within a range, which has the unit
   !> of the input, and of usual size; empty where there is none, or where the number itself is such.
   pure function in_other_units(x, name, unit, low, high) result(hint)
      real(wp), intent(in) :: x, low, high
      character(len=*), intent(in) :: name, unit
      character(len=:), allocatable :: hint
      type(usual_type) :: range
      logical :: found(2)
      integer :: i, kind
      hint = ''
      found = .false.
      range = usual_size(name, unit)
      range%low = max(low, range%low)
      range%high = min(high, range%high)
      if (x >= range%low .and. x <= range%high) return
      do i = 1, size(known)
         if (known(i)%of /= unit .or. abs(x) <= 0 .or. abs(x) > largest) cycle
         kind = merge(2, 1, known(i)%custom)
         associate (meant => known(i)%offset + known(i)%factor*x)
            if (found(kind) .or. meant < range%low .or. meant > range%high) cycle
            hint = hint//'; '//to_text(x)//' '//trim(known(i)%name)//' are '//to_text(meant)
         end associate
         found(kind) = .true.
      end do
   end function in_other_units

   !> Usual size of a variable "pads:front%density".
   pure type(usual_type) function usual_size(name, unit) result(found)
      character(len=*), intent(in) :: name, unit
      character(len=:), allocatable :: base
      integer :: first, i
      base = name
      first = scan(name, ':(')
      if (first > 0) base = name(:first - 1)//name(index(name, '%'):)
      do i = 1, size(usual)
         if (usual(i)%unit /= unit) cycle
         if (index(base, usual(i)%name(:len_trim(usual(i)%name))) /= 1) cycle
         found = usual(i)
         return
      end do
   end function usual_size
end module other_units
