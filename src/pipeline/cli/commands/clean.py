"""./reproduce clean: delete generated files in results/, and .snakemake."""

import json
import shutil
import sys
from contextlib import suppress
from pathlib import Path

from ...config import ConfigError
from ...config.build_specs import build_specs
from ...declaration import extensions
from ...records.files import read_text
from ...records.record import git, record_path
from ...records.sources import ROOT
from ..arguments import Arguments, hint
from ..session import CommandLineError, UsageError, locked

RESULTS = ROOT / "results"
# Files that commands and jobs write besides results and their records. Files named .part are those
# of killed processes, or finished parts of unfinished datasets.
_OTHER_FILES = (
    "*/differences/*.png",
    "*/logs/*.log",
    "*/logs/*.json",
    "*/why/*.txt",
    "*/.*.part",
    "*/*/.*.part",
    "*/*.nc.part/*",
    "report/*.html",
    "compare/*/*.png",
    *(pattern for extension in extensions().values() for pattern in extension.generated),
)


def run(args: Arguments) -> int:
    """Delete the generated files of the named folders of results/.

    Without names, those of all folders are deleted, and .snakemake too.
    """
    existing = sorted(f.name for f in RESULTS.glob("*/") if _has_no_links(f))
    for name in args.folder:
        if name not in existing:
            meant = hint(name, existing) or f": there are {', '.join(existing) or 'none'}"
            raise CommandLineError(f"no folder results/{name}{meant}")
    names = args.folder or existing
    with locked():
        files = _generated_files(args, names)
        cache = ROOT / ".snakemake"
        folders = [cache] if not args.folder and cache.is_dir() and not cache.is_symlink() else []
        if not files and not folders:
            print("nothing to delete")
            return 0
        size = sum(file.lstat().st_size for file in files) / 1e6
        top_files = [str(file.relative_to(ROOT)) for file in files if file.parent == RESULTS]
        where = [f"results/{name}" for name in names] + top_files + [f.name for f in folders]
        summary = f"{len(files)} files, {size:.1f} MB, in {', '.join(where)}"
        if not args.yes:
            _ask(f"delete {summary}? [y/N] ")
        try:
            for file in files:
                file.unlink()
            for folder in folders:
                shutil.rmtree(folder)
            _delete_empty_folders(names)
        except OSError as error:
            raise UsageError(f"{error.filename}: cannot be deleted: {error.strerror}") from None
        print(f"deleted {summary}")
    return 0


def _ask(question: str) -> None:
    """Ask the user, and raise UsageError if the answer is not yes."""
    print(question, end="", file=sys.stderr, flush=True)
    answer = sys.stdin.readline()
    if not answer:  # without a terminal
        print(file=sys.stderr)
    if answer.strip().lower() not in ("y", "yes"):
        raise UsageError("nothing was deleted")


def _delete_empty_folders(names: list[str]) -> None:
    """Delete the folders of results/ with these names, and those below, that are empty."""
    below = [folder for name in names for folder in RESULTS.glob(f"{name}/**/")]
    for folder in sorted(below, reverse=True):
        if _has_no_links(folder) and not any(folder.iterdir()):
            folder.rmdir()


def _generated_files(args: Arguments, names: list[str]) -> list[Path]:
    """Return the files in these folders that the workflow wrote and git does not track."""
    committed = (git("ls-files", "-z", "results", root=ROOT) or b"").decode().split("\0")
    candidates = {file for pattern in _OTHER_FILES for file in RESULTS.glob(pattern)}
    with suppress(ConfigError):  # records alone then say which files are results
        specs = build_specs(args.config)
        candidates |= {ROOT / path for path in (*specs, *map(record_path, specs))}
    for record in RESULTS.glob("*/provenance/*.json"):
        # A forged record may name any file: only these two are accepted.
        folder, name = record.parents[1], record.stem
        with suppress(OSError, ValueError, KeyError, TypeError, RecursionError):
            result = ROOT / json.loads(read_text(record))["output"]["file"]
            if result in (folder / name, folder / "figures" / name):
                candidates |= {record, result}
    return [
        file
        for file in sorted(candidates)
        if file.is_file()
        and _has_no_links(file.parent)
        and str(file.relative_to(ROOT)) not in committed
        and (
            file.relative_to(RESULTS).parts[0] in names
            or (file.parent == RESULTS and not args.folder)
        )
    ]


def _has_no_links(folder: Path) -> bool:
    """Return whether a folder of the project lies where its path says, without symbolic links."""
    return folder.resolve() == ROOT.resolve() / folder.relative_to(ROOT)
