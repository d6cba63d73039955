"""A horseshoe: h-sets at the points of a hyperbolic orbit and along a connection between them.

Sets S_0 ... S_(n-1) at the saddles cover each other in turn; a chain M_-K ... M_K leaves from S_a
and returns to S_b, so that S_a => M_-K => ... => M_K => S_b. Every bi-infinite path in that graph
is followed by an orbit of P (Zgliczynski and Gidea 2004), by the cone condition on every relation
by only one, and the set of these orbits is compact, invariant and uniformly hyperbolic
(Kokubu, Wilczak and Zgliczynski 2007; Zgliczynski 2009).

M_0 is disjoint from all other sets. So a path that visits M_0 is known from the times at which its
orbit does. The n paths that never visit it stay in the S; their orbits are the saddles' own,
started at each of its points, which are distinct since the period is the prime one. So P on the
invariant set is conjugate to the shift on paths. From M_0 back to M_0 a path
takes L + m n impacts, m = 0, 1, ..., with L the length of the loop through the chain; so the
topological entropy is ln x, x^-n + x^-L = 1, and the shift is mixing if n and L have no common
divisor. The path that is in the S for all times but one passage of the chain is an orbit in the
unstable manifold of the saddles and in the stable one; cones make these cross transversally there.
"""

from itertools import pairwise
from math import gcd

from flint import arb, ctx

from ..enclosure.flight import UndecidedError
from ..enclosure.surface import ball_of
from . import hsets, periodic
from .certificate import Certificate, Finding, NotProvedError

BITS = 128  # the smallest sets are 1e-10 wide: 1e-38 is far below what they are measured to


def check(text, surface, *, period, radius, window, crossing, entropy):
    """Prove a certificate's horseshoe.

    Parameters
    ----------
    text : str
        The certificate.
    surface : Surface
        Whose map it is about.
    period : int
        Of the saddles.
    radius : Fraction
        The only orbit within this of the S's centres is theirs.
    window : ((x low, x high), (xdot low, xdot high)) or None
        Fractions: one of the saddles lies in this window; None for any orbit.
    crossing : (Fraction, Fraction) or None
        M_0 must lie between these x: says which connection it is.
    entropy : Fraction
        A lower bound to be proved, nats an impact.

    Returns
    -------
    Finding
        digits: entropy, crossing x and crossing angle (radians); margins: beyond, room and cones,
        the least of all relations; parts: saddles and chain, lists of HSet, edges, the relations,
        margins, of each of them, and loop, impacts.

    Raises
    ------
    NotProvedError
        With the reason.

    References
    ----------
    Zgliczynski and Gidea, Covering relations for multidimensional dynamical systems, J.
    Differential Equations 202 (2004). Kokubu, Wilczak and Zgliczynski, Rigorous verification of
    cocoon bifurcations in the Michelson system, Nonlinearity 20 (2007).
    """
    certificate = Certificate(text, "horseshoe")
    certificate.surface(surface)
    with ctx.workprec(periodic.BITS):
        centres = [row[:2] for row in certificate.numbers("saddles", 6)]
        if len(centres) != period:
            raise NotProvedError(f"the certificate has {len(centres)} saddles, not {period}")
        saddle = periodic.prove(surface, centres, radius)
        if saddle.type != "hyperbolic":
            raise NotProvedError(f"the orbit at the sets is {saddle.type}, not hyperbolic")
        periodic.passes(surface, saddle, window)
    with ctx.workprec(BITS):
        saddles, chain, leaves, enters = _sets(certificate)
        for one, point in zip(saddles, saddle.points, strict=True):
            if not one.contains(*point):
                raise NotProvedError(f"{one.name} is not proved to contain the orbit's point")
        edges = [*pairwise([*saddles, saddles[0]]), (saddles[leaves], chain[0]),
                 *pairwise(chain), (chain[-1], saddles[enters])]  # fmt: skip
        try:
            measured, cone, angle = _relations(surface, edges, chain)
        except (UndecidedError, ZeroDivisionError) as error:
            raise NotProvedError(f"a set of the certificate: {error}") from None
        _meets_margins(certificate, edges, measured)
        middle = chain[len(chain) // 2]
        for other in (*saddles, *chain):
            if other is not middle and not middle.apart(other):
                raise NotProvedError(f"M_0 is not proved to be disjoint from {other.name}")
        x = middle.box()[0]
        if crossing and not ball_of(crossing[0]) < x < ball_of(crossing[1]):
            raise NotProvedError("the connection does not pass y = 0 where the statement says")
        loop = len(chain) + 1 + (leaves - enters) % period
        if gcd(period, loop) != 1:
            raise NotProvedError(f"loops of {period} and {loop} impacts do not mix")
        bound = _entropy(period, loop)
        if not bound > ball_of(entropy):
            raise NotProvedError(f"the entropy is not proved to be above {float(entropy)}")
        beyond, room = map(min, zip(*measured, strict=True))
        margins = {"beyond": beyond, "room": room, "cones": cone}
        digits = {"entropy": bound, "crossing x": x, "crossing angle": angle}
        return Finding(digits, margins, {
            "saddles": saddles, "chain": chain, "edges": edges, "margins": measured, "loop": loop,
        })  # fmt: skip


def _sets(certificate):
    """(saddles, chain, a, b) as HSets; the second half of the chain is mirrored."""
    saddles = [_hset(f"S_{i}", row) for i, row in enumerate(certificate.numbers("saddles", 6))]
    places = [certificate.number(name) for name in ("leaves", "enters")]
    if not all(place in range(len(saddles)) for place in places):
        raise NotProvedError("the certificate's chain does not begin and end at its saddles")
    leaves, enters = map(int, places)
    _symmetric(certificate.numbers("saddles", 6), leaves + enters)
    approach = certificate.numbers("approach", 6)
    steps = len(approach)
    chain = [_hset(f"M_{i - steps}", row) for i, row in enumerate(approach)]
    (x, ux, uy) = certificate.row("middle", 3)
    middle = _hset("M_0", [x, 0, ux, uy, ux, -uy])
    back = [one.mirrored(f"M_{steps - i}") for i, one in enumerate(chain)]
    return saddles, [*chain, middle, *reversed(back)], leaves, enters


def _symmetric(rows, total):
    """Check that the reversor maps set i to set `total` - i, its two sides exchanged.

    Then it maps paths to paths backwards, and the one connection to itself: M_0's orbit has its
    point on y = 0, where one manifold is the mirror image of the other.
    """
    for i, (x, y, ux, uy, sx, sy) in enumerate(rows):
        if rows[(total - i) % len(rows)] != [x, -y, sx, -sy, ux, -uy]:
            raise NotProvedError(f"S_{i} has no mirror image among the saddles' sets")


def _hset(name, row):
    values = [ball_of(value) for value in row]
    return hsets.HSet(name, tuple(values[:2]), tuple(values[2:4]), tuple(values[4:]))


def _relations(surface, edges, chain):
    """Prove every covering and cone condition: ([(beyond, room), ...], cone margin, angle)."""
    measured, cone = [], float("inf")
    slope, middle = hsets.UNIT, chain[len(chain) // 2]
    for source, target in edges:
        at = hsets.local(surface, source, target)
        measured.append(hsets.covering(at, source, target))
        cone = min(cone, hsets.cones(at, source, target))
        if source is chain[0]:
            slope = hsets.UNIT
        (a, b), (c, d) = at.hull()
        slope = (c + d * slope) / (a + b * slope)  # dq/dp of the unstable manifold
        if target is middle:
            angle = _crossing(middle, slope)
    return measured, cone, angle


def _crossing(middle, slope):
    """The angle between the two manifolds in M_0, one the mirror image of the other at y = 0."""
    x, y = (u + slope * s for u, s in zip(middle.u, middle.s, strict=True))
    half = arb.atan2(abs(y), abs(x))
    return (2 * half).min(arb.pi() - 2 * half)  # the acute one, also if half may be pi/4


def _meets_margins(certificate, edges, measured):
    stated = certificate.numbers("margins", 2)
    if len(stated) != len(edges):
        raise NotProvedError(f"there are {len(stated)} margins for {len(edges)} coverings")
    for (source, target), found, least in zip(edges, measured, stated, strict=True):
        if min(least) < 0:
            raise NotProvedError(f"a margin of the certificate is {float(min(least)):g}, below 0")
        if not all(arb(f) >= ball_of(m) for f, m in zip(found, least, strict=True)):
            raise NotProvedError(f"{source.name} covers {target.name}, but by less than is stated")


def _entropy(period, loop):
    """A lower bound of ln x, x^-period + x^-loop = 1: bisection, decided in balls."""
    low, high = arb(0), arb(1)
    for _ in range(60):
        middle = ((low + high) / 2).mid()
        if (-period * middle).exp() + (-loop * middle).exp() > 1:
            low = middle
        else:
            high = middle
    return low.union(high)
