"""Rows of the benchmark on cells of a sweep, drawn at random over the plane of the atlas."""

import math

import numpy as np

from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.verdict import windows
from pseudorigid.kernel.tangents import begin, propagate_with_tangent
from study.bench import Call

from .cell import numbers_of_cells
from .starts import sunflower_points
from .verdicts import random_cells

CELLS = 3, 6  # values of k, and energies of each
CELL = "a cell here"


def calls() -> dict[str, Call]:
    """Return the calls that compute cells, by name."""
    rows = np.reshape(random_cells(math.prod(CELLS), 2), (*CELLS, 2)).tolist()
    drawn = [(row[0][0], e) for row in rows for _, e in row]
    turning, growing = windows((4000,))

    def each_to_the_end() -> None:
        for k, e in drawn:
            x, _, rotation = fixed_point.numbers(k, e)
            for point in np.stack(sunflower_points(k, e, 200)).T:
                sums = np.zeros((len(turning), 1)), np.zeros((len(growing), 1))
                one = begin(k, point[:, None], x, rotation)
                propagate_with_tangent(one, k, 0, 4000, turning, growing, *sums)

    return {
        CELL: Call(lambda: numbers_of_cells(drawn, 200, 8000), len(drawn)),
        "a cell, each orbit alone and to its end": Call(
            each_to_the_end, len(drawn), CELL, "at least 8"
        ),
    }


def lines(seconds: dict[str, tuple[float, float, float]]) -> list[str]:
    """Return what cells take, by the median, lowest and highest seconds of one."""
    middle = seconds[CELL][0]
    return [f"a cell: {1e3 * middle:.4g} ms; a million: {1e6 * middle / 3600:.1f} core hours"]
