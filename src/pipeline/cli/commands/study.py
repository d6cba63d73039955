"""./reproduce study: compare speed and accuracy with other methods."""

from ...config.schema import study as parts
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
    files = {}
    for chart, (part, *_) in parts.CHARTS.items():
        path = parts.published(chart) if part in parts.FIXED else parts.drawn(chart)
        files[path] = chart, [parts.drawn(chart)]
    data = map(parts.data, (*parts.FIXED, *parts.MEASURED))
    with locked():
        return figures.make(args.checked, "study", files, args.options, [*data])
