"""./reproduce benchmark: measure speeds and print their ratios."""

import subprocess
import sys

from ..arguments import Arguments
from ..packages import add_packages


def run(args: Arguments) -> int:
    """Print a table of the map's speed."""
    add_packages("study")
    return subprocess.call([sys.executable, "-P", "-m", "pseudorigid.study.bench"])
