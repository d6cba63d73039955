"""One stage of a scene: the function of the science that the rule names, on the scene's block."""

import os
from importlib import import_module

from job import one_line_errors, recorded
from pipeline.records import artifacts
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap

block = snakemake.params.block
os.environ["OMP_NUM_THREADS"] = str(snakemake.threads)
with one_line_errors(snakemake), recorded(snakemake):
    module, function = snakemake.params.function
    compute = getattr(import_module(module), function)
    # A block with a `method` is computed by it, and its data say how many impacts that missed.
    method = block.get("method")
    how = ImpactMap((method["scan"], method["tolerance"]) if method else None)
    ball = Ball(**block["ball"], map=how)
    inputs = [artifacts.load(path) for path in snakemake.input.data]
    fields = {key: block[key] for key in block.keys() - {"ball", "energy", "method"}}
    dataset = compute(ball, block["energy"], *inputs, **fields)
    if method:
        dataset.attrs |= {"impacts": how.impacts, "impacts_missed": how.missed}
    artifacts.save(
        dataset,
        snakemake.output[0],
        block,
        stage=snakemake.rule,
        k=ball.k,
        g=ball.g,
        energy=float(block["energy"]),
    )
