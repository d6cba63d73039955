"""Certificates as text."""

HEADER = """\
# Proposed by a search in floating point; every number is meant as the exact decimal that it is.
kind = "{kind}"
k = "{surface.k}"
g = "{surface.g}"
energy = "{surface.energy}"
"""


def header(kind, surface):
    """The first lines of a certificate."""
    return HEADER.format(kind=kind, surface=surface)


def decimal(value, digits):
    """The midpoint of a ball as a decimal of `digits` significant digits."""
    text = value.mid().str(digits, radius=False)
    return text if "." in text or "e" in text else text + ".0"


def decimals(values, digits):
    """Rows of balls as rows of decimals."""
    return [[decimal(value, digits) for value in row] for row in values]


def rows(name, values):
    """A list of rows of decimals, given as text."""
    lines = "".join(f"  [{', '.join(row)}],\n" for row in values)
    return f"{name} = [\n{lines}]\n"
