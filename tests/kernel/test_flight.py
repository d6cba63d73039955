"""Time to the next impact against a proved first root, on families of hard states."""

import hashlib
import os
import sys

import mpmath
import numpy as np
import pytest
from flights import FAMILIES, TAU, by_mpmath, error
from independent_solver import judge
from mpmath import mpf
from project import ROOT, run
from slowly import slowly

from pseudorigid.dynamics.ball import Ball
from study.reference_solver import first_root

# sha256 of the times in test_frozen_bits_of_many_flights
FROZEN = "17974d2c018124caaa0b355ed33a3819b44222e6f11b4825fe09d60f1405d4c0"


def states(family, seed, count):
    rng = np.random.default_rng([seed, FAMILIES.index(family)])
    return [tuple(float(a) for a in family(rng)) for _ in range(count)]


@pytest.mark.parametrize(
    ("seed", "count"), [(1, 400), *slowly(*((seed, 1250) for seed in range(100, 114)))]
)
@pytest.mark.parametrize("family", FAMILIES)
def test_tau_against_the_proved_root(family, seed, count):
    worst, state = max((error(state), state) for state in states(family, seed, count))
    assert worst <= TAU, state


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES)
def test_both_reference_solvers_agree(family):
    """Two methods that find the first root independently agree to 40 digits."""
    decided = 0
    for state in states(family, 2, 500):
        true = judge(*state)
        tau = Ball(*state[:2]).time_to_impact(*state[2:])
        assert by_mpmath(tau, true) <= TAU, state
        try:
            root = first_root(*state)
        except ArithmeticError:
            assert true.depth < 1e-15 or true.slope == 0, state
            continue
        decided += 1
        with mpmath.workdps(60):
            mantissa, exponent = root.mid().man_exp()
            off = abs(mpmath.ldexp(mpf(int(mantissa)), int(exponent)) - true.tau)
            spare = true.tau * max(1, true.condition) if true.tau else 0
            assert off <= spare * mpf(10) ** -40, state
    assert decided > 490


def test_frozen_bits_of_many_flights():
    """Times at 12,000 states of three balls have the same bits on every machine."""
    rng = np.random.default_rng(20)
    x, v, w = rng.random((3, 12_000)) - 0.5
    v, w = np.where(v + w < 0, -v, v), np.where(v + w < 0, -w, w)
    tau = np.concatenate([Ball(0.2, g).time_to_impact(x, v, w) for g in (2.0**-12, 0.04, 0.9)])
    digest = hashlib.sha256(tau.astype("<f8").tobytes()).hexdigest()
    assert digest == FROZEN


@pytest.mark.parametrize(
    ("phase", "state"), [("march", (-0.22, -0.01, 0.48)), ("landing", (0.01, 0.45, -0.36))]
)
def test_caps_raise(phase, state):
    """With the cap at one evaluation a flight ends in an error, with the real cap in an impact."""
    assert Ball(0.2, 0.04).time_to_impact(*state) > 0.0
    code = (
        "from pseudorigid import Ball\nfrom pseudorigid.kernel import flight\n"
        "flight.MOST_EVALUATIONS = 1\n"
        f"try: print(Ball(0.2, 0.04).impact{state})\nexcept ArithmeticError as e: print(e)"
    )
    environment = os.environ | {"PYTHONPATH": str(ROOT / "src"), "NUMBA_DISABLE_JIT": "1"}
    result = run(sys.executable, "-c", code, env=environment)
    assert (result.returncode, phase in result.stdout) == (0, True), result.stdout + result.stderr


@pytest.mark.parametrize("exponent", [-1000, -700, 700, 1000])
def test_no_unit_of_length_is_too_small_or_large(exponent):
    """Squares of such lengths overflow or underflow; the march once did not end."""
    unit = 2.0**exponent
    state = (-0.05, 0.1, 0.3)
    expected = Ball(0.2, 0.04).impact(*state)
    *after, tau = Ball(0.2, 0.04 * unit).impact(*(unit * a for a in state))
    assert (*after, tau) == (*(unit * a for a in expected[:3]), expected[3])
