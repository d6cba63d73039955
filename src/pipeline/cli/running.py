"""Snakemake as ./reproduce runs it, and what it is told to make again."""

import signal
import sys
import time
from pathlib import Path

from ..checks.currency import DAMAGED, MISSING, Currency
from ..records.record import record_path
from ..records.sources import ROOT
from .folder import UsageError, interruptible, say

INTERRUPTED = 130
_CAUSES = ("its record", "no record", DAMAGED)


def options_of(arguments):
    """Snakemake's own reading of its options; SystemExit where it refuses them."""
    from snakemake.cli import get_argument_parser

    return get_argument_parser().parse_args(arguments)


def only_says(arguments) -> bool:
    """Whether these options of snakemake make nothing."""
    options = options_of(arguments) if arguments else None
    names = ("dryrun", "dag", "rulegraph", "filegraph", "d3dag", "lint", "summary", "touch")
    names += ("detailed_summary", "list_rules", "list_target_rules", "list_changes", "unlock")
    return any(getattr(options, name, None) for name in names)


def refuse_settings(arguments) -> None:
    """UsageError where values of the config are given on the command line."""
    if any(a.partition("=")[0] in ("--config", "-C", "--configfile") for a in arguments):
        raise UsageError("--config and --configfile are not used here: edit config.yaml")


def needed(expected, wanted) -> list[str]:
    """The results `wanted` and all that they are made from, each after its inputs."""
    found = {}

    def add(path):
        for used in expected[path].inputs:
            if used in expected:
                add(used)
        found[path] = None

    for path in wanted:
        add(path)
    return list(found)


def make(expected, wanted, arguments, targets=(), forced=(), quiet=False) -> int:
    """Have snakemake make the results `wanted` where they are not current; its exit status.

    Parameters
    ----------
    expected : dict
        Every result that may be needed -> config.expected.Expected.
    wanted : iterable of str
        Results, from the root.
    arguments : list of str
        Options for snakemake.
    targets, forced : iterable of str
        Further files to make, and those of them to make even if they are there.
    """
    paths = needed(expected, wanted)
    outdated = Currency(ROOT, expected).outdated(paths)
    for path, why in outdated.items():
        if (ROOT / path).is_dir():
            raise UsageError(f"{path}: {why}")
        for folder in Path(path).parents:
            if (ROOT / folder).exists() and not (ROOT / folder).is_dir():
                raise UsageError(f"{folder}: a file stands in a folder's place, move it away")
        if why.startswith(_CAUSES) and not quiet:
            say(f"{path}: {why}: made again")
    if not (outdated or arguments or targets or forced):
        return 0
    again = [path for path, why in outdated.items() if why != MISSING]
    records = [record_path(path) for path in paths]
    return run([*paths, *records, *targets], [*again, *forced], arguments)


def run(targets, forced, arguments) -> int:
    """Run snakemake in this process to its end; its exit status."""
    from snakemake.cli import main as snakemake

    if arguments and only_says(arguments):
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # of `| head`, which has seen enough
    # The lock is ours: one that snakemake leaves behind when killed would stop the next run.
    command = ["--forcerun", *forced] if forced else []
    command += ["--nolock", "--workflow-profile", str(ROOT / "workflow" / "profiles" / "default")]
    command += [
        "--scheduler",
        "greedy",
    ]  # the other one writes files into TMPDIR, which may be full
    command += [*targets, *arguments]
    given = options_of(arguments)
    if given.cores is None and given.jobs is None:
        command += ["--cores", "all"]
    executable, status = sys.executable, 0
    with interruptible() as caught:
        try:
            snakemake(command)
        except SystemExit as end:
            status = end.code or 0
        except KeyboardInterrupt:
            status = INTERRUPTED
        finally:
            sys.executable = executable  # the Snakefile quotes it for the shell
    if caught:
        say("interrupted: run it again to go on")
        return INTERRUPTED
    if isinstance(status, str):
        print(status, file=sys.stderr)
        return 1
    return status


def last_words(since: float) -> list[str]:
    """The one-line messages that jobs of this run left in their logs, in the order of time.

    Scenes with the same trouble share a line.
    """
    found = []
    for log in ROOT.glob("results/*/logs/*.log"):
        changed = log.stat().st_mtime
        if changed >= since:
            lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
            found += [(changed, line) for line in lines if line.startswith("pseudorigid: ")]
    scenes = {}
    for _, line in sorted(found):
        scene, _, message = line.removeprefix("pseudorigid: ").partition(": ")
        scenes.setdefault(message, set()).add(scene)
    return [f"pseudorigid: {', '.join(sorted(scenes[key]))}: {key}" for key in scenes]


def now() -> float:
    """A time for `last_words`: some file systems keep whole seconds only."""
    return time.time() - 1
