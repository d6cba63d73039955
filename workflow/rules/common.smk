# The checked config, and what the rules ask of it.
import json
import shlex
import sys
from pathlib import Path

from pipeline.config import (
    KINDS,
    PAPER,
    STAGES,
    ConfigError,
    absent_file,
    drawing,
    drawing_code,
    figures,
    load,
    served,
    stage_code,
    stages,
    wanted_orbits,
)
from pipeline.config.declared import study as parts
from pipeline.records import sources
from pipeline.records.provenance import record_path

ROOT = Path(workflow.basedir)
LOCK = "requirements/lock.txt"

# Snakemake pastes this path into shell commands as it stands; a folder's name may have spaces.
sys.executable = shlex.quote(sys.executable)

if config:
    sys.exit("reproduce: --config and --configfile are not used here: edit config.yaml")
try:
    CONFIG = load(ROOT / "config.yaml")
except ConfigError as error:
    sys.exit(str(error))

VARIANTS, SWEEPS = CONFIG["variants"], CONFIG["sweeps"]
SCENES = VARIANTS[PAPER]
SERVED = served(VARIANTS)
FIGURES = figures(VARIANTS)


def artifacts(*stages):
    """Input function: the artifacts of some stages that serve the scene, in this order."""
    return lambda wildcards: [SERVED[wildcards.variant, wildcards.scene, stage] for stage in stages]


def stage_block(stage):
    """Params function: what decides the data of a stage, and nothing else."""
    return lambda wildcards: stages(VARIANTS[wildcards.variant][wildcards.scene])[stage]


def drawn_block(wildcards):
    """Params function: what decides how a scene is drawn."""
    return drawing(VARIANTS[wildcards.variant][wildcards.scene])


def with_records(figures, published=True):
    """The files of some figures, those on the way and their records: what was deleted comes back."""
    files = {file for _, behind in figures.values() for file in behind}
    return sorted({*(figures if published else ()), *files, *map(record_path, files)})


def reported(kind):
    """A drawing, with the caption of its kind of picture in the report."""
    return report(
        "results/{variant}/figures/{scene}.{extension}",
        caption=str(ROOT / captions(kind)),
        category="Figures",
        labels=figure_labels,
    )


def figure_labels(wildcards):
    """The line on a figure in the report's list, read when the report is made.

    One column: a second one with two values in it would become a switch between figures.
    """
    labels = json.loads((ROOT / "results" / "report" / "labels.json").read_text(encoding="utf-8"))
    return {"figure": labels[wildcards.scene]}


def captions(kind):
    """Where the caption of a kind of picture is written when a report is made."""
    return f"results/report/captions/{kind}.rst"


def scenes_of(*kinds):
    """A pattern for the names of the scenes of these kinds."""
    return any_of(name for name, block in SCENES.items() if block["picture"] in kinds)


def any_of(names):
    """A pattern for these names; it matches nothing where there is none."""
    return "|".join(names) or "(?!)"


def scenes_with(stage):
    """A pattern for the names of the scenes that need a stage."""
    return any_of(name for name, block in SCENES.items() if stage in stages(block))


def code(script, *modules):
    """Every file of the project that a script runs, and the lock of the packages behind them."""
    return [*sources.code(script, *modules), LOCK]


def study_artifacts(part):
    """The figures' own artifacts that a part of the study compares with: [stage, scene, file]."""
    scenes = parts.block(part, SCENES).get("scenes", ())
    compared = ("periodic", "manifolds")
    return [[s, n, f] for (v, n, s), f in SERVED.items() if v == PAPER and s in compared and n in scenes]


def study_code(part):
    """What a part of the study runs, the libraries' rivals where they are measured."""
    rivals = ("methods.scipy_events", "methods.taylor", "bench") if part in parts.MEASURED else ()
    modules = [f"pseudorigid.study.{name}" for name in rivals]
    return [*code("study.py", *modules), "requirements/study.txt"]
