"""Ball: its parameters, energy and section, and the impact map on numbers or arrays."""

import math
import warnings
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, Self, SupportsFloat, SupportsIndex

import numpy as np

from ..kernel import formulas
from ..kernel import impact as kernel
from ..kernel.closed_forms import energy_bounds
from ..kernel.formulas import impact_coefficients, rebound
from . import bounds
from .ensemble import ImpactMap
from .inputs import Reals, coordinates, not_allowed, number, state_of, whole_number

# A float for numbers, an array for arrays: a checker of types cannot tell which.
Result = Any
State = tuple[Result, Result, Result]
Arrays = tuple[np.ndarray, np.ndarray, np.ndarray]
NextState = tuple[Result, Result, Result, Result]
Rows = tuple[tuple[float, float], tuple[float, float]]
_ROUNDINGS = 1e-9  # of the energy of a state, over k: far above those of the longest orbits


@dataclass(frozen=True)
class Ball:
    """A pseudo-rigid ball, dimensionless: lengths in R, times in 1/omega.

    A state (x, xdot, udot) is taken just before an impact, where u = -x; x points downwards. States
    lie on the section xdot + udot >= 0, eq. (22). Energies are in m omega^2 R^2, eqs. (15)-(20).
    Methods take scalars or arrays that broadcast. They return floats for scalars, and otherwise
    arrays of the broadcast shape, whose elements equal scalar calls bit for bit. An element is NaN
    where an argument is not finite, and after a flight of 2^20/omega or longer (about
    2 sqrt(2E + g^2/k)/g is the longest one); for scalars such a flight is an error.
    `help(pseudorigid)` lists the accepted types. Two balls are equal if they have equal k and g and
    their maps find impacts in the same way.

    Parameters
    ----------
    k : float
        Euler inertia, eq. (5), 0 < k <= 1 (1/5 for a solid sphere, 1/3 for a thin shell). No sphere
        has a larger k than 1/3, of which Python warns once.
    g : float
        Gravity, eq. (20), 0 < g < k: beyond it a ball at rest is flat. `Ball.dimensionless` is the
        way to any E/g^2.
    map : ImpactMap, optional
        How the next impact is found; by default the march, which in exact arithmetic misses none.

    Raises
    ------
    ValueError
        k or g is out of range. Methods raise it for a state with xdot + udot < 0, those that take
        an energy for one outside `energy_bounds`, and `impact` for one state whose flight is too
        long. Numbers are compared as decimals, as in config.yaml.

    References
    ----------
    Equations are those of Kanso and Papadopoulos, "Dynamics of pseudo-rigid ball impact on rigid
    foundation".

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> ball = Ball(k=0.2, g=0.04)
    >>> x, xdot, udot, tau = ball.impact(*ball.start(0.5, 0.01))
    >>> abs(ball.energy(x, xdot, udot) - 0.01) < 1e-15
    True
    """

    k: float
    g: float
    map: ImpactMap = field(default_factory=ImpactMap)
    _bounded: bool = field(default=True, init=False, repr=False, compare=False)  # by eq. (31)

    if TYPE_CHECKING:  # other numbers become floats

        def __init__(self, k: SupportsFloat, g: SupportsFloat, map: ImpactMap = ...) -> None: ...

    def __post_init__(self) -> None:
        k = number("k", self.k, bounds.K_ALLOWED, lambda v: 0.0 < v <= 1.0)
        g = number("g", self.g, bounds.G_ALLOWED, lambda v: v > 0.0)
        if words := bounds.g_mistake(k, g):
            raise not_allowed("g", self.g, words)
        object.__setattr__(self, "k", k)
        object.__setattr__(self, "g", g)
        if not isinstance(self.map, ImpactMap):
            raise not_allowed("map", self.map, "an ImpactMap")
        if k > bounds.LARGEST_OF_SPHERES:
            warnings.warn(bounds.NO_SPHERE, stacklevel=1)  # from one place: Python says it once

    @classmethod
    def dimensionless(cls, k: SupportsFloat) -> Self:
        """Return a ball with lengths in g R, thus g = 1, and with energies E/g^2.

        Its map is that of every ball with this k and E/g^2, apart from scale. Without R, eq. (31)
        does not bound the energy; it has to be above -1/(2k).

        >>> from pseudorigid import Ball
        >>> Ball.dimensionless(0.2).section(300.0)[0]
        5.0
        """
        return cls.unbounded(k, 1.0)

    @classmethod
    def unbounded(cls, k: SupportsFloat, g: SupportsFloat, map: ImpactMap | None = None) -> Self:
        """Return a ball whose lengths are in another unit than R, so that eq. (31) is no bound.

        Parameters
        ----------
        k, g : float, 0 < k <= 1 and g > 0
        map : ImpactMap, optional
        """
        ball = object.__new__(cls)
        k = number("k", k, bounds.K_ALLOWED, lambda v: 0.0 < v <= 1.0)
        g = number("g", g, "a number above 0", lambda v: v > 0.0)
        for name, value in {"k": k, "g": g, "map": map or ImpactMap(), "_bounded": False}.items():
            object.__setattr__(ball, name, value)
        return ball

    @np.errstate(over="ignore", invalid="ignore")
    def energy(self, x: Reals, xdot: Reals, udot: Reals) -> Result:
        """Return the total energy, eq. (29): xdot^2/2 + k udot^2/2 - g x + k x^2/2.

        Parameters
        ----------
        x, xdot, udot : array_like, in R, omega R and omega
        """
        x, xdot, udot = coordinates(x=x, xdot=xdot, udot=udot)
        kinetic = 0.5 * xdot * xdot + 0.5 * self.k * udot * udot
        return _plain(kinetic - self.g * x + 0.5 * self.k * x * x)

    def energy_bounds(self) -> tuple[float, float]:
        """Return the bounds of the energy, both of which are excluded, to the nearest double.

        They are -g^2/(2k), at rest on the floor, and k/2 - g, eq. (31), which is to keep u > -1, in
        m omega^2 R^2. The latter bounds no `dimensionless` ball. Energies with flights longer than
        10^6/omega are refused too.
        """
        exact = energy_bounds(bounds.as_decimal(self.k), bounds.as_decimal(self.g))
        lowest, highest = map(float, exact)
        return lowest, highest if self._bounded else math.inf

    def section(self, energy: Reals) -> tuple[float, Any]:
        """Return the section's centre and radius (R); ValueError outside `energy_bounds`.

        On y = 0 x runs from centre - radius to centre + radius. In the chart (x, y = xdot - k udot)
        the section is the disk y^2/(1+k) + k (x - g/k)^2 <= 2E + g^2/k.

        Parameters
        ----------
        energy : array_like, in m omega^2 R^2
        """
        (energy,) = coordinates(energy=energy)
        self._require_energy(energy)
        return self.g / self.k, _plain(np.sqrt(formulas.radius_squared(self.k, self.g, energy)))

    @np.errstate(over="ignore", invalid="ignore")
    def state(self, x: Reals, xdot: Reals, energy: Reals, branch: Literal[1, -1] = 1) -> State:
        """Return (x, xdot, udot) with this energy, eq. (29).

        Raises ValueError if the energy surface has no such point with xdot + udot >= 0.

        Parameters
        ----------
        x, xdot, energy : array_like, in R, omega R and m omega^2 R^2
        branch : {1, -1}
            Of two states with this x, xdot and energy, 1 selects the one with the larger udot.
        """
        sign = number("branch", branch, "1 or -1", lambda v: abs(v) == 1.0)
        x, xdot, energy = coordinates(x=x, xdot=xdot, energy=energy)
        self._require_energy(energy)
        square = (2.0 * energy + 2.0 * self.g * x - self.k * x * x - xdot * xdot) / self.k
        if not np.all((square >= 0.0) | np.isnan(x)):
            raise ValueError("no state with this x, xdot and energy: too little kinetic energy")
        udot = sign * np.sqrt(square)
        if not np.all((xdot + udot >= 0.0) | np.isnan(x)):
            raise ValueError("no state with this x, xdot and energy on the section, eq. (22)")
        return _plain(x), _plain(xdot), _plain(udot)

    @np.errstate(over="ignore", invalid="ignore")
    def state_xy(self, x: Reals, y: Reals, energy: Reals) -> State:
        """Return (x, xdot, udot) at a point of the chart (x, y = xdot - k udot).

        The map keeps areas in this chart. Raises ValueError for a point outside the section's disk.

        Parameters
        ----------
        x, y, energy : array_like, in R, omega R and m omega^2 R^2
        """
        x, y, energy = coordinates(x=x, y=y, energy=energy)
        self._require_energy(energy)
        square = formulas.contact_speed_squared(self.k, self.g, energy, x, y)
        if not np.all((square >= 0.0) | np.isnan(x)):
            raise ValueError("no state with this x, y and energy: the point is outside the section")
        x, xdot, udot = formulas.chart_state(self.k, self.g, energy, x, y)
        return _plain(x), _plain(xdot), _plain(udot)

    def start(self, fraction: Reals, energy: Reals) -> State:
        """Return (x, xdot, udot) on y = 0, at a fraction of the section's radius from its centre.

        Raises ValueError beyond the rim, and for an energy outside `energy_bounds`.

        Parameters
        ----------
        fraction, energy : array_like, from -1 to 1 and in m omega^2 R^2
        """
        f, energy = coordinates(fraction=fraction, energy=energy)
        self._require_energy(energy)
        if not np.all((np.abs(f) <= 1.0) | np.isnan(f)):
            raise ValueError("a start is a fraction of the section's radius, from -1 to 1")
        x, xdot, udot = formulas.start(self.k, self.g, energy, f)
        return _plain(x), _plain(xdot), _plain(udot)

    @np.errstate(over="ignore", invalid="ignore")
    def reflect(self, x: Reals, xdot: Reals, udot: Reals) -> State:
        """Apply the reversor R, (x, y) -> (x, -y).

        It reverses the velocities after the impact, eq. (25). R is its own inverse, and R F R is
        the inverse of the impact map F.

        Parameters
        ----------
        x, xdot, udot : array_like, in R, omega R and omega
        """
        x, xdot, udot = self.on_section(x, xdot, udot)
        b, c, _ = rebound(xdot, udot, self.k, impact_coefficients(self.k))
        return _plain(x), _plain(-b), _plain(np.maximum(-c, b))

    def time_to_impact(self, x: Reals, xdot: Reals, udot: Reals) -> Result:
        """Return the time to the next impact: the smallest positive root of eq. (21) with (26).

        It is in 1/omega, and 0 where the ball does not leave the floor: at rest on it, or pressed
        down on the rim xdot + udot = 0.

        Parameters
        ----------
        x, xdot, udot : array_like, in R, omega R and omega
        """
        return self.impact(x, xdot, udot)[3]

    def impact(self, x: Reals, xdot: Reals, udot: Reals) -> NextState:
        """Apply the impact map, eq. (28): return x, xdot, udot and tau.

        They are the state just before the next impact, and the time of flight, eq. (27), in
        1/omega. Where the ball only touches the floor, tau is defined to the square root of a
        rounding.

        Parameters
        ----------
        x, xdot, udot : array_like, in R, omega R and omega
        """
        state = self.on_section(x, xdot, udot)
        after = [_plain(a.reshape(state[0].shape)) for a in self.after(state)]
        require_short_flights(state, after)
        return tuple(after)

    def inverse_impact(self, x: Reals, xdot: Reals, udot: Reals) -> NextState:
        """Return x, xdot, udot just before the previous impact, and tau since then: F^-1 = R F R.

        Parameters
        ----------
        x, xdot, udot : array_like, in R, omega R and omega
        """
        *state, tau = self.impact(*self.reflect(x, xdot, udot))
        return *self.reflect(*state), tau

    def jacobian(
        self, x: Reals, xdot: Reals, udot: Reals, impacts: SupportsIndex = 1
    ) -> np.ndarray:
        """Return the Jacobian of some iterates of the map by (x, xdot, udot), eq. (33).

        The shape is (..., 3, 3). Row i, column j has the derivative of the i-th new variable by the
        j-th old one. It is not finite where the next impact grazes, xdot + udot = 0, because the
        map has no derivative there.

        Parameters
        ----------
        x, xdot, udot : array_like, in R, omega R and omega
        impacts : int, the number of iterates, at least 1
        """
        impacts = whole_number("impacts", impacts)
        state = self.on_section(x, xdot, udot)
        out = np.empty((state[0].size, 3, 3))
        columns = (a.flatten() for a in state)
        missed = kernel.jacobians(*columns, self.k, self.g, impacts, out, self.map.scan)
        self.map.count(impacts * state[0].size, missed)
        return out.reshape(*state[0].shape, 3, 3)

    @np.errstate(all="ignore")
    def chart_jacobian(
        self, x: Reals, xdot: Reals, udot: Reals, impacts: SupportsIndex = 1
    ) -> Rows:
        """Return the Jacobian in the chart (x, y = xdot - k udot) at one state and a fixed energy.

        It is two rows of two floats with determinant 1, eq. (42); they are not finite on the rim.

        Parameters
        ----------
        x, xdot, udot : float, in R, omega R and omega
        impacts : int, the number of iterates, at least 1
        """
        x, xdot, udot = self.on_section(x, xdot, udot)
        if x.shape:
            raise ValueError(f"one state is needed, not an array of shape {x.shape}")
        k, g = self.k, self.g
        s, y = float(xdot + udot), float(xdot - k * udot)
        # Derivatives of s by x and y, and the columns of derivatives of the state by x and y.
        unit = np.array([0.0, 1.0])
        slope = np.array([(1.0 + k) * (g - k * x), -y]) / (k * s)
        along = np.stack((1.0 - unit, (k * slope + unit) / (1.0 + k), (slope - unit) / (1.0 + k)))
        j = self.jacobian(x, xdot, udot, impacts)
        dx, dv, dw = (j[:, :, None] * along).sum(axis=1)
        return tuple(dx.tolist()), tuple((dv - k * dw).tolist())

    def on_section(self, x: Reals, xdot: Reals, udot: Reals) -> Arrays:
        """Read a state as arrays of one shape; raise ValueError if xdot + udot < 0, eq. (22).

        Parameters
        ----------
        x, xdot, udot : array_like, in R, omega R and omega
        """
        x, xdot, udot = coordinates(x=x, xdot=xdot, udot=udot)
        if np.any(xdot < -udot):  # the sum could overflow
            raise ValueError("a state just before an impact has xdot + udot >= 0, eq. (22)")
        return x, xdot, udot

    def moving(self, state: Any) -> Arrays:
        """Read states of a ball that eq. (31) keeps from becoming flat, as arrays of one shape.

        Raises ValueError off the section, and for energies above the bound by more than roundings.

        Parameters
        ----------
        state : (x, xdot, udot), array_like in R, omega R and omega
        """
        states = self.on_section(*state_of(state))
        energy, highest = np.asarray(self.energy(*states)), self.energy_bounds()[1]
        above = energy > highest + _ROUNDINGS * self.k
        if np.any(above):
            words = bounds.energy_mistake(self.k, self.g, float(energy[above][0]))
            raise not_allowed("energy of the state", float(energy[above][0]), words)
        return states

    def after(self, states: Iterable[Reals], impacts: int = 1) -> np.ndarray:
        """Return x, xdot, udot and tau, (4, n), some impacts after n states.

        Parameters
        ----------
        states : (x, xdot, udot), array_like in R, omega R and omega
        impacts : int, at least 1
        """
        return np.stack(self._advanced(states, impacts, 0)[0])

    def history(self, states: Iterable[Reals], impacts: int) -> np.ndarray:
        """Return x, xdot, udot and tau of each impact, (n, impacts, 4), after n states.

        Parameters
        ----------
        states : (x, xdot, udot), array_like in R, omega R and omega
        impacts : int, at least 1
        """
        return self._advanced(states, impacts, impacts)[1]

    def _require_energy(self, energy: np.ndarray) -> None:
        """Raise ValueError for an energy that config.yaml refuses too; NaN is allowed."""
        least, largest = bounds.energy_range(self.k, self.g, self._bounded)
        outside = (energy < least) | (energy > largest)
        if np.any(outside):
            value = float(energy[outside][0])
            words = bounds.energy_mistake(self.k, self.g, value, self._bounded)
            raise not_allowed("energy", value, words)

    def _advanced(
        self, states: Iterable[Reals], impacts: int, kept: int
    ) -> tuple[list[np.ndarray], np.ndarray]:
        """Return the last impact of each state, and `kept` impacts: none, or all."""
        columns = [a.flatten() for a in self.on_section(*state_of(states))]
        columns.append(np.empty(columns[0].size))
        out = np.empty((columns[0].size, kept, 4))
        self.map.iterate(columns, self.k, self.g, impacts, out)
        return columns, out


def require_ball(ball: Any) -> None:
    """Raise ValueError for what is no ball."""
    if not isinstance(ball, Ball):
        raise not_allowed("ball", ball, "a Ball")


def require_short_flights(state: Arrays, after: Iterable[Any]) -> None:
    """Raise ValueError if the flights after one state, which is finite, end in NaN."""
    if not state[0].shape and np.isfinite(state[0]) and any(np.isnan(a) for a in after):
        raise ValueError("a flight lasts 2^20/omega or longer: take a larger g or a lower energy")


def _plain(array: Any) -> Any:
    """Return a 0-dimensional result as a float."""
    return float(array) if np.ndim(array) == 0 else array
