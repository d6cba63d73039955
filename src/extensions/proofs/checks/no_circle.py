"""No invariant circle around the saddles: their unstable manifold meets the jump set.

Sets S_0 ... S_(n-1) at the points of a hyperbolic orbit cover each other in turn. A chain of
coverings leads from S_a to a set N, which the jump set crosses from edge to edge.
README.md ("No invariant circle outside the saddles") has the argument.
"""

from fractions import Fraction
from itertools import pairwise

from flint import ctx

from study.enclosure.flight import NotProvedError
from study.enclosure.surface import Surface, ball_of

from . import hsets, jump, periodic
from .certificate import Certificate, Finding, Window

BITS = 64  # the smallest sets are 1e-5 wide


def check(text: str, surface: Surface, *, period: int, radius: Fraction, window: Window) -> Finding:
    """Prove that the unstable manifold of a certificate's hyperbolic orbit meets the jump set.

    The orbit must have this prime period, be the only one within the radius of the centres of the
    S, and have a point in the window; the jump set must be one curve. The margins are the least
    over all relations. The parts are the chain, a list of HSet with N last, and the orbit.
    """
    certificate = Certificate(text, "jump crossing", surface)
    orbit = periodic.prove_saddles(certificate, surface, period, radius, window)
    with ctx.workprec(BITS):
        saddles = hsets.read_sets(certificate, "saddles", "S")
        chain = hsets.read_sets(certificate, "chain", "M", first=1)
        hsets.check_contained(saddles, orbit.points)
        leaves = certificate.whole("leaves")
        if leaves not in range(len(saddles)):
            raise NotProvedError("the certificate's chain does not begin at its saddles")
        loop = [hsets.prove_hyperbolic(surface, *it) for it in pairwise([*saddles, saddles[0]])]
        margins = [hsets.prove_covering(surface, *it) for it in pairwise([saddles[leaves], *chain])]
    with ctx.workprec(jump.BITS):
        jump.check_landings(surface)
        low, high = map(ball_of, certificate.row("touches", 2))
        across = jump.prove_crossing(surface, chain[-1], low, high)
    beyond, room = map(min, zip(*margins, *(pair for pair, _, _ in loop), strict=True))
    cone = min(least for _, least, _ in loop)
    return Finding(
        {"jump set at x": chain[-1].box(hsets.UNIT, hsets.UNIT)[0]},
        {"beyond": beyond, "room": room, "cones": cone, "crossing": across},
        {"chain": chain, "orbit": orbit},
    )
