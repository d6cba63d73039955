"""A horseshoe: h-sets at the points of a hyperbolic orbit and along a connection between them.

Sets S_0 ... S_(n-1) at the saddles cover each other in turn. A chain M_-K ... M_K leaves from S_a
and returns to S_b, so that S_a => M_-K => ... => M_K => S_b. theory/horseshoe.md has the
theorems, and what follows for the orbits of the impact map P.
"""

from fractions import Fraction
from itertools import pairwise
from math import gcd

from flint import arb, ctx

from pseudorigid.verified.flight import NotProvedError

from ..enclosure.surface import Surface, ball_of
from . import hsets, periodic
from .certificate import Certificate, Finding, Range, Window
from .hsets import HSet

BITS = 128  # the smallest sets are 1e-10 wide: 1e-38 is far finer than their margins

Edge = tuple[HSet, HSet]  # the first set covers the second one


def check(
    text: str,
    surface: Surface,
    *,
    period: int,
    radius: Fraction,
    entropy: Fraction,
    window: Window | None = None,
    crossing: Range | None = None,
) -> Finding:
    """Prove a certificate's horseshoe on an orbit of a period, with a point in the window.

    The orbit's least period must be `period`.

    The orbit must be the only one within `radius` of the centres of the sets S. `crossing` is an
    interval of x that must hold M_0: it singles out this connection. The entropy, in nats per
    impact, must be above `entropy`. In the Finding, margins are the least over all coverings, and
    parts are saddles and chain (lists of HSet), edges (pairs of HSet), margins (of each edge) and
    loop (impacts).
    """
    certificate = Certificate(text, "horseshoe", surface)
    orbit = periodic.prove_saddles(certificate, surface, period, radius, window)
    with ctx.workprec(BITS):
        saddles, chain, leaves, enters = _sets(certificate)
        hsets.check_contained(saddles, orbit.points)
        edges = [
            *pairwise([*saddles, saddles[0]]),
            *pairwise([saddles[leaves], *chain, saddles[enters]]),
        ]
        stated = certificate.numbers("margins", 2)  # beyond exit edges, and inside the others
        if len(stated) != len(edges):
            raise NotProvedError(f"there are {len(stated)} margins for {len(edges)} coverings")
        if (least := min(map(min, stated))) < 0:
            raise NotProvedError(f"a margin of the certificate is {float(least):g}, below 0")
        margins, cone, angle = _relations(surface, edges, chain, stated)
        middle = chain[len(chain) // 2]  # visits to it tell the orbits of different paths apart
        for hset in (*saddles, *chain):
            if hset is not middle and not middle.is_disjoint(hset):
                raise NotProvedError(f"M_0 is not proved to be disjoint from {hset.name}")
        x = middle.box(hsets.UNIT, hsets.UNIT)[0]
        if crossing and not ball_of(crossing[0]) < x < ball_of(crossing[1]):
            raise NotProvedError("the connection does not pass y = 0 where the statement says")
        # A second loop runs through the chain, and on around the saddles to where it began. If its
        # length and the period have no common divisor, the shift is mixing.
        loop = len(chain) + 1 + (leaves - enters) % period
        if gcd(period, loop) != 1:
            raise NotProvedError(f"loops of {period} and {loop} impacts do not mix")
        bound = _entropy(period, loop)
        if not bound > ball_of(entropy):
            raise NotProvedError(f"the entropy is not proved to be above {float(entropy)}")
        beyond, room = map(min, zip(*margins, strict=True))
        return Finding(
            {"entropy": bound, "crossing x": x, "crossing angle": angle},
            {"beyond": beyond, "room": room, "cones": cone},
            dict(saddles=saddles, chain=chain, edges=edges, margins=margins, loop=loop),
        )


def _sets(certificate: Certificate) -> tuple[list[HSet], list[HSet], int, int]:
    """Return the saddles' sets, the chain's, and the saddles that the chain leaves and enters.

    The second half of the chain mirrors the first.
    """
    rows = certificate.numbers("saddles", 6)
    leaves, enters = certificate.whole("leaves"), certificate.whole("enters")
    if not {leaves, enters} <= set(range(len(rows))):
        raise NotProvedError("the certificate's chain does not begin and end at its saddles")
    for i, (x, y, ux, uy, sx, sy) in enumerate(rows):  # the reversor maps the connection to itself
        if rows[(leaves + enters - i) % len(rows)] != [x, -y, sx, -sy, ux, -uy]:
            raise NotProvedError(f"S_{i} has no mirror image among the saddles' sets")
    steps = len(certificate.numbers("approach", 6))
    chain = hsets.read_sets(certificate, "approach", "M", -steps)
    x, ux, uy = certificate.row("middle", 3)
    middle = hsets.hset("M_0", [x, Fraction(0), ux, uy, ux, -uy])
    back = [hset.mirrored(f"M_{steps - i}") for i, hset in enumerate(chain)]
    saddles = hsets.read_sets(certificate, "saddles", "S")
    return saddles, [*chain, middle, *reversed(back)], leaves, enters


def _relations(
    surface: Surface, edges: list[Edge], chain: list[HSet], stated: list[list[Fraction]]
) -> tuple[list[tuple[float, float]], float, arb]:
    """Prove every covering with its cone condition, and with at least the stated margins.

    Returns the margins of each covering, the least cone margin, and the crossing angle.
    """
    margins, cone = [], float("inf")
    slope, middle = hsets.UNIT, chain[len(chain) // 2]
    for (source, target), least in zip(edges, stated, strict=True):
        margin, cone_margin, local = hsets.prove_hyperbolic(surface, source, target)
        if not all(arb(a) >= ball_of(b) for a, b in zip(margin, least, strict=True)):
            raise NotProvedError(f"{source.name} covers {target.name}, but by less than is stated")
        margins.append(margin)
        cone = min(cone, cone_margin)
        if source is chain[0]:
            slope = hsets.UNIT  # by the cones |dq/dp| <= 1 here, whatever came before
        (a, b), (c, d) = local.hull()
        slope = (c + d * slope) / (a + b * slope)  # dq/dp of the unstable manifold
        if target is middle:
            angle = _crossing_angle(middle, slope)
    return margins, cone, angle


def _crossing_angle(middle: HSet, slope: arb) -> arb:
    """Enclose the acute angle between the unstable manifold in M_0 and its mirror image."""
    x, y = (u + slope * s for u, s in zip(middle.u, middle.s, strict=True))
    half = arb.atan2(abs(y), abs(x))
    return (2 * half).min(arb.pi() - 2 * half)  # the acute one, even if half may be pi/4


def _entropy(period: int, loop: int) -> arb:
    """Enclose ln x, where x^-period + x^-loop = 1, by bisection; period and loop are at least 1."""
    low, high = arb(0), arb(1)
    for _ in range(60):
        middle = ((low + high) / 2).mid()
        excess = (-period * middle).exp() + (-loop * middle).exp() - 1
        if excess > 0:
            low = middle
        elif excess < 0:
            high = middle
    return low.union(high)
