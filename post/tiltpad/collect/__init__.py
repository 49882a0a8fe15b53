"""Collecting: the results of many runs become a study, one file."""
