"""What a run says and leaves, for the tests of runs."""

import re

FIG3 = {
    "results/paper/periodic_fig3.nc",
    "results/paper/motion_fig3.nc",
    "results/paper/figures/fig3.png",
}
FIG7 = {f"results/paper/figures/fig7.{extension}" for extension in ("png", "svg")}


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
