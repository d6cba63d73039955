"""What the verdicts add to the report: a bar, the corrections, and a table with a filter."""

import re
from collections import Counter
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup

from pipeline.checks.section import Links, Section
from pipeline.config import MAIN, Config
from pipeline.records.files import read_text

from .. import ledger
from ..ledger.outcomes import CORRECTED, FALSE
from ..ledger.schema import Verdict

_TEMPLATES = jinja2.Environment(
    loader=jinja2.FileSystemLoader(Path(__file__).parent),
    autoescape=True,
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)
# What filters the table of statements; without it, the whole table is shown.
_SCRIPT = Path(__file__).with_name("filter.js").read_text(encoding="utf-8")


def section(config: Config, root: Path, links: Links) -> Section:
    """Return the part that CLAIMS.json of the tree fills; without it, a sentence."""
    verdicts = _verdicts(root)
    values = {
        "linked": links.of,
        "sentences": _sentences,
        "claims": verdicts,
        "checkable": ledger.checkable_count(verdicts),
        "counts": list(Counter(verdict.verdict for verdict in verdicts).items()),
        "corrected": (FALSE, CORRECTED),
    }
    html: Any = _TEMPLATES.get_template("parts.html").make_module(values)

    def note(variant: str, scene: str, block: dict[str, Any], published: str) -> Markup:
        shown = published and variant != MAIN  # all statements concern the paper's figures
        return Markup(html.statements(published).strip()) if shown else Markup()

    menu = {"Corrections": "#corrections", "All statements": "#claims"}
    script = _SCRIPT if verdicts else ""
    return Section(menu, html.summary, html.findings, html.tables, script, note)


def _sentences(row: Verdict) -> list[list[str]]:
    """Return the sentences of a value; one with a series is its beginning and the items."""
    sentences = []
    for sentence in re.split(r"(?<=[^.]\.) (?=[A-Z])", row.value):
        first, *others = sentence.split("; ")
        announced = re.fullmatch(r"(.*(?:: | are ))(.*)", first)
        series = [*announced.groups(), *others] if announced else [first, *others]
        sentences.append(series if len(others) > 1 else [sentence])
    return sentences


def _verdicts(root: Path) -> list[Verdict]:
    """Return the rows of CLAIMS.json in the order of CLAIMS.md, or none."""
    try:
        verdicts = ledger.read_json(read_text(root / ledger.DATA))
    except (OSError, ValueError):
        return []
    return [verdict for group in ledger.by_verdict(verdicts).values() for verdict in group]
