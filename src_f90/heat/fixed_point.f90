!> The fixed point of fields that depend on each other through the equilibrium of forces: with the values of all fields
!> the forces come to equilibrium, each field says there which values it wants, and the next values follow from what
!> the last ones lacked, until all agree.
!>
!> The step is Anderson's: that combination of the last rounds whose residuals, wanted less present values, would cancel
!> best (J. ACM 12 (1965) 547-560). Where this turns against the residual it is the plain one: a balance from which
!> the values run away is not accepted. Along a branch it is, as a branch goes on behind a fold. What a film wants that
!> cavitates cell by cell may jump, by what a cell carries or fails to carry: where no round leads on, the part of the
!> values that jumps most keeps the mean of what it wants on both sides (Filippov), and the others agree beside it.
module fixed_point
   use kinds, only: wp
   use errors, only: error_type, stopped
   use linear_algebra, only: solve
   use equations_of_motion, only: machine_model
   implicit none (type, external)
   private
   public :: coupled_field, field_reference, balance_type, solve_fields, most_rounds

   !> Values that follow from an equilibrium of forces, and on which it depends.
   type, abstract :: coupled_field
      real(wp), allocatable :: values(:)
      !> Largest residual of a value at the end; that of a part that jumps; longest step in a round.
      real(wp) :: agreement = 0, jump = 0, longest = huge(1.0_wp)
      !> Parts of equal size, one after the other, that may jump by themselves.
      integer :: parts = 1
   contains
      procedure(apply_values), deferred :: apply
      procedure(find_wanted_values), deferred :: find_wanted
      procedure(check_values), deferred :: check
      procedure :: explain
   end type coupled_field

   type :: field_reference
      class(coupled_field), pointer :: field => null()
   end type field_reference

   !> What comes to equilibrium with the values of fields: a model.
   type, abstract :: balance_type
      type(machine_model), pointer :: model => null()
      !> Whether the last error says that there can be no equilibrium: others than the last values would not help.
      logical :: refused = .false.
      !> Whether a balance is accepted from which the values run away, as behind the fold of a branch.
      logical :: any_balance = .false.
   contains
      procedure(find_equilibrium), deferred :: settle
   end type balance_type

   abstract interface
      !> Brings the state y, in which the forces are nearly in equilibrium with the present values, to equilibrium with
      !> them. But for the first time it should not be far: where it is, shorter steps of the values lead there, until
      !> they are `final`; the last equilibrium is there to start from as well.
      subroutine find_equilibrium(self, last, y, first, final, error)
         import :: balance_type, error_type, wp
         class(balance_type), intent(inout) :: self
         real(wp), intent(in) :: last(:)
         real(wp), intent(inout) :: y(:)
         logical, intent(in) :: first, final
         type(error_type), allocatable, intent(out) :: error
      end subroutine find_equilibrium

      !> Gives a model what follows from the values.
      subroutine apply_values(self, model)
         import :: coupled_field, machine_model
         class(coupled_field), intent(inout) :: self
         type(machine_model), intent(inout) :: model
      end subroutine apply_values

      !> The values to which the state y in equilibrium with the present ones leads.
      subroutine find_wanted_values(self, model, y, wanted, error)
         import :: coupled_field, machine_model, error_type, wp
         class(coupled_field), intent(inout) :: self
         type(machine_model), intent(inout) :: model
         real(wp), intent(in) :: y(:)
         real(wp), intent(out) :: wanted(:)
         type(error_type), allocatable, intent(out) :: error
      end subroutine find_wanted_values

      !> Refuses values of the last round, those that do not agree with what they lead to and those that are no answer.
      subroutine check_values(self, model, agrees, error)
         import :: coupled_field, machine_model, error_type
         class(coupled_field), intent(in) :: self
         type(machine_model), intent(in) :: model
         logical, intent(in) :: agrees
         type(error_type), allocatable, intent(out) :: error
      end subroutine check_values
   end interface

   !> Rounds that are combined at most, and rounds at most.
   integer, parameter :: depth = 6, most_rounds = 120
   !> Of the largest diagonal element of the normal equations, added to all: differences may be nearly parallel.
   real(wp), parameter :: regularity = 1e-12_wp
   !> Rounds without a residual of half the least one, after which it is taken to jump.
   integer, parameter :: stalled_rounds = 12
   !> Residual up to which the equilibrium is sought from the last one: from where it is expected to be, a pad that
   !> carries little would be left as far from it as the residual of the forces lets it.
   real(wp), parameter :: far = 1e4_wp
   !> Part of a step that is tried where the whole does not lead to equilibrium; how much longer than one that does the
   !> next may be; least part of the longest step.
   real(wp), parameter :: shorter = 0.25_wp, longer = 2, shortest = 5e-3_wp

   !> What leads from round to round. Values and residuals are over their agreements.
   type :: mixer_type
      integer :: rounds = 0
      logical :: agrees = .false.
      !> Of each value what its field says, and the number of its part among all.
      real(wp), allocatable, private :: agreement(:), jump(:), longest(:)
      integer, allocatable, private :: part(:)
      !> How long a step may be, over the longest.
      real(wp), private :: reach = 1
      integer, private :: known = -1, newest = 0
      real(wp), allocatable, private :: x(:), residual(:), y(:)
      !> Differences between rounds of values, residuals and states, `known` columns of which one is the newest.
      real(wp), allocatable, private :: steps(:, :), differences(:, :), moves(:, :)
      !> Least residual, and rounds since then; the mean of what was wanted in these.
      real(wp), private :: least = huge(1.0_wp)
      integer, private :: since = 0
      real(wp), allocatable, private :: mean(:)
      !> Values that are kept.
      logical, allocatable, private :: kept(:)
   contains
      procedure :: begin
      procedure :: next
      procedure, private :: keep
      procedure, private :: forget
      procedure, private :: remember
      procedure, private :: combine
   end type mixer_type

contains

   !> Adds to the error of a search that did not end, perhaps the first, what the field knows of it.
   subroutine explain(self, model, y, first, error)
      class(coupled_field), intent(in) :: self
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      logical, intent(in) :: first
      type(error_type), allocatable, intent(inout) :: error
   end subroutine explain

   !> Brings the state y of what is near equilibrium to equilibrium, and all fields to the values to which this leads.
   !> An error where they do not agree, or with values that are no answer.
   subroutine solve_fields(balance, y, fields, error)
      class(balance_type), intent(inout) :: balance
      real(wp), intent(inout) :: y(:)
      type(field_reference), intent(in) :: fields(:)
      type(error_type), allocatable, intent(out) :: error
      type(mixer_type) :: mixer
      real(wp), allocatable :: x(:), wanted(:)
      integer :: first(size(fields) + 1), f
      first(1) = 1
      x = [real(wp) ::]
      do f = 1, size(fields)
         x = [x, fields(f)%field%values]
         first(f + 1) = size(x) + 1
         call mixer%begin(fields(f)%field)
      end do
      allocate (wanted(size(x)))
      do
         call take_step()
         if (allocated(error)) then
            if (error%status == stopped .or. balance%refused) return
            do f = 1, size(fields)
               call fields(f)%field%explain(balance%model, y, mixer%rounds == 0, error)
            end do
            return
         end if
         do f = 1, size(fields)
            call fields(f)%field%find_wanted(balance%model, y, wanted(first(f):first(f + 1) - 1), error)
            if (allocated(error)) return
         end do
         call mixer%next(wanted, balance%any_balance, x, y)
         if (mixer%agrees .or. mixer%rounds == most_rounds) exit
      end do
      do f = 1, size(fields)
         call fields(f)%field%check(balance%model, mixer%agrees .or. .not. lacks(f), error)
         balance%refused = mixer%agrees .and. allocated(error)
         if (allocated(error)) return
      end do

   contains

      !> Whether the residual of this field is too large.
      pure logical function lacks(f)
         integer, intent(in) :: f
         lacks = any(abs(mixer%residual(first(f):first(f + 1) - 1)) > 1)
      end function lacks

      !> Brings the state y in equilibrium with the present values of the fields to equilibrium with the values x, or
      !> with those of the longest part of this step that it can follow. An error where that is next to nothing.
      subroutine take_step()
         real(wp) :: before(size(x)), last(size(y)), length
         integer :: f
         before = x
         last = y
         if (mixer%rounds > 0) then
            before = mixer%x*mixer%agreement
            last = mixer%y
         end if
         length = maxval(abs(x - before)/mixer%longest)
         do
            do f = 1, size(fields)
               fields(f)%field%values = x(first(f):first(f + 1) - 1)
               call fields(f)%field%apply(balance%model)
            end do
            call balance%settle(last, y, mixer%rounds == 0, length <= shortest, error)
            if (.not. allocated(error)) exit
            y = last
            if (error%status == stopped .or. balance%refused .or. length <= shortest) return
            x = before + shorter*(x - before)
            length = shorter*length
            mixer%reach = length
         end do
         mixer%reach = min(1.0_wp, longer*mixer%reach)
      end subroutine take_step
   end subroutine solve_fields

   !> Begins with the values of a field, behind those of others.
   pure subroutine begin(self, field)
      class(mixer_type), intent(inout) :: self
      class(coupled_field), intent(in) :: field
      integer :: i, n, before
      if (.not. allocated(self%part)) allocate (self%agreement(0), self%jump(0), self%longest(0), self%part(0))
      n = size(field%values)
      before = max(0, maxval(self%part))
      self%agreement = [self%agreement, spread(field%agreement, 1, n)]
      self%jump = [self%jump, spread(field%jump, 1, n)]
      self%longest = [self%longest, spread(field%longest, 1, n)]
      self%part = [self%part, [(before + 1 + (i - 1)*field%parts/n, i=1, n)]]
      self%kept = spread(.false., 1, size(self%part))
      self%mean = spread(0.0_wp, 1, size(self%part))
   end subroutine begin

   !> Forgets the rounds before the last one.
   pure subroutine forget(self)
      class(mixer_type), intent(inout) :: self
      self%known = -1
      self%newest = 0
   end subroutine forget

   !> The next values x after a round that wants others, unless they agree, and the state y in which the forces are then
   !> nearly in equilibrium; `any_balance` as in balance_type.
   subroutine next(self, wanted, any_balance, x, y)
      class(mixer_type), intent(inout) :: self
      real(wp), intent(in) :: wanted(:)
      logical, intent(in) :: any_balance
      real(wp), intent(inout) :: x(:), y(:)
      real(wp) :: residual(size(x)), step(size(x))
      residual = (wanted - x)/self%agreement
      self%rounds = self%rounds + 1
      self%kept = self%kept .and. abs(wanted - x) <= self%jump
      where (self%kept) residual = 0
      associate (largest => maxval(abs(residual)))
         self%agrees = largest <= 1
         if (largest < 0.5_wp*self%least) then
            self%least = largest
            self%since = 0
         end if
      end associate
      self%since = self%since + 1
      self%mean = self%mean + (wanted - self%mean)/self%since
      call self%remember(x/self%agreement, residual, y)
      if (self%agrees) return
      if (self%since > stalled_rounds) call self%keep(x, residual)
      call self%combine(residual, any_balance, step, y)
      step = step*self%agreement
      x = x + step/max(1.0_wp, maxval(abs(step)/(self%reach*self%longest)))
   end subroutine next

   !> Lets the part of the values that jumps most keep the mean of what it wanted, if it jumps by no more than it may.
   pure subroutine keep(self, x, residual)
      class(mixer_type), intent(inout) :: self
      real(wp), intent(inout) :: x(:), residual(:)
      logical :: jumps(size(x))
      jumps = self%part == self%part(maxloc(abs(residual), 1))
      if (any(jumps .and. abs(residual)*self%agreement > self%jump)) return
      self%kept = self%kept .or. jumps
      where (jumps) x = self%mean
      where (jumps) residual = 0
      self%least = huge(self%least)
      self%since = 0
      call self%forget()
   end subroutine keep

   !> Takes a round into the memory.
   pure subroutine remember(self, x, residual, y)
      class(mixer_type), intent(inout) :: self
      real(wp), intent(in) :: x(:), residual(:), y(:)
      if (.not. allocated(self%steps)) allocate (self%steps(size(x), depth), self%differences(size(x), depth), &
         & self%moves(size(y), depth))
      self%known = min(self%known + 1, depth)
      if (self%known > 0) then
         self%newest = 1 + mod(self%newest, depth)
         self%steps(:, self%newest) = x - self%x
         self%differences(:, self%newest) = residual - self%residual
         self%moves(:, self%newest) = y - self%y
      end if
      self%x = x
      self%residual = residual
      self%y = y
   end subroutine remember

   !> The step from the rounds in the memory; the plain one, without memory, where they are of no use.
   subroutine combine(self, residual, any_balance, step, y)
      class(mixer_type), intent(inout) :: self
      real(wp), intent(in) :: residual(:)
      logical, intent(in) :: any_balance
      real(wp), intent(out) :: step(:)
      real(wp), intent(inout) :: y(:)
      real(wp) :: matrix(depth, depth), part(depth), largest
      integer :: i
      logical :: ok
      step = residual
      if (any(abs(residual)*self%agreement > self%longest)) call self%forget()
      associate (n => self%known)
         if (n < 1) return
         associate (d => self%differences(:, :n))
            matrix(:n, :n) = matmul(transpose(d), d)
            part(:n) = matmul(residual, d)
         end associate
         largest = maxval([(matrix(i, i), i=1, n)])
         do i = 1, n
            matrix(i, i) = matrix(i, i) + regularity*largest
         end do
         call solve(n, 1, matrix(:n, :n), part, ok)
         if (ok) then
            step = residual - matmul(self%steps(:, :n) + self%differences(:, :n), part(:n))
            if (any_balance .or. dot_product(step, residual) > 0) then
               if (any(abs(residual) > far)) y = y - matmul(self%moves(:, :n), part(:n))
               return
            end if
         end if
         step = residual
         call self%forget()
      end associate
   end subroutine combine
end module fixed_point
