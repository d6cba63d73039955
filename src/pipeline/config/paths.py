"""What each scene needs computed, and where data and figures are, from the project's root."""

import json

from pseudorigid.sweep import grid

from .schema.kinds import KINDS
from .schema.stages import STAGES, upstream
from .validation.variants import PAPER

# Where the figures of a set of scenes are published; those of variants are not.
PUBLISHED = {
    PAPER: "paper_figures",
    "claims": "more_figures/claims",
    "proofs": "more_figures/proofs",
}
SHOWN = ("png", "svg")  # formats that are published; pdf stays in results
ATLAS = "more_figures/atlas"
LEDGER = "CLAIMS.md"  # the verdicts on the paper's statements
LEDGER_DATA = "CLAIMS.json"  # the data from which CLAIMS.md is rendered
DERIVATIONS = "results/claims/derivations.nc"


def stages(block: dict) -> dict[str, dict]:
    """Stage -> the smallest block that decides its data, for one scene of a checked config."""
    found = {}
    for name in upstream(KINDS[block["picture"]].stages):
        stage = STAGES[name]
        method = ("method",) if stage.takes(block.get("method", {})) else ()
        fields = ("ball", "energy", *stage.fields, *method)
        found[name] = {field: block[field] for field in fields if field in block}
    return found


def drawing(block: dict) -> dict:
    """What decides how a scene is drawn."""
    return {key: value for key, value in block.items() if key != "formats"}


def artifact_paths(variants: dict[str, dict]) -> dict[tuple[str, str, str], str]:
    """The dataset of each stage of each scene: (variant, scene, stage) -> its path.

    A variant shares a scene's dataset with the first variant that gives this scene the same
    parameters. Scenes of other names never share: a scene that is added changes no path.
    """
    first, found_paths = {}, {}
    for variant, scenes in variants.items():
        for scene, block in scenes.items():
            for stage, parameters in stages(block).items():
                key = scene, stage, json.dumps(parameters, sort_keys=True)
                path = first.setdefault(key, f"results/{variant}/{stage}_{scene}.nc")
                found_paths[variant, scene, stage] = path
    return found_paths


def drawn(scene: str, extension: str, variant: str = PAPER) -> str:
    """Where a figure is drawn."""
    return f"results/{variant}/figures/{scene}.{extension}"


def figures(variants: dict[str, dict], variant: str = PAPER) -> dict[str, tuple[str, list[str]]]:
    """Each figure, where users look for it -> its scene, its data files and last its drawing."""
    found_paths = artifact_paths(variants)
    found = {}
    for name, block in variants[variant].items():
        data = [found_paths[variant, name, stage] for stage in stages(block)]
        for extension in block["formats"]:
            made = drawn(name, extension, variant)
            public = variant in PUBLISHED and extension in SHOWN
            path = f"{PUBLISHED[variant]}/{name}.{extension}" if public else made
            found[path] = name, [*data, made]
    return found


# ---- sweeps ----


def block_files(name, sweep) -> list[str]:
    """Where its blocks are kept, in the order of their cells."""
    return [f"results/sweep/{name}_{i:04d}.nc" for i in range(len(grid.ranges(sweep)))]


def sweep_dataset(name) -> str:
    """Where the whole sweep is."""
    return f"results/sweep/{name}.nc"


def sweep_pictures(name, sweep) -> list[str]:
    """Where its pictures are drawn; of a plane, whose cells are many, no vectors."""
    formats = SHOWN if len(sweep["k"]) == 1 else SHOWN[:1]
    return [f"results/sweep/figures/{name}.{extension}" for extension in formats]


def atlas_published(drawing) -> str:
    """Where users look for a picture of a sweep."""
    return f"{ATLAS}/{drawing.rpartition('/')[2]}"
