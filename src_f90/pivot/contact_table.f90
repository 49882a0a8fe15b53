!> The contact law tabulated over the pivot deflection, for constant-time lookup.
!>
!> Every octave of the pivot deflection is cut into `2**bits` equal cells, so the leading bits of the
!> floating-point number are the cell's index. In each cell the force is the cubic that meets the
!> law's force and stiffness at both ends: force and stiffness are continuous. The relative error of the force is
!> the same in all logarithmic_grid, about (2**-bits)**4/384 times eta**4 F''''/F, below 1e-6 by far: 3e-8.
!>
!> The table costs five hundred evaluations of the law, so where there are few lookups it is left out: the law itself
!> answers.
module contact_table
   use kinds, only: wp, i8
   use contact_law, only: contact_law_type, contact_point
   implicit none (type, external)
   private
   public :: contact_table_type, new_contact_table, new_untabulated_contact

   !> Cells per octave: 2**bits. Octaves covered: 2**first to 2**(last+1) metres.
   integer, parameter :: bits = 4, first = -40, last = -7
   !> Position of the index bits in a 64-bit real.
   integer, parameter :: shift = 52 - bits
   integer, parameter :: bias = 1023
   !> Index of the lowest cell.
   integer(i8), parameter :: base = int(bias + first, i8)*2_i8**bits
   integer, parameter :: n_cells = (last - first + 1)*2**bits

   !> Force and stiffness of one pivot over the pivot deflection.
   type :: contact_table_type
      class(contact_law_type), allocatable :: law
      !> Cubic coefficients (4) of each cell over its width; not allocated where the law itself answers.
      real(wp), allocatable, private :: cubic(:, :)
      !> Lower end and one over the width of each cell, m and 1/m.
      real(wp), allocatable, private :: start(:), per_width(:)
      !> Local power law below the lowest cell; straight line above the highest.
      real(wp), private :: low_exponent = 1
      type(contact_point), private :: low_end, high_end
   contains
      !> Force, N, and stiffness, N/m, at a pivot deflection, m; both zero where it is not positive.
      procedure :: lookup
   end type contact_table_type

contains

   !> Tabulates a law.
   pure function new_contact_table(law) result(table)
      class(contact_law_type), intent(in) :: law
      type(contact_table_type) :: table
      type(contact_point) :: left, right
      real(wp) :: x, width
      integer :: k
      table = new_untabulated_contact(law)
      allocate (table%cubic(4, 0:n_cells - 1), table%start(0:n_cells - 1), table%per_width(0:n_cells - 1))
      right = table%low_end
      do k = 0, n_cells - 1
         left = right
         x = cell_start(k)
         width = cell_start(k + 1) - x
         right = law%at(x + width)
         table%start(k) = x
         table%per_width(k) = 1/width
         associate (f0 => left%force, s0 => left%stiffness*width, f1 => right%force, s1 => right%stiffness*width)
            table%cubic(:, k) = [f0, s0, 3*(f1 - f0) - 2*s0 - s1, 2*(f0 - f1) + s0 + s1]
         end associate
      end do
   end function new_contact_table

   !> The same without a table: between its ends the law itself answers.
   pure function new_untabulated_contact(law) result(table)
      class(contact_law_type), intent(in) :: law
      type(contact_table_type) :: table
      allocate (table%law, source=law)
      table%low_end = law%at(cell_start(0))
      table%low_exponent = table%low_end%stiffness*cell_start(0)/table%low_end%force
      table%high_end = law%at(cell_start(n_cells))
   end function new_untabulated_contact

   pure subroutine lookup(self, pivot_deflection, force, stiffness)
      class(contact_table_type), intent(in) :: self
      real(wp), intent(in) :: pivot_deflection
      real(wp), intent(out) :: force, stiffness
      type(contact_point) :: point
      integer(i8) :: k
      real(wp) :: t, d
      force = 0
      stiffness = 0
      if (.not. pivot_deflection > 0) return
      k = shiftr(transfer(pivot_deflection, 1_i8), shift) - base
      if (k < 0) then
         force = self%low_end%force*(pivot_deflection/cell_start(0))**self%low_exponent
         stiffness = force*self%low_exponent/pivot_deflection
      else if (k >= n_cells) then
         d = pivot_deflection - cell_start(n_cells)
         force = self%high_end%force + self%high_end%stiffness*d
         stiffness = self%high_end%stiffness
      else if (.not. allocated(self%cubic)) then
         point = self%law%at(pivot_deflection)
         force = point%force
         stiffness = point%stiffness
      else
         associate (c => self%cubic(:, k))
            t = (pivot_deflection - self%start(k))*self%per_width(k)
            force = c(1) + t*(c(2) + t*(c(3) + t*c(4)))
            stiffness = (c(2) + t*(2*c(3) + t*3*c(4)))*self%per_width(k)
         end associate
      end if
   end subroutine lookup

   !> Lower end of cell k, m: the real whose leading bits are the index.
   elemental function cell_start(k) result(x)
      integer, intent(in) :: k
      real(wp) :: x
      x = transfer(shiftl(base + k, shift), x)
   end function cell_start
end module contact_table
