# The checked config, and what the rules ask of it.
import os
import shlex
import sys
from pathlib import Path

from pseudorigid.config import SHOWN, STAGES, ConfigError, drawn, load, owners, shown, stages
from pseudorigid.sources import closure

ROOT = Path(workflow.basedir)

# Snakemake pastes this path into shell commands as it stands; a folder's name may have spaces.
sys.executable = shlex.quote(sys.executable)

if config:
    sys.exit("reproduce: --config and --configfile are not used here: edit config.yaml")
try:
    SCENES = load(ROOT / "config.yaml")["scenes"]
except ConfigError as error:
    sys.exit(str(error))

OWNERS = owners(SCENES)
FIGURES = [(scene, x) for scene, block in SCENES.items() for x in block["formats"]]
DRAWN = [drawn(scene, extension) for scene, extension in FIGURES]
PUBLISHED = [shown(scene, extension) for scene, extension in FIGURES if extension in SHOWN]
ARTIFACTS = sorted({f"results/paper/{stage}_{owner}.nc" for (_, stage), owner in OWNERS.items()})


def artifacts(*stages):
    """Input function: the artifacts of some stages that serve the scene, in this order."""
    return lambda wildcards: [
        f"results/{wildcards.variant}/{stage}_{OWNERS[wildcards.scene, stage]}.nc" for stage in stages
    ]


def stage_block(stage):
    """Params function: what decides the data of a stage, and nothing else."""
    return lambda wildcards: stages(SCENES[wildcards.scene])[stage]


def drawn_block(wildcards):
    """Params function: what decides how a scene is drawn."""
    block = SCENES[wildcards.scene]
    return {key: value for key, value in block.items() if key != "formats"}


def scenes_of(*pictures):
    """A pattern for the names of the scenes of these kinds; it matches nothing where there is none."""
    names = [name for name, block in SCENES.items() if block["picture"] in pictures]
    return "|".join(names) or "(?!)"


def scenes_with(stage):
    """A pattern for the names of the scenes that need a stage."""
    return scenes_of(*(picture for picture, needed in STAGES.items() if stage in needed))


def code(script, *modules):
    """Every file of the project that a script runs, and the lock of the packages behind them."""
    scripts = [ROOT / "workflow/scripts" / name for name in (script, "job.py")]
    files = [*scripts, *closure(*scripts, *modules), ROOT / "requirements/lock.txt"]
    return [os.path.relpath(file, ROOT) for file in files]


# A clone brings finished figures and no results. Where the drawn file behind a published one is
# missing, the published one counts as older than anything, so that it is made again whatever
# the clone's file times are.
for _scene, _extension in FIGURES:
    _shown = ROOT / shown(_scene, _extension)
    if _shown.exists() and not (ROOT / drawn(_scene, _extension)).exists():
        os.utime(_shown, (-86400, -86400))
