"""Compile the kernels before the workers start.

    python tests/helpers/compile_kernels.py

pseudorigid.kernel.compiled says where the machine code is kept. A second call does nothing.
"""

import hashlib
import os
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[1]), str(Path(__file__).parents[2] / "src")]


def compile_stages():
    from helpers import matrix_probe

    dict(matrix_probe.everything())


def compile_the_rest():
    """Call the ball's methods, a cell of a sweep, and the study."""
    import numpy as np

    from pipeline.declaration import parts
    from pseudorigid.dynamics.ball import Ball
    from pseudorigid.dynamics.ensemble import ImpactMap
    from pseudorigid.dynamics.lyapunov import lyapunov_spectrum

    if "atlas" in parts():
        from extensions.atlas import cell

        for count in (12, 100):
            cell.cell(0.2, 6.25, count, 200)
    state = Ball(0.2, 0.04).start(np.linspace(-0.9, 0.9, 30), 0.01)
    for how in (None, (0.1, 1e-12)):
        ball = Ball(0.2, 0.04, ImpactMap(how))
        lyapunov_spectrum(ball, state, 20, 1)
        for one in (state, [float(a[0]) for a in state]):
            for name in ("impact", "inverse_impact", "jacobian", "time_to_impact"):
                getattr(ball, name)(*one)
    if "study" not in parts():
        return
    from study import figure_errors, states
    from study.methods.counted_methods import OURS, engine_method, scan_method

    start = states.chaotic()
    for method in (OURS, scan_method(0.1, 1e-12), engine_method(1e-3)):
        method.solve(states.BALL, *states.uniform(20))
        method.orbit(states.BALL, start, 20)
    figure_errors._log_stretch(np.ones((3, 3, 3)))


if __name__ == "__main__":
    from pipeline.records.sources import SRC, syntax_hash
    from pseudorigid.kernel import compiled

    files = sorted(file for file in SRC.rglob("*.py") if b"@jit" in file.read_bytes())
    digest = hashlib.sha256(" ".join(map(syntax_hash, files)).encode()).hexdigest()
    done = Path(compiled.folders()[0], f"by the tests {digest[:16]}")
    if not done.exists():
        if child := os.fork():
            compile_stages()
            if os.waitpid(child, 0)[1] == 0:
                done.touch()
        else:
            compile_the_rest()
