# The checked config, and what the rules ask of it: EXPECTED says of each result what makes it.
import shlex
import sys
from pathlib import Path

from pipeline.checks.currency import Currency
from pipeline.config import ConfigError, expected, load, places
from pipeline.config.declared import study as parts
from pipeline.config.declared.kinds import KINDS
from pipeline.config.declared.stages import STAGES
from pipeline.records import sources
from pipeline.records.files import file_hash
from pipeline.records.record import record_path
from snakemake.exceptions import WorkflowError

ROOT = Path(workflow.basedir)
if not ROOT.samefile(sources.ROOT):
    sys.exit(
        f"reproduce: this is {ROOT}, but the code of {sources.ROOT} runs: use ./reproduce here"
    )
# As they are now that snakemake reads them: jobs compare.
READ = {path: file_hash(ROOT / path) for path in sources.WORKFLOW}

# Snakemake pastes this path into shell commands as it stands; a folder's name may have spaces.
sys.executable = shlex.quote(sys.executable)

if config:
    sys.exit("reproduce: --config and --configfile are not used here: edit config.yaml")
try:
    CONFIG = load(ROOT / "config.yaml")
except ConfigError as error:
    sys.exit(str(error))

VARIANTS, SWEEPS = CONFIG["variants"], CONFIG["sweeps"]
SCENES = VARIANTS[places.PAPER]
ALL = {name: scene for scenes in VARIANTS.values() for name, scene in scenes.items()}
EXPECTED = expected.of_all(CONFIG)
CURRENCY = Currency(ROOT, EXPECTED)


def inputs(result):
    """Input function: what a result is made from, in this order.

    Records say what is current, not times: what need not be made again counts as ancient.
    """

    def files(wildcards):
        path = result.format(**wildcards)
        if path not in EXPECTED:
            raise WorkflowError(f"{path}: nothing in config.yaml asks for it")
        used = EXPECTED[path].inputs
        return [path if CURRENCY.reason(path) else ancient(path) for path in used]

    return files


def made(result, what):
    """Params function: `what` makes a result, the block of config or the project's files."""
    return lambda wildcards: getattr(EXPECTED[result.format(**wildcards)], what)


def priority(result):
    """Priority function: the seconds that a long job takes, or one that needs this result."""
    return lambda wildcards: PRIORITIES.get(result.format(**wildcards), 0)


def maker(stage, result):
    """Params function: module and function that compute a stage."""
    return lambda wildcards: STAGES[stage].maker(EXPECTED[result.format(**wildcards)].config)


def any_of(names):
    """A pattern for these names; it matches nothing where there is none."""
    return "|".join(names) or "(?!)"
