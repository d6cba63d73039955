"""./reproduce [FIGURE ...], variant, and commands that make a set of scenes, by snakemake."""

import os
from pathlib import PurePath

from ... import config
from ...commands import DEFAULT_COMMAND, all_commands
from ...config import paths
from ...config.build_specs import build_specs
from ...records.sources import ROOT
from .. import figures, running
from ..arguments import Arguments, hint
from ..packages import add_packages
from ..session import CommandLineError, locked

# Set of scenes -> its files, and further results.
Selected = dict[str, tuple[figures.Wanted, list[str]]]


def run(args: Arguments) -> int:
    """Make the files that the command and its names select."""
    command, status = all_commands().get(args.word or "", DEFAULT_COMMAND), 0
    select = _of_set if command.scenes else _variant if args.word else _named
    selected = select(args)
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
    variants = args.checked.variants
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
        results = build_specs(args.checked)
        if not files & set(results):
            if "/" in name:
                known_files = [*results, *published[config.PAPER]]
                raise CommandLineError(f"no such file is made: {name}{hint(name, known_files)}")
            if name in all_commands():
                raise CommandLineError(f"{name} is a command, no figure: run ./reproduce {name}")
            scenes = [scene for group in published for scene in variants[group]]
            meant = hint(name, [*scenes, *all_commands()]) or ": the figures are " + ", ".join(
                scenes
            )
            raise CommandLineError(f"no command or figure {name}{meant}")
        others |= {path: path for path in sorted(files & set(results))}
    if others:
        selected.setdefault(next(iter(selected), config.PAPER), {}).update(others)
    return selected


def _variant(args: Arguments) -> Selected:
    """Select all figures of a variant, or the named ones."""
    variants = args.checked.own_variants
    if args.variant is None:
        names = ", ".join(variants) or "none"
        raise CommandLineError(f"variant needs a name: config.yaml has {names}")
    figures.require_known("variant", [args.variant], variants)
    return {args.variant: (figures.of_scenes(args.checked, args.variant, args.figure), [])}


def _of_set(args: Arguments) -> Selected:
    """Select all pictures of the command's set of scenes, and data without a picture."""
    command = all_commands()[str(args.word)]
    if command.packages and not args.makes_nothing:
        add_packages(command.packages)
    files = figures.of_scenes(args.checked, command.scenes)
    data = paths.data_only(args.checked.variants, command.scenes).values()
    return {command.scenes: (files, [path for each in data for path in each])}
