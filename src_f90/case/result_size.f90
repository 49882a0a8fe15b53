!> How many samples a march takes, how large its file becomes, and which memory its figures take.
module result_size
   use kinds, only: wp, i8, pi
   use text, only: to_text
   use case_groups, only: bearing_type
   use case_inputs, only: case_type
   implicit none (type, external)
   private
   public :: sample_interval, sample_count, figure_samples, result_bytes, memory_bytes, memory_advice, bytes_text, &
      & size_note

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

   !> Samples that the figures of the last revolutions are of at most, as many revolutions as spectra cover, and one
   !> more.
   pure integer(i8) function figure_samples(inputs) result(samples)
      type(case_type), intent(in) :: inputs
      real(wp) :: angle, last, acceleration, square, time
      samples = 0
      if (inputs%about%task == 'periodic') samples = 1 + int(inputs%periodic%revolutions, i8) &
         & *inputs%output%samples_per_revolution
      if (inputs%about%task /= 'march') return
      samples = max(0_i8, sample_count(inputs))
      angle = 2*pi*(1 + real(inputs%output%spectrum_revolutions, wp))
      last = inputs%operation%final_speed_rpm*pi/30
      acceleration = (last - inputs%operation%speed_rpm*pi/30)/inputs%operation%duration
      ! back from the end the shaft turns by last t - acceleration t^2/2
      square = last**2 - 2*acceleration*angle
      if (square < 0 .or. .not. last > 0) return
      time = 2*angle/(last + sqrt(square))
      samples = min(samples, 2 + ceiling(min(time/sample_interval(inputs), 1e15_wp), i8))
   end function figure_samples

   !> Bytes of the result of a case; 0 where nothing is marched.
   pure real(wp) function result_bytes(inputs) result(bytes)
      type(case_type), intent(in) :: inputs
      integer(i8) :: samples
      bytes = 0
      if (inputs%about%task /= 'march' .or. inputs%output%keep == 'summary') return
      samples = max(0_i8, sample_count(inputs))
      if (inputs%output%keep == 'last_revolutions') samples = figure_samples(inputs)
      bytes = of_frame + of_value*values_of_sample(inputs)*real(samples, wp)
   end function result_bytes

   !> Values of a sample: the series that docs/results.md lists.
   pure integer function values_of_sample(inputs) result(values)
      type(case_type), intent(in) :: inputs
      integer :: b
      values = 3 + 2*size(inputs%excitations) + 2*inputs%rotor%station_count()
      values = values + 4*size(inputs%element_labels())
      do b = 1, size(inputs%bearings)
         values = values + values_of_bearing(inputs%bearings(b), inputs%has_slopes(b)) &
            & + merge(2, 0, any(inputs%inclined() == b))
      end do
   end function values_of_sample

   !> Values of a sample that are those of one bearing.
   pure integer function values_of_bearing(bearing, slopes_count) result(values)
      type(bearing_type), intent(in) :: bearing
      logical, intent(in) :: slopes_count
      integer :: of_pad, turning
      ! each with its rate, its friction and, with bristles, these
      turning = merge(1, 0, bearing%pitching()) + merge(1, 0, bearing%yawing())
      of_pad = 4
      if (bearing%tilting()) of_pad = of_pad + 4
      if (bearing%tilting_radial()) of_pad = of_pad + 2
      of_pad = of_pad + 3*turning
      if (bearing%tilting() .and. bearing%friction%model == 'lugre') of_pad = of_pad + 1 + turning
      if (slopes_count) of_pad = of_pad + 4
      if (bearing%asperity%model /= 'none') of_pad = of_pad + 1
      values = merge(6, 4, slopes_count) + of_pad*bearing%pad_count()
   end function values_of_bearing

   !> Bytes of memory that a run takes at most beyond those of its start; the figures of its last revolutions, where it
   !> has samples, are the only part that a case can make large.
   pure real(wp) function memory_bytes(inputs) result(bytes)
      type(case_type), intent(in) :: inputs
      integer :: values, b
      ! two series of the pads are held at once, and besides them those of the journal and a spectrum, which takes most
      ! where the number of samples is prime
      values = 2*inputs%rotor%station_count()
      do b = 1, size(inputs%bearings)
         values = values + 2*inputs%bearings(b)%pad_count() + 17
      end do
      if (inputs%output%keep /= 'all') values = values + values_of_sample(inputs)
      bytes = of_run + of_value*values*figure_samples(inputs)
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
