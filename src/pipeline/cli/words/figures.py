"""./reproduce and ./reproduce FILE ...: the paper's figures, or some files, made by snakemake."""

from ... import config
from ...config import expected
from ...config.checking.reading import load
from ...records.sources import ROOT
from .. import figures, running
from ..folder import locked


def run(word, arguments, start) -> int:
    """Make every figure, or the files named; further words and options go to snakemake."""
    running.refuse_settings(arguments)
    checked = load(ROOT / "config.yaml")
    published = config.figures(checked["variants"])
    targets = running.options_of(arguments).targets if arguments else []
    rest = [a for a in arguments if a not in targets]
    named = [target for target in targets if target in published]
    results = expected.of_variants(checked["variants"])
    others = [target for target in targets if target in results]
    with locked():
        if len(named) + len(others) < len(targets):  # rules, or files that snakemake may know
            return running.run(targets, [], rest)
        return figures.make(checked, config.PAPER, rest, named if targets else None, others)
