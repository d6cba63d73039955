# The checked config, and what the rules ask of it: EXPECTED says of each result what makes it.
import json
import shlex
import sys
from pathlib import Path

from pipeline.checks.currency import Currency
from pipeline.config import (
    KINDS,
    PAPER,
    STAGES,
    ConfigError,
    expected,
    figures,
    load,
    places,
    served,
    stages,
)
from pipeline.config.declared import study as parts
from pipeline.records.record import record_path

ROOT = Path(workflow.basedir)

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
ALL = {name: scene for scenes in VARIANTS.values() for name, scene in scenes.items()}
EXPECTED = {
    **expected.of_variants(VARIANTS),
    **expected.of_study(VARIANTS),
    **expected.of_sweeps(SWEEPS),
}
CURRENCY = Currency(ROOT, EXPECTED)


def inputs(result):
    """Input function: what a result is made from, in this order.

    Records say what is current, not times: what need not be made again counts as ancient.
    """

    def files(wildcards):
        used = EXPECTED[result.format(**wildcards)].inputs
        return [path if CURRENCY.reason(path) else ancient(path) for path in used]

    return files


def block(result):
    """Params function: the part of the config that decides a result, and nothing else."""
    return lambda wildcards: EXPECTED[result.format(**wildcards)].config


def code(result):
    """Params function: the project's files that make a result."""
    return lambda wildcards: EXPECTED[result.format(**wildcards)].sources


def reported(drawing, kind):
    """A drawing, with the caption of its kind of picture in the report."""
    return report(
        drawing,
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


def any_of(names):
    """A pattern for these names; it matches nothing where there is none."""
    return "|".join(names) or "(?!)"
