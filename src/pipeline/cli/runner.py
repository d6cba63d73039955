"""Snakemake as ./reproduce runs it: one run a folder, and a table of the figures at its end."""

import fcntl
import filecmp
import json
import re
import sys
import time
from pathlib import Path

from .. import config
from .interrupts import tidying_up

ROOT = Path(__file__).resolve().parents[3]
CORES = re.compile(r"--(cores|jobs)(=.*)?|-[cj](all|\d*)|all|\d+")
# Options of snakemake that make nothing.
SAYING = {"-n", "--dry-run", "--dryrun", "--dag", "--rulegraph", "--filegraph", "--d3dag", "--lint"}
SAYING |= {"--summary", "-S", "--detailed-summary", "-D", "--list", "-l", "--list-rules", "--lt"}
SAYING |= {"--list-target-rules", "--list-input-changes", "--list-params-changes", "--touch", "-t"}
SAYING |= {"--list-changes", "--lc", "--unlock", "--help", "-h", "--version", "-v"}
BUSY = "reproduce: another ./reproduce is running in this folder"


def hold_lock():
    """The open lock file of this folder, or None where another run has it. Death releases it."""
    try:
        lock = open(ROOT / ".lock", "w")  # noqa: SIM115  (stays open for the whole run)
        (ROOT / "results").mkdir(exist_ok=True)
    except OSError as error:
        sys.exit(f"reproduce: cannot write in {ROOT}: {error.strerror}: {error.filename}")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return None
    return lock


def run_snakemake(arguments: list[str], forced: list[str]) -> int:
    """Run snakemake to its end, in this process, and return its exit status.

    The files in `forced` are made again even if they seem to be current.
    """
    from snakemake.cli import main as snakemake

    # The lock is ours: one that snakemake leaves behind when killed would stop the next run.
    command = ["--forcerun", *forced] if forced else []
    command += ["--nolock", "--workflow-profile", str(ROOT / "workflow" / "profiles" / "default")]
    command += arguments
    if not any(a.startswith("-") and CORES.fullmatch(a) for a in arguments):
        command += ["--cores", "all"]
    try:
        with tidying_up():
            snakemake(command)
    except SystemExit as end:
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
            return 1
        return end.code or 0
    except KeyboardInterrupt:
        return 130
    return 0


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


def with_missing(arguments: list[str], figures) -> list[str]:
    """The arguments, each figure followed by the files behind it that are missing.

    A clone brings finished figures and no results: snakemake, asked for such a figure, would see
    a file newer than everything it needs and do nothing.
    """
    complete = []
    for argument in arguments:
        _, behind = figures.get(argument, (None, []))
        complete += [argument, *(file for file in behind if not (ROOT / file).exists())]
    return complete


def unlike_drawings(names, figures) -> list[str]:
    """The published figures that are not as drawn: snakemake, which looks at times, misses them."""
    pairs = [(name, ROOT / name, ROOT / figures[name][1][-1]) for name in names]
    return [
        name
        for name, published, drawn in pairs
        if published.is_file() and drawn.is_file()
        if not filecmp.cmp(published, drawn, shallow=False)
    ]


def discard_damaged(figures, arguments) -> None:
    """Delete drawings that are not what their records say, unless nothing is to be made."""
    if only_said(arguments):
        return
    from ..records.provenance import file_hash, record_path

    for _, behind in figures.values():
        drawing = ROOT / behind[-1]
        try:
            made = json.loads((ROOT / record_path(behind[-1])).read_text(encoding="utf-8"))
            whole = file_hash(drawing) in (None, made["output"]["sha256"])
        except (OSError, ValueError, KeyError, TypeError):
            continue  # without its record snakemake makes it again
        if not whole:
            print(
                f"reproduce: {behind[-1]}: changed after it was made, made again", file=sys.stderr
            )
            drawing.unlink()


def only_said(options) -> bool:
    """Whether these options of snakemake make nothing."""
    return any(option.split("=")[0] in SAYING for option in options)


def identity(file: str) -> tuple[int, int] | None:
    """Changes whenever the file is written anew; None where there is none."""
    try:
        status = (ROOT / file).stat()
    except OSError:
        return None
    return status.st_ino, status.st_mtime_ns


def table(rows: list[tuple[str, str, str]]) -> None:
    """Print the figures of this run, one a line: figure, file, size, recomputed or current."""
    rows = [
        (scene, name, f"{(ROOT / name).stat().st_size / 1000:,.0f} kB", state)
        for scene, name, state in rows
    ]
    rows.insert(0, ("figure", "file", "size", "state"))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    print()
    for scene, name, size, state in rows:
        print(f"{scene:{widths[0]}}  {name:{widths[1]}}  {size:>{widths[2]}}  {state}")


def floor_report(variants: dict[str, dict], shown, variant: str = config.PAPER) -> list[str]:
    """Of each scene in `shown` with a `method`: how many impacts it missed, one line a scene."""
    serves = config.served(variants)
    lines = []
    for scene in shown:
        block = variants[variant][scene]
        if "method" not in block:
            continue
        from ..records.artifacts import load  # takes a while

        found = [
            load(ROOT / serves[variant, scene, stage]).attrs
            for stage, parameters in config.stages(block).items()
            if "method" in parameters
        ]
        missed, impacts = (sum(a[n] for a in found) for n in ("impacts_missed", "impacts"))
        how = ", ".join(f"{key} {value:g}" for key, value in block["method"].items())
        lines.append(f"{scene}: {missed:,} of {impacts:,} impacts fell through the floor ({how})")
    return lines


def workflow(arguments: list[str]) -> int:
    """Check the config, run snakemake, and say what became of the figures."""
    variants = config.load(ROOT / "config.yaml")["variants"]
    figures = config.figures(variants)
    if any(a.partition("=")[0] in ("--config", "-C", "--configfile") for a in arguments):
        print(
            "reproduce: --config and --configfile are not used here: edit config.yaml",
            file=sys.stderr,
        )
        return 1
    lock = hold_lock()
    if lock is None:
        print(BUSY, file=sys.stderr)
        return 1
    discard_damaged(figures, arguments)
    before = {name: identity(behind[-1]) for name, (_, behind) in figures.items()}
    named = [argument for argument in arguments if argument in figures]
    stale = unlike_drawings(named or figures, figures)
    start = time.time() - 1  # some file systems keep whole seconds only
    status = run_snakemake(with_missing(arguments, figures), stale)
    if status:
        for line in last_words(start):
            print(line, file=sys.stderr)
        return status
    # After a plain run the figures asked for, or all; with other options what was drawn on the way.
    options = [a for a in arguments if a not in figures and not CORES.fullmatch(a)]
    rows = []
    for name, (scene, behind) in figures.items():
        drawn = identity(behind[-1]) != before[name]
        if drawn or (not options and name in (named or figures)):
            rows.append((scene, name, "recomputed" if drawn else "current"))
    if rows:
        table(rows)
        for line in floor_report(variants, dict.fromkeys(scene for scene, _, _ in rows)):
            print(line)
    return 0
