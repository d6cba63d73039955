"""The plan of a run of snakemake: which results are outdated, told by files that are their inputs.

An outdated result gets a further input, results/<variant>/why/NAME.txt, with the reason. This file
is newer than the result and its content is unique, so that snakemake makes the result again,
whatever the times of other files and whatever it remembers. A job that finds its result current
leaves it as it is.
"""

import os
import time
from functools import cache, partial
from typing import NamedTuple

from ..checks.freshness import MISSING, Freshness
from ..config import Config, load
from ..records.files import write_whole
from ..records.record import beside, record_path
from ..records.sources import ROOT

why_path = partial(beside, "why", "txt")  # of the reason why a result is outdated


class Plan(NamedTuple):
    """The checked config, the freshness of all results, and the outdated results of this run."""

    config: Config
    freshness: Freshness
    outdated: set[str]  # grows while snakemake asks for inputs

    def why(self, path: str) -> list[str]:
        """Return the file that says why a result is outdated; a missing result needs none."""
        reason = self.freshness.reason(path)
        if reason is not None:
            self.outdated.add(path)
        return [] if reason in (None, MISSING) else [why_path(path)]

    def write_reasons(self) -> None:
        """Write the reasons, before snakemake looks for any of them: it remembers what is there.

        Results and records from the future become old: snakemake fails if an output is older than
        an input.
        """
        now = time.time()
        for path in self.freshness.build_specs:
            for file in (ROOT / path, ROOT / record_path(path)):
                if file.exists() and file.stat().st_mtime > now:
                    os.utime(file, (now - 1, now - 1))
        for path, reason in self.freshness.outdated().items():
            if reason != MISSING:  # its content is unique, and the file newer than the result
                write_whole(ROOT / why_path(path), f"{reason}\n{time.time_ns()}\n")


@cache
def plan() -> Plan:
    """Return the plan for config.yaml, the same during a process; raises ConfigError."""
    config = load(ROOT / "config.yaml")
    return Plan(config, Freshness(ROOT, config.build_specs()), set())
