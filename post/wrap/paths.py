"""Prints for the shell where the headers for a compiled part of Python lie, and how the name of one ends."""

import shlex
import sysconfig

import numpy as np
import numpy.f2py

PATHS = {
    "python": sysconfig.get_path("include"),
    "numpy": np.get_include(),
    "f2py": numpy.f2py.get_include(),
    "suffix": sysconfig.get_config_var("EXT_SUFFIX"),
}
for name, path in PATHS.items():
    print(f"{name}={shlex.quote(path)}")
