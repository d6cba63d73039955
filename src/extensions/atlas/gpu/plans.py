"""What threads do between two lengths at which orbits are judged, as numbers that they read.

Windows of impacts are rows of sums. A plan is

    first impact, last impact, impacts of a window of growth,
    rows of the three sums of turns and of the two of growth that are judged, row of the first of
    the two logarithms for the exponent, 1 if undecided orbits are judged all the same

and segments, in which the same windows are open: the impact at which one ends, how many windows of
turns and of growth are open, for each of turns its row and the place in `shares` of the weight of
impact 0, and for each of growth its row.
"""

from typing import NamedTuple

import numpy as np

from pseudorigid.dynamics.verdict import all_windows, lengths_to_decide
from pseudorigid.kernel.tangents import bump, weight


class Level(NamedTuple):
    """A length at which orbits are judged, its plan, and three sums of weights of turns."""

    length: int
    plan: np.ndarray
    weights: np.ndarray


def levels(impacts: int) -> tuple[list[Level], np.ndarray, int]:
    """Return all levels, the weights `shares` of all windows of turns, and the number of sums."""
    lengths = lengths_to_decide(impacts)
    turning, growing = (windows.tolist() for windows in all_windows(lengths))
    rows = len(turning)
    places = np.cumsum([0] + [length for _, length in turning])
    shares = np.concatenate([bump(np.arange(length), length) for _, length in turning])
    found, start = [], 0
    for level, stop in enumerate(lengths):
        plan = [start, stop, stop // 4, 3 * level, rows + 2 * level, rows + 2 * len(lengths)]
        plan.append(int(stop == impacts))
        ends = {at for first, more in (*turning, *growing) for at in (first, first + more)}
        for end in sorted({at for at in ends if start < at < stop} | {stop}):
            turns, grows = (
                [row for row, (first, more) in enumerate(windows) if first < end <= first + more]
                for windows in (turning, growing)
            )
            plan += [end, len(turns), len(grows)]
            for row in turns:
                plan += [row, int(places[row]) - turning[row][0]]
            plan += [rows + row for row in grows]
        weights = [weight(length) for _, length in turning[3 * level : 3 * level + 3]]
        found.append(Level(stop, np.array(plan), np.array(weights)))
        start = stop
    return found, shares, rows + len(growing)
