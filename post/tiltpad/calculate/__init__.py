"""Calculating with runs: parts of the motion, spectra, friction, film pressure, key figures."""
