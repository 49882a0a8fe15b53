!> The table that a study prints at its end: of its first and last runs what varied, and what an engineer asks first.
module study_digest
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_nan
   use kinds, only: wp, pi
   use text, only: to_text, fixed_text, lower_case
   use assignments, only: token_type, target_text, read_number
   use parameter_study, only: study_type
   use packet, only: packet_type, packet_of, text_type
   use study_layout, only: layout_type
   use study_row, only: study_row_type
   implicit none (type, external)
   private
   public :: study_digest_type, new_digest

   !> Rows from the beginning and from the end; most characters of a line.
   integer, parameter :: most_rows = 8, longest_line = 118
   !> Digits of a number.
   integer, parameter :: most_digits = 4

   !> A figure: its heading with the unit, the columns of a study that have it, the first that there is, with the place
   !> of its number in them, the factor of its unit, and which of a machine's bearings has it: the one with the least
   !> or with the greatest, or none.
   type :: figure_type
      character(len=16) :: heading
      character(len=80) :: columns
      integer :: place
      real(wp) :: factor
      character(len=8) :: of_bearings
   end type figure_type

   type(figure_type), parameter :: figures(*) = [ &
      & figure_type('orbit um', 'orbit_size', 1, 1e6_wp, 'greatest'), &
      & figure_type('e/c_r', 'equilibrium_eccentricity_ratio', 1, 1.0_wp, 'greatest'), &
      & figure_type('film um', 'min_film_thickness equilibrium_min_film_thickness', 1, 1e6_wp, 'least'), &
      & figure_type('pad C', 'equilibrium_maximum_temperature', 1, 1.0_wp, 'greatest'), &
      & figure_type('log dec', 'rotor_damping_ratio', 1, 1.0_wp, 'least'), &
      & figure_type('K_yy MN/m', 'stiffness', 1, 1e-6_wp, ''), figure_type('K_zz', 'stiffness', 4, 1e-6_wp, ''), &
      & figure_type('C_yy kN s/m', 'damping', 1, 1e-3_wp, ''), figure_type('C_zz', 'damping', 4, 1e-3_wp, ''), &
      & figure_type('peak MPa', 'max_pressure equilibrium_max_pressure', 1, 1e-6_wp, 'greatest'), &
      & figure_type('loss W', 'equilibrium_total_power_loss', 1, 1.0_wp, '')]
   !> This one is a logarithmic decrement, by the damping ratio.
   integer, parameter :: decrement = findloc(figures%heading, 'log dec', dim=1)
   !> Whether journal or shaft are stable.
   character(len=*), parameter :: stable = 'equilibrium_rotor_stable'
   character(len=*), parameter :: longest_word = '  unstable'

   !> What is kept of a run: its row, or why it has none.
   type :: kept_type
      integer :: run = 0
      logical :: there = .false.
      character(len=:), allocatable :: reason
      real(wp) :: values(size(figures)) = 0
      !> 1, 0 or no number.
      real(wp) :: stable = 0
   end type kept_type

   type :: study_digest_type
      private
      type(kept_type), allocatable :: kept(:)
   contains
      procedure :: take
      procedure :: print => print_table
   end type study_digest_type

contains

   !> For the runs that are wanted; for none where nothing is to be printed.
   function new_digest(wanted, quiet) result(digest)
      logical, intent(in) :: wanted(:), quiet
      type(study_digest_type) :: digest
      integer, allocatable :: runs(:)
      integer :: k
      runs = pack([(k, k=1, size(wanted))], wanted .and. .not. quiet)
      if (size(runs) > 2*most_rows) runs = [runs(:most_rows), runs(size(runs) - most_rows + 1:)]
      allocate (digest%kept(size(runs)))
      digest%kept%run = runs
   end function new_digest

   !> Keeps what a run says that has ended, if it is one of those that are shown.
   subroutine take(self, run, status, reason, row)
      class(study_digest_type), intent(inout) :: self
      integer, intent(in) :: run, status
      character(len=*), intent(in) :: reason
      type(study_row_type), intent(in) :: row
      type(layout_type) :: layout
      type(packet_type) :: packed
      integer :: at, i
      at = findloc(self%kept%run, run, dim=1)
      if (at == 0) return
      associate (kept => self%kept(at))
         kept%there = .true.
         kept%reason = ''
         if (status /= 0) kept%reason = reason
         if (status /= 0) return
         packed = packet_of(row%description)
         call layout%exchange(packed)
         do i = 1, size(figures)
            kept%values(i) = figures(i)%factor*number_of(layout, row%numbers, trim(figures(i)%columns), &
               & figures(i)%place, figures(i)%of_bearings)
         end do
         associate (ratio => kept%values(decrement))
            if (abs(ratio) < 1) then
               kept%values(decrement) = 2*pi*ratio/sqrt(1 - ratio**2)
            else
               kept%values(decrement) = ieee_value(1.0_wp, ieee_quiet_nan)
            end if
         end associate
         kept%stable = number_of(layout, row%numbers, stable, 1, 'least')
      end associate
   end subroutine take

   !> The number at a place of the first of some columns that a row has, of the bearings of a machine the least or
   !> greatest; no number where it has none.
   pure real(wp) function number_of(layout, numbers, columns, place, of_bearings) result(number)
      type(layout_type), intent(in) :: layout
      real(wp), intent(in) :: numbers(:)
      character(len=*), intent(in) :: columns, of_bearings
      integer, intent(in) :: place
      character(len=:), allocatable :: name
      integer :: first, i
      number = ieee_value(1.0_wp, ieee_quiet_nan)
      first = 1
      do while (first <= len(columns) .and. ieee_is_nan(number))
         name = columns(first:first + index(columns(first:)//' ', ' ') - 2)
         first = first + len(name) + 1
         do i = 1, size(layout%columns)
            associate (own => layout%columns(i))
               if (own%width < place .or. .not. is_meant(own%name)) cycle
               associate (x => numbers(own%before + place))
                  if (ieee_is_nan(number) .or. (x < number .eqv. of_bearings == 'least')) number = x
               end associate
            end associate
         end do
      end do
   contains
      !> Whether a column has this name, or has it behind that of a bearing.
      pure logical function is_meant(column)
         character(len=*), intent(in) :: column
         integer :: slash
         slash = merge(index(column, '/', back=.true.), 0, of_bearings /= '')
         is_meant = column(slash + 1:) == name
      end function is_meant
   end function number_of

   !> Prints the table; nothing where it would have no figures.
   subroutine print_table(self, study)
      class(study_digest_type), intent(in) :: self
      type(study_type), intent(in) :: study
      type(kept_type), allocatable :: kept(:)
      type(text_type), allocatable :: lines(:), cells(:)
      type(token_type) :: token
      integer :: i, k
      allocate (kept(0))
      if (allocated(self%kept)) kept = pack(self%kept, self%kept%there)
      if (all([(kept(k)%reason /= '', k=1, size(kept))])) return
      allocate (lines(0:size(kept)), cells(0:size(kept)))
      cells(0)%text = 'run'
      do k = 1, size(kept)
         cells(k)%text = to_text(kept(k)%run)
      end do
      do k = 0, size(kept)
         lines(k)%text = ''
      end do
      call add_column(cells, lines)
      do i = 1, size(study%varied%variables)
         cells(0)%text = short(target_text(study%varied%variables(i)%target))
         do k = 1, size(kept)
            call study%varied%value(i, kept(k)%run, token)
            cells(k)%text = value_text(token)
         end do
         call add_column(cells, lines)
      end do
      do i = 1, size(figures)
         if (all(ieee_is_nan(kept%values(i)) .or. [(kept(k)%reason /= '', k=1, size(kept))])) cycle
         cells(0)%text = trim(figures(i)%heading)
         do k = 1, size(kept)
            cells(k)%text = number_text(kept(k)%values(i))
            if (kept(k)%reason /= '' .or. ieee_is_nan(kept(k)%values(i))) cells(k)%text = '-'
         end do
         call add_column(cells, lines)
      end do
      call add_stability(kept, lines)
      call print_lines(kept, lines)
   end subroutine print_table

   !> "stable" or "unstable", where it is known of a run; why a run has no figures.
   subroutine add_stability(kept, lines)
      type(kept_type), intent(in) :: kept(:)
      type(text_type), intent(inout) :: lines(0:)
      integer :: k
      do k = 1, size(kept)
         if (kept(k)%reason /= '') then
            lines(k)%text = trim(lines(k)%text)//'  '//kept(k)%reason
         else if (.not. ieee_is_nan(kept(k)%stable)) then
            lines(k)%text = lines(k)%text//'  '//trim(merge('stable  ', 'unstable', kept(k)%stable > 0))
         end if
      end do
   end subroutine add_stability

   !> Prints the lines, each cut where it is too long, and between the first and the last runs how many there are.
   subroutine print_lines(kept, lines)
      type(kept_type), intent(in) :: kept(:)
      type(text_type), intent(in) :: lines(0:)
      integer :: k
      do k = 0, size(kept)
         if (kept(max(1, k))%run > kept(max(1, k - 1))%run + 1) print '(a)', '  ...'
         print '(a)', lines(k)%text(:min(len(lines(k)%text), longest_line))
      end do
   end subroutine print_lines

   !> Adds a column to the lines, flush right, unless they are too long then.
   subroutine add_column(cells, lines)
      type(text_type), intent(in) :: cells(0:)
      type(text_type), intent(inout) :: lines(0:)
      integer :: width, k
      width = maxval([(len(cells(k)%text), k=0, size(cells) - 1)])
      if (len(lines(0)%text) + 2 + width + len(longest_word) > longest_line) return
      do k = 0, size(cells) - 1
         lines(k)%text = lines(k)%text//repeat(' ', 2 + width - len(cells(k)%text))//cells(k)%text
      end do
   end subroutine add_column

   !> A number with its digits, of large ones the whole part.
   pure function number_text(x) result(text)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: text
      text = fixed_text(x, max(0, min(most_digits, most_digits - 1 - floor(log10(max(abs(x), tiny(x)))))))
      if (text(len(text):) == '.') text = text(:len(text) - 1)
   end function number_text

   !> A value of a variable as the study has it; of a number the first digits.
   function value_text(token) result(text)
      type(token_type), intent(in) :: token
      character(len=:), allocatable :: text
      real(wp) :: x
      logical :: ok
      text = token%text
      call read_number(lower_case(text), x, ok)
      if (ok) text = to_text(x)
   end function value_text

   !> A variable without its group, but with the name of its bearing or the number of its group.
   pure function short(variable) result(text)
      character(len=*), intent(in) :: variable
      character(len=:), allocatable :: text
      associate (group => variable(:index(variable, '%') - 1), name => variable(index(variable, '%') + 1:))
         text = name
         if (scan(group, ':(') > 0) text = group//'%'//name
      end associate
   end function short
end module study_digest
