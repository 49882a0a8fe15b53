!> "Did you mean": what a wrong word is like, of words and of the input variables.
program test_similar_words
   use similar_words, only: did_you_mean, find_similar, unlike
   use variable_names, only: group_names, names_in, meant_variable, meant_group
   use check, only: runs, expect, report
   implicit none (type, external)

   if (runs('slips')) call slips()
   if (runs('order_of_likeness')) call order_of_likeness()
   if (runs('variables')) call variables()
   call report()

contains

   subroutine expect_text(found, expected)
      character(len=*), intent(in) :: found, expected
      call expect(found == expected .and. len(found) == len(expected), '"'//expected//'" came out as "'//found//'"')
   end subroutine expect_text

   !> A letter too many, too few, wrong, two exchanged; what is too far off has no answer.
   subroutine slips()
      character(len=*), parameter :: known = 'march equilibrium lugre'
      call expect_text(did_you_mean('marrch', known), ' (did you mean march?)')
      call expect_text(did_you_mean('mrch', known), ' (did you mean march?)')
      call expect_text(did_you_mean('mqrch', known), ' (did you mean march?)')
      call expect_text(did_you_mean('mrahc', known), ' (did you mean march?)')
      call expect_text(did_you_mean('mrahx', known), '')
      call expect_text(did_you_mean('equlibirum', known), ' (did you mean equilibrium?)')
      call expect_text(did_you_mean('', known), '')
      call expect_text(did_you_mean('march', ''), '')
      call expect_text(did_you_mean(repeat('m', 5000), known), '')
   end subroutine slips

   !> The same name before its beginning, that before a part, that before a slip; of too many none is proposed.
   subroutine order_of_likeness()
      character(len=:), allocatable :: found
      integer :: score
      call find_similar('mass', 'a%mass_flow b%mass c%mass', found, score)
      call expect_text(found, 'b%mass or c%mass')
      call expect(score == 0, 'the same name')
      call find_similar('mass', 'own_mass massive masse', found, score)
      call expect_text(found, 'massive or masse')
      call find_similar('mass', 'masks own_mass', found, score)
      call expect_text(found, 'own_mass')
      call find_similar('x', 'x_1 x_2 x_3', found, score)
      call expect_text(found, 'x_1 or x_2 or x_3')
      call find_similar('x', 'x_1 x_2 x_3 x_4', found, score)
      call expect_text(found, '')
      call expect(score == unlike, 'four are too many')
   end subroutine order_of_likeness

   !> In the group, in another one, without a group, in a group that does not exist.
   subroutine variables()
      call expect_text(names_in('rotor'), ' mass unbalance balance_grade balance_speed_rpm gravity static_load')
      call expect_text(names_in('roto'), '')
      call expect(index(group_names()//' ', ' case rotor operation bearing ') == 1, 'groups in their order')
      call expect_text(meant_variable('operation', 'sped_rpm'), ' (did you mean speed_rpm?)')
      call expect_text(meant_variable('operation', 'mass'), ' (did you mean rotor%mass or pads%mass?)')
      call expect_text(meant_variable('', 'speed_rpm'), ' (did you mean operation%speed_rpm?)')
      call expect_text(meant_variable('bearing', 'clearance'), &
         & ' (did you mean machined_clearance or assembled_clearance?)')
      call expect_text(meant_variable('rotor', 'weight_of_all'), '')
      call expect_text(meant_group('opration'), ' (did you mean operation?)')
      call expect_text(meant_group('sweeps'), ' (did you mean sweep?)')
   end subroutine variables
end program test_similar_words
