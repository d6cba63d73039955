"""What Ctrl-C does to ./reproduce; imported before anything that takes time."""

import signal
from contextlib import contextmanager

# Ctrl-C ends the process at once, without a traceback, except where `tidying_up`.
CAREFUL = signal.getsignal(signal.SIGINT)
CARELESS = signal.SIG_DFL if CAREFUL is signal.default_int_handler else CAREFUL
signal.signal(signal.SIGINT, CARELESS)


@contextmanager
def tidying_up():
    """Ctrl-C raises KeyboardInterrupt in here, so that nothing unfinished stays behind."""
    signal.signal(signal.SIGINT, CAREFUL)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, CARELESS)
