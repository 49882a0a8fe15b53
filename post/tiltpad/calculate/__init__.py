"""What is calculated from a run: parts of its motion, spectra, friction, film pressure, key figures."""
