"""Time to the next impact against a proved first root, on families of hard states."""

import hashlib
import os
import sys

import mpmath
import numpy as np
import pytest
from flights import FAMILIES, TAU, ahead, before, by_mpmath, error
from independent_solver import judge
from mpmath import mpf
from project import ROOT, run
from slowly import slowly

from pseudorigid.dynamics.ball import Ball
from pseudorigid.proofs.reference_solver import first_root

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


# States for which tau was once wrong.
REGRESSIONS = {
    "crawl near x = -g": [
        (0.3289125415507421, 0.017647215105901212, -0.01764721512065695,
         5.873262117074811e-06, -5.873262117074811e-06),
        (0.04535202124096532, 0.5431580930869265, -0.5431580954767156,
         -0.016077036100503712, 0.016077036100503712),
        (0.014719917971985214, 0.004874144455380341, -0.004874140553574476,
         -0.00040587674124387894, 0.0004058767412579457),
    ],
    "rounded first coefficients of the tails": [
        (0.12648022627918645, 0.7302986566236053, -0.7302986566236053,
         0.19784995088390755, -0.19784995087390705),
        (0.028899114230446245, 0.005521998014898891, -0.005518066548890867,
         0.1390151388881047, -0.13900687152499422),
    ],
    "f'' without g + x grouped": [
        (0.20579185302188838, 0.020898535157525072, -0.020898535157525114,
         0.004666515600934809, -0.004666515600934809),
        (0.08464709262553416, 0.03564797776194839, -0.03564797776197182,
         0.00039232098767921894, -0.00039232098767921894),
    ],
    "squares beyond the range of doubles": [
        (0.2, 1e300, 0.1, 0.1, 0.1), (0.2, 1e200, 0.1, 0.1, 0.1),
    ],
    "wide arguments of sincos": [
        (1.0, 2.0**-22, 0.25, *ahead(*before(1.0, -0.5, 0.125)))
    ],
}  # fmt: skip


@pytest.mark.parametrize("name", REGRESSIONS)
def test_regressions(name):
    for state in REGRESSIONS[name]:
        assert error(state) <= TAU, state


@pytest.mark.parametrize("v", [0.3, 1e-8, 0.0, -1e-8, -0.3])
@pytest.mark.parametrize("k", [5e-324, 1e-16, 1e-9, 0.01, 0.2, 1 / 3, 1.0])
@pytest.mark.parametrize("g", [1e-4, 0.04, 1.0])
@pytest.mark.parametrize("share", [0.0, 0.5, -0.5, -1.0, -2.0, 3.0, 1000.0])
def test_corners(k, g, share, v):
    """Cover k near 0, 1/3 and 1, x around -g, and states on the rim and close to it."""
    for s in (0.0, 1e-12, 0.1):
        if s > 0.0 or v != 0.0:
            assert error((k, g, share * g, v, s - v)) <= TAU, s


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
