"""What ./reproduce does once .venv is ready: pytest, or snakemake and a table of the figures."""

import fcntl
import filecmp
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

# Ctrl-C ends the process at once, without a traceback, except where `tidying_up`.
CAREFUL = signal.getsignal(signal.SIGINT)
CARELESS = signal.SIG_DFL if CAREFUL is signal.default_int_handler else CAREFUL
signal.signal(signal.SIGINT, CARELESS)

START = Path.cwd()
ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "src"))

from pseudorigid import config  # noqa: E402  (needs the path above; imports nothing heavy)
from pseudorigid.sweep import grid  # noqa: E402

CORES = re.compile(r"--(cores|jobs)(=.*)?|-[cj](all|\d*)|all|\d+")


@contextmanager
def tidying_up():
    """Ctrl-C raises KeyboardInterrupt in here, so that nothing unfinished stays behind."""
    signal.signal(signal.SIGINT, CAREFUL)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, CARELESS)


def set_environment() -> None:
    """The tree's own package wherever the folder was moved, and caches that need no home folder."""
    caches = ROOT / ".venv" / "cache"
    os.environ["PYTHONPATH"] = str(ROOT / "src")
    os.environ["XDG_CACHE_HOME"] = str(caches)
    os.environ["MPLCONFIGDIR"] = str(caches / "matplotlib")
    os.environ.pop("MPLBACKEND", None)  # nothing here opens a window


def test(arguments: list[str]) -> int:
    """Hand over to pytest; its exit status is ours."""
    os.execv(sys.executable, [sys.executable, "-m", "pytest", *arguments])


def verify(arguments: list[str]) -> int:
    """Say for each figure whether it is the committed one, or what differs."""
    from pseudorigid.verify import verify

    with tidying_up():
        return verify(ROOT, arguments, START)


def accept(arguments: list[str]) -> int:
    """Make the figures as they are now the committed ones."""
    from pseudorigid.verify import accept

    lock = hold_lock()
    if lock is None:
        print(BUSY, file=sys.stderr)
        return 1
    with tidying_up():
        return accept(ROOT, arguments)


def study(arguments: list[str]) -> int:
    """The study's data and charts, with the packages of its rivals."""
    return add_packages("study") or workflow(["study", *arguments])


def benchmark(arguments: list[str]) -> int:
    """One table of ratios of speed, measured now."""
    if arguments:
        print("reproduce: benchmark takes no arguments", file=sys.stderr)
        return 1
    return add_packages("study") or subprocess.call(
        [sys.executable, "-m", "pseudorigid.study.bench"]
    )


def add_packages(name: str) -> int:
    """Install requirements/<name>.txt on top of the lock if that is not done; the exit status."""
    wanted = (ROOT / "requirements" / f"{name}.txt").read_bytes()
    stamp = ROOT / ".venv" / f"{name}-stamp"  # goes with .venv when that is made anew
    if stamp.is_file() and stamp.read_bytes() == wanted:
        return 0
    print(f"reproduce: installing requirements/{name}.txt into .venv (once)", file=sys.stderr)
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--no-input", "install"]
    pip += ["--quiet", "--require-hashes", "-r", str(ROOT / "requirements" / f"{name}.txt")]
    status = subprocess.call(pip, env=os.environ | {"PIP_USER": "0"})
    if status == 0:
        stamp.write_bytes(wanted)
    return status


def sweep(arguments: list[str]) -> int:
    """The datasets of the sweeps, or of those named first."""
    return swept(arguments, lambda names: [grid.dataset(name) for name in names])


def atlas(arguments: list[str]) -> int:
    """The pictures of the sweeps, and whatever they still need."""
    return swept(
        arguments,
        lambda names: [
            file for name in names for file in (grid.dataset(name), *grid.pictures(name))
        ],
    )


def swept(arguments: list[str], targets) -> int:
    """Snakemake for sweeps: damaged files go before, and it is told how far the cells are."""
    from pseudorigid.sweep import run

    sweeps = config.load(ROOT / "config.yaml")["sweeps"]
    names, options = run.chosen(sweeps, arguments)
    if "--slurm" in options:
        if shutil.which("sbatch") is None:
            print("reproduce: --slurm: there is no sbatch on this machine", file=sys.stderr)
            return 1
        options[options.index("--slurm")] = f"--profile={ROOT / 'workflow' / 'profiles' / 'slurm'}"
        if status := add_packages("slurm"):
            return status
    lock = hold_lock()
    if lock is None:
        print(BUSY, file=sys.stderr)
        return 1
    dry = {"-n", "--dry-run", "--dryrun"} & set(options)
    for line in run.discard(sweeps, names) if not dry else ():
        print(f"reproduce: {line}", file=sys.stderr)
    start = time.time() - 1
    blocks, cells = run.lacking(sweeps, names)
    if line := run.shortage(blocks, cells):
        print(f"reproduce: {line}", file=sys.stderr)
        return 1
    if not any(option.startswith(("-q", "--quiet")) for option in options):
        options += ["--quiet", "rules", "host", "reason", "progress"]
    # Snakemake would not miss a block that a dataset has already been joined from.
    with run.progress(blocks, cells):
        status = run_snakemake([*targets(names), *blocks, *options], [])
    for line in last_words(start) if status else ():
        print(line, file=sys.stderr)
    return status


WORDS = {
    "test": test,
    "verify": verify,
    "accept": accept,
    "study": study,
    "benchmark": benchmark,
    "sweep": sweep,
    "atlas": atlas,
}
BUSY = "reproduce: another ./reproduce is running in this folder"


def hold_lock():
    """The open lock file of this folder, or None where another run has it. Death releases it."""
    lock = open(ROOT / ".lock", "w")  # noqa: SIM115  (stays open for the whole run)
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


def workflow(arguments: list[str]) -> int:
    """Check the config, run snakemake, and say what became of the figures."""
    figures = config.figures(config.load(ROOT / "config.yaml")["scenes"])
    lock = hold_lock()
    if lock is None:
        print(BUSY, file=sys.stderr)
        return 1
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
    return 0


def main(arguments: list[str]) -> int:
    """Run one word, or snakemake."""
    os.chdir(ROOT)
    set_environment()
    word, *rest = arguments or [None]
    try:
        return WORDS[word](rest) if word in WORDS else workflow(arguments)
    except config.ConfigError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
