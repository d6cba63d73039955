"""./reproduce, and ./reproduce FIGURE ...: figures, or some files, made by snakemake."""

import os

from ... import config
from ...config import build_specs
from ...records.sources import ROOT
from .. import figures, running
from ..arguments import COMMANDS, hint
from ..session import CommandLineError, locked


def run(args) -> int:
    """Make every figure of the paper, or those figures and files that are named."""
    _meant(args, args.figure)  # a misspelt one, before what snakemake refuses
    targets = running.options_of(args.options).targets
    options = [a for a in args.options if a not in targets]
    sets, others = _meant(args, [*args.figure, *targets] or ["all"])
    status = 0
    with locked():
        for variant in sets or [config.PAPER]:
            named = sets.get(variant, [])
            status = figures.make(args.checked, variant, options, named, others) or status
            others = []
            if status == running.INTERRUPTED:
                break
    return status


def _meant(args, names):
    """({set of scenes: its files that are meant}, other results); MisuseError for no such."""
    variants = args.checked["variants"]
    published = {variant: config.figures(variants, variant) for variant in config.PUBLISHED}
    results, sets, others = {}, {}, []
    for name in names:
        # As it stands, or from the folder in which the user is.
        files = {os.path.normpath(name), os.path.relpath(args.start / name, ROOT)}
        found = [
            (variant, path)
            for variant, known in published.items()
            for path, (scene, _) in known.items()
            if scene == name or path in files or (name, variant) == ("all", config.PAPER)
        ]
        for variant, path in found:
            sets.setdefault(variant, {})[path] = None
        if found:
            continue
        results = results or build_specs.of_all(args.checked)
        if not files & set(results):
            scenes = [scene for variant in published for scene in variants[variant]]
            known = (
                [*scenes, *COMMANDS] if "/" not in name else [*results, *published[config.PAPER]]
            )
            what = "word or figure" if "/" not in name else "such file is made:"
            there = "" if "/" in name else f": the figures are {', '.join(scenes)}"
            raise CommandLineError(f"no {what} {name}{hint(name, known) or there}")
        others += sorted(files & set(results))
    return sets, others
