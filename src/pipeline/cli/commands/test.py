"""./reproduce test: run the test suite."""

import os
import sys

from ..arguments import Arguments
from ..packages import add_packages


def run(args: Arguments) -> int:
    """Install the packages of the tests and replace this process by pytest."""
    add_packages("test")
    os.execv(sys.executable, [sys.executable, "-m", "pytest", *args.options])
