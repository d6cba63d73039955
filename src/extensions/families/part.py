"""What the families of periodic orbits add to the pipeline."""

from pipeline.declaration import Part, SceneSet, SnakemakeCommand, Stage

PART = Part(
    needs=("atlas",),
    stages={
        "families": Stage("extensions.families.dataset.families", "parameter span period levels"),
        "shares": Stage(
            "extensions.families.shares.shares",
            "parameter span step starts impacts",
            inputs=("families",),
        ),
        "chains": Stage("extensions.families.chains.chains", "k energy chains"),
    },
    sets={
        "families": SceneSet(
            "more_figures/families",
            "./reproduce families",
            "Families of periodic orbits",
            key="families",
        )
    },
    commands={
        "families": SnakemakeCommand(
            "follow periodic orbits from birth to end: more_figures/families/",
            details="Takes minutes; a killed search continues.",
        ),
    },
)
