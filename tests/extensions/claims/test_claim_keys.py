"""Keys and limits of the pictures of claims follow the data."""

import numpy as np
import pytest
import xarray as xr

from extensions.claims.analyses.flux import SIDES
from extensions.claims.analyses.spread import spread
from extensions.claims.figures import clusters as clusters_figure
from extensions.claims.figures import control as control_figure
from extensions.claims.figures import control_shares as control_shares_figure
from extensions.claims.figures import flux as flux_figure
from extensions.claims.figures import last_curve as last_curve_figure
from extensions.claims.figures import rotation as rotation_figure
from extensions.claims.figures import spread as spread_figure
from helpers.examples import checked
from helpers.keys import SCENE, colors, texts
from helpers.legible import assert_legible, frames_of
from helpers.sections import BALL
from pipeline.checks.captions import caption_of
from pipeline.checks.quantities import facts
from pseudorigid.dynamics.lyapunov import scene_exponents
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT


def residues(values):
    """A dataset of residues of two convergents of two numbers."""
    x, y = np.random.default_rng(1).uniform(-1, 1, (2, 2, 9))
    by_convergent = {"period": [[23.0, 40.0], [17.0, 29.0]], "residue": values}
    return xr.Dataset(
        {"rotation": ("noble", [0.17, 0.18])}
        | {name: (("noble", "convergent"), array) for name, array in by_convergent.items()}
        | {name: (("noble", "point"), array) for name, array in (("x", x), ("y", y))}
    )


def test_curves_of_the_last_island_are_named_on_the_section_and_the_sea_is_grey():
    figure = last_curve_figure.draw(SCENE, residues([[1e-3, 1e-5], [1e-6, 0.3]]))
    assert texts(figure).count("0.170000") == 1 and "0.180000" not in texts(figure)
    size = {len(a.get_xdata()): a.get_color() for a in figure.artists if a.get_zorder() == 4}
    assert size[9] == style.ordered(2)[0] and style.PALE_SEA in colors(figure)
    assert max(len(a.get_xdata()) for a in figure.artists if a.get_color() == style.RIM) > 300


def test_the_critical_residue_lies_within_its_axis():
    figure = last_curve_figure.draw(SCENE, residues([[1e-3, 1e-5], [1e-6, 1e-9]]))
    (critical,) = (line for line in figure.artists if line.get_linestyle() == "--")
    assert critical.get_ydata()[0] < 1575 / style.DPI - 0.05


@pytest.mark.parametrize(("last", "said", "unsaid"), [
    (1e-9, ["a curve exists", "0.170000, and with 0.180000"], ["none with", "grey", "A last"]),
    (0.3, ["a curve exists", "none with 0.180000", "A last curve", "The orbit that is"], []),
])  # fmt: skip
def test_the_caption_says_which_numbers_have_a_curve(last, said, unsaid):
    block = checked("last_curve")
    known = facts(block, {"last_curve": residues([[1e-3, 1e-5], [1e-6, last]])})
    text = " ".join(caption_of("a", block, known)[2:-1])
    assert all(words in text for words in said) and not any(words in text for words in unsaid)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_hollow_residues_are_explained_if_there_are_any(sign):
    figure = last_curve_figure.draw(SCENE, residues([[1e-3, 1e-5], [1e-6, sign * 1e-9]]))
    assert ("hollow: negative" in texts(figure)) == (sign < 0.0)


def test_a_start_under_regular_that_is_chaotic_is_no_island():
    data = spread(BALL, 0.01, 4, 2000, 4, [-0.2, 0.6], 1024, 4, 100)
    runs = scene_exponents(BALL, 0.01, [0.6], 500, 4)
    figure = spread_figure.draw(SCENE, data, runs)
    assert "Largest exponent in the islands" not in texts(figure)
    assert any("grey: chaotic" in text for text in texts(figure)) and style.SEA in colors(figure)
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
    block = checked("flux")
    caption = caption_of("a", block, facts(block, {"flux": data}))
    assert "why the outer branches have no lobe" in caption.shows and not caption.see
    assert "region" not in " ".join(caption[2:])


def test_areas_of_lobes_stand_at_the_panels_that_show_the_lobes(datasets):
    figure = flux_figure.draw(SCENE, datasets["flux/flux"])
    whole, outer, inner = frames_of(figure)
    at = {text.get_text(): np.array(text.get_position()) * figure.dpi for text in figure.texts}
    letters = {text for text, place in at.items() if whole.contains(*place)}
    assert letters == {"(b)", "(c)"}
    areas = {text: place for text, place in at.items() if text.startswith("Area")}
    for frame, area in zip((inner, outer), datasets["flux/flux"]["area"].values, strict=True):
        (text,) = (text for text, (x, _) in areas.items() if abs(x - frame.x0) < 1)
        assert f"{area:.3e}".partition("e")[0] in text
    keys = [place[1] for text, place in at.items() if "branch" in text and "es" not in text]
    assert len(keys) == 2 and keys[0] == keys[1] < min(at["grazing rim"][1], whole.y0)


def test_the_panels_along_the_same_line_are_aligned(datasets):
    figure = rotation_figure.draw(SCENE, datasets["rotation/rotation"])
    frames = frames_of(figure)[:2]
    grids = [
        a for a in figure.artists if a.get_color() == style.GRID and np.ptp(a.get_xdata()) == 0
    ]
    lines = [
        sorted(a.get_xdata()[0] for a in grids if abs(a.get_ydata()[0] * figure.dpi - frame.y0) < 1)
        for frame in frames
    ]
    assert len(lines[0]) > 4 and lines[0] == lines[1]
    assert (frames[0].x0, frames[0].x1) == (frames[1].x0, frames[1].x1)


def test_marks_of_clusters_stand_at_their_ticks(datasets):
    figure = clusters_figure.draw(SCENE, datasets["clusters/clusters"])
    artists = [(a.get_marker(), a.get_xdata() * style.DPI, a.get_color()) for a in figure.artists]
    (marks,) = {tuple(x) for mark, x, _ in artists if mark == "s" and len(x) > 1 and x[0] < 540}
    assert {*marks} <= {x[0] for _, x, hue in artists if hue == style.GRID and np.ptp(x) == 0}


def test_maps_of_a_control_are_on_the_section_and_their_shares_in_the_group_of_what_they_keep(
    datasets,
):
    data = datasets["control/control"]
    figure = control_figure.draw(SCENE, data)
    assert_legible(figure)
    rims = [a for a in figure.artists if a.get_color() == style.RIM and len(a.get_xdata()) > 200]
    assert len(rims) == len(frames_of(figure)) == 9
    figure = control_shares_figure.draw(SCENE, data)
    assert_legible(figure)
    regular, (above, below) = data.sel({"class": "regular"}), frames_of(figure)
    top = min(1.03, 1.1 * float(regular["class_high"].max()) + 0.02)
    share = regular["class_share"].sel(map=data["map"] == "stir neither").values[0, 1]
    wanted = below.y0 + (share + 0.01) / (top + 0.01) * below.height
    marks = {mark: [a.get_xydata() * style.DPI for a in figure.artists if a.get_marker() == mark]
             for mark in "os^"}  # fmt: skip
    last = below.x0 + 0.75 * below.width
    (stirred,) = (at for at in marks["s"] if at[0, 0] > last and below.contains(*at[0]))
    assert stirred[:, 1] == pytest.approx(wanted, abs=0.1)
    for frame in (above, below):  # marks of two forms are nowhere on one another
        places = np.sort([x for of_form in marks.values() for at in of_form for x, y in at
                          if frame.contains(x, y)])  # fmt: skip
        assert len(places) >= 10 and np.diff(places).min() > 3.0 * POINT - 1
