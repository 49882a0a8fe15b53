"""Exit status 0 where a compiled part can be made for this Python: its headers are here, and it can make environments."""

import ensurepip  # noqa: F401 - what python3-venv brings
import sys
import sysconfig
from pathlib import Path

sys.exit(not Path(sysconfig.get_path("include"), "Python.h").exists())
