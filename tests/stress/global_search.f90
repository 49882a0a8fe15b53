!> A global search for equilibria, slow, and independent of the one in the program: what it shares with it are the
!> forces, what counts as balanced, and how an equilibrium is judged.
!>
!> usage: global_search CASE.nml...
!>
!> A film without motion depends on two numbers: how far the journal is from the pivot, and how the pad leans. So every
!> pad shape gets a table of film forces; every pad, the curves along which its moments balance, which give its force on
!> the journal over the journal's distance, with all branches; then the journal is sought in the plane, by Newton's
!> method on these curves from a grid of places with branches drawn at random; at last Newton's method on the whole
!> brings the residual below 1e-8. One line tells of each case: its file, 'stable', 'oscillatory instability', 'static
!> instability' or 'none', and how many equilibria there are, then of the best one eigenvalue, 1/s, journal, clearances,
!> and tilts, rad.
program global_search
   use, intrinsic :: iso_fortran_env, only: error_unit
   use kinds, only: wp, pi
   use errors, only: error_type
   use case_inputs, only: case_type
   use namelist_text, only: read_text
   use case_namelist, only: case_from_text
   use linear_algebra, only: solve_2x2, dgesv
   use film_solver, only: film_solver_type, film_motion, film_response, film_ok
   use factories, only: make_film, march_films
   use tilting_pad, only: tilting_pad_type
   use operating_point, only: operating_point_type
   use state_layout, only: pad_state, pivot_deflection
   use equations_of_motion, only: machine_model, new_machine_model
   use force_balance, only: forces, force_derivatives, stability_at, stability_type
   use static_model, only: unbalanced, reference_force, residual_limit
   implicit none (type, external)

   !> Distances and leanings of a table; distances over the pad clearance.
   integer, parameter :: thin = 44, middle = 10, far = 8, distances = thin + 2*middle + far, leanings = 65
   real(wp), parameter :: nearest = 3e-4_wp, farthest = 6
   integer :: n
   !> Close where the film is thin, and about the place where the pad is round about the journal and its force changes
   !> its sign; distances of the pad's middle from the journal.
   real(wp), parameter :: gaps(distances) = [(nearest*(0.68_wp/nearest)**(real(n, wp)/(thin - 1)), n=0, thin - 1), &
      & (1 - 10**(-0.5_wp - 2.5_wp*n/(middle - 1)), n=0, middle - 1), &
      & (1 + 10**(-3 + 2.5_wp*n/(middle - 1)), n=0, middle - 1), &
      & (1.4_wp*(farthest/1.4_wp)**(real(n, wp)/(far - 1)), n=0, far - 1)]
   !> Places of the journal along a side of the grid, draws of branches at each.
   integer, parameter :: side = 15, draws = 6
   !> How far a piece is continued, in its lengths.
   real(wp), parameter :: least_part = -0.5_wp

   !> Films of one pad shape: the pad leans by b, so that the journal stands at distance rho, turned by b, before it.
   type :: table_type
      real(wp) :: rho(distances), b(leanings, distances), share(leanings, distances)
      real(wp) :: along(leanings, distances), outward(leanings, distances)
      logical :: open(leanings, distances)
   end type table_type

   !> A piece of a pad's curve: at its two ends the journal's way towards the pad, the force on the journal, leaning,
   !> pivot deflection.
   type :: piece_type
      real(wp) :: way(2), force(2), b(2), pivot_deflection(2)
      !> Whether the pad alone comes back to it.
      logical :: stable = .true.
   end type piece_type

   type :: curve_type
      type(piece_type), allocatable :: pieces(:)
   end type curve_type

   character(len=1000) :: path
   integer :: k

   do k = 1, command_argument_count()
      call get_command_argument(k, path)
      call search_case(trim(path))
   end do

contains

   subroutine search_case(path)
      character(len=*), intent(in) :: path
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      type(machine_model) :: model
      type(operating_point_type) :: point
      type(curve_type), allocatable :: curves(:)
      call read_text(path, text, error)
      if (.not. allocated(error)) call case_from_text(text, path, inputs, error)
      if (allocated(error)) then
         write (error_unit, '(a)') error%message
         error stop 1
      end if
      ! the same films without tables and without iteration
      associate (solver => inputs%bearings(1)%film%solver)
         if (solver == 'auto' .or. solver == 'sor') solver = 'direct'
      end associate
      model = new_machine_model(inputs)
      point = model%point%static()
      call model%set_point(point)
      call make_curves(inputs, model, curves)
      call search_plane(path, model, curves)
   end subroutine search_case

   !> Of every pad the pieces of its curve.
   subroutine make_curves(inputs, model, curves)
      type(case_type), intent(in) :: inputs
      type(machine_model), intent(in) :: model
      type(curve_type), allocatable, intent(out) :: curves(:)
      type(table_type), allocatable :: tables(:)
      integer :: like(inputs%bearings(1)%pad_count()), i
      call make_tables(inputs, model, like, tables)
      allocate (curves(size(like)))
      do i = 1, size(like)
         call make_curve(model, i, tables(like(i)), curves(i)%pieces)
      end do
   end subroutine make_curves

   !> The tables of all shapes, and which of them is a pad's.
   subroutine make_tables(inputs, model, like, tables)
      type(case_type), intent(in) :: inputs
      type(machine_model), intent(in) :: model
      integer, intent(out) :: like(:)
      type(table_type), allocatable, intent(out) :: tables(:)
      type(case_type) :: shapes
      class(film_solver_type), allocatable :: film
      type(film_motion), allocatable :: motion(:)
      type(film_response), allocatable :: response(:)
      integer, allocatable :: first(:)
      integer :: i, j, k, s
      first = [integer ::]
      do i = 1, size(like)
         like(i) = 0
         do s = 1, size(first)
            associate (b => inputs%bearings(1), p => inputs%bearings(1)%pads, n => first(s))
               if (abs(p%arc_deg(i) - p%arc_deg(n)) + abs(p%pivot_ratio(i) - p%pivot_ratio(n)) &
                  & + abs(p%pivot_distance(i) - p%pivot_distance(n)) &
                  & + abs(b%machined_clearance(i) - b%machined_clearance(n)) &
                  & + abs(b%axial_length(i) - b%axial_length(n)) <= 0) like(i) = s
            end associate
         end do
         if (like(i) > 0) cycle
         first = [first, i]
         like(i) = size(first)
      end do
      shapes = inputs
      shapes%bearings(1)%machined_clearance = inputs%bearings(1)%machined_clearance(first)
      shapes%bearings(1)%axial_length = inputs%bearings(1)%axial_length(first)
      shapes%bearings(1)%pads%pivot_angle_deg = inputs%bearings(1)%pads%pivot_angle_deg(first)
      shapes%bearings(1)%pads%arc_deg = inputs%bearings(1)%pads%arc_deg(first)
      shapes%bearings(1)%pads%pivot_ratio = inputs%bearings(1)%pads%pivot_ratio(first)
      shapes%bearings(1)%pads%pivot_distance = inputs%bearings(1)%pads%pivot_distance(first)
      call make_film(shapes%bearings(1), shapes%integration%relative_tolerance, march_films, film)
      allocate (tables(size(first)), motion(size(first)), response(size(first)))
      do s = 1, size(first)
         call set_places(model, first(s), tables(s))
      end do
      do j = 1, distances
         do k = 1, leanings
            do s = 1, size(first)
               motion(s) = motion_at(model%bearings(1)%pads(first(s))%position%centre_distance, tables(s)%rho(j), &
                  & tables(s)%b(k, j))
            end do
            call film%evaluate(motion, model%oil(first), model%point%speed(0.0_wp), .false., response)
            do s = 1, size(first)
               tables(s)%along(k, j) = response(s)%force(1)
               tables(s)%outward(k, j) = response(s)%force(2)
               tables(s)%open(k, j) = response(s)%status == film_ok
            end do
         end do
      end do
   end subroutine make_tables

   !> The journal without velocity at distance rho from the pivot, turned by b.
   pure type(film_motion) function motion_at(centre_distance, rho, b) result(motion)
      real(wp), intent(in) :: centre_distance, rho, b
      motion%position = [rho*sin(b), centre_distance - rho*cos(b)]
   end function motion_at

   !> Distances, and at each the leanings between those that close the film.
   subroutine set_places(model, i, table)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: i
      type(table_type), intent(inout) :: table
      real(wp) :: gap, ends(2)
      integer :: j, k
      associate (pad => model%bearings(1)%pads(i), clearance => model%bearings(1)%pads(i)%gap%machined_clearance)
         do j = 1, distances
            gap = clearance*gaps(j)
            table%rho(j) = pad%position%centre_distance - clearance + gap
            ends = [last_open(pad, table%rho(j), 0.01_wp*min(gap, clearance), -1.0_wp), &
               & last_open(pad, table%rho(j), 0.01_wp*min(gap, clearance), 1.0_wp)]
            do k = 1, leanings
               table%share(k, j) = 0.5_wp*(1 - cos(pi*(k - 1)/(leanings - 1)))
               table%b(k, j) = ends(1) + (ends(2) - ends(1))*table%share(k, j)
            end do
         end do
      end associate
   end subroutine set_places

   !> The largest leaning in one sense that leaves a pad's film thicker than this.
   pure real(wp) function last_open(pad, rho, film, sense) result(open)
      type(tilting_pad_type), intent(in) :: pad
      real(wp), intent(in) :: rho, film, sense
      real(wp) :: closed, middle
      integer :: n
      open = 0
      closed = sense*pad%largest_tilt
      do n = 1, 50
         middle = 0.5_wp*(open + closed)
         if (pad%gap%min_film_thickness(motion_at(pad%position%centre_distance, rho, middle), pad%directions) &
            & > film) then
            open = middle
         else
            closed = middle
         end if
      end do
   end function last_open

   !> The pieces along which a pad's moments balance and (pivots that yield) its forces along the radius.
   subroutine make_curve(model, i, table, pieces)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: i
      type(table_type), intent(in) :: table
      type(piece_type), allocatable, intent(out) :: pieces(:)
      real(wp) :: root(leanings, distances), b(leanings, distances), outward(leanings, distances), moment(leanings)
      logical :: stable(leanings, distances)
      integer :: roots(distances), j, k, m, best
      real(wp) :: t
      pieces = [piece_type ::]
      roots = 0
      associate (pad => model%bearings(1)%pads(i), position => model%bearings(1)%pads(i)%position)
         do j = 1, distances
            ! over the leaning, against the tilt: a moment that grows brings the pad back
            moment = -table%along(:, j)*position%centre_distance &
               & - pad%weight*(pad%centre_tangential*position%sin_angle - pad%centre_radial*position%cos_angle)
            do k = 1, leanings - 1
               if (.not. (table%open(k, j) .and. table%open(k + 1, j))) cycle
               if ((moment(k) < 0) .eqv. (moment(k + 1) < 0)) cycle
               t = moment(k)/(moment(k) - moment(k + 1))
               roots(j) = roots(j) + 1
               m = roots(j)
               stable(m, j) = moment(k) < 0
               root(m, j) = table%share(k, j) + t*(table%share(k + 1, j) - table%share(k, j))
               b(m, j) = table%b(k, j) + t*(table%b(k + 1, j) - table%b(k, j))
               outward(m, j) = table%outward(k, j) + t*(table%outward(k + 1, j) - table%outward(k, j))
            end do
         end do
         do j = 1, distances - 1
            do m = 1, roots(j)
               if (roots(j + 1) == 0) cycle
               best = minloc(abs(root(:roots(j + 1), j + 1) - root(m, j)), &
                  & mask=stable(:roots(j + 1), j + 1) .eqv. stable(m, j), dim=1)
               if (best == 0) cycle
               if (abs(root(best, j + 1) - root(m, j)) > 0.2_wp) cycle
               call add_piece(model, i, table%rho(j:j + 1), [b(m, j), b(best, j + 1)], &
                  & [outward(m, j), outward(best, j + 1)], stable(m, j), pieces)
            end do
         end do
      end associate
   end subroutine make_curve

   !> Adds the piece between two places, up to where the pivot can hold the pad there.
   subroutine add_piece(model, i, rho, b, force, stable, pieces)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: i
      real(wp), intent(in) :: rho(2), b(2), force(2)
      logical, intent(in) :: stable
      type(piece_type), allocatable, intent(inout) :: pieces(:)
      type(piece_type) :: piece, afloat
      real(wp) :: contact(2), r(2), t
      integer :: k
      associate (pad => model%bearings(1)%pads(i))
         contact = -force - pad%weight*pad%position%sin_angle
         piece = piece_type(pad%position%pivot_radius - rho, force, b, 0.0_wp, stable)
         if (model%layout%elements(1)%has(pivot_deflection)) then
            if (all(contact < 0)) return
            r = rho
            if (any(contact < 0)) then
               ! at zero contact the pad floats, wherever the journal is beyond
               t = contact(1)/(contact(1) - contact(2))
               afloat = piece_type(pad%position%pivot_radius - (rho(1) + t*(rho(2) - rho(1))), &
                  & force(1) + t*(force(2) - force(1)), b(1) + t*(b(2) - b(1)), 0.0_wp, stable)
               afloat%pivot_deflection(2) = -4*pad%gap%machined_clearance
               afloat%way(2) = afloat%way(1) + afloat%pivot_deflection(2)
               pieces = [pieces, afloat]
               k = minloc(contact, dim=1)
               r(k) = rho(1) + t*(rho(2) - rho(1))
               piece%force(k) = afloat%force(1)
               piece%b(k) = afloat%b(1)
               contact(k) = 0
            end if
            do k = 1, 2
               if (contact(k) > 0) piece%pivot_deflection(k) &
                  & = model%bearings(1)%pivots(i)%contact%law%pivot_deflection(contact(k))
            end do
            piece%way = pad%position%pivot_radius + piece%pivot_deflection - r
         end if
         pieces = [pieces, piece]
      end associate
   end subroutine add_piece

   !> Journal and pads from the curves, then by Newton's method on the whole; tells what was found.
   subroutine search_plane(path, model, curves)
      character(len=*), intent(in) :: path
      type(machine_model), intent(inout) :: model
      type(curve_type), intent(in) :: curves(:)
      real(wp) :: y(model%n), place(2), reach
      type(stability_type) :: stability, best
      real(wp), allocatable :: tried(:, :), found(:, :), y_best(:)
      integer :: row, column, draw, count, rank
      logical :: ok
      allocate (tried(model%n, 0), found(model%n, 0), y_best(model%n))
      call random_seed(put=spread(20260101, 1, 64))
      reach = 2*maxval([model%inputs%bearings(1)%clearance(), model%inputs%bearings(1)%machined_clearance])
      count = 0
      rank = 0
      best%name = 'none'
      do row = 1, side
         do column = 1, side
            place = reach*[2*real(row - 1, wp)/(side - 1) - 1, 2*real(column - 1, wp)/(side - 1) - 1]
            if (norm2(place) > reach) cycle
            do draw = 1, draws
               call journal_on_curves(model, curves, place, 0.5_wp - 0.2_wp*(draw - 1), y, ok)
               if (.not. ok) cycle
               if (known(model, y, tried, 2e-2_wp)) cycle
               tried = reshape([tried, y], [model%n, size(tried, 2) + 1])
               call polish(model, y, ok)
               if (.not. ok) cycle
               if (known(model, y, found, 1e-4_wp)) cycle
               found = reshape([found, y], [model%n, size(found, 2) + 1])
               call stability_at(model, y, stability, ok)
               if (.not. ok) cycle
               if (rank_of(stability%name) > rank) then
                  rank = rank_of(stability%name)
                  best = stability
                  y_best = y
               end if
            end do
         end do
      end do
      if (rank == 0) then
         print '(a, 1x, a, i0, a, i0)', path, 'none 0 of ', size(tried, 2)
      else
         print '(a, 1x, a, 1x, i0, a, i0, *(1x, es12.5))', path, best%name, size(found, 2), ' of ', size(tried, 2), &
            & best%eigenvalue, y_best(:2)/model%inputs%bearings(1)%clearance(), &
            & y_best(model%layout%elements(1)%before([(row, row=1, model%layout%pads)]) + 1)
      end if
   end subroutine search_plane

   pure integer function rank_of(name)
      character(len=*), intent(in) :: name
      rank_of = findloc([character(len=23) :: 'static instability', 'oscillatory instability', 'stable'], name, dim=1)
   end function rank_of

   !> Whether a state is, within a part of the clearance, one of a list.
   logical function known(model, y, list, part)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:), list(:, :), part
      real(wp) :: unit(size(y))
      integer :: k, i
      unit = model%scale
      associate (of => model%layout%elements(1))
         if (of%has(pivot_deflection)) unit(of%before([(i, i=1, of%pads)]) + 3) = model%inputs%bearings(1)%clearance()
      end associate
      known = .false.
      do k = 1, size(list, 2)
         if (maxval(abs(y - list(:, k))/unit) < part) known = .true.
      end do
   end function known

   !> Newton's method for the journal on the curves of the pads, with a piece drawn for each at the start.
   subroutine journal_on_curves(model, curves, start, handicap, y, ok)
      type(machine_model), intent(in) :: model
      type(curve_type), intent(in) :: curves(:)
      real(wp), intent(in) :: start(2)
      !> Of pieces that are not stable, in the draw.
      real(wp), intent(in) :: handicap
      real(wp), intent(out) :: y(:)
      logical, intent(out) :: ok
      integer :: iteration, i, at(size(curves))
      real(wp) :: place(2), force(2), slope(2, 2), step(2), t(size(curves)), out(2), length, reference
      reference = max(norm2(model%point%load), maxval(model%bearings(1)%pads%weight), 1.0_wp)
      place = start
      at = 0
      do iteration = 1, 60
         force = model%point%load
         slope = 0
         ok = .true.
         do i = 1, size(curves)
            associate (position => model%bearings(1)%pads(i)%position)
               out = [position%sin_angle, position%cos_angle]
               call choose(curves(i)%pieces, dot_product(place, out), handicap, at(i), t(i))
               if (at(i) == 0) then
                  ok = .false.
                  cycle
               end if
               associate (piece => curves(i)%pieces(at(i)), pad => model%bearings(1)%pads(i))
                  force = force + out*(piece%force(1) + t(i)*(piece%force(2) - piece%force(1))) &
                     & - [out(2), -out(1)]*pad%weight*(pad%centre_tangential*out(1) - pad%centre_radial*out(2)) &
                     & /position%centre_distance
                  if (t(i) > least_part .and. t(i) < 1 - least_part) slope = slope + (piece%force(2) - piece%force(1)) &
                     & /(piece%way(2) - piece%way(1))*spread(out, 2, 2)*spread(out, 1, 2)
               end associate
            end associate
         end do
         if (norm2(force) < 1e-4_wp*reference) exit
         step = solve_2x2(slope, -force)
         length = norm2(step)/(0.15_wp*model%inputs%bearings(1)%clearance())
         if (.not. length > 0) exit
         place = place + step/max(1.0_wp, length)
      end do
      ! switching points may keep it from the last digits
      ok = ok .and. norm2(force) < 0.1_wp*reference
      if (ok) y = state_on_curves(model, curves, place, at, t)
   end subroutine journal_on_curves

   !> The piece on which a pad is when the journal has come a way towards it, and where on it: the one that has it and
   !> is closest to the last one; one drawn of those that have it if there was none; the nearest where none has it.
   !> Newton's method on the whole then says whether there is an equilibrium.
   subroutine choose(pieces, way, handicap, at, t)
      type(piece_type), intent(in) :: pieces(:)
      real(wp), intent(in) :: way, handicap
      integer, intent(inout) :: at
      real(wp), intent(out) :: t
      integer :: k, chosen
      real(wp) :: off, least, drawn
      t = 0
      if (size(pieces) == 0) return
      chosen = 0
      least = huge(least)
      do k = 1, size(pieces)
         associate (ends => pieces(k)%way)
            if (abs(ends(2) - ends(1)) <= 0) cycle
            if (way > maxval(ends) .or. way < minval(ends)) then
               off = 1e6_wp*min(abs(way - ends(1)), abs(way - ends(2))) + 10
            else if (at == 0) then
               call random_number(drawn)
               off = 0.5_wp*drawn + merge(0.0_wp, handicap, pieces(k)%stable) + 1
            else
               off = abs(sum(pieces(k)%b - pieces(at)%b)) + 1e-9_wp*abs(k - at)
               if (k == at) off = -1
            end if
         end associate
         if (off < least) then
            least = off
            chosen = k
         end if
      end do
      at = chosen
      if (at > 0) t = (way - pieces(at)%way(1))/(pieces(at)%way(2) - pieces(at)%way(1))
      ! a curve ends between two places of the table: a bit further it may go on
      t = min(max(t, least_part), 1 - least_part)
   end subroutine choose

   !> The state with the journal at a place and the pads on their pieces.
   function state_on_curves(model, curves, place, at, t) result(y)
      type(machine_model), intent(in) :: model
      type(curve_type), intent(in) :: curves(:)
      real(wp), intent(in) :: place(2), t(:)
      integer, intent(in) :: at(:)
      real(wp) :: y(model%n), deflection, angle, r(2), out(2)
      type(pad_state) :: pads(size(at))
      integer :: i
      do i = 1, size(at)
         associate (piece => curves(i)%pieces(at(i)), position => model%bearings(1)%pads(i)%position)
            deflection = piece%pivot_deflection(1) + t(i)*(piece%pivot_deflection(2) - piece%pivot_deflection(1))
            out = [position%sin_angle, position%cos_angle]
            r = place - (position%pivot_radius + deflection)*out
            angle = atan2(dot_product(r, [out(2), -out(1)]), -dot_product(r, out)) &
               & - (piece%b(1) + t(i)*(piece%b(2) - piece%b(1)))
            pads(i) = pad_state(angle, deflection=deflection)
         end associate
      end do
      y = model%static_state(place, pads)
   end function state_on_curves

   !> Newton's method on journal and pads, with steps cut where the films close or nothing improves.
   subroutine polish(model, y, ok)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      logical, intent(out) :: ok
      integer, allocatable :: x(:)
      real(wp), dimension(model%layout%n_positions(), model%layout%n_positions()) :: stiffness, damping
      real(wp), dimension(model%layout%n_positions()) :: step, unit
      real(wp) :: trial(size(y)), residual, next, part
      integer :: iteration, cut, pivots(size(step)), info
      x = model%layout%positions()
      unit = model%scale(x)
      unit(3:) = merge(unit(3:), model%inputs%bearings(1)%clearance(), &
         & .not. model%layout%elements(1)%has(pivot_deflection) .or. mod([(info, info=1, size(unit) - 2)], 2) == 1)
      do iteration = 1, 60
         call model%evaluate(0.0_wp, y, .true., ok)
         if (.not. ok) return
         residual = unbalanced(model, y)/reference_force(model)
         if (residual <= residual_limit) return
         call force_derivatives(model, stiffness, damping)
         step = -forces(model, 0.0_wp, y)
         call dgesv(size(step), 1, stiffness, size(step), pivots, step, size(step), info)
         ok = info == 0
         if (.not. ok) return
         part = min(1.0_wp, 0.2_wp/max(maxval(abs(step/unit)), tiny(part)))
         do cut = 1, 12
            trial = y
            trial(x) = y(x) + part*step
            call model%evaluate(0.0_wp, trial, .false., ok)
            if (ok) then
               next = unbalanced(model, y)/reference_force(model)
               if (next < residual .or. cut > 8) exit
            end if
            part = 0.5_wp*part
         end do
         if (.not. ok) return
         y = trial
      end do
      ok = .false.
   end subroutine polish
end program global_search
