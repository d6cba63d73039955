"""Make the figures of a variant, publish them, and print what became of each."""

import filecmp
import shutil
import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import PurePath

from ..checks.freshness import MISSING, Freshness
from ..checks.published_sets import committed_state, unlisted_files
from ..config import Config, paths, unknown
from ..config.build_specs import build_specs, with_dependencies
from ..config.schema.scene import Picture
from ..config.schema.sets import PUBLISHED
from ..records.differences import columns
from ..records.files import FileError, identity, obstacle, read_bytes, write_whole
from ..records.record import failure, record_path
from ..records.sources import ROOT
from . import running
from .arguments import Arguments
from .session import CommandLineError, print_error

Wanted = dict[str, str]  # file, where users find it -> its drawing in results


def require_known(kind: str, names: Iterable[str], known: Sequence[str]) -> None:
    """Raise CommandLineError for the first name that config.yaml does not have."""
    for name in names:
        if name not in known:
            raise CommandLineError(unknown(kind, name, known))


def of_scenes(checked: Config, variant: str, names: Sequence[str] = ()) -> Wanted:
    """Return the files of the named scenes of a variant, of all without names.

    They include a file of each scene that the variant leaves out.
    """
    files = {p: (s, made[-1]) for p, (s, made) in paths.figures(checked.variants, variant).items()}
    for scene in checked.left_out.get(variant, ()):
        files[paths.drawn(scene, "png", variant)] = scene, paths.drawn(scene, "png", variant)
    require_known("figure", names, [*dict.fromkeys(scene for scene, _ in files.values())])
    return {path: drawn for path, (scene, drawn) in files.items() if not names or scene in names}


def make(
    checked: Config,
    group: str,
    wanted: Wanted,
    args: Arguments,
    data: Iterable[str] = (),
    brief: bool = False,
) -> int:
    """Make and publish files, print a table of them, and return the exit status.

    A figure whose periodic orbit does not exist is left out, and the others are made; the status is
    1 only if it should have been published. `group` is a set of scenes or a variant. Further
    results to make are `data`, which the table leaves out, as it does files that were current if it
    is `brief`. `args` say what snakemake does.
    """
    variants, folder = checked.variants, PUBLISHED.get(group)
    reasons = checked.left_out.get(group, {})
    left_out = {path: PurePath(path).stem for path in wanted if PurePath(path).stem in reasons}
    wanted = {path: drawing for path, drawing in wanted.items() if path not in left_out}
    results = [*wanted.values(), *data]
    specs = build_specs(checked, [group])
    if set(results) - set(specs):
        specs = build_specs(checked)
    before = {drawing: identity(drawing) for drawing in wanted.values()}

    def blocks(drawings: Iterable[str]) -> dict[str, Picture]:
        scenes = {PurePath(path).stem for path in drawings}
        return {name: block for name, block in variants.get(group, {}).items() if name in scenes}

    notes = [*_hidden(blocks(wanted.values()))]
    status = running.make(Freshness(ROOT, specs), results, args) if results else 0
    if args.makes_nothing or status == running.INTERRUPTED:
        notes += [f"{scene}: {reasons[scene]}" for scene in left_out.values()]
        print(*notes, sep="\n", end="\n" * bool(notes))
        return status
    freshness = Freshness(ROOT, specs)
    outdated = freshness.outdated(results)
    refused = {path for path in outdated if freshness.refusal(path)}
    if refused and refused == outdated.keys():
        status = int(bool(folder))
    elif outdated:
        status = status or 1
        print_error(_not_made([path for path in outdated if path not in refused], len(results)))
    states = {}
    for path, drawing in wanted.items():
        state = "recomputed"
        if drawing in refused:
            state = outdated[drawing]
        elif drawing in outdated:
            state = _failed(with_dependencies(specs, [drawing]), outdated[drawing])
        elif identity(drawing) == before[drawing]:
            state = "current"
        states[path] = state
    good = {path: drawing for path, drawing in wanted.items() if drawing not in outdated}
    for path, reason in _publish(good).items():
        states[path], status = f"not published: {reason}", status or 1
    notes += _missed_impacts(paths.artifact_paths(variants), group, blocks(good.values()))
    if group in PUBLISHED:
        figures = paths.figures(variants, group)
        notes += unlisted_files(ROOT, str(folder), [PurePath(path).name for path in figures])
    rows = [
        (specs[wanted[path]].scene, path, state)
        for path, state in states.items()
        if not (brief and state == "current")
    ]
    rows += [(name, path, reasons[name]) for path, name in left_out.items()]
    for drawing in (*(refused & {*wanted.values()}), *left_out):
        for old in (drawing, record_path(drawing)):  # could be mistaken for this variant's
            if not obstacle(ROOT / old):
                (ROOT / old).unlink(missing_ok=True)
    if rows:
        _print_table(folder, rows, notes)
    return status


def _not_made(paths: list[str], total: int) -> str:
    """Say how many of the results that were asked for are missing or outdated after a run."""
    more = f" and {len(paths) - 3} more" if len(paths) > 3 else ""
    names = ", ".join(PurePath(path).name for path in paths[:3])
    return f"{len(paths)} of {total} results not made, or not current: {names}{more}"


def _failed(upstream: list[str], reason: str) -> str:
    """State of a file whose drawing is outdated after the run, for instance by an edit."""
    if failures := [*filter(None, map(failure, upstream))]:
        return f"not made: {failures[0]}"
    return "not made" if reason == MISSING else f"not current: {reason}"


def _print_table(
    folder: str | None, states: Iterable[tuple[str, str, str]], notes: Iterable[str]
) -> None:
    """Print scene and state of each file, compared with the commit in a `folder`, and notes."""
    rows, reasons = [], dict[str, list[str]]()
    for scene, path, state in states:
        size = compared = ""
        if state in ("current", "recomputed"):
            size = f"{(ROOT / path).stat().st_size / 1000:7,.0f} kB"
            compared = committed_state(ROOT, path) if path.startswith(f"{folder}/") else ""
        if ": " in state:
            reasons.setdefault(state, []).append(path)
        rows.append((scene, path, size, state.partition(": ")[0], compared))
    head = ("figure", "file", "size", "state", "as committed" if any(r[-1] for r in rows) else "")
    width = shutil.get_terminal_size((10**6, 24)).columns  # without a terminal, lines stay whole
    wrap = partial(textwrap.wrap, width=width, subsequent_indent="  ", break_long_words=False)
    found = [f"{', '.join(files)}: {reason}" for reason, files in reasons.items()]
    lines = [line for note in (*found, *notes) for line in wrap(note)]
    print("", *columns([head, *rows]), *lines, sep="\n")


def _publish(drawings: dict[str, str]) -> dict[str, str]:
    """Copy drawings to their published files where these differ; return the files that failed."""
    problems = {}
    for path, drawing in drawings.items():
        published = ROOT / path
        if words := obstacle(published):
            problems[path] = words
        elif not (published.is_file() and filecmp.cmp(published, ROOT / drawing, shallow=False)):
            try:
                write_whole(published, read_bytes(ROOT / drawing))
            except FileError as error:
                problems[path] = str(error).removeprefix(f"{published}: ")
    return problems


def _hidden(scenes: dict[str, Picture]) -> Iterator[str]:
    """Yield a line for each field of these scenes that asks for more than the axes show."""
    for scene, block in scenes.items():
        yield from (f"{scene}: {line}" for line in block.hidden())


def _missed_impacts(
    artifact_paths: Mapping[tuple[str, str, str], str], variant: str, scenes: dict[str, Picture]
) -> Iterator[str]:
    """Yield a line for each of these scenes with a `method`: what it computed or missed."""
    for scene, block in scenes.items():
        method, stages = block.as_mapping().get("method", {}), paths.stages(block)
        if "exact" in method:
            exact = "orbits of their exact starts"
            computed = exact if "orbits" in stages else "no stage with an exact method"
            yield f"{scene}: {computed}; other stages as in doubles"
        elif method:
            from ..records.artifacts import load  # takes long to import

            names = [stage for stage in stages if "method" in stages[stage]]
            counts = [load(ROOT / artifact_paths[variant, scene, stage]).attrs for stage in names]
            missed, impacts = (sum(c[n] for c in counts) for n in ("impacts_missed", "impacts"))
            values = ", ".join(f"{key} {value:g}" for key, value in method.items())
            yield f"{scene}: {missed:,} of {impacts:,} impacts fell through the floor ({values})"
