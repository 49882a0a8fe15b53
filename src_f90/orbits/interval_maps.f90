!> How the points of an orbit's intervals follow from the state at their start: the linear equations of each interval,
!> eliminated. States stand in a border, which all others depend on, and in blocks (the pads of a bearing), which depend
!> on the border and on themselves alone. So the work and the memory of an interval grow with the number of blocks, and
!> neither with its cube nor with its square. Displacements x, x' = v, follow from their rates and are no unknowns.
module interval_maps
   use kinds, only: wp
   use linear_algebra, only: simd_width, padded, apply
   use ode_model, only: ode_model_type
   use orbit_polynomials, only: points
   implicit none (type, external)
   private
   public :: interval_maps_type, new_interval_maps, weight

   real(wp), parameter :: s6 = sqrt(6.0_wp)
   !> The integrals of the points' polynomials up to each point.
   real(wp), parameter :: weight(points, points) = reshape([(88 - 7*s6)/360, (296 + 169*s6)/1800, (16 - s6)/36, &
      & (296 - 169*s6)/1800, (88 + 7*s6)/360, (16 + s6)/36, (-2 + 3*s6)/225, (-2 - 3*s6)/225, 1/9.0_wp], &
      & [points, points])

   !> The border or a block: its states, counted in itself; displacements and the rates of these, all states but the
   !> displacements, and where the rates stand among them.
   type :: part_type
      integer :: n = 0
      integer, allocatable :: x(:), v(:), u(:), v_in_u(:)
   end type part_type

   !> The unknowns of an interval are the u of all its points, point by point, over the scales.
   type :: interval_maps_type
      private
      !> States, blocks; what is added to the equations of an interval (columns of its `gap`).
      integer :: n = 0, blocks = 0, constants = 0
      type(part_type) :: border, block
      !> Where displacements and their rates stand among the states, and which displacement a state is; scales of the
      !> rates over theirs.
      integer, allocatable :: x(:), v(:), number(:)
      real(wp), allocatable :: ratio(:)
      !> How the unknowns follow, per interval: those of the border from all states at the start and the constants,
      !> (state or constant, unknown, interval); those of a block from the unknowns of the border, the states of
      !> the border and its own at the start, and the constants, (.., unknown, block, interval).
      real(wp), allocatable :: of_border(:, :, :), of_block(:, :, :, :)
      !> Length of each interval, s, and what its equations of displacements lack, (constant, x, point, interval).
      real(wp), allocatable :: length(:), gap(:, :, :, :)
   contains
      procedure :: eliminate
      procedure :: follow
   end type interval_maps_type

contains

   !> Room for a number of intervals of a model, with these scales of its states, and a number of constants.
   function new_interval_maps(model, scale, intervals, constants) result(maps)
      class(ode_model_type), intent(in) :: model
      real(wp), intent(in) :: scale(:)
      integer, intent(in) :: intervals, constants
      type(interval_maps_type) :: maps
      integer :: in_block, i
      maps%n = model%n
      maps%constants = constants
      call model%pairs(maps%x, maps%v)
      call model%blocks(maps%blocks, in_block)
      maps%number = [(findloc(maps%x, i, dim=1), i=1, model%n)]
      maps%ratio = scale(maps%v)/scale(maps%x)
      maps%border = new_part(maps, 0, model%n - maps%blocks*in_block)
      maps%block = new_part(maps, maps%border%n, in_block)
      associate (per_border => points*size(maps%border%u), per_block => points*size(maps%block%u))
         allocate (maps%of_border(padded(model%n + constants), per_border, intervals))
         allocate (maps%of_block(padded(per_border + maps%border%n + in_block + constants), per_block, maps%blocks, &
            & intervals))
      end associate
      allocate (maps%length(intervals), maps%gap(constants, size(maps%x), points, intervals))
   end function new_interval_maps

   !> The part of these n states that follows this number of states.
   pure type(part_type) function new_part(maps, before, n) result(part)
      type(interval_maps_type), intent(in) :: maps
      integer, intent(in) :: before, n
      logical :: mine(size(maps%x))
      integer :: i
      part%n = n
      mine = maps%x > before .and. maps%x <= before + n
      part%x = pack(maps%x, mine) - before
      part%v = pack(maps%v, mine) - before
      part%u = pack([(i, i=1, n)], [(all(part%x /= i), i=1, n)])
      part%v_in_u = [(findloc(part%u, part%v(i), dim=1), i=1, size(part%v))]
   end function new_part

   !> Takes the equations of interval k, of this length, s: the derivatives of the rates over the scales and times the
   !> length, and what the equations lack, (state, constant, point). Not ok where they have no solution.
   subroutine eliminate(self, k, length, jacobian, gap, ok)
      class(interval_maps_type), intent(inout) :: self
      integer, intent(in) :: k
      real(wp), intent(in) :: length, jacobian(:, :, :), gap(:, :, :)
      logical, intent(out) :: ok
      real(wp) :: rows(padded(points*size(self%border%u) + self%n + self%constants), points*size(self%border%u))
      real(wp) :: across(points*size(self%block%u), points*size(self%border%u))
      real(wp) :: sum(size(self%of_block, 1))
      integer :: columns(points*size(self%border%u) + self%border%n + self%block%n + self%constants)
      integer :: i, l, r, from
      self%length(k) = length
      do i = 1, points
         self%gap(:, :, i, k) = transpose(gap(self%x, :, i))
      end do
      associate (n => self%n, b => self%border, p => self%block, u => points*size(self%border%u), &
         & all => points*size(self%border%u) + self%n + self%constants)
         rows = 0
         call couple(self, k, b%u, jacobian, b, 0, rows(:u, :), rows(u + 1:u + b%n, :), rows(u + n + 1:all, :))
         call add_own(b, b%u, gap, rows(u + 1:u + b%n, :), rows(u + n + 1:all, :))
         do l = 1, self%blocks
            from = b%n + (l - 1)*p%n
            call eliminate_block(self, k, l, jacobian, gap, ok)
            if (.not. ok) return
            across = 0
            call couple(self, k, b%u, jacobian, p, from, across, rows(u + from + 1:u + from + p%n, :), &
               & rows(u + n + 1:all, :))
            ! where what the block's unknowns follow from stands in the rows
            columns = [(i, i=1, u + b%n), (i, i=u + from + 1, u + from + p%n), (i, i=u + n + 1, all)]
            do r = 1, u
               sum = apply(size(sum), size(across, 1), self%of_block(:, :, l, k), across(:, r))
               do i = 1, size(columns)
                  rows(columns(i), r) = rows(columns(i), r) + sum(i)
               end do
            end do
         end do
         call reduce(size(rows, 1), u, rows, ok)
         self%of_border(:, :, k) = 0
         self%of_border(:all - u, :, k) = rows(u + 1:all, :)
      end associate
   end subroutine eliminate

   !> The unknowns of block l in interval k, through those of the border.
   subroutine eliminate_block(self, k, l, jacobian, gap, ok)
      type(interval_maps_type), intent(inout) :: self
      integer, intent(in) :: k, l
      real(wp), intent(in) :: jacobian(:, :, :), gap(:, :, :)
      logical, intent(out) :: ok
      real(wp) :: rows(padded(points*size(self%block%u) + size(self%of_block, 1)), points*size(self%block%u))
      integer :: own, other, starts, constants, all, from
      associate (b => self%border, p => self%block)
         from = b%n + (l - 1)*p%n
         own = points*size(p%u)
         other = own + points*size(b%u)
         starts = other + b%n
         constants = starts + p%n
         all = constants + self%constants
         rows = 0
         call couple(self, k, from + p%u, jacobian, p, from, rows(:own, :), rows(starts + 1:constants, :), &
            & rows(constants + 1:all, :))
         call couple(self, k, from + p%u, jacobian, b, 0, rows(own + 1:other, :), rows(other + 1:starts, :), &
            & rows(constants + 1:all, :))
         call add_own(p, from + p%u, gap, rows(starts + 1:constants, :), rows(constants + 1:all, :))
         call reduce(size(rows, 1), own, rows, ok)
         self%of_block(:, :, l, k) = rows(own + 1:own + size(self%of_block, 1), :)
      end associate
   end subroutine eliminate_block

   !> Adds what a part, which begins behind `from` states, does to the rates of the states `rated`, integrated up to
   !> each point: by its unknowns, by its states at the start, and by the constants of its displacements.
   pure subroutine couple(self, k, rated, jacobian, part, from, unknowns, starts, constants)
      type(interval_maps_type), intent(in) :: self
      integer, intent(in) :: k, rated(:), from
      real(wp), intent(in) :: jacobian(:, :, :)
      type(part_type), intent(in) :: part
      real(wp), intent(inout) :: unknowns(:, :), starts(:, :), constants(:, :)
      real(wp) :: per_x(points)
      integer :: i, j, l, r, s, row, m, x
      m = size(part%u)
      do j = 1, points
         do s = 1, m
            do r = 1, size(rated)
               do i = 1, points
                  row = (i - 1)*size(rated) + r
                  unknowns((j - 1)*m + s, row) = unknowns((j - 1)*m + s, row) &
                     & + weight(i, j)*jacobian(rated(r), from + part%u(s), j)
               end do
            end do
         end do
      end do
      do s = 1, size(part%x)
         x = self%number(from + part%x(s))
         do r = 1, size(rated)
            do i = 1, points
               row = (i - 1)*size(rated) + r
               per_x = weight(i, :)*jacobian(rated(r), from + part%x(s), :)
               starts(part%x(s), row) = starts(part%x(s), row) + sum(per_x)
               do l = 1, self%constants
                  constants(l, row) = constants(l, row) + sum(per_x*self%gap(l, x, :, k))
               end do
               per_x = self%length(k)*self%ratio(x)*per_x
               do l = 1, points
                  associate (at => (l - 1)*m + part%v_in_u(s))
                     unknowns(at, row) = unknowns(at, row) + sum(per_x*weight(:, l))
                  end associate
               end do
            end do
         end do
      end do
   end subroutine couple

   !> Adds the part's own states at the start, and what its equations lack; its unknowns are these states.
   pure subroutine add_own(part, states, gap, starts, constants)
      type(part_type), intent(in) :: part
      integer, intent(in) :: states(:)
      real(wp), intent(in) :: gap(:, :, :)
      real(wp), intent(inout) :: starts(:, :), constants(:, :)
      integer :: i, r, row
      do i = 1, points
         do r = 1, size(states)
            row = (i - 1)*size(states) + r
            starts(part%u(r), row) = starts(part%u(r), row) + 1
            constants(:, row) = constants(:, row) + gap(states(r), :, i)
         end do
      end do
   end subroutine add_own

   !> Of n rows held side by side, of unknowns x = A x + B, A in their first n columns: the same of x = B. Gauss-Jordan
   !> elimination, each row with the largest pivot: for a pad n is 9 or so, and LAPACK is slower on systems this small.
   pure subroutine reduce(width, n, rows, ok)
      integer, intent(in) :: width, n
      real(wp), intent(inout) :: rows(width, n)
      logical, intent(out) :: ok
      real(wp) :: swapped(width), factor
      integer :: i, j, k, l, first, best
      ok = .false.
      do i = 1, n
         rows(:n, i) = -rows(:n, i)
         rows(i, i) = rows(i, i) + 1
      end do
      do i = 1, n
         best = i
         do j = i + 1, n
            if (abs(rows(i, j)) > abs(rows(i, best))) best = j
         end do
         if (.not. abs(rows(i, best)) > 0) return
         swapped = rows(:, best)
         rows(:, best) = rows(:, i)
         rows(:, i) = (1/swapped(i))*swapped
         ! whole SIMD vectors, from that with number i; those before it are no longer read
         first = simd_width*((i - 1)/simd_width)
         do j = 1, n
            if (j == i) cycle
            factor = rows(i, j)
            do l = first, width - 1, simd_width
               !$omp simd
               do k = 1, simd_width
                  rows(l + k, j) = rows(l + k, j) - factor*rows(l + k, i)
               end do
            end do
         end do
      end do
      ok = .true.
   end subroutine reduce

   !> Changes of the points of interval k, from point `first` on, that follow from changes at its start, all over the
   !> scales: (column, state or constant), (column, state, point); one column, or whole SIMD vectors of them.
   pure subroutine follow(self, k, first, start, at)
      class(interval_maps_type), intent(in) :: self
      integer, intent(in) :: k, first
      real(wp), intent(in), contiguous :: start(:, :)
      real(wp), intent(out), contiguous :: at(:, :, :)
      real(wp) :: seen(size(start, 1), points*size(self%border%u) + self%border%n + self%block%n + self%constants)
      integer :: i, j, l, x, u, from, own
      associate (b => self%border, p => self%block)
         u = points*size(b%u)
         own = u + b%n + p%n
         call multiply(start, self%of_border(:, :, k), b%u, at)
         do i = 1, points
            seen(:, (i - 1)*size(b%u) + 1:i*size(b%u)) = at(:, b%u, i)
         end do
         seen(:, u + 1:u + b%n) = start(:, :b%n)
         seen(:, own + 1:) = start(:, self%n + 1:)
         do l = 1, self%blocks
            from = b%n + (l - 1)*p%n
            seen(:, u + b%n + 1:own) = start(:, from + 1:from + p%n)
            call multiply(seen, self%of_block(:, :, l, k), from + p%u, at)
         end do
      end associate
      do i = first, points
         do x = 1, size(self%x)
            associate (sum => at(:, self%x(x), i), per_rate => self%length(k)*self%ratio(x))
               sum = start(:, self%x(x))
               do j = 1, self%constants
                  sum = sum + self%gap(j, x, i, k)*start(:, self%n + j)
               end do
               do j = 1, points
                  sum = sum + per_rate*weight(i, j)*at(:, self%v(x), j)
               end do
            end associate
         end do
      end do
   end subroutine follow

   !> The states `to` of all points by what is known times how they follow from it.
   pure subroutine multiply(known, follows, to, at)
      real(wp), intent(in), contiguous :: known(:, :), follows(:, :)
      integer, intent(in) :: to(:)
      real(wp), intent(inout), contiguous :: at(:, :, :)
      integer :: i, r
      do i = 1, points
         do r = 1, size(to)
            associate (factor => follows(:size(known, 2), (i - 1)*size(to) + r))
               if (size(known, 1) == 1) then
                  at(1, to(r), i) = dot_product(known(1, :), factor)
               else
                  at(:, to(r), i) = apply(size(known, 1), size(known, 2), known, factor)
               end if
            end associate
         end do
      end do
   end subroutine multiply
end module interval_maps
