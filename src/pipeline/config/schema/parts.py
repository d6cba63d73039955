"""What parts declare: stages, sets of scenes, and blocks of config.yaml, among them methods."""

from collections.abc import Iterable

from ...declaration import SceneSet, Stage, files, parts
from .fields import Block, declared_in

STAGES: dict[str, Stage] = {}
SETS: dict[str, SceneSet] = {}  # by their folders in results/
for _part in parts().values():
    STAGES |= _part.stages
    SETS |= _part.sets
# The set whose scenes are those of the key `scenes`, which ./reproduce makes and variants change.
MAIN = next(name for name, each in SETS.items() if each.key == "scenes")
PUBLISHED = {name: each.folder for name, each in SETS.items() if each.folder}
SETTINGS: dict[str, type[Block]] = {}  # by keys of config.yaml, or of a scene's `method`
for _package in files("settings.py"):
    SETTINGS |= declared_in(f"{_package}.settings")
METHODS = {key: each for key, each in SETTINGS.items() if hasattr(each, "computes")}
BLOCKS = {key: each for key, each in SETTINGS.items() if key not in METHODS}


def upstream(stages: Iterable[str]) -> list[str]:
    """Return these stages and those whose datasets they take, each after its inputs."""
    ordered: dict[str, None] = {}
    for stage in stages:
        ordered |= dict.fromkeys((*upstream(STAGES[stage].inputs), stage))
    return list(ordered)
