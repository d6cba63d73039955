"""Make the figures of a variant or set of scenes, publish them, and print the state of each."""

import filecmp
from collections.abc import Iterable, Sequence
from pathlib import PurePath

from ..checks.published_sets import committed_state, unlisted_files
from ..config import Config, unknown
from ..config.results import drawn
from ..config.schema.parts import PUBLISHED
from ..records.files import FileError, read_bytes, why_not_a_file, write_whole
from ..records.provenance import (
    MISSING,
    BuildSpec,
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
    reasons = config.left_out.get(group, {})
    left_out = {path: reasons[s] for path in drawings if (s := PurePath(path).stem) in reasons}
    drawings = {path: drawing for path, drawing in drawings.items() if path not in left_out}
    results = [*drawings.values(), *data]
    before = Freshness(ROOT, _specs_of(config, group, results))
    status = running.make(before, results, args) if results else 0
    if args.makes_nothing or status == running.INTERRUPTED:
        notes = [f"{PurePath(path).stem}: {reason}" for path, reason in left_out.items()]
        print(*notes, sep="\n", end="\n" * bool(notes))
        return status
    old = before.outdated(results)
    now = Freshness(ROOT, before.build_specs) if old or args.options else before
    outdated = now.outdated(results)
    refused = {path for path in outdated if now.refusal(path)}
    if refused and refused == outdated.keys():
        status = int(group in PUBLISHED)
    elif outdated:
        status = status or 1
        _print_missing([path for path in outdated if path not in refused], len(results))
    made = {path: drawing for path, drawing in drawings.items() if drawing not in outdated}
    unpublished, replaced = _publish(made)
    _delete([*(refused & {*drawings.values()}), *left_out])  # the present config has none
    rows = []
    for path, drawing in drawings.items():
        state = "recomputed" if drawing in old else "current"
        if drawing in outdated:
            state = _why_not_made(now, drawing)
        elif path in unpublished:
            state = f"not published: {unpublished[path]}"
        elif state == "current" and path in replaced:
            state = f"published again: {replaced[path]}"
        if not (brief and state == "current"):
            rows.append(_row(PUBLISHED.get(group), path, state))
    rows += [_row(None, path, reason) for path, reason in left_out.items()]
    if rows:
        notes = [*_notes(now, made.values())]
        notes += [f"{path}: {outdated[path]}" for path in sorted(refused - {*drawings.values()})]
        if group in PUBLISHED:
            figures = [PurePath(path).name for path in config.figures(group)]
            notes += unlisted_files(ROOT, PUBLISHED[group], figures)
        compared = any(cells[1] for _, _, cells in rows)
        header = ("figure", "files", "state", "as committed" if compared else "")
        print_files("", rows, header, notes)
    return status or int(bool(unpublished))


def _specs_of(config: Config, group: str, results: Iterable[str]) -> dict[str, BuildSpec]:
    """Return the build specifications of a group, or all if some results are of other groups."""
    specs = config.build_specs([group])
    inputs = {path for spec in specs.values() for path in spec.inputs}
    return specs if {*results, *inputs} <= specs.keys() else config.build_specs()


def _print_missing(paths: Sequence[str], count: int) -> None:
    """Print which of a number of results are missing or not current."""
    names = [PurePath(path).name for path in paths]
    more = f" and {len(names) - 3} more" if len(names) > 3 else ""
    words = f"{len(names)} of {count} results not made, or not current"
    print_error(f"{words}: {', '.join(names[:3])}{more}")


def _delete(drawings: Iterable[str]) -> None:
    """Delete drawings and their records."""
    for drawing in drawings:
        for file in (ROOT / drawing, ROOT / record_path(drawing)):
            if not why_not_a_file(file):
                file.unlink(missing_ok=True)


def _notes(freshness: Freshness, drawings: Iterable[str]) -> dict[str, None]:
    """Return what the records behind drawings note: what axes hide, and missed impacts."""
    notes = dict[str, None]()
    for path in with_dependencies(freshness.build_specs, drawings):
        output = read_record(ROOT, record_path(path))["output"]
        lines = [*output.get("hidden", ()), *output.get("notes", ())]
        notes |= dict.fromkeys(f"{freshness.build_specs[path].scene}: {line}" for line in lines)
    return notes


def _why_not_made(freshness: Freshness, drawing: str) -> str:
    """Return the state of a drawing that is outdated after a run."""
    reason = str(freshness.reason(drawing))
    if freshness.refusal(drawing):
        return reason
    behind = with_dependencies(freshness.build_specs, [drawing])
    if failures := [*filter(None, map(failure, behind))]:
        return f"not made: {failures[0]}"
    return "not made" if reason == MISSING else f"not current: {reason}"


def _publish(drawings: Drawings) -> tuple[dict[str, str], dict[str, str]]:
    """Copy drawings to their published files if these differ.

    Returns the paths where that failed, with the reasons, and all that differed, with how.
    """
    problems, replaced = dict[str, str](), dict[str, str]()
    for path, drawing in drawings.items():
        published = ROOT / path
        if reason := why_not_a_file(published):
            problems[path] = reason
        elif not (published.is_file() and filecmp.cmp(published, ROOT / drawing, shallow=False)):
            there = published.is_file()
            replaced[path] = f"it differed from {drawing}" if there else "it was missing"
            try:
                write_whole(published, read_bytes(ROOT / drawing))
            except FileError as error:
                problems[path] = str(error).removeprefix(f"{published}: ")
    return problems, replaced


def _row(folder: str | None, path: str, state: str) -> FileRow:
    """Return a file's row of the table; files in a published `folder` are compared."""
    size = compared = ""
    if state.startswith(("current", "recomputed", "published again")):
        size = f"{(ROOT / path).stat().st_size / 1000:5,.0f} kB"
        compared = committed_state(ROOT, path) if path.startswith(f"{folder}/") else ""
    return path, size, (state, compared)
