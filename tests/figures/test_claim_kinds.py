"""The pictures behind the claims: each is reproducible and shows its data."""

import numpy as np
import pytest
from samples import module

from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.render import pixels, render

SCENE = {"sea": [8], "energy": 0.01, "ball": {"k": 0.2, "g": 0.04}}
# For each kind a variable of its first dataset, and a change of it that must show.
CHANGES = {
    "spread": ("exponent", lambda v: v + 0.003),
    "clusters": ("dependence", lambda v: 0.5 * v),
    "rotation": ("rotation", lambda v: v + 2e-3),
    "jumps": ("y", lambda v: 0.9 * v),
    "flux": ("branch_x", lambda v: v + 0.001 * np.arange(v.shape[1]) / v.shape[1]),
    "last_curve": ("residue", lambda v: 3.0 * v),
    "control": ("class_share", lambda v: 0.5 * v),
}
KINDS = list(CHANGES)


@pytest.fixture(scope="module")
def data(datasets):
    """The datasets that each kind draws."""
    others = {"spread": ["fig7/lyapunov"], "jumps": ["fig2/orbits"]}
    return {
        kind: [datasets[name] for name in (f"{kind}/{kind}", *others.get(kind, []))]
        for kind in KINDS
    }


def draw(name, datasets):
    return module(name).draw(SCENE, *datasets)


def texts(name, datasets):
    return [text.get_text() for text in draw(name, datasets).texts]


@pytest.mark.parametrize("name", KINDS)
def test_a_picture_is_reproducible_and_fits_a_column(data, name):
    first = draw(name, data[name])
    for extension in ("png", "svg"):
        assert render(first, extension) == render(draw(name, data[name]), extension)
    image = pixels(first)
    assert image.shape[1] == style.COLUMN
    ink = np.any(image != 255, axis=2)
    assert 0.01 < ink.mean() < 0.6
    for side in (ink[0], ink[-1], ink[:, 0], ink[:, -1]):  # the sheet cuts nothing off
        assert not side.any()
    variable, change = CHANGES[name]
    dataset, *rest = data[name]
    other = dataset.assign(
        {variable: dataset[variable].copy(data=change(dataset[variable].values))}
    )
    assert np.any(image != pixels(draw(name, [other, *rest])))


def test_jumps_are_drawn_only_if_there_are_any(data):
    def count(datasets):
        color = bytes.fromhex(module("jumps").MAP[1:])
        return np.sum(np.all(pixels(draw("jumps", datasets)) == [*color], axis=2))

    curves, portrait = data["jumps"]
    none = curves.assign({name: np.nan * curves[name] for name in ("x", "y")})
    assert 0 < count([none, portrait]) < 0.5 * count(data["jumps"])  # the key's remain


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("flux", {"stable branch", "unstable branch", "crossing, and its lobe's area"}),
        ("rotation", {"regular", "chaotic", "fixed point", "islands"}),
        ("jumps", {"regular orbits", "chaotic orbit"}),
        ("spread", {"thin: range, thick: quartiles, dot: mean"}),
    ],
)
def test_every_mark_is_in_a_key(data, name, words):
    assert words <= set(texts(name, data[name]))


def test_the_key_of_orbits_has_periods_and_no_rotation_numbers(data):
    said = texts("last_curve", data["last_curve"])
    assert not [text for text in said if "rotation number" in text]
    (last,) = data["last_curve"]
    for number, periods in zip(last["rotation"].values, last["period"].values, strict=True):
        assert f"convergents of {number:.6f}" in said
        assert f"orbit from period {periods[-1]:.0f}" in said


def test_eight_energies_have_eight_hues(data):
    many = data["rotation"][0].isel(energy=[0, 1] * 4)
    energies = [0.001, 0.005, 0.01, 0.015, 0.02, 0.026, 0.028, 0.03]
    figure = draw("rotation", [many.assign(energy=("energy", energies))])
    inks = {line.get_color() for line in figure.artists if line.get_linewidth() == 1.0}
    assert len(inks) == 8
    assert not [line for line in figure.artists if line.get_linestyle() == "--"]


def test_names_of_plateaus_lie_within_their_panel(data, monkeypatch):
    (found,) = data["rotation"]
    place, turns = (found[f"detail_{name}"].values for name in ("place", "rotation"))
    last = int(np.argmax(place))
    highest = round(1e5 * turns[last]), 100_000, place[last - 1], place[last]
    monkeypatch.setattr(module("rotation"), "plateaus", lambda *_: [highest])
    figure = draw("rotation", data["rotation"])
    with style.pinned():
        names = [text for text in figure.texts if "/100000" in text.get_text()]
        boxes = [text.get_window_extent() for text in names]
    assert boxes and all(box.y0 > 715 and box.y1 < 1065 and box.x1 < 1005 for box in boxes)
