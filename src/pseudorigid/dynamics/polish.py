"""A periodic orbit to the last bit, by Newton's method on all of its points in decimal arithmetic.

Along an unstable orbit the map multiplies the error of the first point. Therefore all points, in
the chart (x, y = xdot - k udot), and all times of flight are unknowns. Their linear equations,
solved along the orbit, cost as many digits as errors grow by, and more cancel where an impact
grazes, so that doubles do not suffice. Python's decimals have the same bits everywhere.
"""

from decimal import Context, Decimal, localcontext

import numpy as np

from .ball import Ball

DIGITS = 38
CLOSE = 1e-20  # largest change in the last step, in section radii
NEWTON_STEPS = 50  # two or three suffice, but near a fold a step only halves the error
_Numbers = tuple[Decimal, ...]
# A point (x, y), the next point and the time of flight to it, and their derivatives by x and by y.
_Flight = tuple[_Numbers, _Numbers, _Numbers, _Numbers]


def polished(
    ball: Ball, energy: float, orbit: np.ndarray, radius: float, symmetric: bool
) -> tuple[float, np.ndarray]:
    """Return trace and points (4, n) of the orbit near one, (4, n).

    One that is symmetric starts on a symmetry line. Raises ArithmeticError if Newton's method does
    not converge.
    """
    n = orbit.shape[1]
    with localcontext(Context(prec=DIGITS)):
        k, g, e = Decimal(ball.k), Decimal(ball.g), Decimal(energy)
        states = [[Decimal(a) for a in state] for state in orbit.T.tolist()]
        points: list[_Numbers] = [(x, v - k * w, tau) for x, v, w, tau in states]
        # Points i and (line - i) % n are mirror images; `line` is 1 for a start on Fix RP. Their y
        # have the sum 0: this keeps the equations of half the orbit regular where the trace is 2.
        line = int(abs(points[0][1]) > abs(points[0][1] + points[1 % n][1]))
        half = (n + line + 1) // 2 if symmetric else n
        points = [points[i % n] for i in range(half + 1)]
        for _ in range(NEWTON_STEPS):
            flights = [_flight(k, g, e, *point) for point in points[:half]]
            x, y, _ = points[0]
            (p, q), (a, c), (b, d) = (
                (path[0][1] + path[line][1], path[half][1] + path[(line - half) % n][1])
                if symmetric
                else (path[n][0] - path[0][0], path[n][1] - path[0][1])
                for path in _paths(flights, x, y)
            )
            a, b, c, d = a - p, b - p, c - q, d - q
            x += (b * q - d * p) / (a * d - b * c)
            y += (c * p - a * q) / (a * d - b * c)
            before, points = points, _path(flights, x, y)
            both = zip(before, points, strict=True)
            if max(abs(u - v) for two in both for u, v in zip(*two, strict=True)) < CLOSE * radius:
                break
        else:
            raise ArithmeticError("Newton's method does not converge")
        flights += [_mirrored(*flights[(line - 1 - i) % n]) for i in range(half, n)]
        points, along, across = _paths(flights, x, y)
        trace = along[n][0] - points[n][0] + across[n][1] - points[n][1]
        rows = [(x, *_velocities(k, g, e, x, y)[:2], tau) for x, y, tau in points[:n]]
        below = np.nextafter(2.0, 0.0)  # a trace is not rounded to that of another type
        rounded = np.clip(float(trace), -below, below) if abs(trace) < 2 else trace
        return float(rounded), np.array(rows, dtype=float).T


def _paths(flights: list[_Flight], x: Decimal, y: Decimal) -> list[list[_Numbers]]:
    """Return the paths from (x, y), (x + 1, y) and (x, y + 1)."""
    return [_path(flights, x + i, y + j) for i, j in ((0, 0), (1, 0), (0, 1))]


def _path(flights: list[_Flight], x: Decimal, y: Decimal) -> list[_Numbers]:
    """Return the points from (x, y) on, and the times of flight from them, by linear flights."""
    path: list[_Numbers] = []
    for (x0, y0), (x1, y1, t1), (a, c, t_x), (b, d, t_y) in flights:
        dx, dy = x - x0, y - y0
        path.append((x, y, t1 + t_x * dx + t_y * dy))
        x, y = x1 + a * dx + b * dy, y1 + c * dx + d * dy
    return [*path, (x, y, Decimal(0))]


def _mirrored(point: _Numbers, image: _Numbers, by_x: _Numbers, by_y: _Numbers) -> _Flight:
    """Return the mirror image of a flight, run backwards, without the derivatives of its time."""
    (x, y), (p, q, tau), (a, c, _), (b, d, _) = point, image, by_x, by_y
    return (p, -q), (x, -y, tau), (d, c, Decimal(0)), (b, a, Decimal(0))


def _velocities(k: Decimal, g: Decimal, e: Decimal, x: Decimal, y: Decimal) -> _Numbers:
    """Return xdot, udot and s = xdot + udot at a point of the chart."""
    s = (((1 + k) * (2 * e + x * (2 * g - k * x)) - y * y) / k).sqrt()
    return (y + k * s) / (1 + k), (s - y) / (1 + k), s


def _flight(k: Decimal, g: Decimal, e: Decimal, x: Decimal, y: Decimal, t: Decimal) -> _Flight:
    """Return the flight from a point to the root of the gap near the time t, by a Newton step."""
    b, c, s = _velocities(k, g, e, x, -y)  # of the mirror image, which are -b and -c
    sine, cosine = _sincos(t)
    p, v, w = x * cosine + c * sine, g * t - b, x * sine - c * cosine
    late = (p - x + t * (b - g * t / 2)) / (v + w)
    image = p - w * late, v - k * w + (g - k * p) * late, t + late
    derivatives: list[_Numbers] = []
    for dx, dy, ds in ((1, 0, (1 + k) * (g - k * x) / (k * s)), (0, 1, -y / (k * s))):
        db, dc = (dy - k * ds) / (1 + k), -(dy + ds) / (1 + k)
        dt = ((cosine - 1) * dx - sine * dc - t * db) / (v + w)
        dv, dw = db + g * dt, sine * dx + cosine * dc + p * dt
        derivatives.append((cosine * dx - sine * dc - w * dt, dv - k * dw, dt))
    return (x, y), image, derivatives[0], derivatives[1]


def _sincos(angle: Decimal) -> tuple[Decimal, Decimal]:
    """Return sine and cosine by the series of an angle below 1/16, which is then doubled."""
    doublings = 4 + int(angle).bit_length()
    angle = angle / 2**doublings
    square, sine, cosine = angle * angle, Decimal(1), Decimal(1)
    for n in range(20, 0, -2):
        sine, cosine = 1 - sine * square / (n * n + n), 1 - cosine * square / (n * n - n)
    sine *= angle
    for _ in range(doublings):
        sine, cosine = 2 * sine * cosine, 1 - 2 * sine * sine
    return sine, cosine
