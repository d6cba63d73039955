"""Speed of a card, beside one core and all cores of its machine; needs an NVIDIA card.

    PYTHONPATH=src .venv/bin/python tests/extensions/atlas/gpu_speed.py

The cells are drawn at random over the plane of the atlas, 200 orbits of at most 8,000 impacts each.
"""

import os
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

from extensions.atlas import cell
from extensions.atlas.gpu import card, cells

ORBITS = {"starts": 200, "impacts": 8000}


def drawn(count, seed):
    """Cells [k, E/g^2], of which k and the logarithm of E/g^2 are uniform."""
    low, high = [0.012, np.log(0.1)], [0.33, np.log(40.0)]
    k, logarithm = np.random.default_rng(seed).uniform(low, high, (count, 2)).T
    return np.column_stack([k, np.exp(logarithm)]).tolist()


def seconds(work):
    """The shorter time of two calls, and what the last one returned."""
    times = []
    for _ in range(2):
        start = time.perf_counter()
        found = work()
        times.append(time.perf_counter() - start)
    return min(times), found


def on_card(there, given):
    fixed = cells.fixed_points(given)
    return cells.classified(there, np.column_stack([given, fixed[:, [0, 2]]]), **ORBITS)


def on_core(seed):
    return len(cell.numbers_of_cells(drawn(40, seed), **ORBITS))


if __name__ == "__main__":
    taken, count = seconds(lambda: on_core(0))
    print(f"one core: {count / taken:.1f} cells/s")
    cores = os.cpu_count() or 1
    with ProcessPoolExecutor(cores) as pool:  # before CUDA starts
        taken, counts = seconds(lambda: [*pool.map(on_core, range(4 * cores))])
    print(f"{cores} cores: {sum(counts) / taken:.1f} cells/s")
    there = card.Card(Path(cells.__file__).with_name("kernel.ptx").read_bytes())
    given = drawn(20_000, 0)
    taken, verdicts = seconds(lambda: on_card(there, given))
    rates = f"{len(given) / taken:,.0f} cells/s, {verdicts.followed.sum() / taken:.3g} impacts/s"
    print(f"{there.name}, {there.driver}, {there.registers} registers: {rates}")
