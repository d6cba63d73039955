"""The figures of the paper or of a variant: what is missing of them is made, then published."""

import filecmp
import shutil
from pathlib import PurePath

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


def make(checked, variant, options, named=None, others=(), brief=False, before=None) -> int:
    """Make the figures of a variant, or some of its files, and say what became of them.

    A figure whose periodic orbit does not exist is left out, and the rest is made.

    Parameters
    ----------
    checked : dict
        The checked config.
    variant : str
        A variant, or another set of scenes.
    options : list of str
        Options for snakemake.
    named : list of str, optional
        Those of its files, as published, that are meant.
    others : list of str
        Further results to make.
    brief : bool
        Whether files that were current already are left out of the table.
    before : dict, optional
        Drawing -> its `identity` when the command began, where it may have been made since.

    Returns
    -------
    int
        The exit status.
    """
    variants = checked["variants"]
    figures = paths.figures(variants, variant)
    wanted = {path: figures[path] for path in (figures if named is None else named)}
    wanted |= {path: ("", [path]) for path in others}
    results = build_specs.of_variants(variants)
    if set(others) - set(results):
        results = build_specs.of_all(checked)
    # File, as published -> its drawing.
    made = {path: behind[-1] for path, (_, behind) in wanted.items()}
    before = before or {drawing: identity(drawing) for drawing in made.values()}
    freshness = Freshness(ROOT, results)
    hidden = [*_hidden(variants[variant], [scene for scene, _ in wanted.values()])]
    status = running.make(checked, freshness, made.values(), options)
    if running.is_dry_run(options) or status == running.INTERRUPTED:
        print(*hidden, sep="\n", end="\n" * bool(hidden))
        return status
    freshness = Freshness(ROOT, results)
    outdated, absent = freshness.outdated(before), known_absent(freshness, variants, variant)
    missing = {scene for path, (scene, _) in wanted.items() if made[path] in outdated}
    if missing and missing <= set(absent):
        status = 0
    rows = {}
    for path, (scene, behind) in wanted.items():
        rows[path] = scene, "recomputed"
        if made[path] in outdated:
            why = next(filter(None, map(failure, behind)), None)
            stale = outdated[made[path]]  # what was made may be stale by now: its source was edited
            failed = "not made" if stale == MISSING else f"not current: {stale}"
            failed = f"not made: {why}" if why else failed
            rows[path] = scene, f"cannot exist: {absent[scene]}" if scene in absent else failed
        elif identity(made[path]) == before[made[path]]:
            rows[path] = scene, "current"
    for path, (scene, _) in wanted.items():
        if scene in absent:  # an older one would be taken for it
            for old in (made[path], record_path(made[path])):
                (ROOT / old).unlink(missing_ok=True)
    good = {path: drawing for path, drawing in made.items() if drawing not in outdated}
    for path, why in publish(good).items():
        rows[path], status = (rows[path][0], f"not published: {why}"), status or 1
    more = [*hidden, *_missed_impacts(variants, variant, {wanted[path][0] for path in good})]
    if variant in paths.PUBLISHED:
        folder = paths.PUBLISHED[variant]
        more += unlisted_files(ROOT, folder, [PurePath(path).name for path in figures])
    shown = {path: row for path, row in rows.items() if not (brief and row[1] == "current")}
    if shown:
        table(paths.PUBLISHED.get(variant), shown, more)
    if variant in paths.PUBLISHED and any(scene in absent for scene, _ in wanted.values()):
        return status or 1
    return status


def table(folder, rows, more=()) -> None:
    """Print the files of a run, one a line, and how those published in `folder` are committed.

    `rows` is file -> (scene, what became of it); `more` are lines after them.
    """
    as_committed = states.committed(folder, rows) if folder else {}
    lines = [("figure", "file", "size", "state", "as committed" if as_committed else "")]
    for path, (scene, state) in rows.items():
        made = state in ("current", "recomputed")
        size = f"{(ROOT / path).stat().st_size / 1000:7,.0f} kB" if made else ""
        lines.append((scene, path, size, state, as_committed.get(path, "") if made else ""))
    print("", *columns(lines), *more, sep="\n")


def made(folder, files, before) -> int:
    """Publish drawings and print a line for each; 1 where one cannot be published.

    `files` is file, as published -> drawing; `before` is drawing -> its `identity` before the run.
    """
    problems = publish(files)
    rows = {
        path: (PurePath(path).stem, "current" if identity(file) == before[file] else "recomputed")
        for path, file in files.items()
    }
    rows |= {path: (rows[path][0], f"not published: {why}") for path, why in problems.items()}
    table(folder, rows)
    return int(bool(problems))


def of_scenes(checked, variant, names) -> list[str] | None:
    """The files of these scenes of a variant, as published; None for all where none is named."""
    scenes = checked["variants"][variant]
    for name in names:
        if name not in scenes:
            raise CommandLineError(unknown("figure", name, list(scenes)))
    found = paths.figures(checked["variants"], variant)
    return [path for path, (scene, _) in found.items() if scene in names] if names else None


def publish(drawings) -> dict[str, str]:
    """Copy each finished drawing to where users look for it, in one step, where it is another.

    Returns published file -> why it could not be, for each that could not.
    """
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


def known_absent(freshness, variants, variant) -> dict[str, str]:
    """Scene -> why its figure cannot exist, as far as the jobs of a variant have found."""
    found = {
        scene: freshness.refusal(behind[-1])
        for scene, behind in paths.figures(variants, variant).values()
    }
    return {scene: why for scene, why in found.items() if why}


def _hidden(blocks, scenes):
    """A line for each field of these scenes that asks for more than its axes show."""
    for scene in dict.fromkeys(filter(None, scenes)):
        kind = KINDS[blocks[scene]["picture"]]
        yield from (f"{scene}: {line}" for line in kind.hidden(blocks[scene]))


def _missed_impacts(variants, variant, scenes):
    """Of each of these scenes with a `method`: what it did, one line a scene."""
    artifact_paths = paths.artifact_paths(variants)
    for scene, block in variants[variant].items():
        method, stages = block.get("method", {}), paths.stages(block)
        if scene in scenes and "exact" in method:
            exact = "orbits of their exact starts"
            how = exact if "orbits" in stages else "no stage with an exact method"
            yield f"{scene}: {how}; other stages as in doubles"
        elif scene in scenes and method:
            from ..records.artifacts import load  # takes a while

            names = [stage for stage in stages if "method" in stages[stage]]
            found = [load(ROOT / artifact_paths[variant, scene, stage]).attrs for stage in names]
            missed, impacts = (sum(a[n] for a in found) for n in ("impacts_missed", "impacts"))
            how = ", ".join(f"{key} {value:g}" for key, value in method.items())
            yield f"{scene}: {missed:,} of {impacts:,} impacts fell through the floor ({how})"
