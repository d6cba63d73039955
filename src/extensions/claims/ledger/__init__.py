"""Statements of the paper (claims.toml), and the checks that give a verdict on each.

CLAIMS.json has the verdicts as data, and CLAIMS.md is rendered from it.
"""

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict
from inspect import getmembers, isfunction
from pathlib import Path

import xarray as xr
from pydantic import TypeAdapter

from pipeline.records.sources import ROOT

from ..mathematics import typeset
from . import chaos, model, periodic, schema
from .outcomes import UNCHECKED
from .schema import Verdict

FILE, DATA = "CLAIMS.md", "CLAIMS.json"  # the page is rendered from the data
# MODULE.FUNCTION, as claims.toml names a check, -> the function.
CHECKS = {
    f"{module.__name__.rpartition('.')[2]}.{name}": function
    for module in (model, periodic, chaos)
    for name, function in getmembers(module, isfunction)
    if function.__module__ == module.__name__ and not name.startswith("_")
}
TEXT = Path(__file__).with_name("claims.toml").read_text(encoding="utf-8")
DOCUMENT = schema.load(TEXT, CHECKS)
# number -> claim, and verdict word -> what the verdict needs, in the order of CLAIMS.md
CLAIMS, VERDICTS = DOCUMENT.claims, DOCUMENT.verdicts
_ROWS = TypeAdapter(list[Verdict])
_ROW = re.compile(r"\b(?:row|statement) (\d+)\b")


def required_datasets() -> list[str]:
    """Return the names of all datasets that the checks need, sorted."""
    return sorted({name for claim in CLAIMS.values() for name in claim.data})


def required_theorems() -> list[str]:
    """Return the names of all theorems that the checks need, sorted."""
    return sorted({name for claim in CLAIMS.values() for name in claim.theorems})


def judge_claims(datasets: Mapping[str, xr.Dataset], proofs: Mapping[str, str]) -> list[Verdict]:
    """Return the verdicts on all claims, in the order of claims.toml.

    `datasets` maps each of `required_datasets()` to the dataset. `proofs` maps theorems to "proved"
    or another word; a theorem that it lacks counts as not proved.
    """
    return [claim.judge(datasets, proofs) for claim in CLAIMS.values()]


def to_json(verdicts: Iterable[Verdict]) -> str:
    """Return the text of CLAIMS.json: a list of objects with the fields of Verdict."""
    return json.dumps([asdict(each) for each in verdicts], indent=1, ensure_ascii=False) + "\n"


def read_json(text: str) -> list[Verdict]:
    """Return the verdicts of a CLAIMS.json; raises ValueError if it is not one."""
    return _ROWS.validate_json(text, strict=True)


def checkable_count(verdicts: Iterable[Verdict]) -> int:
    """Return the number of statements that can be checked: all but the "not checkable" ones."""
    return sum(verdict.verdict != UNCHECKED for verdict in verdicts)


def by_verdict(verdicts: Iterable[Verdict]) -> dict[str, list[Verdict]]:
    """Map each verdict word, in the order of CLAIMS.md, to its verdicts, sorted by number."""
    by_number = sorted(verdicts, key=lambda verdict: verdict.number)
    return {word: [v for v in by_number if v.verdict == word] for word in VERDICTS}


def render(verdicts: list[Verdict]) -> str:
    """Return the text of CLAIMS.md: a table of the verdict words, and a heading for each claim."""
    groups, count = by_verdict(verdicts), checkable_count(verdicts)
    rest = f"{count} checkable statements, and on {len(verdicts) - count} more"
    lines = [DOCUMENT.head, f"The verdicts on {rest}, and what each needs:", ""]
    lines += ["| verdict | statements | what it needs |", 3 * "|---" + "|"]
    lines += [
        f"| [{word}](#{word.replace(' ', '-')}) | {len(groups[word])} | {needs} |"
        for word, needs in VERDICTS.items()
    ]
    for word in filter(groups.get, groups):
        lines += ["", f"## {word.capitalize()}"]
        for verdict in groups[word]:
            lines += ["", f"### Statement {verdict.number}", "", *_described(verdict)]
    return "\n".join([*lines, ""])


def _described(verdict: Verdict) -> Iterator[str]:
    """Yield the lines below the heading of a verdict."""
    texts = {"Our value": verdict.value, "Error": verdict.error}
    yield f"**The paper, {verdict.place}:** {typeset(verdict.statement)}"
    for name, text in texts.items():
        if text:
            words = _ROW.sub(r"[\g<0>](#statement-\1)", typeset(text))
            yield f"\n**{name}:** {words}"
    if verdict.evidence:
        yield f"\n**Look at:** {', '.join(_linked(verdict.evidence))}"


def _linked(evidence: str) -> Iterator[str]:
    """Yield each thing to look at: a link to a file of the tree, or code."""
    folder = ""
    for name in evidence.split(", "):
        path = name if "/" in name else f"{folder}/{name}"
        folder = path.rpartition("/")[0]
        is_file = (ROOT / path).is_file() and not path.startswith("results/")
        code = f"`{name}`" if "/" in name else name
        yield f"[{path}]({path})" if is_file else code
