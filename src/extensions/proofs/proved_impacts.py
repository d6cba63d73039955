"""./reproduce prove --impacts: every impact behind the figures is the first one."""

from collections.abc import Callable, Iterator
from fractions import Fraction

import numpy as np
import xarray as xr

from pipeline.checks.freshness import Freshness
from pipeline.config import PAPER, Config, paths
from pipeline.config.build_specs import build_specs
from pipeline.config.schema.scene import Picture
from pipeline.records.artifacts import load
from pipeline.records.sources import ROOT
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.orbits import orbit, start_state
from pseudorigid.dynamics.variables import of_type, states_of

from .theorems import impacts as proofs

Impacts = tuple[np.ndarray, ...]  # states before, states after, flight times


def impacts(checked: Config, progress: Callable[[str], None]) -> int:
    """Prove scene by scene that each impact behind the figures is the first one; print a line each.

    Every impact of portraits and of the orbits in motions is proved. Figures whose data have
    millions of impacts are sampled, as config.yaml says. `progress` is called with a line that says
    how many impacts are done. Returns 1 if an impact is not proved.
    Raises ValueError if a result is missing.
    """
    artifact_paths = paths.artifact_paths(checked.variants)
    freshness = Freshness(ROOT, build_specs(checked, [PAPER]))
    status, worst, sample = 0, 0.0, checked.blocks["prove"].as_mapping()["impacts"]
    for scene, block in checked.scenes.items():
        if why := freshness.refusal(paths.drawn(scene, "png")):
            print(f"{scene} is left out, cannot exist: {why}")
            continue
        k, g = (Fraction(str(block.as_mapping()["ball"][name])) for name in "kg")

        def data(stage: str, scene: str = scene) -> xr.Dataset:
            return load(ROOT / artifact_paths[PAPER, scene, stage])

        for part, (before, after, tau) in _impacts_behind(block, data, sample):
            name = f"{scene} {part}"

            def report(done: int, name: str = name, total: int = tau.size) -> None:
                progress(f"{name}: {done:,} of {total:,} impacts done")

            result = proofs.prove_impacts(k, g, before, after, tau, name=name, progress=report)
            print(result.line(), flush=True)
            status |= result.verdict != "proved"
            worst = max(worst, result.margins["worst error"])
    print(f"worst bound of an error: {worst:.3g}")
    return status


def _impacts_behind(
    scene: Picture, data: Callable[[str], xr.Dataset], sample: int
) -> Iterator[tuple[str, Impacts]]:
    """Yield the name and the impacts of each stage of a scene."""
    block, stages = scene.as_mapping(), paths.stages(scene)
    ball, energy = Ball(**block["ball"]), block["energy"]
    if {"orbits", "manifolds"} <= stages.keys():
        sample //= 2
    if "orbits" in stages:
        states = proofs.of_orbits(ball, energy, data("orbits"), block["starts"])
        yield "orbits", _evenly(states, sample) if "manifolds" in stages else states
    if "motion" in stages:
        yield "orbit", proofs.of_periodic(of_type(data("periodic"), block["type"]))
    if "manifolds" in stages:
        lines = states_of(data("manifolds"))
        lines = lines[:, ~np.isnan(lines[0])]
        lines[2] = np.maximum(lines[2], -lines[1])
        yield "manifolds", proofs.of_states(ball, *_evenly((lines,), sample))
    if "lyapunov" in stages:
        starts = [start_state(ball, energy, start) for start in block["starts"]]
        for i, start in enumerate(starts):
            track = orbit(ball, start, sample // len(starts))
            after = states_of(track)
            before = np.concatenate([np.array(start)[:, None], after[:, :-1]], axis=1)
            yield f"orbit {i}", (before, after, track["tau"].values)


def _evenly(arrays: Impacts, count: int) -> Impacts:
    """Take at most `count` columns of each array (..., n), evenly by index."""
    size = arrays[0].shape[-1]
    chosen = np.arange(min(count, size)) * size // min(count, size)
    return tuple(array[..., chosen] for array in arrays)
