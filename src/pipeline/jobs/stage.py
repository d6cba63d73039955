"""The job that computes the dataset of a stage, or of a part of one."""

import inspect
import sys
import time
import warnings
from collections.abc import Callable
from typing import Any

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.bounds import NO_SPHERE
from pseudorigid.dynamics.ensemble import ImpactMap

from ..declaration import imported
from ..records import artifacts
from ..records.provenance import BuildSpec


def _progress(spec: BuildSpec) -> Callable[[float, str], None]:
    """Return a function f(share, text) that prints what is done of a stage, at most every 4 s."""
    reported = 0.0

    def progress(share: float, text: str) -> None:
        nonlocal reported
        if time.monotonic() > reported + 4.0:
            print(f"{spec.scene}: {share:.0%}, {text}", file=sys.stderr, flush=True)
            reported = time.monotonic()

    return progress


def make(spec: BuildSpec, **known: Any) -> dict[str, Any] | None:
    """Compute a dataset with the function that the specification names, and save it.

    The function also gets what is `known` already, which decides no value.

    `declaration.Stage` says how the function is called. With a `method` that scans, the ball's map
    finds impacts by it, and the dataset says how many it missed. Returns notes for the user.
    """
    warnings.filterwarnings("ignore", NO_SPHERE)  # the command said so when it read the config
    block, function = spec.config, imported(spec.function)
    fields = {key: block[key] for key in block.keys() - {"ball", "energy", "method"}} | known
    parameters = inspect.signature(function).parameters
    if "progress" in parameters:
        fields["progress"] = _progress(spec)
    if "folder" in parameters:  # where it keeps finished parts, so that a killed run goes on
        fields["folder"] = f"{spec.result}.part"
    inputs = [artifacts.load(path) for path in spec.inputs]
    title = function.__name__.removeprefix("scene_").replace("_", " ").capitalize()
    attributes: dict[str, Any] = {"stage": spec.step, "title": title}
    if "ball" not in block:
        energies = {"energy": block["energy"]} if "energy" in block else {}
        dataset = function(*inputs, **fields, **energies)
        artifacts.save(dataset, spec.result, block, **(attributes | dataset.attrs))
        return None
    method = block.get("method", {})
    scan = ImpactMap((method["scan"], method["tolerance"])) if "scan" in method else None
    # config.yaml was checked before a variant's scale changed its unit of length.
    ball = Ball.unbounded(**block["ball"], map=scan)
    dataset = function(ball, block["energy"], *inputs, **fields)
    notes = [f"{spec.step} by the method {name}; all else in doubles" for name in method]
    if "scan" in method:
        missed, total = f"{ball.map.missed:,}", f"{ball.map.impacts:,}"
        values = ", ".join(f"{key} {value:g}" for key, value in method.items())
        notes = [f"{missed} of {total} impacts fell through the floor ({values})"]
        dataset.attrs |= {"impacts": ball.map.impacts, "impacts_missed": ball.map.missed}
    attributes |= {"k": ball.k, "g": ball.g, "energy": float(block["energy"])}
    artifacts.save(dataset, spec.result, block, **attributes)
    return {"notes": notes} if notes else None
