"""Entry point of `python -m pipeline`, which ./reproduce runs."""

import sys

if __name__ == "__main__":
    from .cli.main import main

    sys.exit(main(sys.argv[1:]))
