!> The task 'coefficients': the equilibrium, and stiffness, damping and stability there, as file and console have them.
module coefficients_task
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp, pi
   use text, only: to_text, fixed_text, filled
   use errors, only: error_type, add_context, stopped
   use case_inputs, only: case_type
   use equations_of_motion, only: machine_model
   use force_balance, only: is_of_rotor, position_names
   use linear_bearing, only: bearing_coefficients_type, find_coefficients, begin_to_carry, &
      & vibration_modes_type
   use rotor_response, only: rotor_response_type, find_rotor_response
   use stability_threshold, only: find_thresholds
   use threshold_cycle, only: threshold_cycle_type, follow_cycles
   use stability_levels, only: stability_levels_type, find_stability_levels
   use coefficient_results, only: put_coefficients, put_one_sided, put_modes, put_shapes, put_thresholds, &
      & put_births, put_rotor_response, put_stability_levels
   use bearing_file, only: bearing_file_type
   use stop_signals, only: stop_reason
   use case_run, only: case_run_type
   use run_start, only: find_converged_equilibrium
   use film_network, only: warm_films_type
   use newton_method, only: place_part_type
   implicit none (type, external)
   private
   public :: run_coefficients

   !> Whirl frequencies, and modes of the rotor and of the pads, that are printed at most.
   integer, parameter :: most = 4
   !> Modes of which more than this part of the damping in a march is that of the reduction are not listed.
   real(wp), parameter :: mostly = 0.5_wp

contains

   subroutine run_coefficients(run, error)
      type(case_run_type), intent(inout), target :: run
      type(error_type), allocatable, intent(out) :: error
      type(machine_model), target :: fine
      type(bearing_coefficients_type) :: found
      type(warm_films_type), allocatable :: films(:)
      type(place_part_type), allocatable :: before(:)
      real(wp), allocatable :: y(:)
      call find_converged_equilibrium(run, fine, y, error, films)
      if (allocated(error)) return
      call find_coefficients(fine, y, found, error)
      if (.not. allocated(error) .and. run%inputs%coefficients%threshold_up_to_rpm > 0) then
         if (run%inputs%coefficients%threshold_born) then
            call find_thresholds(fine, y, found, error, films, before)
         else
            call find_thresholds(fine, y, found, error, films)
         end if
      end if
      if (.not. allocated(error)) call write_coefficients(run, fine, found, error)
      if (.not. allocated(error) .and. run%inputs%coefficients%threshold_born) then
         call note_birth(run, fine, y, films, before, error)
      end if
      if (allocated(error)) then
         call add_context(error, 'with converged films')
         if (error%status == stopped) then
            ! nothing to go on from
            run%computed = .false.
            error%message = stop_reason()//' while the coefficients were calculated; nothing was written'
         end if
         return
      end if
      call note_one_sided(run, fine, y)
   end subroutine run_coefficients

   !> Follows the limit cycles that begin at the threshold speed of free, or with friction stuck, pivots, behind an
   !> equilibrium, and says what they do.
   subroutine note_birth(run, fine, y, films, before, error)
      type(case_run_type), intent(inout), target :: run
      type(machine_model), intent(in), target :: fine
      real(wp), intent(in) :: y(:)
      type(warm_films_type), allocatable, intent(in) :: films(:)
      type(place_part_type), allocatable, intent(in) :: before(:)
      type(error_type), allocatable, intent(out) :: error
      type(threshold_cycle_type) :: cycles
      if (.not. allocated(before)) then
         if (.not. run%quiet) print '(a)', 'limit cycles: none begin, as no threshold speed was found'
         return
      end if
      call follow_cycles(fine, y, films, before, cycles, error)
      if (allocated(error)) then
         if (error%status == stopped) return
         if (.not. run%quiet) print '(a)', 'limit cycles: '//error%message
         deallocate (error)
      end if
      if (.not. cycles%next > 0) return
      call put_births(run%file, cycles)
      if (run%quiet) return
      print '(a)', filled('limit cycles begin at {.2} rpm, born towards '//trim(merge('higher', 'lower ', &
         & cycles%next > cycles%threshold))//' speeds', [cycles%threshold])
      if (cycles%lowest < cycles%threshold) print '(a)', filled('  the lowest speed with one is {.2} rpm, of ' &
         & //'amplitude y {u.2}, z {u.2} um: from there on a kick may lead to whirl', [cycles%lowest, cycles%amplitude])
   end subroutine note_birth

   !> Writes which pads have a film that only just begins to carry in the equilibrium y, and remarks on them.
   subroutine note_one_sided(run, fine, y)
      type(case_run_type), intent(inout), target :: run
      type(machine_model), intent(in) :: fine
      real(wp), intent(in) :: y(:)
      type(bearing_file_type) :: part
      logical :: begin(fine%layout%pads)
      integer :: b
      begin = begin_to_carry(fine, y)
      do b = 1, size(fine%bearings)
         part = run%bearing(b)
         call put_one_sided(part, begin(fine%layout%elements(b)%all_pads()))
      end do
      if (any(begin)) call run%note_remarks(shown=.true.)
   end subroutine note_one_sided

   !> Writes and prints coefficients and modes, and of a machine the response of its rotor.
   subroutine write_coefficients(run, fine, found, error)
      type(case_run_type), intent(inout), target :: run
      type(machine_model), intent(in) :: fine
      type(bearing_coefficients_type), intent(in) :: found
      type(error_type), allocatable, intent(out) :: error
      type(bearing_file_type) :: part
      type(rotor_response_type) :: response
      type(stability_levels_type) :: levels
      real(wp) :: left_out
      integer :: b
      do b = 1, size(fine%bearings)
         part = run%bearing(b)
         associate (layout => fine%layout%elements(b))
            call put_coefficients(part, found, layout, position_names(fine, b), b, &
               & run%inputs%coefficients%frequency_ratio)
            call put_shapes(part, found, layout)
         end associate
      end do
      if (fine%rotor%stations > 0) then
         call find_rotor_response(fine, found, response, error)
         if (allocated(error)) return
         call put_rotor_response(run%file, found, response, run%inputs%sense())
         if (size(run%inputs%rotor%elastic%impellers) > 0) then
            call find_stability_levels(fine, found, levels, error)
            if (allocated(error)) return
            call put_stability_levels(run%file, levels)
         end if
      end if
      if (.not. allocated(response%of_reduction)) allocate (response%of_reduction(2*size(found%bearings(1)%moves), &
         & size(found%modes)), source=0.0_wp)
      call put_modes(run%file, found, response%of_reduction > mostly)
      call put_thresholds(run%file, found)
      if (run%quiet) return
      left_out = 0
      if (run%file%has('rotor/left_out_frequency')) left_out = run%file%get_real('rotor/left_out_frequency')
      call print_coefficients(found, run%inputs, response%of_reduction > mostly, left_out)
      if (allocated(response%unbalance)) call print_response(found, response, run%inputs)
      if (allocated(levels%zero)) call print_levels(found, levels, run%inputs)
   end subroutine write_coefficients

   subroutine print_coefficients(found, inputs, of_reduction, left_out)
      type(bearing_coefficients_type), intent(in) :: found
      type(case_type), intent(in) :: inputs
      !> Whether the damping of a mode in a march is that of the reduction, (mode, pivot).
      logical, intent(in) :: of_reduction(:, :)
      !> Frequency, Hz, of the first mode that the reduction leaves out; 0: none is.
      real(wp), intent(in) :: left_out
      character(len=:), allocatable :: kept
      integer :: b, i, k
      kept = ''
      if (inputs%thermal%model /= 'none') kept = 'viscosities'
      if (any(inputs%bearings%changes_shape())) then
         if (kept /= '') kept = kept//' and '
         kept = kept//'clearances'
      end if
      if (kept /= '') print '(a)', 'stiffness and damping at the '//kept//' of this equilibrium:'
      associate (ratios => inputs%coefficients%frequency_ratio)
         do i = 1, size(found%bearings)
            print '(a)', pivots_of(found, i, inputs)//':'
            do b = 1, size(found%stiffness, 5)
               if (inputs%bearings(b)%name /= '') print '(a)', '  '//inputs%bearings(b)%label(':')
               do k = 1, min(most, size(ratios))
                  print '(a)', '  whirl at '//to_text(ratios(k))//' of the speed: K ' &
                     & //elements(found%stiffness(:, :, k, i, b))//' MN/m, C ' &
                     & //elements(found%damping(:, :, k, i, b))//' MN s/m (yy, yz, zy, zz)'
               end do
            end do
            if (size(ratios) > most) print '(a)', '  and '//to_text(size(ratios) - most) &
               & //' whirl frequencies more, in the file'
            call print_modes(found%modes(i), of_reduction(:size(found%modes(i)%eigenvalue), i), left_out)
            if (.not. allocated(found%thresholds)) cycle
            ! where an eigenvalue crosses the axis next
            associate (threshold => found%thresholds(i), speed => inputs%operation%speed_rpm)
               if (ieee_is_nan(threshold)) then
                  print '(a)', filled('  no eigenvalue crosses the axis from {} rpm up to {} rpm', [speed, &
                     & found%sought_up_to])
               else
                  print '(a)', filled('  threshold speed: above {} rpm an eigenvalue crosses the axis at {.2} rpm', &
                     & [speed, threshold])
               end if
            end associate
         end do
      end associate
   end subroutine print_coefficients

   !> The elements of a matrix, row after row, over 1e6, with as many decimals as give the largest five digits.
   pure function elements(matrix) result(text)
      real(wp), intent(in) :: matrix(:, :)
      character(len=:), allocatable :: text
      integer :: decimals, i, j
      decimals = max(0, min(9, 4 - floor(log10(max(tiny(matrix), 1e-6_wp*maxval(abs(matrix)))))))
      text = ''
      do i = 1, size(matrix, 1)
         do j = 1, size(matrix, 2)
            if (text /= '') text = text//', '
            text = text//fixed_text(1e-6_wp*matrix(i, j), decimals)
         end do
      end do
   end function elements

   !> What synchronously reduced coefficients would change of the modes; the largest whirl of the stations.
   subroutine print_response(found, response, inputs)
      type(bearing_coefficients_type), intent(in) :: found
      type(case_type), intent(in) :: inputs
      type(rotor_response_type), intent(in) :: response
      real(wp), allocatable :: amplitude(:)
      character(len=:), allocatable :: pivots, others
      integer :: i
      do i = 1, size(found%modes)
         pivots = pivots_of(found, i, inputs)//': '
         others = other_decrements(found%modes(i), response%synchronous(i), response%counterpart(:, i), &
            & response%of_reduction(:, i) > mostly)
         if (others /= '') print '(a)', pivots//'synchronously reduced coefficients would give other logarithmic ' &
            & //'decrements: '//others
         call print_of_elements(found%modes(i), response%of_elements(:, :, i), inputs%element_labels(), &
            & response%of_reduction(:, i) > mostly)
         amplitude = maxval(abs(response%unbalance(:, :, i)), 1)
         print '(a)', pivots//filled('linear response to the unbalance, largest at station {}: {u.3} um', &
            & [real(wp) :: maxloc(amplitude), maxval(amplitude)])
      end do
   end subroutine print_response

   !> What elements and dampers add to the logarithmic decrements of the least damped modes of the rotor.
   subroutine print_of_elements(modes, parts, labels, of_reduction)
      type(vibration_modes_type), intent(in) :: modes
      character(len=*), intent(in) :: labels(:)
      real(wp), intent(in) :: parts(:, :)
      logical, intent(in) :: of_reduction(:)
      character(len=:), allocatable :: text
      integer, allocatable :: shown(:)
      integer :: i, k, e
      if (size(parts, 1) == 0) return
      shown = pack([(i, i=1, size(modes%name))], is_of_rotor(modes%name) .and. modes%eigenvalue%im > 0 &
         & .and. .not. of_reduction(:size(modes%name)))
      do k = 1, min(most, size(shown))
         i = shown(k)
         text = ''
         do e = 1, size(parts, 1)
            text = text//', '//trim(labels(e))//' '//fixed_text(parts(e, i), 3)
         end do
         print '(a)', '    of the logarithmic decrement of mode '//to_text(i)//', ' &
            & //fixed_text(modes%log_decrement(i), 3)//': '//text(3:)
      end do
   end subroutine print_of_elements

   !> What the cross-coupled stiffness that API 617 anticipates makes of the first forward mode.
   subroutine print_levels(found, levels, inputs)
      type(bearing_coefficients_type), intent(in) :: found
      type(stability_levels_type), intent(in) :: levels
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: zero
      integer :: i, at
      at = minloc(abs(levels%cross_stiffness - levels%anticipated), dim=1)
      do i = 1, size(found%bearings)
         zero = ', 0 above ten times that'
         if (.not. ieee_is_nan(levels%zero(1, i))) zero = filled(', 0 at {.3} times that', &
            & [levels%zero(1, i)/levels%anticipated])
         if (levels%zero(1, i) <= 0) zero = ', below 0 without it'
         associate (mode => levels%eigenvalue(at, :, i))
            print '(a)', pivots_of(found, i, inputs)//filled(': with the anticipated cross-coupled stiffness of {.4} ' &
               & //'MN/m the first forward mode has a logarithmic decrement of {.4} ({.4} with synchronously reduced ' &
               & //'coefficients)', [1e-6_wp*levels%anticipated, -2*pi*mode%re/mode%im])//zero
         end associate
      end do
   end subroutine print_levels

   !> Modes of the rotor whose logarithmic decrement on synchronously reduced coefficients has another sign than with
   !> the pads' own equations, or differs by more than a tenth: "mode 1 (shaft, backward) 1.0345 and not 1.1234, ...";
   !> of a mode that has no counterpart "none".
   function other_decrements(exact, reduced, counterpart, of_reduction) result(text)
      type(vibration_modes_type), intent(in) :: exact, reduced
      integer, intent(in) :: counterpart(:)
      logical, intent(in) :: of_reduction(:)
      character(len=:), allocatable :: text, there
      ! of the decrement, and what its decimals show
      real(wp), parameter :: differs = 0.1_wp, shown = 0.5e-4_wp
      integer :: i, k, others
      text = ''
      others = 0
      do i = 1, size(exact%eigenvalue)
         if (.not. (exact%eigenvalue(i)%im > 0 .and. is_of_rotor(exact%name(i)))) cycle
         if (of_reduction(i)) cycle
         k = counterpart(i)
         there = 'none'
         if (k > 0) then
            ! a decrement of another sign differs by more than itself
            if (abs(reduced%log_decrement(k) - exact%log_decrement(i)) <= max(shown, &
               & differs*abs(exact%log_decrement(i)))) cycle
            there = fixed_text(reduced%log_decrement(k), 4)
         end if
         others = others + 1
         if (others > most) cycle
         if (others > 1) text = text//', '
         text = text//'mode '//to_text(i)//' ('//trim(exact%name(i))//') '//there//' and not ' &
            & //fixed_text(exact%log_decrement(i), 4)
      end do
      if (others > most) text = text//', and '//to_text(others - most)//' more'
   end function other_decrements

   !> What modes of the rotor, and those of pads, say of stability, and the least damped ones that vibrate or grow.
   subroutine print_modes(modes, of_reduction, left_out)
      type(vibration_modes_type), intent(in) :: modes
      logical, intent(in) :: of_reduction(:)
      real(wp), intent(in) :: left_out
      logical :: of_rotor(size(modes%name))
      of_rotor = is_of_rotor(modes%name)
      call print_kind(modes, of_rotor, of_reduction, trim(merge('the shaft  ', 'the journal', &
         & any(index(modes%name, 'shaft') == 1)))//' is', left_out)
      call print_kind(modes, .not. of_rotor, of_reduction, 'the pads are', 0.0_wp)
   end subroutine print_modes

   subroutine print_kind(modes, of_kind, of_reduction, who, left_out)
      type(vibration_modes_type), intent(in) :: modes
      logical, intent(in) :: of_kind(:), of_reduction(:)
      character(len=*), intent(in) :: who
      real(wp), intent(in) :: left_out
      character(len=:), allocatable :: rough
      integer, allocatable :: shown(:)
      integer :: i, k
      if (.not. any(of_kind)) return
      shown = pack([(i, i=1, size(of_kind))], of_kind .and. modes%damping_ratio < 1 .and. .not. of_reduction)
      print '(a)', '  '//who//trim(merge(' unstable', ' stable  ', any(of_kind .and. modes%eigenvalue%re > 0 &
         & .and. .not. of_reduction))) &
         & //trim(merge(':                  ', ', without vibration', size(shown) > 0))
      do k = 1, min(most, size(shown))
         i = shown(k)
         associate (value => modes%eigenvalue(i), title => '    mode '//to_text(i)//' ('//trim(modes%name(i))//'): ')
            rough = ''
            if (left_out > 0 .and. value%im > 2*pi*left_out) rough = filled('; rough, as modes from {.1} Hz on are ' &
               & //'left out (reduction%frequency)', [left_out])
            if (value%im > 0) then
               print '(a)', title//filled('{.2} Hz, damping ratio {.4}, logarithmic decrement {.3}', &
                  & [value%im/(2*pi), modes%damping_ratio(i), modes%log_decrement(i)])//rough
            else
               print '(a)', title//filled('grows without vibration, {.3} 1/s', [value%re])
            end if
         end associate
      end do
      if (any(of_kind .and. of_reduction)) print '(a)', '    not listed: ' &
         & //to_text(count(of_kind .and. of_reduction))//trim(merge(' high mode ', ' high modes', &
         & count(of_kind .and. of_reduction) == 1))//' of the shaft, which ' &
         & //'a march damps (reduction%damp_above)'
   end subroutine print_kind

   !> "pivots stuck"; "coefficients" where no bearing has pivots.
   function pivots_of(found, i, inputs) result(title)
      type(bearing_coefficients_type), intent(in) :: found
      integer, intent(in) :: i
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: title
      title = 'coefficients'
      if (any(inputs%bearings%tilting())) title = 'pivots '//trim(found%bearings(i)%pivot)
   end function pivots_of
end module coefficients_task
