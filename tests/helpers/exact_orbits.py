"""Orbits and their events in 60 digits."""

from mpmath import mp, mpf

from helpers.independent_solver import exact_map

STEP = mpf(10) ** -20  # of central differences


def state_at(k, g, energy, x, y):
    """The state (x, xdot, udot) of a point (x, y = xdot - k udot) of the section."""
    s = mp.sqrt(((1 + k) * (2 * energy + 2 * g * x - k * x * x) - y * y) / k)
    return x, (y + k * s) / (1 + k), (s - y) / (1 + k)


def at_rest(k, g, energy):
    """The state of the ball at rest on the floor, on Fix R at the section's rim."""
    return g / k - mp.sqrt((2 * energy + g * g / k) / k), mpf(0), mpf(0)


def after(k, g, state, impacts):
    """The state after some impacts."""
    for _ in range(impacts):
        state = exact_map(k, g, *state)[:3]
    return state


def on_section(k, g, energy, x, y, impacts):
    """The point (x, y) after some impacts."""
    x, v, w = after(k, g, state_at(k, g, energy, x, y), impacts)
    return x, v - k * w


def apex(k, g, state):
    """Strain -xi and eta = -k U' where the centre is highest in the flight after an impact."""
    x, v, w = state
    e = 2 * (v + w) / (1 + k)
    b, c = v - k * e, w - e
    t = -b / g
    return x * mp.cos(t) - c * mp.sin(t), -k * (x * mp.sin(t) + c * mp.cos(t))


def derivative(function, at, number, step=STEP):
    """The derivative of a function that returns several numbers by one of its arguments."""
    ends = ([x + d * (i == number) for i, x in enumerate(at)] for d in (step, -step))
    ahead, behind = (function(*end) for end in ends)
    return [(p - m) / (2 * step) for p, m in zip(ahead, behind, strict=True)]


def event_energy(end, kind, energy, along):
    """The energy of a fold or doubling of symmetric orbits, next to an approximate one.

    `end(energy, along, across)` is the end (along, across) of the half orbit with that start.
    Newton's method has differences that are wide against the equations' own.
    """

    def equations(energy, along):
        at = energy, along, mpf(0)
        a, c = derivative(end, at, 1)
        return end(*at)[1], c if kind == "fold" else a * derivative(end, at, 2)[1]

    energy, along = mpf(energy), mpf(along)
    for _ in range(3):
        columns = [derivative(equations, (energy, along), i, mpf(10) ** -12) for i in (0, 1)]
        step = mp.lu_solve(mp.matrix(columns).T, mp.matrix(equations(energy, along)))
        energy, along = energy - step[0], along - step[1]
    assert abs(step[0]) < mpf(10) ** -18 * energy
    return energy
