"""Progress and checkpoints of a run."""

import os
import time
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

EVERY = 15.0  # seconds between two checkpoints


class Monitor:
    """Reports the progress of a run, and saves checkpoints every EVERY seconds.

    `progress` is called at most once a second, and at the end, with the share done and the seconds
    left.
    """

    def __init__(self, run, progress: Callable | None, checkpoint: Path | None):
        self.progress, self.checkpoint = progress, checkpoint
        self.begin = self.reported = self.saved = time.monotonic()
        self.total = self._work_left(run)

    def after_impact(self, run) -> None:
        """Report and save what is due."""
        now = time.monotonic()
        if self.progress is not None and (now - self.reported > 1.0 or run.count == run.impacts):
            self.reported = now
            left = self._work_left(run)
            done = max(self.total - left, 1e-9)
            self.progress(run.count / run.impacts, (now - self.begin) * left / done)
        if self.checkpoint is not None and now - self.saved > EVERY and run.count < run.impacts:
            self.saved = now
            identity = run.start.identity(run.impacts)
            values = run.values[: run.count]
            save(self.checkpoint, identity=identity, state=run.state(), values=values)

    @staticmethod
    def _work_left(run):
        """Work left, in impacts of 64 bits: an impact of b bits costs about 1 + (b/6000)^1.6."""
        return (run.impacts - run.count) * (1.0 + (run.precision / 6000.0) ** 1.6 / 2.6)


def save(path: Path, **arrays) -> None:
    """Write arrays to a file, whole or not at all."""
    part = path.with_name(path.name + ".writing")
    with open(part, "wb") as file:
        np.savez(file, **arrays)
    os.replace(part, path)


def load(path: Path, identity: str) -> dict[str, np.ndarray] | None:
    """Read the arrays of `save`; None if the file is missing, damaged or has another identity."""
    try:
        with np.load(path) as file:
            arrays = {name: file[name] for name in file.files}
            return arrays if str(arrays["identity"]) == identity else None
    except (OSError, ValueError, EOFError, KeyError, zipfile.BadZipFile):
        return None
