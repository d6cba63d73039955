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
    figure_sets, others = _select(args, [*args.figure, *targets] or ["all"])
    status = 0
    with locked():
        for variant in figure_sets or [config.PAPER]:
            files = figure_sets.get(variant, [])
            status = figures.make(args.checked, variant, options, files, others) or status
            others = []
            if status == running.INTERRUPTED:
                break
    return status


def _select(args: Arguments, names: list[str]) -> tuple[dict[str, list[str]], list[str]]:
    """Return {set of scenes: its published files} and other results that the names select."""
    variants = args.checked["variants"]
    published = {variant: config.figures(variants, variant) for variant in config.PUBLISHED}
    figure_sets: dict[str, dict[str, None]] = {}
    others: list[str] = []
    for name in names:
        # A path is relative to the root or to the user's folder.
        files = {os.path.normpath(name), os.path.relpath(args.start / name, ROOT)}
        selected = [
            (variant, path)
            for variant, known in published.items()
            for path, (scene, _) in known.items()
            if scene == name or path in files or (name, variant) == ("all", config.PAPER)
        ]
        for variant, path in selected:
            figure_sets.setdefault(variant, {})[path] = None
        if selected:
            continue
        results = build_specs.of_all(args.checked)
        if not files & set(results):
            if "/" in name:
                known_files = [*results, *published[config.PAPER]]
                raise CommandLineError(f"no such file is made: {name}{hint(name, known_files)}")
            scenes = [scene for variant in published for scene in variants[variant]]
            meant = hint(name, [*scenes, *COMMANDS])
            raise CommandLineError(
                f"no command or figure {name}{meant or ': the figures are ' + ', '.join(scenes)}"
            )
        others += sorted(files & set(results))
    return {variant: list(paths) for variant, paths in figure_sets.items()}, others
