"""Exit status 0 if a compiled part can be built for this Python: it has headers and can make environments."""

import ensurepip  # noqa: F401 - what python3-venv brings
import sys
import sysconfig
from pathlib import Path

sys.exit(not Path(sysconfig.get_path("include"), "Python.h").exists())
