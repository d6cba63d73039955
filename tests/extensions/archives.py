"""What verify --against finds."""

from contextlib import redirect_stdout
from io import StringIO

from extensions.publication import archive
from pipeline import config


def against(tree, place):
    """Return exit status, file -> state, and all lines of verify --against."""
    with redirect_stdout(StringIO()) as text:
        status = archive.compare(tree.path, config.load(tree.config), place)
    lines = text.getvalue().splitlines()
    rows = (line.split(maxsplit=1) for line in lines if "  " in line.strip() and line[0] != " ")
    return status, dict(rows), lines
