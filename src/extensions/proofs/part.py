"""What the proofs add to the pipeline."""

from pipeline.declaration import Part, SceneSet, SnakemakeCommand, Stage, names, switch

CERTIFICATES = "src/extensions/proofs/certificates"
_TRUE_ORBITS = "extensions.proofs.true_orbits.orbit.true_scene_orbits"
_SCENES = "extensions.proofs.theorems.scenes"
PART = Part(
    needs=("paper",),
    stages={
        "horseshoe": Stage(
            f"{_SCENES}.scene_horseshoe", "period type connection", inputs=("periodic",)
        ),
        "twist": Stage(f"{_SCENES}.scene_twist", "energies"),
        "curves": Stage(f"{_SCENES}.scene_curves", "rotation_numbers"),
        "graph": Stage(f"{_SCENES}.scene_graph"),
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
            names("theorem", "theorems; without a name, all"),
            switch("--again", "check them all, also those that did not change"),
            switch("--search", "search for new certificates first"),
            switch("--impacts", "prove the impacts behind the figures instead"),
            switch("--pictures", "draw the pictures, in more_figures/proofs/"),
            module="extensions.proofs.command",
            details="Checks what changed since it was checked here, and prints a line for each "
            "theorem. The exit status is 1 if one is not proved.",
        ),
    },
    settings={"prove": "extensions.proofs.settings.Prove"},
    methods={"exact": ("extensions.proofs.settings.Exact", {"orbits": _TRUE_ORBITS})},
    reads={"src/extensions/proofs/theorems/statements.py": f"{CERTIFICATES}/*.toml"},
    seconds={
        "results/theorems/theorem_entropy.nc": 16,
        "results/theorems/theorem_curve-six.nc": 10,
        "results/theorems/theorem_curve-fixed-point-outer.nc": 5,
        "results/theorems/theorem_twist-one-zero.nc": 4,
        "results/theorems/theorem_curve-fixed-point-low.nc": 3,
        "results/theorems/derivations_derivations.nc": 3,
    },
)
