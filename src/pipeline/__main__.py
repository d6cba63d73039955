"""`python -m pipeline`, which ./reproduce hands over to."""

import signal
import sys

if __name__ == "__main__":
    # Until something is there to tidy up, Ctrl-C ends the process without a traceback.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)

    try:
        from .cli.main import main
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] in ("pipeline", "pseudorigid"):
            raise
        print(f"reproduce: .venv is damaged ({error}): remove it and run again", file=sys.stderr)
        sys.exit(1)
    sys.exit(main(sys.argv[1:]))
