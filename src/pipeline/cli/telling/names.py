"""What a result is called: its scene and its stage."""

from pathlib import PurePath

from ...config import places
from ...config.declared.stages import STAGES

OWN = (*places.PUBLISHED, "study", "sweep")  # folders whose names go without saying


def step(result) -> tuple[str, str]:
    """(scene, stage) of a result; the scene of a variant with its name before it."""
    path = PurePath(result)
    folder, name, stage = path.parts[1], path.stem, "data"
    if path.parts[2] == "figures":
        stage = f"drawing {path.suffix[1:]}"
    elif folder == "sweep" and name[-4:].isdigit():
        name, stage = name[:-5], f"block {int(name[-4:])}"
    elif folder not in ("study", "sweep"):
        stage = max((s for s in STAGES if name.startswith(f"{s}_")), key=len, default=stage)
        name = name.removeprefix(f"{stage}_")
    return (name if folder in OWN else f"{folder}/{name}"), stage
