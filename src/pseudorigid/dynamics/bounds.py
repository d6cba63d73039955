"""Bounds of a ball's k, g and energy, which Python and config.yaml refuse by the same words.

k is the Euler inertia, eq. (5), g gravity in R omega^2; energies are in m omega^2 R^2. Numbers are
compared as the decimals that were written: as floats, 0.2 / 2 - 0.04 exceeds 0.06. Eq. (31) bounds
the energies of balls whose lengths are in R, and of no others (`Ball.unbounded`).
"""

import math
from fractions import Fraction
from functools import lru_cache

from ..kernel.closed_forms import energy_bounds

K_ALLOWED, G_ALLOWED = "a number with 0 < k <= 1", "a number with 0 < g < k"
LARGEST_OF_SPHERES = 1 / 3  # k of a thin shell
NO_SPHERE = "no sphere has a k above 1/3, which is that of a thin shell"
# 1/omega. The kernel computes flights up to 2^20, and a histogram has ten bins a unit of time.
LONGEST_FLIGHT = 1_000_000


def as_decimal(value: float) -> Fraction:
    """Return a number as the decimal that was written."""
    return Fraction(str(value))


def g_mistake(k: float, g: float) -> str:
    """Return which g is allowed, for one that is not below k, or an empty text."""
    return "" if g < k else f"0 < g < k = {k}"


def energy_mistake(k: float, g: float, energy: float, bounded: bool = True) -> str:
    """Return which energies are allowed, for one that is not, or an empty text."""
    lowest, highest, long = _bounds(k, g)
    if not as_decimal(energy) > lowest:
        return f"a number above -g^2/(2k) = {float(lowest)}, where the ball rests on the floor"
    if bounded and not as_decimal(energy) < highest:
        return f"a number below k/2 - g = {float(highest)}, where the ball could flatten to nothing"
    if not as_decimal(energy) <= long:
        return f"at most {float(long)}, with flights up to {LONGEST_FLIGHT}/omega"
    return ""


@lru_cache
def energy_range(k: float, g: float, bounded: bool = True) -> tuple[float, float]:
    """Return the least and the largest double that `energy_mistake` allows."""
    lowest, highest, long = _bounds(k, g)
    # A double beside float(bound) is on the same side of the bound as its shortest decimal.
    least, largest = float(lowest), float(long)
    if not as_decimal(least) > lowest:
        least = math.nextafter(least, math.inf)
    if not as_decimal(largest) <= long:
        largest = math.nextafter(largest, -math.inf)
    if bounded and highest <= long:
        largest = float(highest)
        if not as_decimal(largest) < highest:
            largest = math.nextafter(largest, -math.inf)
    return least, largest


def _bounds(k: float, g: float) -> tuple[Fraction, Fraction, Fraction]:
    """Return the energy at rest, that of eq. (31), and that of the longest flight."""
    inertia, gravity = as_decimal(k), as_decimal(g)
    lowest, highest = energy_bounds(inertia, gravity)
    # There sqrt(2E + g^2/k) = LONGEST_FLIGHT g/2.
    return lowest, highest, lowest + (LONGEST_FLIGHT * gravity) ** 2 / 8
