"""./reproduce benchmark: run `bench` with the rows that parts add, in the place of this process."""

import os
import sys

from pipeline.cli.arguments import Arguments
from pipeline.declaration import parts


def run(args: Arguments) -> int:
    """Replace this process by the benchmark."""
    more = [part.benchmark for part in parts().values() if part.benchmark]
    os.execv(sys.executable, [sys.executable, "-m", "study.bench", *more, *args.options])
