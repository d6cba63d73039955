"""What verify and accept say, for the tests of both; run in this process to save their start."""

import re
from contextlib import redirect_stdout
from io import StringIO
from typing import NamedTuple

from pipeline import config
from pipeline.checks.accept import accept
from pipeline.checks.verify import verify


class Said(NamedTuple):
    """What verify said of the paper's figures."""

    status: int
    wrong: dict  # figure -> its lines, where it is not identical
    findings: list
    notes: list
    last: str
    rest: list  # of the study's charts


def said(text, status):
    """The parts of what verify printed."""
    assert "Traceback" not in text
    lines = text.splitlines()
    end = next(i for i, line in enumerate(lines) if re.match(r"\d+ of \d+ figures", line))
    blank = lines.index("")
    figures = {}
    for line in lines[:blank]:
        name, words = re.match(r"(\S*) +(\S.*)", line).groups()
        if name:
            figures[name] = []
        figures[next(reversed(figures))].append(words)
    other = lines[blank + 1 : end]
    notes = [line.removeprefix("note: ") for line in other if line.startswith("note: ")]
    findings = [line for line in other if not line.startswith("note: ")]
    wrong = {name: words for name, words in figures.items() if words != ["identical"]}
    assert lines[end].startswith(f"{len(figures) - len(wrong)} of {len(figures)} figures identical")
    return Said(status, wrong, findings, notes, lines[end], lines[end + 1 :])


def verified(tree, strict=False):
    """What verify says of a tree."""
    with redirect_stdout(StringIO()) as text:
        status = verify(tree.path, config.load(tree.config), strict)
    return said(text.getvalue(), int(status))


def accepting(tree):
    """(exit status, the lines) of accept."""
    with redirect_stdout(StringIO()) as text:
        status = accept(tree.path, config.load(tree.config))
    return status, text.getvalue().splitlines()
