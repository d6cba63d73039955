"""Coverings, cones, horseshoes and graphs: each premise, on maps and sets that are made up."""

from fractions import Fraction
from itertools import pairwise, product
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
from flint import arb, ctx

from extensions.proofs import THEOREMS, Surface
from extensions.proofs.checkers import graph, horseshoe, hsets, periodic
from extensions.proofs.checkers.certificate import Certificate, NotProvedError
from extensions.proofs.checkers.graph import Connection, Graph
from extensions.proofs.checkers.hsets import HSet, LocalMap, hset
from extensions.proofs.enclosure.jets import Jet
from helpers.parts.certificates import numbers, refused, told, with_rows
from pseudorigid.verified.flight import UndecidedError

PAPER = Surface("1/5", "1/25", "1/100")
ONE, LEFT = hset("N", [0, 0, 1, 0, 0, 1]), hset("M", [0, 0, 1, 0, 0, 1])
SKEW = hset("A", [Fraction(1, 4), Fraction(-1, 2), 2, 1, Fraction(-1, 2), 1])
OTHER = hset("B", [Fraction(1, 8), Fraction(3, 4), -1, 1, 1, 2])


def made(formula):
    """A surface whose map is a formula, of balls or jets."""
    return SimpleNamespace(impact=lambda x, y: (*formula(x, y), None, None))


def ball(low, high):
    return arb(low).union(arb(high))


def local(p=(0, 0, 0, 0, 0, 0), q=(0, 0, 0, 0, 0, 0)):
    """A LocalMap with these coefficients of 1, p, q, p^2, p q, q^2 of p' and of q'."""
    p, q = ([a if isinstance(a, arb) else arb(a) for a in row] for row in (p, q))
    return LocalMap((p[0], q[0]), (tuple(p[1:3]), tuple(q[1:3])), (tuple(p[3:]), tuple(q[3:])))


# ---- parallelograms


def test_coordinates_undo_a_box_also_of_the_mirrored_set():
    for p, q in ((0.25, -0.5), (1, 1), (-1, 0)):
        x, y = SKEW.box(arb(p), arb(q))
        assert (x, y) == (0.25 + 2 * p - q / 2, -0.5 + p + q) and SKEW.coordinates(x, y) == (p, q)
        assert SKEW.mirrored("R").coordinates(x, -y) == (q, p)
    assert (SKEW.area, SKEW.mirrored("R").area) == (2.5, 2.5) and SKEW.mirrored("R").name == "R"


@pytest.mark.parametrize("u", [(1, 0), (-1, 0), (0, 0)])
def test_sides_that_may_be_parallel_make_no_set(u):
    with pytest.raises(NotProvedError, match="N: its sides may be parallel"):
        HSet("N", (arb(0), arb(0)), tuple(map(arb, u)), (arb(1), arb(0, 1e-9)))
    assert HSet("N", (arb(0), arb(0)), (arb(0), arb(1)), (arb(1), arb(0))).area == -1


@pytest.mark.parametrize(("p", "q"), [(1, 0), (-1, 0), (0, 1), (0, -1), (1.1, 0), (0, -1.1)])
def test_each_set_contains_its_point_inside(p, q):
    sets = hsets.read_sets(Certificate('kind = "a"\nsets = [[0,0,1,0,0,1],[4,0,1,0,0,1]]', "a"),
                           "sets", "B", first=3)  # fmt: skip
    inside = [(arb(0.99), arb(-0.99)), (arb(3.01), arb(0.99))]
    hsets.check_contained(sets, inside)
    with pytest.raises(NotProvedError, match="B_4 is not proved to contain"):
        hsets.check_contained(sets, [inside[0], (arb(4 + p), arb(q))])


@pytest.mark.parametrize(("x", "y", "apart"), [
    (2.1, 0, True), (-2.1, 0, True), (0, 2.1, True), (0, -2.1, True), (2, 0, False),
    (0, -2, False), (1.9, 1.9, False), (2.1, arb(0, 9), True), (arb(0, 3), 0, False),
])  # fmt: skip
def test_squares_are_disjoint_if_all_corners_are_beyond_one_side(x, y, apart):
    other = HSet("T", (arb(x), arb(y)), (arb(1), arb(0)), (arb(0), arb(1)))
    assert ONE.is_disjoint(other) == other.is_disjoint(ONE) == apart


# ---- the map on a set


def test_the_true_images_of_a_set_lie_in_its_local_map():
    """200 points of a wide set of the paper's map, where the second order dominates."""
    random = np.random.default_rng(1)
    source = hset("A", [Fraction(a) for a in ("0.1", "0.05", "4e-3", "1e-3", "-1e-3", "3e-3")])
    target = hset("B", [Fraction(a) for a in ("0.2", "0.1", "1e-2", "2e-3", "1e-3", "-1e-2")])
    its = hsets.local_map(PAPER, source, target)
    hull, sharp = its.hull(), 0
    for p, q in [*product((-1.0, 1.0), repeat=2), *random.uniform(-1, 1, (196, 2))]:
        x, y = source.box(*Jet.plane(1, arb(p), arb(q)))
        after = target.coordinates(*PAPER.impact(x, y)[:2])
        powers = [1, p, q, p * p, p * q, q * q]
        for i, jet in enumerate(after):
            terms = [its.centre[i], *its.slopes[i], *its.curvatures[i]]
            value = sum((a * b for a, b in zip(terms, powers, strict=True)), arb(0))
            assert value.contains(jet.constant)
            sharp += not (terms[0] + p * terms[1] + q * terms[2]).overlaps(jet.constant)
            assert all(a.contains(b) for a, b in zip(hull[i], jet.coefficients[1:], strict=True))
        assert its.across().contains(after[1].constant)
        for side in (-1, 1):
            x, y = source.box(arb(side), arb(q))
            assert its.exit_edge(side).contains(target.coordinates(*PAPER.impact(x, y)[:2])[0])
    assert sharp > 300  # all but those near the centre


def test_curvatures_are_enclosed_over_the_whole_set():
    """Of x^9, whose second derivative is far larger at the edges than halfway to them."""

    def power(x):
        return x * x * x * x * x * x * x * x * x

    its = hsets.local_map(made(lambda x, y: (power(x), power(y))), ONE, ONE)
    assert its.curvatures[0][0].contains(1) and its.curvatures[1][2].contains(1)


EDGES = [  # coefficient, its enclosures of p' at p = 1 and at p = -1, and of q'
    (0, (2, 2), (2, 2), (2, 2)), (1, (2, 2), (-2, -2), (-2, 2)), (2, (-2, 2), (-2, 2), (-2, 2)),
    (3, (2, 2), (2, 2), (0, 2)), (4, (-2, 2), (-2, 2), (-2, 2)), (5, (0, 2), (0, 2), (0, 2)),
]  # fmt: skip


@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize(("place", "high", "low", "across"), EDGES)
def test_edges_and_images_are_enclosed_term_by_term(place, high, low, across, sign):
    terms = [2 * sign * (place == i) for i in range(6)]
    its = local(terms, terms)
    found = its.exit_edge(1), its.exit_edge(-1), its.across()
    for value, (least, most) in zip(found, (high, low, across), strict=True):
        wanted = sign * ball(least, most)
        assert abs(value.lower() - wanted.lower()) < 1e-7
        assert abs(value.upper() - wanted.upper()) < 1e-7


@pytest.mark.parametrize("place", range(1, 6))
def test_the_hull_holds_the_derivatives_of_all_points(place):
    """The half widths are those of 2 p, q and so on for a coefficient of 2."""
    half_widths = {3: (4, 0), 4: (2, 2), 5: (0, 4)}.get(place, (0, 0))
    for row, sign in product((0, 1), (-1, 1)):
        terms = [2 * sign * (place == i) for i in range(6)]
        hull = local(*((terms, [0] * 6) if row == 0 else ([0] * 6, terms))).hull()
        middle = [2 * sign * (place == 1), 2 * sign * (place == 2)]
        for value, centre, width in zip(hull[row], middle, half_widths, strict=True):
            assert value.contains(centre) and abs(value.rad() - width) < 1e-7
        assert all(value == 0 for value in hull[1 - row])


# ---- coverings and cones


LANDS, FITS = "not proved to land beyond", "not proved to fit between"


@pytest.mark.parametrize(("p", "q", "reason"), [
    ((0, 3), (0, 0, 0.5), ""), ((0, -3), (0, 0, 0.5), ""),
    ((0, 0, 0, 3), (0, 0, 0.5), LANDS),  # a fold: both edges on one side
    ((0, 0, 0, -3), (0, 0, 0.5), LANDS),
    ((0.5, 1.4), (0, 0, 0.5), LANDS),  # the edge p = -1 lands inside
    ((-0.5, 1.4), (0, 0, 0.5), LANDS), ((0.5, 1.5), (0, 0, 0.5), LANDS),
    ((arb(0, 9), 3), (0, 0, 0.5), LANDS), ((0, 3, 2.5), (0, 0, 0.5), LANDS),
    ((0, 3), (1, 0, 0), FITS), ((0, 3), (0.6, 0, 0.5), FITS), ((0, 3), (-0.6, 0, 0.5), FITS),
    ((0, 3), (0, 0.6, 0.5), FITS), ((0, 3), (0, 0, 1), FITS), ((0, 3), (0, 0, arb(0.5, 0.6)), FITS),
])  # fmt: skip
def test_a_covering_needs_both_edges_on_opposite_sides_and_room(p, q, reason):
    its = local(*((*row, *[0] * (6 - len(row))) for row in (p, q)))
    with told(reason and f"A does not cover B: .*{reason}"):
        beyond, room = hsets.covering_margins(its, SKEW, OTHER)
        assert 2 - 1e-6 < beyond <= 2 and 0.5 - 1e-6 < room <= 0.5


@pytest.mark.parametrize(("rows", "margin"), [
    (((3, 0), (0, 0.5)), 0.6), (((-3, 0), (0, -0.5)), 0.6), (((1, 0), (0, 0.5)), None),
    (((3, 0), (0, 1)), None),
    (((0.5, 3), (0.1, 9.5)), None),  # negative definite: the determinant is positive
    (((3, 1), (0, 0.5)), 0.5), (((3, 0), (1, 0.5)), 0.4), (((3, 1), (1, 0.5)), 0.6),
    (((3, 0), (3, 0.5)), None), (((3, 2), (0, 0.5)), 0.15),
    (((3, 4), (1, 2)), None),  # first > 0, but not the determinant
    (((3, 2), (2, -1)), None),  # mixed = a b - c d = 8
    (((arb(3, 0.3), 0), (0, 0.5)), 0.3), (((arb(3, 1.5), 0), (0, 0.5)), None),
    (((3, 0), (0, arb(0.5, 0.6))), None),
])  # fmt: skip
def test_cones_need_a_positive_definite_form_for_all_derivatives(rows, margin):
    (a, b), (c, d) = rows
    its = local((0, a, b, 0, 0, 0), (0, c, d, 0, 0, 0))
    with told("" if margin else "cone condition not proved from A to B"):
        found = hsets.cone_margin(its, SKEW, OTHER)
        matrix = np.array([[float(arb(v).mid()) for v in row] for row in rows])
        form = matrix.T @ np.diag([1, -1]) @ matrix - np.diag([1, -1])
        assert margin < found <= np.linalg.eigvalsh(form)[0]


def test_a_hyperbolic_relation_needs_its_covering_and_its_cones():
    def prove(a, b, d):
        return hsets.prove_hyperbolic(made(lambda x, y: (a * x + b * y, d * y)), ONE, LEFT)

    margins, cone, its = prove(4, 2.5, 0.5)
    assert margins == (pytest.approx(0.5), pytest.approx(0.5)) and cone > 0
    assert its.slopes == ((4, 2.5), (0, 0.5))
    with pytest.raises(NotProvedError, match="N does not cover M"):
        prove(4, 3, 0.5)
    with pytest.raises(NotProvedError, match="cone condition not proved from N to M"):
        prove(4, 2.5, 0.9)
    with pytest.raises(NotProvedError, match=r"^N: no$"):
        hsets.prove_hyperbolic(made(undecided), ONE, LEFT)


def undecided(x, y):
    raise UndecidedError("no")


# ---- coverings on cells


def dent(p, q, x, y):
    """A jet that is 1 at (p, q) and falls to 1/2 within a distance of 0.2."""
    return 1 / (1 + 25 * ((x - p) * (x - p) + (y - q) * (y - q)))


PLACES = [(-1, -1), (1, 1), (1, -0.45), (0.2, 1), (-0.45, -0.45)]


@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("narrow", [Fraction(1), Fraction(1, 8)])
def test_a_covering_on_cells_holds_for_a_folded_image(side, narrow):
    """Where the whole set is not enclosed well enough, and for sets longer in either direction."""

    def folded(x, y):
        y = y / hsets.ball_of(narrow)
        return side * (3 * x + 3.2 * y * (1 - y * y)), y / 8 + 1.8 * x * (1 - x * x)

    source = hset("N", [0, 0, 1, 0, 0, narrow])
    with pytest.raises(NotProvedError):
        hsets.covering_margins(hsets.local_map(made(folded), source, ONE), source, ONE)
    beyond, room = hsets.prove_covering(made(folded), source, ONE)
    assert 0.2 < beyond < 0.77 and 0 < room < 0.19


@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize(("p", "q"), PLACES)
def test_a_dent_of_the_image_is_found_wherever_it_is(p, q, sign):
    """In q' at every place; in p' at the edges alone."""

    def out_of_the_strip(x, y):
        return 3 * x, y / 8 + sign * 1.5 * dent(p, q, x, y)

    def back_inside(x, y):
        return sign * (3 * x - 2.5 * p * dent(p, q, x, y)), y / 8

    for formula in (out_of_the_strip, back_inside) if abs(p) == 1 else (out_of_the_strip,):
        with pytest.raises(NotProvedError, match="N does not cover M"):
            hsets.prove_covering(made(formula), ONE, LEFT)


@pytest.mark.parametrize("formula", [
    lambda x, y: (3 * x * x, y / 8), lambda x, y: (-3 * x * x, y / 8),  # folds
    lambda x, y: (x, y / 8), lambda x, y: (-x, y / 8), lambda x, y: (3 * x, y),
    lambda x, y: (3 * x + 4, y / 8), lambda x, y: (y / 8, 3 * x),
    lambda x, y: (3 * x, y / 8 + 0.95), lambda x, y: (3 * x, y / 8 - 0.95),
    lambda x, y: (1.5 * x - 0.75, y / 8),
])  # fmt: skip
def test_what_does_not_cover_is_refused(formula):
    with pytest.raises(NotProvedError, match="N does not cover M"):
        hsets.prove_covering(made(formula), ONE, LEFT)


def test_a_set_whose_flights_stay_undecided_covers_nothing(monkeypatch):
    """Only the edges' middle is decided, or all but one point."""
    monkeypatch.setattr(hsets, "MOST_CELLS", 60)

    def but(x, y):
        if isinstance(x, Jet) and x.constant.contains(0.3) and y.constant.contains(0.4):
            raise UndecidedError("a touch")
        return 3 * x, y / 8

    with pytest.raises(NotProvedError, match="N: a touch"):
        hsets.prove_covering(made(but), ONE, LEFT)


# ---- a horseshoe

# Three sets in which S_0 mirrors itself, and a chain of M_-1, M_0, M_1 from S_2 to S_1.
HORSESHOE = """
kind = "horseshoe"
k = "1/5"
g = "1/25"
energy = "1/100"
leaves = 2
enters = 1
saddles = [[0, 0, 1, 1, 1, -1], [10, 1, 1, 0, 0, 1], [10, -1, 0, -1, 1, 0]]
approach = [[20, 1, 1, 0, 0, 1]]
middle = [30, 1, 1]
margins = [[1, 0.5], [1, 0.5], [1, 0.5], [1, 0.5], [1, 0.5], [1, 0.5], [1, 0.5]]
"""


@pytest.fixture
def horseshoe_of(monkeypatch):
    """Check the horseshoe with relations that are made up; returns the finding."""

    def check(old="", new="", points=((0, 0), (10, 1), (10, -1)), margins=(1.0, 0.5), **bounds):
        assert old in HORSESHOE
        orbit = SimpleNamespace(points=[(arb(x), arb(y)) for x, y in points])
        monkeypatch.setattr(periodic, "prove_saddles", lambda *_: orbit)
        monkeypatch.setattr(hsets, "prove_hyperbolic", lambda _, source, target: (
            margins, 0.25 if source.name == "M_0" else 0.5, local((0, 3, 0, 0, 0, 0))))  # fmt: skip
        bounds = {"period": 3, "radius": 1, "entropy": Fraction(1, 10)} | bounds
        return horseshoe.check(HORSESHOE.replace(old, new), PAPER, **bounds)

    return check


def test_a_horseshoe_has_all_relations_and_the_least_margins(horseshoe_of):
    found = horseshoe_of(crossing=(Fraction(27), Fraction(33)))
    assert " ".join(f"{a.name}>{b.name}" for a, b in found.parts["edges"]) == (
        "S_0>S_1 S_1>S_2 S_2>S_0 S_2>M_-1 M_-1>M_0 M_0>M_1 M_1>S_1")  # fmt: skip
    assert found.margins == {"beyond": 1.0, "room": 0.5, "cones": 0.25}
    assert found.parts["loop"] == 3 + 1 + 1
    middle, last = found.parts["chain"][1:]
    assert (middle.s, last.centre, last.u, last.s) == ((1, -1), (20, -1), (0, -1), (1, 0))
    first = "[[20, 1, 1, 0, 0, 1]"
    text = HORSESHOE.replace(first, f"{first}, [25, 2, 1, 0, 0, 1]")
    chain = horseshoe._sets(Certificate(text, "horseshoe"))[1]
    assert [it.name for it in chain] == ["M_-2", "M_-1", "M_0", "M_1", "M_2"]
    assert [it.centre for it in chain] == [(20, 1), (25, 2), (30, 0), (25, -2), (20, -1)]


@pytest.mark.parametrize(("old", "new", "changed", "reason"), [
    ("", "", {"points": ((0, 0), (10, 2.5), (10, -1))}, "S_1 is not proved to contain"),
    ("[1, 0.5], ", "", {}, "margins for 7 coverings"),
    ("1, 0.5]]", "1, -0.5]]", {}, "is -0.5, below 0"),
    ("", "", {"margins": (0.9, 0.5)}, "S_0 covers S_1, but by less"),
    ("", "", {"margins": (1.0, 0.4)}, "S_0 covers S_1, but by less"),
    ("1, 0.5]]", "1.1, 0.5]]", {}, "M_1 covers S_1, but by less"),
    ("1, 0.5]]", "1, 0.6]]", {}, "M_1 covers S_1, but by less"),
    ("middle = [30", "middle = [12", {}, "M_0 is not proved to be disjoint from S_1"),
    ("middle = [30", "middle = [21", {}, "M_0 is not proved to be disjoint from M_-1"),
    ("", "", {"crossing": (Fraction(29), Fraction(33))}, "pass y = 0 where"),
    ("", "", {"crossing": (Fraction(27), Fraction(31))}, "pass y = 0 where"),
    ("leaves = 2\nenters = 1", "leaves = 1\nenters = 2", {}, "loops of 3 and 6 impacts do not mix"),
    ("", "", {"entropy": Fraction("0.1773")}, "not proved to be above 0.1773"),
    *((old, f"{old[:-1]}{place}", {}, "begin and end at its saddles")
      for old in ("leaves = 2", "enters = 1") for place in (3, -1)),
    ("leaves = 2", "leaves = 1", {}, "has no mirror image"),
    *(("[10, -1, 0, -1, 1, 0]", other, {}, "S_1 has no mirror image") for other in (
        "[9, -1, 0, -1, 1, 0]", "[10, 1, 0, -1, 1, 0]", "[10, -1, 1, -1, 1, 0]",
        "[10, -1, 0, 1, 1, 0]", "[10, -1, 0, -1, 2, 0]", "[10, -1, 0, -1, 1, 1]")),
    ("[0, 0, 1, 1, 1, -1]", "[0, 0, 1, 1, 1, -2]", {}, "S_0 has no mirror image"),
])  # fmt: skip
def test_each_premise_of_a_horseshoe_is_looked_at(old, new, changed, reason, horseshoe_of):
    with pytest.raises(NotProvedError, match=reason):
        horseshoe_of(old, new, **changed)


@pytest.mark.parametrize(("period", "loop"), [(1, 1), (3, 5), (6, 119), (14, 9)])
@pytest.mark.parametrize("bits", [12, 20, 128])
def test_the_entropy_solves_its_equation(period, loop, bits):
    """Also where the sign of the equation's two sides is not decided near the solution."""
    with ctx.workprec(bits):
        found = horseshoe._entropy(period, loop)
    with ctx.workprec(128), mpmath.workdps(40):
        assert found.rad() < (1e-17 if bits == 128 else 0.05)
        paths = lambda h: mpmath.exp(-period * h) + mpmath.exp(-loop * h) - 1  # noqa: E731
        true = mpmath.findroot(paths, (0.001, 1), solver="anderson")
        assert found.contains(arb(mpmath.nstr(true, 30)))


def test_the_crossing_angle_follows_the_unstable_direction_through_the_chain(monkeypatch):
    """Slopes start within the cones at the chain's first set, whatever came before."""
    steps = (1, 9, 9, 1), (4, 1, 2, 0.25), (5, 2, 1, 0.5), (3, 0, 0, 9), (3, 0, 0, 9)
    sets = [hset(f"M_{i}", [0, 0, 1, 1, 1, -1]) for i in range(-3, 3)]
    maps = {it.name: local((0, *row[:2], 0, 0, 0), (0, *row[2:], 0, 0, 0))
            for it, row in zip(sets, steps, strict=False)}  # fmt: skip
    monkeypatch.setattr(hsets, "prove_hyperbolic", lambda _, a, b: ((1.0, 1.0), 1.0, maps[a.name]))
    edges = list(pairwise(sets))
    angle = horseshoe._relations(None, edges, sets[1:], [[Fraction(0)] * 2] * 5)[2]
    for slope in (-1, 0, 1):
        after = slope
        for a, b, c, d in steps[1:3]:
            after = (c + d * after) / (a + b * after)
        half = np.arctan2(1 - after, 1 + after)
        assert angle.contains(min(2 * half, np.pi - 2 * half))
    assert angle.rad() < 0.15


# ---- a graph

GRAPH = """
kind = "graph"
k = "1/5"
g = "1/25"
energy = "1/100"
growth = 1.5
weights = [2, 1]
sets = [[0, 0, 4, 2, 0, 1], [9, 0, 1, 0, 0, 1]]
chains = [[1, 0, 1, 0, 0, 1], [2, 0, 1, 0, 0, 1]]
connections = [[0, 0, 0.5, 1, 1], [0, 1, -1, -0.5, 2], [1, 0, -0.5, 0.5, 1], [0, 1, 0, 0.25, 2]]
"""


@pytest.fixture
def graph_of(monkeypatch):
    """Check the graph with coverings that are made up; returns the finding and the coverings."""

    def check(old="", new="", entropy="0.4"):
        assert old in GRAPH
        pairs = []
        monkeypatch.setattr(hsets, "prove_covering", lambda _, source, target: (
            pairs.append(f"{source.name} => {target.name}") or (2.0 / len(pairs), 0.5 * len(pairs))
        ))  # fmt: skip
        found = graph.check(GRAPH.replace(old, new), PAPER, entropy=Fraction(entropy))
        return found, pairs

    return check


def test_a_graph_has_all_coverings_and_the_least_margins(graph_of):
    found, pairs = graph_of()
    strip, link = "the strip of connection", "set 1 of connection"
    assert pairs == [
        f"{strip} 0 => B_0", f"{strip} 1 => {link} 1", f"{link} 1 => B_1", f"{strip} 2 => B_0",
        f"{strip} 3 => {link} 3", f"{link} 3 => B_1",
    ]  # fmt: skip
    assert found.margins == {"beyond": 2 / 6, "room": 0.5, "apart": 0.25}
    assert found.digits["entropy"].overlaps(arb("0.405465108108164", 1e-15))
    second = found.parts["graph"].connections[1]
    assert (second.source, second.target, second.low, second.high) == (0, 1, -1, Fraction(-1, 2))
    assert second.impacts == 2 and second.strip.box(arb(-1), arb(0)) == (-4, -2)
    assert second.strip.box(arb(1), arb(1)) == (-2, 0) and second.chain[0].centre == (1, 0)
    with pytest.raises(NotProvedError, match=r"entropy is not proved to be above 0\.41"):
        graph_of(entropy="0.41")


FIRST = "[0, 0, 0.5, 1, 1]"


@pytest.mark.parametrize(("old", "new", "reason"), [
    *((FIRST, f"[{row}]", "connection 0 does not lead from a set to a set") for row in (
        "2, 0, 0.5, 1, 1", "-1, 0, 0.5, 1, 1", "0, 2, 0.5, 1, 1", "0, -1, 0.5, 1, 1",
        "0.5, 0, 0.5, 1, 1", "0, 0.5, 0.5, 1, 1", "0, 0, 0.5, 1, 0", "0, 0, 0.5, 1, 1.5")),
    *((FIRST, f"[0, 0, {row}, 1]", "strip of connection 0 is not a part of its set") for row in (
        "0.5, 1.01", "-1.01, 1", "0.5, 0.5", "0.75, 0.5")),
    (", [2, 0, 1, 0, 0, 1]]", "]", "lacks sets of connection 3"),
    (", [2, 0, 1, 0, 0, 1]]", ", [2, 0, 1, 0, 0, 1], [3, 0, 1, 0, 0, 1]]", "more sets than"),
    (FIRST, "[0, 0, 0.25, 1, 1]", "two strips of B_0 overlap"),
    (FIRST, "[0, 0, -0.75, -0.25, 1]", "two strips of B_0 overlap"),
    (FIRST, "[0, 0, -0.75, -0.55, 1]", "two strips of B_0 overlap"),
    ("[1, 0, -0.5, 0.5, 1]", "[1, 0, -0.5, 0.5, 1], [1, 0, 0.5, 1, 1]", "of B_1 overlap"),
    ("growth = 1.5", "growth = 1", "growth is not above 1"),
    ("growth = 1.5", "growth = 0.5", "growth is not above 1"),
    ("[2, 1]\n", "[-1, 1]\n", "weight of B_0 is not positive"),
    ("[2, 1]\n", "[3, 1]\n", "at B_0 the weights"),
    ("[2, 1]\n", "[2, 1.4]\n", "at B_1 the weights"),
    ("growth = 1.5", "growth = 1.7", "the weights do not grow"),
])  # fmt: skip
def test_each_premise_of_a_graph_is_looked_at(old, new, reason, graph_of):
    with pytest.raises(NotProvedError, match=reason):
        graph_of(old, new)


def test_a_growth_may_be_exact():
    """Two loops of one impact: growth 2 needs each weight times 1/2 twice."""
    loops = [Connection(0, 0, 0, 0, None, ()), Connection(0, 0, 0, 0, None, ())]
    graph.check_growth(Graph([ONE], loops), Fraction(2), [Fraction(3)])
    with pytest.raises(NotProvedError, match="at B_0"):
        graph.check_growth(Graph([ONE], loops), Fraction(2) + Fraction(1, 10**30), [Fraction(3)])
    with pytest.raises(NotProvedError, match="weight of B_1 is not positive"):
        graph.check_growth(Graph([ONE, LEFT], loops), Fraction(2), [Fraction(3), Fraction(0)])


def test_the_entropy_is_that_of_the_paths():
    """The logarithm of the spectral radius of the matrix with a vertex for each impact."""
    theorem = THEOREMS["entropy-lower"]
    finding = theorem.prove()
    sets, connections = finding.parts["graph"].sets, finding.parts["graph"].connections
    size = len(sets) + sum(it.impacts - 1 for it in connections)
    matrix, free = np.zeros((size, size)), len(sets)
    for it in connections:
        path = [it.source, *range(free, free + it.impacts - 1), it.target]
        free += it.impacts - 1
        for a, b in pairwise(path):
            matrix[a, b] += 1.0
    entropy = np.log(np.abs(np.linalg.eigvals(matrix)).max())
    with ctx.workprec(64):
        bound = float(finding.digits["entropy"])
    assert float(theorem.bounds["entropy"]) < bound < entropy < bound + 5e-4


def test_a_loop_around_an_elliptic_orbit_is_refused():
    text = THEOREMS["no-circle"].text()
    points = numbers(THEOREMS["six-elliptic"].text(), "points")
    sides = (row[2:] for row in numbers(text, "saddles"))
    saddles = [[*point, *side] for point, side in zip(points, sides, strict=True)]
    assert "not hyperbolic" in refused("no-circle", with_rows(text, "saddles", saddles))
