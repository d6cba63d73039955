"""./reproduce test: the test suite."""

import os
import sys

from ..packages import add_packages


def run(args) -> int:
    """Install the packages of the tests and hand over to pytest; its exit status is ours."""
    add_packages("test")
    os.execv(sys.executable, [sys.executable, "-m", "pytest", *args.options])
