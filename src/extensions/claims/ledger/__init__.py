"""Statements of the paper (claims.toml), and the checks that give a verdict on each.

CLAIMS.json has the verdicts as data, and CLAIMS.md is rendered from it.
"""

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from inspect import getmembers, isfunction
from pathlib import Path

import xarray as xr
from pydantic import TypeAdapter

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
    """Return the text of CLAIMS.md: a table of the verdict words, and one of each word's rows."""
    tables, count = by_verdict(verdicts), checkable_count(verdicts)
    rest = f"{count} checkable statements, and on {len(verdicts) - count} more"
    lines = [DOCUMENT.head, f"The verdicts on {rest}, and what each needs:", ""]
    lines += ["| verdict | rows | what it needs |", 3 * "|---" + "|"]
    lines += [f"| {word} | {len(tables[word])} | {needs} |" for word, needs in VERDICTS.items()]
    lines.append("")
    for word in filter(tables.get, tables):
        lines += [f"## {word.capitalize()}", ""]
        lines += ["| | where | statement | our value | error | look at |", 6 * "|---" + "|"]
        for v in tables[word]:
            cells = str(v.number), v.place, v.statement, v.value, v.error, v.evidence
            lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
        lines.append("")
    return "\n".join(lines)
