"""A refused argument of a Picture is a ValueError of one line that names it; others are drawn."""

import datetime
from fractions import Fraction

import numpy as np
import pandas
import pytest
import xarray as xr

from pseudorigid import Picture

ENDS = [0.0, 1.0]
TEXTS = (None, 3, b"a", ["a"], r"$\foo$", "$x_$", "$a$ $b_$")
NUMBERS = (None, True, "0.5", 1j, [], [0.5], np.nan, np.inf, 10**400, {}, datetime.date(2020, 1, 1))
ARRAYS = (None, "ab", ["a", "b"], [0.0, None], [0.0, 1j], {}, np.zeros(2, "M8[s]"), np.zeros(3))
DATA = ([], [np.nan] * 2, np.inf, [1.0, np.inf], 10**400, -1e301, np.ma.masked)
COLORS = (None, "blurple", 3, [1, 2], "$x$", np.nan)
STYLE = {"color": "blurple", "lw": np.nan, "ls": "~", "marker": "@", "zorder": "a", "mec": [2.0]}
MARKS = {"x": ENDS, "y": ENDS, "color": "red"}
INTERVALS = {"x": ENDS, "low": ENDS, "high": ENDS}
SCALE = {"colors": ["red", "blue"], "low": 0.0, "high": 1.0}
CASES = [  # method, right arguments, values to be refused of one of them
    *((Picture, {"x": ENDS, "y": ENDS, name: None}, name, [*ARRAYS[:-1], *DATA]) for name in "xy"),
    (Picture, {"x": ENDS, "y": ENDS}, "names", [None, "ab", ("a",), [1, 2], ("a", r"$\foo$")]),
    (Picture, {"x": ENDS, "y": ENDS}, "title", TEXTS),
    *(("line", MARKS, name, [*ARRAYS, np.zeros((2, 2))]) for name in "xy"),
    *((method, MARKS, "label", TEXTS) for method in ("line", "dots")),
    *(("dots", MARKS, name, ARRAYS) for name in "xy"),
    ("dots", MARKS, "size", (*NUMBERS, -1.0, 1e4)),
    ("dots", MARKS, "color", COLORS[1:]),
    *(("bars", INTERVALS, name, ARRAYS) for name in INTERVALS),
    *(("estimates", INTERVALS | {"values": ENDS}, name, ARRAYS) for name in (*INTERVALS, "values")),
    ("estimates", INTERVALS | {"values": ENDS, "color": "red"}, "color", COLORS),
    *(("note", {"x": 0.5, "y": 0.5, "text": "a"}, name, NUMBERS) for name in "xy"),
    ("note", {"x": 0.5, "y": 0.5}, "text", TEXTS),
    ("note", {"x": 0.5, "y": 0.5, "text": "a"}, "shift", [3, "ab", (1,), (1, None), (np.nan, 1)]),
    *(("note", {"x": 0.5, "y": 0.5, "text": "a"}, name, (None, 3, "no")) for name in ("ha", "va")),
    ("colorbar", SCALE, "colors", [None, "red", 3, [], ["red"], ["red", "blurple"], [1, 2]]),
    *(("colorbar", SCALE, name, NUMBERS) for name in ("low", "high")),
    ("colorbar", SCALE, "high", (0.0, -1.0)),
    ("colorbar", SCALE, "name", TEXTS),
    ("render", {}, "extension", (None, "gif", ".png", "PNG", 3, b"png")),
    ("save", {}, "file", (None, "foo", "foo.gif", "png", ".png", 3, b"foo.png")),
    *(("line", MARKS, name, (value,)) for name, value in [*STYLE.items(), ("colr", "red")]),
    *(("dots", MARKS, name, (value,)) for name, value in STYLE.items()),
    *(("line", MARKS, name, (1,)) for name in ("transform", "clip", "figure")),
]
NAMES_OF_MANY = "x", "y", "low", "high", "values"


@pytest.fixture
def picture():
    return Picture(ENDS, ENDS)


@pytest.mark.parametrize(("method", "arguments", "name", "values"), CASES)
def test_a_refused_argument_is_one_line_that_names_it(method, arguments, name, values, picture):
    call = getattr(picture, method) if isinstance(method, str) else method
    if method == "estimates":
        arguments = {"color": "red"} | arguments
    for value in values:
        with pytest.raises(ValueError) as error:
            call(**arguments | {name: value})
        text = str(error.value)
        shapes = name in NAMES_OF_MANY and "of shapes" in text
        assert shapes or (name in text.partition(" is not allowed: ")[0]), (value, text)
        assert "\n" not in text and len(text) < 250
        assert type(error.value) is ValueError and ("is not allowed: " in text or shapes)
    assert len(picture.figure.artists) == len(Picture(ENDS, ENDS).figure.artists)


def test_every_kind_of_numbers_and_text_is_drawn(picture, tmp_path):
    assert picture.save(tmp_path / "a.svg") is picture
    many = np.ma.array([[0.1, 0.2], [0.3, 9.0]], mask=[[0, 0], [0, 1]])
    picture.dots(many, Fraction(1, 2), (0.1, 0.2, 0.3), np.int8(3), "costs $5, or 5 $")
    picture.line(pandas.Series(ENDS), xr.DataArray([0.0, np.inf]), "$x^2$", ls="--", marker="s")
    picture.line([], [], "nothing")
    picture.line(0.5, range(2))
    picture.dots([], [], "none")
    picture.bars(ENDS, 0, [np.nan, 1.0], label="bars", color="0.5")
    picture.colorbar(np.eye(3), 0, Fraction(1, 3), "a third")
    picture.estimates(ENDS, [0.5, np.nan], 0, 1, "tab:red")
    (picture.note(1e9, 0.5, "beyond the axes"), picture.note(Fraction(1, 2), 0.5, "half", (1, 2)))
    for extension in ("png", "svg", "pdf"):
        assert picture.render(extension)
    for x in ([1e300, -1e300], 5e-324, [1e15, 1e15 + 1], Fraction(1, 3), [np.nan, 2.0], many):
        assert Picture(x, [0, 1]).render("svg")


def test_a_colorbar_has_its_colours_from_low_to_high_and_an_svg_its_title():
    picture = Picture(ENDS, ENDS, title="A & B")
    picture.colorbar(["red", "lime", "blue"], 2, 5, "scale")
    assert b"<title>A &amp; B</title>" in picture.render("svg")
    bars = [a for a in picture.figure.artists if a.get_color() in ("#ff0000", "#00ff00", "#0000ff")]
    heights = [a.get_ydata()[0] for a in bars]
    assert [a.get_color() for a in bars] == ["#ff0000", "#00ff00", "#0000ff"]
    step = heights[1] - heights[0]
    at = {text.get_text(): text.get_position()[1] for text in picture.figure.texts}
    assert at["3"] == pytest.approx(heights[0] + 0.5 * step, abs=0.01) and at["scale"] > heights[-1]
