"""Input that is no state and balls that are none; and flights that would not end."""

import math
import os
import subprocess
import sys

import numpy as np
import pytest
from project import ROOT

from pseudorigid.dynamics.ball import Ball

BALL = Ball(0.2, 0.04)
BAD = (math.nan, math.inf, -math.inf)


@pytest.mark.parametrize("bad", BAD)
@pytest.mark.parametrize("place", range(3))
def test_what_is_not_finite(place, bad):
    """NaN in every number, at once, and for inverses."""
    for others in ((0.1, 0.2, 0.3), (math.inf,) * 3, (math.nan,) * 3):
        state = [*others]
        state[place] = bad
        assert np.isnan(BALL.impact(*state)).all()
        assert np.isnan(BALL.inverse_impact(*state)).all()
        assert np.isnan(BALL.jacobian(*state)).all()


def test_one_bad_state_among_good_ones_spoils_nothing():
    x = np.array([0.1, math.nan, 0.2, math.inf, -0.1])
    found = np.array(BALL.impact(x, 0.1, 0.3))
    for i in (0, 2, 4):
        assert found[:, i].tolist() == list(BALL.impact(x[i], 0.1, 0.3))
    assert np.isnan(found[:, [1, 3]]).all()


@pytest.mark.parametrize("bad", [*BAD, 0.0, -1.0])
def test_balls_that_are_none(bad):
    for k, g, name in ((bad, 0.04, "k"), (0.2, bad, "g")):
        with pytest.raises(ValueError, match=rf"^{name} = .* is not allowed"):
            Ball(k, g)


@pytest.mark.parametrize(
    ("words", "state"),
    [
        ("march", (-0.22, -0.01, 0.48)),
        ("landing", (0.01, 0.45, -0.36)),
    ],
)
def test_caps_raise(words, state):
    """With the cap at one evaluation a flight ends in an error; with the real one in an impact."""
    assert BALL.time_to_impact(*state) > 0.0
    code = (
        "from pseudorigid import Ball\nfrom pseudorigid.kernel import flight\n"
        "flight.MOST_EVALUATIONS = 1\n"
        f"try: print(Ball(0.2, 0.04).impact{state})\nexcept ArithmeticError as e: print(e)"
    )
    environment = os.environ | {"PYTHONPATH": str(ROOT / "src"), "NUMBA_DISABLE_JIT": "1"}
    command = [sys.executable, "-c", code]
    run = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    assert (run.returncode, words in run.stdout) == (0, True), run.stdout + run.stderr
