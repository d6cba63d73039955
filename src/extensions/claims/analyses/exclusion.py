"""Points of the section through which no invariant circle around the fixed point can pass.

Converse KAM theory (MacKay and Percival, Communications in Mathematical Physics 98, 1985; MacKay,
Meiss and Stark, Nonlinearity 2, 1989; Duignan and Meiss, SIAM Journal on Applied Dynamical Systems
20, 2021). A circle that is star-shaped about the fixed point meets each ray from there once, so
that vectors along the rays point out of it. If it is invariant, their images under the derivative
of the map point out of it as well. So the radial vectors at the points of an orbit on the circle,
carried to one of these points, lie in one half plane, outside of the circle's tangent. No such
circle passes through a point where they do not.
"""

import numpy as np
import xarray as xr

from extensions.atlas.symmetry_line import symmetric_fixed_point
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import LENGTH, SPEED, described
from pseudorigid.kernel import impact as kernel
from pseudorigid.kernel.compiled import jit

from .sea import as_array, half_axes

_EXCLUDED = "impacts forwards and backwards that exclude the point; 0 if none do"
_SHARE = "share of the section that so many impacts, forwards and backwards, exclude"
_ERROR = "its standard error, as if the points that are followed were random"


def exclusion(ball: Ball, energy: float, grid: int, followed: int) -> xr.Dataset:
    """Find after how many impacts each point of a grid is on no circle around the fixed point.

    The grid has `grid` columns, an even number, across the section, and square cells where the
    section is drawn as a disk. Of each point and its mirror image in y = 0 one is followed, since
    the reversor maps circles to circles, for at most `followed` impacts in either direction. Points
    beyond the section, or closer than 1e-12 to its rim, have -1.

    >>> from pseudorigid import Ball
    >>> float(exclusion(Ball(k=0.2, g=0.04), 0.01, 40, 20)["share"][-1]) > 0.7
    True
    """
    (centre, _), (width, height) = ball.section(energy), half_axes(ball, energy)
    middle = (2.0 * np.arange(grid) + 1.0) / grid - 1.0
    half = middle[grid // 2 :]
    up, across = (a.ravel() for a in np.meshgrid(half, middle, indexing="ij"))
    inside = across * across + up * up < 1.0 - 1e-12
    states = as_array(ball.state_xy(centre + width * across[inside], height * up[inside], energy))
    place, _ = symmetric_fixed_point(ball, energy)
    of_half = np.full((half.size, grid), -1, dtype=np.int32)
    of_half.ravel()[inside] = _excluded_after(
        *states, centre + width * place, ball.k, ball.g, followed
    )
    excluded = np.concatenate([of_half[::-1], of_half])
    known = of_half[of_half >= 0]
    counts = np.bincount(known, minlength=followed + 1)
    share = np.cumsum(counts[1:]) / known.size
    data = {
        "x": ("column", centre + width * middle, "position at the impact", LENGTH),
        "y": ("row", height * middle, "y = xdot - k udot", SPEED),
        "excluded": (("row", "column"), excluded, _EXCLUDED),
        "impacts": ("count", np.arange(1, followed + 1), "impacts in either direction"),
        "share": ("count", share, _SHARE),
        "share_error": ("count", np.sqrt(share * (1.0 - share) / known.size), _ERROR),
    }
    return xr.Dataset(described(data))


@jit
def _excluded_after(
    x: np.ndarray, v: np.ndarray, w: np.ndarray, centre: float, k: float, g: float, followed: int
) -> np.ndarray:
    """Return after how many impacts each state is excluded, 0 for one that is not.

    An orbit backwards is the mirror image of the orbit forwards from the state's mirror image.
    """
    coefficients = kernel.impact_coefficients(k)
    result = np.zeros(x.size, dtype=np.int32)
    orbits, cone = np.empty((2, 9)), np.empty(4)
    for i in range(x.size):
        right, up = x[i] - centre, v[i] - k * w[i]
        cone[0], cone[1], cone[2], cone[3] = right, up, right, up
        _begin(orbits[0], x[i], v[i], w[i], k, g)
        xi, vi, wi = kernel.reflect(x[i], v[i], w[i], k, coefficients)
        _begin(orbits[1], xi, vi, wi, k, g)
        for n in range(1, followed + 1):
            right, up = _carried_radius(orbits[0], centre, k, g, coefficients)
            fits = _widen_to_hold(cone, right, up)
            right, up = _carried_radius(orbits[1], centre, k, g, coefficients)
            if not (fits and _widen_to_hold(cone, right, -up)):
                result[i] = n
                break
    return result


@jit
def _begin(orbit: np.ndarray, x: float, v: float, w: float, k: float, g: float) -> None:
    """Set an orbit's state, and the tangent vectors of the energy surface over dx and dy."""
    s, y = v + w, v - k * w
    orbit[0], orbit[1], orbit[2] = x, v, w
    ds = (1.0 + k) * (g - k * x) / (k * s)  # by x; by y it is -y/(k s)
    orbit[3], orbit[4], orbit[5] = 1.0, k * ds / (1.0 + k), ds / (1.0 + k)
    ds = -y / (k * s)
    orbit[6], orbit[7], orbit[8] = 0.0, (1.0 + k * ds) / (1.0 + k), (ds - 1.0) / (1.0 + k)


@jit
def _carried_radius(
    orbit: np.ndarray, centre: float, k: float, g: float, coefficients: tuple[float, float]
) -> tuple[float, float]:
    """Advance an orbit by an impact; return the radial vector there, carried to the orbit's start.

    The derivative has determinant 1 in the chart, so that its inverse needs no division. Only the
    direction of the result has a meaning.
    """
    x, v, w, _, sine, cosine, tau_x, tau_s, tau_c, _ = kernel.step_with_flight(
        orbit[0], orbit[1], orbit[2], k, g, coefficients, None
    )
    orbit[0], orbit[1], orbit[2] = x, v, w
    size = 0.0
    for j in (3, 6):
        dx, dv, dw = kernel.tangent(
            orbit[j], orbit[j + 1], orbit[j + 2],
            k, g, coefficients, x, w, sine, cosine, tau_x, tau_s, tau_c,
        )  # fmt: skip
        orbit[j], orbit[j + 1], orbit[j + 2] = dx, dv, dw
        size += abs(dx) + abs(dv) + abs(dw)
    for j in range(3, 9):
        orbit[j] /= size
    right, up = x - centre, v - k * w
    up_of_x, up_of_y = orbit[4] - k * orbit[5], orbit[7] - k * orbit[8]
    return up_of_y * right - orbit[6] * up, orbit[3] * up - up_of_x * right


@jit
def _widen_to_hold(cone: np.ndarray, right: float, up: float) -> bool:
    """Widen a cone, by its right and its left edge, to hold a vector; return whether it can.

    It cannot if the vector and the cone fit into no half plane. A vector that is NaN, after an
    exactly grazing impact, excludes nothing.
    """
    left_of_right = cone[0] * up - cone[1] * right
    right_of_left = cone[3] * right - cone[2] * up
    if left_of_right < 0.0 < right_of_left:
        cone[0], cone[1] = right, up
    elif right_of_left < 0.0 < left_of_right:
        cone[2], cone[3] = right, up
    return not (left_of_right <= 0.0 and right_of_left <= 0.0) or (
        left_of_right == 0.0 and right_of_left == 0.0 and cone[0] * right + cone[1] * up > 0.0
    )
