"""Around a run of sweeps: which are meant, the space they need, and how far they are."""

import shutil
import sys
import threading
import time
from contextlib import contextmanager

from pseudorigid.sweep import grid

from ...config import places, unknown
from ...config.expected import needed
from ...records.files import identity
from ..folder import MisuseError, UsageError

PAUSE = 1.0  # seconds between two looks at the files
# Bytes of disk, rounded up from what was measured: a cell in its block and in the dataset, a block
# and snakemake's records of it, and what snakemake writes for any run.
CELL, BLOCK, RUN = 600, 60_000, 10_000_000


def chosen(sweeps, names) -> list[str]:
    """The sweeps that are named, all where none is."""
    for name in names:
        if name not in sweeps:
            raise MisuseError(unknown("sweep", name, list(sweeps)))
    if not sweeps:
        raise UsageError("config.yaml: sweeps: missing, or empty")
    return list(dict.fromkeys(names)) or list(sweeps)


def shortage(blocks, total) -> str | None:
    """One line if the disk has not the space for `blocks` and a dataset of `total` cells."""
    need = RUN + CELL * total + BLOCK * len(blocks)
    free = shutil.disk_usage(".").free
    if free >= need:
        return None
    return f"the disk is full: about {need / 1e6:.0f} MB are needed here, {free / 1e6:.0f} are free"


def progress(sweeps, currency, targets):
    """`told` of the sweeps behind some results; UsageError where the disk has not the space."""
    outdated = currency.outdated(needed(currency.expected, targets))
    blocks, total = {}, 0
    for name, sweep in sweeps.items():
        if places.sweep_dataset(name) in outdated:
            total += grid.cells(sweep)
        files = zip(places.block_files(name, sweep), grid.ranges(sweep), strict=True)
        for path, (start, stop) in files:
            if path in outdated:
                cells = stop - start
                blocks[path] = cells, cells * sweep["starts"] * sweep["impacts"]
    if blocks and (line := shortage(blocks, total)):
        raise UsageError(line)
    return told(blocks, total)


@contextmanager
def told(blocks, total, out=None):
    """Tell how many of `total` cells are done while the body runs.

    The speed is measured from the first block on: before it, jobs may compile the map.

    Parameters
    ----------
    blocks : dict
        Those that are to be written: file -> (cells, impacts).
    total : int
        Cells of all sweeps.
    out : file, optional
        Where the lines go, by default stderr.
    """
    pending = {path: identity(path) for path in blocks}
    first = None  # the time at which the first blocks were there, and their cells and impacts
    ended = threading.Event()

    def tell():
        nonlocal first
        written = [path for path in pending if identity(path) not in (pending[path], None)]
        for path in written:
            del pending[path]
        if written:
            now = time.monotonic()
            done, left = (_sums(blocks, here) for here in (blocks.keys() - pending, pending))
            since = [a - b for a, b in zip((now, *done), first, strict=True)] if first else None
            first = first or (now, *done)
            print(line(total, left, since), file=out or sys.stderr, flush=True)

    def watch():
        while not ended.wait(PAUSE):
            tell()
        tell()

    thread = threading.Thread(target=watch, daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()


def line(total, left, since=None) -> str:
    """How far a sweep of `total` cells is.

    Parameters
    ----------
    total : int
    left : (int, int)
        Cells and impacts that are still to be done.
    since : (float, int, int), optional
        Seconds since the first block, and the cells and impacts done in these.
    """
    text = f"sweep: {total - left[0]:,} of {total:,} cells"
    if since is None:
        return text
    seconds, cells, impacts = since
    text += f", {cells / seconds:.3g} cells/s"
    if not left[0]:
        return text
    minutes, rest = divmod(round(left[1] * seconds / impacts), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{text}, {f'{hours} h {minutes} min' if hours else f'{minutes} min {rest} s'} to go"


def _sums(blocks, paths):
    return sum(blocks[path][0] for path in paths), sum(blocks[path][1] for path in paths)
