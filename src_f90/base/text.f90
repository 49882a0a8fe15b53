!> Small text helpers for messages and input.
module text
   use kinds, only: wp, i8
   implicit none (type, external)
   private
   public :: to_text, list_text, exact_text, fixed_text, whole_number, lower_case, printable, shortened, replaced
   public :: filled, line_if, behind, newline, is_utf8, checksum, is_first, find_similar, did_you_mean, unlike

   character(len=*), parameter :: newline = achar(10)
   !> Letters before the numbers of a template, as before units, and by what they multiply.
   character(len=*), parameter :: letters = 'umcM'
   real(wp), parameter :: factors(0:4) = [1.0_wp, 1e6_wp, 1e3_wp, 100.0_wp, 1e-6_wp]

   !> The score of a word that no known one is like.
   integer, parameter :: unlike = huge(1)
   !> Most words that a message proposes; where more are as much alike, none helps.
   integer, parameter :: most_proposed = 3

   !> Decimals in a format, which no number that a runtime writes may tell: it can be told to write signs.
   character(len=2), parameter :: decimals_in_format(0:20) = ['0 ', '1 ', '2 ', '3 ', '4 ', '5 ', '6 ', '7 ', '8 ', &
      & '9 ', '10', '11', '12', '13', '14', '15', '16', '17', '18', '19', '20']

   !> A number as short text, for messages: `to_text(3)`, `to_text(0.1_wp)`.
   interface to_text
      module procedure integer_text, long_text, real_text
   end interface to_text

contains

   pure function integer_text(i) result(string)
      integer, intent(in) :: i
      character(len=:), allocatable :: string
      string = long_text(int(i, i8))
   end function integer_text

   pure function long_text(i) result(string)
      integer(i8), intent(in) :: i
      character(len=:), allocatable :: string
      character(len=20) :: digits
      integer(i8) :: rest
      integer :: at
      ! not by a write statement, which a quarter of the time of checking a case went into
      rest = i
      at = len(digits)
      do
         ! the remainder has the sign of the number: the lowest number has no positive twin
         digits(at:at) = achar(iachar('0') + abs(int(mod(rest, 10_i8))))
         rest = rest/10
         if (rest == 0) exit
         at = at - 1
      end do
      string = digits(at:)
      if (i < 0) string = '-'//string
   end function long_text

   !> Six significant digits, without needless zeros: 0.019, 1e-4, -1.25e9.
   pure function real_text(x) result(string)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: string
      string = of_digits(x, 6)
   end function real_text

   !> Numbers as short texts, or with this number of decimals: "1, 0.5".
   pure function list_text(values, decimals) result(string)
      real(wp), intent(in) :: values(:)
      integer, intent(in), optional :: decimals
      character(len=:), allocatable :: string
      integer :: i
      string = ''
      do i = 1, size(values)
         if (i > 1) string = string//', '
         if (present(decimals)) then
            string = string//fixed_text(values(i), decimals)
         else
            string = string//to_text(values(i))
         end if
      end do
   end function list_text

   !> A template with numbers in its places: {} a short number, {.2} one with two decimals, {i} a whole one, and
   !> with a letter before that in other units, "{u.3} um", "{m} mrad", "{M} MPa", "{c.1} %". What a user wrote may have
   !> braces itself and stands beside a template, not in it.
   pure function filled(template, numbers) result(text)
      character(len=*), intent(in) :: template
      real(wp), intent(in), optional :: numbers(:)
      character(len=:), allocatable :: text
      integer :: at, from, to, i
      text = template
      if (.not. present(numbers)) return
      text = ''
      at = 1
      do i = 1, size(numbers)
         from = at + index(template(at:), '{') - 1
         to = from + index(template(from:), '}') - 1
         text = text//template(at:from - 1)//in_place(template(from + 1:to - 1), numbers(i))
         at = to + 1
      end do
      text = text//template(at:)
   end function filled

   !> A number as the place in a template wants it, which stands in braces there.
   pure function in_place(place, number) result(text)
      character(len=*), intent(in) :: place
      real(wp), intent(in) :: number
      character(len=:), allocatable :: text
      real(wp) :: x
      integer :: letter
      letter = index(letters, place(:min(1, len(place))))
      if (place == '') letter = 0
      x = factors(letter)*number
      if (index(place, '.') > 0) then
         text = fixed_text(x, whole_number(place(index(place, '.') + 1:)))
      else if (index(place, 'i') > 0) then
         text = to_text(nint(x, i8))
      else
         text = to_text(x)
      end if
   end function in_place

   !> A line of a list: a text or template, and what stands behind it, where a condition holds; else nothing.
   pure function line_if(holds, template, numbers, ending) result(line)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: template
      real(wp), intent(in), optional :: numbers(:)
      character(len=*), intent(in), optional :: ending
      character(len=:), allocatable :: line
      line = ''
      if (.not. holds) return
      line = filled(template, numbers)
      if (present(ending)) line = line//ending
      line = line//newline
   end function line_if

   !> Lines, each behind a prefix.
   pure function behind(prefix, lines) result(prefixed)
      character(len=*), intent(in) :: prefix, lines
      character(len=:), allocatable :: prefixed
      integer :: first, length
      prefixed = ''
      first = 1
      do while (first <= len(lines))
         length = index(lines(first:), newline)
         prefixed = prefixed//prefix//lines(first:first + length - 1)
         first = first + length
      end do
   end function behind

   !> The whole number from 1 that a text of at most 9 digits is; 0 where it is none.
   pure integer function whole_number(text)
      character(len=*), intent(in) :: text
      whole_number = 0
      if (text /= '' .and. len(text) <= 9 .and. verify(text, '0123456789') == 0) read (text, *) whole_number
   end function whole_number

   !> A number with this number of significant digits, without needless zeros.
   pure function of_digits(x, digits) result(string)
      real(wp), intent(in) :: x
      integer, intent(in) :: digits
      character(len=:), allocatable :: string
      character(len=32) :: buffer
      integer :: exponent, e
      if (abs(x) >= 1e-3_wp .and. abs(x) < 1e6_wp) then
         string = without_zeros(fixed_text(x, max(0, digits - 1 - floor(log10(abs(x))))))
         return
      end if
      if (.not. abs(x) > 0) then
         string = '0'
         return
      end if
      write (buffer, '(ss,es32.'//decimals_in_format(digits - 1)//'e3)') x
      buffer = adjustl(buffer)
      e = scan(buffer, 'E')
      if (e == 0) then
         ! not a number, or infinite
         string = trim(buffer)
         return
      end if
      read (buffer(e + 1:), *) exponent
      string = without_zeros(buffer(:e - 1))//'e'//integer_text(exponent)
   end function of_digits

   !> "0.0190" to "0.019", "10.0" to "10".
   pure function without_zeros(digits) result(string)
      character(len=*), intent(in) :: digits
      character(len=:), allocatable :: string
      integer :: last
      last = len(digits)
      if (index(digits, '.') > 0) last = verify(digits, '0', back=.true.)
      if (digits(last:last) == '.') last = last - 1
      string = digits(:last)
   end function without_zeros

   !> The fewest significant digits, from six to seventeen, that give the same bits when they are read back.
   pure function exact_text(x) result(string)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: string
      real(wp) :: back
      integer :: digits, first
      ! most are whole, and need no trial
      if (abs(x) > 0 .and. abs(x) < 1e6_wp .and. abs(x - anint(x)) <= 0) then
         string = integer_text(nint(x))
         return
      end if
      ! normal numbers of up to fifteen digits are these, with zeros
      first = merge(precision(x), 6, abs(x) >= tiny(x))
      ! rounded to fewer digits the largest numbers would be infinite
      if (abs(x) > 0.1_wp*huge(x)) first = 17
      do digits = first, 17
         string = of_digits(x, digits)
         read (string, *) back
         if (transfer(back, 1_i8) == transfer(x, 1_i8)) return
      end do
      ! a zero below zero
      if (.not. abs(x) > 0) string = '-0'
   end function exact_text

   !> A number with this number of decimals, and a digit before the point.
   pure function fixed_text(x, decimals) result(string)
      real(wp), intent(in) :: x
      integer, intent(in) :: decimals
      character(len=:), allocatable :: string
      character(len=40) :: buffer
      write (buffer, '(ss,f40.'//decimals_in_format(decimals)//')') x
      string = trim(adjustl(buffer))
      ! what rounds to zero has no sign
      if (verify(string, '-0.') == 0) string = string(1 + index(string, '-'):)
   end function fixed_text

   pure function lower_case(string) result(lower)
      character(len=*), intent(in) :: string
      character(len=len(string)) :: lower
      integer :: i, code
      lower = string
      do i = 1, len(string)
         code = iachar(string(i:i))
         if (code >= iachar('A') .and. code <= iachar('Z')) lower(i:i) = achar(code + 32)
      end do
   end function lower_case

   !> The text with question marks for control characters and for bytes that are not UTF-8, so that an error stays
   !> one line that any terminal shows as it is.
   pure function printable(text)
      character(len=*), intent(in) :: text
      character(len=len(text)) :: printable
      integer :: i, length
      printable = text
      i = 1
      do while (i <= len(text))
         length = utf8_length(text(i:))
         if (length == 0) then
            printable(i:i) = '?'
         else if (is_control(text(i:i + length - 1))) then
            printable(i:i + length - 1) = repeat('?', length)
         end if
         i = i + max(length, 1)
      end do
   end function printable

   !> True for the control characters of ASCII and Latin-1 and for the separators of lines and paragraphs.
   pure logical function is_control(character)
      character(len=*), intent(in) :: character
      is_control = character < ' ' .or. character == achar(127) &
         & .or. character >= char(194)//char(128) .and. character <= char(194)//char(159) &
         & .or. character == char(226)//char(128)//char(168) .or. character == char(226)//char(128)//char(169)
   end function is_control

   !> The text, or its beginning and three points where it is too long for a message.
   pure function shortened(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: shortened
      integer, parameter :: most = 80
      shortened = text
      if (len(text) > most) shortened = text(:most - 3)//'...'
   end function shortened

   !> True where all of the text is UTF-8.
   pure logical function is_utf8(text)
      character(len=*), intent(in) :: text
      integer :: i, length
      is_utf8 = .false.
      i = 1
      do while (i <= len(text))
         length = utf8_length(text(i:))
         if (length == 0) return
         i = i + length
      end do
      is_utf8 = .true.
   end function is_utf8

   !> Bytes of the character that the text starts with; 0 where that is not UTF-8.
   pure integer function utf8_length(text) result(length)
      character(len=*), intent(in) :: text
      integer :: first, second, i
      first = ichar(text(1:1))
      length = merge(1, 0, first < 128)
      if (first < 194 .or. first > 244) return
      length = 2 + merge(1, 0, first >= 224) + merge(1, 0, first >= 240)
      if (len(text) < length) length = 0
      do i = 2, length
         if (ichar(text(i:i)) < 128 .or. ichar(text(i:i)) > 191) length = 0
      end do
      if (length < 3) return
      ! longer than need be, the halves of a surrogate pair, beyond the last character
      second = ichar(text(2:2))
      if (first == 224 .and. second < 160 .or. first == 237 .and. second > 159 &
         & .or. first == 240 .and. second < 144 .or. first == 244 .and. second > 143) length = 0
   end function utf8_length

   !> The text with something else for each of these characters.
   pure function replaced(text, character, by)
      character(len=*), intent(in) :: text, by
      character(len=1), intent(in) :: character
      character(len=:), allocatable :: replaced
      integer :: i
      replaced = ''
      do i = 1, len(text)
         if (text(i:i) == character) then
            replaced = replaced//by
         else
            replaced = replaced//text(i:i)
         end if
      end do
   end function replaced

   !> A number from 0 to 2**62 that tells a text from another, though not against intent: two remainders of 31 bits.
   !> With `before`, the checksum of what comes before the text, it is that of both together.
   pure integer(i8) function checksum(text, before)
      character(len=*), intent(in) :: text
      integer(i8), intent(in) :: before
      integer(i8), parameter :: prime = 2_i8**31 - 1, factors(2) = [48271_i8, 69621_i8]
      integer(i8) :: remainders(2)
      integer :: i
      remainders = [before/2_i8**31, mod(before, 2_i8**31)]
      do i = 1, len(text)
         remainders = mod(remainders*factors + ichar(text(i:i)) + 1, prime)
      end do
      checksum = remainders(1)*2_i8**31 + remainders(2)
   end function checksum

   !> Which of some checksums are the first of their value.
   pure function is_first(sums)
      integer(i8), intent(in) :: sums(:)
      logical :: is_first(size(sums))
      !> By the place that a checksum asks for, or the next that was free: which was the first.
      integer :: firsts(0:2*size(sums))
      integer :: k, at
      firsts = 0
      do k = 1, size(sums)
         at = int(modulo(sums(k), size(firsts, kind=i8)))
         do while (firsts(at) > 0)
            if (sums(firsts(at)) == sums(k)) exit
            at = modulo(at + 1, size(firsts))
         end do
         is_first(k) = firsts(at) == 0
         if (is_first(k)) firsts(at) = k
      end do
   end function is_first

   !> " (did you mean mass?)", or nothing where no known word is like this one. `known` are separated by blanks.
   pure function did_you_mean(word, known) result(text)
      character(len=*), intent(in) :: word, known
      character(len=:), allocatable :: text, found
      integer :: score
      call find_similar(word, known, found, score)
      text = ''
      if (found /= '') text = ' (did you mean '//found//'?)'
   end function did_you_mean

   !> Those of the known words that are most like the word, joined by "or", and how much: 0 for the same. Of a known
   !> word "group%name" the name alone is compared.
   pure subroutine find_similar(word, known, found, score)
      character(len=*), intent(in) :: word, known
      character(len=:), allocatable, intent(out) :: found
      integer, intent(out) :: score
      integer :: first, last, here, proposed
      found = ''
      score = unlike
      proposed = 0
      first = 1
      do while (first <= len(known))
         last = first + index(known(first:)//' ', ' ') - 2
         here = unlike
         if (last >= first) here = likeness(word, known(first + index(known(first:last), '%'):last))
         if (here < score) then
            score = here
            found = ''
            proposed = 0
         end if
         if (here == score .and. here < unlike) then
            proposed = proposed + 1
            if (found /= '') found = found//' or '
            found = found//known(first:last)
         end if
         first = last + 2
      end do
      if (proposed > most_proposed) found = ''
      if (proposed > most_proposed) score = unlike
   end subroutine find_similar

   !> 0: the same; 1: its beginning; 2: some of its parts between underscores; above that the number of edits.
   pure integer function likeness(word, known)
      character(len=*), intent(in) :: word, known
      integer :: edits
      likeness = unlike
      if (word == '') return
      if (word == known) then
         likeness = 0
      else if (index(known, word) == 1) then
         likeness = 1
      else if (index('_'//known//'_', '_'//word//'_') > 0) then
         likeness = 2
      else if (len(word) <= 2*len(known)) then
         edits = distance(word, known)
         ! one edit for each three letters
         if (edits <= (max(len(word), len(known)) + 1)/3 .and. edits < len(known)) likeness = 2 + edits
      end if
   end function likeness

   !> How many letters are to be put in, left out, replaced or exchanged with the next one.
   pure integer function distance(a, b)
      character(len=*), intent(in) :: a, b
      integer :: edits(0:len(a), 0:len(b))
      integer :: i, j
      edits(:, 0) = [(i, i=0, len(a))]
      edits(0, :) = [(j, j=0, len(b))]
      do j = 1, len(b)
         do i = 1, len(a)
            edits(i, j) = min(edits(i - 1, j) + 1, edits(i, j - 1) + 1, &
               & edits(i - 1, j - 1) + merge(0, 1, a(i:i) == b(j:j)))
            if (i == 1 .or. j == 1) cycle
            if (a(i:i) == b(j - 1:j - 1) .and. a(i - 1:i - 1) == b(j:j)) then
               edits(i, j) = min(edits(i, j), edits(max(i - 2, 0), max(j - 2, 0)) + 1)
            end if
         end do
      end do
      distance = edits(len(a), len(b))
   end function distance
end module text
