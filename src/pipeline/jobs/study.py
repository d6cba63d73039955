"""Compute a part of the study: data that are equal on every machine, or measured times."""

from collections.abc import Callable
from importlib import import_module
from typing import Any

import xarray as xr

from pseudorigid.study import failures, figure_errors, states, work
from pseudorigid.study.machine import machine
from pseudorigid.study.methods.counted_methods import METHODS, OURS

from ..records import artifacts
from ..records.build_spec import BuildSpec

# The settings of external solvers that are compared near grazing.
_GRAZING_SOLVERS = (
    "certified march",
    "brentq 0.1, 1e-12",
    "RK45, 1e-06",
    "DOP853, 1e-09",
    "DOP853, steps <= 0.1, 1e-12",
    "LSODA, 1e-09",
    "heyoka any, 1e-15",
    "heyoka positive, 1e-15",
)


def _library_solvers() -> list[Any]:
    """Return the solvers whose packages are installed for the study alone."""
    modules = [import_module(f"pseudorigid.study.methods.{n}") for n in ("scipy_events", "taylor")]
    return [solver for module in modules for solver in module.METHODS]


def _grazing_solvers() -> list[Any]:
    return [m for m in (OURS, *_library_solvers()) if m.name in _GRAZING_SOLVERS]


def make(spec: BuildSpec) -> None:
    """Compute the part that the block of config names; measured parts describe the machine."""
    part = spec.config["part"]
    figures = {(stage, scene): artifacts.load(path) for stage, scene, path in spec.given}
    parts: dict[str, Callable[[], xr.Dataset]] = {
        "work": work.counted,
        "edges": lambda: failures.edges(failures.EDGE_METHODS),
        "orbits": failures.orbits,
        "needs": lambda: figure_errors.figure_errors(
            spec.config["scenes"], spec.config["measures"], figures
        ),
        # takes long to import
        "verdicts": lambda: import_module("pseudorigid.study.verdicts").verdicts(),
        "work_all": lambda: work.measured([*METHODS, *_library_solvers()]),
        "edges_all": lambda: failures.edges(_grazing_solvers(), 40),
        "missed_all": lambda: failures.missed(_grazing_solvers()),
    }
    dataset = parts[part]()
    if part.endswith("_all"):
        dataset.attrs |= machine()
    attributes: dict[str, Any] = {"stage": "study", "title": f"Methods compared: {part}"}
    if part != "verdicts":  # which are on cells with many values of k and energy
        attributes |= {"k": states.BALL.k, "g": states.BALL.g, "energy": states.ENERGY}
    artifacts.save(dataset, spec.result, {"part": part}, **attributes)
