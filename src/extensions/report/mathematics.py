"""Mathematics in the plain texts of the ledger and the captions, set as in the article."""

import re

from markupsafe import Markup, escape

_GREEK = {"omega": "ω", "lambda": "λ", "delta": "δ", "rho": "ρ", "phi": "φ", "pi": "π"}
_SIGNS = {"<=": "≤", ">=": "≥", "-": "−", "x": "×", "'": "’", "^": "∧"}
_FORMULA = re.compile(
    rf"""
    (?P<digits>\b\d+(?:\.\d+)?)e(?P<power>-?\d+)\b
    | (?P<dotted>[xu])dot\b
    | (?P<sign> <= | >= | ' | (?<=\d\ )x(?=\ \d) | (?<=\ )[\^-](?=\ )
        | (?<![\w-])-(?=\d | [gmpRx]\b) )
    | \^(?P<high>-?\w(?:[\d.]*\d)?)
    | \b(?P<greek>{"|".join(_GREEK)})(?:_(?P<mark>\w))?\b
    | \bl(?P<exponent>[1-3])\b
    | (?<!['’.\\])(?:\b|(?<=\bd))(?P<letter>[EFPRghjkmnprtuvxy])(?:_(?P<low>\w))?\b
    """,
    re.VERBOSE,
)


def typeset(text: str) -> Markup:
    """Return a text with symbols in italics, powers, indices and signs, as HTML."""
    parts, end = [], 0
    for found in _FORMULA.finditer(text):
        parts += [escape(text[end : found.start()]), _formula(found)]
        end = found.end()
    return Markup().join([*parts, escape(text[end:])])


def _formula(found: re.Match[str]) -> Markup:
    """Return one symbol, sign or power."""
    part = {name: value for name, value in found.groupdict().items() if value}
    if "power" in part:
        factor = "" if part["digits"] == "1" else f"{part['digits']} × "
        return Markup("{}10<sup>{}</sup>").format(factor, str(int(part["power"])).replace("-", "−"))
    if "dotted" in part:
        return Markup("<i>{}\u0307</i>").format(part["dotted"])
    if "sign" in part:
        return Markup("{}").format(_SIGNS[part["sign"]])
    if "high" in part:
        return Markup("<sup>{}</sup>").format(part["high"].replace("-", "−"))
    if "exponent" in part:
        return Markup("λ<sub>{}</sub>").format(part["exponent"])
    symbol = (
        Markup("<i>{}</i>").format(part["letter"]) if "letter" in part else _GREEK[part["greek"]]
    )
    low = part.get("low") or part.get("mark")
    return Markup("{}<sub>{}</sub>").format(symbol, low) if low else Markup("{}").format(symbol)
