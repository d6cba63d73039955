"""Compute a stage of a scene."""

import sys
from collections.abc import Callable
from importlib import import_module
from typing import Any

import xarray as xr

from pseudorigid.dynamics.ball import Ball

from ..records import artifacts
from ..records.build_spec import BuildSpec
from ..records.stage_call import compute_stage

# Stages that report their progress and keep finished parts, so that a killed run goes on.
RESUMED = {"families"}


def _as_text(start: Any) -> Any:
    """Return a start with its numbers as decimal text."""
    if isinstance(start, dict):
        return {name: str(value) for name, value in start.items()}
    return str(start)


def _compute_exactly(
    function: Callable[..., xr.Dataset], spec: BuildSpec, fields: dict[str, Any]
) -> xr.Dataset:
    """Compute orbits from the decimals of the config."""

    def progress(share: float, orbit: int) -> None:
        orbit_name = f"{spec.scene}: orbit {orbit + 1} of {len(fields['starts'])}"
        print(f"{orbit_name}: {share:.0%}", file=sys.stderr, flush=True)

    numbers = {**spec.config["ball"], "energy": spec.config["energy"]}
    return function(
        **{name: str(value) for name, value in numbers.items()},
        **fields | {"starts": [_as_text(start) for start in fields["starts"]]},
        progress=progress,
    )


def _resumable(spec: BuildSpec) -> dict[str, Any]:
    """Return the arguments by which a long stage reports its progress and keeps its work."""
    reported = 0.0

    def progress(share: float, text: str) -> None:
        nonlocal reported
        if share >= reported:
            print(f"{spec.scene}: {share:.0%}, {text}", file=sys.stderr, flush=True)
            reported = share + 0.05

    return {"progress": progress, "folder": f"{spec.result}.part"}


def make(spec: BuildSpec) -> None:
    """Compute with the module and function that the specification names."""
    block, (module, name) = spec.config, spec.given
    function = getattr(import_module(module), name)
    method, ball = block.get("method", {}), Ball(**block["ball"])
    fields = {key: block[key] for key in block.keys() - {"ball", "energy", "method"}}
    if "exact" in method:
        dataset = _compute_exactly(function, spec, fields)
    else:
        inputs = [artifacts.load(path) for path in spec.inputs]
        if spec.step in RESUMED:
            fields |= _resumable(spec)
        dataset = compute_stage(function, ball, block["energy"], inputs, fields, method)
    attributes = {"stage": spec.step, "k": ball.k, "g": ball.g, "energy": float(block["energy"])}
    title = artifacts.title_of(function)
    artifacts.save(dataset, spec.result, block, **attributes, title=title)
