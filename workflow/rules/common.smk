# What can be made, and the functions that the rules use.
#
# When the workflow is read, `set_times` writes the specification of each result (the input
# `specification` of its rule) and sets the times of files: what is current, as its record says, is
# newer than all that it is made from, and what is not is older than its specification. So Snakemake
# decides by times, and contents decide these.
import sys
from pathlib import Path
from shlex import quote

HERE = Path(workflow.current_basedir).parents[1]
sys.path.insert(0, str(HERE / "src"))

from pipeline.config import ConfigError, load
from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.parts import STAGES
from pipeline.declaration import SourceError, Stage, parts
from pipeline.records.files import FileError
from pipeline.records.provenance import Freshness, log_path, record_path, spec_path
from pipeline.records.sources import ROOT

if not (HERE / "Snakefile").samefile(workflow.main_snakefile) or not HERE.samefile("."):
    how = "in its own folder, not as a module and without --directory"
    sys.exit(f"reproduce: the workflow runs {how}: copy {HERE} to have results elsewhere")
if not ROOT.samefile(HERE):  # plugins of snakemake were found elsewhere
    sys.exit(f"reproduce: this is {HERE}, but the code of {ROOT} runs: use ./reproduce here")
if config:
    sys.exit("reproduce: --config and --configfile are not used here: edit config.yaml")
try:
    CONFIG = load(ROOT / "config.yaml")
    SPECS = CONFIG.build_specs()
    if workflow.is_main_process:  # and not a job on a cluster
        Freshness(ROOT, SPECS).set_times()
except (ConfigError, FileError, SourceError) as error:
    sys.exit(str(error))

VARIANTS, DATASETS = CONFIG.variants, CONFIG.datasets
SECONDS = {path: s for part in parts().values() for path, s in part.seconds.items()}
ALL = {name for scenes in VARIANTS.values() for name in scenes}
PICTURES = {each.picture: KINDS[each.picture] for s in VARIANTS.values() for each in s.values()}
ALONE = {name for name, stage in STAGES.items() if stage.alone}  # nothing runs beside these
# What is made from blocks of cells, which alone are jobs of a cluster.
JOINED = {name for name, stage in STAGES.items() if stage.of_block}
JOINED |= {f"draw_{kind}" for kind, picture in PICTURES.items() if JOINED & {*picture.stages}}
BIN, SRC = quote(str(Path(sys.executable).parent)), quote(sys.path[0])  # of this Python and code
shell.prefix(f"export PATH={BIN}:$PATH PYTHONPATH={SRC}${{{{PYTHONPATH:+:$PYTHONPATH}}}}; ")


def dataset(stage):
    """Return an input function for the dataset of a scene's stage, which variants may share."""
    return lambda wildcards: DATASETS.get((wildcards.variant, wildcards.scene, stage), [])


def inputs_of(result):
    """Return an input function for all datasets that a result is made from."""
    return lambda wildcards: getattr(SPECS.get(result.format(**wildcards)), "inputs", [])


def shown(drawing):
    """Mark a drawing for `snakemake --report FILE`."""
    labels = {"figure": "{scene}", "format": "{extension}"}
    return report(drawing, ROOT / "workflow" / "caption.rst", "{variant}", labels=labels)


def caption(wildcards):
    """Return the caption of a drawing, for workflow/caption.rst."""
    from pipeline.checks.quantities import caption_of_result

    return caption_of_result(CONFIG, wildcards.variant, wildcards.scene)


config["caption"] = caption


def priority(wildcards, rulename):
    """Return the priority of a job: the longest begin first."""
    result = workflow.get_rule(rulename).output.result.apply_wildcards(wildcards)
    return SECONDS.get(str(result), 0)


def resources_of(name):
    """Return the resources that the stage of a rule declares; those of a drawing are the defaults."""
    stage = STAGES.get(name.removesuffix("_block"), Stage(""))
    return {"mem_mb": stage.mem_mb, "runtime": stage.runtime}


def any_of(names):
    """Return a regular expression for these names, which matches nothing without names."""
    return "|".join(sorted(names)) or "(?!)"


def of_kind(kind):
    """Return wildcard constraints for the scenes of a kind of picture, which variants may change.

    In the path of a result, the scene follows the variant and a folder.
    """
    pairs = []
    for variant, scenes in VARIANTS.items():
        if names := [name for name, scene in scenes.items() if scene.picture == kind]:
            pairs.append(rf"{variant}(?=/\w+/({any_of(names)})\.)")
    return {"variant": any_of(pairs)}


def other_rules():
    """Yield name, function, result and inputs for the rules of all other stages and kinds."""
    written = {rule.name for rule in workflow.rules}
    files = {Path(path).name for path in DATASETS.values()}
    for name in {stage: None for _, _, stage in DATASETS if stage not in written}:
        stage = STAGES[name]
        # Data that depend on no field of a scene have no scene in their path.
        scene = "" if f"{name}.nc" in files else "_{scene}"
        result = f"results/{{variant}}/{name}{scene}.nc"
        inputs = {used: dataset(used) for used in stage.inputs}
        if stage.more:
            inputs = {"datasets": inputs_of(result)}
        if stage.of_block:
            yield f"{name}_block", stage.of_block, result.replace(".nc", ".{number}.nc"), {}
        yield name, stage.function, result, inputs
    for kind, picture in PICTURES.items():
        if f"draw_{kind}" not in written and picture.model_fields["formats"].default:
            result = "results/{variant}/figures/{scene}.{extension}"
            yield f"draw_{kind}", picture.drawn_by, result, {s: dataset(s) for s in picture.stages}
