"""What a run says and leaves, for the tests of runs."""

import re

FIG3 = {
    "results/paper/periodic_fig3.nc",
    "results/paper/motion_fig3.nc",
    "results/paper/figures/fig3.png",
}
# Of the small scenes 3, 4 and 7; one without Figure 4, at an energy without such an orbit.
VARIANTS = {"low": {"energy": 0.0017}, "doubled": {"scale": 2}}


def rows(said):
    """File -> recomputed or current, from the table at the end of a run."""
    found = re.findall(r"^\S+ +(\S+) +[\d,]+ kB +(recomputed|current)\b", said, re.MULTILINE)
    return dict(found)


def contents(tree):
    """Name -> bytes of what is published."""
    return {name: content for name, (content, _, _) in tree.published().items()}


def last_line(result):
    """The last line of a run, in which there is no traceback."""
    assert "Traceback" not in result.stdout
    return result.stdout.splitlines()[-1]
