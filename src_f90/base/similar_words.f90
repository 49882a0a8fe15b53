!> "Did you mean": which known words a wrong one may stand for.
module similar_words
   implicit none (type, external)
   private
   public :: find_similar, did_you_mean, unlike

   !> The score of a word that no known one is like.
   integer, parameter :: unlike = huge(1)
   !> Most words that a message proposes; where more are as much alike, none helps.
   integer, parameter :: most_proposed = 3

contains

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
end module similar_words
