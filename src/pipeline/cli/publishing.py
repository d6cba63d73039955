"""Make the figures of a variant or set of scenes, publish them, and print the state of each."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import PurePath

from ..checks.published_sets import committed_state, unlisted_files
from ..config import Config, unknown
from ..config.results import drawn
from ..config.schema.parts import PUBLISHED
from ..records.files import ABSENT, FileError, read_bytes, why_not_a_file, write_whole
from ..records.provenance import (
    MISSING,
    Freshness,
    failure,
    read_record,
    record_path,
    with_dependencies,
)
from ..records.sources import ROOT
from . import running
from .arguments import Arguments
from .errors import CommandLineError, print_error
from .table import FileRow, print_files

Drawings = dict[str, str]  # path where users find a figure -> path of its drawing in results


def require_known(kind: str, names: Iterable[str], known: Sequence[str]) -> None:
    """Raise CommandLineError for the first name that is not a `known` one of this kind."""
    for name in names:
        if name not in known:
            raise CommandLineError(unknown(kind, name, known))


def drawings_of(config: Config, variant: str, names: Sequence[str] = ()) -> Drawings:
    """Return the figures of the named scenes of a variant, by default those of all its scenes.

    A scene that the variant leaves out has one path, so that `make` reports it.
    """
    files = config.figures(variant)
    for scene in config.left_out.get(variant, ()):
        path = drawn(scene, "png", variant)
        files[path] = scene, path
    require_known("figure", names, [*dict.fromkeys(scene for scene, _ in files.values())])
    return {path: file for path, (scene, file) in files.items() if not names or scene in names}


def make(
    config: Config,
    group: str,
    drawings: Drawings,
    args: Arguments,
    data: Iterable[str] = (),
    brief: bool = False,
) -> int:
    """Make and publish figures, print a table of them, and return the exit status.

    `group` is a set of scenes or a variant. `data` are further results to make, which the table
    leaves out. `args` has the number of cores and the options of snakemake. A `brief` table leaves
    out figures that were current. A figure that cannot exist, for instance for want of its periodic
    orbit, is not made; if nothing else is missing, the status is 1 only for a published set.
    """
    left_out, before = config.left_out.get(group, {}), Freshness(ROOT, config.build_specs())
    results = [path for path in (*drawings.values(), *data) if path in before.build_specs]
    made = before.outdated(with_dependencies(before.build_specs, results))
    if made and not args.makes_nothing:
        from .packages import add_imported  # takes long to import

        add_imported({file for path in made for file in before.build_specs[path].sources})
    status = running.make(before, results, args) if results else 0
    if args.makes_nothing or status == running.INTERRUPTED:
        for drawing in drawings.values():
            if drawing not in before.build_specs:
                scene = PurePath(drawing).stem
                print(f"{scene}: {left_out[scene]}")
        return status
    old = before.outdated(results)
    now = Freshness(ROOT, before.build_specs) if old or args.options else before
    outdated = now.outdated(results)
    if missing := [path for path in outdated if not now.refusal(path)]:
        status = status or 1
        names = ", ".join(PurePath(path).name for path in missing[:3])
        more = f" and {len(missing) - 3} more" if len(missing) > 3 else ""
        words = f"{len(missing)} of {len(results)} results not made, or not current"
        print_error(f"{words}: {names}{more}")
    elif outdated:
        status = int(group in PUBLISHED)
    rows, notes = list[FileRow](), dict[str, None]()
    for path, drawing in drawings.items():
        size = compared = ""
        state = "recomputed" if drawing in old else "current"
        if drawing not in before.build_specs or now.refusal(drawing):
            state = outdated.get(drawing) or left_out[PurePath(drawing).stem]
            for file in (ROOT / drawing, ROOT / record_path(drawing)):  # of another config
                if not why_not_a_file(file):
                    file.unlink(missing_ok=True)
        elif drawing in outdated:
            state = _why_not_made(now, drawing)
        else:
            notes |= dict.fromkeys(_notes(now, drawing))
            try:
                how = _publish(path, drawing)
                state = f"published again: {how}" if how and state == "current" else state
                size = f"{(ROOT / path).stat().st_size / 1000:5,.0f} kB"
                if path.startswith(f"{PUBLISHED.get(group)}/"):
                    compared = committed_state(ROOT, path)
            except FileError as error:
                status = status or 1
                state = f"not published: {str(error).removeprefix(f'{ROOT / path}: ')}"
        if not (brief and state == "current"):
            rows.append((path, size, (state, compared)))
    if rows:
        for path in sorted(outdated.keys() - drawings.values()):
            if now.refusal(path):
                notes[f"{path}: {outdated[path]}"] = None
        if group in PUBLISHED:
            figures = [PurePath(path).name for path in config.figures(group)]
            notes |= dict.fromkeys(unlisted_files(ROOT, PUBLISHED[group], figures))
        title = "as committed" if any(cells[1] for _, _, cells in rows) else ""
        print_files("", rows, ("figure", "files", "state", title), notes)
    return status


def _notes(freshness: Freshness, drawing: str) -> Iterator[str]:
    """Yield what the records behind a drawing note: what axes hide, and missed impacts."""
    for path in with_dependencies(freshness.build_specs, [drawing]):
        output = read_record(ROOT, record_path(path))["output"]
        for line in [*output.get("hidden", ()), *output.get("notes", ())]:
            yield f"{freshness.build_specs[path].scene}: {line}"


def _why_not_made(freshness: Freshness, drawing: str) -> str:
    """Return the state of a drawing that could exist and is outdated after a run."""
    behind = with_dependencies(freshness.build_specs, [drawing])
    if failures := [*filter(None, map(failure, behind))]:
        return f"not made: {failures[0]}"
    reason = freshness.reason(drawing)
    return "not made" if reason == MISSING else f"not current: {reason}"


def _publish(path: str, drawing: str) -> str:
    """Copy a drawing to its published file if they differ, and return how they did, or "".

    Raises FileError if that fails.
    """
    content, before = read_bytes(ROOT / drawing), None
    with suppress(*ABSENT):
        before = read_bytes(ROOT / path)
    if before == content:
        return ""
    write_whole(ROOT / path, content)
    return "it was missing" if before is None else f"it differed from {drawing}"
