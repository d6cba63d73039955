"""The documents, with their commands and programs."""

import re

from helpers.project import ROOT


def text_of(document):
    return (ROOT / document).read_text(encoding="utf-8")


def blocks(document):
    """The indented blocks of a document, without the indent."""
    found = re.findall(r"(?:^|\n)\n((?:    .*\n|\n(?=    ))+)", text_of(document))
    return [re.sub(r"^    ", "", block, flags=re.MULTILINE).strip("\n") for block in found]
