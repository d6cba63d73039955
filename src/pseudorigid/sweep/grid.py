"""The grid of a sweep over k and E/g^2: its cells, and the blocks that are computed at once.

A sweep is a mapping of config.yaml, in which `k` and `energy` are lists of numbers. Cells are
counted along the energies of one k, then along those of the next k.
"""

from itertools import islice, product


def cells(sweep: dict) -> int:
    """Number of cells of a sweep."""
    return len(sweep["k"]) * len(sweep["energy"])


def ranges(sweep: dict) -> list[tuple[int, int]]:
    """First cell of each block of a sweep, and the cell after its last one."""
    count, size = cells(sweep), sweep["block"]
    return [(start, min(start + size, count)) for start in range(0, count, size)]


def block(sweep: dict, number: int) -> dict:
    """Parameters that decide the data of a block, counted from 0: cells [k, E/g^2] and orbits."""
    cells = islice(product(sweep["k"], sweep["energy"]), *ranges(sweep)[number])
    return {"cells": [*map(list, cells)], "starts": sweep["starts"], "impacts": sweep["impacts"]}


def whole(sweep: dict) -> dict:
    """Parameters that decide the data of a sweep. The size of its blocks is none of them."""
    return {key: sweep[key] for key in ("k", "energy", "starts", "impacts")}
