"""The commands of extensions: their arguments, and the reports of mistakes."""

import pytest

from helpers.commands import mistake
from pipeline.cli import arguments
from pipeline.declaration import parts

# Extension -> mistaken command -> the line about it.
MISTAKES = {
    "atlas": {
        "sweep plan": ": no sweep plan: did you mean plane?",
        "sweep --slrum": " sweep: no argument --slrum: did you mean --slurm?",
        "fig3 --slurm": ": no argument --slurm: sweep has it",
    },
    "proofs": {
        "prove horsshoe-outer": ": no theorem horsshoe-outer: did you mean horseshoe-outer?",
        "prove --impact": " prove: no argument --impact: did you mean --impacts?",
    },
    "publication": {"article --against": " article: no argument --against: verify has it"},
}


@pytest.mark.parametrize(
    ("line", "words"),
    [each for name, lines in MISTAKES.items() if name in parts() for each in lines.items()],
)
def test_a_mistake_is_one_line_with_the_nearest_name(capsys, line, words):
    assert mistake(capsys, line) == words


@pytest.mark.skipif("atlas" not in parts(), reason="no sweeps here")
def test_names_and_flags_may_be_mixed():
    args = arguments.read(["sweep", "--slurm", "line", "-c2", "small", "--", "-j", "5"])
    assert (args.sweep, args.slurm, args.cores) == (["line", "small"], True, "2")
