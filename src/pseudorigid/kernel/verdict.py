"""The verdict on one orbit, regular or chaotic, from its sums over windows of impacts; compiled.

`dynamics.regularity` says what growth is, and `dynamics.verdict` when an orbit is judged.
"""

import math

from .compiled import jit

# Half the threshold still exceeds a regular orbit's 0.85.
GROWTH_THRESHOLD = 2.2
# An orbit is judged before its end only if the verdict holds with the threshold divided and
# multiplied by this factor; `strict` and `lenient` are the verdicts with these two.
MARGIN_FACTOR = 2.0
# Before its end an orbit is called regular only if the winding numbers of its halves differ by
# less (turns an impact): weighted Birkhoff averages converge fast on quasi-periodic orbits only.
WINDING_TOLERANCE = 1e-7
# Before its end an orbit is called chaotic only if G is larger than this: on a regular orbit G is
# about ln n after n impacts, 9.7 after 16,000.
MIN_CHAOTIC_G = 15.0
_STRICT, _LENIENT = GROWTH_THRESHOLD / MARGIN_FACTOR, GROWTH_THRESHOLD * MARGIN_FACTOR


@jit
def judge(turned, weights, grown, quarter, size, at_end):
    """Judge an orbit after a length of impacts.

    `turned` are three weighted sums of turns, over the whole length and its two halves, `weights`
    the sums of the weights; `grown` are sums of the logarithm of a tangent vector's length over two
    windows of `quarter` impacts, and `size` is that logarithm. Returns the winding number, the
    growth, whether the orbit is regular with the threshold, with half and with twice the threshold,
    and whether that is decided, as it is `at_end`.
    """
    growth = grown[1] / quarter - grown[0] / quarter
    strict = growth < _STRICT
    if at_end:
        regular, lenient, decided = growth < GROWTH_THRESHOLD, growth < _LENIENT, True
    else:
        difference = turned[1] / weights[1] - turned[2] / weights[2]
        strict = strict and abs(difference) < WINDING_TOLERANCE
        regular = lenient = strict
        chaotic = growth > _LENIENT and size > MIN_CHAOTIC_G
        decided = strict or chaotic or math.isnan(growth)
    return turned[0] / weights[0], growth, regular, strict, lenient, decided


@jit
def judge_each(turned, weights, grown, quarter, sizes, at_end, winding, growth, verdicts):
    """Judge orbits by sums (3, n) and (2, n) and sizes (n,), each as `judge` does.

    Writes winding numbers (n,), growths (n,), and verdicts (n, 4).
    """
    for i in range(sizes.size):
        turns, logarithms = (turned[0, i], turned[1, i], turned[2, i]), (grown[0, i], grown[1, i])
        found = judge(turns, weights, logarithms, quarter, sizes[i], at_end)
        winding[i], growth[i] = found[:2]
        verdicts[i, 0], verdicts[i, 1], verdicts[i, 2], verdicts[i, 3] = found[2:]
