"""The parts of the study: its data, which of them are the same on every machine, and its charts."""

from collections.abc import Mapping

from .fields import YamlMapping
from .published import FOLDERS

# Data that are the same on every machine, and measurements.
FIXED = ("work", "edges", "orbits", "needs", "verdicts")
MEASURED = ("work_all", "edges_all", "missed_all")
# Parts beside which no other job runs: `verdicts` uses all cores, and `work_all` measures seconds.
ALONE = ("verdicts", "work_all")
SIDE_BY_SIDE = tuple(part for part in (*FIXED, *MEASURED) if part not in ALONE)
# chart -> (its data, the function of figures.study, further arguments)
CHARTS: dict[str, tuple[str, str, tuple[object, ...]]] = {
    "work_uniform": ("work", "work", (0, "evaluations")),
    "work_grazing": ("work", "work", (1, "evaluations")),
    "edges": ("edges", "edges", ()),
    "energy": ("orbits", "energy", ()),
    "apart": ("orbits", "separation", ()),
    "needs": ("needs", "figure_errors", ()),
    "verdicts": ("verdicts", "verdicts", ()),
    "work_all_uniform": ("work_all", "work", (0, "evaluations")),
    "work_all_grazing": ("work_all", "work", (1, "evaluations")),
    "seconds_uniform": ("work_all", "work", (0, "seconds")),
    "seconds_grazing": ("work_all", "work", (1, "seconds")),
    "edges_all": ("edges_all", "edges", ()),
}
# Kinds of picture with a measure of error in pseudorigid.study.figure_errors.
STUDIED = ("portrait", "motion", "tangle", "closeup", "exponents")
FOLDER = FOLDERS["study"]
# Functions of a name that return a path from the project's root.
data = "results/study/{}.nc".format  # of a part
FORMATS = ("png", "svg")  # of charts
drawn = "results/study/figures/{}.{}".format  # where a chart is drawn in a format
published = (FOLDER + "/{}.{}").format  # where users find a chart in a format


def block(part: str, scenes: Mapping[str, YamlMapping]) -> YamlMapping:
    """Return what decides the data of a part.

    For `needs` these are the scenes with a measure of error and axes, which fix the picture's size.
    """
    if part != "needs":
        return {"part": part}
    chosen = {
        name: block
        for name, block in scenes.items()
        if block["picture"] in STUDIED and "axes" in block
    }
    measures = {name: block["picture"] for name, block in chosen.items()}
    return {"part": part, "scenes": chosen, "measures": measures}


def drawing(chart: str) -> YamlMapping:
    """Return what decides how a chart is drawn."""
    _, function, arguments = CHARTS[chart]
    return {"chart": function, "arguments": list(arguments)}
