"""The picture of chains over a plane: legible, and each curve is drawn where it belongs."""

import numpy as np
import xarray as xr
from legible import assert_legible

from extensions.atlas.figures import atlas, raster
from extensions.families.figures import chains

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
    curves = xr.Dataset(
        {
            "order": ("curve", [order for order, _ in lines]),
            "kind": ("curve", np.array([kind for _, kind in lines], dtype=object)),
            "row_size": ("curve", [2] * len(lines)),
            "k": ("point", np.ravel([k for k, _ in lines.values()])),
            "energy": ("point", np.ravel([energy for _, energy in lines.values()])),
        }
    )
    return chains.draw(SWEEP, data, curves), lines


def test_text_is_whole_and_apart():
    assert_legible(drawn()[0])


def test_each_curve_is_drawn_where_its_data_are():
    figure, lines = drawn()
    artists = [
        (np.column_stack(artist.get_data()) * figure.dpi, artist.get_color())
        for artist in figure.artists
        if len(artist.get_xdata()) == 2 and artist.get_zorder() == 2.0
    ]
    left, right = raster.edges(np.log10(SWEEP["energy"]))[[0, -1]]
    low, high = raster.edges(np.array(SWEEP["k"]))[0], 1 / 3  # a shell: the last edge is beyond
    colours = {}
    for (order, _), (k, energy) in lines.items():
        x = atlas.LEFT + (np.log10(energy) - left) / (right - left) * atlas.WIDE
        y = chains.BOTTOM + (np.array(k) - low) / (high - low) * atlas.HIGH
        wanted = np.column_stack([x, y])
        distance, colour = min((np.abs(places - wanted).max(), each) for places, each in artists)
        assert distance < 0.3
        assert colours.setdefault(order, colour) == colour
    assert len({*colours.values()}) == len(colours)
