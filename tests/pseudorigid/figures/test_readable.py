"""Published pictures can be read at the width of a column, by readers with each colour vision."""

import numpy as np
import pytest

from helpers import readable
from helpers.project import ROOT
from helpers.readable import assert_readable, faults
from pseudorigid.figures.axes.panel import Axis, Panel, key
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.names import name_curves
from pseudorigid.figures.canvas.render import render
from pseudorigid.figures.canvas.sheet import Sheet

SUMS = [*ROOT.glob("paper_figures/SHA256SUMS"), *ROOT.glob("more_figures/*/SHA256SUMS")]
SVGS = {
    f"{file.parent.name}/{line.split()[1]}": file.parent / line.split()[1]
    for file in sorted(SUMS)
    for line in file.read_text(encoding="utf-8").splitlines()
    if line.endswith(".svg")
}


@pytest.mark.parametrize("name", SVGS)
def test_a_published_picture_can_be_read(name):
    assert_readable(SVGS[name].read_text(encoding="utf-8"))


def sheet():
    return Sheet(style.COLUMN, 600)


def kinds(drawn):
    return {kind for kind, _ in faults(render(drawn.figure, "svg"))}


def a_chart(**line_style):
    """Draw two lines, each named, with a key."""
    drawn = sheet()
    axis = Axis((0, 1), (0, 0.5, 1))
    panel = Panel(drawn, (150, 150, 1000, 500), axis, axis)
    panel.line([0, 1], [0.2, 0.3], color=style.BLUE)
    panel.line([0, 1], [0.7, 0.8], **{"color": style.VERMILION, "ls": "--"} | line_style)
    panel.note(0.5, 0.5, "$10^{-3}$ between")
    key(drawn, [("one", style.BLUE), ("other", style.VERMILION, "", True)], 50, columns=2)
    return drawn


def test_a_good_chart_has_no_fault_and_its_key_is_found():
    drawn = a_chart()
    assert kinds(drawn) == set()
    entries = readable.Drawing(render(drawn.figure, "svg")).key()
    assert [name for name, _ in entries] == ["one", "other"]
    marks = sheet()
    key(marks, [("a", style.BLUE, "o"), ("b", style.BLUE, "o", True)], 300, columns=1)
    found = readable.Drawing(render(marks.figure, "svg")).key()
    assert [(name, line.hollow) for name, line in found] == [("a", False), ("b", True)]
    assert kinds(marks) == set()


@pytest.mark.parametrize(("size", "text", "wide", "small"), [
    (6.0, "text", 1050, False), (5.9, "text", 1050, True),
    (7.0, "$10^{-3}$", 1050, False), (6.9, "$10^{-3}$", 1050, True),
    (8.5, "text", 1500, True), (8.6, "text", 1500, False),
])  # fmt: skip
def test_small_text_is_a_fault(size, text, wide, small):
    drawn = Sheet(wide, 600)
    drawn.text(300, 300, text, size=size)
    assert kinds(drawn) == ({"size"} if small else set())


@pytest.mark.parametrize(("color", "pale"), [("#949494", False), ("#959595", True)])
def test_a_pale_line_is_a_fault_unless_it_is_ground(color, pale):
    assert kinds(a_chart(color=color)) == ({"contrast"} if pale else set())
    for ground in style.QUIET:
        assert kinds(a_chart(color=ground)) == set()


def test_a_pale_text_is_a_fault_and_a_sheet_writes_none():
    drawn = sheet()
    drawn.text(100, 100, "text", size=8.0, color=style.STABLE)
    assert kinds(drawn) == set()
    drawn.figure.texts[0].set_color("#777777")  # 4.48
    assert kinds(drawn) == {"contrast"}
    on_band = sheet()
    on_band.draw([100, 900], [300, 300], color=style.BACKDROP, lw=20)
    on_band.text(300, 300, "text", size=8.0, color=style.BLUE)
    assert kinds(on_band) == {"contrast"}


@pytest.mark.parametrize(("entries", "alike"), [
    (((style.BLUE, "o"), (style.GREEN, "o")), False),
    (((style.VERMILION, "o"), (style.ORANGE, "o")), True),  # to a deuteranope
    (((style.VERMILION, "o"), (style.ORANGE, "^")), False),
    (((style.BLUE, "", False), (style.BLUE, "", True)), False),
    (((style.BLUE, "", False, 0.9), (style.BLUE, "", False, 1.2)), True),
    (((style.BLUE, "", False, 0.8), (style.BLUE, "", False, 1.6)), False),
])  # fmt: skip
def test_entries_of_a_key_that_look_alike_are_a_fault(entries, alike):
    drawn = sheet()
    named = [(name, *entry) for name, entry in zip("ab", entries, strict=True)]
    key(drawn, named, 300, columns=1)
    assert kinds(drawn) == ({"key"} if alike else set())


def test_text_over_text_or_over_a_line_or_a_mark_is_a_fault():
    drawn = a_chart()
    drawn.text(575, 325, "over", size=8.0)
    assert kinds(drawn) == {"over"}
    for across, up in (((150, 1000), (325, 325)), ((500, 800), (200, 480))):
        drawn = a_chart()
        drawn.draw(across, up, color=style.BLACK, lw=0.5)
        assert kinds(drawn) == {"over"}
    drawn = a_chart()
    drawn.dots([600], [325], style.BLACK, 2.0)
    assert kinds(drawn) == {"over"}
    drawn = a_chart()
    drawn.draw([150, 1000], [325, 325], clip=(150, 150, 500, 500), color=style.BLACK, lw=0.5)
    assert kinds(drawn) == set()


def test_a_name_interrupts_its_own_curve_only():
    angle = np.linspace(0, 2 * np.pi, 2000)
    curve = 450 + 200 * np.array([np.cos(angle), 0.6 * np.sin(angle)])
    for own in (True, False):
        drawn = sheet()
        drawn.draw(*curve, color=style.STABLE, lw=0.8)
        name_curves(
            drawn, [curve, np.empty((2, 0))], ["1"], [style.STABLE], (0, 0, 1050, 900), 10.0
        )
        if not own:
            drawn.figure.texts[0].set_color(style.BLUE)
        assert kinds(drawn) == (set() if own else {"over"})


@pytest.mark.parametrize("side", [-1, 1])
def test_a_name_is_off_the_ground_if_it_can_be(side):
    angle, grid = np.linspace(0, 2 * np.pi, 2000), np.arange(-450.0, 451.0, 3.0)
    curve = 450 + 200 * np.array([np.cos(angle), np.sin(angle)])
    across, up = 450 + np.reshape(np.meshgrid(grid[side * grid > -60], grid), (2, -1))
    drawn = sheet()
    drawn.dots(across, up, style.SEA, 0.4)
    drawn.draw(*curve, color=style.BLUE, lw=0.8)
    curves, ground = [curve, np.empty((2, 0))], np.array([across, up])
    name_curves(drawn, curves, ["1"], [style.BLUE], (0, 0, 900, 900), 10.0, ground)
    (text,) = drawn.figure.texts
    assert side * (text.get_position()[0] * style.DPI - 450) < -60 and kinds(drawn) == set()


def test_the_ink_of_a_colour_is_the_colour_where_it_is_dark_enough():
    assert style.ink(style.BLUE) == style.BLUE and style.ink(style.BLACK) == style.BLACK
    for color in [style.VERMILION, style.SKY, style.ORANGE, style.PALE_SEA, *style.ordered(9)]:
        assert readable.contrast(style.ink(color), "#ffffff") >= readable.OF_TEXT


def test_a_pale_colour_is_as_light_as_a_line_may_be():
    for color in (style.BLUE, style.VERMILION, style.BLACK, style.GREEN, *style.ordered(9)):
        pale = readable.contrast(style.pale(color), "#ffffff")
        assert readable.OF_LINES <= pale <= readable.contrast(color, "#ffffff")
    assert readable.contrast(style.pale(style.BLUE), "#ffffff") < 3.6
