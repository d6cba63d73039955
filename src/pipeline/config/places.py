"""What each scene needs computed, and where data and figures are, from the project's root."""

import json

from pseudorigid.sweep import grid

from ..records import sources
from .checking.variants import PAPER
from .declared.kinds import KINDS
from .declared.stages import STAGES, behind

# Where the figures of a set of scenes are published; those of variants are not.
PUBLISHED = {
    PAPER: "paper_figures",
    "claims": "more_figures/claims",
    "proofs": "more_figures/proofs",
}
SHOWN = ("png", "svg")  # formats that are published; pdf stays in results
ATLAS = "more_figures/atlas"
ATLAS_FORMATS = ("png", "svg")


def stages(block: dict) -> dict[str, dict]:
    """Stage -> the smallest block that decides its data, for one scene of a checked config."""
    found = {}
    for name in behind(KINDS[block["picture"]].stages):
        stage = STAGES[name]
        fields = ("ball", "energy", *stage.fields, *(("method",) if stage.follows else ()))
        found[name] = {field: block[field] for field in fields if field in block}
    return found


def drawing(block: dict) -> dict:
    """What decides how a scene is drawn."""
    return {key: value for key, value in block.items() if key != "formats"}


def served(variants: dict[str, dict]) -> dict[tuple[str, str, str], str]:
    """(variant, scene, stage) -> the artifact: that of the first with the same parameters."""
    first, serves = {}, {}
    for variant, scenes in variants.items():
        for scene, block in scenes.items():
            for stage, parameters in stages(block).items():
                key = stage, json.dumps(parameters, sort_keys=True)
                path = first.setdefault(key, artifact(stage, scene, variant))
                serves[variant, scene, stage] = path
    return serves


def stage_code(stage: str) -> list[str]:
    """The project's files that make the data of a stage."""
    return sources.code("stage.py", STAGES[stage].module)


def drawing_code(kind: str) -> list[str]:
    """The project's files that draw a kind of picture."""
    return sources.code("draw.py", f"pseudorigid.figures.kinds.{kind}")


def artifact(stage: str, scene: str, variant: str = PAPER) -> str:
    """Where the data of a stage are, from the project's root."""
    return f"results/{variant}/{stage}_{scene}.nc"


def drawn(scene: str, extension: str, variant: str = PAPER) -> str:
    """Where a figure is drawn."""
    return f"results/{variant}/figures/{scene}.{extension}"


def shown(scene: str, extension: str, variant: str = PAPER) -> str:
    """Where users look for the figure: in paper_figures/, or in results if it is not published."""
    if variant in PUBLISHED and extension in SHOWN:
        return f"{PUBLISHED[variant]}/{scene}.{extension}"
    return drawn(scene, extension, variant)


def figures(variants: dict[str, dict], variant: str = PAPER) -> dict[str, tuple[str, list[str]]]:
    """Each figure, where users look for it -> its scene, its data files and last its drawing."""
    serves = served(variants)
    return {
        shown(name, extension, variant): (
            name,
            [serves[variant, name, stage] for stage in stages(block)]
            + [drawn(name, extension, variant)],
        )
        for name, block in variants[variant].items()
        for extension in block["formats"]
    }


def wanted_orbits(scenes: dict[str, dict]) -> dict[str, str]:
    """Scene -> the type of the periodic orbit that it cannot do without."""
    return {name: block["type"] for name, block in scenes.items() if "type" in block}


def absent_file(variant: str) -> str:
    """Where it says which figures of a variant cannot exist: JSON, scene -> reason."""
    return f"results/{variant}/absent.json"


# ---- sweeps ----


def block_files(name, sweep) -> list[str]:
    """Where its blocks are kept, in the order of their cells."""
    return [f"results/sweep/{name}_{i:04d}.nc" for i in range(len(grid.ranges(sweep)))]


def sweep_dataset(name) -> str:
    """Where the whole sweep is."""
    return f"results/sweep/{name}.nc"


def sweep_pictures(name) -> list[str]:
    """Where its pictures are drawn."""
    return [f"results/sweep/figures/{name}.{extension}" for extension in ATLAS_FORMATS]


def atlas_published(drawing) -> str:
    """Where users look for a picture of a sweep."""
    return f"{ATLAS}/{drawing.rpartition('/')[2]}"
