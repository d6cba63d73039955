"""The stages and the sets of scenes that parts declare."""

from collections.abc import Iterable

from ...declaration import SceneSet, Stage, parts

STAGES: dict[str, Stage] = {}
SETS: dict[str, SceneSet] = {}  # by their folders in results/
for _part in parts().values():
    STAGES |= _part.stages
    SETS |= _part.sets
# The set whose scenes are those of the key `scenes`, which ./reproduce makes and variants change.
MAIN = next(name for name, each in SETS.items() if each.key == "scenes")
PUBLISHED = {name: each.folder for name, each in SETS.items() if each.folder}


def upstream(stages: Iterable[str]) -> list[str]:
    """Return these stages and those whose datasets they take, each after its inputs."""
    ordered: dict[str, None] = {}
    for stage in stages:
        ordered |= dict.fromkeys((*upstream(STAGES[stage].inputs), stage))
    return list(ordered)
