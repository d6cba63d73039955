"""Compute a stage of a scene."""

import sys
from collections.abc import Callable
from importlib import import_module

from pseudorigid.dynamics.ball import Ball

from ..records import artifacts
from ..records.build_spec import BuildSpec
from ..records.stage_call import compute_stage

# Stages that keep finished parts, so that a killed run goes on.
RESUMED = {"families"}


def _progress(spec: BuildSpec) -> Callable[[float, str], None]:
    """Return a function by which a long stage reports the share that is done, every 5 %."""
    reported = 0.0

    def progress(share: float, text: str) -> None:
        nonlocal reported
        if share >= reported:
            print(f"{spec.scene}: {share:.0%}, {text}", file=sys.stderr, flush=True)
            reported = share + 0.05

    return progress


def make(spec: BuildSpec) -> None:
    """Compute with the module and function that the specification names."""
    block, (module, name) = spec.config, spec.given
    function = getattr(import_module(module), name)
    method, ball = block.get("method", {}), Ball(**block["ball"])
    fields = {key: block[key] for key in block.keys() - {"ball", "energy", "method"}}
    if spec.step in RESUMED or "exact" in method:
        fields["progress"] = _progress(spec)
    if spec.step in RESUMED:
        fields["folder"] = f"{spec.result}.part"
    inputs = [artifacts.load(path) for path in spec.inputs]
    dataset = compute_stage(function, ball, block["energy"], inputs, fields, method)
    attributes = {"stage": spec.step, "k": ball.k, "g": ball.g, "energy": float(block["energy"])}
    title = artifacts.title_of(function)
    artifacts.save(dataset, spec.result, block, **attributes, title=title)
