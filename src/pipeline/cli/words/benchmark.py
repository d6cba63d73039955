"""./reproduce benchmark: ratios of speed, measured now."""

import argparse
import subprocess
import sys

from ..packages import add_packages


def run(word, arguments, start) -> int:
    """Print one table of ratios of speed."""
    argparse.ArgumentParser(
        prog="reproduce benchmark",
        description="Print one table of ratios of speed, measured now on one core.",
    ).parse_args(arguments)
    return add_packages("study") or subprocess.call(
        [sys.executable, "-P", "-m", "pseudorigid.study.bench"]
    )
