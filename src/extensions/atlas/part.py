"""What the atlas adds to the pipeline: sweeps over k and the energy."""

import os

from pipeline.declaration import ONLY_SET, Part, SceneSet, SnakemakeCommand, Stage

_ARGUMENTS = {
    "sweep": "sweeps of config.yaml; without a name, all; or finer, a million cells",
    "--slurm": "submit blocks of cells to Slurm, with the options in profiles/slurm",
    "--gpu": "compute blocks of cells on an NVIDIA card",
}
_MODULE = "extensions.atlas.command"
_FINER = SceneSet(
    "more_figures/finer",
    "./reproduce atlas --gpu finer",
    "The finer atlas",
    scenes="extensions.atlas.finer.scenes",
    kind="atlas",
)
PART = Part(
    needs=("processors",),
    stages={
        "sweep": Stage(
            "extensions.atlas.sweep.dataset_of_a_sweep",
            "k energy starts impacts",
            more="extensions.atlas.kinds.specifications",
            of_block="extensions.atlas.cell.block_of_cells_of_a_sweep",
            runtime=120,
        ),
        "verdicts": Stage("extensions.atlas.verdicts.verdicts", alone=True),
    },
    sets={
        "atlas": SceneSet(
            "more_figures/atlas", "./reproduce atlas", "The atlas", key="sweeps", kind="atlas"
        ),
        # It has a million cells: only processes of its own command load it.
        **({"finer": _FINER} if os.environ.get(ONLY_SET) == "finer" else {}),
    },
    commands={
        "sweep": SnakemakeCommand(
            "compute sweeps over k and E/g^2, in results/atlas/", _ARGUMENTS, module=_MODULE
        ),
        "atlas": SnakemakeCommand(
            "draw the sweeps, in more_figures/atlas/", _ARGUMENTS, module=_MODULE
        ),
    },
    committed="extensions.atlas.gpu.run.renewed",
    seconds={
        "results/atlas/verdicts.nc": 190,
    },
)
