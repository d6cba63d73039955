"""Premises: each function that encloses something under one refuses what is outside it."""

import json
from fractions import Fraction

import numpy as np
import pytest
from certificates import numbers, refused, with_field, with_rows
from flint import arb

from extensions.proofs import THEOREMS, Surface, proved_impacts
from extensions.proofs.checkers import (
    fixed_point,
    one_zero,
    periodic,
)
from extensions.proofs.checkers.certificate import NotProvedError
from extensions.proofs.enclosure.surface import ball_of
from pseudorigid.verified import reference_solver

PAPER = Surface("1/5", "1/25", "1/100")
K, G = Fraction(1, 5), Fraction(1, 25)


@pytest.mark.parametrize(("name", "field", "value", "reason"), [
    ("jump-set", "speed", "0.1172", "rim point with x < -g"),
    ("jump-set", "radius", "0", "not above 0 and at most"),
    ("no-circle", "touches", ["-0.13835", "-0.13670"], "rim point with x < -g"),
    ("one-fixed-point", "theta_below", "-3.66", "theta is not proved"),
    ("one-fixed-point", "theta_below", "4.8", "theta is not proved"),
    ("fixed-point-elliptic", "theta", ["2.30867038629863620493595529693534352062"] * 2, "1e-30"),
    ("fixed-point-elliptic", "theta", ["0", "1e-31"], "between 0 and pi"),
    ("fixed-point-elliptic", "bands", 1, "each band"),
    ("fixed-point-elliptic", "bands", -4, "bands"),
    ("fixed-point-elliptic", "bands", 10**9, "bands"),
    ("fixed-point-elliptic", "trace_above", "-1/2", "not -0.46"),
    ("fixed-point-elliptic", "trace_above", "-0.45", "not proved to be above"),
    ("fixed-point", "radius", "5e-03", "boxes"),
    ("twist-six", "twist", "0", "not the stated"),
    ("twist-six", "twist", "1028.719239086", "not the stated"),
    ("twist-ten", "twist", "-4416.404133650", "not the stated"),  # 1e-8 of it off
    ("twist-six", "radius", "5e-05", "as stated"),
    ("twist-zero", "width", "0", "not above 0 and at most"),
    ("twist-zero", "width", "1e-12", "width"),
    ("twist-zero", "width", "nan", "width"),
    ("twist-zero", "radius", "1e-3", "as stated"),
    ("twist-zero", "energy", "-1/250", "not allowed: above"),
    ("twist-zero", "energy", "0.0291977581390", ""),  # 1e-13 off
    ("curve-six", "loss", "0.02", "6 times the loss"),
])  # fmt: skip
def test_a_number_outside_a_premise_or_the_statement_is_refused(name, field, value, reason):
    text = json.dumps(value)  # TOML has numbers, strings and lists in the same form
    assert reason in refused(name, with_field(THEOREMS[name].text(), field, text))


@pytest.mark.parametrize(("name", "field", "row", "columns", "values", "reason"), [
    ("entropy-lower", "sets", 0, (2, 3), None, "sides may be parallel"),
    ("no-circle", "chain", -1, (2, 3), None, "sides may be parallel"),
    ("no-circle", "saddles", 2, (0, 1), ("0.21107112", "0.03071019"), "Newton|floor|period"),
    ("horseshoe-outer", "approach", 0, (4, 5), ("0", "0"), "sides may be parallel"),
    ("six-elliptic", "points", 3, (0, 1), ("0.6", "0.1"), "rim"),
])  # fmt: skip
def test_rows_outside_a_premise_are_refused(name, field, row, columns, values, reason):
    text = THEOREMS[name].text()
    rows = numbers(text, field)
    if values is None:  # the expanding side becomes the contracting one
        values = rows[row][4:]
    for column, value in zip(columns, values, strict=True):
        rows[row][column] = f'"{value}"'
    refusal = refused(name, with_rows(text, field, rows))
    assert any(word in refusal for word in reason.split("|")), refusal


@pytest.mark.parametrize(("name", "bounds", "reason"), [
    ("one-fixed-point", {"k": Fraction(-1, 5)}, "no ball"),
    ("diffeomorphism", {"g": Fraction(0)}, "no ball"),
    ("twist-one-zero", {"zero": (Fraction(1, 100), Fraction(7, 100))}, "do not reach"),
    ("six-birth", {"rotation": Fraction(5, 6)}, "no two orbits"),
    ("six-birth", {"energies": (Fraction(0), Fraction(1, 50))}, "beyond theta"),
])  # fmt: skip
def test_a_statement_outside_a_premise_is_refused(name, bounds, reason):
    assert reason in refused(name, None, **bounds)


OUTSIDE = {
    "energy: theta > pi": lambda: fixed_point.energy_at(arb(1), arb(1), arb(4)),
    "trace: theta > pi": lambda: fixed_point.trace_at(arb(1), arb(4)),
    "slope: theta about pi": lambda: fixed_point.slope_at(arb(1), arb(3.1, 0.1)),
    "band: beyond": lambda: one_zero.over_band(K, G, Fraction(5, 2), Fraction(13, 5)),
    "orbit: radius": lambda: periodic.prove(PAPER, [[Fraction(0), Fraction(0)]], Fraction(-1)),
}


@pytest.mark.parametrize("case", OUTSIDE)
def test_nothing_is_enclosed_outside_a_premise(case):
    with pytest.raises((NotProvedError, ValueError, ArithmeticError)) as refusal:
        OUTSIDE[case]()
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("place", range(4))
def test_an_impact_that_is_off_has_its_error_and_one_that_is_no_number_no_bound(place):
    before = np.array([[0.1], [0.05], [0.06]])
    exact = reference_solver.impact(ball_of(K), ball_of(G), *map(arb, before[:, 0]))
    impact = np.array([[float(a)] for a in exact])
    assert proved_impacts.impact_errors(K, G, before, impact[:3], impact[3]) < 1e-15
    impact[place] += 1e-3
    assert 1e-3 - 1e-15 < proved_impacts.impact_errors(K, G, before, impact[:3], impact[3]) < 1.1e-3
    impact[place] = np.nan
    assert proved_impacts.impact_errors(K, G, before, impact[:3], impact[3]) == np.inf
