"""Compute a stage of a scene: the function of the science that the specification names."""

import sys
from importlib import import_module

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap

from ..records import artifacts


def _as_text(start):
    """A start with its decimals as text."""
    if isinstance(start, dict):
        return {name: str(value) for name, value in start.items()}
    return str(start)


def _compute_exactly(compute, spec, fields):
    """Compute from the decimals as they are written; finished orbits are kept while it lasts."""

    def progress(share, seconds, orbit):
        place = f"{spec.scene}: orbit {orbit + 1} of {len(fields['starts'])}"
        print(f"{place}: {share:.0%}, {seconds:.0f} s to go", file=sys.stderr, flush=True)

    numbers = {**spec.config["ball"], "energy": spec.config["energy"]}
    return compute(
        **{name: str(value) for name, value in numbers.items()},
        **fields | {"starts": [_as_text(start) for start in fields["starts"]]},
        progress=progress,
        folder=f"{spec.result}.part",
    )


def make(spec):
    """Compute the result of a BuildSpec."""
    block, (module, function) = spec.config, spec.given
    compute = getattr(import_module(module), function)
    # A block with a `method` is computed by it, and its data say how many impacts that missed.
    method = block.get("method", {})
    root_finder = ImpactMap((method["scan"], method["tolerance"]) if "scan" in method else None)
    ball = Ball(**block["ball"], map=root_finder)
    inputs = [artifacts.load(path) for path in spec.inputs]
    fields = {key: block[key] for key in block.keys() - {"ball", "energy", "method"}}
    if "exact" in method:
        dataset = _compute_exactly(compute, spec, fields)
    else:
        dataset = compute(ball, block["energy"], *inputs, **fields)
    if "scan" in method:
        dataset.attrs |= {"impacts": root_finder.impacts, "impacts_missed": root_finder.missed}
    about = {"stage": spec.step, "k": ball.k, "g": ball.g, "energy": float(block["energy"])}
    about["title"] = artifacts.title_of(compute)
    artifacts.save(dataset, spec.result, block, **about)
