# The plan of a run, and the functions that the rules use.
import sys
from pathlib import Path

from pipeline.config import ConfigError, build_specs, paths
from pipeline.config.schema import study as parts
from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.stages import STAGES
from pipeline.jobs import server
from pipeline.records.record import log_path, record_path
from pipeline.records.sources import ROOT
from snakemake.exceptions import WorkflowError

if not ROOT.samefile(workflow.basedir):
    here = f"this is {workflow.basedir}, but the code of {ROOT} runs"
    sys.exit(f"reproduce: {here}: use ./reproduce here")
if config:
    sys.exit("reproduce: --config and --configfile are not used here: edit config.yaml")
try:
    PLAN = server.plan()
except ConfigError as error:
    sys.exit(str(error))

VARIANTS, SWEEPS = PLAN.config["variants"], PLAN.config["sweeps"]
ALL = {name: scene for scenes in VARIANTS.values() for name, scene in scenes.items()}


def inputs(result):
    """Return an input function for the inputs of a result, in the order of its specification.

    Records decide what is outdated, not times: an input that is current counts as ancient.
    """

    def files(wildcards):
        path = result.format(**wildcards)
        if path not in PLAN.specs:
            raise WorkflowError(f"{path}: nothing in config.yaml asks for it")
        used = PLAN.specs[path].inputs
        return [path if path in PLAN.outdated else ancient(path) for path in used]

    return files


def priority(result):
    """Return a priority function: the seconds of a long job, or of a long job that needs it."""
    return lambda wildcards: PRIORITIES.get(result.format(**wildcards), 0)


def any_of(names):
    """Return a pattern for these names, which matches nothing if there are none."""
    return "|".join(names) or "(?!)"
