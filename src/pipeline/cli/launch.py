"""What ./reproduce does once .venv is ready: pytest, or snakemake and a table of the figures."""

import difflib
import os
import subprocess
import sys
from pathlib import Path

from .. import config
from .interrupts import tidying_up
from .packages import add_packages
from .runner import BUSY, ROOT, hold_lock, workflow

START = Path.cwd()


def set_environment() -> None:
    """The tree's own package wherever the folder was moved, and caches that need no home folder."""
    caches = ROOT / ".venv" / "cache"
    os.environ["PYTHONPATH"] = str(ROOT / "src")
    os.environ["XDG_CACHE_HOME"] = str(caches)
    os.environ["MPLCONFIGDIR"] = str(caches / "matplotlib")
    os.environ.pop("MPLBACKEND", None)  # nothing here opens a window


def test(arguments: list[str]) -> int:
    """Hand over to pytest; its exit status is ours."""
    os.execv(sys.executable, [sys.executable, "-m", "pytest", *arguments])


def verify(arguments: list[str]) -> int:
    """Say for each figure whether it is the committed one, or what differs."""
    from ..checks.verify import verify

    with tidying_up():
        return verify(ROOT, arguments, START)


def accept(arguments: list[str]) -> int:
    """Make the figures as they are now the committed ones."""
    from ..checks.verify import accept

    lock = hold_lock()
    if lock is None:
        print(BUSY, file=sys.stderr)
        return 1
    with tidying_up():
        return accept(ROOT, arguments)


def study(arguments: list[str]) -> int:
    """The study's data and charts, with the packages of its rivals."""
    return add_packages("study") or workflow(["study", *arguments])


def benchmark(arguments: list[str]) -> int:
    """One table of ratios of speed, measured now."""
    if arguments:
        print("reproduce: benchmark takes no arguments", file=sys.stderr)
        return 1
    return add_packages("study") or subprocess.call(
        [sys.executable, "-m", "pseudorigid.study.bench"]
    )


def variant(arguments: list[str]) -> int:
    """The figures of one variant."""
    from .variants import variant

    return variant(arguments)


def compare(arguments: list[str]) -> int:
    """What differs between two variants."""
    from .variants import compare

    return compare(arguments)


def report(arguments: list[str]) -> int:
    """One HTML page with the figures."""
    from .reporting import report

    return report(arguments)


def sweep(arguments: list[str]) -> int:
    """The datasets of the sweeps, or of those named first."""
    from .sweeps import sweep

    return sweep(arguments)


def atlas(arguments: list[str]) -> int:
    """The pictures of the sweeps, and whatever they still need."""
    from .sweeps import atlas

    return atlas(arguments)


WORDS = {
    "test": test,
    "verify": verify,
    "accept": accept,
    "variant": variant,
    "compare": compare,
    "report": report,
    "study": study,
    "benchmark": benchmark,
    "sweep": sweep,
    "atlas": atlas,
}


def main(arguments: list[str]) -> int:
    """Run one word, or snakemake."""
    os.chdir(ROOT)
    set_environment()
    word, *rest = arguments or [""]
    meant = difflib.get_close_matches(word, WORDS, 1, 0.75)
    if meant and word not in WORDS:
        print(f"reproduce: no word {word}: did you mean {meant[0]}?", file=sys.stderr)
        return 1
    try:
        return WORDS[word](rest) if word in WORDS else workflow(arguments)
    except config.ConfigError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
