"""./reproduce [FIGURE ...]: make figures, or other files, with snakemake."""

import os

from ... import config
from ...config import build_specs
from ...records.sources import ROOT
from .. import figures, running
from ..arguments import COMMANDS, Arguments, hint
from ..session import CommandLineError, locked


def run(args: Arguments) -> int:
    """Make every figure of the paper, or the named figures and files."""
    _select(args, args.figure)  # reports misspelt names before errors in snakemake's options
    targets = running.options_of(args.options).targets
    options = [a for a in args.options if a not in targets]
    status = 0
    with locked():
        for group, files in _select(args, [*args.figure, *targets] or ["all"]).items():
            status = figures.make(args.checked, group, files, options) or status
            if status == running.INTERRUPTED:
                break
    return status


def _select(args: Arguments, names: list[str]) -> dict[str, figures.Wanted]:
    """Return the published files, by their sets of scenes, and other results with these names."""
    variants = args.checked["variants"]
    published = {variant: config.figures(variants, variant) for variant in config.PUBLISHED}
    selected: dict[str, figures.Wanted] = {}
    others: figures.Wanted = {}
    for name in names:
        # A path is relative to the root or to the user's folder.
        files = {os.path.normpath(name), os.path.relpath(args.start / name, ROOT)}
        found = [
            (variant, path)
            for variant, known in published.items()
            for path, (scene, _) in known.items()
            if scene == name or path in files or (name, variant) == ("all", config.PAPER)
        ]
        for variant, path in found:
            selected.setdefault(variant, {})[path] = published[variant][path]
        if found:
            continue
        results = build_specs.of_all(args.checked)
        if not files & set(results):
            if "/" in name:
                known_files = [*results, *published[config.PAPER]]
                raise CommandLineError(f"no such file is made: {name}{hint(name, known_files)}")
            scenes = [scene for variant in published for scene in variants[variant]]
            meant = hint(name, [*scenes, *COMMANDS]) or ": the figures are " + ", ".join(scenes)
            raise CommandLineError(f"no command or figure {name}{meant}")
        others |= {path: ("", [path]) for path in sorted(files & set(results))}
    if others:
        selected.setdefault(next(iter(selected), config.PAPER), {}).update(others)
    return selected
