"""The style of all pictures: matplotlib's defaults, its own fonts, and fixed colours.

Text is at least 6 points high where a picture is 89 mm wide, exponents and indices 4.9. Texts have
a contrast of 4.5 with their ground, lines and marks that carry data one of 3 with white.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import matplotlib
from matplotlib import font_manager

DPI = 300
COLUMN = 1050  # pixels: the width of a journal's column
PLAIN = 9.0  # points: text in a picture of that width

# Colours for meanings without an order. Readers with every kind of colour vision can tell apart
# those that one picture uses, also in grey (tests/helpers/colours.py).
BLUE, VERMILION, BLACK, GREEN = "#123fb0", "#d55e00", "#000000", "#00735a"
ORANGE, SKY = "#b87f00", "#3a92c8"  # as light as VERMILION: with marks or widths of their own
# The paper's green and blue for the two kinds of manifold.
STABLE, UNSTABLE = "#4fa82a", BLUE
MANIFOLDS = UNSTABLE, STABLE  # by the variable `stable`, 0 or 1
SEA, BACKDROP = "#909090", "#b4b4b4"
PALE_SEA = "#d8d8d8"  # behind regular orbits
_SCALE = "inferno", 36, 172  # matplotlib's table, and its darkest and lightest rows for lines
GRID, PANE, FRAME = "#e0e0e0", "#b0b0b0", "#404040"
RIM = BLACK
QUIET = GRID, PANE, BACKDROP, PALE_SEA  # need no contrast, since they are the ground of the data
_WEIGHTS = 2126, 7152, 722  # of red, green and blue
_INK, _PALE = 1833 * 255**2, 3000 * 255**2  # the most for a text, for a line

NAMES = {"x": "$x$", "xdot": r"$\dot{x}^{{-}}$", "udot": r"$\dot{u}^{{-}}$"}

_SETTINGS: Any = {
    # One family for words, numbers and formulas, which matplotlib ships.
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    # Matplotlib simplifies paths and rounds joins by comparisons and sines whose last bit may
    # differ between machines.
    "path.simplify": False,
    "lines.solid_joinstyle": "bevel",
    "lines.solid_capstyle": "butt",
    "lines.dash_joinstyle": "bevel",
    "svg.hashsalt": "pseudorigid",
    "svg.fonttype": "path",
    "pdf.compression": 0,
    "pdf.fonttype": 42,
}


@contextmanager
def pinned() -> Iterator[None]:
    """Set matplotlib's defaults and this style, without matplotlibrc and fonts of the system.

    Fonts of the system may be other versions of those that matplotlib ships with. There is no
    setting that leaves them out, so a private attribute is used; a test fails if it stops having an
    effect.
    """
    manager: Any = font_manager.fontManager
    folder = matplotlib.get_data_path()
    all_fonts = manager.ttflist
    with matplotlib.rc_context():
        try:
            manager.ttflist = [font for font in all_fonts if font.fname.startswith(folder)]
            manager._findfont_cached.cache_clear()
            matplotlib.rcdefaults()
            matplotlib.rcParams.update(_SETTINGS)
            yield
        finally:
            manager.ttflist = all_fonts
            manager._findfont_cached.cache_clear()


def ordered(count: int) -> list[str]:
    """Return `count` colours from dark to light, for values that have an order."""
    name, first, last = _SCALE
    table = matplotlib.colormaps[name]
    rows = table([first + (last - first) * i // max(count - 1, 1) for i in range(count)])
    return ["#" + bytes(row).hex() for row in (rows[:, :3] * 255 + 0.5).astype("uint8")]


def pale(color: str) -> str:
    """Return `color` (#rrggbb) mixed with white as far as a contrast of 3 with white allows."""
    parts = lighter = [*bytes.fromhex(color[1:])]
    while _light(lighter) <= _PALE:
        parts, lighter = lighter, [(part * 15 + 255) // 16 for part in lighter]
    return "#" + bytes(parts).hex()


def ink(color: str) -> str:
    """Return `color` (#rrggbb) for a text: darkened to a contrast of 4.5 with white."""
    parts = [*bytes.fromhex(color[1:])]
    while _light(parts) > _INK:
        parts = [part * 15 // 16 for part in parts]
    return "#" + bytes(parts).hex()


def _light(parts: Sequence[int]) -> int:
    """Return a little more than the luminance of sRGB, with the same bits everywhere."""
    return sum(weight * part * part for weight, part in zip(_WEIGHTS, parts, strict=True))


def setting(scene: dict[str, Any], energy: bool = True) -> str:
    """Return a line with the energy and the ball of a scene, without `energy` the ball alone."""
    values = {"E": scene["energy"]} if energy else {}
    values |= scene["ball"]
    return ", ".join(f"${name}$ = {number(value)}" for name, value in values.items())


def plural(noun: str, count: int) -> str:
    """Return a noun in the number that a count needs."""
    return noun if count == 1 else f"{noun}s"


def irregular(types: Sequence[str]) -> str:
    """Return the key's name of the orbits that are not regular; empty if all are."""
    kinds = [kind for kind in ("chaotic", "undecided", "undefined") if kind in types]
    rest = sum(kind in kinds for kind in types)
    return plural(f"{' and '.join(kinds)} orbit", rest) if rest else ""


def number(value: float, power: int = 0) -> str:
    """Return value / 10**power as a tick label: shortest decimal form, a proper minus sign."""
    return f"{value / 10**power:.10g}".replace("-", "\N{MINUS SIGN}")
