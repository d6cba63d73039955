"""Rows of the benchmark on cells of a sweep, and on what methods that classify orbits carry along.

Cells are drawn at random over the plane of the atlas.
"""

import math
from typing import Any

import numpy as np

from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.verdict import windows
from pseudorigid.kernel import lanes
from pseudorigid.kernel.arithmetic import narrow_log
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.impact import impact_coefficients
from pseudorigid.kernel.tangents import (
    CHUNK,
    GROUP,
    V,
    W,
    X,
    advance_chunk,
    allocate_buffers,
    begin,
    propagate_with_tangent,
    push_tangent,
    turn_between,
)
from study.bench import Call

from .cell import numbers_of_cells
from .starts import sunflower_points
from .verdicts import random_cells

CELLS = 3, 6  # values of k, and energies of each
CELL = "a cell here"
# What orbits in lanes carry along -> tangent vectors, and whether their turns are counted. The
# ratios are the times of `verdicts.METHODS`.
CARRIED = {
    "an impact in lanes": (0, False),
    "with turns": (0, True),
    "with a tangent vector": (1, False),
    "with two tangent vectors": (2, False),
    "with a tangent vector and turns": (1, True),
}
IMPACTS = 50 * CHUNK


def calls() -> dict[str, Call]:
    """Return the calls that compute cells, and those that follow orbits, by name."""
    rows = np.reshape(random_cells(math.prod(CELLS), 2), (*CELLS, 2)).tolist()
    drawn = [(row[0][0], e) for row in rows for _, e in row]
    turning, growing = windows((4000,))
    base = next(iter(CARRIED))

    def each_to_the_end() -> None:
        for k, e in drawn:
            x, _, rotation = fixed_point.numbers(k, e)
            for point in np.stack(sunflower_points(k, e, 200)).T:
                sums = np.zeros((len(turning), 1)), np.zeros((len(growing), 1))
                one = begin(k, point[:, None], x, rotation)
                propagate_with_tangent(one, k, 0, 4000, turning, growing, *sums)

    def followed(vectors: int, turns: bool) -> Call:
        states = sunflower_points(0.2, 6.25, GROUP)
        to = "" if (vectors, turns) == CARRIED[base] else base
        return Call(lambda: _follow(*states, 0.2, IMPACTS, vectors, turns), GROUP * IMPACTS, to)

    return {
        CELL: Call(lambda: numbers_of_cells(drawn, 200, 8000), len(drawn)),
        "a cell, each orbit alone and to its end": Call(
            each_to_the_end, len(drawn), CELL, "at least 8"
        ),
    } | {name: followed(*carried) for name, carried in CARRIED.items()}


def lines(seconds: dict[str, tuple[float, float, float]]) -> list[str]:
    """Return what cells take, by the median, lowest and highest seconds of one."""
    middle = seconds[CELL][0]
    return [f"a cell: {1e3 * middle:.4g} ms; a million: {1e6 * middle / 3600:.1f} core hours"]


@jit
def _follow(x: Any, v: Any, w: Any, k: float, impacts: int, vectors: int, turns: bool) -> Any:
    """Follow at most GROUP orbits with unit tangent vectors, and count turns if `turns` is true."""
    n, coefficients = x.size, impact_coefficients(k)
    x, v, w, tau = x.copy(), v.copy(), w.copy(), np.empty(n)
    states, flights = allocate_buffers()
    out = states.reshape(4, CHUNK + 1, GROUP)[:, 1:, :n].transpose(2, 1, 0)
    tangents, sums = np.ones(3 * vectors * GROUP), np.zeros(GROUP)
    for _ in range(impacts // CHUNK):
        if vectors:
            advance_chunk(x, v, w, k, 1.0, CHUNK, states, flights, None)
        else:
            states[X : X + n], states[V : V + n], states[W : W + n] = x, v, w
            lanes.iterate(x, v, w, k, 1.0, CHUNK, tau, out)
        for row in range(0, CHUNK * GROUP, GROUP):
            for vector in range(0, 3 * vectors * GROUP, 3 * GROUP):
                at = max(vector, 0), max(row, 0)
                _carry(tangents, *at, n, k, coefficients, states, flights, sums)
            if turns:
                _turn(max(row, 0), n, k, states, sums)
    return sums


@jit
def _carry(
    tangents: Any, vector: int, row: int, n: int, k: float, coefficients: Any, states: Any,
    flights: Any, sums: Any,
) -> None:  # fmt: skip
    """Carry a tangent vector of each orbit over an impact."""
    for i in range(n):
        at = vector + i
        a, b, c = tangents[at], tangents[at + GROUP], tangents[at + 2 * GROUP]
        a, b, c = push_tangent(a, b, c, k, 1.0, coefficients, states, flights, row + i)
        size = (abs(a) + abs(b)) + abs(c)
        sums[i] += narrow_log(size)
        tangents[at], tangents[at + GROUP] = a / size, b / size
        tangents[at + 2 * GROUP] = c / size


@jit
def _turn(row: int, n: int, k: float, states: Any, sums: Any) -> None:
    """Add the turn of each orbit around the centre of the section."""
    for i in range(n):
        at = row + i
        p, q = states[X + at] - 5.0, states[V + at] - k * states[W + at]
        at += GROUP
        r, s = states[X + at] - 5.0, states[V + at] - k * states[W + at]
        sums[i] += turn_between(p, q, r, s, 0.2)
