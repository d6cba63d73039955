"""./reproduce clean: deletes what was made in results/."""

import json
import shutil
import sys
from contextlib import suppress

from ...config import ConfigError, build_specs
from ...records.files import read_text
from ...records.record import git, record_path
from ...records.sources import ROOT
from ..arguments import hint
from ..session import CommandLineError, UsageError, locked, print_error

RESULTS = ROOT / "results"
# Beside results and their records: what words and jobs leave in these folders.
_MORE = (
    "*/differences/*.png",
    "*/logs/*.log",
    "*/logs/*.json",
    "*/.*.part",
    "*/*/.*.part",
    "*/*.nc.part/*",
)
_MORE += ("report/*.html", "archive/pseudorigid.tar", "compare/*/*.png")


def run(args) -> int:
    """Delete the results in some folders of results/, all without a name, and snakemake's own."""
    there = sorted(f.name for f in RESULTS.iterdir() if f.is_dir()) if RESULTS.is_dir() else []
    for name in args.folder:
        if name not in there:
            has = f": there are {', '.join(there) or 'none'}"
            raise CommandLineError(f"no folder results/{name}{hint(name, there) or has}")
    names = []
    for name in args.folder or there:
        if _is_inside(RESULTS / name / "file"):
            names.append(name)
        else:
            print_error(f"results/{name} leads out of this folder: what is there stays")
    with locked():
        files = _made(args, names)
        own = ROOT / ".snakemake"
        folders = [own] if not args.folder and own.is_dir() and not own.is_symlink() else []
        if not files and not folders:
            print("nothing to delete")
            return 0
        size = sum(file.lstat().st_size for file in files) / 1e6
        places = ", ".join([f"results/{name}" for name in names] + [f.name for f in folders])
        what = f"{len(files)} files, {size:.1f} MB, in {places}"
        if not args.yes and not _agreed(what):
            raise UsageError("nothing was deleted")
        try:
            for file in files:
                file.unlink()
            for folder in folders:
                shutil.rmtree(folder)
            _remove_empty_folders(names)
        except OSError as error:
            raise UsageError(f"{error.filename}: cannot be deleted: {error.strerror}") from None
        print(f"deleted {what}")
    return 0


def _made(args, names):
    """The files in these folders that this project made: git's, and any other, stay."""
    committed = (git("ls-files", "-z", "results", root=ROOT) or b"").decode().split("\0")
    found = {file for pattern in _MORE for file in RESULTS.glob(pattern)}
    with suppress(ConfigError):  # in case that records are lost
        results = build_specs.of_all(args.checked)
        found |= {ROOT / path for path in (*results, *map(record_path, results))}
    for record in RESULTS.glob("*/provenance/*.json"):
        # A record may come from anywhere: it chooses between the two places that it can speak of.
        folder = record.parents[1]
        results = {
            str(f.relative_to(ROOT)): f
            for f in (folder / record.stem, folder / "figures" / record.stem)
        }
        with suppress(OSError, ValueError, KeyError, TypeError, RecursionError):
            found |= {results[json.loads(read_text(record))["output"]["file"]], record}
    return sorted(
        file
        for file in found
        if file.is_file()
        and _is_inside(file)
        and file.relative_to(RESULTS).parts[0] in names
        and str(file.relative_to(ROOT)) not in committed
    )


def _is_inside(file):
    """Whether a file is in this folder, and not where a link in its path leads."""
    return file.parent.resolve() == ROOT.resolve() / file.parent.relative_to(ROOT)


def _agreed(what):
    print(f"delete {what}? [y/N] ", end="", file=sys.stderr, flush=True)
    answer = sys.stdin.readline().strip().lower()
    if not answer:
        print(file=sys.stderr)
    return answer in ("y", "yes")


def _remove_empty_folders(names):
    for name in names:
        for folder in sorted(RESULTS.glob(f"{name}/**/"), reverse=True):
            if _is_inside(folder / "file") and not any(folder.iterdir()):
                folder.rmdir()
