"""Formulas in the plain texts of the ledger, for Markdown: `E/g^2` becomes `$E/g^{2}$`."""

import re

_GREEK = r"omega|lambda|delta|rho|phi|pi"
_SYMBOL = rf"""
    \d+(?:\.\d+)?e-?\d+\b                    # 4e-07
  | \d+(?:\.\d+)?\^-?\w+                     # 10^-6
  | \b[xu]dot\b(?:\^2)?
  | \b(?:{_GREEK})(?:_\w)?\b
  | \bl[1-3]\b                               # the exponents
  | (?<!['’.])\bd(?=\ (?:phi|[xy]\b))         # d x, of an area or a derivative
  | (?<!['’.\\-])\b[EFPRghjkmnprtuvxy](?:_\w)?(?:\^-?\w[\d.]*)?(?![\w'’])
"""
_JOIN = r"\ ?(?:/\d+)?\ (?:[-+=<>]|<=|>=)\ |/|\ "
_NUMBER = r"-?\d+(?:\.\d+)?(?:/\d+)?\b"
# Symbols, joined by signs, and the number at the end of an equation.
_FORMULA = re.compile(
    rf"(?P<as_is>`[^`]*`|\S*\w/\S*\.\w+)"
    rf"|(?P<formula>(?:(?<![\w.])-?\d+(?:\.\d+)?\ <=?\ )?"
    rf"(?:{_SYMBOL})(?:(?:{_JOIN})(?:{_SYMBOL}))*(?:/\d+)?"
    rf"(?:\ (?:<=|>=|<|>|=)\ {_NUMBER})?)",
    re.VERBOSE,
)
_TEX = (
    (r"(\d+(?:\.\d+)?)e(-?)0*(\d+)", r"\1\\times10^{\2\3}"),
    (r"\^(-?\w[\d.]*)", r"^{\1}"),
    (r"\b([xu])dot\b", r"\\dot{\1}"),
    (rf"\b({_GREEK})", r"\\\1"),
    (r"\bl([1-3])\b", r"\\lambda_\1"),
    ("<=", r"\\le"),
    (">=", r"\\ge"),
    (r"^1\\times", ""),
)


def typeset(text: str) -> str:
    """Return a text whose formulas stand between dollar signs; code and paths stay as they are."""
    return _FORMULA.sub(lambda found: found["as_is"] or f"${_tex(found['formula'])}$", text)


def _tex(formula: str) -> str:
    """Return a plain formula as LaTeX."""
    for plain, tex in _TEX:
        formula = re.sub(plain, tex, formula)
    return formula
