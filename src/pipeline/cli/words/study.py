"""./reproduce study: speed and accuracy against other methods."""

from ...checks.currency import Currency
from ...config import expected
from ...config.declared import study as parts
from ...records.sources import ROOT
from .. import figures, running
from ..folder import locked
from ..packages import add_packages


def run(given) -> int:
    """Make the study's data and charts, with the packages of its rivals; publish what is computed.

    Charts of what is measured stay in results until `accept`.
    """
    if not running.only_says(given.options) and (status := add_packages("study")):
        return status
    made = expected.of_study(given.checked["variants"])
    with locked():
        currency = Currency(ROOT, expected.of_all(given.checked))
        status = running.make(currency, made, given.options)
        if status == 0 and not running.only_says(given.options):
            charts = parts.CHARTS
            computed = [chart for chart in charts if charts[chart][0] in parts.FIXED]
            figures.publish({parts.published(c): parts.drawn(c) for c in computed})
            files = {c: parts.published(c) if c in computed else parts.drawn(c) for c in charts}
            figures.table(parts.FOLDER, {path: (c, "made") for c, path in files.items()})
    return status
