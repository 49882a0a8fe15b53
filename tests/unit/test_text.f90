!> Text: numbers, short to six digits and exact to the last bit; characters; "did you mean" of words and of the input
!> variables.
program test_text
   use kinds, only: wp, i8
   use text, only: checksum, to_text, exact_text, fixed_text, lower_case, printable, shortened, is_utf8, &
      & did_you_mean, find_similar, unlike
   use case_parameter, only: group_names, names_in, meant_variable, meant_group
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   if (runs('whole_numbers')) call whole_numbers()
   if (runs('short_reals')) call short_reals()
   if (runs('short_reals_are_close')) call short_reals_are_close()
   if (runs('exact_round_trip')) call exact_round_trip()
   if (runs('exact_is_short')) call exact_is_short()
   if (runs('exact_special_values')) call exact_special_values()
   if (runs('words')) call words()
   if (runs('characters')) call characters()
   if (runs('checksums')) call checksums()
   if (runs('slips')) call slips()
   if (runs('order_of_likeness')) call order_of_likeness()
   if (runs('variables')) call variables()
   call report()

contains

   !> UTF-8 of every length passes, and what is none, or moves the cursor of a terminal, becomes question marks.
   subroutine characters()
      character(len=*), parameter :: good = 'a'//char(195)//char(164)//char(226)//char(130)//char(172) &
         & //char(240)//char(157)//char(156)//char(139)//char(244)//char(143)//char(191)//char(191)
      call expect(is_utf8('') .and. is_utf8(good), 'characters of one to four bytes')
      call expect(printable(good) == good, 'stay as they are')
      ! a lone byte, one missing, longer than need be, half of a surrogate pair, beyond the last character
      call expect_bad(char(255), '?')
      call expect_bad(char(164), '?')
      call expect_bad(char(195), '?')
      call expect_bad(char(226)//char(130), '??')
      call expect_bad(char(195)//'a', '?a')
      call expect_bad(char(192)//char(128), '??')
      call expect_bad(char(224)//char(159)//char(191), '???')
      call expect_bad(char(237)//char(160)//char(128), '???')
      call expect_bad(char(240)//char(143)//char(191)//char(191), '????')
      call expect_bad(char(244)//char(144)//char(128)//char(128), '????')
      call expect(printable('a'//achar(10)//achar(27)//'[2J'//achar(127)) == 'a??[2J?', 'control characters')
      call expect(printable('a'//char(194)//char(155)//'b') == 'a??b', 'those of Latin-1')
      call expect(printable(char(226)//char(128)//char(168)//'b') == '???b', 'the separator of lines')
      call expect(shortened(repeat('x', 80)) == repeat('x', 80), 'what is short stays')
      call expect(shortened(repeat('x', 81)) == repeat('x', 77)//'...', 'what is long ends in points')
   end subroutine characters

   subroutine expect_bad(text, shown)
      character(len=*), intent(in) :: text, shown
      call expect(.not. is_utf8('a'//text), 'not UTF-8: '//shown)
      call expect(printable('a'//text) == 'a'//shown, 'shown as a'//shown)
   end subroutine expect_bad

   subroutine whole_numbers()
      call expect(to_text(0) == '0', 'to_text(0)')
      call expect(to_text(-120) == '-120', 'to_text(-120) keeps its zero')
      call expect(to_text(huge(1_i8)) == '9223372036854775807', 'to_text of the largest long integer')
      call expect(to_text(-huge(1_i8) - 1) == '-9223372036854775808', 'to_text of the lowest long integer')
   end subroutine whole_numbers

   subroutine short_reals()
      call expect_text(0.0_wp, '0')
      call expect_text(0.1_wp, '0.1')
      call expect_text(-0.5_wp, '-0.5')
      call expect_text(100.0_wp, '100')
      call expect_text(1e-3_wp, '0.001')
      call expect_text(69.3_wp, '69.3')
      call expect_text(123456.7_wp, '123457')
      call expect_text(1.0_wp/3, '0.333333')
      call expect_text(15e-6_wp, '1.5e-5')
      call expect_text(2.1e11_wp, '2.1e11')
      call expect_text(-1e100_wp, '-1e100')
      call expect(fixed_text(-1.25_wp, 1)//fixed_text(-0.04_wp, 1)//fixed_text(-0.0_wp, 3) == '-1.20.00.000', &
         & 'what rounds to zero has no sign')
   end subroutine short_reals

   subroutine expect_text(x, expected)
      real(wp), intent(in) :: x
      character(len=*), intent(in) :: expected
      call expect(to_text(x) == expected, 'to_text '//expected//' came out as '//to_text(x))
   end subroutine expect_text

   !> Six significant digits: wrong by at most half a unit of the sixth, 5e-6 of the number.
   subroutine short_reals_are_close()
      real(wp) :: x, back, worst
      integer :: e
      worst = 0
      do e = -300, 300
         x = random_mantissa()*10.0_wp**e
         if (mod(e, 2) == 0) x = -x
         back = value_of(to_text(x))
         worst = max(worst, abs(back/x - 1))
      end do
      call expect_close(worst, 0.0_wp, 5.0001e-6_wp, 'to_text read back is within half a unit of the sixth digit')
      call expect_close(value_of(to_text(999999.5_wp)), 999999.5_wp, 5.0_wp, 'to_text rounds up to a million')
      call expect_close(value_of(to_text(9.999999e-4_wp)), 1e-3_wp, 5e-9_wp, 'to_text rounds up to a thousandth')
   end subroutine short_reals_are_close

   !> Every exponent a real has, positive and negative, with random last bits: the same bits come back.
   subroutine exact_round_trip()
      real(wp) :: x
      integer :: e, i, wrong, too_long
      wrong = 0
      too_long = 0
      do e = minexponent(x), maxexponent(x)
         do i = 1, 4
            x = set_exponent(random_mantissa(), e)
            if (mod(i, 2) == 0) x = -x
            if (.not. same_bits(value_of(exact_text(x)), x)) wrong = wrong + 1
            if (len(exact_text(x)) > 24) too_long = too_long + 1
         end do
      end do
      call expect(wrong == 0, 'exact_text loses bits of '//to_text(wrong)//' numbers')
      call expect(too_long == 0, 'exact_text has more than seventeen digits, sign and exponent')
   end subroutine exact_round_trip

   !> A number of up to fifteen digits, with any exponent, has these and no others.
   subroutine exact_is_short()
      character(len=:), allocatable :: text
      real(wp) :: u(3)
      integer :: i
      integer(i8) :: digits
      do i = 1, 2000
         call random_number(u)
         digits = max(1_i8, int(u(1)*10.0_wp**(1 + int(15*u(2))), i8))
         text = to_text(digits)//'e'//to_text(int(580*u(3)) - 290)
         ! in either way of writing it, zeros and the point aside
         call expect(digits_of(exact_text(value_of(text))) == digits_of(text), text)
      end do
   end subroutine exact_is_short

   !> The significant digits, without zeros at both ends.
   function digits_of(text) result(digits)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: digits
      integer :: i
      digits = ''
      do i = 1, index(text//'e', 'e') - 1
         if (text(i:i) /= '.') digits = digits//text(i:i)
      end do
      digits = digits(verify(digits, '0'):verify(digits, '0', back=.true.))
   end function digits_of

   subroutine exact_special_values()
      real(wp), parameter :: values(*) = [0.0_wp, -0.0_wp, 1.0_wp, 0.1_wp, 1.0_wp/3, 15e-6_wp, &
         & tiny(1.0_wp), huge(1.0_wp), -huge(1.0_wp), epsilon(1.0_wp), 1 - epsilon(1.0_wp)/2, 2.0_wp**53]
      integer :: i
      do i = 1, size(values)
         call expect(same_bits(value_of(exact_text(values(i))), values(i)), 'exact_text '//exact_text(values(i)))
      end do
      ! a number below the normal range
      call expect(same_bits(value_of(exact_text(transfer(1_i8, 1.0_wp))), transfer(1_i8, 1.0_wp)), &
         & 'exact_text of the least subnormal number')
      call expect(exact_text(0.1_wp) == '0.1', 'exact_text is short where short is exact')
      call expect(exact_text(0.1234567_wp) == '0.1234567', 'exact_text has no more digits than it needs')
      call expect(exact_text(-1.23456789e-5_wp) == '-1.23456789e-5', 'exact_text has a short exponent')
   end subroutine exact_special_values

   subroutine words()
      character(len=1) :: c
      integer :: i, changed
      call expect(lower_case('AbC_z 19%') == 'abc_z 19%', 'lower_case')
      changed = 0
      do i = 0, 127
         c = lower_case(achar(i))
         if (c /= achar(i)) changed = changed + 1
      end do
      call expect(changed == 26, 'lower_case changes the 26 capitals alone')
      call expect(len(lower_case('')) == 0, 'lower_case of nothing')
   end subroutine words

   !> A random number in [1, 2).
   real(wp) function random_mantissa()
      call random_number(random_mantissa)
      random_mantissa = 1 + random_mantissa
   end function random_mantissa

   real(wp) function value_of(string)
      character(len=*), intent(in) :: string
      read (string, *) value_of
   end function value_of

   pure logical function same_bits(a, b)
      real(wp), intent(in) :: a, b
      same_bits = transfer(a, 1_i8) == transfer(b, 1_i8)
   end function same_bits

   !> One of parts is that of the whole, as a study that grows needs it; order, blanks and zeros count.
   subroutine checksums()
      integer(i8) :: whole
      whole = checksum('ab', 0_i8)
      call expect(whole == checksum('b', checksum('a', 0_i8)), 'of parts')
      call expect(whole /= checksum('ba', 0_i8), 'the order')
      call expect(whole /= checksum('ab ', 0_i8), 'a blank')
      call expect(checksum(achar(0), 0_i8) /= checksum('', 0_i8), 'a zero')
      call expect(checksum(repeat('~', 10000), 0_i8) > 0, 'a long text')
   end subroutine checksums

   subroutine expect_text_words(found, expected)
      character(len=*), intent(in) :: found, expected
      call expect(found == expected .and. len(found) == len(expected), '"'//expected//'" came out as "'//found//'"')
   end subroutine expect_text_words

   !> A letter too many, too few, wrong, two exchanged; what is too far off has no answer.
   subroutine slips()
      character(len=*), parameter :: known = 'march equilibrium lugre'
      call expect_text_words(did_you_mean('marrch', known), ' (did you mean march?)')
      call expect_text_words(did_you_mean('mrch', known), ' (did you mean march?)')
      call expect_text_words(did_you_mean('mqrch', known), ' (did you mean march?)')
      call expect_text_words(did_you_mean('mrahc', known), ' (did you mean march?)')
      call expect_text_words(did_you_mean('mrahx', known), '')
      call expect_text_words(did_you_mean('equlibirum', known), ' (did you mean equilibrium?)')
      call expect_text_words(did_you_mean('', known), '')
      call expect_text_words(did_you_mean('march', ''), '')
      call expect_text_words(did_you_mean(repeat('m', 5000), known), '')
   end subroutine slips

   !> The same name before its beginning, that before a part, that before a slip; of too many none is proposed.
   subroutine order_of_likeness()
      character(len=:), allocatable :: found
      integer :: score
      call find_similar('mass', 'a%mass_flow b%mass c%mass', found, score)
      call expect_text_words(found, 'b%mass or c%mass')
      call expect(score == 0, 'the same name')
      call find_similar('mass', 'own_mass massive masse', found, score)
      call expect_text_words(found, 'massive or masse')
      call find_similar('mass', 'masks own_mass', found, score)
      call expect_text_words(found, 'own_mass')
      call find_similar('x', 'x_1 x_2 x_3', found, score)
      call expect_text_words(found, 'x_1 or x_2 or x_3')
      call find_similar('x', 'x_1 x_2 x_3 x_4', found, score)
      call expect_text_words(found, '')
      call expect(score == unlike, 'four are too many')
   end subroutine order_of_likeness

   !> In the group, in another one, without a group, in a group that does not exist.
   subroutine variables()
      call expect_text_words(names_in('rotor'), &
         & ' mass unbalance balance_grade balance_speed_rpm gravity static_load file')
      call expect_text_words(names_in('roto'), '')
      call expect(index(group_names()//' ', ' case rotor operation excitation bearing ') == 1, 'groups in their order')
      call expect_text_words(meant_variable('operation', 'sped_rpm'), ' (did you mean speed_rpm?)')
      call expect_text_words(meant_variable('operation', 'mass'), ' (did you mean rotor%mass or pads%mass?)')
      call expect_text_words(meant_variable('', 'speed_rpm'), ' (did you mean operation%speed_rpm?)')
      call expect_text_words(meant_variable('bearing', 'clearance'), &
         & ' (did you mean machined_clearance or assembled_clearance?)')
      call expect_text_words(meant_variable('rotor', 'weight_of_all'), '')
      call expect_text_words(meant_group('opration'), ' (did you mean operation?)')
      call expect_text_words(meant_group('sweeps'), ' (did you mean sweep?)')
   end subroutine variables
end program test_text
