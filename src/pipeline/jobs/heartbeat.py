"""What a long computation shows of its progress: one line that changes, or lines in a file."""

import os
import sys
import threading
import time
from collections.abc import Callable
from shutil import get_terminal_size

CLEAR = "\r\033[K"  # clears the present line of a terminal


def on_terminal() -> bool:
    """Return whether stderr is a terminal on which a line can change."""
    return sys.stderr.isatty() and os.environ.get("TERM") != "dumb"


def clear_line() -> None:
    """Clear the line that changes, before others are printed."""
    if on_terminal():
        print(CLEAR, end="", file=sys.stderr, flush=True)


class Heartbeat(threading.Thread):
    """Show what `describe` returns until `close`: on a terminal in one line, which changes.

    Elsewhere a line is written after `gap` seconds without one.
    """

    def __init__(self, describe: Callable[[], str], gap: float = 30.0) -> None:
        super().__init__(daemon=True)
        self.describe, self.gap, self.closed = describe, gap, threading.Event()
        self.due = time.monotonic() + gap
        self.start()

    def run(self) -> None:
        """Look a few times a second what there is to show."""
        while not self.closed.wait(0.2):
            if on_terminal():
                line = self.describe()[: get_terminal_size().columns - 1]
                print(f"{CLEAR}{line}", end="", file=sys.stderr, flush=True)
            elif time.monotonic() >= self.due:
                self.print(self.describe())

    def print(self, line: str) -> None:
        """Print a line that stays."""
        clear_line()
        sys.stderr.write(f"{line}\n")  # at once: another thread may print a line
        self.due = time.monotonic() + self.gap

    def close(self) -> None:
        """Show nothing any more."""
        self.closed.set()
        self.join()
        clear_line()
