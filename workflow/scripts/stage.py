"""One stage of a scene: the function of the science that the rule names, on the scene's block."""

import os
import sys
from importlib import import_module

from pipeline.records import artifacts
from pipeline.records.job import one_line_errors, recorded
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap

block = snakemake.params.block
os.environ["OMP_NUM_THREADS"] = str(snakemake.threads)


def written(start):
    """A start with its decimals as text."""
    if isinstance(start, dict):
        return {name: str(value) for name, value in start.items()}
    return str(start)


def compute_exactly(compute, fields):
    """From the decimals as they are written; finished orbits are kept while the job lasts."""
    what = f"{snakemake.wildcards.variant}/{snakemake.wildcards.scene}"

    def progress(share, seconds, orbit):
        place = f"{what}: orbit {orbit + 1} of {len(fields['starts'])}"
        print(f"{place}: {share:.0%}, {seconds:.0f} s to go", file=sys.stderr, flush=True)

    numbers = {**block["ball"], "energy": block["energy"]}
    return compute(
        **{name: str(value) for name, value in numbers.items()},
        **fields | {"starts": [written(start) for start in fields["starts"]]},
        progress=progress,
        folder=f"{snakemake.output[0]}.part",
    )


with one_line_errors(snakemake), recorded(snakemake):
    module, function = snakemake.params.given
    compute = getattr(import_module(module), function)
    # A block with a `method` is computed by it, and its data say how many impacts that missed.
    method = block.get("method", {})
    how = ImpactMap((method["scan"], method["tolerance"]) if "scan" in method else None)
    ball = Ball(**block["ball"], map=how)
    inputs = [artifacts.load(path) for path in snakemake.input.data]
    fields = {key: block[key] for key in block.keys() - {"ball", "energy", "method"}}
    if "exact" in method:
        dataset = compute_exactly(compute, fields)
    else:
        dataset = compute(ball, block["energy"], *inputs, **fields)
    if "scan" in method:
        dataset.attrs |= {"impacts": how.impacts, "impacts_missed": how.missed}
    about = {"stage": snakemake.rule, "k": ball.k, "g": ball.g, "energy": float(block["energy"])}
    about["title"] = artifacts.title_of(compute)
    artifacts.save(dataset, snakemake.output[0], block, **about)
