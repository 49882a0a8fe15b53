!> What file and console have of the shape of a bearing in operation.
module shape_results
   use kinds, only: wp
   use text, only: to_text, fixed_text, micro
   use errors, only: error_type, raise, system_error
   use record, only: record_type
   use case_groups, only: bearing_type
   use bearing_shape, only: bearing_shape_type
   use summary_group, only: put_figure
   implicit none (type, external)
   private
   public :: put_shape, read_shape, print_shape

contains

   !> Writes radius, clearances and what has changed them.
   subroutine put_shape(file, shape)
      class(record_type), intent(inout) :: file
      type(bearing_shape_type), intent(in) :: shape
      call put('journal_radius', shape%journal_radius, 'm', 'radius of the journal in operation')
      call put('machined_clearance', shape%machined_clearance, 'm', 'clearance between bore and journal in operation')
      call put('assembled_clearance', shape%assembled_clearance, 'm', 'clearance at the pivots in operation')
      call put('pivot_distance', shape%pivot_distance, 'm', 'distance from the bore to the pivot in operation')
      call put('elastic_bending', shape%bending%elastic, 'm', &
         & 'change of the pad clearance as the pressure bends the pad')
      call put('thermal_bending', shape%bending%thermal, 'm', 'change of the pad clearance as heat bends the pad')
      call put_figure(file, 'equilibrium_bearing_clearance', minval(shape%assembled_clearance), 'm', &
         & 'bearing clearance in operation')
      associate (t => shape%temperatures)
         if (.not. allocated(t%pads)) return
         call put('shaft_temperature', t%shaft, 'degC', 'temperature of the shaft that expands')
         call put('housing_temperature', t%housing, 'degC', 'temperature of the housing that expands')
         call put('pad_temperature', t%pads, 'degC', 'temperature of the pad that expands')
      end associate
   contains
      !> A number, or one of each pad.
      subroutine put(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(..)
         call file%put('shape/'//name, values, units, long_name, 'pad')
      end subroutine put
   end subroutine put_shape

   !> Gives a shape the lengths that the file of its bearing has; an error where it has none.
   subroutine read_shape(file, shape, error)
      class(record_type), intent(in) :: file
      type(bearing_shape_type), intent(inout) :: shape
      type(error_type), allocatable, intent(inout) :: error
      shape%journal_radius = file%get_real('shape/journal_radius')
      call file%get_list('shape/machined_clearance', shape%machined_clearance)
      call file%get_list('shape/assembled_clearance', shape%assembled_clearance)
      call file%get_list('shape/pivot_distance', shape%pivot_distance)
      associate (lengths => shape%lengths())
         if (.not. (all(lengths > 0) .and. all(lengths < huge(lengths)))) call raise(error, system_error, &
            & 'damaged: shape is not that of a bearing')
      end associate
   end subroutine read_shape

   !> The clearances of a bearing and those in operation.
   subroutine print_shape(b, shape)
      type(bearing_type), intent(in) :: b
      type(bearing_shape_type), intent(in) :: shape
      character(len=:), allocatable :: bends
      integer :: i
      associate (t => shape%temperatures)
         do i = 1, size(shape%machined_clearance)
            bends = ''
            if (b%pads%bending /= 'none') bends = '; bends by '//micro(shape%bending%elastic(i), 2) &
               & //' um by pressure and '//micro(shape%bending%thermal(i), 2)//' um by heat'
            if (allocated(t%pads)) bends = bends//'; at '//fixed_text(t%pads(i), 1)//' C'
            print '(a)', '  pad '//to_text(i)//': pad clearance '//micro(b%machined_clearance(i), 2) &
               & //' um, in operation '//micro(shape%machined_clearance(i), 2)//'; at the pivot ' &
               & //micro(b%assembled_clearance(i), 2)//' um, in operation '//micro(shape%assembled_clearance(i), 2) &
               & //bends
         end do
         if (allocated(t%pads)) print '(a)', '  all pads: clearances of '//fixed_text(b%clearance_temperature, 1) &
            & //' C, the shaft at '//fixed_text(t%shaft, 1)//' C and the housing at '//fixed_text(t%housing, 1)//' C'
      end associate
   end subroutine print_shape
end module shape_results
