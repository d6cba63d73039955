"""Certificates of the bands over which the fixed point's twist has one zero."""

from fractions import Fraction

from flint import ctx

from pseudorigid.verified.flight import NotProvedError

from ..checkers.fixed_point import energy_at
from ..checkers.one_zero import BITS, ZEROS, over_band
from ..enclosure.surface import ball_of
from .certificate_text import Theorem, ball_header, bisected, fixed, rows

_WIDTHS = [Fraction(n, 1000) for n in (50, 40, 30, 25, 20, 15, 10, 8, 6, 5, 4, 3, 2, 1)]
_LAST = Fraction("2.4")  # theta beyond which no band is tried
_DECIMALS = 22  # of theta at a zero


def propose(theorem: Theorem) -> str:
    """Return a certificate of the bands of theta up to the theorem's energy.

    Each band is the widest of a list over which the signs are decided. Raises ValueError where
    there is none.
    """
    k, g, energy = (theorem.bounds[name] for name in ("k", "g", "energy"))
    with ctx.workprec(BITS):
        edges = [Fraction(0), _widest(k, g, Fraction(0))]
        while not energy_at(ball_of(k), ball_of(g), ball_of(edges[-1])) > ball_of(energy):
            edges.append(edges[-1] + _widest(k, g, edges[-1]))
        zeros = {}
        for name in ZEROS:

            def is_positive(theta: Fraction, name: str = name) -> bool:
                return getattr(over_band(k, g, theta, theta), name).value > 0

            zeros[name] = bisected(is_positive, edges[1], edges[-1], _DECIMALS)
    return (
        ball_header("one zero of the twist", k, g)
        + f'energy_up_to = "{energy}"\n'
        + "".join(f"{name} = [{fixed(a, _DECIMALS)}, {fixed(b, _DECIMALS)}]\n"
                  for name, (a, b) in zeros.items())
        + rows("edges", (f"[{float(edge):.3f}]" for edge in edges))
    )  # fmt: skip


def _widest(k: Fraction, g: Fraction, low: Fraction) -> Fraction:
    """Return the width of the widest band over which the signs are decided."""
    for width in _WIDTHS:
        if low + width > _LAST:
            continue
        try:
            *pairs, _ = over_band(k, g, low, low + width)
        except NotProvedError:
            continue
        if all(value > 0 or value < 0 or slope < 0 for value, slope in pairs):
            return width
    raise ValueError(f"no band from theta = {float(low):g} on has a sign")
