"""The workflow: it turns config.yaml into files and checks them."""

import getpass
import os
import signal
import sys

# Ctrl-C ends `python -m` without a traceback while there is nothing to clean up, so from here on.
if sys.argv[:1] == ["-m"] and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)

from .loading import Finder

if Finder not in sys.meta_path:
    sys.meta_path.insert(0, Finder)

# Read when netCDF4 is loaded. Files are written whole, so that HDF5 need not lock them, which fails
# on file systems without locks.
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

from pseudorigid.kernel import compiled  # loaded from its text

from .records import sources

compiled.name_folders_by(sources.digest_of_loaded)

# Snakemake asks for the user's name and makes a cache. In a container, a user may be a number that
# has no name, and no home.
os.environ.setdefault("XDG_CACHE_HOME", str(sources.ROOT / ".venv" / "cache"))
try:
    getpass.getuser()
except (KeyError, OSError):
    os.environ["LOGNAME"] = str(os.getuid())
