"""The second checker proves the same statements and shares no code; its arithmetic and its map."""

import subprocess
import sys
from fractions import Fraction

import mpmath
import numpy as np
import pytest
import second_checker
from certificates import with_field
from flint import arb, ctx
from second_checker import STATEMENTS, ImpactMap, Interval, NotProvedError, Series, check
from sections import sea
from slowly import slowly

from extensions.proofs import THEOREMS, Surface
from extensions.proofs.enclosure.jets import Jet
from pseudorigid.dynamics.variables import chart

PAPER = Surface("1/5", "1/25", "1/100")
HORSESHOES = ["horseshoe-outer", "horseshoe-inner"]
QUICK = [name for name in STATEMENTS if name not in HORSESHOES]


def contains(interval, ball):
    """Whether an interval contains a ball."""
    unit = arb(2) ** -second_checker.BITS
    return arb(interval.lo) * unit <= ball.lower() and ball.upper() <= arb(interval.hi) * unit


def test_it_needs_nothing_but_the_standard_library():
    program = f"import runpy; runpy.run_path({second_checker.__file__!r})"
    command = [sys.executable, "-I", "-S", "-c", program]  # -S hides all packages
    assert subprocess.run(command, check=False).returncode == 0


def test_sine_and_cosine_contain_those_of_mpmath():
    random = np.random.default_rng(1)
    for low in [0.0, 1e-30, 31.5, *random.uniform(0.0, 30.0, 50)]:
        width = 10.0 ** random.uniform(-60, 0.2)
        interval = Interval(Interval.of(low).lo, Interval.of(Fraction(low) + Fraction(width)).hi)
        sine, cosine = interval.sine_cosine()
        with mpmath.workdps(80):
            for share in (0, 0.25, 0.5, 1):
                t = mpmath.mpf(low) + mpmath.mpf(width) * share
                for value, true in ((sine, mpmath.sin(t)), (cosine, mpmath.cos(t))):
                    assert value.lo <= true * second_checker.ONE <= value.hi
        assert sine.hi - sine.lo <= 1.2 * (interval.hi - interval.lo) + 10
    with pytest.raises(NotProvedError, match="longer"):
        Interval.of(33).sine_cosine()


def test_operations_contain_the_results_for_numbers_inside():
    random = np.random.default_rng(2)
    for _ in range(100):
        ends = [sorted(Fraction(a) for a in random.normal(size=2)) for _ in range(2)]
        one, other = (Interval(Interval.of(a).lo, Interval.of(b).hi) for a, b in ends)
        for s, t in ((0, 1), (1, 0), (0, 0), (1, 1), (Fraction(1, 3), Fraction(2, 7))):
            a, b = ((low + (high - low) * u) for (low, high), u in zip(ends, (s, t), strict=True))
            exact = [(one + other, a + b), (one - other, a - b), (one * other, a * b),
                     (one.square(), a * a), (abs(one), abs(a)), (-one, -a)]  # fmt: skip
            if other.lo > 0 or other.hi < 0:
                exact.append((one / other, a / b))
            for interval, value in exact:
                assert interval.lo <= value * second_checker.ONE <= interval.hi
            if one.lo > 0:
                root = one.sqrt()
                assert root.lo**2 <= a * second_checker.ONE**2 <= root.hi**2


def test_its_statements_are_those_of_the_theorems():
    for name, (_, numbers) in STATEMENTS.items():
        bounds = dict(THEOREMS[name].bounds)
        if surface := bounds.pop("surface", None):
            bounds |= {"k": surface.k, "g": surface.g, "energy": surface.energy}
        assert numbers == bounds


@pytest.mark.parametrize("name", [*QUICK, *slowly(*HORSESHOES)])
def test_it_proves_the_statement_with_the_same_digits(name):
    found, result = check(name), THEOREMS[name].check()
    with ctx.workprec(256):
        unit = arb(2) ** -second_checker.BITS
        for digit in ("x", "trace") if "trace" in found else ():
            ends = arb(found[digit].lo).union(arb(found[digit].hi))
            assert (ends * unit).overlaps(arb(result.digits[digit]))
            assert found[digit].hi - found[digit].lo < second_checker.ONE // 10**28
    if name in HORSESHOES:
        # its margins are at least the package's: its enclosures of coverings are narrower
        for margin in ("beyond", "room"):
            assert found[margin].middle() > result.margins[margin] - 1e-9


@pytest.mark.parametrize(("name", "radius"), [
    ("fixed-point", "1e-2"), ("fixed-point-low", "5e-3"), ("six-elliptic", "4e-4"),
    ("six-hyperbolic", "5e-4"), ("six-inverse", "2e-3"), ("ten-elliptic", "1e-5"),
    ("twelve-elliptic", "1e-5"),
])  # fmt: skip
def test_it_proves_the_orbits_in_the_larger_boxes_of_the_page(name, radius):
    larger = with_field(THEOREMS[name].text(), "radius", f'"{radius}"')
    assert check(name, larger, radius=Fraction(radius))


# ---- its arithmetic and its map


def test_images_and_derivatives_contain_those_of_the_package():
    surface = ImpactMap(PAPER.k, PAPER.g, PAPER.energy)
    radius, undecided = Fraction(1, 10**5), 0
    for point in chart(0.2, *sea(60)).T:
        x, y = map(Fraction, point)
        size = Interval.of(radius).hi
        box = [Interval.of(a).plus_minus(size) for a in (x, y)]
        zeros = [second_checker.ZERO] * 4
        try:
            series = surface.image(
                Series(box[0], second_checker.UNITY, *zeros),
                Series(box[1], second_checker.ZERO, second_checker.UNITY, *zeros[1:]),
                surface.first_root(*box),
            )
        except NotProvedError:
            undecided += 1
            continue
        for shift in (-1, Fraction(1, 3), 1):
            with ctx.workprec(300):
                near = [arb(a.numerator) / a.denominator for a in (x + shift * radius, y - radius)]
                jets = PAPER.impact(*Jet.plane(2, *near))[:2]
                for part, jet in zip(series, jets, strict=True):
                    for coefficient, true in zip(part.c, jet.coefficients, strict=True):
                        assert contains(coefficient, true)
    assert undecided < 10
