"""./reproduce benchmark: ratios of speed, measured now."""

import subprocess
import sys

from ..packages import add_packages


def run(given) -> int:
    """Print one table of ratios of speed."""
    return add_packages("study") or subprocess.call(
        [sys.executable, "-P", "-m", "pseudorigid.study.bench"]
    )
