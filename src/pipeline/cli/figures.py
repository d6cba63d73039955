"""Make the figures of a variant, publish them, and print what became of each."""

import filecmp
import shutil
from collections.abc import Iterable, Iterator, Mapping
from pathlib import PurePath
from typing import Any

from ..checks.checksums import unlisted_files
from ..checks.freshness import MISSING, Freshness
from ..config import build_specs, paths, unknown
from ..config.schema.kinds import KINDS
from ..records.differences import columns
from ..records.files import FileError, identity, obstacle, replacing
from ..records.record import failure, record_path
from ..records.sources import ROOT
from . import running
from .progress import states
from .session import CommandLineError


def make(
    checked: dict[str, Any],
    variant: str,
    options: list[str],
    files: list[str] | None = None,
    others: Iterable[str] = (),
    brief: bool = False,
    before: dict[str, int | None] | None = None,
) -> int:
    """Make and publish figures, print a table of them, and return the exit status.

    A figure whose periodic orbit does not exist is left out, and the others are made.

    Parameters
    ----------
    checked : dict
        The checked config.
    variant : str
        A variant, or another set of scenes.
    options : list of str
        Options for snakemake.
    files : list of str, optional
        The published files to make, by default all of the variant.
    others : iterable of str
        Further results to make.
    brief : bool
        Whether the table leaves out files that were current already.
    before : dict, optional
        The `identity` of each drawing when the command began; by default, now.
    """
    variants = checked["variants"]
    figures = paths.figures(variants, variant)
    # File -> (its scene, the results that it is made from, its drawing last).
    wanted = {path: figures[path] for path in (figures if files is None else files)}
    wanted |= {path: ("", [path]) for path in others}
    specs = build_specs.of_variants(variants)
    if set(others) - set(specs):
        specs = build_specs.of_all(checked)
    drawings = {path: upstream[-1] for path, (_, upstream) in wanted.items()}
    before = before or {drawing: identity(drawing) for drawing in drawings.values()}
    notes = [*_hidden(variants[variant], [scene for scene, _ in wanted.values()])]
    status = running.make(checked, Freshness(ROOT, specs), drawings.values(), options)
    if running.is_dry_run(options) or status == running.INTERRUPTED:
        print(*notes, sep="\n", end="\n" * bool(notes))
        return status
    freshness = Freshness(ROOT, specs)
    outdated, absent = freshness.outdated(before), known_absent(freshness, variants, variant)
    missing = {scene for path, (scene, _) in wanted.items() if drawings[path] in outdated}
    if missing and missing <= set(absent):
        status = 0
    rows = {}
    for path, (scene, upstream) in wanted.items():
        drawing, state = drawings[path], "recomputed"
        if scene in absent:
            state = f"cannot exist: {absent[scene]}"
            for old in (drawing, record_path(drawing)):  # could be mistaken for this variant's
                (ROOT / old).unlink(missing_ok=True)
        elif drawing in outdated:
            state = _failed(upstream, outdated[drawing])
        elif identity(drawing) == before[drawing]:
            state = "current"
        rows[path] = scene, state
    good = {path: drawing for path, drawing in drawings.items() if drawing not in outdated}
    for path, reason in _publish(good).items():
        rows[path], status = (rows[path][0], f"not published: {reason}"), status or 1
    notes += _missed_impacts(variants, variant, {wanted[path][0] for path in good})
    folder = paths.PUBLISHED.get(variant)
    if folder:
        notes += unlisted_files(ROOT, folder, [PurePath(path).name for path in figures])
    shown = {path: row for path, row in rows.items() if not (brief and row[1] == "current")}
    if shown:
        _print_table(folder, shown, notes)
    if folder and any(scene in absent for scene, _ in wanted.values()):
        return status or 1
    return status


def _failed(upstream: list[str], reason: str) -> str:
    """State of a file whose drawing is outdated after the run, for instance by an edit."""
    if failures := [*filter(None, map(failure, upstream))]:
        return f"not made: {failures[0]}"
    return "not made" if reason == MISSING else f"not current: {reason}"


def _print_table(
    folder: str | None, rows: Mapping[str, tuple[str, str]], notes: Iterable[str] = ()
) -> None:
    """Print a line for each file of `rows`, which maps it to its scene and state, then notes.

    Files that are published in `folder` are compared with the committed ones.
    """
    as_committed = states.committed(folder, rows) if folder else {}
    lines = [("figure", "file", "size", "state", "as committed" if as_committed else "")]
    for path, (scene, state) in rows.items():
        made = state in ("current", "recomputed")
        size = f"{(ROOT / path).stat().st_size / 1000:7,.0f} kB" if made else ""
        lines.append((scene, path, size, state, as_committed.get(path, "") if made else ""))
    print("", *columns(lines), *notes, sep="\n")


def publish_and_report(folder: str, files: dict[str, str], before: Mapping[str, int | None]) -> int:
    """Publish drawings, print a table of them, and return 1 if one could not be published.

    `files` maps published files to drawings, and `before` maps drawings to their `identity` before
    the run.
    """
    problems = _publish(files)
    rows = {}
    for path, file in files.items():
        state = "current" if identity(file) == before[file] else "recomputed"
        if path in problems:
            state = f"not published: {problems[path]}"
        rows[path] = PurePath(path).stem, state
    _print_table(folder, rows)
    return int(bool(problems))


def of_scenes(checked: dict[str, Any], variant: str, names: list[str]) -> list[str] | None:
    """Return the published files of these scenes of a variant, None (for all) without names."""
    scenes = checked["variants"][variant]
    for name in names:
        if name not in scenes:
            raise CommandLineError(unknown("figure", name, list(scenes)))
    figures = paths.figures(checked["variants"], variant)
    return [path for path, (scene, _) in figures.items() if scene in names] if names else None


def _publish(drawings: dict[str, str]) -> dict[str, str]:
    """Copy drawings to their published files where these differ; return the files that failed."""
    problems = {}
    for path, drawing in drawings.items():
        published = ROOT / path
        if words := obstacle(published):
            problems[path] = words
        elif not (published.is_file() and filecmp.cmp(published, ROOT / drawing, shallow=False)):
            try:
                with replacing(published) as part:
                    shutil.copyfile(ROOT / drawing, part)
            except FileError as error:
                problems[path] = str(error).removeprefix(f"{published}: ")
    return problems


def known_absent(freshness: Freshness, variants: dict[str, Any], variant: str) -> dict[str, str]:
    """Map scenes whose figures cannot exist, as far as jobs found out, to the reasons."""
    reasons = {
        scene: freshness.refusal(upstream[-1])
        for scene, upstream in paths.figures(variants, variant).values()
    }
    return {scene: reason for scene, reason in reasons.items() if reason}


def _hidden(blocks: dict[str, Any], scenes: list[str]) -> Iterator[str]:
    """Yield a line for each field of these scenes that asks for more than the axes show."""
    for scene in dict.fromkeys(filter(None, scenes)):
        kind = KINDS[blocks[scene]["picture"]]
        yield from (f"{scene}: {line}" for line in kind.hidden(blocks[scene]))


def _missed_impacts(variants: dict[str, Any], variant: str, scenes: set[str]) -> Iterator[str]:
    """Yield a line for each of these scenes with a `method`: what it computed or missed."""
    artifact_paths = paths.artifact_paths(variants)
    for scene, block in variants[variant].items():
        method, stages = block.get("method", {}), paths.stages(block)
        if scene in scenes and "exact" in method:
            exact = "orbits of their exact starts"
            computed = exact if "orbits" in stages else "no stage with an exact method"
            yield f"{scene}: {computed}; other stages as in doubles"
        elif scene in scenes and method:
            from ..records.artifacts import load  # takes long to import

            names = [stage for stage in stages if "method" in stages[stage]]
            counts = [load(ROOT / artifact_paths[variant, scene, stage]).attrs for stage in names]
            missed, impacts = (sum(c[n] for c in counts) for n in ("impacts_missed", "impacts"))
            values = ", ".join(f"{key} {value:g}" for key, value in method.items())
            yield f"{scene}: {missed:,} of {impacts:,} impacts fell through the floor ({values})"
