"""What an extension adds to the report."""

from collections.abc import Callable
from typing import Any, NamedTuple

from markupsafe import Markup


def _nothing(variant: str, scene: str, block: dict[str, Any], published: str) -> Markup:
    return Markup()


class Part(NamedTuple):
    """HTML that an extension adds; its report module has a function `part(config, root, links)`.

    `summary`, `findings` and `tables` are called once `links` knows all pictures of the page.
    """

    menu: dict[str, str]  # name in the menu -> where it leads
    summary: Callable[[], Markup] = Markup  # below the title
    findings: Callable[[], Markup] = Markup  # after the paper's figures
    tables: Callable[[], Markup] = Markup  # before the provenance
    script: str = ""
    # (variant, scene, block, published file) -> a note below a picture, or nothing
    note: Callable[[str, str, dict[str, Any], str], Markup] = _nothing
