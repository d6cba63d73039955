"""Invariant curves of visible size around elliptic orbits, by an a-posteriori KAM theorem.

README.md ("Invariant curves of visible size") has the theorem with its proof, in the names
used here. For an orbit of period n the curves K_0 ... K_(n-1) around its points are one curve over
T x Z_n: P maps K_i to K_(i+1), and K_(n-1) to K_0 turned by omega.
"""

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import reduce
from itertools import pairwise
from typing import NamedTuple

from flint import acb, arb, ctx

from study.enclosure.flight import UndecidedError
from study.enclosure.jets import Jet
from study.enclosure.surface import Surface, ball_of

from ..enclosure import complex_flight
from . import periodic
from .certificate import Certificate, Finding, NotProvedError, lowest
from .circle import Cells, derivative, evaluate, noble, real_values, rotated, transform, values
from .periodic import Window

BITS = 512  # of the error; its Fourier coefficients are weighted by up to 1e70
CELL_BITS = 80
NEAR, NEAR_SLOPE = arb(1e-10), arb(1e-8)  # r and beta: of the curves that the constants hold for
MOST_CELLS, MOST_MODES = 4096, 4096
_FINER = 4  # cells of the strip's edge, and points for the twist's mean, for each column
_SHRUNK = Fraction(1, 1000)  # relative distance of the polygon from the curve
_DEPTH = 14  # of the subdivision of the disc inside
_LAYERS = 8  # of the first pieces of the disc, from the centre outwards
_COLUMNS_OF_PIECE = 8  # of the first pieces of the disc, around the curve

Curve = tuple[list[acb], list[acb]]  # Fourier coefficients of x and of y
Point = tuple[arb, arb]


class Bounds(NamedTuple):
    """Bounds for every curve near K, and on the map near it; max norms."""

    tangent: arb  # of |L|
    normal: arb  # of |N|
    twist: arb  # of |T|
    torsion: arb  # a lower bound of |<T>|
    first: arb  # of |DP|
    second: arb  # of |D^2 P|
    image: arb  # of |P(K)| and |K| on the wide strip


class Plan(NamedTuple):
    """Numbers of a certificate: the strips, the cells and rows, and what each step loses."""

    strip: arb
    wide: arb
    loss: arb
    height: arb  # of a cell
    columns: int
    rows: int
    all_rows: int


def check(
    text: str,
    surface: Surface,
    *,
    period: int,
    radius: Fraction,
    share: Fraction,
    error: Fraction,
    window: Window | None = None,
    rotation: tuple[Fraction, Fraction] | None = None,
) -> Finding:
    """Prove a certificate's invariant curve around the first point of an elliptic orbit.

    The orbit's bounds are those of `periodic.prove_stated`. The rotation number, in clockwise turns
    of P^n, must lie between the two given, the disc inside the curve have more than a share of the
    section, and the error of the certificate's curve be no larger than the given one. The parts are
    orbit, polygons (of points (x, y), inside the curve around each of the orbit's points) and curve
    (Fourier coefficients of x and y).
    """
    with ctx.workprec(periodic.BITS):
        certificate = Certificate(text, "invariant curve", surface)
        orbit = periodic.prove_stated(
            certificate, surface, period=period, type="elliptic", radius=radius, window=window
        )
    with ctx.workprec(BITS):
        centres = [tuple(map(ball_of, row)) for row in certificate.numbers("points", 2)]
        omega, divisors = noble(*map(certificate.whole_numbers, ("quotients", "repeating")))
        if rotation and not ball_of(rotation[0]) < omega < ball_of(rotation[1]):
            raise NotProvedError("the rotation number is not in the statement's interval")
        stated_error, stated_share = certificate.number("error"), certificate.number("share")
        if not 0 < stated_error <= error:
            raise NotProvedError(f"the error is not stated to be below {float(error):g}")
        if not stated_share >= share:
            raise NotProvedError(f"the share is stated as {float(stated_share):g}, less than "
                                 f"{float(share):g}")  # fmt: skip
        plan = _plan(certificate)
        first = _first_curve(certificate)
        with ctx.workprec(64):  # beyond it coefficients are far below the error in the strip
            digits = 10 - float(ball_of(stated_error).log())
            most = max(len(first[0]), int(digits / float(2 * arb.pi() * (plan.wide - plan.strip))))
        count = 1 << (2 * most + 2).bit_length()
        curves, errors = _curves(surface, first, period, omega, count)
        with ctx.workprec(CELL_BITS):
            bounds = _bounds(surface, curves, centres, omega, plan)
        size = _size_of_error(errors, most, count, bounds.image, plan)
        if not size < ball_of(stated_error):
            raise NotProvedError(
                f"the curve's error is not proved to be below {float(stated_error):g}: "
                f"its bound is {float(size.upper()):.3g}"
            )
        margins, distance, slope = _theorem(
            ball_of(stated_error), bounds, divisors, period, plan.loss
        )
        area = _area(first)
        area = arb(area.mid(), area.rad() + (distance * (2 * bounds.tangent + slope)).upper())
        part = area / surface.area()
        if not part > ball_of(stated_share):
            raise NotProvedError(
                f"the curve is not proved to enclose {float(stated_share):g} of the section"
            )
    with ctx.workprec(CELL_BITS):
        polygons = []
        for curve, centre in zip(curves, centres, strict=True):
            _check_winding(curve, centre, plan.columns)
            polygons.append(_polygon(curve, centre, plan.columns))
        all_boxes = [_real_cells(curve, plan.columns) for curve in curves]
        _check_disjoint(all_boxes)
        for boxes, centre in zip(all_boxes, centres, strict=True):
            _check_disc(surface, boxes, centre)
    digits = {"rotation number": omega, "area": area, "share": part, "distance": distance.upper()}
    return Finding(digits, margins, {"orbit": orbit, "polygons": polygons, "curve": first})


def _plan(certificate: Certificate) -> Plan:
    """Return the certificate's strips and cells."""
    strip, loss = certificate.number("strip"), certificate.number("loss")
    columns, rows, more = (certificate.whole(name) for name in ("columns", "rows", "more_rows"))
    if not (0 < strip < 1 and loss > 0 and 8 <= columns <= MOST_CELLS):
        raise NotProvedError("the certificate's strip, loss or columns are out of range")
    if not (1 <= rows <= 1000 and 1 <= more <= 1000):
        raise NotProvedError("the certificate's rows or more_rows are out of range")
    if not 6 * loss < strip:
        raise NotProvedError("the strip is too narrow: its half width is at most 6 times the loss")
    height, every = ball_of(strip) / rows, rows + more
    return Plan(ball_of(strip), height * every, ball_of(loss), height, columns, rows, every)


def _first_curve(certificate: Certificate) -> Curve:
    """Return the Fourier coefficients of the certificate's curve."""
    rows = certificate.numbers("coefficients", 2)
    if not 3 <= len(rows) <= MOST_MODES:
        raise NotProvedError(f"the curve has {len(rows)} coefficients, not 3 to {MOST_MODES}")
    if rows[0][1] != 0:
        raise NotProvedError("the coefficient of sin(0) is not 0")
    x = [acb(ball_of(a) / 2) for a, _ in rows]
    x[0] *= 2
    return x, [acb(0, -ball_of(b) / 2) for _, b in rows]


def _points(curve: Curve, count: int, offset: arb | int = 0) -> list[Point]:
    """Return the real points of a curve at t = (j + offset)/count."""
    return list(zip(*(real_values(row, count, offset) for row in curve), strict=True))


def _curves(surface: Surface, first: Curve, period: int, omega: arb, count: int):
    """Return all curves, and the discrete Fourier coefficients of P(K_i) - K_(i+1).

    K_i for i > 0 are the midpoints of truncated series of the images, taken as exact.
    """
    modes = len(first[0]) - 1
    curves, errors = [first], []
    for i in range(period):
        images = [surface.impact(*point)[:2] for point in _points(curves[i], count)]
        waves = [transform(row, count // 2) for row in zip(*images, strict=True)]
        if i + 1 < period:
            target = tuple([c.mid() for c in row[: modes + 1]] for row in waves)
            for row in target:
                row[0] = acb(row[0].real)  # the mean is real
            curves.append(target)
        else:
            target = _turned(first, omega)
        errors += [
            [c - goal[q] if q <= modes else c for q, c in enumerate(row)]
            for row, goal in zip(waves, target, strict=True)
        ]
    return curves, errors


def _size_of_error(errors: list[list[acb]], most: int, count: int, image: arb, plan: Plan) -> arb:
    """Bound |e| on the strip, from its discrete Fourier coefficients up to frequency `most`.

    Coefficient q of `count` points is the sum of all e_(q + m count), and |e_q| is at most
    2 image exp(-2 pi wide |q|).
    """
    turn = 2 * arb.pi()
    crude = 2 * image
    aliasing = crude / (1 - (-turn * plan.wide * count).exp())
    beyond = (-turn * (plan.wide - plan.strip) * (most + 1)).exp()
    tail = 2 * crude * beyond / (1 - (-turn * (plan.wide - plan.strip)).exp())
    sizes = []
    for waves in errors:
        total = tail
        for q in range(most + 1):
            alias = (-turn * plan.wide * (count - q)).exp()
            alias += (-turn * plan.wide * (count + q)).exp()
            bound = (abs(waves[q]) + aliasing * alias) * (turn * plan.strip * q).exp()
            total += bound if q == 0 else 2 * bound
        sizes.append(total.upper())
    return _most(sizes)


def _theorem(error: arb, b: Bounds, divisors: arb, period: int, d: arb) -> tuple[dict, arb, arb]:
    """Check the theorem's inequalities; returns margins, the curve's distance and its slope's.

    `divisors` is the sum of `circle.noble`.
    """
    kappa = period * (arb(3) / 32 + divisors * d**2).sqrt() + 2 * (period - 1) * d
    torsion = 1 / b.torsion
    a2 = 2 * kappa * b.tangent + 2 * torsion * (b.normal * d + b.twist * b.tangent * kappa)
    a1 = kappa * (2 * b.normal * d + b.twist * a2)
    a = b.tangent * a1 + b.normal * a2 * d
    c = 2 * b.tangent * b.normal * a1 * d + b.second * a**2 / 2
    c += b.normal * (d**3 + 2 * b.tangent * a1 * d + 2 * b.first * b.normal * a2 * d**2)
    contraction = 2**4 * c * error / d**4
    distance, slope = 2 * a * error / d**2, 2 * a * error / d**3
    for name, value, most in (
        ("the steps are not proved to converge", contraction, arb(1) / 2),
        ("the curve may leave the neighbourhood", distance, NEAR),
        ("the curve's slope may leave the neighbourhood", slope, NEAR_SLOPE),
    ):
        if not value < most:
            raise NotProvedError(f"{name}: {float(value.upper()):.3g} is not below {float(most):g}")
    margins = {"contraction": 1 / (2 * contraction), "distance": NEAR / distance}
    margins |= {"torsion": b.torsion}
    return {name: lowest(value) for name, value in margins.items()}, distance, slope


def _bounds(surface: Surface, curves: list, centres: list, omega: arb, plan: Plan) -> Bounds:
    """Compute the constants of the theorem.

    P is analytic, and det(K - c, K') not zero, over the cells of the strip. So by the maximum
    principle the bounds over its edge, in finer cells, hold in all of it.
    """
    circle = [*zip(curves, centres, strict=True), (_turned(curves[0], omega), centres[0])]
    image, edge = [], []
    for here, there in pairwise(circle):
        for box in _real_cells(here[0], plan.columns):
            surface.impact(*box)  # raises an error where a flight has no first root
        middles = _points(here[0], plan.columns, arb(0.5))
        known = [tuple(map(acb, (*point, surface.impact(*point).tau))) for point in middles]
        for row in range(plan.all_rows):
            cells = []
            for x, y, slopes, root in _row_of_cells(surface, here[0], plan, row, known):
                cells.append((x, y, root))
                if row < plan.rows:
                    _normal((x, y), slopes, here[1])
                if row == plan.all_rows - 1:
                    image += [x, y, *surface.impact(x, y, root)[:2]]
            if row == plan.rows - 1:
                edge += _over_edge(surface, here, there, plan, cells)
    tangent, normal, twist, first, second, length, areas = zip(*edge, strict=True)
    sizes = [_most(row) for row in (tangent, normal, first, second)]
    twist, image = _most(twist), _most(a.abs_upper() for a in image)
    count = _FINER * plan.columns
    ratio = (-2 * arb.pi() * plan.strip * count).exp()
    change = _change_of_twist(sizes, _most(length), reduce(arb.min, areas))
    torsion = abs(_torsion(surface, circle, count))
    torsion = (torsion - 2 * twist * ratio / (1 - ratio) - change).lower()
    if not torsion > 0:
        raise NotProvedError("the twist's mean along the curve may be zero")
    return Bounds(sizes[0], sizes[1], twist, torsion, sizes[2], sizes[3], image)


def _over_edge(surface: Surface, here, there, plan: Plan, cells: list) -> list[tuple]:
    """Bound |L|, |N|, |T|, |DP|, |D^2 P|, |K - c| above and |det(K - c, L)| below, per cell.

    The cells are those of the strip's edge, for all curves near K. `here` and `there` are a curve
    and the one that its image is close to, each with its centre, and `cells` the x, y and flight
    time over the cells below the edge.
    """
    count, bounds = _FINER * plan.columns, []
    points, slopes = _edge_cells(here[0], count, plan)
    images, image_slopes = _edge_cells(there[0], count, plan)
    middles = list(zip(*(values(row, count, arb(0.5), plan.strip) for row in here[0]), strict=True))
    for j in range(count):
        (x, y), (below_x, below_y, below) = points[j], cells[j // _FINER]
        _check_inside(middles[j], (x, y), (below_x, below_y))
        known = complex_flight.point_root(surface.flight(*middles[j]), below)
        root = complex_flight.unique_root(surface, x, y, known)
        jets = surface.impact(*Jet.plane(2, x, y), root)[:2]
        sizes = [[c.abs_upper() for c in jet.coefficients] for jet in jets]
        normal, length, area = _normal((x, y), slopes[j], here[1])
        after, *_ = _normal(images[j], image_slopes[j], there[1])
        right, up = (jet[1, 0] * normal[0] + jet[0, 1] * normal[1] for jet in jets)
        bounds.append((
            _most(a.abs_upper() for a in slopes[j]), _most(a.abs_upper() for a in normal),
            (right * after[1] - up * after[0]).abs_upper(),
            _most(a + b for _, a, b, *_ in sizes), _most(2 * (a + b + c) for *_, a, b, c in sizes),
            length, area,
        ))  # fmt: skip
    return bounds


def _edge_cells(curve: Curve, count: int, plan: Plan) -> tuple[list, list]:
    """Return (x, y) and (x', y') over the cells of the strip's edge, for all curves near K."""
    points, slopes = (
        [Cells(row, count, plan.strip) for row in rows]
        for rows in (curve, tuple(map(derivative, curve)))
    )
    return tuple(
        [[_inflated(cell[j], by) for cell in cells] for j in range(count)]
        for cells, by in ((points, NEAR), (slopes, NEAR_SLOPE))
    )


def _normal(point, slope, centre: Point) -> tuple[Point, arb, arb]:
    """Return N = -(K - c)/det(K - c, K'), and bounds of |K - c| above and of the det. below."""
    x, y = _minus(point, centre)
    area = x * slope[1] - y * slope[0]
    if not area.abs_lower() > 0:
        raise NotProvedError("K - c and K' may be parallel in the strip")
    return (-x / area, -y / area), _most([x.abs_upper(), y.abs_upper()]), area.abs_lower()


def _change_of_twist(sizes: list[arb], length: arb, area: arb) -> arb:
    """Bound the difference of T between K and the curves near it.

    `length` bounds |K - c| from above and `area` |det(K - c, K')| from below, for all of them.
    """
    tangent, normal, first, second = sizes
    of_area = 2 * (NEAR * tangent + length * NEAR_SLOPE)
    of_normal = (NEAR + normal * of_area) / area
    return 2 * normal * (second * NEAR * normal + 2 * first * of_normal)


def _real_cells(curve: Curve, columns: int) -> list[list[arb]]:
    """Return boxes (x, y) around all curves near K, over the cells of the real circle."""
    rows = [Cells(row, columns) for row in curve]
    return [[_inflated(row[j], NEAR) for row in rows] for j in range(columns)]


def _row_of_cells(
    surface: Surface, curve: Curve, plan: Plan, row: int, known: list[tuple]
) -> Iterator[tuple]:
    """Yield x, y, (x', y') and the flight time of each cell of a row, for all curves near K.

    `known` has the x and y of a point on the lower edge of each cell and its flight time, and is
    replaced by those of a point on the upper edge. Both must be points of the cell.
    """
    half = plan.height / 2
    middle, top = plan.height * row + half, plan.height * (row + 1)
    cells = [Cells(waves, plan.columns, middle, half) for waves in curve]
    slopes = [Cells(derivative(waves), plan.columns, middle, half) for waves in curve]
    edge = [values(waves, plan.columns, arb(0.5), top) for waves in curve]
    for j in range(plan.columns):
        x, y = (_inflated(cell[j], NEAR) for cell in cells)
        below, above = known[j], (edge[0][j], edge[1][j])
        _check_inside(below[:2], (x, y))
        _check_inside(above, (x, y))
        root = complex_flight.unique_root(surface, x, y, below[2])
        known[j] = *above, complex_flight.point_root(surface.flight(*above), root)
        yield x, y, [_inflated(slope[j], NEAR_SLOPE) for slope in slopes], root


def _check_inside(point: Sequence[acb], *boxes: Sequence[acb]) -> None:
    """Check that a point on the edge of cells is in the boxes of these cells."""
    if not all(a.contains(b) for box in boxes for a, b in zip(box, point, strict=True)):
        raise NotProvedError("a cell does not contain a point of its edge")


def _turned(curve: Curve, omega: arb) -> Curve:
    """Return the curve K(t + omega)."""
    x, y = (rotated(row, omega) for row in curve)
    return x, y


def _torsion(surface: Surface, circle: list, count: int) -> arb:
    """Return the mean of T = det(DP N, N_+) of K itself over equidistant real points.

    The circle has the curves with their centres, and the first one turned.
    """
    normals, total = [_normals(*pair, count) for pair in circle], arb(0)
    for (curve, _), here, there in zip(circle, normals, normals[1:], strict=False):
        for point, n, m in zip(_points(curve, count), here, there, strict=True):
            (a, b), (c, d) = surface.jacobian(*point)[0]
            total += (a * n[0] + b * n[1]) * m[1] - (c * n[0] + d * n[1]) * m[0]
    return total / (count * (len(circle) - 1))


def _normals(curve: Curve, centre: Point, count: int) -> list[Point]:
    """Enclose N at equidistant real points."""
    slopes = _points(tuple(map(derivative, curve)), count)
    pairs = zip(_points(curve, count), slopes, strict=True)
    return [_normal(*pair, centre)[0] for pair in pairs]


def _check_winding(curve: Curve, centre: Point, columns: int) -> None:
    """Check that every curve near K turns once, clockwise, around the centre and the orbit's point.

    The point is within periodic.CLOSE of the centre. det(K - c, K') is not zero (`_bounds`), so the
    curve turns one way. K - c stays, over each cell, within a right angle of its values at the
    middles of this cell and the one before, so that arguments from middle to middle are principal.
    """
    centre = tuple(_inflated(value, ball_of(periodic.CLOSE)) for value in centre)
    boxes = [acb(*_minus(box, centre)) for box in _real_cells(curve, columns)]
    middles = [acb(*_minus(point, centre)) for point in _points(curve, columns, arb(0.5))]
    total = arb(0)
    for j, here in enumerate(middles):
        after = (j + 1) % columns
        if not all((boxes[k] / here).real > 0 for k in (j, after)):
            raise NotProvedError("the cells are too wide to count the curve's turns")
        total += (middles[after] / here).arg()
    turns = total / (2 * arb.pi())
    if not (turns + arb(1)).contains(0) or not turns.rad() < 0.1:
        raise NotProvedError(
            f"the curve turns {turns.mid().str(3, radius=False)} times around the centre, not -1"
        )


def _polygon(curve: Curve, centre: Point, columns: int) -> list[list[float]]:
    """Return a polygon inside every curve near K, with the centre inside.

    Vertex j is K at the left end of cell j, moved towards the centre. The curve over a cell that is
    wider than the edge's sector lies beyond the edge; so each ray meets the edge first. The three
    turns, from the cell's beginning to the edge's ends and to the cell's end, are each less than a
    right angle. So they add up to the curve's own turn over the cell, which `_check_winding` proves
    to be less than half a turn, and the polygon turns once.
    """
    wide = arb(1) / (2 * columns)
    cells = [Cells(row, columns, wide=wide * 1.25) for row in curve]
    left, right = (
        [[_inflated(value, NEAR) for value in point] for point in _points(curve, columns, offset)]
        for offset in (arb(-0.125), arb(0.125))
    )
    factor = 1 - ball_of(_SHRUNK)
    corners = [
        [float(c + factor * (value - c)) for value, c in zip(end, centre, strict=True)]
        for end in _points(curve, columns)
    ]
    exact = [tuple(map(arb, corner)) for corner in corners]
    for j, a in enumerate(exact):
        k = (j + 1) % columns
        b = exact[k]
        side = _minus(b, a)
        line = [
            side[0] * t[1].real - side[1] * t[0].real
            for t in zip(*(cell.taylor(j) for cell in cells), strict=True)
        ]
        line[0] -= side[0] * a[1] - side[1] * a[0]
        rest = abs(side[0]) * abs(cells[1].rest) + abs(side[1]) * abs(cells[0].rest)
        rest += (abs(side[0]) + abs(side[1])) * NEAR
        height = evaluate([acb(c) for c in line], cells[0].box).real
        turns = [_turn(centre, *pair) for pair in ((left[j], a), (a, b), (b, right[k]))]
        if not (height > rest and all(turn < 0 < towards for turn, towards in turns)):
            raise NotProvedError("the polygon is not proved to lie inside the curve")
    return corners


def _turn(centre: Point, a: Point, b: Point) -> tuple[arb, arb]:
    """Return det(a - c, b - c) and the scalar product of a - c and b - c."""
    (p, q), (u, v) = _minus(a, centre), _minus(b, centre)
    return p * v - q * u, p * u + q * v


def _minus(a: Point, b: Point) -> Point:
    return a[0] - b[0], a[1] - b[1]


def _check_disjoint(all_boxes: list) -> None:
    """Check that the discs inside curves, each in boxes (x, y), are disjoint."""
    hulls = [[reduce(arb.union, row) for row in zip(*boxes, strict=True)] for boxes in all_boxes]
    for i, a in enumerate(hulls):
        if any(a[0].overlaps(b[0]) and a[1].overlaps(b[1]) for b in hulls[:i]):
            raise NotProvedError("the discs inside two of the curves may overlap")


def _check_disc(surface: Surface, boxes: list[list[arb]], centre: Point) -> None:
    """Check that P is analytic on the closed disc in a curve: each flight's first root is simple.

    The disc consists of pieces c + l (K - c), K in some of the boxes and l in an interval of
    [0, 1], which are halved where a flight is not decided.
    """
    pieces = [
        (boxes[begin : begin + _COLUMNS_OF_PIECE], Fraction(layer, _LAYERS), 0)
        for begin in range(0, len(boxes), _COLUMNS_OF_PIECE)
        for layer in range(_LAYERS)
    ]
    while pieces:
        part, low, depth = pieces.pop()
        half = Fraction(1, 2 * _LAYERS << depth)
        length = ball_of(low).union(ball_of(low + 2 * half))
        hull = [reduce(arb.union, row) for row in zip(*part, strict=True)]
        try:
            surface.impact(*(c + (a - c) * length for a, c in zip(hull, centre, strict=True)))
        except UndecidedError as reason:
            if depth == _DEPTH:
                raise NotProvedError(f"the disc inside the curve: {reason}") from None
            middle = len(part) // 2
            halves = [part[:middle], part[middle:]] if middle else [part]
            pieces += [(some, at, depth + 1) for some in halves for at in (low, low + half)]


def _area(curve: Curve) -> arb:
    """Return the area inside a curve that turns clockwise: minus the integral of x dy."""
    total = arb(0)
    for q, (a, b) in enumerate(zip(*curve, strict=True)):
        total += 2 * (a.conjugate() * b * acb(0, 2 * q * arb.pi())).real
    return -total


def _inflated(value: acb | arb, radius: arb) -> acb | arb:
    """Return the set of all numbers whose parts are within a radius of the value's."""
    if isinstance(value, acb):
        return acb(_inflated(value.real, radius), _inflated(value.imag, radius))
    return arb(value.mid(), (value.rad() + radius).upper())


def _most(sizes: Iterable[arb]) -> arb:
    sizes = list(sizes)
    if not all(size < arb("inf") for size in sizes):
        raise NotProvedError("a bound over the strip is not finite")
    return reduce(arb.max, sizes, arb(0))
