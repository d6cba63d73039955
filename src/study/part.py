"""The part of the study: speed and accuracy of the map and of other methods."""

from pipeline.declaration import Command, Part, SceneSet, SnakemakeCommand, Stage

_STAGES = "study.stages"
_RECORDED = "src/study/recorded.json"  # what libraries gave, once
PART = Part(
    needs=("paper",),
    stages={
        "work": Stage(f"{_STAGES}.work", reads=_RECORDED),
        "edges": Stage(f"{_STAGES}.edges", reads=_RECORDED),
        "misses": Stage(f"{_STAGES}.misses", reads=_RECORDED),
        "drift": Stage(f"{_STAGES}.drift"),
        "needs": Stage("study.figure_errors.figure_errors", more="study.compared.with_paper"),
    },
    sets={
        "study": SceneSet(
            "more_figures/study", "./reproduce study", "Accuracy and speed of methods", key="study"
        )
    },
    commands={
        "study": SnakemakeCommand(
            "compare speed and accuracy of methods, in more_figures/study/",
            details="What other packages gave was recorded, so that they are not installed.",
        ),
        "benchmark": Command(
            "measure speeds and print a table of their ratios",
            module="study.bench",
            packages="study",
            details="Installs the packages of the study first (once).",
        ),
    },
    seconds={
        "results/study/needs.nc": 90,
        "results/study/drift.nc": 35,
        "results/study/misses.nc": 40,
    },
)
