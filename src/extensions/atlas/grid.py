"""The cells of a sweep over k and E/g^2, in the parts that are computed at once."""

from itertools import islice, product


def parts(sweep: dict) -> list[dict]:
    """Return what decides the data of each part of a sweep: cells [k, E/g^2] and orbits.

    Cells are counted along the energies of one k, then along those of the next k. A part has as
    many of them as the sweep's field `block` says.
    """
    cells = product(sweep["k"], sweep["energy"])
    orbits = {name: sweep[name] for name in ("starts", "impacts")}
    found = []
    while block := [*map(list, islice(cells, sweep["block"]))]:
        found.append({"cells": block} | orbits)
    return found
