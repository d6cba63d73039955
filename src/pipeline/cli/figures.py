"""Make the figures of a variant or set of scenes, publish them, and print the state of each."""

import filecmp
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import PurePath

from ..checks.published_sets import committed_state, unlisted_files
from ..config import Config, unknown
from ..config.results import drawn, stages
from ..config.schema.sets import PUBLISHED
from ..config.schema.stages import METHODS
from ..records.files import FileError, inode, read_bytes, why_not_a_file, write_whole
from ..records.provenance import (
    MISSING,
    REFUSED,
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
from .session import CommandLineError, print_error
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
    specs = _specs_of(config, group, results)
    inodes = {drawing: inode(drawing) for drawing in drawings.values()}  # before the run
    status = running.make(Freshness(ROOT, specs), results, args) if results else 0
    if args.makes_nothing or status == running.INTERRUPTED:
        notes = [f"{PurePath(path).stem}: {reason}" for path, reason in left_out.items()]
        print(*notes, sep="\n", end="\n" * bool(notes))
        return status
    freshness = Freshness(ROOT, specs)
    outdated = freshness.outdated(results)
    refused = {path for path in outdated if freshness.refusal(path)}
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
        state = _state(specs, drawing, outdated.get(drawing), inode(drawing) != inodes[drawing])
        if path in unpublished:
            state = f"not published: {unpublished[path]}"
        elif state == "current" and path in replaced:
            state = f"published again: {replaced[path]}"
        if not (brief and state == "current"):
            rows.append(_row(PUBLISHED.get(group), path, state))
    rows += [_row(None, path, reason) for path, reason in left_out.items()]
    if rows:
        notes = [*_hidden(made.values())]
        notes += [f"{path}: {outdated[path]}" for path in sorted(refused - {*drawings.values()})]
        notes += _missed_impacts(config, group, {PurePath(path).stem for path in made.values()})
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


def _hidden(drawings: Iterable[str]) -> dict[str, None]:
    """Return a line for each axis that hides something, as the records of the drawings say."""
    outputs = {path: read_record(ROOT, record_path(path))["output"] for path in drawings}
    lines = [(path, line) for path, output in outputs.items() for line in output.get("hidden", ())]
    return dict.fromkeys(f"{PurePath(path).stem}: {line}" for path, line in lines)


def _state(specs: Mapping[str, BuildSpec], drawing: str, reason: str | None, replaced: bool) -> str:
    """Return the state of a drawing after a run; `reason` says why it is outdated, if it is."""
    if reason is None:
        return "recomputed" if replaced else "current"
    if reason.startswith(REFUSED):
        return reason
    if failures := [*filter(None, map(failure, with_dependencies(specs, [drawing])))]:
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


def _missed_impacts(config: Config, variant: str, scenes: set[str]) -> Iterator[str]:
    """Yield a line for each scene with a `method`: impacts that were missed, or what is exact."""
    for scene, block in config.variants.get(variant, {}).items():
        method = block.as_mapping().get("method", {}) if scene in scenes else {}
        of_method = [stage for stage, fields in stages(block).items() if "method" in fields]
        if of_part := method.keys() & METHODS.keys():
            computed = ", ".join(of_method) or "no stage"
            yield f"{scene}: {computed} by the method {', '.join(of_part)}; all else in doubles"
        elif method:
            from ..records.artifacts import load  # takes long to import

            data = config.data_of(variant, scene)
            counts = [load(ROOT / data[stage]).attrs for stage in of_method]
            missed, impacts = (sum(c[n] for c in counts) for n in ("impacts_missed", "impacts"))
            values = ", ".join(f"{key} {value:g}" for key, value in method.items())
            yield f"{scene}: {missed:,} of {impacts:,} impacts fell through the floor ({values})"
