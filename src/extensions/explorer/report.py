"""What the explorer adds to the report: links that open a figure's scene in it."""

from pathlib import Path
from typing import Any

from markupsafe import Markup

from pipeline.checks.section import Links, Section
from pipeline.config import Config
from pipeline.records.files import write_whole

from .data import address
from .page import render

_NOTE = Markup(
    '<p class="small"><a href="{}#{}">Open this figure in the explorer</a> to start orbits on '
    "it.</p>"
)


def section(config: Config, root: Path, links: Links) -> Section:
    """Return a link in the menu, and one below each picture of a section.

    The page that they lead to is written, unless the report is part of a site, which has its own.
    """
    page = "explorer.html" if links.in_site else "../explorer.html"
    if not links.in_site:
        write_whole(root / "results/explorer.html", render(config, root))

    def note(variant: str, scene: str, block: dict[str, Any], published: str) -> Markup:
        place = address(config, variant, scene, block)
        return _NOTE.format(page, place) if place else Markup()

    return Section({"Explore orbits": page}, note=note)
