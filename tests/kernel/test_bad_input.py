"""Flights whose search would not end."""

import os
import subprocess
import sys

import pytest
from project import ROOT

from pseudorigid.dynamics.ball import Ball

BALL = Ball(0.2, 0.04)


@pytest.mark.parametrize(
    ("phase", "state"),
    [
        ("march", (-0.22, -0.01, 0.48)),
        ("landing", (0.01, 0.45, -0.36)),
    ],
)
def test_caps_raise(phase, state):
    """With the cap at one evaluation a flight ends in an error, with the real cap in an impact."""
    assert BALL.time_to_impact(*state) > 0.0
    code = (
        "from pseudorigid import Ball\nfrom pseudorigid.kernel import flight\n"
        "flight.MOST_EVALUATIONS = 1\n"
        f"try: print(Ball(0.2, 0.04).impact{state})\nexcept ArithmeticError as e: print(e)"
    )
    environment = os.environ | {"PYTHONPATH": str(ROOT / "src"), "NUMBA_DISABLE_JIT": "1"}
    command = [sys.executable, "-c", code]
    run = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    assert (run.returncode, phase in run.stdout) == (0, True), run.stdout + run.stderr
