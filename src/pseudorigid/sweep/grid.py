"""The grid of a sweep over k and E/g^2: its cells, and the blocks they are computed in.

Cells are counted along the energies of one k, then the next k. Importing this module is cheap.
"""


def cells(sweep) -> int:
    """How many cells a sweep has.

    Parameters
    ----------
    sweep : dict
        Of the config: k and energy are lists of numbers.

    Returns
    -------
    int
    """
    return len(sweep["k"]) * len(sweep["energy"])


def ranges(sweep) -> list[tuple[int, int]]:
    """How a sweep is cut into blocks.

    Parameters
    ----------
    sweep : dict
        Of the config.

    Returns
    -------
    list of (int, int)
        Of each block, its first cell and the one after its last.
    """
    count, size = cells(sweep), sweep["block"]
    return [(start, min(start + size, count)) for start in range(0, count, size)]


def block(sweep, number) -> dict:
    """What decides the data of a block.

    Parameters
    ----------
    sweep : dict
        Of the config.
    number : int
        Of the block, from 0.

    Returns
    -------
    dict
        Its cells as [k, E/g^2], and starts and impacts, the orbits of each.
    """
    start, stop = ranges(sweep)[number]
    across = len(sweep["energy"])
    return {
        "cells": [
            [sweep["k"][i // across], sweep["energy"][i % across]] for i in range(start, stop)
        ],
        "starts": sweep["starts"],
        "impacts": sweep["impacts"],
    }


def whole(sweep) -> dict:
    """What decides the data of a sweep: not how it is cut into blocks.

    Parameters
    ----------
    sweep : dict
        Of the config.

    Returns
    -------
    dict
    """
    return {key: sweep[key] for key in ("k", "energy", "starts", "impacts")}
