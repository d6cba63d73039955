"""./reproduce report: write one HTML page with the figures and their numbers."""

from ... import config
from ...checks.freshness import Freshness
from ...config import build_specs
from ...records.files import write_whole
from ...records.sources import ROOT
from .. import figures, running
from ..arguments import Arguments
from ..session import interruptible, locked, one_line

PAGE = "results/report/report.html"


def run(args: Arguments) -> int:
    """Make missing results, then the page."""
    checked, variants = args.checked, args.checked["variants"]
    with locked():
        status = figures.make(checked, config.PAPER, args.options)
        freshness = Freshness(ROOT, build_specs.of_variants(variants))
        absent = {name: figures.known_absent(freshness, variants, name) for name in variants}
        if running.is_dry_run(args.options) or (status and not absent[config.PAPER]):
            return status
        from ...checks.report import page

        with interruptible(), one_line():
            write_whole(ROOT / PAGE, page.render(ROOT, checked, absent))
    print(f"\n{PAGE}  {(ROOT / PAGE).stat().st_size / 1e6:.1f} MB: open it in a browser")
    return status
