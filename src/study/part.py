"""The part of the study: speed and accuracy of the map and of other methods."""

from pipeline.declaration import Command, Part, SceneSet, SnakemakeCommand, Stage

_STAGES, _MEASURED = "study.stages", "study.measured"
PART = Part(
    needs=("paper",),
    stages={
        "work": Stage(f"{_STAGES}.work"),
        "edges": Stage(f"{_STAGES}.edges"),
        "drift": Stage(f"{_STAGES}.drift"),
        "needs": Stage("study.figure_errors.figure_errors", main="study.compared.paper_scenes"),
        "work_all": Stage(f"{_MEASURED}.work_all", measured=True, alone=True),
        "edges_all": Stage(f"{_MEASURED}.edges_all", measured=True),
        "missed_all": Stage(f"{_MEASURED}.missed_all", measured=True),
    },
    sets={
        "study": SceneSet(
            "more_figures/study", "./reproduce study", "Accuracy and speed of methods", key="study"
        )
    },
    commands={
        "study": SnakemakeCommand(
            "compare speed and accuracy with other methods, in more_figures/study/",
            scenes="study",
            packages="study",
            details="Installs the packages of the other methods first (once).",
        ),
        "benchmark": Command(
            "measure speeds and print a table of their ratios",
            module="study.benchmark",
            packages="study",
            details="Installs the packages of the study first (once).",
        ),
    },
    seconds={
        "results/study/needs.nc": 90,
        "results/study/work_all.nc": 80,
        "results/study/drift.nc": 35,
        "results/study/edges_all.nc": 20,
    },
)
