"""What each scene needs computed, and where data and figures are."""

import json

from .variants import PAPER

# What each kind of picture is drawn from: stage -> the fields of the scene that decide its data.
STAGES = {
    "portrait": {"orbits": ("starts", "impacts")},
    "motion": {"periodic": ("period",), "motion": ("period", "type", "duration")},
    "tangle": {
        "orbits": ("starts", "impacts"),
        "periodic": ("period",),
        "manifolds": ("period", "type", "branches", "resolution"),
    },
    "closeup": {
        "periodic": ("period",),
        "manifolds": ("period", "type", "point", "window", "resolution", "length"),
    },
    "exponents": {"lyapunov": ("starts", "impacts", "records")},
}
# The stages that follow orbits: a scene's `method`, where it has one, decides their data too.
FOLLOWING = ("orbits", "motion", "manifolds", "lyapunov")
SHOWN = ("png", "svg")  # formats that are published; pdf stays in results


def stages(block: dict) -> dict[str, dict]:
    """Stage -> the smallest block that decides its data, for one scene of a checked config."""
    method = {"method": block["method"]} if "method" in block else {}
    return {
        stage: {field: block[field] for field in ("ball", "energy", *fields)}
        | (method if stage in FOLLOWING else {})
        for stage, fields in STAGES[block["picture"]].items()
    }


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


def artifact(stage: str, scene: str, variant: str = PAPER) -> str:
    """Where the data of a stage are, from the project's root."""
    return f"results/{variant}/{stage}_{scene}.nc"


def drawn(scene: str, extension: str, variant: str = PAPER) -> str:
    """Where a figure is drawn."""
    return f"results/{variant}/figures/{scene}.{extension}"


def shown(scene: str, extension: str, variant: str = PAPER) -> str:
    """Where users look for the figure: in paper_figures/, or in results if it is not published."""
    published = variant == PAPER and extension in SHOWN
    return f"paper_figures/{scene}.{extension}" if published else drawn(scene, extension, variant)


def figures(variants: dict[str, dict], variant: str = PAPER) -> dict[str, tuple[str, list[str]]]:
    """Each figure, where users look for it -> its scene, its data files and last its drawing."""
    serves = served(variants)
    return {
        shown(name, extension, variant): (
            name,
            [serves[variant, name, stage] for stage in STAGES[block["picture"]]]
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
