"""States spread over the section of the energy surface."""

import numpy as np
from hypothesis import strategies as st

from pseudorigid.dynamics.ball import Ball

BALL = Ball(k=0.2, g=0.04)


def sea(n, energy=0.01, ball=BALL):
    """n random states over the section, in islands and sea."""
    rng = np.random.default_rng(n)
    radius, angle = np.sqrt(rng.random(n)), 2.0 * np.pi * rng.random(n)
    centre, size = ball.section(energy)
    y = size * np.sqrt(ball.k * (1.0 + ball.k)) * radius * np.sin(angle)
    return ball.state_xy(centre + size * radius * np.cos(angle), y, energy)


@st.composite
def any_sea(draw, least):
    """A ball, and at least `least` states over its section at an energy."""
    ball = Ball(k=draw(st.floats(0.01, 1.0)), g=draw(st.floats(1e-4, 1.0)))
    lowest, _ = ball.energy_bounds()
    energy = lowest + draw(st.floats(1e-6, 0.999)) * (3.0 * abs(lowest) + 0.1)
    return ball, sea(least + draw(st.integers(0, 8)), energy, ball)
