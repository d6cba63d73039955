"""Invariant curves of visible size around elliptic orbits, by an a-posteriori KAM theorem.

theory/curves.md has the theorem with its proof, in the names used here. For an orbit of period n
the curves K_0 ... K_(n-1) around its points are one curve over T x Z_n: P maps K_i to K_(i+1), and
K_(n-1) to K_0 turned by omega.
"""

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import reduce
from itertools import combinations, pairwise
from typing import NamedTuple, TypeVar

from flint import acb, arb, ctx

from pseudorigid.verified.flight import NotProvedError, UndecidedError

from ..enclosure.jets import Jet
from ..enclosure.surface import Surface, ball_of
from . import complex_flight, periodic
from .certificate import Certificate, Finding, Range, Window, lower_bound, naming
from .circle import Cells, derivative, evaluate, noble, real_values, rotated, transform, values
from .periodic import Point

BITS = 512  # of the error; its Fourier coefficients are weighted by up to 1e70
CELL_BITS = 80
NEAR, NEAR_SLOPE = arb(1e-10), arb(1e-8)  # r and beta: of the curves that the constants hold for
MOST_CELLS, MOST_MODES = 4096, 4096
_EDGE_CELLS_PER_COLUMN = 4  # cells of the strip's edge and points for the twist's mean
_POLYGON_INSET = Fraction(1, 1000)  # relative distance of the polygon from the curve
_MOST_HALVINGS = 14  # of the subdivision of the disc inside
_DISC_LAYERS = 8  # of the first pieces of the disc, from the centre outwards
_COLUMNS_OF_PIECE = 8  # of the first pieces of the disc, around the curve

Curve = tuple[list[acb], list[acb]]  # Fourier coefficients of x and of y
Centred = tuple[Curve, Point]  # a curve and the centre that it goes around
ComplexPoint = tuple[acb, acb]
Cell = tuple[ComplexPoint, acb]  # all curves near K over a part of the strip, and flight times
Number = TypeVar("Number", arb, acb)


class Bounds(NamedTuple):
    """Bounds for every curve near K, and on the map near it; max norms."""

    tangent: arb  # of |L|
    normal: arb  # of |N|
    twist: arb  # of |T|
    torsion: arb  # a lower bound of |<T>|
    derivative: arb  # of |DP|
    second_derivative: arb  # of |D^2 P|
    image: arb  # of |P(K)| and |K| on the wide strip


class EdgeBounds(NamedTuple):
    """The bounds over one cell of the strip's edge."""

    tangent: arb
    normal: arb
    twist: arb
    derivative: arb
    second_derivative: arb
    distance: arb  # of |K - c|
    area: arb  # a lower bound of |det(K - c, L)|


class Claim(NamedTuple):
    """What a certificate says of its curve, and how the strip around it is divided."""

    centres: list[Point]
    omega: arb
    divisors: arb  # the sum of `circle.noble`
    error: arb
    share: arb
    curve: Curve
    strip: arb  # half width of the strip, and of a wider one
    wide: arb
    loss: arb  # of the strip, by each step of the proof
    height: arb  # of a cell
    columns: int
    rows: int  # of cells from the real axis to the strip's edge, and to the wide one's
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
    rotation: Range | None = None,
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
        claim = _read(certificate, share, error, rotation)
        curves, boxes, bounds = _prove_error(surface, claim, period)
        margins, distance, slope_error = _theorem(claim, bounds, period)
        area = _inflated(_area(claim.curve), distance * (2 * bounds.tangent + slope_error))
        enclosed = area / surface.area()
        if not enclosed > claim.share:
            raise NotProvedError(
                f"the curve is not proved to enclose {float(claim.share):g} of the section"
            )
    with ctx.workprec(CELL_BITS):
        polygons = _prove_discs(surface, curves, boxes, claim.centres)
    digits = {"rotation number": claim.omega, "area": area, "share": enclosed}
    digits |= {"distance": distance.upper()}
    return Finding(digits, margins, {"orbit": orbit, "polygons": polygons, "curve": claim.curve})


def _read(
    certificate: Certificate, share: Fraction, error: Fraction, rotation: Range | None
) -> Claim:
    """Return what a certificate says, which must be as much as the statement needs."""
    centres = [(ball_of(x), ball_of(y)) for x, y in certificate.numbers("points", 2)]
    omega, divisors = noble(*map(certificate.whole_numbers, ("quotients", "repeating")))
    if rotation and not ball_of(rotation[0]) < omega < ball_of(rotation[1]):
        raise NotProvedError("the rotation number is not in the statement's interval")
    stated_error = certificate.at_most("error", error)
    stated_share = certificate.at_least("share", share)
    strip, loss = certificate.number("strip"), certificate.number("loss")
    columns, rows, more = (certificate.whole(name) for name in ("columns", "rows", "more_rows"))
    if not (0 < strip < 1 and loss > 0 and 8 <= columns <= MOST_CELLS):
        raise NotProvedError("the certificate's strip, loss or columns are out of range")
    if not (1 <= rows <= 1000 and 1 <= more <= 1000):
        raise NotProvedError("the certificate's rows or more_rows are out of range")
    if not 6 * loss < strip:
        raise NotProvedError("the strip is too narrow: its half width is at most 6 times the loss")
    height = ball_of(strip) / rows
    return Claim(
        centres, omega, divisors, ball_of(stated_error), ball_of(stated_share),
        _first_curve(certificate), ball_of(strip), height * (rows + more), ball_of(loss), height,
        columns, rows, rows + more,
    )  # fmt: skip


def _prove_error(
    surface: Surface, claim: Claim, period: int
) -> tuple[list[Curve], list[list[Point]], Bounds]:
    """Prove the curve's stated error, and that the discs inside all curves are disjoint.

    Returns the curves, boxes (x, y) around each, and the bounds.
    """
    modes = len(claim.curve[0])
    with ctx.workprec(64):  # beyond `highest` coefficients are far below the error in the strip
        digits = 10 - float(claim.error.log())
        highest = max(modes, int(digits / float(2 * arb.pi() * (claim.wide - claim.strip))))
    count = 1 << (2 * highest + 2).bit_length()
    curves, errors = _curves(surface, claim.curve, period, claim.omega, count)
    with ctx.workprec(CELL_BITS):
        boxes = [_real_cells(curve, claim.columns) for curve in curves]
        hulls = [[reduce(arb.union, row) for row in zip(*around, strict=True)] for around in boxes]
        for one, other in combinations(hulls, 2):
            if all(a.overlaps(b) for a, b in zip(one, other, strict=True)):
                raise NotProvedError("the discs inside two of the curves may overlap")
        bounds = _bounds(surface, curves, boxes, claim)
    error = _bound_of_error(errors, highest, count, bounds.image, claim)
    if not error < claim.error:
        raise NotProvedError(
            f"the curve's error is not proved to be below {float(claim.error):g}: "
            f"its bound is {float(error.upper()):.3g}"
        )
    return curves, boxes, bounds


def _prove_discs(
    surface: Surface, curves: list[Curve], all_boxes: list[list[Point]], centres: list[Point]
) -> list[list[list[float]]]:
    """Prove that P is analytic on the disc inside each curve, and return polygons inside them.

    Each curve must turn once around its centre.
    """
    polygons = []
    for curve, boxes, centre in zip(curves, all_boxes, centres, strict=True):
        _check_winding(curve, boxes, centre)
        polygons.append(_polygon(curve, centre, len(boxes)))
        _check_disc(surface, boxes, centre)
    return polygons


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
    x, y = (real_values(row, count, offset) for row in curve)
    return list(zip(x, y, strict=True))


def _curves(
    surface: Surface, first: Curve, period: int, omega: arb, count: int
) -> tuple[list[Curve], list[list[acb]]]:
    """Return all curves, and the discrete Fourier coefficients of P(K_i) - K_(i+1).

    K_i for i > 0 are the midpoints of truncated series of the images, taken as exact.
    """
    modes = len(first[0]) - 1
    curves, errors = [first], []
    for i in range(period):
        images = [surface.impact(*point)[:2] for point in _points(curves[i], count)]
        waves = [transform(list(row), count // 2) for row in zip(*images, strict=True)]
        if i + 1 < period:
            x, y = ([c.mid() for c in row[: modes + 1]] for row in waves)
            x[0], y[0] = acb(x[0].real), acb(y[0].real)  # the means are real
            target = x, y
            curves.append(target)
        else:
            target = _turned(first, omega)
        errors += [
            [c - goal[q] if q <= modes else c for q, c in enumerate(row)]
            for row, goal in zip(waves, target, strict=True)
        ]
    return curves, errors


def _bound_of_error(
    errors: list[list[acb]], highest: int, count: int, image: arb, claim: Claim
) -> arb:
    """Bound |e| on the strip, from its discrete Fourier coefficients up to frequency `highest`.

    Coefficient q of `count` points is the sum of all e_(q + m count), and |e_q| is at most
    2 image exp(-2 pi wide |q|).
    """
    two_pi = 2 * arb.pi()
    largest = 2 * image
    aliasing = largest / (1 - (-two_pi * claim.wide * count).exp())
    decay = (-two_pi * (claim.wide - claim.strip) * (highest + 1)).exp()
    tail = 2 * largest * decay / (1 - (-two_pi * (claim.wide - claim.strip)).exp())
    totals = []
    for waves in errors:
        total = tail
        for q in range(highest + 1):
            aliases = (-two_pi * claim.wide * (count - q)).exp()
            aliases += (-two_pi * claim.wide * (count + q)).exp()
            bound = (abs(waves[q]) + aliasing * aliases) * (two_pi * claim.strip * q).exp()
            total += bound if q == 0 else 2 * bound
        totals.append(total.upper())
    return _largest(totals)


def _theorem(claim: Claim, bounds: Bounds, period: int) -> tuple[dict[str, float], arb, arb]:
    """Check the theorem's inequalities; returns margins, the curve's distance and its slope's."""
    tangent, normal, twist, torsion, derivative, second, _ = bounds
    error, d = claim.error, claim.loss
    kappa = period * (arb(3) / 32 + claim.divisors * d**2).sqrt() + 2 * (period - 1) * d
    a2 = 2 * kappa * tangent + 2 * (1 / torsion) * (normal * d + twist * tangent * kappa)
    a1 = kappa * (2 * normal * d + twist * a2)
    a = tangent * a1 + normal * a2 * d
    c = 2 * tangent * normal * a1 * d + second * a**2 / 2
    c += normal * (d**3 + 2 * tangent * a1 * d + 2 * derivative * normal * a2 * d**2)
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
    margins |= {"torsion": torsion}
    return {name: lower_bound(value) for name, value in margins.items()}, distance, slope


def _bounds(
    surface: Surface, curves: list[Curve], boxes: list[list[Point]], claim: Claim
) -> Bounds:
    """Compute the constants of the theorem.

    P is analytic, and det(K - c, K') not zero, over the cells of the strip. So by the maximum
    principle the bounds over its edge, in finer cells, hold in all of it.
    """
    centres = claim.centres
    cycle = [*zip(curves, centres, strict=True), (_turned(curves[0], claim.omega), centres[0])]
    on_wide_edge: list[acb] = []  # x and y over the upper edge of the wide strip, and their images
    edge: list[EdgeBounds] = []
    for (here, there), around in zip(pairwise(cycle), boxes, strict=True):
        with naming("the strip around the curve"):
            for box in around:
                surface.impact(*box)  # raises an error where a flight has no first root
            below, top = _over_strip(surface, here, claim)
            edge += _over_edge(surface, here, there, claim, below)
            for point, root in top:
                on_wide_edge += [*point, *surface.impact(*point, root)[:2]]
    *sizes, areas = zip(*edge, strict=True)
    tangent, normal, twist, derivative_bound, second, distance = map(_largest, sizes)
    count = _EDGE_CELLS_PER_COLUMN * claim.columns
    ratio = (-2 * arb.pi() * claim.strip * count).exp()
    aliasing = 2 * twist * ratio / (1 - ratio)  # of the mean over `count` points
    change = _change_of_twist(
        tangent, normal, derivative_bound, second, distance, reduce(arb.min, areas)
    )
    torsion = (abs(_torsion(surface, cycle, count)) - aliasing - change).lower()
    if not torsion > 0:
        raise NotProvedError("the twist's mean along the curve may be zero")
    image = _largest(a.abs_upper() for a in on_wide_edge)
    return Bounds(tangent, normal, twist, torsion, derivative_bound, second, image)


def _over_strip(surface: Surface, here: Centred, claim: Claim) -> tuple[list[Cell], list[Cell]]:
    """Return the cells below the strip's edge and those below the wide strip's.

    Flight times are continued from the real axis, row by row: `starts` has the x and y of a point
    on the lower edge of each cell of a row, and its flight time. This point and the one on the
    upper edge must be points of the cell.
    """
    curve, centre = here
    half_height, starts = claim.height / 2, []
    for x, y in _points(curve, claim.columns, arb(0.5)):
        starts.append((acb(x), acb(y), acb(surface.impact(x, y).tau)))
    for row in range(claim.all_rows):
        middle, top = claim.height * row + half_height, claim.height * (row + 1)
        points, slopes = _inflated_cells(curve, claim.columns, middle, half_height)
        x_above, y_above = (values(waves, claim.columns, arb(0.5), top) for waves in curve)
        cells: list[Cell] = []
        for j, upper in enumerate(zip(x_above, y_above, strict=True)):
            *lower, time = starts[j]
            _check_inside(lower, points[j])
            _check_inside(upper, points[j])
            root = complex_flight.unique_root(surface, *points[j], time)
            starts[j] = *upper, complex_flight.point_root(surface.flight(*upper), root)
            cells.append((points[j], root))
            if row < claim.rows:
                normal_vector(points[j], slopes[j], centre)  # refuses a pole
        if row < claim.rows:
            below = cells
    return below, cells


def _over_edge(
    surface: Surface, here: Centred, there: Centred, claim: Claim, below: list[Cell]
) -> list[EdgeBounds]:
    """Return bounds over each cell of the strip's edge, for all curves near K.

    `here` is a curve and `there` the one that its image is close to; `below` are the cells below
    the edge.
    """
    count, bounds = _EDGE_CELLS_PER_COLUMN * claim.columns, []
    points, slopes = _inflated_cells(here[0], count, claim.strip)
    images, image_slopes = _inflated_cells(there[0], count, claim.strip)
    x_middles, y_middles = (values(row, count, arb(0.5), claim.strip) for row in here[0])
    for j, middle in enumerate(zip(x_middles, y_middles, strict=True)):
        point_below, root_below = below[j // _EDGE_CELLS_PER_COLUMN]
        _check_inside(middle, points[j], point_below)
        middle_time = complex_flight.point_root(surface.flight(*middle), root_below)
        root = complex_flight.unique_root(surface, *points[j], middle_time)
        x, y = Jet.plane(2, *points[j])
        right, up, *_ = surface.impact(x, y, root)
        sizes = [[c.abs_upper() for c in jet.coefficients] for jet in (right, up)]
        normal, distance, area = normal_vector(points[j], slopes[j], here[1])
        after, *_ = normal_vector(images[j], image_slopes[j], there[1])
        along, across = (jet[1, 0] * normal[0] + jet[0, 1] * normal[1] for jet in (right, up))
        bounds.append(EdgeBounds(
            tangent=_largest(a.abs_upper() for a in slopes[j]),
            normal=_largest(a.abs_upper() for a in normal),
            twist=(along * after[1] - across * after[0]).abs_upper(),
            derivative=_largest(a + b for _, a, b, *_ in sizes),
            second_derivative=_largest(2 * (a + b + c) for *_, a, b, c in sizes),
            distance=distance,
            area=area,
        ))  # fmt: skip
    return bounds


def _inflated_cells(
    curve: Curve, count: int, height: arb, half: arb | int = 0
) -> tuple[list[ComplexPoint], list[ComplexPoint]]:
    """Return (x, y) and (x', y') over the cells of a row of the strip, for all curves near K."""

    def over_cells(curve: Curve, radius: arb) -> list[ComplexPoint]:
        x, y = (Cells(row, count, height, half) for row in curve)
        return [(_inflated(x[j], radius), _inflated(y[j], radius)) for j in range(count)]

    return over_cells(curve, NEAR), over_cells(_slope_of(curve), NEAR_SLOPE)


def normal_vector(
    point: tuple[Number, Number], slope: tuple[Number, Number], centre: Point
) -> tuple[tuple[Number, Number], arb, arb]:
    """Return N = -(K - c)/det(K - c, K'), and bounds of |K - c| above and of the det. below."""
    x, y = point[0] - centre[0], point[1] - centre[1]
    area = x * slope[1] - y * slope[0]
    if not area.abs_lower() > 0:
        raise NotProvedError("K - c and K' may be parallel in the strip")
    return (-x / area, -y / area), _largest([x.abs_upper(), y.abs_upper()]), area.abs_lower()


def _change_of_twist(
    tangent: arb, normal: arb, derivative: arb, second: arb, distance: arb, area: arb
) -> arb:
    """Bound the difference of T between K and the curves near it, by the bounds over the edge."""
    change_of_area = 2 * (NEAR * tangent + distance * NEAR_SLOPE)
    change_of_normal = (NEAR + normal * change_of_area) / area
    return 2 * normal * (second * NEAR * normal + 2 * derivative * change_of_normal)


def _real_cells(curve: Curve, columns: int) -> list[Point]:
    """Return boxes (x, y) around all curves near K, over the cells of the real circle."""
    x, y = (Cells(row, columns) for row in curve)
    return [(_inflated(x[j].real, NEAR), _inflated(y[j].real, NEAR)) for j in range(columns)]


def _check_inside(point: Sequence[acb], *boxes: Sequence[acb]) -> None:
    """Check that a point on the edge of cells is in the boxes of these cells."""
    if not all(a.contains(b) for box in boxes for a, b in zip(box, point, strict=True)):
        raise NotProvedError("a cell does not contain a point of its edge")


def _turned(curve: Curve, omega: arb) -> Curve:
    """Return the curve K(t + omega)."""
    x, y = (rotated(row, omega) for row in curve)
    return x, y


def _slope_of(curve: Curve) -> Curve:
    """Return the curve's derivative K'."""
    x, y = map(derivative, curve)
    return x, y


def _torsion(surface: Surface, cycle: list[Centred], count: int) -> arb:
    """Return the mean of T = det(DP N, N_+) of K itself over equidistant real points.

    The cycle has the curves with their centres, and the first one turned.
    """
    along_curves, total = [], arb(0)  # of each curve, real points with N there
    for curve, centre in cycle:
        pairs = zip(_points(curve, count), _points(_slope_of(curve), count), strict=True)
        along_curves.append(
            [(point, normal_vector(point, slope, centre)[0]) for point, slope in pairs]
        )
    for here, there in pairwise(along_curves):
        for (point, n), (_, m) in zip(here, there, strict=True):
            (a, b), (c, d) = surface.jacobian(*point)[0]
            total += (a * n[0] + b * n[1]) * m[1] - (c * n[0] + d * n[1]) * m[0]
    return total / (count * (len(cycle) - 1))


def _check_winding(curve: Curve, cells: list[Point], centre: Point) -> None:
    """Check that every curve near K turns once, clockwise, around the centre and the orbit's point.

    The point is within periodic.CLOSE of the centre. det(K - c, K') is not zero (`_bounds`), so the
    curve turns one way. K - c stays, over each cell, within a right angle of its values at the
    middles of this cell and the one before, so that arguments from middle to middle are principal.
    """
    x, y = (_inflated(value, ball_of(periodic.CLOSE)) for value in centre)
    boxes = [acb(*_minus(box, (x, y))) for box in cells]
    middles = [acb(*_minus(point, (x, y))) for point in _points(curve, len(cells), arb(0.5))]
    total = arb(0)
    for j, here in enumerate(middles):
        after = (j + 1) % len(cells)
        if not all((boxes[cell] / here).real > 0 for cell in (j, after)):
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
    x_cells, y_cells = (Cells(row, columns, half_width=wide * 1.25) for row in curve)
    left, right = (
        [(_inflated(x, NEAR), _inflated(y, NEAR)) for x, y in _points(curve, columns, offset)]
        for offset in (arb(-0.125), arb(0.125))
    )
    factor = 1 - ball_of(_POLYGON_INSET)
    corners = [
        [float(c + factor * (value - c)) for value, c in zip(end, centre, strict=True)]
        for end in _points(curve, columns)
    ]
    exact = [(arb(x), arb(y)) for x, y in corners]
    for j, a in enumerate(exact):
        after = (j + 1) % columns
        b = exact[after]
        turns = [_turn(centre, *pair) for pair in ((left[j], a), (a, b), (b, right[after]))]
        if not (
            _lies_beyond(x_cells, y_cells, j, a, b)
            and all(turn < 0 < towards for turn, towards in turns)
        ):
            raise NotProvedError("the polygon is not proved to lie inside the curve")
    return corners


def _lies_beyond(x_cells: Cells, y_cells: Cells, j: int, a: Point, b: Point) -> bool:
    """Whether the curves near K lie, over cell j, to the left of the line from a to b."""
    dx, dy = _minus(b, a)
    coefficients = zip(x_cells.taylor(j), y_cells.taylor(j), strict=True)
    line = [dx * y.real - dy * x.real for x, y in coefficients]
    line[0] -= dx * a[1] - dy * a[0]
    rest = abs(dx) * abs(y_cells.rest) + abs(dy) * abs(x_cells.rest)
    rest += (abs(dx) + abs(dy)) * NEAR
    return bool(evaluate([acb(c) for c in line], x_cells.box).real > rest)


def _turn(centre: Point, a: Point, b: Point) -> tuple[arb, arb]:
    """Return det(a - c, b - c) and the scalar product of a - c and b - c."""
    (p, q), (u, v) = _minus(a, centre), _minus(b, centre)
    return p * v - q * u, p * u + q * v


def _minus(a: Point, b: Point) -> Point:
    return a[0] - b[0], a[1] - b[1]


def _check_disc(surface: Surface, boxes: list[Point], centre: Point) -> None:
    """Check that P is analytic on the closed disc in a curve: each flight's first root is simple.

    The disc consists of pieces c + l (K - c), K in columns of the boxes and l in an interval of
    [0, 1], which are halved where a flight is not decided.
    """
    pieces = [
        (boxes[begin : begin + _COLUMNS_OF_PIECE], Fraction(layer, _DISC_LAYERS), 0)
        for begin in range(0, len(boxes), _COLUMNS_OF_PIECE)
        for layer in range(_DISC_LAYERS)
    ]
    while pieces:
        columns, low, depth = pieces.pop()
        half = Fraction(1, 2 * _DISC_LAYERS << depth)
        length = ball_of(low).union(ball_of(low + 2 * half))
        hull = (reduce(arb.union, row) for row in zip(*columns, strict=True))
        x, y = (c + (a - c) * length for a, c in zip(hull, centre, strict=True))
        try:
            surface.impact(x, y)
        except UndecidedError as reason:
            if depth == _MOST_HALVINGS:
                raise NotProvedError(f"the disc inside the curve: {reason}") from None
            middle = len(columns) // 2
            halves = [columns[:middle], columns[middle:]] if middle else [columns]
            pieces += [(part, at, depth + 1) for part in halves for at in (low, low + half)]


def _area(curve: Curve) -> arb:
    """Return the area inside a curve that turns clockwise: minus the integral of x dy."""
    total = arb(0)
    for q, (a, b) in enumerate(zip(*curve, strict=True)):
        total += 2 * (a.conjugate() * b * acb(0, 2 * q * arb.pi())).real
    return -total


def _inflated(value: Number, radius: arb) -> Number:
    """Return the set of all numbers whose parts are within a radius of the value's."""
    if isinstance(value, acb):
        return acb(_inflated(value.real, radius), _inflated(value.imag, radius))
    return arb(value.mid(), (value.rad() + radius).upper())


def _largest(sizes: Iterable[arb]) -> arb:
    """Return the largest of some upper bounds, which must all be finite."""
    sizes = list(sizes)
    if not all(size < arb("inf") for size in sizes):
        raise NotProvedError("a bound over the strip is not finite")
    return reduce(arb.max, sizes, arb(0))
