"""./reproduce, and ./reproduce FIGURE ...: figures, or some files, made by snakemake."""

import os

from ... import config
from ...config import expected
from ...config.checking.reading import load
from ...records.sources import ROOT
from .. import figures, running
from ..arguments import WORDS, hint
from ..folder import MisuseError, locked


def run(given) -> int:
    """Make every figure of the paper, or those figures and files that are named."""
    checked = load(ROOT / "config.yaml")
    _meant(checked, given.figure, given.start)  # a misspelt one, before what snakemake refuses
    targets = running.options_of(given.options).targets if given.options else []
    options = [a for a in given.options if a not in targets]
    names = [*given.figure, *targets]
    sets, others = _meant(checked, names, given.start)
    with locked():
        if not (sets or others):
            return figures.make(checked, config.PAPER, options)
        status = 0
        for variant in sets or ([config.PAPER] if others else []):
            named = sets.get(variant, [])
            status = figures.make(checked, variant, options, named, others) or status
            others = []
            if status == running.INTERRUPTED:
                break
        return status


def _meant(checked, names, start):
    """({set of scenes: its files that are meant}, other results); MisuseError for no such."""
    variants = checked["variants"]
    published = {variant: config.figures(variants, variant) for variant in config.PUBLISHED}
    results = {}
    sets, others = {}, []
    for name in names:
        if name == "all":
            continue
        # As it stands, or from the folder in which the user is.
        files = {os.path.normpath(name), os.path.relpath(start / name, ROOT)}
        found = {
            variant: [path for path, (scene, _) in known.items() if scene == name or path in files]
            for variant, known in published.items()
        }
        for variant, paths in found.items():
            if paths:
                sets[variant] = list(dict.fromkeys([*sets.get(variant, []), *paths]))
        if any(found.values()):
            continue
        results = results or (
            expected.of_variants(variants)
            | expected.of_study(variants)
            | expected.of_sweeps(checked["sweeps"])
        )
        if not files & set(results):
            scenes = [scene for variant in published for scene in variants[variant]]
            known = [*scenes, *WORDS] if "/" not in name else [*results, *published[config.PAPER]]
            what = "word or figure" if "/" not in name else "such file is made:"
            there = "" if "/" in name else f": the figures are {', '.join(scenes)}"
            raise MisuseError(f"no {what} {name}{hint(name, known) or there}")
        others += sorted(files & set(results))
    return sets, others
