"""Map of the paper's method, and the impacts that it misses."""

import numpy as np
import pytest

from helpers.sections import BALL
from pseudorigid import Ball, lyapunov_spectrum, orbit
from pseudorigid.dynamics.ensemble import ImpactMap
from pseudorigid.kernel.impact import scan

SEA = BALL.start(0.534522, 0.01)


def scanned(step=0.1, tolerance=1e-12):
    return Ball(BALL.k, BALL.g, ImpactMap((step, tolerance)))


def test_the_scan_gives_the_map_to_its_tolerance():
    states = BALL.start(np.linspace(-0.9, 0.9, 50), 0.01)
    for tolerance in (1e-3, 1e-6, 1e-12):
        ball = scanned(tolerance=tolerance)
        for name in ("impact", "inverse_impact"):
            error = np.array(getattr(ball, name)(*states)) - getattr(BALL, name)(*states)
            assert np.abs(error).max() <= tolerance
        assert (ball.map.impacts, ball.map.missed) == (100, 0)
        exact = BALL.jacobian(*states, impacts=2)
        off = np.abs(ball.jacobian(*states, impacts=2) - exact).max(axis=(1, 2))
        assert np.all(off <= 100 * tolerance * np.abs(exact).max(axis=(1, 2)) ** 2)
    assert np.abs(error).max() > 0  # the method differs


def test_missed_impacts_are_counted():
    """Compare with the certified march from each state of the orbit."""
    ball = scanned(step=0.5)
    track = orbit(ball, SEA, 50_000)
    x, v, w, tau = (track[name].values for name in ("x", "xdot", "udot", "tau"))
    first = BALL.time_to_impact(x[:-1], v[:-1], w[:-1])
    late = int(np.sum(tau[1:] > first + 1e-5))
    assert ball.map.missed == late > 5
    assert ball.map.impacts == 50_000
    orbit(ball, SEA, 50_000)
    assert (ball.map.missed, ball.map.impacts) == (2 * late, 100_000)
    # The energy does not show missed impacts.
    assert np.max(np.abs(BALL.energy(x, v, w) / 0.01 - 1.0)) < 1e-9


def test_exponents_belong_to_the_scanned_orbit():
    ball = scanned(step=0.5)
    found = lyapunov_spectrum(ball, SEA, 2000, records=1).exponent.values[-1]
    orbits = scanned(step=0.5)
    orbit(orbits, SEA, 2000)
    assert (ball.map.impacts, ball.map.missed) == (2000, orbits.map.missed)
    many = lyapunov_spectrum(ball, BALL.start([0.534522] * 40, 0.01), 2000, records=1)
    assert np.array_equal(many.exponent.values[-1], [found] * 40)
    exact = lyapunov_spectrum(BALL, SEA, 2000, records=1).exponent.values[-1]
    assert 1e-6 < np.max(np.abs(found - exact)) < 0.1  # chaotic orbits part after 100 impacts


@pytest.mark.slow
def test_a_scan_without_an_end_raises():
    """A flight of 2e7 time units takes more steps than a scan may."""
    with pytest.raises(ArithmeticError, match="scan"):
        Ball(0.2, 1e-8, ImpactMap((0.1, 1e-6))).impact(0.0, 0.0, 0.3)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_input_that_is_not_finite_gives_nan(bad):
    assert np.isnan(scan(bad, -0.1, -0.1, 0.04, 0.1, 1e-6)[0])
    assert np.isnan(scanned().impact(bad, 0.0, 1.0)).all()
