"""`python -m pipeline`, which ./reproduce hands over to."""

import sys

from .cli.launch import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
