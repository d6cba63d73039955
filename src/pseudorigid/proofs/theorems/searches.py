"""How a certificate of each theorem is sought, by what checks it."""

from fractions import Fraction

from ..checks import horseshoe, jump, periodic, twist
from ..enclosure.surface import Surface
from ..search import approximate_orbits
from ..search import horseshoe as horseshoes
from ..search import jump as jumps
from ..search import periodic as orbits
from ..search import twist as twists

PLANS = {
    "horseshoe-outer": horseshoes.Plan(side=1, steps=59, size=6.5e-5, room=1.14),
    "horseshoe-inner": horseshoes.Plan(side=-1, steps=177, size=1e-10, room=1.12),
}
ZERO = Fraction("0.029"), Fraction("0.03")  # energies between which the twist falls through zero
SPEED = "0.02"  # xdot of the rim point from which the stated point of the jump set is reached


def _orbit(theorem):
    surface, period, kind = (theorem.bounds[name] for name in ("surface", "period", "type"))
    return orbits.propose(
        surface, approximate_orbits.points(surface, period, kind), theorem.of_any_size
    )


def _twist(theorem):
    surface, period = theorem.bounds["surface"], theorem.bounds["period"]
    points = approximate_orbits.points(surface, period, "elliptic")
    return twists.propose(surface, points, theorem.of_any_size)


def _zero(theorem):
    ball = theorem.bounds["k"], theorem.bounds["g"]
    (start,) = approximate_orbits.points(Surface(*ball, ZERO[0]), 1, "elliptic")
    return twists.propose_zero(*ball, *ZERO, start, theorem.of_any_size)


def _horseshoe(theorem):
    surface, period = theorem.bounds["surface"], theorem.bounds["period"]
    points, plan = approximate_orbits.points(surface, period, "hyperbolic"), PLANS[theorem.name]
    return horseshoes.propose(
        surface, approximate_orbits.ball(surface), points, plan, theorem.prove
    )


SEARCHES = {
    periodic.check: _orbit,
    periodic.check_only_fixed_point: lambda it: orbits.propose_only_fixed_point(**it.bounds),
    twist.check: _twist,
    twist.check_zero: _zero,
    horseshoe.check: _horseshoe,
    jump.check: lambda it: jumps.propose(it.bounds["surface"], SPEED, "1e-28"),
    jump.check_smooth: lambda it: jumps.propose_smooth(it.bounds["k"], it.bounds["g"]),
}
