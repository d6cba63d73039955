"""Keys and limits of the pictures of claims follow the data."""

import numpy as np
import pytest
import xarray as xr
from keys import SCENE, colors, texts
from sections import BALL

from extensions.claims.analyses.flux import SIDES
from extensions.claims.analyses.spread import spread
from extensions.claims.figures import flux as flux_figure
from extensions.claims.figures import last_curve as last_curve_figure
from extensions.claims.figures import spread as spread_figure
from pseudorigid.dynamics.lyapunov import scene_exponents
from pseudorigid.figures.canvas import style


def residues(values):
    """A dataset of residues of two convergents of two numbers."""
    x, y = np.random.default_rng(1).uniform(-1, 1, (2, 2, 9))
    by_convergent = {"period": [[23.0, 40.0], [17.0, 29.0]], "residue": values}
    return xr.Dataset(
        {"rotation": ("noble", [0.17, 0.18])}
        | {name: (("noble", "convergent"), array) for name, array in by_convergent.items()}
        | {name: (("noble", "point"), array) for name, array in (("x", x), ("y", y))}
    )


def test_the_critical_residue_lies_within_its_axis():
    figure = last_curve_figure.draw(SCENE, residues([[1e-3, 1e-5], [1e-6, 1e-9]]))
    (critical,) = (line for line in figure.artists if line.get_linestyle() == "--")
    assert critical.get_ydata()[0] < 1425 / style.DPI - 0.05


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_hollow_residues_are_explained_if_there_are_any(sign):
    figure = last_curve_figure.draw(SCENE, residues([[1e-3, 1e-5], [1e-6, sign * 1e-9]]))
    assert ("hollow: negative" in texts(figure)) == (sign < 0.0)


def test_a_start_under_regular_that_is_chaotic_is_no_island():
    data = spread(BALL, 0.01, 4, 2000, 4, [-0.2, 0.6], 1024, 4, 100)
    runs = scene_exponents(BALL, 0.01, [0.6], 500, 4)
    figure = spread_figure.draw(SCENE, data, runs)
    assert "Largest exponent in the islands" not in texts(figure)
    assert any("grey: chaotic" in text for text in texts(figure))
    assert style.SEA in colors(figure)
    calm = spread_figure.draw(SCENE, data.isel(island=[0]), runs)
    assert "Largest exponent in the islands" in texts(calm) and style.SEA not in colors(calm)


def test_flux_without_regions_and_lobes_says_why():
    blank = {name: ("side", [np.nan] * 2) for name in ("area", "region")}
    lines = ("outline_x", "outline_y", "branch_x", "branch_y", "crossing_x")
    blank |= {name: (("side", "n"), np.full((2, 9), np.nan)) for name in lines}
    why = {"missing_inner": "a jump of the map cuts it"}
    data = xr.Dataset(blank, coords={"side": list(SIDES)}, attrs=why)
    figure = flux_figure.draw(SCENE, data)
    assert "neither region has an edge that can be drawn" in texts(figure)
    assert "no lobe: a jump of the\nmap cuts it" in texts(figure)
    assert not {style.SKY, style.VERMILION} & colors(figure)
