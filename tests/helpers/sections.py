"""States spread over the section."""

import numpy as np
from hypothesis import strategies as st

from pseudorigid.dynamics.ball import Ball
from pseudorigid.kernel import formulas

BALL = Ball(k=0.2, g=0.04)


def sea(n, energy=0.01, ball=BALL):
    """n random states over the section, in islands and sea, also beyond eq. (31)."""
    rng = np.random.default_rng(n)
    radius, angle = np.sqrt(rng.random(n)), 2.0 * np.pi * rng.random(n)
    k, g = ball.k, ball.g
    size = np.sqrt(formulas.radius_squared(k, g, energy))
    y = size * np.sqrt(k * (1.0 + k)) * radius * np.sin(angle)
    return formulas.chart_state(k, g, energy, g / k + size * radius * np.cos(angle), y)


def ball_of(k, g):
    """A ball with any k and g, also g >= k, for maps of its states."""
    ball = Ball.dimensionless(k)
    object.__setattr__(ball, "g", float(g))
    return ball


@st.composite
def any_sea(draw, least):
    """A ball, and at least `least` states over its section at an energy."""
    ball = ball_of(draw(st.floats(0.01, 1.0)), draw(st.floats(1e-4, 1.0)))
    lowest, _ = ball.energy_bounds()
    energy = lowest + draw(st.floats(1e-6, 0.999)) * (3.0 * abs(lowest) + 0.1)
    return ball, sea(least + draw(st.integers(0, 8)), energy, ball)
