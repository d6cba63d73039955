"""The control experiment: closed formulas of its maps, areas, reversors, spirals and classes."""

import math

import numpy as np
import pytest

from extensions.atlas.cell import wilson
from extensions.claims.analyses import control, perturbed_map
from extensions.claims.analyses.perturbed_map import MAPS, apply, change
from pseudorigid import Ball
from pseudorigid.kernel.verdict import GROWTH_THRESHOLD

BALL, ENERGY, EPS = Ball(0.2, 0.04), 0.01, 0.1
CHANGES = sorted({(form, keeps) for form, keeps, _ in MAPS.values()})


def disk(count, inside=0.99):
    """Complex points of the unit disk, some of them on its rim."""
    number = np.arange(count)
    radius = np.sqrt((number + 0.5) / count) * inside
    angle = 2.399963229728653 * number
    rim = np.exp(1j * angle[: count // 8])
    return np.concatenate([radius * np.exp(1j * angle), rim])


def twist(z, centre, turn):
    """A, in complex numbers and as its docstring has it."""
    t = turn * np.maximum(1.0 - np.abs(z - centre) ** 2 / 0.75**2, 0.0) ** 6
    return centre + (z - centre) * (1.0 + 1j * t) / (1.0 - 1j * t)


def moebius(z, c):
    """M, in complex numbers and as its docstring has it."""
    return (z + c) / (1.0 + np.conj(c) * z)


def formula(form, keeps, z, eps=EPS, inverse=False):
    """T or its inverse, in complex numbers and as the docstring has it."""
    if form == "shift":
        return moebius(z, (-1 if inverse else 1) * eps * (3 + 4j) / 5)
    twists = {
        "twist": [((-4 + 3j) / 20, 4.0)],
        "stir": [((-4 - 3j) / 20, -2.0), ((-3 + 4j) / 20, 2.0)],
    }[form]
    frame = 0.0 if keeps else (-3 + 4j) / 10
    z = moebius(z, frame)
    for centre, turn in twists[::-1] if inverse else twists:
        z = twist(z, centre, (-turn if inverse else turn) * eps)
    return moebius(z, -frame)


def applied(form, keeps, z, eps=EPS, mirrored=False):
    """The images and Jacobians that the compiled code gives."""
    out = np.array([apply(change(form, keeps, eps, mirrored), p.real, p.imag) for p in z])
    return out[:, 0] + 1j * out[:, 1], out[:, 2:].T.reshape(2, 2, -1)


def determinant(matrix):
    return matrix[0, 0] * matrix[1, 1] - matrix[0, 1] * matrix[1, 0]


@pytest.mark.parametrize(("form", "keeps"), CHANGES)
def test_changes_and_their_jacobians_are_those_of_the_formulas(form, keeps):
    """At strength 0 they are the identity, to the bit."""
    z = disk(400)
    image, jacobian = applied(form, keeps, z)
    assert np.max(np.abs(image - formula(form, keeps, z))) < 1e-14
    assert 0.5 * EPS < np.max(np.abs(image - z)) < 2.0 * EPS
    inside, step = np.abs(z) < 0.995, 1e-5
    ends = [
        [formula(form, keeps, z[inside] + sign * d) for sign in (1, -1)] for d in (step, 1j * step)
    ]
    numeric = np.array([(ahead - behind) / (2.0 * step) for ahead, behind in ends])
    numeric = np.array([numeric.real, numeric.imag])
    assert np.max(np.abs(jacobian[:, :, inside] - numeric)) < 1e-7
    assert (np.max(np.abs(determinant(jacobian) - 1.0)) < 1e-12) == keeps
    image, jacobian = applied(form, keeps, z, 0.0)
    assert np.array_equal(image, z)
    assert np.array_equal(jacobian, np.broadcast_to(np.eye(2)[:, :, None], jacobian.shape))


@pytest.mark.parametrize(("form", "keeps"), CHANGES)
def test_changes_map_the_disk_onto_itself_and_have_no_symmetry(form, keeps):
    z = disk(400)
    image, inverse = (formula(form, keeps, z, inverse=back) for back in (False, True))
    rim = np.abs(np.abs(z) - 1.0) < 1e-12
    for radius in (np.abs(image), np.abs(inverse)):
        assert np.all(radius <= 1.0 + 1e-12) and np.all(np.abs(radius[rim] - 1.0) < 1e-12)
    assert np.max(np.abs(formula(form, keeps, image, inverse=True) - z)) < 1e-13
    # R T R is neither T nor its inverse
    mirrored, other = (np.conj(formula(form, keeps, np.conj(z), inverse=b)) for b in (False, True))
    assert min(np.max(np.abs(mirrored - f)) for f in (image, inverse)) > 0.1 * EPS
    assert np.max(np.abs(applied(form, keeps, z, mirrored=True)[0] - other)) < 1e-13


def points(count=200):
    z = disk(count, 0.9)[:count]
    return np.stack([z.real, z.imag])


def reversor_error(perturbed):
    """Median distance of R F R F from the identity."""
    image = points()
    for _ in range(2):
        image = perturbed.images(image)
        image[1] = -image[1]
    return float(np.median(np.hypot(*(image - points()))))


@pytest.mark.parametrize("name", MAPS)
def test_maps_keep_what_they_say(name):
    perturbed = perturbed_map.perturbed_map(BALL, ENERGY, name, EPS)
    error, least = reversor_error(perturbed), control._reversor_defect(perturbed)
    _, keeps_area, reversible = MAPS[name]
    if reversible:
        assert max(error, least) < 1e-13
    else:
        assert error > 0.03 * EPS and least > 0.1 * EPS
    grown, area, _ = control._growths(perturbed, points(), [64])
    assert np.isfinite(grown).all() and (np.max(np.abs(area)) < 1e-12) == keeps_area


@pytest.mark.parametrize("name", MAPS)
def test_a_perturbed_map_is_t_after_p_after_its_mirror(name):
    """Against Ball.impact and the formulas in complex numbers."""
    a, b = points()
    z = a + 1j * b
    form, keeps, reversible = MAPS[name]
    if reversible:
        z = np.conj(formula(form, keeps, np.conj(z), inverse=True))
    centre, radius = BALL.section(ENERGY)
    high = math.sqrt(BALL.k * (1.0 + BALL.k)) * radius
    state = BALL.state_xy(centre + radius * z.real, high * z.imag, ENERGY)
    x, v, w, _ = BALL.impact(*state)
    z = formula(form, keeps, (x - centre) / radius + 1j * (v - BALL.k * w) / high)
    image = perturbed_map.perturbed_map(BALL, ENERGY, name, EPS).images(points())
    # a flight near a jump of the map turns a rounding into another impact
    assert np.quantile(np.abs(image[0] + 1j * image[1] - z), 0.95) < 1e-11


def test_an_orbit_is_chaotic_or_a_spiral_or_regular():
    low, high = 0.9 * GROWTH_THRESHOLD, 1.1 * GROWTH_THRESHOLD
    grown = np.array([low, -5.0, low, low, high, high, math.nan])
    area = np.array([0.0, low, high, -high, 0.0, -high, 0.0])
    assert control.classes(grown, area).tolist() == [0, 0, 1, 1, 2, 2, 2]
    for count in (0, 17, 500):
        assert control._wilson(count, 500) == pytest.approx(wilson(count, 500), abs=1e-12)


@pytest.fixture(scope="module")
def controlled():
    """A small control experiment."""
    return control.control(BALL, ENERGY, [0.03], 150, 4000, [0.1], 0.03, 20)


@pytest.mark.parametrize("name", MAPS)
def test_regular_orbits_remain_if_a_property_is_kept(controlled, name):
    _, keeps_area, reversible = MAPS[name]
    share = controlled["class_share"].isel(length=-1)
    assert np.max(np.abs(share.sum("class").values - 1.0)) < 1e-12
    regular = share.sel({"class": "regular"})
    itself, changed = float(regular[0, 0]), float(regular.sel(map=name, strength=0.03))
    assert (changed > 0.8 * itself) if keeps_area or reversible else (changed < 0.2 * itself)
    # with the reversor all regular orbits are on curves around symmetric points
    symmetric = float(controlled["symmetric"].sel(map=name, strength=0.03))
    assert symmetric == pytest.approx(changed, abs=0.01) if reversible else math.isnan(symmetric)


def test_areas_along_chaotic_orbits_wander_only_if_no_area_is_kept(controlled):
    wander = controlled["wander"].sel(strength=0.03)
    assert np.all(wander.sel(map=["twist area", "stir both"]).values < 1e-12)
    assert np.all(wander.sel(map=["twist reversor", "stir reversor"]).values[:, -1] > 0.01)
