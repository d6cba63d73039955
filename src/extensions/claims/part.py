"""What the verdicts on the paper's statements add to the pipeline."""

from pipeline.declaration import Part, SceneSet, SnakemakeCommand, Stage

_ANALYSES = "extensions.claims.analyses"
PART = Part(
    needs=("paper", "proofs", "atlas", "families"),
    stages={
        "spread": Stage(
            f"{_ANALYSES}.spread.spread",
            "orbits length blocks regular regular_impacts cells visits",
        ),
        "clusters": Stage(
            f"{_ANALYSES}.clusters.clusters", "orbits impacts cuts lags resamples seed"
        ),
        "rotation": Stage(
            f"{_ANALYSES}.rotation.rotation", "energies starts impacts detail detail_impacts"
        ),
        "jumps": Stage(f"{_ANALYSES}.jumps.jumps", "energies sides"),
        "flux": Stage(f"{_ANALYSES}.flux.flux", "period distance orbits impacts"),
        "exclusion": Stage(f"{_ANALYSES}.exclusion.exclusion", "grid followed"),
        "control": Stage(
            f"{_ANALYSES}.control.control",
            "strengths orbits impacts starts shown drawn",
        ),
        "last_curve": Stage(  # computed by the atlas, drawn here
            "extensions.atlas.last_curve.last_curve", "nobles convergents between drawn"
        ),
    },
    sets={
        "claims": SceneSet(
            folder="more_figures/claims",
            command="./reproduce claims",
            heading="Statements of the paper",
            key="claims",
            texts=("CLAIMS.md", "CLAIMS.json"),
        )
    },
    commands={
        "claims": SnakemakeCommand(
            "check every statement of the paper: CLAIMS.md, more_figures/claims/",
            module="extensions.claims.command",
            details="Makes missing results first, including the sweeps of the atlas.",
        ),
    },
    committed="extensions.claims.ledger.bar.committed",
    seconds={
        "results/claims/spread_spread.nc": 90,
        "results/claims/rotation_rotation.nc": 8,
        "results/claims/control_control.nc": 8,
        "results/claims/flux_flux.nc": 6,
        "results/claims/clusters_clusters.nc": 25,
        "results/claims/exclusion_exclusion.nc": 15,
        "results/claims/exclusion_exclusion_low.nc": 40,
    },
)
