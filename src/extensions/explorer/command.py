"""./reproduce explore: write the explorer, one HTML page, and open it in a browser."""

import os
import webbrowser

from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import one_line
from pipeline.cli.lock import locked
from pipeline.records.files import write_whole
from pipeline.records.sources import ROOT

from . import page

EXPLORER = "results/explorer.html"


def run(args: Arguments) -> int:
    """Write the page; unless told otherwise, open it where there is a display."""
    with locked(), one_line():
        write_whole(ROOT / EXPLORER, page.render(args.config))
    # Without a display, Python would start a browser for terminals, which waits for keys.
    display = any(map(os.environ.get, ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER")))
    opened = display and not args.no_open and webbrowser.open((ROOT / EXPLORER).as_uri())
    size = (ROOT / EXPLORER).stat().st_size / 1e6
    print(f"{EXPLORER}  {size:.1f} MB: {'opened' if opened else 'open it'} in a browser")
    return 0
