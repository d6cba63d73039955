"""The picture of chains over a plane: legible, and each curve is drawn where it belongs."""

import numpy as np
import xarray as xr

from extensions.atlas.grid import edges
from extensions.families.figures import chains
from helpers.legible import assert_legible, frames_of
from helpers.readable import assert_readable
from pseudorigid.figures.canvas import style

SWEEP = {
    "k": list(np.linspace(0.05, 0.32, 10)),
    "energy": list(np.geomspace(0.1, 40.0, 16)),
    "chains": [3, 4, 5, 6, 7, 8],
}
KINDS = "resonance", "fold", "doubling", "rim"


def drawn():
    """The figure of straight lines of all kinds, and what was drawn."""
    shape = len(SWEEP["k"]), len(SWEEP["energy"])
    data = xr.Dataset({"regular": (("k", "energy"), np.full(shape, 0.4))})
    lines = {(0, "jumps"): ([0.06, 0.3], [1.03, 1.15])}
    for i, order in enumerate(SWEEP["chains"]):
        for j, kind in enumerate(KINDS):
            energy = 10 ** (-0.8 + 0.35 * i + 0.08 * j)
            lines[order, kind] = ([0.06, 0.3], [3.0 * energy, energy])
    curves = {
        "order": ("curve", [order for order, _ in lines]),
        "kind": ("curve", np.array([kind for _, kind in lines], dtype=object)),
        "row_size": ("curve", [2] * len(lines)),
        "k": ("point", np.ravel([k for k, _ in lines.values()])),
        "energy": ("point", np.ravel([energy for _, energy in lines.values()])),
    }
    return chains.draw(SWEEP, data, xr.Dataset(curves)), lines


def test_text_is_whole_and_apart():
    figure, _ = drawn()
    assert_legible(figure)
    assert_readable(figure)


def test_each_curve_is_drawn_where_its_data_are():
    figure, lines = drawn()
    artists = [
        (np.column_stack(artist.get_data()) * figure.dpi, artist.get_color(), artist.get_lw())
        for artist in figure.artists
        if len(artist.get_xdata()) == 2 and artist.get_zorder() == 2.0
    ]
    left, right = edges(np.log10(SWEEP["energy"]))[[0, -1]]
    low, high = edges(np.array(SWEEP["k"]))[0], 1 / 3  # a shell: the last edge is beyond
    looks = {}
    for (order, kind), (k, energy) in lines.items():
        frame = frames_of(figure)[max(order - 3, 0)]  # a panel for each order, from 3
        x = frame.x0 + (np.log10(energy) - left) / (right - left) * frame.width
        y = frame.y0 + (np.array(k) - low) / (high - low) * frame.height
        wanted = np.column_stack([x, y])
        near = [(np.abs(places - wanted).max(), look) for places, *look in artists]
        distance, look = min(near)
        assert distance < 0.3 and looks.setdefault(kind, look) == look
    assert len({*map(str, looks.values())}) == len(looks)
    for frame in frames_of(figure):  # the four kinds of its order, and the onset of jumps
        inside = [look for places, *look in artists if frame.contains(*places.mean(axis=0))]
        assert len([look for look in inside if look[0] != style.FRAME]) == 5
