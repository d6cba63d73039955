"""The output and the files of a run."""

import re

FIG3 = {
    "results/paper/periodic_fig3.nc",
    "results/paper/motion_fig3.nc",
    "results/paper/figures/fig3.png",
}
# Variants of the small scenes 3, 4 and 7; at the energy of `low`, Figure 4's orbit does not exist.
VARIANTS = {"low": {"energy": 0.0017}, "doubled": {"scale": 2}}


def rows(output):
    """File -> recomputed, current or published again, from the tables at the end of a run."""
    states, folder = {}, ""
    row = r"(\S+) +((?:\w{3} +[\d,]+ kB +)+)(recomputed|current|published again)\b"
    for line in output.splitlines():
        folder = line if re.fullmatch(r"\S+/", line) else folder
        if match := re.match(row, line):
            name, files, state = match.groups()
            formats = re.findall(r"(\w{3}) +[\d,]+ kB", files)
            states |= {f"{folder}{name}.{suffix}": state for suffix in formats}
    return states


def contents(tree):
    """Name -> bytes of each published file."""
    return {name: content for name, (content, _, _) in tree.published().items()}
