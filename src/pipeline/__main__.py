"""`python -m pipeline`, which ./reproduce hands over to."""

import signal
import sys

if __name__ == "__main__":
    # Until something is there to tidy up, Ctrl-C ends the process without a traceback.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)

    from .cli.packages import told_damage

    try:
        from .cli.main import main

        status = main(sys.argv[1:])
    except Exception:
        if not told_damage():
            raise
        status = 1
    else:
        if status not in (0, 130):
            told_damage()
    sys.exit(status)
