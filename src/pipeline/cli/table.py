"""What commands print about files: tables with one row for each figure, and verdicts in colour."""

import os
import re
import shutil
import sys
import textwrap
from collections.abc import Iterable
from pathlib import PurePath

from ..records.differences import columns

FileRow = tuple[str, str, tuple[str, ...]]  # path, size or nothing, what is said about the file
WHAT_TO_DO = (
    "What differs: to keep it, run ./reproduce accept; to undo it, git checkout what you edited, "
    "and run again; to have both, make it a variant in config.yaml (docs/commands.md)."
)
_VERDICTS = {32: r"\b(identical|proved)\b", 31: r"\b(differs|missing|stale|refused|not \w+)\b"}


def print_files(
    title: str, rows: Iterable[FileRow], header: tuple[str, ...] = (), notes: Iterable[str] = ()
) -> None:
    """Print tables of figures, one for each folder, and notes.

    Formats of a figure that have the same state share a row. Reasons, the words that follow ": " in
    a cell, are printed below the table, once for all their files. If a cell says "differs", the
    last line says what to do.
    """
    folders, reasons = dict[str, dict[tuple[str, ...], list[str]]](), dict[str, list[str]]()
    differs = False
    for path, size, cells in rows:
        folder, name = os.path.split(path)
        row = [PurePath(name).stem]
        for cell in cells:
            state, _, reason = cell.partition(": ")
            row.append(state)
            if reason:
                reasons.setdefault(cell, []).append(path)
        differs |= "differs" in row
        file = f"{PurePath(name).suffix[1:]} {size}".rstrip()
        folders.setdefault(folder, {}).setdefault(tuple(row), []).append(file)
    for folder, figures in folders.items():
        between = "  " if header else " "
        table = [(row[0], between.join(files), *row[1:]) for row, files in figures.items()]
        print(f"\n{title}{folder}/")
        print_lines(columns([header, *table] if header else table))
    for reason, files in reasons.items():
        print_lines(wrapped(f"{', '.join(files)}: {reason}"))
    for line in (*notes, *[WHAT_TO_DO] * differs):
        print_lines(wrapped(line))


def wrapped(text: str, width: int = 10**6) -> list[str]:
    """Return lines of the terminal's width, or of `width`; they break at spaces alone.

    By default, the text stays one line without a terminal.
    """
    width = min(width, shutil.get_terminal_size((width, 24)).columns)
    return textwrap.wrap(
        text, width, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
    )


def print_lines(lines: Iterable[str]) -> None:
    """Print lines, with verdicts in green and red for a person at a terminal."""
    text = "\n".join([*lines, ""])
    plain = os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb"
    if sys.stdout.isatty() and not plain:
        for colour, words in _VERDICTS.items():
            text = re.sub(words, rf"\033[{colour}m\1\033[m", text)
    print(text, end="", flush=True)
