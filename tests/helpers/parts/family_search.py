"""Searches for families of the paper's ball."""

import math
from functools import cache
from itertools import pairwise

from extensions.families.continuation.curve import at_parameter
from extensions.families.continuation.half_orbit import ENERGY
from extensions.families.continuation.search import Search
from extensions.families.continuation.symmetric import Parameter
from pseudorigid import Ball

PAPER = Ball(0.2, 0.04)


def rho(ball, energy):
    return math.sqrt(1.0 + 2.0 * ball.k * (energy / (ball.g * ball.g)))


def searched(ball, low, high, longest, levels):
    """A whole search over a range of energies."""
    ends = rho(ball, low), rho(ball, high)
    found = Search(Parameter(ENERGY, ball.k, *ends), longest)
    step = (ends[1] - ends[0]) / levels
    for _ in found.sweep([ends[0] + (i + 0.5) * step for i in range(levels)]):
        pass
    for _ in found.complete():
        pass
    return found


@cache
def up_to_period_six():
    """Periods up to 6 over two thirds of the paper's energies."""
    return searched(PAPER, -0.00399, 0.0399, 6, 20)


def crossings(family, p):
    """The points of a family at a parameter."""
    cut = ((a, b) for a, b in pairwise(family.points) if (a.p < p) != (b.p < p))
    return [point for a, b in cut if (point := at_parameter(family.system, a, b, p)) is not None]


def energy_of(found, p):
    return found.parameter.energy(p) * PAPER.g**2


def six_born_at(found, line, kind):
    """The period-six family from one line that ends in a kind of event below E = 0.01."""
    six = [f for f in found.families if (f.period, f.line) == (6, line)]
    energy = found.parameter.energy
    (family,) = (f for f in six if any(e.kind == kind and energy(e.p) < 6.25 for e in f.ends))
    return family
