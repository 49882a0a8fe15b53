!> The input variables of the groups excitation.
module excitation_fields
   use kinds, only: wp
   use excitations, only: excitation_type
   use variable_table, only: variable_table_type
   use machine_names, only: counted
   use machine_fields, only: list_station
   implicit none (type, external)
   private
   public :: list_excitations

contains

   !> Those of all excitations; `numbered`, each with its number, and with their stations.
   subroutine list_excitations(excitations, v, numbered, stations)
      type(excitation_type), intent(inout) :: excitations(:)
      type(variable_table_type), intent(inout) :: v
      logical, intent(in) :: numbered, stations
      integer :: i
      do i = 1, size(excitations)
         if (numbered) call v%behind_group(counted(i))
         call v%group('excitation', 'A force over time on the rotor, for the tasks march and periodic; one group for ' &
            & //'each; *Excitation* above')
         if (stations) call list_station(excitations(i)%station, v)
         call list_excitation(excitations(i), v)
      end do
      call v%behind_group('')
   end subroutine list_excitations

   subroutine list_excitation(x, v)
      type(excitation_type), intent(inout) :: x
      type(variable_table_type), intent(inout) :: v
      call v%word(x%kind, 'kind', 'harmonic chirp step ramp table', &
         & 'harmonic: a vibration; chirp: one whose frequency changes linearly; step: constant from start to end; ' &
         & //'ramp: from 0 at start to amplitude at end, which it keeps; table: forces from a file')
      call v%number(x%amplitude, 'amplitude', 0.0_wp, 1e12_wp, 'N', 'amplitude of the force; not of a table')
      call v%number(x%direction_deg, 'direction_deg', -360.0_wp, 360.0_wp, 'deg', &
         & 'direction, from +y towards +z; of a rotating force at phase 0')
      call v%word(x%rotating, 'rotating', 'no forward backward', &
         & 'harmonic, chirp: whether the force turns, with the shaft or against it; no: it keeps its direction')
      call v%number(x%frequency_hz, 'frequency_hz', 1e-6_wp, 1e7_wp, 'Hz', &
         & 'harmonic: frequency; chirp: frequency at start')
      call v%number(x%frequency_ratio, 'frequency_ratio', 1e-6_wp, 1e6_wp, '1', &
         & 'harmonic: frequency over the speed of the shaft, instead of frequency_hz')
      call v%number(x%final_frequency_hz, 'final_frequency_hz', 1e-6_wp, 1e7_wp, 'Hz', 'chirp: frequency at end')
      call v%number(x%phase_deg, 'phase_deg', -360.0_wp, 360.0_wp, 'deg', &
         & 'harmonic, chirp: phase at start, where 0 is the whole amplitude')
      call v%number(x%start, 'start', 0.0_wp, 1e6_wp, 's', 'when it begins; of a table the time 0')
      call v%number(x%end, 'end', 0.0_wp, 1e6_wp, 's', 'when it ends; if left out, not before the run (chirp, ramp: ' &
         & //'with operation%duration)')
      call v%word(x%file, 'file', '', 'table: CSV file of the columns time, force_y, force_z, in s and N')
   end subroutine list_excitation
end module excitation_fields
