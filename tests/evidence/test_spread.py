"""The spread of exponents: blocks add up, regular orbits fall like ln n / n, cells entered."""

import math

import numpy as np
import pytest

from pseudorigid import Ball, lyapunov_spectrum, orbit
from pseudorigid.evidence.spread import spread, stretches

BALL, ENERGY = Ball(0.2, 0.04), 0.01
SEA = (0.55, 0.68)


@pytest.fixture(scope="module")
def spreading():
    return spread(BALL, ENERGY, SEA, 16, 40_000, 8, [-0.44, 0.142183], 1 << 14, 12, 1 << 13)


def test_blocks_add_up_to_the_exponents_of_the_whole(spreading):
    states = BALL.start(spreading["start"].values, ENERGY)
    whole = lyapunov_spectrum(BALL, states, 40_000, 1)["exponent"].values[0]
    np.testing.assert_allclose(spreading["exponent"].values.mean(axis=0), whole, atol=1e-13)
    assert stretches(spreading, 40_000) == pytest.approx(whole[:, 0], abs=1e-13)
    assert stretches(spreading, 10_000).size == 64


def test_exponents_of_regular_orbits_fall_like_ln_n_over_n(spreading):
    n = spreading["length"].values[6:]
    largest = spreading["regular_exponent"].values[6:, :, 0]
    bound = 1.5 * np.log(n) / n
    assert np.all(np.abs(largest) < bound[:, None])
    assert np.all(stretches(spreading, 40_000) > 0.2)


def test_cells_that_orbits_enter(spreading):
    any_, all_, least = (spreading[f"entered_{name}"].values for name in ("any", "all", "least"))
    assert np.all(all_ <= least) and np.all(least <= any_)
    assert np.all(np.diff(any_) >= 0) and np.all(np.diff(least) >= 0)
    assert 0.5 * 144 < any_[-1] <= 144
    # one orbit, counted by hand
    start = float(spreading["start"].values[0])
    path = orbit(BALL, BALL.start(start, ENERGY), 1 << 13)
    centre, radius = BALL.section(ENERGY)
    x = (path["x"].values - centre) / radius
    y = (path["xdot"].values - 0.2 * path["udot"].values) / (radius * math.sqrt(0.24))
    cells = {(int(6 * (a + 1)), int(6 * (b + 1))) for a, b in zip(x, y, strict=True)}
    alone = spread(BALL, ENERGY, (start, start + 1e-12), 1, 8, 1, [0.1], 1, 12, 1 << 13)
    assert abs(int(alone["entered_any"].values[-1]) - len(cells)) <= 2  # the start moved by 1e-12


def test_blocks_must_divide_an_orbit():
    with pytest.raises(ValueError, match="length = 10 is no multiple"):
        spread(BALL, ENERGY, SEA, 2, 10, 4, [0.1], 4, 4, 4)
    with pytest.raises(ValueError, match="between"):
        spread(BALL, ENERGY, (0.7, 0.6), 2, 8, 4, [0.1], 4, 4, 4)
