"""Lines that tell the user of a long computation what is being done."""

import sys
import threading
import time
from collections.abc import Callable

FIRST, GAP = 2.5, 4.5  # seconds to the first line, and without another one to the next


class Heartbeat(threading.Thread):
    """Print what `describe` returns, unless it is empty, when no line was printed for GAP seconds.

    It does so until the process ends, and adds the time since the user's command, which was given
    `waited` seconds ago.
    """

    def __init__(self, describe: Callable[[], str], waited: float = 0.0) -> None:
        super().__init__(daemon=True)
        self.describe, self.began = describe, time.monotonic() - waited
        self.due = self.began + FIRST
        self.start()

    def run(self) -> None:
        """Look a few times a second whether a line is due."""
        while True:
            now = time.monotonic()
            if now >= self.due and (words := self.describe()):
                self.print(f"{words}; {now - self.began:.0f} s so far")
            time.sleep(0.2)

    def print(self, line: str) -> None:
        """Print a line, after which the next one is due in GAP seconds."""
        sys.stderr.write(f"{line}\n")  # at once: another thread may print a line
        sys.stderr.flush()
        self.due = time.monotonic() + GAP
