"""CLAIMS.json, the verdicts as data, and CLAIMS.md, which is rendered from it."""

import json
from collections.abc import Iterable
from dataclasses import asdict

from pydantic import TypeAdapter

from . import DOCUMENT, VERDICTS
from .schema import Verdict

_VERDICTS = TypeAdapter(list[Verdict])


def to_json(verdicts: Iterable[Verdict]) -> str:
    """Return the text of CLAIMS.json: a list of objects with the fields of Verdict."""
    return json.dumps([asdict(each) for each in verdicts], indent=1, ensure_ascii=False) + "\n"


def read_json(text: str) -> list[Verdict]:
    """Return the verdicts of a CLAIMS.json; raises ValueError if it is not one."""
    return _VERDICTS.validate_json(text, strict=True)


def by_verdict(verdicts: Iterable[Verdict]) -> dict[str, list[Verdict]]:
    """Return verdict word -> its rows by number, in the order of CLAIMS.md: corrections first."""
    rows = sorted(verdicts, key=lambda row: row.number)
    return {word: [row for row in rows if row.verdict == word] for word in VERDICTS}


def render(verdicts: list[Verdict]) -> str:
    """Return the text of CLAIMS.md."""
    tables = by_verdict(verdicts)
    lines = [DOCUMENT.head, f"The verdicts on {len(verdicts)} statements, and what each needs:", ""]
    lines += ["| verdict | rows | what it needs |", 3 * "|---" + "|"]
    lines += [f"| {word} | {len(tables[word])} | {needs} |" for word, needs in VERDICTS.items()]
    lines.append("")
    for word, rows in tables.items():
        if rows:
            lines += [f"## {word.capitalize()}", ""]
            lines += ["| | where | statement | our value | error | look at |", 6 * "|---" + "|"]
            lines += [*map(_row, rows), ""]
    return "\n".join(lines)


def _row(row: Verdict) -> str:
    cells = (str(row.number), row.place, row.statement, row.value, row.error, row.evidence)
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"
