"""Pictures have the same bytes for everyone, and hold what was drawn: only lines are simplified."""

import re
from io import BytesIO

import numpy as np
import pytest

from helpers.samples import KINDS, draw, drawn
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.render import pixels, render
from pseudorigid.figures.canvas.sheet import Sheet, bends


@pytest.mark.parametrize("kind", KINDS)
def test_a_last_bit_in_matplotlib_moves_no_pixel(kind, monkeypatch):
    from matplotlib import transforms

    before = pixels(drawn(kind))
    exact = transforms.affine_transform
    random = np.random.default_rng(5)

    def noisy(values, matrix):
        result = exact(values, matrix)
        return result * (1 + 4e-16 * random.choice([-1, 0, 1], np.shape(result)))

    monkeypatch.setattr(transforms, "affine_transform", noisy)
    assert np.array_equal(pixels(draw(kind)), before)


def test_png_holds_exactly_the_pixels():
    from PIL import Image

    figure = draw("portrait")
    with Image.open(BytesIO(render(figure, "png"))) as image:
        assert image.mode == "RGB" and round(image.info["dpi"][0]) == style.DPI
        assert set(image.info) == {"dpi", "srgb"}
        assert np.array_equal(np.asarray(image), pixels(figure))


def test_thousands_of_dots_in_an_svg_are_one_path_of_the_same_dots():
    sheet = Sheet(300, 300)
    x = 20.0 + 0.1 * np.arange(2500)
    sheet.draw(x, x, ls="none", marker="o", ms=2.0, mew=0, color="#0072b2")
    sheet.draw(x[:50], x[:50] + 20, ls="none", marker="o", ms=2.0, mew=0, color="#d55e00")
    svg = render(sheet.figure, "svg").decode()
    (dots, line_style) = re.search(r'<path d="(M[^"]*h0)" style="([^"]*)"/>', svg).groups()
    assert "stroke-linecap: round; stroke: #0072b2; stroke-width: 2" in line_style
    points = np.array([dot[1:-2].split() for dot in re.findall(r"M[^M]*", dots)], dtype=float)
    shown = (np.floor(x * 256) + 0.25) / 256 * 72 / style.DPI
    assert np.abs(points - np.array([shown, 72.0 - shown]).T).max() < 1e-3
    assert svg.count("<use ") == 50


def kept_by_definition(x, y, tolerance):
    """Keep a vertex where the chord to the next one does not pass all since the last one kept."""
    keep = [0]
    for i in range(1, len(x) - 1):
        first, last = keep[-1], i + 1
        wide, high = x[last] - x[first], y[last] - y[first]
        dx, dy = x[first + 1 : last] - x[first], y[first + 1 : last] - y[first]
        square, along = wide * wide + high * high, dx * wide + dy * high
        near = np.abs(dx * high - dy * wide) <= tolerance * np.sqrt(float(square))
        if square == 0 or not np.all(near & (along >= 0) & (along <= square)):
            keep.append(i)
    return [*keep, len(x) - 1]


@pytest.mark.parametrize("seed", range(6))
def test_random_lines_keep_what_the_definition_keeps(seed):
    """Straight lines with noise, circles, walks, turns back and parabolas."""
    random = np.random.default_rng(seed)
    for count in random.integers(2, 150, 20):
        t, size = np.arange(count), random.uniform(0.1, 100.0)
        turns = random.uniform(1e-3, 0.3) * t
        for line in (
            (size * t, random.uniform(-size, size) * t + random.integers(-6, 7, count)),
            (1e5 * np.cos(turns), 1e5 * np.sin(turns)),
            random.integers(-3, 4, (2, count)).cumsum(axis=1),
            (size * t, size * np.abs(t - count // 2)),
            (size * t, random.uniform(-0.3, 0.3) * t**2),
        ):
            x, y = (np.floor(a).astype(np.int64) for a in line)
            for tolerance in (1, 4):
                assert bends(x, y, tolerance) == kept_by_definition(x, y, tolerance)
