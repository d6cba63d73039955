"""Periodic orbits and branches by the methods that most people use, plainly and with care.

The work is the number of impacts computed, which all of these methods spend in the same map. This
prints the tables of src/study/README.md:

    PYTHONPATH=src .venv/bin/python tests/study/consumers.py
"""

import itertools
import math
from collections.abc import Iterator

import numpy as np

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.branch import Branch
from pseudorigid.dynamics.periodic import symmetric_orbits
from pseudorigid.dynamics.variables import of_type, states_of
from study.states import BALL, ENERGY, uniform

PERIODS = 6, 20
STARTS = 500  # of Newton's method, drawn uniformly from the section
NEWTON_STEPS, HALVINGS = 50, 8
CLOSED, SAME = 1e-10, 1e-6  # R: gap of an orbit that is found; distance between points of one
POINTS = 100, 1_000, 10_000  # of an image of the first segment by plain resampling
LENGTH = 2.8  # of the branch, in section radii
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


if __name__ == "__main__":
    for n in PERIODS:
        for index, name in enumerate(METHODS):
            orbits, impacts = found_orbits(n, index)
            print(f"period {n}, {name}: {orbits} orbits, {impacts:,} impacts")
    (fine, _), *ways = branches()
    for (line, impacts), name in zip(ways, ("inserted", *POINTS), strict=True):
        off = largest_distance(fine, line)
        print(f"branch, {name}: {line.shape[1]:,} vertices, {impacts:,} impacts, off by {off:.1e}")
