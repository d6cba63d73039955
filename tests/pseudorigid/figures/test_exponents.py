"""Names of exponents are at the ends of their lines; chaotic ones are drawn again above."""

import numpy as np
import pytest
import xarray as xr

from helpers.legible import assert_legible, frames_of
from helpers.samples import ATTRS, SCENES, exponents, module
from paper.figures.exponents import hidden
from pseudorigid.figures.canvas.sheet import POINT

TOUCHING = 1.3 * 9 * POINT  # pixels between two names that touch


def history(*values, step=100, types=None):
    """Exponents of orbits, each a list of records of three values or of NaN."""
    values = np.array(values, dtype=float).transpose(1, 0, 2)
    variables = {"exponent": (("impact", "orbit", "index"), values)}
    variables["type"] = ("orbit", types or ["chaotic"] * values.shape[1])
    impact = step * np.arange(1, len(values) + 1)
    return xr.Dataset(variables, coords={"impact": impact}, attrs=ATTRS)


def drawn(data, **axes):
    """The scene of the axes alone, and its figure."""
    scene = SCENES["exponents"] | {"axes": axes, "starts": [0.6, 0.62, 0.65][: data.sizes["orbit"]]}
    return scene, module("exponents").draw(scene, data)


def names(figure):
    """Left ends and middles of the names, (name, 2) in pixels."""
    found = [text for text in figure.texts if "lambda" in text.get_text()]
    found.sort(key=lambda text: text.get_text())
    return np.array([text.get_position() for text in found]) * figure.dpi


def main_lines(figure):
    """The main axes' frame in pixels, and the lines that these cut off."""
    frame = max(frames_of(figure), key=lambda frame: frame.height)
    lines = [line for line in figure.artists if line.get_clip_box() is not None]
    main = [line for line in lines if line.get_clip_box().y0 == pytest.approx(frame.y0, abs=1)]
    return frame, [line.get_xydata() * figure.dpi for line in main]


def test_a_name_is_at_the_end_of_its_line_unless_it_would_cover_another():
    random = np.random.default_rng(1)
    moved = 0
    for share in np.linspace(0.05, 1.0, 40):  # of the axis within which the ends lie
        end = random.uniform(-0.3 * share, 0.3 * share, 3) + random.uniform(-0.2, 0.2) * (1 - share)
        data = history([random.uniform(-0.1, 0.1, 3), random.uniform(-0.1, 0.1, 3), end])
        _, figure = drawn(data, exponent={"limits": [-0.3, 0.3], "ticks": [0]})
        frame, lines = main_lines(figure)
        ends = np.sort([line[-1, 1] for line in lines])[::-1]
        at = names(figure)[:, 1]
        assert (-np.diff(at) > TOUCHING - 0.1).all()
        groups = np.split(np.arange(3), 1 + np.flatnonzero(-np.diff(at) > TOUCHING + 0.1))
        moved += len(groups) < 3
        for group in groups:  # least squares: a group has the mean of its ends
            if frame.y0 + 1 < at[group[-1]] and at[group[0]] < frame.y1 - 1:
                assert at[group].mean() == pytest.approx(ends[group].mean(), abs=0.1)
                assert (np.cumsum(at[group] - ends[group]) > -0.2).all()  # upper ones go up
    assert 10 < moved < 30


def test_names_follow_lines_that_end_before_the_axis_or_leave_it():
    falling = [[0.25 - 0.008 * i, 0.008 * i, 0.01 * i - 0.25] for i in range(11)]
    _, figure = drawn(history(falling), impact={"limits": [0, 3000], "ticks": [0]})
    frame, lines = main_lines(figure)
    assert np.abs(names(figure) - [line[-1] + [4 * POINT, 0] for line in lines]).max() < 0.1
    assert_legible(figure)
    edges = {"exponent": {"limits": [-0.15, 0.17], "ticks": [0]}}  # at the ends of lines
    assert_legible(drawn(history(falling), impact={"limits": [0, 3000], "ticks": [0]}, **edges)[1])
    _, figure = drawn(history(falling), impact={"limits": [0, 450], "ticks": [0]})
    frame, lines = main_lines(figure)
    leave = [np.interp(frame.x1, *line.T) for line in lines]
    assert names(figure)[:, 1] == pytest.approx(leave, abs=0.1)


FLAT = [[0.23, 0.0, -0.23]] * 20
LOW = [[0.01, 0.001, -0.01]] * 20
NOTHING = [[np.nan] * 3] * 16


def test_the_largest_exponents_of_chaotic_orbits_are_drawn_again_above():
    _, figure = drawn(history(FLAT, LOW, types=["chaotic", "regular"]))
    assert_legible(figure)
    upper, lower = sorted(frames_of(figure), key=lambda frame: -frame.y0)
    assert upper.y0 > lower.y1 and upper.height > 0.45 * lower.height
    lines = [line.get_xydata() * figure.dpi for line in figure.artists if line.get_lw() == 0.8]
    assert sum(upper.contains(*line.mean(axis=0)) for line in lines) == 1


@pytest.mark.parametrize("energy", [0.01, 0.0098])
def test_the_papers_exponent_is_a_line_in_its_case_alone(energy):
    data = history(FLAT, [[0.231, 0.0, -0.231]] * 20)
    axes = {"largest": {"limits": [0.22, 0.24], "ticks": [0.22, 0.24]}}
    scene = SCENES["exponents"] | {"axes": axes, "starts": [0.6, 0.62], "energy": energy}
    figure = module("exponents").draw(scene, data)
    upper = max(frames_of(figure), key=lambda frame: frame.y0)
    heights = [
        upper.y0 + (value - 0.22) / 0.02 * upper.height
        for value, name in ((0.235, "the paper: 0.235"), (0.231, "largest at the end: 0.231"))
        if name in [text.get_text() for text in figure.texts]
    ]
    lines = [a.get_ydata()[0] * figure.dpi for a in figure.artists if a.get_lw() == 0.7]
    assert len(heights) == 2 * (energy == 0.01) and lines == pytest.approx(heights, abs=0.1)


def test_a_panel_without_data_is_left_out_and_its_axis_is_said_to_be_unused():
    short = history([*FLAT[:4], *NOTHING], LOW, types=["chaotic", "regular"])
    largest = {"limits": [0.2, 0.25], "ticks": [0.2]}
    for data in (short, history(FLAT, types=["regular"])):
        scene, figure = drawn(data, largest=largest)
        assert len(frames_of(figure)) == 1
        (line,) = hidden(scene, data)
        assert line.startswith("axes.largest is not used: ") and line.endswith("largest out")
    scene, figure = drawn(exponents(), largest=largest)
    assert len(frames_of(figure)) == 2 and not [*hidden(scene, exponents())]


@pytest.mark.parametrize("limits", [[0.232, 0.24], [0.22, 0.232]])
def test_a_line_of_the_upper_panel_beyond_its_limits_is_left_out(limits):
    axes = {"largest": {"limits": limits, "ticks": limits}}
    scene = SCENES["exponents"] | {"axes": axes, "starts": [0.6, 0.62]}
    varied = [[0.23 + 0.0002 * i, 0.0, -0.23] for i in range(20)]
    data = history(varied[::-1], [[0.231, 0.0, -0.231]] * 20)
    texts = [text.get_text() for text in module("exponents").draw(scene, data).texts]
    expected = "the paper" if limits[1] > 0.235 else "largest at the end"
    assert [t.partition(":")[0] for t in texts if ": 0.23" in t] == [expected]
