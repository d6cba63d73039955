"""The part of the paper, Figures 2 to 8. pipeline.renew writes workflow/rules/paper.smk from it."""

from pipeline.declaration import Part, SceneSet, Stage

_DYNAMICS = "pseudorigid.dynamics"
PART = Part(
    stages={
        "orbits": Stage(f"{_DYNAMICS}.orbits.scene_orbits", "starts impacts", follows=True),
        "periodic": Stage(f"{_DYNAMICS}.periodic.symmetric_orbits", "period"),
        "motion": Stage(
            f"{_DYNAMICS}.motion.scene_motion", "period type duration", ("periodic",), follows=True
        ),
        "manifolds": Stage(
            f"{_DYNAMICS}.manifolds.scene_manifolds",
            "period type branches point window length resolution",
            ("periodic",),
            follows=True,
        ),
        "lyapunov": Stage(
            f"{_DYNAMICS}.lyapunov.scene_exponents", "starts impacts records", follows=True
        ),
    },
    sets={"paper": SceneSet("paper_figures", "./reproduce", "The paper's figures", key="scenes")},
)
