"""Perturbed maps: their closed formulas, areas, reversors, spirals and classes."""

import math

import numpy as np
import pytest

from pseudorigid import Ball
from pseudorigid.analyses import control, perturbed_map
from pseudorigid.analyses.perturbed_map import MAPS, apply, change
from pseudorigid.analyses.regularity import GROWTH_THRESHOLD, regular
from pseudorigid.analyses.rotation import winding
from pseudorigid.sweep.cell import wilson

BALL, ENERGY, EPS = Ball(0.2, 0.04), 0.01, 0.1
CHANGES = ["twist", "Moebius", "squeeze"]


def disk(count, inside=0.99):
    """Complex points of the unit disk, some of them on its rim."""
    number = np.arange(count)
    radius = np.sqrt((number + 0.5) / count) * inside
    angle = 2.399963229728653 * number
    rim = np.exp(1j * angle[: count // 8])
    return np.concatenate([radius * np.exp(1j * angle), rim])


def twist(z, eps, centre=0.25j):
    """A, in complex numbers and as its docstring has it."""
    t = 4.0 * eps * np.maximum(1.0 - np.abs(z - centre) ** 2 / 0.75**2, 0.0) ** 6
    return centre + (z - centre) * (1.0 + 1j * t) / (1.0 - 1j * t)


def moebius(z, eps, direction=0.6 + 0.8j):
    """M, in complex numbers and as its docstring has it."""
    c = eps * direction
    return (z + c) / (1.0 + np.conj(c) * z)


def squeeze(z, eps):
    """D, in complex numbers and as its docstring has it."""
    return z.real + 1j * (1.0 - eps) * z.imag


FORMULAS = {"twist": twist, "Moebius": moebius, "squeeze": squeeze}
INVERSES = {"twist": lambda z, eps: twist(z, -eps), "Moebius": lambda z, eps: moebius(z, -eps)}


def derivatives(function, z, step=1e-5):
    """The Jacobian (2, 2, n) of a function of the plane by central differences."""
    columns = [(function(z + d) - function(z - d)) / (2.0 * step) for d in (step, 1j * step)]
    return np.array([[c.real for c in columns], [c.imag for c in columns]])


def applied(name, z, eps=EPS):
    """The images and Jacobians that the compiled code gives."""
    out = np.array([apply(change(name, eps), p.real, p.imag) for p in z])
    return out[:, 0] + 1j * out[:, 1], out[:, 2:].T.reshape(2, 2, -1)


def determinant(matrix):
    return matrix[0, 0] * matrix[1, 1] - matrix[0, 1] * matrix[1, 0]


def keeps_disk(function, z):
    """Whether points of the disk stay in it, and points of the rim on the rim."""
    image = np.abs(function(z))
    rim = np.abs(np.abs(z) - 1.0) < 1e-12
    return bool(np.all(image <= 1.0 + 1e-12) and np.all(np.abs(image[rim] - 1.0) < 1e-12))


def has_no_symmetry(function, inverse, z):
    """Whether R T R is neither T nor its inverse, by a tenth of the strength somewhere."""
    mirrored = np.conj(function(np.conj(z)))
    return all(np.max(np.abs(mirrored - f(z))) > 0.1 * EPS for f in (function, inverse))


@pytest.mark.parametrize("name", CHANGES)
def test_changes_are_their_formulas_and_start_from_the_identity(name):
    z = disk(400)
    image, jacobian = applied(name, z)
    assert np.max(np.abs(image - FORMULAS[name](z, EPS))) < 1e-14
    inside = np.abs(z) < 0.995
    numeric = derivatives(lambda p: FORMULAS[name](p, EPS), z[inside])
    assert np.max(np.abs(jacobian[:, :, inside] - numeric)) < 1e-8
    image, jacobian = applied(name, z, 0.0)
    assert np.array_equal(image, z) or np.max(np.abs(image - z)) < 1e-15
    assert np.max(np.abs(jacobian - np.eye(2)[:, :, None])) < 1e-15


@pytest.mark.parametrize("name", ["twist", "Moebius"])
def test_changes_map_the_disk_onto_itself_and_have_no_symmetry(name):
    z = disk(400)
    function, inverse = (lambda p, f=f: f[name](p, EPS) for f in (FORMULAS, INVERSES))
    assert keeps_disk(function, z) and keeps_disk(inverse, z)
    assert np.max(np.abs(inverse(function(z)) - z)) < 1e-14
    assert has_no_symmetry(function, inverse, z)
    mirrored = np.conj(INVERSES[name](np.conj(z), EPS))
    assert np.max(np.abs(applied(f"mirrored {name}", z)[0] - mirrored)) < 1e-14


def points(count=200):
    z = disk(count, 0.9)[:count]
    return np.stack([z.real, z.imag])


def reversor_error(perturbed):
    """Median distance of R F R F from the identity."""
    image = points()
    for _ in range(2):
        image = control.images(perturbed, image)
        image[1] = -image[1]
    return float(np.median(np.hypot(*(image - points()))))


@pytest.mark.parametrize("name", MAPS)
def test_maps_keep_what_they_say(name):
    perturbed = perturbed_map.perturbed_map(BALL, ENERGY, name, EPS)
    error, least = reversor_error(perturbed), control._defect(perturbed)
    if name in ("both", "reversor"):
        assert max(error, least) < 1e-13
    else:
        assert min(error, least) > 0.1 * EPS
    grown, area = control._growths(perturbed, points(), [64])
    assert np.isfinite(grown).all()
    assert (np.max(np.abs(area)) < 1e-12) == (name in ("both", "area"))


@pytest.mark.parametrize("name", MAPS)
def test_a_perturbed_map_is_t_after_p_after_its_mirror(name):
    """Against Ball.impact and the formulas in complex numbers."""
    a, b = points()
    z = a + 1j * b
    before, after = MAPS[name]
    if before:
        z = np.conj(INVERSES[after](np.conj(z), EPS))
    centre, radius = BALL.section(ENERGY)
    high = math.sqrt(BALL.k * (1.0 + BALL.k)) * radius
    state = BALL.state_xy(centre + radius * z.real, high * z.imag, ENERGY)
    x, v, w, _ = BALL.impact(*state)
    z = FORMULAS[after]((x - centre) / radius + 1j * (v - BALL.k * w) / high, EPS)
    image = control.images(perturbed_map.perturbed_map(BALL, ENERGY, name, EPS), points())
    # a flight near a jump of the map turns a rounding into another impact
    assert np.quantile(np.abs(image[0] + 1j * image[1] - z), 0.95) < 1e-11


@pytest.mark.parametrize("name", MAPS)
def test_jacobians_are_those_of_differences_and_areas_their_determinants(name):
    perturbed = perturbed_map.perturbed_map(BALL, ENERGY, name, EPS)
    step, at = 1e-6, np.array([[-0.5], [0.3]])
    _, jacobian = control._jacobian(perturbed, at, 2)
    moved = at + step * np.array([[1.0, -1.0, 0.0, 0.0], [0.0, 0.0, 1.0, -1.0]])
    image = control.images(perturbed, moved, 2)
    assert np.max(np.abs((image[:, ::2] - image[:, 1::2]) / (2 * step) - jacobian)) < 1e-7
    out = np.empty((2, 1, 2))
    windows, sums = np.array([[1, 1]]), np.zeros((2, 1, 1))
    rows = control._begin(at)
    perturbed_map.propagate(rows, *perturbed, 2, windows, *sums, out)
    assert sums[1, 0, 0] == pytest.approx(math.log(determinant(jacobian)), abs=1e-12)
    assert np.array_equal(out[:, :, -1], control.images(perturbed, at, 2))


def test_without_a_change_classes_are_those_of_the_rotation_numbers_stage():
    place = np.linspace(-0.9, 0.9, 60)
    _, exponent = winding(BALL, ENERGY, place, 2000)
    perturbed = perturbed_map.perturbed_map(BALL, ENERGY, "area", 0.0)
    grown, area = control._growths(perturbed, np.stack([place, 0.0 * place]), [2000])
    assert np.mean((control.classes(grown, area)[0] == 0) == regular(exponent, 2000)) > 0.98
    assert not area.any()


def test_an_orbit_is_chaotic_or_a_spiral_or_regular():
    low, high = 0.9 * GROWTH_THRESHOLD, 1.1 * GROWTH_THRESHOLD
    grown = np.array([low, -5.0, low, low, high, high, math.nan])
    area = np.array([0.0, low, high, -high, 0.0, -high, 0.0])
    assert control.classes(grown, area).tolist() == [0, 0, 1, 1, 2, 2, 2]
    for count in (0, 17, 500):
        assert control._wilson(count, 500) == pytest.approx(wilson(count, 500), abs=1e-12)


def test_what_becomes_of_the_islands():
    data = control.control(BALL, ENERGY, [0.003, 0.03], 150, 1600, 6, [0.1], 0.03, 20, 40, 1)
    share = data["class_share"].isel(length=-1)
    assert np.max(np.abs(share.sum("class").values - 1.0)) < 1e-12
    kept = share.sel({"class": "regular"})
    itself = float(kept[0, 0])
    for name in ("both", "area", "reversor"):
        assert np.all(kept.sel(map=name).values > 0.8 * itself)
    assert np.all(kept.sel(map=["neither", "damped"], strength=0.03).values == 0.0)
    # the fixed point attracts or repels as the determinants say, and not if one property is kept
    rate = data["rate"].values
    linear = np.log(data["island_determinant"].values) / (2.0 * data["island"].values)
    found = np.isfinite(rate)
    assert found[:, :, 0].all() and np.array_equal(found, np.isfinite(linear) & found)
    assert np.max(np.abs(rate - linear)[found]) < 2e-4
    alone = [list(MAPS).index(name) for name in ("both", "area", "reversor")]
    assert np.nanmax(np.abs(linear[alone])) < 1e-9
    assert np.all(linear[3, 1:, 0] > 0.0)
    assert linear[4, 1:, 0] == pytest.approx(0.5 * np.log(1.0 - np.array([0.003, 0.03])))
    assert float(data["attraction"].sel(map="reversor", strength=0.03)) < -0.1
    assert np.array_equal(data["kind"].values[:, 0], [0, 0, 0, 0, 2, 1])
