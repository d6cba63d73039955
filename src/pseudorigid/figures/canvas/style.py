"""The style of all pictures: matplotlib's defaults, its own fonts, and fixed colours."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib
from matplotlib import font_manager

DPI = 300
COLUMN = 1050  # pixels: the width of a journal's column
PLAIN = 9.0  # points: text in a picture of that width

# The hues of Okabe and Ito, which can be told apart with every kind of colour blindness.
BLUE, VERMILION, GREEN, ORANGE = "#0072b2", "#d55e00", "#009e73", "#e69f00"
PURPLE, SKY, BLACK = "#cc79a7", "#56b4e9", "#000000"
HUES = (BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY, BLACK)
# The paper's green and blue for the two kinds of manifold. One is light and yellowish and the other
# dark, so that they can be told apart too.
STABLE, UNSTABLE = "#4fa82a", "#123fb0"
MANIFOLDS = UNSTABLE, STABLE  # by the variable `stable`, 0 or 1
SEA, BACKDROP = "#909090", "#b4b4b4"
MANY_HUES = (*HUES, SEA)
GRID, PANE, FRAME = "#e0e0e0", "#b0b0b0", "#404040"
RIM = BLACK

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


def pale(color: str) -> str:
    """Return `color` (#rrggbb) mixed with twice as much white."""
    return "#" + bytes((part + 2 * 255) // 3 for part in bytes.fromhex(color[1:])).hex()


def setting(scene: dict[str, Any], energy: bool = True) -> str:
    """Return a line with the energy and the ball of a scene, without `energy` the ball alone."""
    values = {"E": scene["energy"]} if energy else {}
    values |= scene["ball"]
    return ", ".join(f"${name}$ = {number(value)}" for name, value in values.items())


def plural(noun: str, count: int) -> str:
    """Return a noun in the number that a count needs."""
    return noun if count == 1 else f"{noun}s"


def number(value: float, power: int = 0) -> str:
    """Return value / 10**power as a tick label: shortest decimal form, a proper minus sign."""
    return f"{value / 10**power:.10g}".replace("-", "\N{MINUS SIGN}")
