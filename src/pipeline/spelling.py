"""Suggest the name that was probably meant by an unknown one."""

import difflib
from collections.abc import Iterable


def suggestion(name: object, known: Iterable[str]) -> str:
    """Ask whether the nearest known names were meant; empty if none is near.

    Several names, at most three, are suggested only if they are equally near.
    """
    text = str(name)
    near = difflib.get_close_matches(text, list(dict.fromkeys(known)), 20, 0.6)
    ratios = {other: difflib.SequenceMatcher(None, other, text).ratio() for other in near}
    best = sorted(other for other in near if ratios[other] == max(ratios.values()))[:3]
    if not best:
        return ""
    return f"did you mean {' or '.join(filter(None, [', '.join(best[:-1]), best[-1]]))}?"
