"""./reproduce prove --impacts: no flight behind the figures passes an earlier impact.

Figures with millions of impacts are sampled.
"""

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from flint import arb

from pipeline.config import MAIN, Config
from pipeline.config.results import drawn, stage_parameters
from pipeline.config.schema.scene import Picture
from pipeline.jobs.heartbeat import clear_line
from pipeline.records.artifacts import load
from pipeline.records.provenance import Freshness
from pipeline.records.sources import ROOT
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.orbits import orbit, start_state
from pseudorigid.dynamics.variables import of_type, states_of
from pseudorigid.verified.reference_solver import decided, impact

from .enclosure.surface import Exact, ball_of, exact
from .theorems.statements import Result

_IMPACT_BITS = 96  # at first: a double's 53, and room for cancellation
_LARGEST_ERROR = 1e-6  # a larger one is no rounding error: another impact was taken


class Impacts(NamedTuple):
    """States (3, n) just before an impact and just before the next one, and the times between.

    The rows are x, xdot, udot.
    """

    before: np.ndarray
    after: np.ndarray
    tau: np.ndarray


def prove_figures(checked: Config, progress: Callable[[str], None]) -> int:
    """Prove scene by scene that each impact behind the figures is the first one; print a line each.

    All impacts of portraits, and of the orbits in motions, are proved. Figures whose data have
    millions are sampled: `prove: impacts` in scenes.yaml says how many. `progress` is called with a
    line that says how many impacts are done. Returns 1 if an impact is not proved, otherwise 0.
    Raises ValueError if a result is missing.
    """
    freshness = Freshness(ROOT, checked.build_specs([MAIN]))
    status, worst, sample = 0, 0.0, checked.document.prove.impacts  # of each
    for scene, block in checked.scenes.items():
        if why := freshness.refusal(drawn(scene, "png")):
            print(f"{scene} is left out, because it cannot exist: {why}")
            continue
        k, g = (Fraction(str(block.as_mapping()["ball"][name])) for name in "kg")

        def data(stage: str, scene: str = scene) -> xr.Dataset:
            return load(ROOT / checked.datasets[MAIN, scene, stage])

        for part, some in _impacts_behind(block, data, sample):
            name = f"{scene} {part}"

            def report(done: int, name: str = name, total: int = some.tau.size) -> None:
                progress(f"{name}: {done:,} of {total:,} impacts done")

            result = prove_impacts(k, g, some, name=name, progress=report)
            clear_line()
            print(result.line(), flush=True)
            status |= result.verdict != "proved"
            worst = max(worst, result.margins["worst error"])
    print(f"worst bound of an error: {worst:.3g}")
    return status


def prove_impacts(
    k: Exact,
    g: Exact,
    impacts: Impacts,
    name: str = "impacts",
    progress: Callable[[int], None] | None = None,
) -> Result:
    """Prove that each of many impacts is the first one, to within a small error.

    `progress` is called with the number of impacts done. The Result has the margin worst error.
    """
    errors = impact_errors(k, g, *impacts, progress)
    worst, reason = float(np.max(errors, initial=0.0)), ""
    if not errors.size:
        reason = "there are no impacts"
    elif worst == np.inf:
        reason = f"impact {np.argmax(errors)} grazes: which one is first is not decided"
    elif not worst < _LARGEST_ERROR:
        reason = f"impact {np.argmax(errors)} is off by {worst:.3g}: not the first one"
    statement = (
        f"each of {errors.size:,} impacts computed is the first one, to within {_LARGEST_ERROR:g}"
    )
    # There is no certificate: the third field begins the printed line.
    return Result(name, statement, name, reason, {}, {"worst error": worst})


def impact_errors(
    k: Exact,
    g: Exact,
    before: np.ndarray,
    after: np.ndarray,
    tau: np.ndarray,
    progress: Callable[[int], None] | None = None,
) -> np.ndarray:
    """Bound the errors of impacts that were computed in doubles, for an exact ball.

    `before` and `after`, shape (3, n), have x, xdot, udot just before an impact and just before the
    next one, and `tau` the durations of the flights. Returns upper bounds (n,) of the largest error
    of x', xdot', udot' and tau, with `before` taken as exact; infinite where the next impact is not
    proved. `progress` is called with the number of impacts done. Raises ValueError if k or g is not
    an exact number.
    """
    ball = exact("k", k), exact("g", g)
    bounds = np.full(tau.size, np.inf)
    for i, row in enumerate(np.vstack((before, after, tau)).T.tolist()):
        if progress is not None:
            progress(i)

        def error(state: list[float] = row[:3], computed: list[float] = row[3:]) -> arb:
            proved = impact(*map(ball_of, ball), *map(arb, state))
            errors = [abs(a - b).upper() for a, b in zip(proved, computed, strict=True)]
            return max(errors) if all(it.is_finite() for it in errors) else arb("inf")

        if (largest := decided(error, _IMPACT_BITS)) is not None:
            bounds[i] = np.nextafter(float(largest), np.inf)
    return bounds


def _impacts_behind(
    scene: Picture, data: Callable[[str], xr.Dataset], sample: int
) -> Iterator[tuple[str, Impacts]]:
    """Yield a name and impacts for each stage of a scene, and for each orbit of exponents."""
    block, used = scene.as_mapping(), stage_parameters(scene).keys()
    ball, energy = Ball(**block["ball"]), block["energy"]
    if {"orbits", "manifolds"} <= used:
        sample = max(1, sample // 2)  # for each of the two
    if "orbits" in used:
        its = of_orbits(ball, energy, data("orbits"), block["starts"])
        yield "orbits", Impacts(*_evenly(its, sample)) if "manifolds" in used else its
    if "motion" in used:
        track = of_type(data("periodic"), block["type"])
        states = states_of(track)
        yield "orbit", Impacts(states, np.roll(states, -1, axis=1), track["tau"].values)
    if "manifolds" in used:
        lines = states_of(data("manifolds"))
        lines = lines[:, ~np.isnan(lines[0])]
        # A point on the rim may lie below it by a rounding, and would be refused.
        lines[2] = np.maximum(lines[2], -lines[1])
        (before,) = _evenly((lines,), sample)
        x, xdot, udot, tau = ball.impact(*before)
        yield "manifolds", Impacts(before, np.array([x, xdot, udot]), np.asarray(tau))
    if "lyapunov" in used:
        starts = [start_state(ball, energy, start) for start in block["starts"]]
        for i, start in enumerate(starts):
            track = orbit(ball, start, max(1, sample // len(starts)))
            after = states_of(track)
            before = np.concatenate([np.array(start)[:, None], after[:, :-1]], axis=1)
            yield f"orbit {i}", Impacts(before, after, track["tau"].values)


def of_orbits(ball: Ball, energy: float, orbits: xr.Dataset, starts: list[Any]) -> Impacts:
    """Return all impacts of a dataset of `scene_orbits`.

    The starts are in the form that `orbits.start_state` takes.
    """
    state = states_of(orbits)
    before = np.roll(state, 1, axis=1)
    sizes = orbits["row_size"].values
    first = np.cumsum(sizes) - sizes
    # the first impact of an orbit follows its start
    before[:, first] = np.array([start_state(ball, energy, start) for start in starts]).T
    return Impacts(before, state, orbits["tau"].values)


def _evenly(arrays: tuple[np.ndarray, ...], count: int) -> tuple[np.ndarray, ...]:
    """Take at most `count` columns of each array (..., n), evenly by index."""
    size = arrays[0].shape[-1]
    chosen = np.arange(min(count, size)) * size // min(count, size)
    return tuple(array[..., chosen] for array in arrays)
