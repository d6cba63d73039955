"""The ball map: roots against a scan, identities, jets, and proofs that fail if it is broken."""

from decimal import Decimal
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from certificates import ONE_OF_EACH
from flint import arb, ctx
from independent_solver import exact_map
from sections import BALL, sea

from extensions.proofs import THEOREMS, Surface, proved_impacts
from extensions.proofs.enclosure.surface import exact
from pseudorigid.dynamics.variables import chart
from pseudorigid.verified import flight
from pseudorigid.verified.flight import UndecidedError

PAPER = Surface("1/5", "1/25", "1/100")
COVERINGS = ("horseshoe", "entropy", "no-circle", "unstable")
# theorems without a flight whose root is searched
WITHOUT_FLIGHTS = ("diffeomorphism", "one-fixed-point", "fixed-point-elliptic", "twist-one-zero")


def points(count):
    """Points (x, y) uniform on the section."""
    return chart(BALL.k, *sea(count)).T


def test_the_first_root_is_that_of_a_brute_force_scan():
    times = np.linspace(0.0, 40.0, 20_001)[1:]
    waves = np.sin(times) - times, 1.0 - np.cos(times)
    for x, y in points(500):
        tau = PAPER.impact(arb(x), arb(y)).tau
        _, v, w = BALL.state_xy(x, y, 0.01)
        s, c = v + w, -(y + v + w) / 1.2
        gap = times * (0.02 * times - s) + c * waves[0] + x * waves[1]
        later = times[gap > 0.0]
        assert tau.rad() < 1e-7
        assert later[0] - 0.002 - 1e-7 < float(tau) < later[0] + 1e-7


def test_a_box_encloses_the_images_and_derivatives_of_its_points():
    random = np.random.default_rng(8)
    for x, y in points(40):
        try:
            rows, image = PAPER.jacobian(arb(x, 1e-4), arb(y, 1e-4))
        except UndecidedError:
            continue
        for dx, dy in random.uniform(-1e-4, 1e-4, (5, 2)):
            inner, point = PAPER.jacobian(arb(x + dx), arb(y + dy))
            assert all(outer.contains(part) for outer, part in zip(image, point, strict=True))
            for wide, thin in zip(rows, inner, strict=True):
                assert all(a.contains(b) for a, b in zip(wide, thin, strict=True))


def test_a_band_of_energies_contains_each_of_its_maps():
    band = Surface("1/5", "1/25", "1/100", Fraction(1, 1000))
    wide = band.impact(arb("0.1"), arb("0.05"))
    for energy in ("1/100", "0.0104", "0.011"):
        thin = Surface("1/5", "1/25", energy).impact(arb("0.1"), arb("0.05"))
        assert all(a.contains(b) for a, b in zip(wide, thin, strict=True))


def test_an_independent_map_of_60_digits_lies_in_the_balls():
    with ctx.workprec(160), mpmath.workdps(60):
        k, g = mpmath.mpf(1) / 5, mpmath.mpf(1) / 25
        for x, y in points(20):
            v, w = (mpmath.mpf(a.str(50, radius=False)) for a in PAPER.velocities(arb(x), arb(y)))
            image = PAPER.impact(arb(x), arb(y))
            x1, v1, w1, tau = exact_map(k, g, mpmath.mpf(x), v, w)
            for ball, true in ((image.x, x1), (image.y, v1 - k * w1), (image.tau, tau)):
                assert abs(float(arb(mpmath.nstr(true, 50)) - ball)) < 1e-40


def test_a_flight_that_may_touch_and_a_point_off_the_section_are_undecided():
    # a point of the jump set, to thirty digits: the touch cannot be told from a miss
    x, y = arb("0.150034356069120683526702038728"), arb("-0.144621563013173987118939871049")
    with ctx.workprec(60), pytest.raises(UndecidedError, match="touch"):
        PAPER.impact(+x, +y)
    with pytest.raises(UndecidedError, match="rim"):
        PAPER.impact(arb("0.6"), arb(0))


@pytest.mark.parametrize(("numbers", "name"), [
    *(((value, "1/25", "1/100"), "k = ")
      for value in (0.2, "1/x", "1/0", "nan", "1e99999", None, True, "0x1p3")),
    (("0", "1", "1"), "k = 0"), (("6/5", "1", "1"), "k = 6/5"), (("1/5", "0", "1"), "g = 0"),
    (("1/5", "1/25", "-1/250"), "energy = -1/250"),
])  # fmt: skip
def test_numbers_that_are_not_exact_or_out_of_range_are_refused(numbers, name):
    with pytest.raises(ValueError, match=f"^{name}") as error:
        Surface(*numbers)
    assert "\n" not in str(error.value)


def test_exact_numbers_are_fractions_decimals_and_text():
    for value in (Fraction(1, 5), Decimal("0.2"), "1/5", "0.2", " 2e-1 ", "+1 / 5"):
        assert exact("k", value) == Fraction(1, 5)


def test_a_fraction_of_a_decimal_is_an_exact_number():
    assert exact("k", "0.5/3") == exact("k", " .5 / 3") == Fraction(1, 6)


def test_a_ball_pressed_onto_the_floor_stays_there():
    at_rest = np.array([[-0.25], [0.0], [0.0]])  # x = -g, s = 0 and udot = 0
    assert proved_impacts.impact_errors("1/5", "1/4", at_rest, at_rest, np.zeros(1)) < 1e-300
    # x = -0.04 as a double is not -1/25: the ball leaves the floor
    lifted = np.array([[-0.04], [0.0], [0.0]])
    assert proved_impacts.impact_errors("1/5", "1/25", lifted, at_rest, np.zeros(1)) > 0.1


# ---- a broken map proves nothing


def proved(names):
    return [name for name in names if THEOREMS[name].check().verdict == "proved"]


def test_proofs_refuse_a_map_that_skips_a_root(monkeypatch):
    march = flight._march

    def skipping(gap, start):
        _, t = march(gap, start)
        for _ in range(4000):
            t = t + 0.01
            if gap.height(t) < 0:
                return march(gap, t.mid())
        raise UndecidedError("no other root")

    monkeypatch.setattr(flight, "_march", skipping)
    assert proved(name for name in ONE_OF_EACH if name not in WITHOUT_FLIGHTS) == []


@pytest.mark.parametrize(("error", "coverings"), [(arb(2) ** -80, False), (arb("4e-6"), True)])
def test_proofs_refuse_a_gravity_that_is_a_little_off(error, coverings, monkeypatch):
    """Coverings and |B| > |A| have margins: a smaller error leaves them true."""
    constants = Surface.constants

    def heavier(self):
        k, g, energy = constants(self)
        return k, g + error, energy

    monkeypatch.setattr(Surface, "constants", heavier)
    names = [name for name in THEOREMS if name.startswith(COVERINGS) == coverings]
    assert proved(name for name in names if name not in WITHOUT_FLIGHTS) == []
