"""What the proofs add to the pipeline."""

from pipeline.declaration import Part, SceneSet, SnakemakeCommand, Stage

CERTIFICATES = "src/extensions/proofs/certificates"
_SCENES, _ALL = "extensions.proofs.theorems.scenes", f"{CERTIFICATES}/*.toml"
PART = Part(
    needs=("paper",),
    stages={
        "horseshoe": Stage(
            f"{_SCENES}.scene_horseshoe", "period type connection", ("periodic",), reads=_ALL
        ),
        "twist": Stage(f"{_SCENES}.scene_twist", "energies", reads=_ALL),
        "curves": Stage(f"{_SCENES}.scene_curves", "rotation_numbers", reads=_ALL),
        "graph": Stage(f"{_SCENES}.scene_graph", reads=_ALL),
        "escape": Stage("extensions.proofs.escape.escape", "beside distance orbits impacts"),
        "theorem": Stage(
            "extensions.proofs.theorems.statements.theorem_verdict",
            "theorem",
            reads=f"{CERTIFICATES}/{{theorem}}.toml",
        ),
        "derivations": Stage("extensions.proofs.derivations.derivations"),
    },
    sets={
        "proofs": SceneSet(
            "more_figures/proofs", "./reproduce prove --pictures", "Theorems", key="proofs"
        ),
        "theorems": SceneSet("", "./reproduce prove", scenes="extensions.proofs.kinds.theorems"),
    },
    commands={
        "prove": SnakemakeCommand(
            "check the theorems from their certificates",
            {
                "theorem": "theorems; without a name, all",
                "--again": "check them all, also those that did not change",
                "--search": "search for new certificates first",
                "--impacts": "prove the impacts behind the figures instead",
                "--pictures": "draw the pictures, in more_figures/proofs/",
            },
            module="extensions.proofs.command",
            packages="algebra",
            details="Checks what changed since it was checked here, and prints a line for each "
            "theorem. The exit status is 1 if one is not proved.",
        ),
    },
    seconds={
        "results/theorems/theorem_entropy.nc": 16,
        "results/theorems/theorem_curve-six.nc": 10,
        "results/theorems/theorem_curve-fixed-point-outer.nc": 5,
        "results/theorems/theorem_twist-one-zero.nc": 4,
        "results/theorems/theorem_curve-fixed-point-low.nc": 3,
        "results/theorems/derivations_derivations.nc": 3,
    },
)
