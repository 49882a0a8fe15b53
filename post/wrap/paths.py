"""Prints for the shell where the headers for a compiled part of Python lie, and how the name of one ends."""

import sysconfig

import numpy as np
import numpy.f2py

print(f"python='{sysconfig.get_path('include')}'")
print(f"numpy='{np.get_include()}'")
print(f"f2py='{numpy.f2py.get_include()}'")
print(f"suffix='{sysconfig.get_config_var('EXT_SUFFIX')}'")
