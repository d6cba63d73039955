"""./reproduce report: write one HTML page with the figures and their numbers."""

from pipeline.cli import figures, running
from pipeline.cli.arguments import Arguments
from pipeline.cli.session import interruptible, locked, one_line
from pipeline.config import MAIN
from pipeline.records.files import write_whole
from pipeline.records.sources import ROOT

PAGE = "results/report/report.html"


def run(args: Arguments) -> int:
    """Make missing results, then the page."""
    with locked():
        files = figures.drawings_of(args.config, MAIN)
        status = figures.make(args.config, MAIN, files, args)
        if args.makes_nothing or status == running.INTERRUPTED:
            return status
        from . import page

        with interruptible(), one_line():
            write_whole(ROOT / PAGE, page.render(ROOT, args.config))
    print(f"\n{PAGE}  {(ROOT / PAGE).stat().st_size / 1e6:.1f} MB: open it in a browser")
    return status
