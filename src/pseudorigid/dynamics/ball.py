"""The ball: its parameters, energy and section, and the impact map on numbers or arrays."""

import math
from dataclasses import dataclass, field

import numpy as np

from ..kernel.impact_law import impact_coefficients, rebound
from .ensemble import ImpactMap
from .inputs import coordinates, not_allowed, number, whole_number


@dataclass(frozen=True)
class Ball:
    """A pseudo-rigid ball, dimensionless: lengths in R, times in 1/omega.

    A state (x, xdot, udot) is taken just before an impact, where u = -x; x points down. It is on
    the section where xdot + udot >= 0, eq. (22). Methods take scalars or arrays that broadcast,
    and return numbers for scalars and arrays of the broadcast shape otherwise; each element has
    the bits of the scalar call, and is NaN where the input is not finite. `help(pseudorigid)` says
    what counts as a number. Balls are equal if k, g and the way of `map` are.

    Parameters
    ----------
    k : float
        Euler inertia, eq. (5), 0 < k <= 1 (a solid sphere has 1/5, a thin shell 1/3).
    g : float
        Gravity, eq. (20), g > 0.
    map : ImpactMap, optional
        How the next impact is found: by default the certified march.

    Raises
    ------
    ValueError
        k or g outside its range; from methods, a state with xdot + udot < 0.

    Notes
    -----
    Positions are in R, xdot in R omega, udot in omega, energies in m omega^2 R^2, eqs. (15)-(20).

    References
    ----------
    Equations are those of Kanso and Papadopoulos, "Dynamics of pseudo-rigid ball impact on rigid
    foundation".

    Examples
    --------
    >>> ball = Ball(k=0.2, g=0.04)
    >>> x, xdot, udot, tau = ball.impact(*ball.start(0.5, 0.01))
    >>> abs(ball.energy(x, xdot, udot) - 0.01) < 1e-15
    True
    """

    k: float
    g: float
    map: ImpactMap = field(default_factory=ImpactMap)

    def __post_init__(self):
        for name, most, allowed in (("k", 1.0, "0 < k <= 1"), ("g", math.inf, "g > 0, finite")):
            value = number(name, getattr(self, name), allowed, lambda v, most=most: 0.0 < v <= most)
            object.__setattr__(self, name, value)
        if not isinstance(self.map, ImpactMap):
            raise not_allowed("map", self.map, "an ImpactMap")

    @np.errstate(over="ignore", invalid="ignore")
    def energy(self, x, xdot, udot):
        """Total energy, eq. (29): xdot^2/2 + k udot^2/2 - g x + k x^2/2.

        Parameters
        ----------
        x, xdot, udot : float or array

        Returns
        -------
        float or array
            In m omega^2 R^2.
        """
        x, xdot, udot = coordinates(x=x, xdot=xdot, udot=udot)
        kinetic = 0.5 * xdot * xdot + 0.5 * self.k * udot * udot
        return _plain(kinetic - self.g * x + 0.5 * self.k * x * x)

    def energy_bounds(self):
        """The lowest energy there is, and the paper's highest.

        Returns
        -------
        lowest, highest : float
            -g^2/(2k), at rest on the floor, and k/2 - g, eq. (31), which is to keep u > -1.
        """
        return -self.g * self.g / (2.0 * self.k), 0.5 * self.k - self.g

    @np.errstate(over="ignore")
    def section(self, energy):
        """The section along y = 0: x from centre - radius to centre + radius.

        The energy surface's half is the disk y^2/(1+k) + k (x - g/k)^2 <= 2E + g^2/k.

        Parameters
        ----------
        energy : float or array
            In m omega^2 R^2.

        Returns
        -------
        centre : float
            In R.
        radius : float or array
            In R.

        Raises
        ------
        ValueError
            An energy below the lowest.
        """
        (energy,) = coordinates(energy=energy)
        square = (2.0 * energy + self.g * self.g / self.k) / self.k
        off = (square < 0.0) | np.isinf(square)
        if np.any(off):
            lowest = self.energy_bounds()[0]
            raise not_allowed("energy", float(energy[off][0]), f"finite, at least {lowest:.6g}")
        return self.g / self.k, _plain(np.sqrt(square))

    @np.errstate(over="ignore", invalid="ignore")
    def state(self, x, xdot, energy, branch=1):
        """The state with this energy, eq. (29).

        Parameters
        ----------
        x, xdot, energy : float or array
        branch : {1, -1}
            Of two states, that with the larger udot, or the other.

        Returns
        -------
        x, xdot, udot : float or array

        Raises
        ------
        ValueError
            The energy surface has no such point with xdot + udot >= 0, or another branch.
        """
        branch = number("branch", branch, "1 or -1", lambda v: abs(v) == 1.0)
        x, xdot, energy = coordinates(x=x, xdot=xdot, energy=energy)
        square = (2.0 * energy + 2.0 * self.g * x - self.k * x * x - xdot * xdot) / self.k
        if not np.all((square >= 0.0) | np.isnan(x)):
            raise ValueError("no state with this x, xdot and energy: too little kinetic energy")
        udot = branch * np.sqrt(square)
        if not np.all((xdot + udot >= 0.0) | np.isnan(x)):
            raise ValueError("no state with this x, xdot and energy on the section, eq. (22)")
        return _plain(x), _plain(xdot), _plain(udot)

    @np.errstate(over="ignore", invalid="ignore")
    def state_xy(self, x, y, energy):
        """The state at a point of the canonical chart, in which the map keeps areas.

        Parameters
        ----------
        x, y, energy : float or array
            y = xdot - k udot.

        Returns
        -------
        x, xdot, udot : float or array

        Raises
        ------
        ValueError
            A point outside the section's disk.
        """
        x, y, energy = coordinates(x=x, y=y, energy=energy)
        k = self.k
        # s = xdot + udot from 2E + 2 g x - k x^2 = (y^2 + k s^2)/(1 + k)
        square = ((1.0 + k) * (2.0 * energy + 2.0 * self.g * x - k * x * x) - y * y) / k
        if not np.all((square >= 0.0) | np.isnan(x)):
            raise ValueError("no state with this x, y and energy: the point is outside the section")
        s = np.sqrt(square)
        return _plain(x), _plain((y + k * s) / (1.0 + k)), _plain((s - y) / (1.0 + k))

    def start(self, fraction, energy):
        """The state on y = 0 at a fraction of the section's radius.

        Parameters
        ----------
        fraction : float or array
            From -1 to 1.
        energy : float or array
            In m omega^2 R^2.

        Returns
        -------
        x, xdot, udot : float or array

        Raises
        ------
        ValueError
            A fraction beyond the rim, or an energy below the lowest.
        """
        f, energy = coordinates(fraction=fraction, energy=energy)
        centre, radius = self.section(energy)
        if not np.all((np.abs(f) <= 1.0) | np.isnan(f)):
            raise ValueError("a start is a fraction of the section's radius, from -1 to 1")
        # in the chart s^2 = (1 + k) (radius^2 - (x - centre)^2); so nothing cancels at the rim
        udot = radius * np.sqrt((1.0 - f) * (1.0 + f) / (1.0 + self.k))
        return _plain(centre + f * radius), _plain(self.k * udot), _plain(udot)

    @np.errstate(over="ignore", invalid="ignore")
    def reflect(self, x, xdot, udot):
        """The reversor R, (x, y) -> (x, -y): velocities after the impact, eq. (25), reversed.

        Parameters
        ----------
        x, xdot, udot : float or array

        Returns
        -------
        x, xdot, udot : float or array
            R undoes itself, and R F R is the inverse of the impact map F.
        """
        x, xdot, udot = self.on_section(x, xdot, udot)
        b, c, _ = rebound(xdot, udot, self.k, impact_coefficients(self.k))
        return _plain(x), _plain(-b), _plain(np.maximum(-c, b))

    def time_to_impact(self, x, xdot, udot):
        """Time to the next impact: the smallest positive root of eq. (21) with (26).

        Parameters
        ----------
        x, xdot, udot : float or array

        Returns
        -------
        float or array
            In 1/omega; 0 where the ball does not leave the floor (at rest on it, or on the rim
            xdot + udot = 0 and pressed down).
        """
        return self.impact(x, xdot, udot)[3]

    def impact(self, x, xdot, udot):
        """The impact map, eq. (28).

        At a double root, where the ball just touches the floor, tau is only defined to the square
        root of a rounding.

        Parameters
        ----------
        x, xdot, udot : float or array

        Returns
        -------
        x, xdot, udot, tau : float or array
            The state just before the next impact, and the flight time (1/omega), eq. (27).
        """
        return self._once(self.map.steps, x, xdot, udot)

    def inverse_impact(self, x, xdot, udot):
        """The impact map's inverse, F^-1 = R F R.

        Parameters
        ----------
        x, xdot, udot : float or array

        Returns
        -------
        x, xdot, udot, tau : float or array
            The state just before the previous impact, and the flight time since (1/omega).
        """
        return self._once(self.map.steps_back, x, xdot, udot)

    def jacobian(self, x, xdot, udot, impacts=1):
        """The analytic Jacobian of the map with respect to (x, xdot, udot), eq. (33).

        Not finite where the next impact is grazing, xdot + udot = 0 there: the map is not
        differentiable.

        Parameters
        ----------
        x, xdot, udot : float or array
        impacts : int
            Of the map's iterate, by the chain rule.

        Returns
        -------
        ndarray, shape (..., 3, 3)
            Row i, column j: the derivative of the i-th new variable by the j-th old one.
        """
        impacts = whole_number("impacts", impacts)
        columns, shape = self.columns(x, xdot, udot)
        out = np.empty((columns[0].size, 3, 3))
        self.map.jacobians(*columns, self.k, self.g, impacts, out)
        return out.reshape(*shape, 3, 3)

    @np.errstate(all="ignore")
    def chart_jacobian(self, x, xdot, udot, impacts=1):
        """The Jacobian in the chart (x, y = xdot - k udot) at fixed energy.

        Not finite on the rim.

        Parameters
        ----------
        x, xdot, udot : float
            One state.
        impacts : int
            Of the map's iterate.

        Returns
        -------
        tuple
            Two rows of two numbers; the determinant is 1, eq. (42).
        """
        x, xdot, udot = self.on_section(x, xdot, udot)
        if x.shape:
            raise ValueError(f"one state is needed, not an array of shape {x.shape}")
        k, g = self.k, self.g
        s, y = float(xdot + udot), float(xdot - k * udot)
        # the derivatives of s by x and y, and with them those of the state, a column each
        unit = np.array([0.0, 1.0])
        slope = np.array([(1.0 + k) * (g - k * x), -y]) / (k * s)
        along = np.stack((1.0 - unit, (k * slope + unit) / (1.0 + k), (slope - unit) / (1.0 + k)))
        j = self.jacobian(x, xdot, udot, impacts)
        dx, dv, dw = (j[:, :, None] * along).sum(axis=1)
        return tuple(dx.tolist()), tuple((dv - k * dw).tolist())

    def on_section(self, x, xdot, udot):
        """The state as arrays of one shape.

        Parameters
        ----------
        x, xdot, udot : float or array

        Returns
        -------
        x, xdot, udot : ndarray

        Raises
        ------
        ValueError
            Where xdot + udot < 0, eq. (22).
        """
        x, xdot, udot = coordinates(x=x, xdot=xdot, udot=udot)
        if np.any(xdot < -udot):  # a sum could overflow
            raise ValueError("a state just before an impact has xdot + udot >= 0, eq. (22)")
        return x, xdot, udot

    def columns(self, x, xdot, udot):
        """States for a loop that advances them in place.

        Parameters
        ----------
        x, xdot, udot : float or array

        Returns
        -------
        columns : list of ndarray, shape (n,)
            Copies of the three.
        shape : tuple
            What they were before.
        """
        state = self.on_section(x, xdot, udot)
        return [a.flatten() for a in state], state[0].shape

    def _once(self, loop, x, xdot, udot):
        columns, shape = self.columns(x, xdot, udot)
        tau = np.empty(columns[0].size)
        loop(*columns, self.k, self.g, 1, tau)
        return tuple(_plain(a.reshape(shape)) for a in (*columns, tau))


def _plain(array):
    """A 0-dimensional result as a Python float."""
    return float(array) if np.ndim(array) == 0 else array
