"""What is drawn, by the methods that most people use: exponents, periodic orbits and branches.

The work of orbits and branches is the number of impacts computed, which all of these methods spend
in the same map; that of exponents is evaluations an impact. This prints the tables of
src/study/README.md, after ./reproduce study has installed the libraries:

    PYTHONPATH=src .venv/bin/python tests/study/consumers.py

Its ratios of time are to be taken from an idle machine.
"""

import itertools
import math
import time
from collections.abc import Iterator
from functools import partial

import numpy as np

from pseudorigid.dynamics.ball import Ball, State
from pseudorigid.dynamics.branch import Branch
from pseudorigid.dynamics.lyapunov import lyapunov_spectrum
from pseudorigid.dynamics.periodic import symmetric_orbits
from pseudorigid.dynamics.variables import of_type, states_of
from study import figure_errors
from study.methods import Method, libraries
from study.methods.counted_methods import OURS, careful_method
from study.states import BALL, ENERGY, uniform

PERIODS = 6, 20
STARTS = 500  # of Newton's method, drawn uniformly from the section
NEWTON_STEPS, HALVINGS = 50, 8
CLOSED, SAME = 1e-10, 1e-6  # R: gap of an orbit that is found; distance between points of one
POINTS = 100, 1_000, 10_000  # of an image of the first segment by plain resampling
LENGTH = 2.8  # of the branch, in section radii
SEA_STARTS, ISLAND_START = 0.52 + 0.01 * np.arange(10), 0.2  # in section radii
IMPACTS = 3_000  # of each orbit whose exponent is computed
METHODS = "symmetry lines", "Newton, as usually written", "Newton with halved steps"


def found_orbits(period: int, method: int) -> tuple[int, int]:
    """Return how many orbits of a period a method finds, and the impacts that it computes."""
    ball = Ball(BALL.k, BALL.g)
    if method == 0:
        orbits = symmetric_orbits(ball, ENERGY, period)
        return orbits.sizes["orbit"], ball.map.impacts
    columns = uniform(STARTS)
    points = [_newton(ball, start, period, method == 2) for start in columns.T]
    found: set[tuple[int, ...]] = set()
    for state in filter(None, points):
        track = ball.history(np.array(state)[:, None], period)[0, :, :3]
        divisors = [m for m in range(1, period) if period % m == 0]
        if all(np.abs(track[m - 1] - state).max() > SAME for m in divisors):
            found.add(min(tuple(np.round(row / SAME).astype(int).tolist()) for row in track))
    distinct = sorted(found)
    close = (abs(a - b) <= 2 for (a, *_), (b, *_) in itertools.pairwise(distinct))
    return len(distinct) - sum(close), ball.map.impacts


def _newton(ball: Ball, start: np.ndarray, period: int, halved: bool) -> tuple[float, ...] | None:
    """Return the periodic point to which Newton's method goes, if it does."""
    x, xdot, udot = start.tolist()
    y, step, best = xdot - ball.k * udot, (0.0, 0.0), math.inf
    for _ in range(NEWTON_STEPS):
        for half in range(HALVINGS if halved else 1):
            share = 0.5**half
            try:
                state = ball.state_xy(x + share * step[0], y + share * step[1], ENERGY)
            except ValueError:  # off the section
                continue
            x1, v1, w1, _ = ball.after(np.array(state)[:, None], period)[:, 0].tolist()
            fx = x1 - x - share * step[0]
            fy = v1 - ball.k * w1 - y - share * step[1]
            if not halved or math.sqrt(fx * fx + fy * fy) < best:
                break
        else:
            return None
        best = math.sqrt(fx * fx + fy * fy)
        if best < CLOSED:
            return tuple(map(float, state))
        x, y = x + share * step[0], y + share * step[1]
        (a, b), (c, d) = ball.chart_jacobian(*state, period)
        determinant = (a - 1.0) * (d - 1.0) - b * c
        if not 0.0 < abs(determinant) < math.inf:
            return None
        step = ((b * fy - (d - 1.0) * fx) / determinant, (c * fx - (a - 1.0) * fy) / determinant)
    return None


def branches() -> Iterator[tuple[np.ndarray, int]]:
    """Yield polylines of an outer branch of Figure 5, and the impacts that each takes.

    First comes a fine one, then the usual one of this package, then images of a segment with
    POINTS points each, as many images as reach the length.
    """
    ball = Ball(BALL.k, BALL.g)
    points = states_of(of_type(symmetric_orbits(ball, ENERGY, 6), "hyperbolic"))
    for distance, bend in (0.001, 2.0), (0.01, 10.0):
        branch, before = Branch(ball, ENERGY, points, 0, "outer", False), ball.map.impacts
        line = branch.trace(LENGTH, distance, bend, None)
        yield line, ball.map.impacts - before
    images = math.ceil(branch.u[-1])
    for count in POINTS:
        branch, before = Branch(ball, ENERGY, points, 0, "outer", False), ball.map.impacts
        lines = []
        states = branch._from_segment(np.arange(count) / count)
        for _ in range(images):
            lines.append(states)
            states = ball.after(states, branch.period)[:3]
        yield np.concatenate(lines, axis=1), ball.map.impacts - before


def largest_distance(vertices: np.ndarray, polyline: np.ndarray) -> float:
    """Return the largest distance of vertices (3, n) from a polyline (3, m), in section radii."""
    start, side = polyline[:, :-1], np.diff(polyline)
    length = np.maximum(np.sum(side * side, axis=0), 1e-300)
    worst = 0.0
    for vertex in vertices[:, ~np.isnan(vertices[0])].T:
        along = np.sum((vertex[:, None] - start) * side, axis=0) / length
        nearest = start + np.clip(along, 0.0, 1.0) * side
        worst = max(worst, float(np.nanmin(np.sum((nearest - vertex[:, None]) ** 2, axis=0))))
    return math.sqrt(worst) / float(BALL.section(ENERGY)[1])


def exponents() -> Iterator[tuple[str, np.ndarray, float, float]]:
    """Yield methods, with the largest exponent of each orbit, evaluations and seconds an impact.

    The last orbit is regular, the others lie in the sea. All methods but the first two follow an
    orbit and push a tangent vector along it by the analytic Jacobian.
    """
    states = [BALL.start(f, ENERGY) for f in (*SEA_STARTS, ISLAND_START)]

    def spectrum(state: State) -> tuple[float, float]:
        return lyapunov_spectrum(BALL, state, IMPACTS, 1)["exponent"].values.max(), math.nan

    def pynamicalsys(state: State) -> tuple[float, float]:
        return libraries.lyapunov_exponents(BALL, state, IMPACTS).max(), math.nan

    def loop(method: Method, state: State) -> tuple[float, float]:
        columns, work = [np.array(state)[:, None]], 0
        for _ in range(IMPACTS):
            tau, count = method.solve(BALL, *columns[-1])
            x, xdot, udot = figure_errors._next_states(BALL, columns[-1], tau)
            columns.append(np.array([x, xdot, np.maximum(udot, -xdot)]))
            work += int(count[0])
        jacobians = BALL.jacobian(*np.concatenate(columns[:-1], axis=1))
        return figure_errors._log_stretch(jacobians) / IMPACTS, work / IMPACTS

    loops = (OURS, careful_method(0.5), libraries.ivp_method("DOP853", 1e-9))
    loops += (libraries.ivp_method("DOP853", 1e-9, False), libraries.cyrk_method("DOP853", 1e-9))
    ways = {"spectrum of this package": spectrum, "pynamicalsys": pynamicalsys}
    ways |= {f"loop around {method.name}": partial(loop, method) for method in loops}
    for name, way in ways.items():
        way(states[0])  # which compiles
        start = time.process_time()
        values, work = zip(*map(way, states), strict=True)
        seconds = (time.process_time() - start) / (IMPACTS * len(states))
        yield name, np.array(values), float(np.mean(work)), seconds


if __name__ == "__main__":
    rows = [*exponents()]
    for name, values, work, seconds in rows:
        *sea, regular = values
        error = np.std(sea, ddof=1) / math.sqrt(len(sea))
        print(f"exponents, {name}: sea {np.mean(sea):.4f} +- {error:.4f}, regular {regular:.9f},")
        print(f"    {work:.3g} evaluations, {seconds / rows[0][-1]:.3g} times the first")
    for n in PERIODS:
        for index, name in enumerate(METHODS):
            orbits, impacts = found_orbits(n, index)
            print(f"period {n}, {name}: {orbits} orbits, {impacts:,} impacts")
    (fine, _), *ways = branches()
    for (line, impacts), name in zip(ways, ("inserted", *POINTS), strict=True):
        off = largest_distance(fine, line)
        print(f"branch, {name}: {line.shape[1]:,} vertices, {impacts:,} impacts, off by {off:.1e}")
