"""The pictures behind the claims: each is made, the same again, and shows what its data say."""

import numpy as np
import pytest

from pseudorigid import Ball, lyapunov_spectrum
from pseudorigid.analyses import clusters, flux, jumps, last_curve, rotation, spread
from pseudorigid.dynamics import orbits
from pseudorigid.figures import kinds
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.render import pixels, render
from pseudorigid.figures.kinds import (
    clusters as clusters_kind,
)  # fmt: skip
from pseudorigid.figures.kinds import (
    flux as flux_kind,
)
from pseudorigid.figures.kinds import (
    jumps as jumps_kind,
)
from pseudorigid.figures.kinds import (
    last_curve as last_curve_kind,
)
from pseudorigid.figures.kinds import (
    rotation as rotation_kind,
)
from pseudorigid.figures.kinds import (
    spread as spread_kind,
)

BALL, ENERGY, SEA = Ball(0.2, 0.04), 0.01, (0.55, 0.68)
EDGE = (-0.2, -0.0325639)


def artifact(dataset):
    return dataset.assign_attrs(k=0.2, g=0.04, energy=ENERGY)


@pytest.fixture(scope="module")
def data():
    """For each kind its module and the datasets that it draws."""
    seven = lyapunov_spectrum(BALL, BALL.start(np.array([0.6, 0.62, 0.65]), ENERGY), 20_000, 4)
    portrait = orbits.scene_orbits(BALL, ENERGY, [-0.44, 0.142183, 0.534522], [200, 200, 800])
    nobles = [[0, 5, 1, 15], [0, 5, 1, 17]]
    found = {
        "spread": (
            spread_kind,
            spread.spread(BALL, ENERGY, 13, 400_000, 8, [-0.44, 0.142], 4096, 8, 64),
            seven,
        ),
        "clusters": (
            clusters_kind,
            clusters.clusters(BALL, ENERGY, SEA, 24, 1000, [4.0, 6.0], 3, 20, 1),
        ),
        "rotation": (
            rotation_kind,
            rotation.rotation(
                BALL, ENERGY, [0.001, 0.026, 0.03], 80, 1500, (-0.8344, -0.8341), 900
            ),
        ),
        "jumps": (jumps_kind, jumps.jumps(BALL, ENERGY, [0.0018, 0.001, 0.0025], 400), portrait),
        "flux": (flux_kind, flux.flux(BALL, ENERGY, 6, 2e-3, 50, SEA, 4, 50)),
        "last_curve": (
            last_curve_kind,
            last_curve.last_curve(BALL, ENERGY, 4, EDGE, 400, 400, nobles),
        ),
    }
    return {name: (row[0], *map(artifact, row[1:])) for name, row in found.items()}


NAMES = ("spread", "clusters", "rotation", "jumps", "flux", "last_curve")
SCENE = {"sea": [2], "energy": ENERGY, "ball": {"k": BALL.k, "g": BALL.g}}


def image(row):
    kind, *datasets = row
    return pixels(kind.draw(SCENE, *datasets))


@pytest.mark.parametrize("name", NAMES)
def test_the_same_data_make_the_same_bytes(data, name):
    kind, *datasets = data[name]
    first = kind.draw(SCENE, *datasets)
    for extension in ("png", "svg"):
        assert render(first, extension) == render(kind.draw(SCENE, *datasets), extension)


@pytest.mark.parametrize("name", NAMES)
def test_a_picture_has_a_column_s_width_and_is_not_empty(data, name):
    shown = image(data[name])
    assert shown.shape[1] == style.COLUMN
    ink = np.any(shown != 255, axis=2)
    assert 0.01 < ink.mean() < 0.6
    # nothing is cut off by the sheet's edge
    assert not ink[0].any() and not ink[-1].any() and not ink[:, 0].any() and not ink[:, -1].any()


CHANGES = {
    "spread": ("exponent", lambda v: v + 0.003),
    "clusters": ("dependence", lambda v: 0.5 * v),
    "rotation": ("rotation", lambda v: v + 2e-3),
    "jumps": ("y", lambda v: 0.9 * v),
    "flux": ("branch_x", lambda v: v + 0.001 * np.arange(v.shape[1]) / v.shape[1]),
    "last_curve": ("residue", lambda v: 3.0 * v),
}


@pytest.mark.parametrize("name", NAMES)
def test_other_data_make_another_picture(data, name):
    variable, change = CHANGES[name]
    kind, first, *rest = data[name]
    other = first.assign({variable: first[variable].copy(data=change(first[variable].values))})
    assert np.any(image(data[name]) != pixels(kind.draw(SCENE, other, *rest)))


def colored(shown, color):
    parts = [int(color[at : at + 2], 16) for at in (1, 3, 5)]
    return int(np.sum(np.all(shown == parts, axis=2)))


def test_jumps_are_drawn_only_where_there_are_any(data):
    kind, found, portrait = data["jumps"]
    with_curve = colored(image(data["jumps"]), jumps_kind.MAP)
    none = found.assign({name: np.nan * found[name] for name in ("x", "y")})
    without = colored(pixels(kind.draw(SCENE, none, portrait)), jumps_kind.MAP)
    assert without < 0.5 * with_curve  # what is left stands in the key
    assert without > 0


def test_every_kind_is_a_module_of_its_own():
    for name in NAMES:
        assert hasattr(getattr(kinds, name), "draw")


def texts(figure):
    return [text.get_text() for text in figure.texts]


def test_every_mark_is_in_a_key(data):
    named = {
        "flux": ("stable branch", "unstable branch", "crossing, and its lobe's area"),
        "rotation": ("regular", "chaotic", "fixed point", "islands"),
        "jumps": ("regular orbits", "chaotic orbit"),
        "spread": ("thin: range, thick: quartiles, dot: mean",),
    }
    for name, words in named.items():
        kind, *datasets = data[name]
        assert set(words) <= set(texts(kind.draw(SCENE, *datasets)))


def test_an_orbit_has_no_rotation_number_in_the_key(data):
    kind, last = data["last_curve"]
    said = texts(kind.draw(SCENE, last))
    assert not [text for text in said if "rotation number" in text]
    for number, periods in zip(last["rotation"].values, last["period"].values, strict=True):
        assert f"convergents of {number:.6f}" in said
        assert f"orbit from period {periods[-1]:.0f}" in said


def test_eight_energies_have_eight_hues(data):
    kind, few = data["rotation"]
    many = few.isel(energy=[0, 1, 2, 3, 0, 1, 2, 3])
    energies = [0.001, 0.005, 0.01, 0.015, 0.02, 0.026, 0.028, 0.03]
    figure = kind.draw(SCENE, many.assign(energy=("energy", energies)))
    inks = {line.get_color() for line in figure.artists if line.get_linewidth() == 1.0}
    assert len(inks) == 8
    assert not [line for line in figure.artists if line.get_linestyle() == "--"]


def test_plateaus_names_lie_within_their_panel(data, monkeypatch):
    kind, found = data["rotation"]
    place, turns = (found[f"detail_{name}"].values for name in ("place", "rotation"))
    last = int(np.argmax(place))
    highest = round(1e5 * turns[last]), 100_000, place[last - 1], place[last]
    monkeypatch.setattr(kind, "plateaus", lambda *_: [highest])
    figure = kind.draw(SCENE, found)
    with style.pinned():
        names = [text for text in figure.texts if "/100000" in text.get_text()]
        boxes = [text.get_window_extent() for text in names]
    assert boxes and all(box.y0 > 715 and box.y1 < 1065 and box.x1 < 1005 for box in boxes)
