"""Committed files that are written from the declarations of the core and of extensions."""

import re
from collections import Counter

from project import ROOT

from pipeline.checks import figures_page
from pipeline.config import json_schema


def test_the_committed_schema_is_up_to_date():
    assert (ROOT / json_schema.FILE).read_text() == json_schema.text()


def test_the_page_of_figures_is_current_and_complete():
    text = (ROOT / "docs" / "figures.md").read_text(encoding="utf-8")
    assert text == figures_page.page(), "renew it: python -m pipeline.checks.figures_page"
    pictures = [*ROOT.glob("paper_figures/*.png"), *ROOT.glob("more_figures/*/*.png")]
    links = Counter(re.findall(r"\]\(\.\./(\S+)\)", text))
    assert links == Counter(str(path.relative_to(ROOT)) for path in pictures)
    assert max(map(len, text.splitlines())) <= 100
    assert not re.findall(r"^[-+*>=] ", text, re.MULTILINE)  # no line of a caption is a list
