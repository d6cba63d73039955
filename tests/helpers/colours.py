"""Colours of a picture: apart for each kind of colour vision, and in grey."""

from itertools import combinations

import numpy as np
from matplotlib.colors import to_hex

from pseudorigid.figures.canvas import style

# Machado, Oliveira and Fernandes (2009), severity 1, for linear sRGB.
VISIONS = {
    "normal": np.eye(3),
    "deuteranopia": [
        [0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ],
    "protanopia": [
        [0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ],
}  # fmt: skip
_TO_XYZ = np.array([
    [0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750],
    [0.0193339, 0.1191920, 0.9503041],
])  # fmt: skip


def lab(color, vision="normal"):
    """Return CIELAB coordinates (D65) of a colour #rrggbb as seen with a colour vision."""
    part = np.array([*bytes.fromhex(color[1:])]) / 255
    linear = np.where(part <= 0.04045, part / 12.92, ((part + 0.055) / 1.055) ** 2.4)
    linear = np.clip(np.array(VISIONS[vision]) @ linear, 0.0, 1.0)
    xyz = (_TO_XYZ @ linear) / _TO_XYZ.sum(axis=1)
    x, y, z = np.where(xyz > 216 / 24389, np.cbrt(xyz), (24389 / 27 * xyz + 16) / 116)
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


def distance(one, other, vision="normal"):
    """Return the CIE 1976 difference of two colours."""
    return float(np.linalg.norm(lab(one, vision) - lab(other, vision)))


def lightness(color):
    """Return the lightness of a colour in grey, 0 to 100."""
    return float(lab(color)[0])


def contrast(one, other):
    """Return the contrast of two colours #rrggbb by WCAG 2.2, 1 to 21."""
    lights = []
    for color in (one, other):
        part = np.array([*bytes.fromhex(color[1:])]) / 255
        linear = np.where(part <= 0.04045, part / 12.92, ((part + 0.055) / 1.055) ** 2.4)
        lights.append(float(linear @ [0.2126, 0.7152, 0.0722]) + 0.05)
    return max(lights) / min(lights)


APART = 12.0  # least difference of two colours that mean different things, in each vision
SHADES = 10.0  # least difference in lightness of two that look alike but for their colours
WIDER = 1.5  # ratio of two widths, or sizes, that tell lines or marks apart
_FRAMES = {style.FRAME, style.GRID, style.PANE, "#ffffff"}


def looks(figure):
    """Return what lines and marks look like: (colour, mark, hollow or dashes, size)."""
    found = set()
    for artist in figure.artists:
        if (marker := artist.get_marker()) not in ("None", None, ""):
            hollow = to_hex(artist.get_markerfacecolor()) != to_hex(artist.get_color())
            edge = artist.get_markeredgecolor() if hollow else artist.get_color()
            found.add((to_hex(edge), marker, hollow, artist.get_markersize()))
        else:
            dashes = str(artist._unscaled_dash_pattern[1])
            found.add((to_hex(artist.get_color()), "", dashes, artist.get_linewidth()))
    return {look for look in found if look[0] not in _FRAMES}


def apart(one, other, marks=None):
    """Return why two looks may be confused, or nothing: (colour, mark, hollow or dashes, size).

    Marks of different shapes or fillings need no colours, nor do lines through such marks: `marks`
    has the marks of a colour's lines. In grey, they may also differ in dashes or size.
    """
    shapes = [{look[1:3]} if look[1] else (marks or {}).get(look[0]) for look in (one, other)]
    by_shape = all(shapes) and not shapes[0] & shapes[1]
    seen = {vision: distance(one[0], other[0], vision) for vision in VISIONS}
    if not by_shape and min(seen.values()) < APART:
        return f"{one[0]} and {other[0]} differ by {min(seen.values()):.1f}"
    sizes = sorted((one[3], other[3]))
    told_apart = by_shape or one[1:3] != other[1:3] or sizes[1] >= WIDER * sizes[0]
    shades = abs(lightness(one[0]) - lightness(other[0]))
    if not told_apart and shades < SHADES:
        return f"{one[0]} and {other[0]} differ by {shades:.1f} in grey"
    return ""


def assert_colours_apart(figure):
    """Fail if colours of a picture are too near each other in a vision, or in grey.

    Colours of the scale for ordered values are compared with the others alone.
    """
    found, ordered = looks(figure), style.ordered(256)
    scales = set(ordered), set(map(style.pale, ordered))
    marks = {look[0]: {other[1:3] for other in found if other[0] == look[0]} for look in found}
    marks = {hue: {shape for shape in shapes if shape[0]} for hue, shapes in marks.items()}
    for one, other in combinations(sorted(found, key=str), 2):
        if one[0] == other[0] or any({one[0], other[0]} <= scale for scale in scales):
            continue
        assert not apart(one, other, marks), (one, other)
