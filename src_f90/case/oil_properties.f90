!> Viscosity and density of the oil over its temperature, in degrees Celsius.
!>
!> walther:      log10 log10 (nu + 0.7) = A - B log10 T, nu in mm^2/s and T in K, through two points; mu = nu rho(T).
!> exponential:  mu = mu_ref exp(-beta (T - T_ref)).
!> constant:     bearing%viscosity, whatever the temperature.
module oil_properties
   use kinds, only: wp
   use case_groups, only: bearing_type, oil_type, temperature_range, is_set
   implicit none (type, external)
   private
   public :: viscosity, viscosities, viscosity_slope, density, reference_viscosity, kinematic_points, grades

   !> ISO viscosity grades (ISO 3448): kinematic viscosity in the middle of the grade at 40 C, mm^2/s.
   integer, parameter :: grades(16) = [10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500, 2200, 3200]
   !> Theirs at 100 C with viscosity index 100, mm^2/s: where H of ASTM D2270 (equations of its appendix X2) is the
   !> viscosity at 40 C.
   real(wp), parameter :: grades_at_100(16) = [2.6590_wp, 3.4098_wp, 4.2937_wp, 5.3621_wp, 6.7617_wp, 8.7320_wp, &
      & 11.3811_wp, 15.0217_wp, 19.4376_wp, 24.9504_wp, 31.7699_wp, 41.1339_wp, 52.7792_wp, 68.3405_wp, 86.7899_wp, &
      & 109.0925_wp]
   real(wp), parameter :: zero_celsius = 273.15_wp
   !> Largest ln(nu + 0.7), nu in mm^2/s: cold oil stays a number.
   real(wp), parameter :: largest_log = 70
   !> Temperature of the density that is given, C.
   real(wp), parameter :: density_temperature = 15

   !> A and B of Walther's law.
   type :: walther_line
      real(wp) :: a = 0, b = 0
   end type walther_line

contains

   !> Dynamic viscosity, Pa s, by the laws walther and exponential; beyond the temperatures that the input allows it is
   !> that of the nearest of them.
   elemental real(wp) function viscosity(oil, temperature)
      type(oil_type), intent(in) :: oil
      real(wp), intent(in) :: temperature
      viscosity = viscosity_by(oil, line_of(oil), temperature)
   end function viscosity

   !> Those of a field: Walther's line costs several times a point on it.
   pure function viscosities(oil, temperature)
      type(oil_type), intent(in) :: oil
      real(wp), intent(in) :: temperature(:, :)
      real(wp) :: viscosities(size(temperature, 1), size(temperature, 2))
      type(walther_line) :: line
      line = line_of(oil)
      viscosities = viscosity_by(oil, line, temperature)
   end function viscosities

   elemental real(wp) function viscosity_by(oil, line, temperature) result(viscosity)
      type(oil_type), intent(in) :: oil
      type(walther_line), intent(in) :: line
      real(wp), intent(in) :: temperature
      real(wp) :: t
      t = allowed(temperature)
      if (oil%law == 'walther') then
         viscosity = 1e-6_wp*(exp(walther_log(line, t)) - 0.7_wp)*density(oil, t)
      else
         viscosity = oil%reference_viscosity*exp(-oil%temperature_exponent*(t - oil%reference_temperature))
      end if
   end function viscosity_by

   !> Derivative of the viscosity over the temperature, Pa s/K.
   elemental real(wp) function viscosity_slope(oil, temperature)
      type(oil_type), intent(in) :: oil
      real(wp), intent(in) :: temperature
      type(walther_line) :: line
      real(wp) :: log_nu
      viscosity_slope = 0
      if (abs(allowed(temperature) - temperature) > 0) return
      if (oil%law == 'walther') then
         line = line_of(oil)
         log_nu = walther_log(line, temperature)
         viscosity_slope = 1e-6_wp*(oil%density_slope*(exp(log_nu) - 0.7_wp) &
            & - density(oil, temperature)*exp(log_nu)*log_nu*line%b/(temperature + zero_celsius))
      else
         viscosity_slope = -oil%temperature_exponent*viscosity(oil, temperature)
      end if
   end function viscosity_slope

   !> Density, kg/m^3, that makes Walther's kinematic viscosity a dynamic one. The heat balance takes the constant
   !> `oil%density` instead.
   elemental real(wp) function density(oil, temperature)
      type(oil_type), intent(in) :: oil
      real(wp), intent(in) :: temperature
      density = oil%density
      if (is_set(oil%density_at_15)) density = oil%density_at_15
      density = density + oil%density_slope*(temperature - density_temperature)
   end function density

   !> The viscosity that films of a bearing have without a heat balance, Pa s: bearing%viscosity where the law is
   !> constant, else that at the supply temperature.
   pure real(wp) function reference_viscosity(bearing)
      type(bearing_type), intent(in) :: bearing
      if (bearing%oil%law == 'constant') then
         reference_viscosity = bearing%viscosity
      else
         reference_viscosity = viscosity(bearing%oil, bearing%oil%supply_temperature)
      end if
   end function reference_viscosity

   !> Kinematic viscosities, m^2/s, at the two temperatures of Walther's law: as given, or those of a grade.
   pure function kinematic_points(oil) result(points)
      type(oil_type), intent(in) :: oil
      real(wp) :: points(2)
      integer :: i
      points = oil%kinematic_viscosity
      i = findloc(abs(grades - oil%grade) <= 0, .true., dim=1)
      if (i > 0) points = 1e-6_wp*[real(grades(i), wp), grades_at_100(i)]
   end function kinematic_points

   !> ln(nu + 0.7) of Walther's law, nu in mm^2/s.
   elemental real(wp) function walther_log(line, temperature)
      type(walther_line), intent(in) :: line
      real(wp), intent(in) :: temperature
      walther_log = log(10.0_wp)*10**min(line%a - line%b*log10(temperature + zero_celsius), log10(largest_log))
      walther_log = min(walther_log, largest_log)
   end function walther_log

   !> A and B of Walther's law; 0 of another.
   pure type(walther_line) function line_of(oil) result(line)
      type(oil_type), intent(in) :: oil
      real(wp) :: ends(2), log_t(2)
      if (oil%law /= 'walther') return
      ends = log10(log10(1e6_wp*kinematic_points(oil) + 0.7_wp))
      log_t = log10(oil%at_temperature + zero_celsius)
      line%b = (ends(1) - ends(2))/(log_t(2) - log_t(1))
      line%a = ends(1) + line%b*log_t(1)
   end function line_of

   !> The temperature, or the nearest that the input allows.
   elemental real(wp) function allowed(temperature)
      real(wp), intent(in) :: temperature
      allowed = min(max(temperature, temperature_range(1)), temperature_range(2))
   end function allowed
end module oil_properties
