!> How many samples a march takes, how large its file becomes, and which memory its figures take.
module result_size
   use kinds, only: wp, i8, pi
   use text, only: to_text
   use case_inputs, only: case_type
   implicit none (type, external)
   private
   public :: sample_interval, sample_count, result_bytes, memory_bytes, memory_advice, bytes_text, size_note

   !> From this number of bytes on, the size is printed before a run.
   real(wp), parameter :: large = 100e6_wp
   !> Bytes of a value, and of a file without samples.
   real(wp), parameter :: of_value = 8, of_frame = 1e5_wp
   !> Bytes of memory of a run but its figures; the examples take 3 to 6 MB, with other libraries more.
   real(wp), parameter :: of_run = 12e6_wp

contains

   !> Time between samples, s.
   pure real(wp) function sample_interval(inputs) result(interval)
      type(case_type), intent(in) :: inputs
      interval = 2*pi/(inputs%highest_speed()*inputs%output%samples_per_revolution)
   end function sample_interval

   !> Samples of a march that reaches its end; a last one that misses the end by rounding alone is taken.
   pure integer(i8) function sample_count(inputs) result(samples)
      type(case_type), intent(in) :: inputs
      samples = 1 + floor((inputs%operation%duration - inputs%output%start_time)/sample_interval(inputs) + 1e-6_wp, i8)
   end function sample_count

   !> Bytes of the result of a case; 0 where nothing is marched.
   pure real(wp) function result_bytes(inputs) result(bytes)
      type(case_type), intent(in) :: inputs
      integer :: of_pad
      bytes = 0
      if (inputs%about%task /= 'march') return
      ! the series that docs/results.md lists
      of_pad = 4
      if (inputs%tilting()) of_pad = of_pad + 4
      if (inputs%tilting_radial()) of_pad = of_pad + 2
      if (inputs%tilting() .and. inputs%friction%model == 'lugre') of_pad = of_pad + 1
      if (inputs%asperity%model /= 'none') of_pad = of_pad + 1
      bytes = of_frame + of_value*(7 + of_pad*inputs%pad_count())*max(0.0_wp, real(sample_count(inputs), wp))
   end function result_bytes

   !> Bytes of memory that a run takes at most beyond those of its start; the figures of its last revolutions, where it
   !> has samples, are the only part that a case can make large.
   pure real(wp) function memory_bytes(inputs) result(bytes)
      type(case_type), intent(in) :: inputs
      real(wp) :: samples
      bytes = of_run
      associate (output => inputs%output)
         samples = 1 + real(output%spectrum_revolutions, wp)*output%samples_per_revolution
         select case (inputs%about%task)
         case ('march')
            samples = min(samples, real(sample_count(inputs), wp))
         case ('periodic')
            samples = min(samples, 1 + real(inputs%periodic%revolutions, wp)*output%samples_per_revolution)
         case default
            return
         end select
      end associate
      ! two series of the pads are held at once, and besides them those of the journal and a spectrum, which takes most
      ! where the number of samples is prime
      bytes = bytes + of_value*(2*inputs%pad_count() + 17)*max(0.0_wp, samples)
   end function memory_bytes

   !> What makes it less, where the figures take most of it.
   pure function memory_advice(inputs) result(advice)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: advice
      advice = ''
      if (memory_bytes(inputs) > 2*of_run) advice = '; fewer output%spectrum_revolutions or ' &
         & //'output%samples_per_revolution need less'
   end function memory_advice

   !> "540 MB".
   pure function bytes_text(bytes) result(text)
      real(wp), intent(in) :: bytes
      character(len=:), allocatable :: text
      if (bytes < 1e9_wp) then
         text = to_text(nint(bytes/1e6_wp))//' MB'
      else
         text = to_text(0.1_wp*anint(bytes/1e8_wp))//' GB'
      end if
   end function bytes_text

   !> A note where this many results of the case are large together; else empty.
   function size_note(inputs, results) result(note)
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: results
      character(len=:), allocatable :: note
      note = ''
      if (results*result_bytes(inputs) < large) return
      note = 'note: about '//bytes_text(results*result_bytes(inputs))//' of results, ' &
         & //to_text(sample_count(inputs))//' samples'
      if (results > 1) note = note//' in each of '//to_text(results)//' files'
      note = note//'; a later output%start_time or fewer output%samples_per_revolution make them smaller'
   end function size_note
end module result_size
