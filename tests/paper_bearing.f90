!> The paper's bearing (Dyk et al. 2023, Tables 1 and 2) as the modules take it that know no case.
module paper_bearing
   use kinds, only: wp, degree
   use film_solver, only: film_oil
   use pad_gap, only: pad_gap_type
   use contact_law, only: contact_law_type, make_contact_law
   implicit none (type, external)
   private
   public :: paper_pad, offset_pad, paper_law
   public :: speed, clearance, paper_oil, uneven

   !> Shaft speed of 6,494 rpm, rad/s; pad clearance, m.
   real(wp), parameter :: speed = 680, clearance = 100e-6_wp
   !> The oil of its films.
   type(film_oil), parameter :: paper_oil = film_oil(19e-3_wp)
   !> Oil that becomes three times thinner along the arc and is warmer at the pad than at the journal.
   type(film_oil), parameter :: uneven = film_oil(19e-3_wp, .true., [0.1_wp, 0.5_wp, 0.05_wp, -0.06_wp, 0.02_wp], &
      & [0.53_wp, 0.03_wp, 0.004_wp, -0.007_wp, 0.002_wp], [-0.1_wp, -0.5_wp, 0.02_wp, 0.05_wp, 0.01_wp])

contains

   !> A pad with pressures (default: none) at the leading edge, at the others and where the film cavitates, and an axial
   !> length (default: the paper's).
   pure type(pad_gap_type) function paper_pad(pressures, length)
      real(wp), intent(in), optional :: pressures(3), length
      paper_pad = pad_gap_type(49.9e-3_wp, clearance, 0.1_wp, 0.5_wp*69.3_wp*degree, 0.5_wp*69.3_wp*degree, 0.0_wp, &
         & 0.0_wp, 0.0_wp)
      if (present(pressures)) then
         paper_pad%supply_pressure = pressures(1)
         paper_pad%ambient_pressure = pressures(2)
         paper_pad%cavitation_pressure = pressures(3)
      end if
      if (present(length)) paper_pad%axial_length = length
   end function paper_pad

   !> The same with the pivot behind the middle, 40 and 30 degrees from the edges, so that nothing is symmetric.
   pure type(pad_gap_type) function offset_pad(pressures, length)
      real(wp), intent(in), optional :: pressures(3), length
      offset_pad = paper_pad(pressures, length)
      offset_pad%leading_angle = 40*degree
      offset_pad%trailing_angle = 30*degree
   end function offset_pad

   !> The contact of ball and socket of steel, by law, difference of their radii, m, and factor of eq (13) (default: as
   !> printed).
   function paper_law(name, difference, factor) result(law)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: difference
      real(wp), intent(in), optional :: factor
      class(contact_law_type), allocatable :: law
      real(wp) :: used
      used = 4
      if (present(factor)) used = factor
      call make_contact_law(name, 13e-3_wp, difference, [2.1e11_wp, 2.1e11_wp], [0.3_wp, 0.3_wp], used, law)
   end function paper_law
end module paper_bearing
