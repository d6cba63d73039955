"""./reproduce clean: delete generated files in results/, and .snakemake."""

import os
import shutil
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from ...config import ConfigError
from ...config.schema.sets import SETS
from ...declaration import SourceError, parts
from ...records.record import RecordError, git, git_refuses, read_record, record_path
from ...records.sources import ROOT
from ..arguments import Arguments, hint
from ..session import CommandLineError, UsageError, locked, print_error

RESULTS = ROOT / "results"
# Files that jobs write in the folder of a set or variant, besides results and their records. Files
# named .part are those of killed processes, or finished parts of unfinished datasets.
_BESIDE_RESULTS = (
    *("differences/*.png", "logs/*.*.log", "logs/*.*.json", "why/*.*.txt"),
    *(".*.part", "*/.*.part", "*.nc.part/*"),
)
# Files that commands write elsewhere in results/.
_OF_COMMANDS = tuple(pattern for part in parts().values() for pattern in part.generated)
_MOST_NAMED = 20  # files that stay


def run(args: Arguments) -> int:
    """Delete the generated files of the named folders of results/, which may itself be a link.

    Without names, those of all folders are deleted, and .snakemake too. Other files are listed.
    """
    place = RESULTS.resolve()
    if any(p.resolve().is_relative_to(place) for p in (ROOT, Path(os.path.expanduser("~")))):
        raise UsageError(f"results is a link to {place}, which has other files: delete by hand")
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
        kept = [*_kept(names if args.folder else [""], {*files})]
        if not files and not folders:
            print("nothing to delete")
            print_error(*kept)
            return 0
        size = sum(file.lstat().st_size for file in files) / 1e6
        tops = sorted({file.relative_to(RESULTS).parts[0] for file in files})
        where = [f"results/{name}" for name in tops] + [f.name for f in folders]
        summary = f"{len(files)} files, {size:.1f} MB, in {', '.join(where)}"
        if not args.yes:
            _ask(f"delete {summary}? [y/N] ")
        try:
            for file in files:
                file.unlink()
            for folder in folders:
                shutil.rmtree(folder)
            _delete_empty_folders(tops)
        except OSError as error:
            raise UsageError(f"{error.filename}: cannot be deleted: {error.strerror}") from None
        print(f"deleted {summary}", *kept, sep="\n")
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


def _kept(names: list[str], deleted: set[Path]) -> Iterator[str]:
    """Yield a line for each other file in these folders of results/, up to a number."""
    others = [
        str(path.relative_to(ROOT))
        for top in names
        for path in sorted((RESULTS / top).rglob("*"))
        if path not in deleted and (path.is_symlink() or not path.is_dir())
    ]
    yield from (f"stays: {repr(other)[1:-1]}" for other in others[:_MOST_NAMED])
    if more := others[_MOST_NAMED:]:
        yield f"and {len(more)} more files stay"


def _generated_files(args: Arguments, names: list[str]) -> list[Path]:
    """Return the files in these folders that the workflow wrote and git does not track."""
    # The folder may be in another repository.
    if git_refuses(RESULTS):
        raise UsageError("git does not say which files in results are committed, see git status")
    tracked = (git("ls-files", "-z", root=RESULTS) or b"").decode().split("\0")
    candidates, known = set[Path](), {*SETS}
    with suppress(ConfigError, SourceError):  # records alone then say which files are results
        known |= args.config.variants.keys()
        specs = args.config.build_specs()
        candidates |= {ROOT / path for path in (*specs, *map(record_path, specs))}
    for record in RESULTS.glob("*/provenance/*.json"):
        with suppress(RecordError):
            read_record(ROOT, str(record))
            folder, name = record.parents[1], record.stem
            candidates |= {record, folder / ("." if name.endswith(".nc") else "figures") / name}
            known.add(folder.name)
    patterns = [f"{name}/{pattern}" for name in known for pattern in _BESIDE_RESULTS]
    candidates |= {f for pattern in (*patterns, *_OF_COMMANDS) for f in RESULTS.glob(pattern)}
    found = []
    for file in sorted(candidates):
        path = file.relative_to(RESULTS)
        wanted = path.parts[0] in names or (len(path.parts) == 1 and not args.folder)
        if wanted and file.is_file() and _has_no_links(file.parent) and str(path) not in tracked:
            found.append(file)
    return found


def _has_no_links(folder: Path) -> bool:
    """Return whether a folder in results/ lies where its path says, without symbolic links."""
    return folder.resolve() == RESULTS.resolve() / folder.relative_to(RESULTS)
