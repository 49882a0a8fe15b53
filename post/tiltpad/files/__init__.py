"""What is read: result files and studies, their input as a namelist, units."""
