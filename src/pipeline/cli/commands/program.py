"""./reproduce test and ./reproduce benchmark: run a program in the place of this one."""

import os
import sys

from ...declaration import extensions
from ..arguments import Arguments

_MODULES = {"test": "pytest", "benchmark": "study.bench"}


def run(args: Arguments) -> int:
    """Replace this process by the program."""
    module = _MODULES[str(args.word)]
    more = [e.benchmark for e in extensions().values() if e.benchmark and args.word == "benchmark"]
    os.execv(sys.executable, [sys.executable, "-m", module, *more, *args.options])
