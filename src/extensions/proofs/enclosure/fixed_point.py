"""The fixed point's energy and trace in closed form, in ball arithmetic.

The trace is that of the impact map's Jacobian at the fixed point on y = 0. With theta half the time
of flight, L = 1/theta - cot(theta) and Q = 2 theta - sin(2 theta),

    E = (g^2/2k) ((1+k) theta^2 + (theta L)^2 - 1),
    trace/2 = (1 + k cos(2 theta))/(1+k) - k L Q/(1+k)^2.

The functions raise NotProvedError unless 0 < theta < pi is proved. README.md of this extension
derives the formulas ("Periodic orbits").
"""

from flint import arb

from study.enclosure.flight import NotProvedError
from study.enclosure.jets import Jet, Real, algebra


def energy_at(k: arb, g: arb, theta: arb) -> arb:
    """Enclose the energy E at theta, which rises with theta."""
    _check(theta)
    bend = 1 - theta * theta.cot()
    return g * g / (2 * k) * ((1 + k) * theta * theta + bend * bend - 1)


def trace_at(k: arb, theta: Real) -> Real:
    """Enclose the trace at theta, or its Taylor series if theta is a Jet."""
    _check(theta.constant if isinstance(theta, Jet) else theta)
    sine, cosine = theta.sin_cos()
    double_sine, double_cosine = (2 * theta).sin_cos()
    shear = (1 / theta - cosine / sine) * (2 * theta - double_sine)
    return 2 * ((1 + k * double_cosine) / (1 + k) - k * shear / (1 + k) ** 2)


def slope_at(k: arb, theta: arb) -> arb:
    """Enclose the derivative of the trace by theta."""
    (jet,) = Jet.series(algebra(1, 1), theta)
    return trace_at(k, jet).coefficients[1]


def _check(theta: arb) -> None:
    """Raise NotProvedError unless theta is proved to lie between 0 and pi."""
    if not (theta > 0 and theta < arb.pi()):
        raise NotProvedError("theta is not proved to lie between 0 and pi")
