"""The cells of a sweep over k and E/g^2, in the parts that are computed at once."""

from itertools import product
from typing import Any


def parts(sweep: dict[str, Any]) -> list[dict[str, Any]]:
    """Return what decides the data of each part of a sweep: cells [k, E/g^2] and orbits.

    Cells are counted along the energies of one k, then along those of the next k. A part has as
    many of them as the sweep's field `block` says.
    """
    cells, size = list(map(list, product(sweep["k"], sweep["energy"]))), sweep["block"]
    orbits = {name: sweep[name] for name in ("starts", "impacts")}
    return [{"cells": cells[i : i + size]} | orbits for i in range(0, len(cells), size)]
