"""./reproduce report: write one HTML page with the figures and their numbers."""

from ...config import PAPER
from ...records.files import write_whole
from ...records.sources import ROOT
from .. import figures, running
from ..arguments import Arguments
from ..session import interruptible, locked, one_line

PAGE = "results/report/report.html"


def run(args: Arguments) -> int:
    """Make missing results, then the page."""
    with locked():
        files = figures.drawings_of(args.config, PAPER)
        status = figures.make(args.config, PAPER, files, args)
        if args.makes_nothing or status == running.INTERRUPTED:
            return status
        from ...checks.report import page

        with interruptible(), one_line():
            write_whole(ROOT / PAGE, page.render(ROOT, args.config))
    print(f"\n{PAGE}  {(ROOT / PAGE).stat().st_size / 1e6:.1f} MB: open it in a browser")
    return status
