"""What the study consists of: data, which of them are the same everywhere, and charts."""

from .kinds import KINDS

# Data whose bytes are part of the contract, and measurements.
FIXED = ("work", "edges", "orbits", "needs", "verdicts")
MEASURED = ("work_all", "edges_all", "missed_all")
# Beside these no other job runs: `verdicts` uses all cores, and `work_all` measures seconds.
ALONE = ("verdicts", "work_all")
SIDE_BY_SIDE = tuple(part for part in (*FIXED, *MEASURED) if part not in ALONE)
# chart -> (its data, the function of figures.study, further arguments)
CHARTS = {
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
FOLDER = "more_figures/study"


def data(part):
    """Where the data of a part are, from the project's root."""
    return f"results/study/{part}.nc"


def drawn(chart):
    """Where a chart is drawn."""
    return f"results/study/figures/{chart}.png"


def published(chart):
    """Where users look for it."""
    return f"{FOLDER}/{chart}.png"


def block(part, scenes):
    """What decides the data of a part: for `needs` the scenes and the measure of error of each.

    Those with a measure, and whose picture has a known size: they give their axes.
    """
    if part != "needs":
        return {"part": part}
    measures = {name: KINDS[block["picture"]].studied for name, block in scenes.items()}
    measures = {name: found for name, found in measures.items() if found and "axes" in scenes[name]}
    chosen = {name: scenes[name] for name in measures}
    return {"part": part, "scenes": chosen, "measures": measures}


def artifacts(part, scenes, artifact_paths):
    """The figures' own artifacts that a part compares with: (stage, scene, file)."""
    looked = block(part, scenes).get("scenes", ())
    return [
        (stage, scene, file)
        for (variant, scene, stage), file in artifact_paths.items()
        if variant == "paper" and scene in looked and stage in ("periodic", "manifolds")
    ]


def modules(part):
    """The modules that a part imports by name, the libraries' rivals where they are measured."""
    own = ("verdicts",) if part == "verdicts" else ()
    rivals = ("methods.scipy_events", "methods.taylor") if part in MEASURED else ()
    return [f"pseudorigid.study.{name}" for name in own + rivals]


def drawing(chart):
    """What decides how a chart is drawn."""
    _, function, arguments = CHARTS[chart]
    return {"chart": function, "arguments": list(arguments)}
