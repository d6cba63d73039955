"""Around a run of snakemake: which blocks must go first, and how far the sweep is.

Snakemake looks at times and parameters, not into files.
"""

import difflib
import os
import shutil
import sys
import threading
import time
from contextlib import contextmanager
from pathlib import Path

from pseudorigid.sweep import grid

from ..config import ConfigError, places
from ..records import sources

PAUSE = 1.0  # seconds between two looks at the files
# Bytes of disk, rounded up from what was measured: a cell in its block and in the dataset, a block
# and snakemake's records of it, and what snakemake writes for any run.
CELL, BLOCK, RUN = 600, 60_000, 10_000_000


def chosen(sweeps, words) -> tuple[list[str], list[str]]:
    """The sweeps named before the first option, all where none is, and the words after them.

    Raises ConfigError for a name that config.yaml has not.
    """
    end = next((i for i, word in enumerate(words) if word.startswith("-")), len(words))
    for name in words[:end]:
        if name not in sweeps:
            near = difflib.get_close_matches(name, sweeps, 1, 0.5)
            known = f"did you mean {near[0]}?" if near else f"there is {', '.join(sweeps)}"
            raise ConfigError(f"config.yaml: sweeps.{name}: no such sweep: {known}")
    if not sweeps:
        raise ConfigError("config.yaml: sweeps: missing, or empty")
    return words[:end] or list(sweeps), words[end:]


def discard(sweeps, names) -> list[str]:
    """Delete blocks and datasets that are damaged or of another grid; a line for each of them."""
    from ..records import blocks as store

    lines = []
    for name in names:
        sweep = sweeps[name]
        for i, path in enumerate(places.block_files(name, sweep)):
            if os.path.lexists(path):
                try:
                    store.load_block(path, grid.block(sweep, i))
                except store.StoreError as error:
                    lines.append(f"{error}: computed again")
                    os.unlink(path)
        path = places.sweep_dataset(name)
        if os.path.lexists(path) and not store.intact(path, places.sweep_record(name)):
            lines.append(f"{path}: not as it was written: joined again")
            os.unlink(path)
    return lines


def lacking(sweeps, names) -> tuple[dict[str, tuple[int, int]], int]:
    """Block -> (cells, impacts), of those missing or older than the code; the cells in all."""
    newest = max(os.stat(path).st_mtime for path in sources.code("sweep_block.py"))
    found = {}
    for name in names:
        sweep = sweeps[name]
        each = sweep["starts"] * sweep["impacts"]
        blocks = zip(places.block_files(name, sweep), grid.ranges(sweep), strict=True)
        for path, (start, stop) in blocks:
            try:
                if os.stat(path).st_mtime >= newest:
                    continue
            except FileNotFoundError:
                pass
            found[path] = stop - start, (stop - start) * each
    return found, sum(grid.cells(sweeps[name]) for name in names)


def shortage(blocks, total) -> str | None:
    """One line if the disk has not the space for `blocks` and a dataset of `total` cells."""
    need = RUN + CELL * total + BLOCK * len(blocks)
    free = shutil.disk_usage(".").free
    if free >= need:
        return None
    return f"the disk is full: about {need / 1e6:.0f} MB are needed here, {free / 1e6:.0f} are free"


@contextmanager
def progress(blocks, total, out=None):
    """While the body runs, tell how many of `blocks` have been written, as given by `lacking`."""
    pending = {path: _identity(path) for path in blocks}
    begin = time.monotonic()
    ended = threading.Event()

    def tell():
        written = [path for path in pending if _identity(path) not in (pending[path], None)]
        for path in written:
            del pending[path]
        if written:
            done, left = (_sums(blocks, here) for here in (blocks.keys() - pending, pending))
            text = line(total, done, left, time.monotonic() - begin)
            print(text, file=out or sys.stderr, flush=True)

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


def line(total, done, left, seconds) -> str:
    """How far a sweep of `total` cells is; `done` in so many seconds and `left`: cells, impacts."""
    text = f"sweep: {total - left[0]:,} of {total:,} cells, {done[0] / seconds:.3g} cells/s"
    if not left[0]:
        return text
    minutes, rest = divmod(round(left[1] * seconds / done[1]), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{text}, {f'{hours} h {minutes} min' if hours else f'{minutes} min {rest} s'} to go"


def _sums(blocks, paths):
    return sum(blocks[path][0] for path in paths), sum(blocks[path][1] for path in paths)


def _identity(path):
    try:
        status = Path(path).stat()
    except OSError:
        return None
    return status.st_ino, status.st_mtime_ns
