"""Where the last invariant curve beyond a resonance breaks, by Greene's residue criterion.

An invariant curve with a noble rotation number is at the point of breaking if the residues of its
long convergents are near 1/4 (Greene, A method for determining a stochastic transition, J. Math.
Phys. 20, 1979): as the convergents get longer, residues tend to zero before and grow without bound
after it. Curves *beyond* p/q have rotation numbers on the other side of p/q than the fixed point's.
"""

import math
from collections.abc import Callable

from extensions.atlas.last_curve import OrbitSearch
from extensions.atlas.symmetry_line import symmetric_fixed_point
from pseudorigid.dynamics.ball import Ball

CRITICAL = 0.25  # size of a long convergent's residue at the breakup of a noble curve
_PERIOD = 500  # least period of the two convergents whose residues decide
_CELLS = 256  # from the fixed point to the rim, in which orbits are searched
_NOBLES = 512  # noble numbers, ever closer to the resonance
_HALVINGS = 16  # of the interval in which a curve breaks
_INNER, _OUTER = 1e-3, 0.999  # section radii: from the fixed point to a start, and to the rim


def breakup(
    ball_and_energy: Callable[[float], tuple[Ball, float]], turns: int, order: int,
    whole: float, broken: float,
) -> float:  # fmt: skip
    """Return the parameter at which the last invariant curve beyond a resonance breaks.

    The rotation numbers tried have the convergents (r + n p)/(s + n q), (r + (n + 1) p)/(s + (n +
    1) q), and after these always the one whose numerator and denominator are the sums of those of
    the last two. Here p/q is the resonance, r/s its neighbour on the side beyond it, and n is
    chosen so that the curve is the last one.

    Parameters
    ----------
    ball_and_energy : function
        Returns the ball and the energy at a value of the parameter.
    turns, order : int
        p and q of the resonance.
    whole, broken : float
        Parameters between which to search: some curve is whole at the first, all are broken at the
        second, and the fixed point's rotation number is on the same side of p/q at both.

    Returns
    -------
    float
        NaN if no curve breaks between the two, or one is whole at the second.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> ball = Ball(k=0.2, g=0.04)
    >>> breakup(lambda energy: (ball, energy), 1, 7, 0.0090, 0.0092)  # the sea
    nan
    """

    def is_whole(n: int, part: float) -> bool:
        ball, energy = ball_and_energy(whole + part * (broken - whole))
        return noble_residue(ball, energy, turns, order, n) < CRITICAL

    def broken_at(n: int, part: float) -> float:
        low, high = part, 1.0
        if is_whole(n, high):
            return math.inf
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if is_whole(n, middle) else (low, middle)
        return high

    # `last` is a share of the way from `whole` to `broken` at which all curves tried are broken;
    # another curve is better only if it is whole there.
    best, last = 0, 0.0
    for n in (1 << i for i in range(_NOBLES.bit_length() - 1)):
        if last < math.inf and is_whole(n, last):
            best, last = n, broken_at(n, last)
    step = best // 2
    while step and last < math.inf:
        near = (n for n in (best - step, best + step) if 0 < n < _NOBLES and is_whole(n, last))
        better = next(near, None)
        if better is None:
            step //= 2
        else:
            best, last = better, broken_at(better, last)
    return whole + last * (broken - whole) if best and last < math.inf else math.nan


def noble_residue(ball: Ball, energy: float, turns: int, order: int, n: int) -> float:
    """Return the larger residue, in size, of two long convergents of the n-th noble beyond p/q.

    It is infinite if no orbit of a convergent is found, as in the sea.
    """
    place, rotation = symmetric_fixed_point(ball, energy)
    p, q = neighbour(turns, order, rotation > turns / order)
    first, second = (p + n * turns, q + n * order), (p + (n + 1) * turns, q + (n + 1) * order)
    while first[1] < _PERIOD:
        first, second = second, (first[0] + second[0], first[1] + second[1])
    search = OrbitSearch(ball, energy, (place - _INNER, -_OUTER))
    largest = 0.0
    for convergent in (first, second):
        found = search.innermost(*convergent, _CELLS)
        largest = max(largest, math.inf if found is None else abs(found[1]))
        if largest > CRITICAL:
            break
    return largest


def neighbour(turns: int, order: int, below: bool) -> tuple[int, int]:
    """Return p and q of the neighbour of a fraction with a smaller denominator, below or above it.

    >>> neighbour(2, 7, True), neighbour(2, 7, False)
    ((1, 4), (1, 3))
    """
    if order == 1:
        return (turns - 1, 1) if below else (turns + 1, 1)
    # the denominator s solves p s = 1 or -1 modulo q
    s = pow(turns if below else -turns, -1, order)
    return (turns * s - (1 if below else -1)) // order, s
