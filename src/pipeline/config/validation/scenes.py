"""Validation of scenes, and of variants: the paper's scenes with some values replaced.

The values that a variant gives for all scenes (ball, energy, method) replace those of the scenes.
The fields that it gives for one scene are merged into the result. Its `scale` L is applied at the
end: g is multiplied by L and energies by L^2; bounds are checked before that.
"""

import math
from collections.abc import Mapping
from typing import Any

from ..schema.fields import YamlMapping
from ..schema.kinds import KINDS
from ..schema.published import FOLDERS
from ..schema.scene import exact
from .mistakes import complete, has_types, mistakes
from .words import Place, dotted, refusal, unknown

# Names that a variant may not have: folders in results/, and commands.
RESERVED = (*FOLDERS, "sweeps", "atlas", "compare", "report", "archive")
_OF_ALL_SCENES = ("ball", "energy", "method")


def checked(
    given: object,
    ball: YamlMapping | None,
    place: Place,
    origins: Mapping[int | str, Place] | None = None,
) -> tuple[YamlMapping, list[str]]:
    """Return a scene's complete block and a line for each mistake; with mistakes the block is {}.

    `ball` is the ball of a scene without one, or None if it has mistakes itself. `origins` maps
    fields that were written elsewhere to the places where their mistakes should be reported.
    """
    if not isinstance(given, dict):
        return {}, [refusal(place, given, "a mapping that begins with picture")]
    words, picture = f"one of {', '.join(KINDS)}", (*place, "picture")
    if "picture" not in given:
        return {}, [f"{dotted(picture)}: missing: expected {words}"]
    if not isinstance(given["picture"], str) or given["picture"] not in KINDS:
        return {}, [refusal(picture, given["picture"], words)]
    kind = KINDS[given["picture"]]
    lines = mistakes(kind, given, place)
    if ball is None or (lines and not has_types(kind, given)):
        return {}, lines
    block = complete(kind, {"ball": ball} | given)
    places = ({} if "ball" in given else {"ball": ("ball",)}) | dict(origins or {})
    for (field, *inner), value, allowed in kind.cross_field_errors(block):
        lines.append(refusal((*places.get(field, (*place, field)), *inner), value, allowed))
    return ({}, lines) if lines else (block, [])


def derive(document: YamlMapping, name: str, given: YamlMapping) -> tuple[YamlMapping, list[str]]:
    """Return the scenes of a variant, and a line for each mistake between fields."""
    place = ("variants", name)
    if name in RESERVED:
        return {}, [refusal(place[:-1], name, f"a name other than {', '.join(RESERVED)}")]
    lines: list[str] = []
    changes = given.get("scenes", {})
    for scene, change in changes.items():
        lines += _change_mistakes(document["scenes"], scene, change, (*place, "scenes", scene))
    if lines:
        return {}, lines
    scenes = {}
    for scene, block in document["scenes"].items():
        change = changes.get(scene, {})
        derived = _derived({"ball": document["ball"]} | block, given, change)
        replaced = {"ball"} | (given.keys() & set(_OF_ALL_SCENES))
        origins = {key: (*place, key) for key in replaced - change.keys()}
        where = (*place, "scenes", scene)
        scenes[scene], mistaken = checked(derived, derived["ball"], where, origins)
        lines += mistaken
    scale = given.get("scale", 1)
    if lines or scale == 1:
        return scenes, lines
    return {scene: _scaled(block, scale) for scene, block in scenes.items()}, []


def _derived(block: YamlMapping, variant: YamlMapping, change: YamlMapping) -> YamlMapping:
    """Merge a variant's values into a scene's block, which includes its ball."""
    replaced = {key: variant[key] for key in _OF_ALL_SCENES if key in variant}
    if "method" in variant:  # methods are replaced as a whole
        block = {key: value for key, value in block.items() if key != "method"}
    derived: YamlMapping = _merged(_merged(block, replaced), change)
    kind = KINDS[block["picture"]]
    framing = ("ball", "energy", *kind.axes_depend_on, *kind.along.values())
    moved = variant.get("scale", 1) != 1 or any(block.get(f) != derived.get(f) for f in framing)
    if moved:
        derived.pop("axes", None)
    return derived | ({"axes": change["axes"]} if moved and "axes" in change else {})


def _change_mistakes(
    scenes: YamlMapping, scene: str, change: YamlMapping, place: Place
) -> list[str]:
    if scene not in scenes:
        return [f"{dotted(place)}: {unknown('scene', scene, list(scenes))}"]
    picture = scenes[scene]["picture"]
    if change.get("picture", picture) != picture:
        words = f"{picture}, which a variant does not change"
        return [refusal((*place, "picture"), change["picture"], words)]
    return []


def _merged(old: Any, new: Any) -> Any:
    """Merge mappings key by key; replace anything else."""
    if not (isinstance(old, dict) and isinstance(new, dict)):
        return new
    return old | {key: _merged(old.get(key), value) for key, value in new.items()}


def _scaled(block: YamlMapping, scale: float) -> YamlMapping:
    """Express a complete block in another unit of length."""
    ball = block["ball"] | {"g": _times(block["ball"]["g"], scale)}
    block = block | {"ball": ball}
    energies = {"energy", "energies", "marks"}
    if block.get("parameter") == "energy":  # what families are followed against
        energies |= {"span", "step"}
    for name in energies & block.keys():
        block[name] = _times(block[name], scale, scale)
    if isinstance(block.get("starts"), list):  # fractions of the section stay
        starts = block["starts"]
        block["starts"] = [_times(s, scale) if isinstance(s, dict) else s for s in starts]
    return block


def _times(values: Any, *factors: float) -> Any:
    """Multiply decimals as written and round once, so that 3 times 0.01 gives 0.03."""
    if isinstance(values, list):
        return [_times(value, *factors) for value in values]
    if isinstance(values, dict):
        return {key: _times(value, *factors) for key, value in values.items()}
    return float(math.prod(map(exact, (values, *factors))))
