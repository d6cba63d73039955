"""The part of the paper, Figures 2 to 8. pipeline.renew writes workflow/rules/paper.smk from it."""

from functools import partial

from pipeline.declaration import Part, SceneSet, Stage

_DYNAMICS = "pseudorigid.dynamics"
# A job reads the workflow, compiles once and computes: at most 400 MB and 20 s of processor time.
_stage = partial(Stage, mem_mb=500, runtime=10)
PART = Part(
    stages={
        "orbits": _stage(f"{_DYNAMICS}.orbits.scene_orbits", "starts impacts", follows=True),
        "periodic": _stage(f"{_DYNAMICS}.periodic.symmetric_orbits", "period"),
        "motion": _stage(
            f"{_DYNAMICS}.motion.scene_motion", "period type duration", ("periodic",), follows=True
        ),
        "manifolds": _stage(
            f"{_DYNAMICS}.manifolds.scene_manifolds",
            "period type branches point window length resolution",
            ("periodic",),
            follows=True,
        ),
        "lyapunov": _stage(
            f"{_DYNAMICS}.lyapunov.scene_exponents", "starts impacts records", follows=True
        ),
    },
    sets={"paper": SceneSet("paper_figures", "./reproduce", "The paper's figures", key="scenes")},
)
