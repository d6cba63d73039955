"""From every view, the labels of a box are whole, apart, and outside the box beside their axes."""

from functools import cache
from itertools import combinations, product

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from helpers.samples import FLAT, SCENES, SPACE, exponents, module
from helpers.slowly import slowly
from pseudorigid.figures.axes import box as box_module
from pseudorigid.figures.axes.box import Box
from pseudorigid.figures.axes.direction import disproportion
from pseudorigid.figures.canvas import sheet, style

ELEVATIONS = [0.1, 1, 7, 20, 35, 50, 70, 87, 89.9]
AZIMUTHS = sorted({*range(-360, 361, 45), -100, 115})
# Beside multiples of 90 and of 45 degrees, and where the axis of udot changes its side.
TURNS = [0.1, 1, 3, 10, 20, 30, 62, 64, 80, 87, 89.9]
AZIMUTHS += [90 * (i % 8 - 4) + turn for i, turn in enumerate(TURNS)]
SOME_VIEWS = [*product([7, 70, 89.9], [-100, 0, 45, 64])]
ENTRIES = [(name, style.BLACK, "o") for name in ("stable", "unstable", "saddles", "orbits")]
LEAST = 4  # pixels between a label and the ends of the picture
NEAR = 4  # pixels by which a label may be nearer to another axis, at a corner


def axes(x, xdot, udot):
    """Axes with ticks, whose limits are the first and the last tick."""
    ticks = {"x": x, "xdot": xdot, "udot": udot}
    return {name: {"limits": [at[0], at[-1]], "ticks": at} for name, at in ticks.items()}


WHOLE, THIRD, SHORT = [-0.4, -0.2, 0, 0.2, 0.4], [-0.4, 0, 0.4], [0.1, 0.1005, 0.101]
DENSE = [i / 50 for i in range(-20, 21)]
BOXES = {
    "SPACE": SPACE, "FLAT": FLAT,
    "corners": axes([-0.2, 0, 0.2, 0.4, 0.6], WHOLE, [-0.2, 0, 0.2, 0.4]),
    "long labels": axes(*[[-0.0005, -0.00025, 0, 0.00025, 0.0005]] * 3),
    "large": axes([-20000, 0, 60000], [-40000, 0, 40000], [-20000, 10000, 40000]),
    "short x": axes(SHORT, THIRD, THIRD), "short xdot": axes(THIRD, SHORT, THIRD),
    "short udot": axes(THIRD, THIRD, SHORT), "wide x": axes(WHOLE, [-0.1, 0, 0.1], [-0.1, 0, 0.1]),
    "wide xdot": axes([-0.1, 0, 0.1], WHOLE, [-0.1, 0, 0.1]),
    "many ticks": axes(DENSE, DENSE, DENSE),
    "uneven ticks": axes([-0.4, 0.01, 0.02, 0.4], [-0.4, -0.39, 0.4], [-0.2, -0.19, 0.3, 0.4]),
}  # fmt: skip


class BareBox(Box):
    """A box without panes and lines, which take most of the time."""

    def seen(self, points):
        return np.full(points.shape[1], True)

    def line(self, points, color, width):
        pass

    def _panes(self):
        pass


def distance(point, start, end):
    """The distance of a point from a segment."""
    along = end - start
    share = np.clip((point - start) @ along / max(along @ along, 1e-30), 0, 1)
    return np.hypot(*(start + share * along - point))


def depth(box, extent):
    """How far a rectangle reaches into the outline of a box, not above 0 if it does not."""
    corners, rectangle = np.array(box.view(box.view.corners)), extent.corners().T
    normals = [
        np.array([-up, right]) for right, up in zip(box.view.right, box.view.up, strict=True)
    ]
    normals = [n / np.hypot(*n) for n in normals if np.hypot(*n) > 1e-9]
    spans = [(n @ corners, n @ rectangle) for n in (*normals, np.array([1, 0]), np.array([0, 1]))]
    return min(min(a.max(), b.max()) - max(a.min(), b.min()) for a, b in spans)


def faults(box, renderer):
    """Yield what is wrong with the texts of a box."""
    extents = [(text.get_text(), text.get_window_extent(renderer)) for text in box.figure.texts]
    wide, high = box.figure.bbox.size
    for text, extent in extents:
        if min(*extent.min, wide - extent.x1, high - extent.y1) < LEAST:
            yield text, "leaves the picture"
    for (text, extent), (other_text, other) in combinations(extents, 2):
        if extent.overlaps(other):
            yield text, f"covers {other_text}"
    starts, names = [start for start, _ in box._axes()], [*style.NAMES.values()]
    ends = [[*at[:i], box.spans[i][1], *at[i + 1 :]] for i, at in enumerate(starts)]
    edges = [np.transpose(box.view(np.transpose(edge))) for edge in zip(starts, ends, strict=True)]
    along, numbers = 0, 0
    for text, extent in extents[2 + len(ENTRIES) :]:  # after the setting and the key
        away = [distance(0.5 * (extent.min + extent.max), *edge) for edge in edges]
        if away[along] > min(away) + NEAR:
            yield text, f"stands at another axis than {names[along]}"
        if depth(box, extent) > 1:
            yield text, "stands inside the box"
        if text in names:
            if text != names[along] or not numbers:
                yield text, "has no number"
            along, numbers = along + 1, 0
        else:
            numbers += 1
    if along != len(names):
        yield "a name", "is missing"


@pytest.mark.parametrize("which, views", [
    *((which, SOME_VIEWS) for which in BOXES),
    *slowly(*((which, [*product(ELEVATIONS, AZIMUTHS)]) for which in BOXES)),
])  # fmt: skip
def test_labels_of_a_box_are_whole_apart_and_at_their_axes(which, views, monkeypatch):
    monkeypatch.setattr(box_module, "width", cache(box_module.width))
    renderer = FigureCanvasAgg(Figure(dpi=style.DPI)).get_renderer()
    scene = {"axes": BOXES[which], "energy": 0.01, "ball": {"k": 0.2, "g": 0.04}}
    limits = [axis["limits"] for axis in BOXES[which].values()]
    wrong, shapes = [], []
    with style.pinned():
        for elevation, azimuth in views:
            if disproportion(limits, elevation, azimuth):
                continue
            box = BareBox(scene | {"view": {"elevation": elevation, "azimuth": azimuth}}, ENTRIES)
            wrong += [(elevation, azimuth, *fault) for fault in faults(box, renderer)]
            shapes.append(box.sheet.high / box.sheet.wide)
    assert not wrong and len(shapes) > len(views) / 3 and max(1 / min(shapes), *shapes) <= 4


# Limits of x, xdot and udot, a view, and the axis that makes the box too high or too flat from it.
LONG = [
    ([[0, 1], [0, 0.001], [0, 100]], (40, 115), "udot"),
    ([[0, 0.001], [0, 100], [0, 0.001]], (89.9, 180), "xdot"),
    ([[0, 0.001], [0, 100], [0, 0.001]], (0.1, 180), "xdot"),
    ([[0, 100], [0, 0.001], [0, 0.001]], (10, 90), "x"),
    ([[0, 1], [0, 1], [0, 5]], (1, 0), "udot"),
    ([[0, 1], [0, 1], [0, 0.05]], (0.1, 0), "x"),
]


@pytest.mark.parametrize("limits, view, axis", LONG)
def test_a_box_without_bound_is_refused_before_it_is_laid_out(limits, view, axis, monkeypatch):
    monkeypatch.setattr(Box, "_lay_out", None)
    names = dict(zip(style.NAMES, limits, strict=True))
    given = {name: {"limits": ends, "ticks": ends} for name, ends in names.items()}
    scene = {"axes": given, "energy": 0.01, "ball": {"k": 0.2, "g": 0.04}}
    with pytest.raises(ValueError, match=rf"^axes\.{axis}\.limits \[0, .*times as high as wide"):
        Box(scene | {"view": dict(zip(("elevation", "azimuth"), view, strict=True))})


def test_a_sheet_is_at_most_four_times_as_long_as_wide():
    for wide, high in ((300, 1200), (1200, 300)):
        assert sheet.Sheet(wide, high).high == high
    for wide, high in ((300, 1275), (1275, 300)):
        with pytest.raises(ValueError, match=f"^{wide} x {high} pixels: one side is over 4 times"):
            sheet.Sheet(wide, high)


def test_more_starts_than_a_key_can_hold_are_refused_by_name():
    data = exponents().isel(impact=slice(None, None, 20))
    history = np.repeat(data["exponent"].values[:, :1], 126, axis=1)
    history[:, 0] = 0.0  # one is regular
    data = data.drop_vars(["exponent", "type"]).assign(
        exponent=(("impact", "orbit", "index"), history),
        type=("orbit", ["regular"] + ["chaotic"] * 125),
    )
    starts = [i / 1000 for i in range(126)]
    draw = module("exponents").draw
    with pytest.raises(ValueError, match=r"^starts: 126 of them: expected at most 124"):
        draw(SCENES["exponents"] | {"starts": starts}, data)
    figure = draw(SCENES["exponents"] | {"starts": starts[:124]}, data.isel(orbit=range(124)))
    assert figure.bbox.height == 4 * figure.bbox.width
