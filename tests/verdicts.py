"""What verify and accept say, for the tests of both."""

import re
from contextlib import redirect_stdout
from io import StringIO

from pipeline.checks.verify import verify


def verdicts(text):
    """(figure -> verdict, the other lines) of what verify printed."""
    assert "Traceback" not in text
    figures = dict(re.findall(r"^(\w+\.(?:png|svg))  +(\S.*)$", text, re.MULTILINE))
    _, _, rest = text.partition("\n\n")
    return figures, rest.splitlines()


def say(word, tree, *arguments):
    """(exit status, what is printed) of verify or accept, run in this process to save its start."""
    with redirect_stdout(StringIO()) as text:
        status = word(tree.path, arguments)
    return status, text.getvalue()


def findings(tree, *arguments):
    """What verify finds wrong: figure -> verdict where not identical, and other lines; exit 1."""
    status, text = say(verify, tree, *arguments)
    figures, rest = verdicts(text)
    assert status == 1, text
    assert re.fullmatch(r"\d+ of 11 figures identical(; \d+ other findings?)?", rest[-1])
    return {name: v for name, v in figures.items() if v != "identical"}, rest[:-1]
