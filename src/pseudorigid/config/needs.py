"""What each scene needs computed, and where data and figures are."""

import json

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
SHOWN = ("png", "svg")  # formats that are published; pdf stays in results


def stages(block: dict) -> dict[str, dict]:
    """Stage -> the smallest block that decides its data, for one scene of a checked config."""
    return {
        stage: {field: block[field] for field in ("ball", "energy", *fields)}
        for stage, fields in STAGES[block["picture"]].items()
    }


def drawing(block: dict) -> dict:
    """What decides how a scene is drawn."""
    return {key: value for key, value in block.items() if key != "formats"}


def owners(scenes: dict[str, dict]) -> dict[tuple[str, str], str]:
    """(scene, stage) -> the scene whose artifact serves it: the first with the same parameters."""
    first, serves = {}, {}
    for name, block in scenes.items():
        for stage, parameters in stages(block).items():
            key = stage, json.dumps(parameters, sort_keys=True)
            serves[name, stage] = first.setdefault(key, name)
    return serves


def artifact(stage: str, owner: str, variant: str = "paper") -> str:
    """Where the data of a stage are, from the project's root."""
    return f"results/{variant}/{stage}_{owner}.nc"


def drawn(scene: str, extension: str, variant: str = "paper") -> str:
    """Where a figure is drawn."""
    return f"results/{variant}/figures/{scene}.{extension}"


def shown(scene: str, extension: str) -> str:
    """Where users look for the figure: in paper_figures/, or in results if it is not published."""
    return f"paper_figures/{scene}.{extension}" if extension in SHOWN else drawn(scene, extension)


def figures(scenes: dict[str, dict]) -> dict[str, tuple[str, list[str]]]:
    """Each figure, where users look for it -> its scene, its data files and last its drawing."""
    serves = owners(scenes)
    return {
        shown(name, extension): (
            name,
            [artifact(stage, serves[name, stage]) for stage in STAGES[block["picture"]]]
            + [drawn(name, extension)],
        )
        for name, block in scenes.items()
        for extension in block["formats"]
    }
