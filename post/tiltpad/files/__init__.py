"""Reading: result files and studies, the namelist in them, units."""
