"""Drawing: pictures of runs and of studies, and the page about a run; these modules load matplotlib."""
