"""./reproduce study: compare speed and accuracy with other methods."""

from ...checks.freshness import Freshness
from ...config import build_specs
from ...config.schema import study as parts
from ...records.files import identity
from ...records.sources import ROOT
from .. import figures, running
from ..arguments import Arguments
from ..packages import add_packages
from ..session import locked


def run(args: Arguments) -> int:
    """Make the study's data and charts, and publish the charts of computed data.

    Charts of measured times stay in results/ until `accept`.
    """
    if not running.is_dry_run(args.options):
        add_packages("study")
    results = build_specs.of_study(args.checked["variants"])
    with locked():
        before = {file: identity(file) for file in results}
        freshness = Freshness(ROOT, build_specs.of_all(args.checked))
        status = running.make(args.checked, freshness, results, args.options)
        if status == 0 and not running.is_dry_run(args.options):
            files = {}
            for chart, (data, *_) in parts.CHARTS.items():
                drawn = parts.drawn(chart)
                files[parts.published(chart) if data in parts.FIXED else drawn] = drawn
            status = figures.publish_and_report(parts.FOLDER, files, before)
    return status
