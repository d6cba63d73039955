"""./reproduce study: speed and accuracy against other methods."""

from ...checks.currency import Currency
from ...config import expected
from ...config.declared import study as parts
from ...records.files import identity
from ...records.sources import ROOT
from .. import figures, running
from ..folder import locked
from ..packages import add_packages


def run(given) -> int:
    """Make the study's data and charts, with the packages of its rivals; publish what is computed.

    Charts of what is measured stay in results until `accept`.
    """
    if not running.only_says(given.options):
        add_packages("study")
    made = expected.of_study(given.checked["variants"])
    with locked():
        before = {file: identity(file) for file in made}
        currency = Currency(ROOT, expected.of_all(given.checked))
        status = running.make(given.checked, currency, made, given.options)
        if status == 0 and not running.only_says(given.options):
            files = {}
            for chart, (data, *_) in parts.CHARTS.items():
                drawn = parts.drawn(chart)
                files[parts.published(chart) if data in parts.FIXED else drawn] = drawn
            status = figures.made(parts.FOLDER, files, before)
    return status
