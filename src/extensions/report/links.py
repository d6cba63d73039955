"""Links to the pictures and files that the texts of a report name."""

import re
from pathlib import Path

from markupsafe import Markup, escape

from pipeline.config import MAIN

from .mathematics import typeset

# A path has folders and a file with an extension: E/g is none.
_PATH = re.compile(r"(?<![\w./])\w[\w.-]*(?:/[\w.-]*\w)*/[\w.-]*\.[a-z]\w*")


class Links:
    """Links of a report in results/report/, or in another folder of results."""

    def __init__(self, root: Path, in_site: bool) -> None:
        self.root, self.in_site = root, in_site
        self.pictures: dict[str, str] = {}  # published file -> its place on the page

    def of(self, text: str) -> Markup:
        """Return a text with mathematics, in which paths are links.

        Lines may be broken after a slash or an underscore of a path.
        """
        parts, end = [], 0
        for found in _PATH.finditer(text):
            parts += [typeset(text[end : found.start()]), self._linked(found[0])]
            end = found.end()
        return Markup().join([*parts, typeset(text[end:])])

    def _linked(self, path: str) -> Markup:
        words = Markup(re.sub(r"([/_])", r"\1<wbr>", str(escape(path))))
        target = self._target(path)
        return Markup('<a href="{}">{}</a>').format(target, words) if target else words

    def _target(self, path: str) -> str | None:
        if path in self.pictures:
            return f"#{self.pictures[path]}"
        if not (self.root / path).is_file():
            return None
        if not self.in_site:
            return f"../../{path}"
        data = path.startswith(f"results/{MAIN}/") and path.endswith(".nc")
        return path.removeprefix("results/") if data else None
