"""Make the figures of a variant or set of scenes, publish them, and print the state of each."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import PurePath

from ..checks.published_sets import committed_state, unlisted_files
from ..config import Config, unknown
from ..config.results import drawn
from ..config.schema.parts import PUBLISHED
from ..records.files import ABSENT, FileError, read_bytes, why_not_a_file, write_whole
from ..records.provenance import (
    CURRENT,
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

_NOT_PUBLISHED = "not published"  # a state
Drawings = dict[str, str]  # path where users find a figure -> path of its drawing in results


def require_known(kind: str, names: Iterable[str], known: Sequence[str]) -> None:
    """Raise CommandLineError for the first name that is not a `known` one of this kind."""
    for name in names:
        if name not in known:
            raise CommandLineError(unknown(kind, name, known))


def variants_and_scenes(args: Arguments, *further: str) -> tuple[list[str], list[str]]:
    """Return the variants that a command names, those of ranges too, and the scenes.

    `further` are other names of variants. Raises CommandLineError without a variant.
    """
    config, names = args.config, args.variant
    known = [*further, *config.own_variants, *config.ranges, *config.faulty]
    scenes = [name for name in names if name not in known]
    if len(scenes) == len(names):
        require_known("variant", scenes, known)
        have = ", ".join(dict.fromkeys(known)) or "none"
        raise CommandLineError(f"{args.word} needs a name: config.yaml has {have}")
    require_known("variant or figure", scenes, [*known, *config.scenes])
    found = (config.members(name) for name in names if name in known)
    return [*dict.fromkeys(member for each in found for member in each)], scenes


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
    targets: Mapping[str, Drawings],
    args: Arguments,
    data: Sequence[str] = (),
    brief: bool = False,
) -> int:
    """Make figures in one run, publish them, print tables of them, and return the exit status.

    `targets` maps sets of scenes and variants to their figures. `data` are further results to make,
    which the tables leave out. `args` has the number of cores and the options of snakemake. A
    `brief` table leaves out figures that were current. A figure that cannot exist, for instance for
    want of its periodic orbit, is not made; if nothing else is missing, the status is 1 only for a
    published set.
    """
    before = Freshness(ROOT, config.build_specs())
    drawings = [drawing for files in targets.values() for drawing in files.values()]
    results = [path for path in (*drawings, *data) if path in before.build_specs]
    made = before.outdated(with_dependencies(before.build_specs, results))
    if made and not args.makes_nothing:
        from .packages import add_imported  # takes long to import

        add_imported({file for path in made for file in before.build_specs[path].sources})
    status = running.make(before, results, args) if results else 0
    if args.makes_nothing or status == running.INTERRUPTED:
        for group, files in targets.items():
            for drawing in files.values():
                if drawing not in before.build_specs:
                    scene = PurePath(drawing).stem
                    print(f"{group}/{scene}: {config.left_out[group][scene]}")
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
        shown = [file for group in PUBLISHED.keys() & targets for file in targets[group].values()]
        status = int(bool(shown) and not outdated.keys().isdisjoint([*shown, *data]))
    for group, files in targets.items():
        rows, notes = list[FileRow](), dict[str, None]()
        for path, drawing in files.items():
            row = _published(config, group, path, drawing, old, now)
            status = status or int(row[2][0].startswith(_NOT_PUBLISHED))
            if drawing in now.build_specs and not now.reason(drawing):
                notes |= dict.fromkeys(_notes(now, drawing))
            if not (brief and row[2][0] == CURRENT):
                rows.append(row)
        for path in sorted(outdated.keys() - drawings) if rows else ():
            if now.refusal(path):
                notes[f"{path}: {outdated[path]}"] = None
        if rows and group in PUBLISHED:
            figures = [PurePath(path).name for path in config.figures(group)]
            notes |= dict.fromkeys(unlisted_files(ROOT, group, figures).values())
        title = "as committed" if any(cells[1] for _, _, cells in rows) else ""
        if rows:
            print_files("", rows, ("figure", "files", "state", title), notes)
    return status


def _published(
    config: Config, group: str, path: str, drawing: str, old: Collection[str], now: Freshness
) -> FileRow:
    """Publish a figure if it is current and return its row; `old` was outdated before the run."""
    if drawing not in now.build_specs or now.refusal(drawing):
        for file in (ROOT / drawing, ROOT / record_path(drawing)):  # of another config
            if not why_not_a_file(file):
                file.unlink(missing_ok=True)
        known = drawing in now.build_specs
        state = now.reason(drawing) if known else config.left_out[group][PurePath(drawing).stem]
        return path, "", (str(state), "")
    if now.reason(drawing):
        return path, "", (_why_not_made(now, drawing), "")
    state = "recomputed" if drawing in old else CURRENT
    size = compared = ""
    try:
        how = _publish(path, drawing)
        state = f"published again: {how}" if how and state == CURRENT else state
        size = f"{(ROOT / path).stat().st_size / 1000:5,.0f} kB"
        if path.startswith(f"{PUBLISHED.get(group)}/"):
            compared = committed_state(ROOT, path)
    except FileError as error:
        state = f"{_NOT_PUBLISHED}: {str(error).removeprefix(f'{ROOT / path}: ')}"
    return path, size, (state, compared)


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
