# The checked config, and what the rules ask of it.
import shlex
import sys
from pathlib import Path

from pseudorigid import sources
from pseudorigid.config import (
    STAGES,
    ConfigError,
    artifact,
    drawing,
    figures,
    load,
    owners,
    stages,
)
from pseudorigid.provenance import record_path

ROOT = Path(workflow.basedir)

# Snakemake pastes this path into shell commands as it stands; a folder's name may have spaces.
sys.executable = shlex.quote(sys.executable)

if config:
    sys.exit("reproduce: --config and --configfile are not used here: edit config.yaml")
try:
    CONFIG = load(ROOT / "config.yaml")
except ConfigError as error:
    sys.exit(str(error))

SCENES, SWEEPS = CONFIG["scenes"], CONFIG["sweeps"]
OWNERS = owners(SCENES)
FIGURES = figures(SCENES)


def artifacts(*stages):
    """Input function: the artifacts of some stages that serve the scene, in this order."""
    return lambda wildcards: [
        artifact(stage, OWNERS[wildcards.scene, stage], wildcards.variant) for stage in stages
    ]


def stage_block(stage):
    """Params function: what decides the data of a stage, and nothing else."""
    return lambda wildcards: stages(SCENES[wildcards.scene])[stage]


def drawn_block(wildcards):
    """Params function: what decides how a scene is drawn."""
    return drawing(SCENES[wildcards.scene])


def scenes_of(*pictures):
    """A pattern for the names of the scenes of these kinds."""
    return any_of(name for name, block in SCENES.items() if block["picture"] in pictures)


def any_of(names):
    """A pattern for these names; it matches nothing where there is none."""
    return "|".join(names) or "(?!)"


def scenes_with(stage):
    """A pattern for the names of the scenes that need a stage."""
    return scenes_of(*(picture for picture, needed in STAGES.items() if stage in needed))


def code(script, *modules):
    """Every file of the project that a script runs, and the lock of the packages behind them."""
    return [*sources.code(script, *modules), "requirements/lock.txt"]


def study_inputs(part):
    """The figures' own artifacts that a part of the study compares with."""
    stages = ("periodic", "manifolds") if part == "needs" else ()
    return sorted(artifact(s, owner) for (_, s), owner in OWNERS.items() if s in stages)
