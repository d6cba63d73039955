"""Run snakemake, and start at once the process that forks its jobs: both load packages."""

from .forks import forking

if __name__ == "__main__":
    forking()
    from snakemake.cli import main

    main()
