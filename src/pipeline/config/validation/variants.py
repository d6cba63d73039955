"""Variants: the paper's document with some of its values replaced.

What a variant says of all scenes (its `ball`, laid over each scene's; its `energy`; its `method`)
replaces what they say themselves; what it says of one scene, under `scenes`, is laid over that.
Mappings merge, numbers, texts and lists replace. Its `scale` L changes the unit of length at the
very end: g is multiplied by L, energies by L^2, and the ball's radius is L; bounds are those of the
numbers before.
"""

import math

from ..schema.kinds import KINDS
from ..schema.scene import exact
from ..schema.variant import Variant
from .mistakes import mistakes
from .scenes import checked
from .words import dotted, refusal, unknown

PAPER = "paper"
# Folders in results/ and words that a variant's name must leave alone.
RESERVED = (PAPER, "claims", "proofs", "study", "sweep", "sweeps", "atlas", "compare")
RESERVED += ("report", "archive")
_FOR_ALL = ("ball", "energy", "method")


def derive(document, name, given):
    """(scenes, its mistakes) of the variant `name` of a correct document."""
    place = ("variants", name)
    if name in RESERVED:
        return None, [refusal(place[:-1], name, f"a name other than {', '.join(RESERVED)}")]
    lines = mistakes(Variant, given, place)
    changes = {} if lines else given.get("scenes", {})
    for scene, change in changes.items():
        lines += _change_mistakes(document["scenes"], scene, change, (*place, "scenes", scene))
    if not lines and not given:
        lines = [refusal(place, given, Variant.__doc__)]
    if lines:
        return None, lines
    scenes = {}
    for scene, block in document["scenes"].items():
        change = changes.get(scene, {})
        after = _derived({"ball": document["ball"]} | block, given, change)
        said = {key: (*place, key) for key in _FOR_ALL if key in given and key not in change}
        if "ball" not in change:
            said["ball"] = (*place, "ball")
        scenes[scene], wrong = checked(after, after["ball"], (*place, "scenes", scene), said)
        lines += wrong
    scale = given.get("scale", 1)
    if lines or scale == 1:
        return scenes, lines
    return {scene: scaled(block, scale) for scene, block in scenes.items()}, []


def _derived(block, variant, change):
    """A scene's block, ball included, with what a variant says of all scenes and of this one."""
    given = {key: variant[key] for key in _FOR_ALL if key in variant}
    if "method" in variant:  # one method instead of another
        block = {key: value for key, value in block.items() if key != "method"}
    after = merged(merged(block, given), change)
    kind = KINDS[block["picture"]]
    framing = ("ball", "energy", *kind.axes_depend_on)
    moved = variant.get("scale", 1) != 1 or any(block.get(f) != after.get(f) for f in framing)
    if moved and "axes" not in change:
        after.pop("axes", None)
    elif moved:
        after["axes"] = change["axes"]
    return after


def _change_mistakes(scenes, scene, change, place):
    if scene not in scenes:
        return [f"{dotted(place)}: {unknown('scene', scene, list(scenes))}"]
    if not isinstance(change, dict):
        return [refusal(place, change, "a mapping with fields of the scene")]
    picture = scenes[scene]["picture"]
    if change.get("picture", picture) != picture:
        what = f"{picture}, which a variant does not change"
        return [refusal((*place, "picture"), change["picture"], what)]
    return []


def merged(old, new):
    """`new` laid over `old`: mappings key by key, anything else in its place."""
    if not (isinstance(old, dict) and isinstance(new, dict)):
        return new
    return old | {key: merged(old.get(key), value) for key, value in new.items()}


def scaled(block, scale):
    """A complete block in another unit of length."""
    ball = block["ball"] | {"g": _product(block["ball"]["g"], scale)}
    block = block | {"ball": ball, "energy": _product(block["energy"], scale, scale)}
    for name in {"energies", "marks"} & block.keys():
        block[name] = [_product(energy, scale, scale) for energy in block[name]]
    if isinstance(block.get("starts"), list):
        block["starts"] = [
            {key: _product(value, scale) for key, value in start.items()}
            if isinstance(start, dict)
            else start
            for start in block["starts"]
        ]
    return block


def _product(*factors):
    """Of the decimals as written: 3 times 0.01 is 0.03."""
    return float(math.prod(map(exact, factors)))
