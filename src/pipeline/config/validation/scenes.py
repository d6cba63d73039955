"""Validation of scenes, and of variants: the paper's scenes with some values replaced.

The values that a variant gives for all scenes (ball, energy, method) replace those of the scenes.
The fields that it gives for one scene are merged into the result. A scene that cannot have the
values is left out. The variant's `scale` L is applied at the end: g is multiplied by L and energies
by L^2; bounds are checked before that.
"""

import math
import re
from collections.abc import Mapping
from typing import Any

from ...declaration import extensions
from ..schema.fields import YamlMapping
from ..schema.kinds import KINDS
from ..schema.scene import CompletionError, Picture, exact
from ..schema.sets import SETS
from .mistakes import complete, has_types, mistakes
from .words import Place, dotted, refusal, unknown

_OF_ALL_SCENES = ("ball", "energy", "method")


def reserved_names() -> list[str]:
    """Return the names that a variant may not have: of other folders in results/."""
    patterns = [p for extension in extensions().values() for p in extension.generated]
    folders = [p.partition("/")[0] for p in patterns if re.match(r"[\w-]+/", p)]
    return [*dict.fromkeys([*SETS, "compare", "report", *folders])]


def checked(
    given: object,
    ball: YamlMapping | None,
    place: Place,
    others: Mapping[str, Any],
) -> tuple[YamlMapping, list[str]]:
    """Return a scene's complete block and a line for each mistake; with mistakes the block is {}.

    `ball` is the ball of a scene without one, or None if it has mistakes itself. `others` are the
    scenes of its set, over one of which it may be drawn.
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
    of_ball = "ball" in kind.model_fields
    if (ball is None and of_ball) or (lines and not has_types(kind, given)):
        return {}, lines
    try:
        below = _below(kind, given, others) if kind.drawn_over else {}
        block = kind.completed(below | complete(kind, ({"ball": ball} if of_ball else {}) | given))
    except CompletionError as error:
        return {}, [refusal((*place, *error.place), error.value, error.allowed)]
    for where, value, allowed in kind.cross_field_errors(block):
        lines.append(refusal((*place, *where), value, allowed))
    return ({}, lines) if lines else (block, [])


def of_kind(block: object, kind: str) -> object:
    """Return a scene that is of this kind if it does not say otherwise."""
    return {"picture": kind} | block if isinstance(block, dict) else block


def _below(kind: type[Picture], given: YamlMapping, others: Mapping[str, Any]) -> YamlMapping:
    """Return the complete block of the scene over which another one is drawn."""
    below, over = others.get(given["over"]), KINDS[kind.drawn_over]
    if not isinstance(below, dict) or below.get("picture") != kind.drawn_over:
        raise CompletionError(("over",), given["over"], f"a scene of kind {kind.drawn_over}")
    if mistakes(over, below, ()):
        raise CompletionError(("over",), given["over"], "a scene without mistakes")
    return over.completed(complete(over, below))


def derive(
    document: YamlMapping, name: str, given: YamlMapping
) -> tuple[YamlMapping, dict[str, str], list[str]]:
    """Return the scenes of a variant, why others are left out, and a line for each mistake.

    A scene is left out if the values that the variant gives for all scenes do not suit it. It is a
    mistake if they suit no scene, or if what the variant gives for the scene itself is wrong.
    """
    place = ("variants", name)
    if name in (reserved := reserved_names()):
        return {}, {}, [refusal(place[:-1], name, f"a name other than {', '.join(reserved)}")]
    lines: list[str] = []
    changes = given.get("scenes", {})
    for scene, change in changes.items():
        lines += _change_mistakes(document["scenes"], scene, change, (*place, "scenes", scene))
    if lines:
        return {}, {}, lines
    scenes, left_out = {}, {}
    mistaken: dict[str, list[str]] = {}  # line -> the scenes that the value does not suit
    unsuitable: dict[str, list[str]] = {}
    for scene, given_block in document["scenes"].items():
        change, where = changes.get(scene, {}), (*place, "scenes", scene)
        block = {"ball": document["ball"]} | given_block
        derived = _derived(block, given, change)
        kind = KINDS[derived["picture"]]
        wrong = mistakes(kind, derived, where)
        lines += wrong
        if wrong and not has_types(kind, derived):
            continue
        scenes[scene] = complete(kind, derived)
        errors = [*kind.cross_field_errors(scenes[scene])]
        # What the variant gives for the scene itself is wrong where it is, and where all was well.
        others = complete(kind, _derived(block, given, {}))
        excused = {at[0] for at, *_ in kind.cross_field_errors(others)} - change.keys()
        own = [error for error in errors if error[0][0] not in excused]
        for at, value, allowed in own or errors:
            shared = at[0] in given and at[0] not in change
            line = refusal((*(place if shared else where), *at), value, allowed)
            (mistaken if own else unsuitable).setdefault(line, []).extend([scene] * shared)
        if errors and not own:
            left_out[scene] = f"left out: {refusal(*errors[0])}"
            del scenes[scene]
    if not scenes:
        mistaken |= unsuitable
    lines += [f"{line}, for {', '.join(for_)}" if for_ else line for line, for_ in mistaken.items()]
    scale = given.get("scale", 1)
    if lines or scale == 1:
        return scenes, left_out, lines
    return {scene: _scaled(block, scale) for scene, block in scenes.items()}, left_out, []


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
    if block.get("parameter") == "energy":  # along which something is followed
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
