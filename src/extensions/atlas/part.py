"""What the atlas adds to the pipeline: sweeps over k and the energy."""

from pipeline.declaration import Part, SceneSet, SnakemakeCommand, Stage, names, switch

_ARGUMENTS = (
    names("sweep", "sweeps of config.yaml; without a name, all; or finer, a million cells"),
    switch("--slurm", "submit blocks of cells to Slurm, with the options in profiles/slurm"),
    switch("--gpu", "compute blocks of cells on an NVIDIA card"),
)
_MODULE = "extensions.atlas.command"
PART = Part(
    needs=("processors",),
    stages={
        "sweep": Stage(
            "extensions.atlas.sweep.dataset_of_a_sweep",
            "k energy starts impacts",
            blocks="extensions.atlas.kinds.blocks",
            of_block="extensions.atlas.cell.block_of_cells_of_a_sweep",
        ),
        "verdicts": Stage("extensions.atlas.verdicts.verdicts", alone=True),
    },
    sets={
        "atlas": SceneSet(
            "more_figures/atlas", "./reproduce atlas", "The atlas", key="sweeps", kind="atlas"
        ),
        "finer": SceneSet(
            "more_figures/finer",
            "./reproduce atlas --gpu finer",
            "The finer atlas",
            scenes="extensions.atlas.finer.scenes",
            kind="atlas",
            apart=True,
        ),
    },
    commands={
        "sweep": SnakemakeCommand(
            "compute sweeps over k and E/g^2, in results/atlas/", *_ARGUMENTS, module=_MODULE
        ),
        "atlas": SnakemakeCommand(
            "draw the sweeps, in more_figures/atlas/", *_ARGUMENTS, module=_MODULE
        ),
    },
    benchmark="extensions.atlas.bench",
    committed="extensions.atlas.gpu.run.renewed",
    seconds={
        "results/atlas/verdicts.nc": 190,
    },
)
