"""Progress and checkpoints of a run."""

import os
import time
import zipfile

import numpy as np

EVERY = 15.0  # seconds between two checkpoints


class Clock:
    """Progress and checkpoints.

    Parameters
    ----------
    run : Run
    progress : callable or None
        Called at most once a second, and at the end, with the share done and the seconds left.
    checkpoint : Path or None
        Written every EVERY seconds.
    """

    def __init__(self, run, progress, checkpoint):
        self.progress, self.checkpoint = progress, checkpoint
        self.begin = self.said = self.saved = time.monotonic()
        self.first = run.count
        self.total = self._work(run)

    def tick(self, run):
        """Tell and save what is due after an impact."""
        now = time.monotonic()
        if self.progress is not None and (now - self.said > 1.0 or run.count == run.impacts):
            self.said = now
            left = self._work(run)
            spent = max(self.total - left, 1e-9)
            self.progress(run.count / run.impacts, (now - self.begin) * left / spent)
        if self.checkpoint is not None and now - self.saved > EVERY and run.count < run.impacts:
            self.saved = now
            save(
                self.checkpoint, identity=run.place.identity(run.impacts), state=run.state(),
                values=run.values[: run.count],
            )  # fmt: skip

    @staticmethod
    def _work(run):
        """What is left, in impacts of 64 bits: an impact of b costs about 1 + (b/6000)^1.6."""
        return (run.impacts - run.count) * (1.0 + (run.digits / 6000.0) ** 1.6 / 2.6)


def save(path, **arrays):
    """Write arrays to a file, whole or not at all.

    Parameters
    ----------
    path : Path
    **arrays : array
    """
    part = path.with_name(path.name + ".writing")
    with open(part, "wb") as file:
        np.savez(file, **arrays)
    os.replace(part, path)


def load(path, identity):
    """The arrays of a file that `save` wrote.

    Parameters
    ----------
    path : Path
    identity : str
        What the file's own must be.

    Returns
    -------
    dict or None
        None if it is missing, damaged or of something else.
    """
    try:
        with np.load(path) as file:
            found = {name: file[name] for name in file.files}
            return found if str(found["identity"]) == identity else None
    except (OSError, ValueError, EOFError, KeyError, zipfile.BadZipFile):
        return None
