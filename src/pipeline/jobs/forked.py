"""Run snakemake, and start at once the process that forks its jobs: both load packages."""

import sys

from .forks import forking

if __name__ == "__main__":
    forking(any(argument.endswith(".nc") for argument in sys.argv))
    from snakemake.cli import main

    main()
