"""What verify finds and accept prints."""

import subprocess
from contextlib import redirect_stdout
from io import StringIO
from typing import NamedTuple

from pipeline import config
from pipeline.checks.verify import summary, verify
from pipeline.cli.commands.accept import accept


class Found(NamedTuple):
    """What verify found about the paper's figures."""

    status: int
    wrong: dict  # figure -> its lines, if it is not identical
    findings: list
    notes: list
    lines: list  # the whole report


def verified(tree, strict=False):
    """Verify a tree."""
    findings, *others = verify(tree.path, config.load(tree.config))
    wrong = {
        name: [f"{layer}: {words}" for layer, words in layers.items()]
        for name, layers in findings.differences.items()
    }
    status = any([*each.why(strict)] for each in (findings, *others))
    lines = [*findings.report(), summary([findings])]
    return Found(int(status), wrong, findings.failures, findings.notes, lines)


def commit(folder, *files):
    """Commit files of a folder to a new repository there."""
    git = ["git", "-C", folder, "-c", "user.name=x", "-c", "user.email=x@example.org"]
    for words in (["init", "-q"], ["add", "-f", *files], ["commit", "-q", "-m", "x"]):
        subprocess.run([*git, *words], check=True)


def accepting(tree):
    """Return the exit status and the lines of accept."""
    with redirect_stdout(StringIO()) as text:
        status = accept(tree.path, config.load(tree.config))
    return status, text.getvalue().splitlines()
