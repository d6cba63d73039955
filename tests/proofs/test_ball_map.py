"""The ball map: roots against a scan, identities, jets, and what happens when it is broken."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest
from flint import arb, ctx
from independent_solver import exact_map

from pseudorigid import Ball
from pseudorigid.proofs import THEOREMS, Surface
from pseudorigid.proofs.enclosure import flight, surface
from pseudorigid.proofs.enclosure.flight import Gap, UndecidedError, first_root
from pseudorigid.proofs.enclosure.jets import Jet, algebra

PAPER = Surface("1/5", "1/25", "1/100")
BALL = Ball(k=0.2, g=0.04)
BY_HAND = ("diffeomorphism", "one-fixed-point")  # theorems that use no flight


def points(count, energy=0.01, seed=5):
    """Points (x, y) uniform on the section."""
    random = np.random.default_rng(seed)
    centre, radius = BALL.section(energy)
    angle, size = random.uniform(0, 2 * np.pi, count), np.sqrt(random.uniform(0, 0.999, count))
    width = radius * np.sqrt(BALL.k * (1 + BALL.k))
    return np.column_stack([centre + radius * size * np.cos(angle), width * size * np.sin(angle)])


def test_the_first_root_is_that_of_a_brute_force_scan():
    times = np.linspace(0.0, 40.0, 20_001)[1:]
    waves = np.sin(times) - times, 1.0 - np.cos(times)
    for x, y in points(1500):
        tau = PAPER.impact(arb(x), arb(y)).tau
        _, v, w = BALL.state_xy(x, y, 0.01)
        s, c = v + w, -(y + v + w) / 1.2
        gap = times * (0.02 * times - s) + c * waves[0] + x * waves[1]
        later = times[gap > 0.0]
        assert tau.rad() < 1e-7
        assert later[0] - 0.002 - 1e-7 < float(tau) < later[0] + 1e-7


def test_the_determinant_encloses_one():
    for x, y in points(300):
        (a, b), (c, d) = PAPER.jacobian(arb(x, 1e-7), arb(y, 1e-7))[0]
        assert (a * d - b * c).contains(1)


def test_the_reversor_undoes_the_map():
    with ctx.workprec(128):
        for x, y in points(300):
            there = PAPER.impact(arb(x), arb(y))
            back = PAPER.impact(there.x, -there.y)
            assert back.x.contains(x)
            assert (-back.y).contains(y)
            assert back.x.rad() < arb(2) ** -80


def test_a_box_encloses_what_its_points_do():
    random = np.random.default_rng(8)
    for x, y in points(40):
        try:
            rows, image = PAPER.jacobian(arb(x, 1e-4), arb(y, 1e-4))
        except UndecidedError:
            continue
        for dx, dy in random.uniform(-1e-4, 1e-4, (5, 2)):
            inner, point = PAPER.jacobian(arb(x + dx), arb(y + dy))
            assert all(whole.contains(part) for whole, part in zip(image, point, strict=True))
            for wide, thin in zip(rows, inner, strict=True):
                assert all(a.contains(b) for a, b in zip(wide, thin, strict=True))


def test_an_independent_map_of_60_digits_lies_in_the_balls():
    with ctx.workprec(160), mpmath.workdps(60):
        for x, y in points(20):
            v, w = (mpmath.mpf(a.str(50, radius=False)) for a in PAPER.velocities(arb(x), arb(y)))
            image = PAPER.impact(arb(x), arb(y))
            k, g = mpmath.mpf(1) / 5, mpmath.mpf(1) / 25
            x1, v1, w1, tau = exact_map(k, g, mpmath.mpf(x), v, w)
            for ours, true in ((image.x, x1), (image.y, v1 - k * w1), (image.tau, tau)):
                assert abs(float(arb(mpmath.nstr(true, 50)) - ours)) < 1e-40


def test_jets_have_the_coefficients_of_finite_differences():
    plane = algebra(2, 3)
    with ctx.workprec(400):
        h = arb(2) ** -60
        x0, y0 = arb("0.1"), arb("0.05")
        jet = PAPER.impact(Jet.variable(plane, 0, x0), Jet.variable(plane, 1, y0))
        at = {
            (i, j): PAPER.impact(x0 + i * h, y0 + j * h) for i in range(-2, 3) for j in range(-2, 3)
        }
        for part in range(4):
            f = {key: image[part] for key, image in at.items()}
            third = (f[2, 0] - 2 * f[1, 0] + 2 * f[-1, 0] - f[-2, 0]) / (2 * h**3) / 6
            mixed = (
                (f[1, 1] - 2 * f[0, 1] + f[-1, 1] - f[1, -1] + 2 * f[0, -1] - f[-1, -1])
                / (2 * h**3)
                / 2
            )
            assert abs(float(jet[part][3, 0] - third)) < 1e-30 * (1 + abs(float(third)))
            assert abs(float(jet[part][2, 1] - mixed)) < 1e-30 * (1 + abs(float(mixed)))


def test_a_flight_that_may_touch_is_not_decided():
    # from a point of the jump set, to twenty digits: the touch cannot be told from a miss
    x, y = arb("0.150034356069120683526702038728"), arb("-0.144621563013173987118939871049")
    with ctx.workprec(60), pytest.raises(UndecidedError, match="touch"):
        PAPER.impact(+x, +y)


def test_a_point_off_the_section_is_not_decided():
    with pytest.raises(UndecidedError, match="rim"):
        PAPER.impact(arb("0.6"), arb(0))


@pytest.mark.parametrize("value", ["1/x", "", "1/0", "nan", "1e99999", None, True, [1], "0x1p3"])
def test_what_is_no_exact_number_is_refused(value):
    with pytest.raises(ValueError, match=r"k = .* is not an exact number") as error:
        Surface(value, "1/25", "1/100")
    assert "\n" not in str(error.value)


def test_a_float_is_refused():
    with pytest.raises(ValueError, match=r"k = 0.2 is a rounded number: give .* '0.2'"):
        Surface(0.2, "1/25", "1/100")


@pytest.mark.parametrize(
    ("numbers", "what"),
    [(("0", "1", "1"), "k = 0"), (("6/5", "1", "1"), "k = 6/5"), (("1/5", "0", "1"), "g = 0"),
     (("1/5", "1/25", "-1/250"), "energy = -1/250")],
)  # fmt: skip
def test_numbers_out_of_range_are_refused(numbers, what):
    with pytest.raises(ValueError, match=what):
        Surface(*numbers)


def test_constants_are_as_narrow_as_the_precision():
    for bits in (64, 300, 64):
        with ctx.workprec(bits):
            k, g, _ = PAPER.constants()
            assert (5 * k).contains(1)
            assert (25 * g).contains(1)
            assert k.rad() < arb(2) ** (2 - bits)


def proved(names):
    return [name for name in names if THEOREMS[name].check().verdict == "proved"]


def test_proofs_refuse_a_map_that_skips_a_root(monkeypatch):
    march = flight._march

    def skipping(gap, after):
        _, high = march(gap, after)
        shifted = Gap(gap.x, gap.c, gap.s, gap.g)
        t = high
        for _ in range(4000):
            t = t + 0.01
            if shifted.height(t) < 0:
                return march(shifted, t.mid())
        raise UndecidedError("no other root")

    monkeypatch.setattr(flight, "_march", skipping)
    names = [name for name in THEOREMS if name not in BY_HAND]
    assert proved(names) == []


def test_proofs_refuse_a_rounded_constant(monkeypatch):
    true = Surface.constants

    def rounded(self):
        k, g, energy = true(self)
        return k, g + arb(2) ** -80, energy

    monkeypatch.setattr(Surface, "constants", rounded)
    names = [n for n in THEOREMS if n not in BY_HAND and not n.startswith("horseshoe")]
    assert proved(names) == []


def test_horseshoes_refuse_a_gravity_that_is_a_little_off(monkeypatch):
    true = Surface.constants

    def heavier(self):
        k, g, energy = true(self)
        return k, g * arb("1.0001"), energy

    monkeypatch.setattr(Surface, "constants", heavier)
    assert proved(["horseshoe-outer", "horseshoe-inner"]) == []


def test_proofs_refuse_a_sine_without_its_error(monkeypatch):
    true = Gap.height
    monkeypatch.setattr(Gap, "height", lambda self, t: true(self, t) + arb(2) ** -50)
    assert proved(["fixed-point", "six-hyperbolic", "twist-six", "twist-zero", "jump-set"]) == []


def test_a_band_of_energies_contains_each_of_its_maps():
    band = Surface("1/5", "1/25", "1/100", Fraction(1, 1000))
    wide = band.impact(arb("0.1"), arb("0.05"))
    for energy in ("1/100", "0.0104", "0.011"):
        thin = Surface("1/5", "1/25", energy).impact(arb("0.1"), arb("0.05"))
        assert all(a.contains(b) for a, b in zip(wide, thin, strict=True))


def test_grazing_starts_are_decided_where_the_numbers_are_exact():
    with ctx.workprec(128):
        # x < -g: it leaves the floor although xdot + udot = 0
        assert first_root(arb(-0.5), arb(0.1), arb(0), arb(0.25)) > 0
        # x = -g exactly and udot > 0: a cubic start
        assert first_root(arb(-0.25), arb(0.1), arb(0), arb(0.25)) > 0
        with pytest.raises(UndecidedError):
            first_root(arb(-0.25), arb(-0.1), arb(0), arb(0.25))
        with pytest.raises(UndecidedError, match="grazing"):
            first_root(arb(0.1), arb(0.1), arb(0, 1e-9), arb(0.25))


def test_exact_takes_fractions_decimals_and_text():
    from decimal import Decimal

    for value in (Fraction(1, 5), Decimal("0.2"), "1/5", "0.2", " 2e-1 ", "+1 / 5"):
        assert surface.exact("k", value) == Fraction(1, 5)
