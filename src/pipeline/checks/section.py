"""What a part adds to the report."""

from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

from markupsafe import Markup


class Links(Protocol):
    """The links of a report."""

    in_site: bool  # in the folder of a site, or else in results/report/

    def of(self, text: str) -> Markup:
        """Return a text with mathematics, in which paths are links."""


class Section(NamedTuple):
    """HTML that a part adds; its report module has a function `section(config, root, links)`.

    `summary`, `findings` and `tables` are called once `links` knows all pictures of the page.
    """

    menu: dict[str, str]  # name in the menu -> where it leads
    summary: Callable[[], Markup] = Markup  # below the title
    findings: Callable[[], Markup] = Markup  # after the paper's figures
    tables: Callable[[], Markup] = Markup  # before the provenance
    script: str = ""
    # (variant, scene, block, published file) -> a note below a picture, or nothing
    note: Callable[[str, str, dict[str, Any], str], Markup] = lambda *_: Markup()
