"""./reproduce study: speed and accuracy against other methods."""

import argparse

from ...config import expected
from ...config.checking.reading import load
from ...config.declared import study as parts
from ...records.sources import ROOT
from .. import figures, running
from ..folder import locked, say
from ..packages import add_packages


def run(word, arguments, start) -> int:
    """Make the study's data and charts, with the packages of its rivals; publish what is computed.

    Charts of what is measured stay in results until `accept`.
    """
    if {"-h", "--help"} & set(arguments):
        argparse.ArgumentParser(
            prog="reproduce study",
            description="Make the study's data and charts; options go to snakemake. Installs the "
            "packages of its rivals first (once).",
        ).print_help()
        return 0
    checked = load(ROOT / "config.yaml")
    if status := add_packages("study"):
        return status
    made = expected.of_study(checked["variants"])
    with locked():
        since = running.now()
        results = expected.of_variants(checked["variants"]) | made
        status = running.make(results, made, arguments)
        for line in running.last_words(since) if status else ():
            say(line.removeprefix("pseudorigid: "))
        if status == 0 and not running.only_says(arguments):
            charts = {parts.published(c): parts.drawn(c) for c in parts.CHARTS}
            computed = {c for c in parts.CHARTS if parts.CHARTS[c][0] in parts.FIXED}
            figures.publish({p: d for p, d in charts.items() if d in map(parts.drawn, computed)})
            for chart in parts.CHARTS:
                print(parts.published(chart) if chart in computed else parts.drawn(chart))
    return status
