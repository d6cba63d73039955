"""The fixed point at the resonance 1/4: a band that is too wide, and other balls."""

from fractions import Fraction

import pytest
from flint import arb, ctx

from extensions.proofs import THEOREMS
from extensions.proofs.checkers import fixed_point
from extensions.proofs.enclosure.surface import ball_of


@pytest.mark.parametrize(
    ("k", "factor"),
    [("1/20", 1.089), ("1/10", 1.367), ("1/5", 4.206), ("3/10", 3.414), ("1/3", 2.093)],
)
def test_the_resonance_is_unstable_for_other_balls(k, factor):
    """The factors by which |B| exceeds |A| in src/extensions/atlas/README.md."""
    k, g, low, high = Fraction(k), Fraction(1, 25), Fraction(1, 100), Fraction(3)
    with ctx.workprec(fixed_point.BITS):
        for _ in range(170):
            middle = (low + high) / 2
            falls = fixed_point.trace_at(ball_of(k), ball_of(middle)) > 0
            low, high = (middle, high) if falls else (low, middle)
        ends = [fixed_point.energy_at(ball_of(k), ball_of(g), ball_of(end)) for end in (low, high)]
        band, orbit = fixed_point._prove_over(k, g, arb.union(*ends), ball_of(low))
        form = fixed_point.complex_map(band, orbit, order=3)
        a, b = map(abs, fixed_point.resonant_coefficients(*form))
        assert float(b / a) == pytest.approx(factor, abs=5e-4)
    assert "unstable" in THEOREMS
