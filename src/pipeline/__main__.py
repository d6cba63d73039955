"""Entry point of `python -m pipeline`, which ./reproduce runs."""

import signal
import sys

if __name__ == "__main__":
    # As long as there is nothing to clean up, Ctrl-C ends the process without a traceback.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)

    from .cli.main import main

    sys.exit(main(sys.argv[1:]))
