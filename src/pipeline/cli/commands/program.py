"""./reproduce test and ./reproduce benchmark: run a program that needs further packages."""

import os
import sys

from ...declaration import extensions
from ..arguments import Arguments
from ..packages import add_packages

# Command -> its requirements, and the module that is run.
_PROGRAMS = {"test": ("test", "pytest"), "benchmark": ("study", "study.bench")}


def run(args: Arguments) -> int:
    """Install the packages and replace this process by the program."""
    requirements, module = _PROGRAMS[str(args.word)]
    add_packages(requirements)
    more = [e.benchmark for e in extensions().values() if e.benchmark and args.word == "benchmark"]
    os.execv(sys.executable, [sys.executable, "-m", module, *more, *args.options])
