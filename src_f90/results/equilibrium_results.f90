!> What the file of a run says of its equilibrium: names, dimensions and units as docs/results.md lists them.
module equilibrium_results
   use hdf5_file, only: hdf5_type
   use equilibrium, only: equilibrium_type
   implicit none (type, external)
   private
   public :: put_equilibrium

contains

   !> Writes an equilibrium; `tilting` where the pads have tilts, `radial` where they have penetrations.
   subroutine put_equilibrium(file, found, tilting, radial)
      type(hdf5_type), intent(inout) :: file
      type(equilibrium_type), intent(in) :: found
      logical, intent(in) :: tilting, radial
      call file%make_group('equilibrium')
      call file%put_real('equilibrium/journal_y', found%journal(1), 'm', 'journal displacement, vertical')
      call file%put_real('equilibrium/journal_z', found%journal(2), 'm', 'journal displacement, horizontal')
      if (tilting) call file%put_list('equilibrium/pad_tilt', found%tilt, 'rad', 'pad tilt', 'pad')
      if (radial) call file%put_list('equilibrium/pad_penetration', found%penetration, 'm', &
         & 'pivot penetration', 'pad')
      if (tilting) call file%put_list('equilibrium/contact_force', found%contact_force, 'N', 'pivot contact force', &
         & 'pad')
      call file%put_list('equilibrium/min_film_thickness', found%min_film_thickness, 'm', &
         & 'minimum film thickness', 'pad')
      call file%put_list('equilibrium/max_pressure', found%max_pressure, 'Pa', 'maximum film pressure', 'pad')
      call file%put_real('equilibrium/residual', found%residual, '1', 'unbalanced force over load')
      call file%put_real('equilibrium/eigenvalue_real', found%stability%eigenvalue%re, '1/s', &
         & 'growth of the small motion that grows most')
      call file%put_real('equilibrium/eigenvalue_imag', found%stability%eigenvalue%im, '1/s', &
         & 'angular frequency of the small motion that grows most')
      call file%put_text('equilibrium_stability', found%stability%name)
   end subroutine put_equilibrium
end module equilibrium_results
