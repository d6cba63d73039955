"""The verdicts as a bar, for docs/findings.md."""

from collections.abc import Iterable

from pipeline.records.files import read_text
from pipeline.records.sources import ROOT

from . import DATA, by_verdict, checkable_count, read_json
from .outcomes import CORRECTED, FALSE, HOLDS, PROVED, UNDECIDED
from .schema import Verdict

FILE = "docs/verdicts.svg"
_COLOURS = {
    PROVED: "#0b6e4f",
    HOLDS: "#4fa3d1",
    CORRECTED: "#e1a100",
    FALSE: "#c0392b",
    UNDECIDED: "#8a8a8a",
}
_WORDS = {HOLDS: "hold", CORRECTED: "hold with a correction", FALSE: "do not hold"}
_WIDE, _CHARACTER = 420, 8.4  # pixels: width of the bar, and of a letter with room to spare
_LINE = 24  # pixels: from one line of names to the next


def committed() -> dict[str, str]:
    """Return the text of the bar by its file, if the statements have been judged."""
    if not (ROOT / DATA).exists():
        return {}
    return {FILE: bar(read_json(read_text(ROOT / DATA)))}


def sentence(verdicts: Iterable[Verdict]) -> str:
    """Return how many statements there are of each verdict, as words."""
    groups = by_verdict(verdicts)
    return ", ".join(f"{len(groups[word])} {_WORDS.get(word, word)}" for word in _COLOURS)


def bar(verdicts: list[Verdict]) -> str:
    """Return an SVG with a part of a bar, and its name, for each verdict."""
    groups, count = by_verdict(verdicts), checkable_count(verdicts)
    title = f"{count} statements: {sentence(verdicts)}"
    parts, at, under, y = [], 0.0, 0.0, 40
    for word, colour in _COLOURS.items():
        name = f"{len(groups[word])} {_WORDS.get(word, word)}"
        wide = _WIDE * len(groups[word]) / count
        room = 26 + _CHARACTER * len(name)
        under, y = (under, y) if under + room <= _WIDE else (0.0, y + _LINE)
        parts += [
            f'<rect x="{at:.1f}" width="{max(wide - 2, 0):.1f}" height="26" fill="{colour}"/>',
            f'<rect x="{under:.1f}" y="{y}" width="12" height="12" fill="{colour}"/>',
            f'<text x="{under + 18:.1f}" y="{y + 11}">{name}</text>',
        ]
        at, under = at + wide, under + room
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDE} {y + 20}" role="img">'
    style = "text { font: 16px sans-serif; fill: #24292f } @media (prefers-color-scheme: dark)"
    style += " { text { fill: #d0d7de } }"
    lines = [head, f"<title>{title}</title>", f"<style>{style}</style>", *parts, "</svg>"]
    return "\n".join([*lines, ""])
