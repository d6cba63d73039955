"""Compute a stage of a scene."""

import inspect
import sys
import time
from collections.abc import Callable
from importlib import import_module

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap

from ..records import artifacts
from ..records.build_spec import BuildSpec


def _progress(spec: BuildSpec) -> Callable[[float, str], None]:
    """Return a function by which a long stage reports the share that is done, every 4 s."""
    reported = 0.0

    def progress(share: float, text: str) -> None:
        nonlocal reported
        if time.monotonic() > reported + 4.0:
            print(f"{spec.scene}: {share:.0%}, {text}", file=sys.stderr, flush=True)
            reported = time.monotonic()

    return progress


def make(spec: BuildSpec) -> None:
    """Compute with the module and function that the specification names."""
    block, (module, name) = spec.config, spec.given
    function = getattr(import_module(module), name)
    method, ball = block.get("method", {}), Ball(**block["ball"])
    fields = {key: block[key] for key in block.keys() - {"ball", "energy", "method"}}
    taken = inspect.signature(function).parameters
    if "progress" in taken:
        fields["progress"] = _progress(spec)
    if "folder" in taken:  # keeps finished parts, so that a killed run goes on
        fields["folder"] = f"{spec.result}.part"
    inputs = [artifacts.load(path) for path in spec.inputs]
    if "scan" in method:
        ball = Ball(ball.k, ball.g, map=ImpactMap((method["scan"], method["tolerance"])))
    dataset = function(ball, block["energy"], *inputs, **fields)
    if "scan" in method:
        dataset.attrs |= {"impacts": ball.map.impacts, "impacts_missed": ball.map.missed}
    attributes = {"stage": spec.step, "k": ball.k, "g": ball.g, "energy": float(block["energy"])}
    title = artifacts.title_of(function)
    artifacts.save(dataset, spec.result, block, **attributes, title=title)
