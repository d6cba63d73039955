"""Pictures have the same bytes for everyone, and hold exactly what was drawn."""

import os
import re
import shutil
import sys
from io import BytesIO

import numpy as np
import pytest
from project import ROOT, run
from samples import KINDS, draw, drawn

from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.render import pixels, render
from pseudorigid.figures.canvas.sheet import Sheet


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
        assert image.mode == "RGB"
        assert round(image.info["dpi"][0]) == style.DPI
        assert set(image.info) == {"dpi", "srgb"}
        assert np.array_equal(np.asarray(image), pixels(figure))


def test_fonts_of_the_system_are_not_used(tmp_path):
    from matplotlib import font_manager

    manager = font_manager.fontManager
    own = font_manager.findfont("DejaVu Serif")
    copy = shutil.copy(own, tmp_path)
    manager.addfont(copy)
    manager.ttflist.insert(0, manager.ttflist.pop())
    try:
        assert font_manager.findfont("DejaVu Serif") == copy
        with style.shipped_fonts():
            assert font_manager.findfont("DejaVu Serif") == own
    finally:
        del manager.ttflist[0]
        manager.addfont(own)  # clears the cached path of the copy
        manager.ttflist.pop()


def test_drawing_leaves_matplotlib_as_it_was():
    import matplotlib
    from matplotlib import font_manager

    all_fonts = font_manager.fontManager.ttflist
    with matplotlib.rc_context({"font.size": 31, "path.simplify": True}):
        before = dict(matplotlib.rcParams)
        pixels(draw("motion"))
        assert dict(matplotlib.rcParams) == before
    assert font_manager.fontManager.ttflist is all_fonts


def test_a_drawing_imports_only_what_it_uses():
    names = "pyplot", "numba", "scipy", "netCDF4", "backend_pdf"
    code = (
        "import sys\n"
        f"from pseudorigid.figures.kinds import {', '.join(KINDS)}\n"
        "from pseudorigid.figures.canvas import render\n"
        f"print([m for m in sys.modules for name in {names} if name in m.split('.')])"
    )
    result = run(sys.executable, "-c", code, env=os.environ | {"PYTHONPATH": str(ROOT / "src")})
    assert result.stdout == "[]\n", result.stderr


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
