"""./reproduce prove --impacts: every impact behind the figures is the first one."""

from fractions import Fraction

import numpy as np

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.orbits import orbit
from pseudorigid.dynamics.starts import start_state
from pseudorigid.dynamics.variables import of_type, states_of
from pseudorigid.proofs.theorems import impacts as proofs

from ..config import paths
from ..records.artifacts import load
from ..records.sources import ROOT


def impacts(checked) -> int:
    """Prove that each impact behind the figures is the first one, scene by scene, a line each.

    Of portraits, and of the orbits that motions repeat, every impact; of the figures whose data
    have millions of them as many as config.yaml says.

    Returns
    -------
    int
        1 where an impact is not proved to be the first.

    Raises
    ------
    ValueError
        Results that are missing.
    """
    artifact_paths = paths.artifact_paths(checked["variants"])
    status, worst, sample = 0, 0.0, checked["prove"]["impacts"]
    for scene, block in checked["scenes"].items():
        ball = Ball(**block["ball"])
        exact = [Fraction(str(block["ball"][name])) for name in "kg"]

        def data(stage, scene=scene):
            path = artifact_paths[paths.PAPER, scene, stage]
            if not (ROOT / path).is_file():
                raise ValueError(f"{path} is missing: run ./reproduce first")
            return load(ROOT / path)

        for what, states in _states(ball, block, data, sample):
            result = proofs.prove_impacts(*exact, *states, name=f"{scene} {what}")
            print(result.line(), flush=True)
            status |= result.verdict != "proved"
            worst = max(worst, result.margins["worst error"])
    print(f"worst bound of an error: {worst:.3g}")
    return status


def _states(ball, block, data, sample):
    """(what, (states before, after, tau)) of the impacts behind a scene."""
    energy, stages = block["energy"], paths.stages(block)
    if "orbits" in stages:
        orbits = data("orbits")
        states = proofs.of_orbits(ball, energy, orbits, block["starts"])
        every = "manifolds" not in stages
        yield "orbits", states if every else _evenly(states, sample // 2)
    if "motion" in stages:
        yield "orbit", proofs.of_periodic(of_type(data("periodic"), block["type"]))
    if "manifolds" in stages:
        lines = states_of(data("manifolds"))
        lines = lines[:, ~np.isnan(lines[0])]
        lines[2] = np.maximum(lines[2], -lines[1])
        (lines,) = _evenly((lines,), sample // 2 if "orbits" in stages else sample)
        yield "manifolds", proofs.of_states(ball, lines)
    if "lyapunov" in stages:
        starts = [start_state(ball, energy, start) for start in block["starts"]]
        each = sample // len(starts)
        for i, start in enumerate(starts):
            track = orbit(ball, start, each)
            after = states_of(track)
            before = np.concatenate([np.array(start)[:, None], after[:, :-1]], axis=1)
            yield f"orbit {i}", (before, after, track["tau"].values)


def _evenly(arrays, count):
    """Of each array (..., n) at most `count` columns, evenly by index."""
    size = arrays[0].shape[-1]
    chosen = np.arange(min(count, size)) * size // min(count, size)
    return tuple(array[..., chosen] for array in arrays)
