"""Compile what the tests use, once: workers that start together would each do it for themselves.

    python tests/warm.py

Machine code is kept where pseudorigid.kernel.compiled says, in a folder that any edit of what is
compiled renames; a second call does nothing.
"""

import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[1] / "src")]


def compile_all():
    """Call everything with the types that it is called with."""
    import matrix_probe
    import numpy as np

    from pseudorigid.dynamics.ball import Ball
    from pseudorigid.study import figure_errors, states
    from pseudorigid.study.methods import counted
    from pseudorigid.sweep import cell

    dict(matrix_probe.everything())
    state = matrix_probe.BALL.start(np.linspace(-0.9, 0.9, 30), 0.01)
    for ball in (matrix_probe.BALL, Ball(0.2, 0.04, matrix_probe.ImpactMap((0.1, 1e-12)))):
        for one in (state, [float(a[0]) for a in state]):
            for name in ("impact", "inverse_impact", "jacobian", "time_to_impact"):
                getattr(ball, name)(*one)
    cell.cell(0.2, 6.25, 12, 200)
    start = states.chaotic()
    for method in (counted.OURS, counted.scan_method(0.1, 1e-12), counted.engine_method(1e-3)):
        method.solve(states.BALL, *states.uniform(20))
        method.orbit(states.BALL, start, 20)
    figure_errors._growth(np.ones((3, 3, 3)))


if __name__ == "__main__":
    from pseudorigid.kernel import compiled

    done = Path(compiled._CACHE) / "by the tests"
    if not done.exists():
        compile_all()
        done.touch()
