"""The sets of scenes that parts declare."""

from ...declaration import SceneSet, parts

SETS: dict[str, SceneSet] = {}  # by their folders in results/
for _part in parts().values():
    SETS |= _part.sets
# The set whose scenes are those of the key `scenes`, which ./reproduce makes and variants change.
MAIN = next(name for name, each in SETS.items() if each.key == "scenes")
PUBLISHED = {name: each.folder for name, each in SETS.items() if each.folder}
