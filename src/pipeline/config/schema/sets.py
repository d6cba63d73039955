"""The sets of scenes that parts declare."""

import os

from ...declaration import ONLY_SET, SceneSet, parts

SETS: dict[str, SceneSet] = {}  # by their folders in results/
for _part in parts().values():
    SETS |= _part.sets
# The set whose scenes are those of the key `scenes`, which ./reproduce makes and variants change.
MAIN = next(name for name, each in SETS.items() if each.key == "scenes")
PUBLISHED = {name: each.folder for name, each in SETS.items() if each.folder}


def needs_main_alone() -> bool:
    """Return whether this process needs the main set of scenes alone."""
    return os.environ.get(ONLY_SET) == MAIN
