# The plan of a run, and the functions that the rules use.
import re
import sys
from functools import cache
from pathlib import Path
from types import SimpleNamespace

from pipeline.config import MAIN, ConfigError
from pipeline.config.results import with_dependencies
from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.stages import STAGES
from pipeline.declaration import SourceError, parts
from pipeline.jobs.plan import plan
from pipeline.records.files import FileError
from pipeline.records.record import log_path, record_path
from pipeline.records.sources import ROOT
from snakemake.exceptions import WorkflowError

if not ROOT.samefile(workflow.basedir):
    here = f"this is {workflow.basedir}, but the code of {ROOT} runs"
    sys.exit(f"reproduce: {here}: use ./reproduce here")
if not ROOT.samefile("."):
    sys.exit("reproduce: --directory is not used here: copy the folder to have results elsewhere")
if config:
    sys.exit("reproduce: --config and --configfile are not used here: edit config.yaml")
try:
    PLAN = plan()
    if workflow.is_main_process:  # and not a job on a cluster
        PLAN.write_reasons()
except (ConfigError, FileError, SourceError) as error:
    sys.exit(str(error))

SPECS, VARIANTS = PLAN.freshness.build_specs, PLAN.config.variants
ALL = {name for scenes in VARIANTS.values() for name in scenes}
DATASETS = PLAN.config.datasets
# The command of a job, if no executor makes the result without it.
MAKE = "{params.python:q} -P -m pipeline.jobs.forks {output.result:q}"


def dataset(stage):
    """Return an input function for the dataset of a scene's stage, which variants may share."""

    def file(wildcards):
        key = wildcards.variant, wildcards.scene, stage
        if key not in DATASETS:
            raise WorkflowError("the scene {1} of {0} has no stage {2}".format(*key))
        return DATASETS[key]

    return file


def inputs_of(result):
    """Return an input function for all datasets that a result is made from."""

    def files(wildcards):
        return SPECS[result.format(**wildcards)].inputs

    return files


def reason(result):
    """Return an input function for the file that says why a result is outdated, if it is."""

    def files(wildcards):
        path = result.format(**wildcards)
        if path not in SPECS:
            raise WorkflowError(f"{path}: nothing in config.yaml asks for it")
        return PLAN.why(path)

    return files


def made(result):
    """Return a job's outputs. `update` keeps the old ones: the job may find them current."""
    return {"result": update(result), "record": update(record_path(result))}


def shown(drawing):
    """Mark a drawing for `snakemake --report FILE`."""
    labels = {"figure": "{scene}", "format": "{extension}"}
    return report(drawing, ROOT / "workflow" / "caption.rst", "{variant}", labels=labels)


def caption(wildcards):
    """Return the caption of a drawing as reStructuredText."""
    from pipeline.checks.quantities import facts, measured
    from pipeline.checks.captions import caption_of

    variant, scene = wildcards.variant, wildcards.scene
    known = measured(ROOT, PLAN.config, variant, scene, facts)
    name = scene if variant == MAIN else f"{variant}/{scene}"
    name, title, *texts = caption_of(name, VARIANTS[variant][scene].as_mapping(), known)
    return re.sub(r"([\\`*_|])", r"\\\1", "\n\n".join([f"{name}: {title}", *texts]))


config["caption"] = caption  # for workflow/caption.rst


@cache
def priorities():
    """Map each result to its seconds, or to those of the longest job that needs it."""
    known = {path: s for part in parts().values() for path, s in part.seconds.items()}
    return {
        dependency: seconds
        for path, seconds in sorted(known.items(), key=lambda item: item[1])
        if path in SPECS
        for dependency in with_dependencies(SPECS, [path])
    }


def priority(wildcards, rulename):
    """Return the priority of a job."""
    result = workflow.get_rule(rulename).output.result.apply_wildcards(wildcards)
    return priorities().get(str(result), 0)


def any_of(names):
    """Return a regular expression for these names, which matches nothing without names."""
    return "|".join(sorted(names)) or "(?!)"


def of_kind(kind):
    """Return wildcard constraints for the scenes of a kind of picture.

    Which scenes these are depends on the variant: sets of scenes may have scenes of one name and of
    different kinds. In the path of a result, the scene follows the variant and a folder.
    """
    pairs = []
    for variant, scenes in VARIANTS.items():
        if names := [name for name, scene in scenes.items() if scene.picture == kind]:
            pairs.append(rf"{variant}(?=/\w+/({any_of(names)})\.)")
    return {"variant": any_of(pairs)}


def rule_of(name, function, result, **more):
    """Return what a rule is made from. A `local` one is no job of its own on a cluster."""
    usual = {"inputs": {}, "constraints": {}, "local": False, "threads": 1, "made": made(result)}
    return SimpleNamespace(name=name, function=function, result=result, **usual | more)


def other_rules():
    """Yield the rules of all stages and kinds of picture that have none yet."""
    written = {rule.name for rule in workflow.rules}
    files = {Path(path).name for path in DATASETS.values()}
    for name in [each for each in STAGES if each not in written]:
        stage = STAGES[name]
        # Data that depend on no field of a scene have no scene in their path.
        scene = "" if f"{name}.nc" in files else "_{scene}"
        result, more = f"results/{{variant}}/{name}{scene}.nc", {"local": bool(stage.blocks)}
        if stage.blocks:
            block = result.replace(".nc", ".{number}.nc")
            yield rule_of(f"{name}_block", stage.of_block, block)
        joined = {"datasets": inputs_of(result)} if stage.blocks or stage.main else {}
        more["inputs"] = joined or {used: dataset(used) for used in stage.inputs}
        if stage.alone:
            more["threads"] = lambda wildcards: workflow.cores
        yield rule_of(name, stage.function, result, **more)
    result = "results/{variant}/figures/{scene}.{extension}"
    for kind, picture in KINDS.items():
        if f"draw_{kind}" not in written and picture.model_fields["formats"].default:
            more = {"local": any(STAGES[used].blocks for used in picture.stages)}
            more["inputs"] = {used: dataset(used) for used in picture.stages}
            more |= {"made": made(shown(result)), "constraints": of_kind(kind)}
            yield rule_of(f"draw_{kind}", picture.drawn_by, result, **more)
