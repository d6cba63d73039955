"""./reproduce test: run pytest in the place of this program."""

import os
import sys

from ..arguments import Arguments


def run(args: Arguments) -> int:
    """Replace this process by pytest."""
    os.execv(sys.executable, [sys.executable, "-m", "pytest", *args.options])
