"""./reproduce [FIGURE ...], variant, families, study, sweep, atlas: make files by snakemake."""

import os
import shutil
from itertools import product
from pathlib import PurePath

from ... import config
from ...config import build_specs, paths
from ...config.schema import study
from ...records.sources import ROOT
from .. import figures, running
from ..arguments import COMMANDS, Arguments, hint
from ..packages import add_packages
from ..session import CommandLineError, UsageError, locked

# Set of scenes -> its files, and further results.
Selected = dict[str, tuple[figures.Wanted, list[str]]]


def run(args: Arguments) -> int:
    """Make the files that the command and its names select."""
    selected, status = _SELECT.get(args.word, _named)(args), 0
    with locked():
        for group, (files, data) in selected.items():
            status = figures.make(args.checked, group, files, args, data) or status
            if status == running.INTERRUPTED:
                break
    return status


def _named(args: Arguments) -> Selected:
    """Select every figure of the paper, or the named figures and files."""
    found = _find(args, args.figure or ["all"])
    return {group: (files, []) for group, files in found.items()}


def _find(args: Arguments, names: list[str]) -> dict[str, figures.Wanted]:
    """Return the published files, by their sets of scenes, and other results with these names."""
    variants = args.checked["variants"]
    published = {group: figures.of_scenes(args.checked, group) for group in config.PUBLISHED}
    selected: dict[str, figures.Wanted] = {}
    others: figures.Wanted = {}
    for name in names:
        # A path is relative to the root or to the user's folder.
        files = {os.path.normpath(name), os.path.relpath(args.start / name, ROOT)}
        found = [
            (group, path)
            for group, known in published.items()
            for path, drawing in known.items()
            if name == PurePath(drawing).stem
            or path in files
            or (name, group) == ("all", config.PAPER)
        ]
        for group, path in found:
            selected.setdefault(group, {})[path] = published[group][path]
        if found:
            continue
        results = build_specs.of_all(args.checked)
        if not files & set(results):
            if "/" in name:
                known_files = [*results, *published[config.PAPER]]
                raise CommandLineError(f"no such file is made: {name}{hint(name, known_files)}")
            if name in COMMANDS:
                raise CommandLineError(f"{name} is a command, no figure: run ./reproduce {name}")
            scenes = [scene for group in published for scene in variants[group]]
            meant = hint(name, [*scenes, *COMMANDS]) or ": the figures are " + ", ".join(scenes)
            raise CommandLineError(f"no command or figure {name}{meant}")
        others |= {path: path for path in sorted(files & set(results))}
    if others:
        selected.setdefault(next(iter(selected), config.PAPER), {}).update(others)
    return selected


def _variant(args: Arguments) -> Selected:
    """Select all figures of a variant, or the named ones."""
    variants = [name for name in args.checked["variants"] if name not in config.PUBLISHED]
    if args.variant is None:
        names = ", ".join(variants) or "none"
        raise CommandLineError(f"variant needs a name: config.yaml has {names}")
    figures.require_known("variant", [args.variant], variants)
    return {args.variant: (figures.of_scenes(args.checked, args.variant, args.figure), [])}


def _families(args: Arguments) -> Selected:
    """Select the pictures of families."""
    return {"families": (figures.of_scenes(args.checked, "families"), [])}


def _study(args: Arguments) -> Selected:
    """Select the study's data, its charts, and the published ones of computed data.

    Charts of measured times stay in results/ until `accept`.
    """
    if not args.makes_nothing:
        add_packages("study")
    files = {}
    for chart, extension in product(study.CHARTS, study.FORMATS):
        fixed = study.CHARTS[chart][0] in study.FIXED
        drawn = study.drawn(chart, extension)
        files[study.published(chart, extension) if fixed else drawn] = drawn
    return {"study": (files, [*map(study.data, (*study.FIXED, *study.MEASURED))])}


def _sweep(args: Arguments) -> Selected:
    """Select the datasets of all sweeps or of the named ones; `atlas` selects pictures too."""
    sweeps = args.checked["sweeps"]
    figures.require_known("sweep", args.sweep, list(sweeps))
    if not sweeps:
        raise UsageError("config.yaml: sweeps: missing, or empty")
    if args.slurm:
        if shutil.which("sbatch") is None:
            raise UsageError("--slurm: there is no sbatch on this machine")
        args.options = [f"--profile={ROOT / 'profiles' / 'slurm'}", *args.options]
        add_packages("slurm")
    files = {}
    for name in args.sweep or sweeps:
        files[paths.sweep_dataset(name)] = paths.sweep_dataset(name)
        for drawing in paths.sweep_pictures(name, sweeps[name]) if args.word == "atlas" else ():
            files[paths.atlas_published(drawing)] = drawing
    return {"sweep": (files, [])}


# Command -> what it selects; others select by names.
_SELECT = {
    "variant": _variant,
    "families": _families,
    "study": _study,
    "sweep": _sweep,
    "atlas": _sweep,
}
