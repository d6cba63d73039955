"""The search for a certificate of each theorem, by the theorem's checker."""

from fractions import Fraction
from functools import partial

from ..enclosure.surface import Surface
from ..search import approximate_orbits
from ..search import curve as curve_search
from ..search import ellipticity as ellipticity_search
from ..search import events as event_search
from ..search import graph as graph_search
from ..search import horseshoe as horseshoe_search
from ..search import jump as jump_search
from ..search import no_circle as circle_search
from ..search import one_zero as one_zero_search
from ..search import periodic as orbit_search
from ..search import twist as twist_search

_PLANS = {
    "horseshoe-outer": horseshoe_search.Plan(side=1, steps=59, size=6.5e-5, room=1.14),
    "horseshoe-inner": horseshoe_search.Plan(side=-1, steps=177, size=1e-10, room=1.12),
}
_GRAPHS = {
    "entropy": graph_search.Plan(periods=(6, 7, 8, 9), size=6e-3, impacts=12),
    "entropy-lower": graph_search.Plan(periods=(9, 10), size=2.5e-3, impacts=20),
}
_JUMP_CROSSING = {"size": 6.5e-5, "last": 1e-3}  # scales of the sets at saddles and jump set
_CURVES = {  # the partial quotients, the error, and the strips
    "curve-fixed-point": ((5, 1, 3), "1e-37", ("0.025", "0.004", 256, 6, 6, 380)),
    "curve-fixed-point-outer": ((5, 1, 6), "1e-38", ("0.0125", "0.002", 512, 6, 4, 1020)),
    "curve-fixed-point-low": ((9,), "1e-37", ("0.025", "0.004", 512, 10, 6, 440)),
    "curve-six": ((1, 4, 1, 3), "5e-45", ("0.02", "0.0033", 128, 5, 5, 540)),
}
_EVENTS = {  # where Newton's method begins: the energy, and x or y
    "six-elliptic-doubling": ("0.010825252768", "0.305443359319"),
    "six-elliptic-end": ("0.012520264234",),
    "six-hyperbolic-end": ("0.042726525978", "0.167175430477"),
    "six-inverse-birth": ("0.009682501945",),
}
_ZERO = Fraction("0.029"), Fraction("0.03")  # energies between which the twist falls through zero
_SPEED = "0.02"  # xdot of the rim point from which the stated point of the jump set is reached
_JUMP_RADIUS = "1e-28"  # error of the jump set's points


def _near(theorem, kind: str) -> tuple[Surface, list]:
    surface = theorem.bounds["surface"]
    return surface, approximate_orbits.points(surface, theorem.bounds["period"], kind)


def _orbit(theorem) -> str:
    near = _near(theorem, theorem.bounds["type"])
    return orbit_search.propose(*near, theorem.holds_for_any_radius)


def _twist(theorem) -> str:
    return twist_search.propose(*_near(theorem, "elliptic"), theorem.holds_for_any_radius)


def _zero(theorem) -> str:
    ball = theorem.bounds["k"], theorem.bounds["g"]
    start = approximate_orbits.points(Surface(*ball, _ZERO[0]), 1, "elliptic")
    return twist_search.propose_zero(*ball, *_ZERO, start, theorem.holds_for_any_radius)


def _horseshoe(theorem) -> str:
    near = _near(theorem, "hyperbolic")
    if theorem.name in _PLANS:
        return horseshoe_search.propose(*near, _PLANS[theorem.name], theorem.prove)
    return horseshoe_search.search(*near, 1, theorem.prove)


def _curve(theorem) -> str:
    surface, points = _near(theorem, "elliptic")
    quotients, error, strips = _CURVES[theorem.name]
    bounds = {name: str(float(theorem.bounds[name])) for name in ("radius", "share")}
    strips = curve_search.Strips(*strips)
    return curve_search.propose(surface, points, quotients, strips, error=error, **bounds)


def _of_bounds(propose, theorem) -> str:
    return propose(**theorem.bounds)


def _event(propose, theorem) -> str:
    near = _EVENTS[theorem.name]
    return propose(near, theorem.holds_for_any_radius, **theorem.bounds)


# Module and name of a checker -> the search for certificates of its theorems.
SEARCHES = {
    "periodic.check": _orbit,
    "periodic.check_only_fixed_point": partial(_of_bounds, orbit_search.propose_only_fixed_point),
    "ellipticity.check": partial(_of_bounds, ellipticity_search.propose),
    "events.check_resonance": partial(_of_bounds, event_search.propose_resonance),
    "events.check_doubling": partial(_event, event_search.propose_doubling),
    "events.check_grazing": partial(_event, event_search.propose_grazing),
    "twist.check": _twist,
    "twist.check_zero": _zero,
    "one_zero.check": partial(_of_bounds, one_zero_search.propose),
    "horseshoe.check": _horseshoe,
    "graph.check": lambda it: graph_search.propose(it.bounds["surface"], _GRAPHS[it.name]),
    "no_circle.check": lambda it: circle_search.propose(*_near(it, "hyperbolic"), **_JUMP_CROSSING),
    "curve.check": _curve,
    "jump.check": lambda it: jump_search.propose(it.bounds["surface"], _SPEED, _JUMP_RADIUS),
    "jump.check_smooth": partial(_of_bounds, jump_search.propose_smooth),
}
