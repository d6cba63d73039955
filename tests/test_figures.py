"""The pictures: the same bytes for everyone, nothing clipped, nothing on top of something else."""

import hashlib
import os
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from pseudorigid.figures.axes import box, limits, plane, projection
from pseudorigid.figures.canvas import save, sheet, style

VIEW = {"elevation": 40, "azimuth": 115}
SPACE = {
    "x": {"limits": [-0.2, 0.6], "ticks": [-0.2, 0, 0.2, 0.4]},
    "xdot": {"limits": [-0.4, 0.4], "ticks": [-0.4, -0.2, 0, 0.2, 0.4]},
    "udot": {"limits": [-0.2, 0.4], "ticks": [-0.1, 0.1, 0.3]},
}
FLAT = {
    "x": {"limits": [-0.05, 0.45], "ticks": [0, 0.2, 0.4]},
    "xdot": {"limits": [-0.1, 0.1], "ticks": [-0.05, 0.05]},
    "udot": {"limits": [-0.1, 0.25], "ticks": [-0.05, 0.05, 0.15]},
}
SCENES = {
    "portrait": {"axes": SPACE, "view": VIEW, "sea": [2]},
    "tangle": {"axes": SPACE, "view": VIEW, "type": "hyperbolic"},
    "motion": {
        "axes": {
            "t": {"limits": [0, 16], "ticks": [0, 2, 4, 6, 8, 10, 12, 14, 16]},
            "displacement": {"limits": [-0.4, 0.2], "ticks": [-0.4, -0.2, 0, 0.2]},
        }
    },
    "closeup": {
        "axes": {
            "x": {"limits": [0.21, 0.2116], "ticks": [0.21, 0.2116]},
            "xdot": {"limits": [0.0925, 0.0932], "ticks": [0.0925, 0.0932]},
        }
    },
    "exponents": {
        "axes": {
            "impact": {"limits": [0, 200000], "ticks": list(range(0, 200001, 20000))},
            "exponent": {"limits": [-0.3, 0.3], "ticks": [-0.2, -0.1, 0, 0.1, 0.2, 0.3]},
        }
    },
}
KINDS = list(SCENES)
ATTRS = {"k": 0.2, "g": 0.04, "energy": 0.01}


def states(count, seed):
    """States on the energy surface, from uniform numbers and square roots only."""
    k, g, energy = ATTRS["k"], ATTRS["g"], ATTRS["energy"]
    radius = np.sqrt(2 * energy + g * g / k)
    x, y = np.random.default_rng(seed).uniform(-0.7, 0.7, (2, count)) * radius
    s = np.sqrt((radius * radius - x * x - y * y) * (1 + k) / k)
    x, y = g / k + x / np.sqrt(k), y * np.sqrt(1 + k)
    return {"x": x, "xdot": (y + k * s) / (1 + k), "udot": (s - y) / (1 + k)}


def orbits(sizes=(300, 200, 900)):
    variables = {name: ("point", value) for name, value in states(sum(sizes), 1).items()}
    variables["row_size"] = ("orbit", np.array(sizes, dtype=np.int32))
    return xr.Dataset(variables, attrs=ATTRS)


def manifolds():
    state = states(400, 2)
    for name in state:
        state[name] = np.sort(state[name])
        state[name][100:103] = np.nan
    variables = {name: ("vertex", value) for name, value in state.items()}
    variables["row_size"] = ("branch", np.array([250, 150], dtype=np.int32))
    variables["stable"] = ("branch", np.array([0, 1], dtype=np.int8))
    return xr.Dataset(variables, attrs=ATTRS)


def periodic():
    state = states(12, 3)
    variables = {name: (("orbit", "point"), value.reshape(2, 6)) for name, value in state.items()}
    variables["type"] = ("orbit", ["elliptic", "hyperbolic"])
    return xr.Dataset(variables, attrs=ATTRS)


def window():
    along = np.linspace(0.2, 0.22, 500)
    wiggle = 0.0929 + (along - 0.211) * 0.4 + (along - 0.2105) * (along - 0.2115) * 90
    both = {"x": np.tile(along, 2), "xdot": np.concatenate([wiggle, 0.1858 - wiggle])}
    variables = {name: ("vertex", value) for name, value in both.items()}
    variables["row_size"] = ("branch", np.array([500, 500], dtype=np.int32))
    variables["stable"] = ("branch", np.array([0, 1], dtype=np.int8))
    return xr.Dataset(variables, attrs=ATTRS | {"point_x": 0.211, "point_xdot": 0.0929})


def motion(flights=5, length=3.1, samples=40):
    s = np.tile(np.linspace(0, 1, samples), flights)
    start = np.repeat(np.arange(flights), samples)
    x = 0.0212 - 0.19 * s * (1 - s)
    variables = {
        "t": ("sample", (start + s) * length),
        "position": ("sample", x),
        "strain": ("sample", -x - 1.2 * s * (1 - s)),
        "impact_t": ("impact", np.arange(flights + 1) * length),
        "impact_position": ("impact", np.full(flights + 1, 0.0212)),
    }
    return xr.Dataset(variables, attrs=ATTRS)


def exponents():
    impact = np.arange(1, 201) * 1000
    walk = np.random.default_rng(4).uniform(-1, 1, (200, 3)).cumsum(axis=0) / impact[:, None]
    history = np.stack([0.232 + walk, 0.5 / impact[:, None] + 0 * walk, -0.232 - walk], axis=2)
    variables = {"exponent": (("impact", "orbit", "index"), history)}
    return xr.Dataset(variables, coords={"impact": impact}, attrs=ATTRS)


DATA = {
    "portrait": lambda: (orbits(),),
    "tangle": lambda: (orbits(), manifolds(), periodic()),
    "motion": lambda: (motion(),),
    "closeup": lambda: (window(),),
    "exponents": lambda: (exponents(),),
}


def draw(kind):
    return import_module(f"pseudorigid.figures.{kind}").draw(SCENES[kind], *DATA[kind]())


def digests(folder):
    """Draw everything, in every format, and return a hash for each file."""
    found = {}
    for kind in KINDS:
        figure = draw(kind)
        for suffix in save.FORMATS:
            data = save.save(figure, Path(folder) / f"{kind}.{suffix}").read_bytes()
            found[f"{kind}.{suffix}"] = hashlib.sha256(data).hexdigest()
    return found


HOSTILE = """\
font.family: monospace
font.size: 30
axes.facecolor: red
savefig.dpi: 7
savefig.bbox: tight
savefig.facecolor: blue
svg.fonttype: none
svg.hashsalt: other
pdf.compression: 9
path.simplify: True
lines.antialiased: False
lines.scale_dashes: False
mathtext.fontset: cm
text.hinting: none
text.usetex: True
"""


def hostile(folder):
    """An environment with other settings, other fonts under our fonts' names, another locale."""
    from fontTools.ttLib import TTFont
    from matplotlib import get_data_path

    fonts = folder / ".fonts"
    fonts.mkdir()
    for number, family in enumerate(("DejaVu Sans", "STIXGeneral")):
        font = TTFont(Path(get_data_path()) / "fonts" / "ttf" / "cmss10.ttf")
        for record in font["name"].names:
            if record.nameID in (1, 16):
                record.string = family
        font.save(fonts / f"{number}.ttf")
    (folder / "matplotlibrc").write_text(HOSTILE)
    return {
        "HOME": str(folder),
        "XDG_DATA_HOME": str(folder),
        "MPLCONFIGDIR": str(folder),
        "MPLBACKEND": "svg",
        "LC_ALL": "C",
        "LANG": "tr_TR.UTF-8",
        "TZ": "Asia/Tokyo",
        "PYTHONHASHSEED": "77",
        "SOURCE_DATE_EPOCH": "1",
        "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL",
        "OPENBLAS_CORETYPE": "Prescott",
        "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX2,-FMA,-FMA4",
    }


def test_same_bytes_for_everyone(tmp_path):
    here = digests(tmp_path / "here")
    home = tmp_path / "a home"
    home.mkdir()
    tests = Path(__file__).parent
    environment = {**os.environ, **hostile(home)}
    environment["PYTHONPATH"] = os.pathsep.join([str(tests), str(tests.parent / "src")])
    run = subprocess.run(
        [sys.executable, "-c", "from test_figures import *; print(digests('there'))"],
        env=environment,
        cwd=home,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    assert run.stdout.strip() == str(here)
    assert digests(tmp_path / "again") == here


@pytest.mark.parametrize("kind", KINDS)
def test_a_last_bit_in_matplotlib_moves_no_pixel(kind, monkeypatch):
    from matplotlib import transforms

    before = save.pixels(draw(kind))
    exact = transforms.affine_transform
    random = np.random.default_rng(5)

    def noisy(values, matrix):
        result = exact(values, matrix)
        return result * (1 + 4e-16 * random.choice([-1, 0, 1], np.shape(result)))

    monkeypatch.setattr(transforms, "affine_transform", noisy)
    assert np.array_equal(save.pixels(draw(kind)), before)


@pytest.mark.parametrize("kind", KINDS)
def test_png_holds_exactly_the_pixels(kind, tmp_path):
    from PIL import Image

    figure = draw(kind)
    with Image.open(save.save(figure, tmp_path / "a.png")) as image:
        assert image.mode == "RGB"
        assert round(image.info["dpi"][0]) == style.DPI
        assert set(image.info) == {"dpi", "srgb"}
        assert np.array_equal(np.asarray(image), save.pixels(figure))


@pytest.mark.parametrize("kind", KINDS)
def test_text_is_whole_and_apart(kind):
    assert_text_is_whole_and_apart(draw(kind))


def lengths_scaled(data, scale):
    """The data with every length multiplied, times and exponents as they are."""
    names = {"x", "xdot", "udot", "position", "strain", "impact_position"} & set(data.variables)
    edges = {"window_x": [0.2101, 0.2116], "window_xdot": [0.0925, 0.0932]}
    edges = {name: [scale * edge for edge in ends] for name, ends in edges.items()}
    points = {name: scale * data.attrs[name] for name in data.attrs if name.startswith("point_")}
    changed = data.assign({name: scale * data[name] for name in names})
    return changed.assign_attrs(edges | points | {"g": scale * data.attrs["g"]})


@pytest.mark.parametrize("scale", [1.0, 2.0, 0.37, 0.1, 5000.0])
@pytest.mark.parametrize("kind", KINDS)
def test_a_picture_without_axes_has_those_of_its_data(kind, scale):
    scene = {key: value for key, value in SCENES[kind].items() if key != "axes"}
    scene |= {"duration": 15.5, "impacts": 200_000}
    data = [lengths_scaled(part, scale) for part in DATA[kind]()]
    figure = import_module(f"pseudorigid.figures.{kind}").draw(scene, *data)
    assert_text_is_whole_and_apart(figure)


def test_an_axis_that_a_scene_gives_is_kept():
    given = {"limits": [0, 8], "ticks": [0, 8]}
    scene = limits.complete({"axes": {"t": given}}, t=lambda: 1 / 0, x=lambda: "made")
    assert scene == {"axes": {"t": given, "x": "made"}}


def test_names_of_exponents_that_coincide_are_moved_apart():
    data = exponents()
    data["exponent"] *= 0.0
    picture = import_module("pseudorigid.figures.exponents")
    figure = picture.draw(SCENES["exponents"], data)
    assert_text_is_whole_and_apart(figure)
    texts = sorted(figure.texts, key=lambda text: -text.get_position()[1])
    names = [text.get_text() for text in texts if "lambda" in text.get_text()]
    assert names == [rf"$\lambda_{i}$" for i in (1, 2, 3)]


def assert_text_is_whole_and_apart(figure):
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    with style.pinned():
        renderer = FigureCanvasAgg(figure).get_renderer()
        boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in figure.texts]
    wide, high = figure.bbox.size
    for text, extent in boxes:
        assert min(extent.x0, extent.y0) >= 4, text
        assert extent.x1 <= wide - 4, text
        assert extent.y1 <= high - 4, text
    for place, (text, extent) in enumerate(boxes):
        for other, second in boxes[:place]:
            assert not extent.overlaps(second), (text, other)
    image = save.pixels(figure)
    for side in (image[:3], image[-3:], image[:, :3], image[:, -3:]):
        assert (side == 255).all()


@pytest.mark.parametrize("kind", KINDS)
def test_text_is_legible_at_a_columns_width(kind):
    figure = draw(kind)
    shrink = min(1, style.COLUMN / figure.bbox.width)
    assert min(text.get_size() for text in figure.texts) * shrink >= 7


@pytest.mark.parametrize("axes", [SPACE, FLAT])
@pytest.mark.parametrize("azimuth", [25, 115, 205, 295, 340])
def test_labels_of_a_box_fit_from_every_side(axes, azimuth, monkeypatch):
    scene = {"axes": axes, "view": {"elevation": 30, "azimuth": azimuth}, "sea": []}
    monkeypatch.setitem(SCENES, "portrait", scene)
    test_text_is_whole_and_apart("portrait")


def test_drawing_leaves_matplotlib_as_it_was():
    import matplotlib
    from matplotlib import font_manager

    fonts = font_manager.fontManager.ttflist
    with matplotlib.rc_context({"font.size": 31, "path.simplify": True}):
        before = dict(matplotlib.rcParams)
        save.pixels(draw("motion"))
        assert dict(matplotlib.rcParams) == before
    assert font_manager.fontManager.ttflist is fonts


def test_a_job_imports_only_what_it_uses():
    names = (
        "pyplot",
        "xarray",
        "pandas",
        "numba",
        "scipy",
        "netCDF4",
        "backend_pdf",
    )
    code = (
        "import sys\n"
        f"from pseudorigid.figures import {', '.join([*KINDS, 'save'])}\n"
        f"print([m for m in sys.modules for name in {names} if name in m.split('.')])"
    )
    source = str(Path(__file__).parent.parent / "src")
    run = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "PYTHONPATH": source},
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.stdout.strip() == "[]", run.stderr


@pytest.mark.parametrize("suffix", save.FORMATS)
def test_a_failing_save_leaves_the_old_picture_and_nothing_else(suffix, tmp_path, monkeypatch):
    figure = draw("motion")
    path = save.save(figure, tmp_path / f"a.{suffix}")
    before = path.read_bytes()

    def half(path, data):
        with open(path, "wb") as file:
            file.write(data[: len(data) // 2])
        raise OSError("disk full")

    monkeypatch.setattr(Path, "write_bytes", half)
    with pytest.raises(OSError, match="disk full"):
        save.save(figure, path)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_refuses_other_formats(tmp_path):
    with pytest.raises(ValueError, match="png, svg, pdf"):
        save.save(draw("motion"), tmp_path / "a.jpg")


def test_refuses_what_the_data_do_not_have():
    from pseudorigid.figures.kinds import portrait, tangle

    with pytest.raises(ValueError, match=r"sea \[7\]"):
        portrait.draw(SCENES["portrait"] | {"sea": [7]}, orbits())
    with pytest.raises(ValueError, match="no inverse hyperbolic orbit"):
        tangle.draw(SCENES["tangle"] | {"type": "inverse hyperbolic"}, *DATA["tangle"]())
    with pytest.raises(ValueError, match="elevation 90"):
        portrait.draw(SCENES["portrait"] | {"view": {"elevation": 90, "azimuth": 0}}, orbits())
    with pytest.raises(KeyError, match="udot"):
        portrait.draw(SCENES["portrait"], orbits().drop_vars("udot"))


def test_curves_of_a_motion_touch_at_the_impacts_and_never_cross():
    curves = [line.get_data() for line in draw("motion").artists if len(line.get_xdata()) > 20]
    (t, mass), (other_t, strain) = curves
    vertices = [set(zip(*(axis.tolist() for axis in curve), strict=True)) for curve in curves]
    assert len(vertices[0] & vertices[1]) == motion().sizes["impact"]
    seen = 1 / 32 / style.DPI  # two lines, each within 1/64 of a pixel of its samples
    assert (mass >= np.interp(t, other_t, strain) - seen).all()
    assert (np.interp(other_t, t, mass) >= strain - seen).all()


def test_every_point_is_drawn_and_the_sea_comes_first():
    data = orbits()
    dots = [line for line in draw("portrait").artists if line.get_marker() == "o"]
    assert sum(len(line.get_xdata()) for line in dots) == data.sizes["point"]
    colors = [line.get_color() for line in dots]
    full = colors[len(colors) // 2 :]
    assert full == [style.SEA, style.HUES[0], style.HUES[1]]
    assert colors[: len(colors) // 2] == [style.pale(color) for color in full]


def test_projection_is_orthographic_and_fits():
    limits = [span["limits"] for span in SPACE.values()]
    view = projection.Projection(limits, VIEW)
    frame = np.array([view.right, view.up, view.eye])
    assert np.allclose(frame @ frame.T, np.eye(3), atol=1e-15)
    across, up = view.place(10, 20, 300, 400)(*view.corners().T)
    assert across.min() >= 10 - 1e-9
    assert across.max() <= 310 + 1e-9
    assert up.min() >= 20 - 1e-9
    assert up.max() <= 420 + 1e-9


@pytest.mark.parametrize("degrees", [0, 30, 40, 90, 115, 180, 270, -65, 1e-3, 359.999, 12345.678])
def test_sine_and_cosine_of_the_view_are_correctly_rounded(degrees):
    mpmath = pytest.importorskip("mpmath")
    with mpmath.workdps(50):
        angle = mpmath.mpf(degrees) * mpmath.pi / 180
        exact = float(mpmath.sin(angle)), float(mpmath.cos(angle))
    assert projection.sincos_degrees(degrees) == pytest.approx(exact, rel=0, abs=1e-40)


def test_settled_pixels_keep_their_distance_from_every_threshold():
    pixels = sheet.settle(np.random.default_rng(6).uniform(0, 1500, 10000))
    for step in (1 / 256, 1 / 2, 1):
        part = pixels / step % 1
        assert np.minimum(part, 1 - part).min() * step >= 0.2 / 256
    points = pixels * 72 / style.DPI * 1e6
    assert np.abs(points % 1 - 0.5).min() > 0.1


@pytest.mark.parametrize(
    "value, power, text",
    [(0, 0, "0"), (-0.2, 0, "\N{MINUS SIGN}0.2"), (0.2116, 0, "0.2116"), (160000, 5, "1.6")],
)
def test_labels_of_ticks(value, power, text):
    assert style.number(value, power) == text


def test_large_ticks_share_a_power_of_ten():
    assert plane.thousands([0, 200000]) == 5
    assert plane.thousands([0, 16]) == 0


def test_what_lies_outside_the_box_is_not_drawn():
    small = box.Box(SCENES["portrait"] | {"axes": FLAT})
    before = len(small.figure.artists)
    x = np.array([0.0, 0.1, 0.9, 0.1, 0.0, 0.1])
    small.points(x, 0 * x, 0 * x, style.BLUE, 1)
    small.line(x, 0 * x, 0 * x, style.BLUE, 1)
    sizes = [len(artist.get_xdata()) for artist in small.figure.artists[before:]]
    assert sizes == [5, 2, 3]


def test_box_knows_the_far_side():
    seen = box.Box(SCENES["portrait"])
    x = np.array([0.2, 0.2])
    state = {"x": ("point", x), "xdot": ("point", [0.1, -0.1]), "udot": ("point", [0.0, 0.0])}
    towards = xr.Dataset(state, attrs=ATTRS)
    assert seen.facing(towards).tolist() == [True, False]
