"""Validation of scenes, and of variants: the paper's scenes with some values replaced.

The values that a variant gives for all scenes (ball, energy, method) replace those of the scenes.
The fields that it gives for one scene are merged into the result. A scene that cannot have the
values is left out. The variant's `scale` L is applied at the end: g is multiplied by L and energies
by L^2; bounds are checked before that.
"""

import math
from collections.abc import Mapping
from typing import Any

from pydantic import create_model

from pseudorigid.dynamics.bounds import as_decimal

from ..schema.fields import TYPES_ALONE, Point, YamlMapping
from ..schema.kinds import KINDS
from ..schema.scene import CompletionError, Picture, Scene, Variant
from .mistakes import Mistake, Place, refusal, unknown, validate


def check_scene(
    given: object, ball: YamlMapping | None, place: Place, others: Mapping[str, Any]
) -> tuple[Picture | None, list[Mistake]]:
    """Return a complete scene and each mistake in it; None if its values have wrong types.

    `ball` is the ball of a scene without one, or None if it has mistakes itself. `others` are the
    scenes of its set, over one of which it may be drawn.
    """
    if not isinstance(given, dict):
        return None, [refusal(place, given, "a mapping that begins with picture")]
    if not isinstance(given.get("picture"), str) or given["picture"] not in KINDS:
        words, picture = f"one of {', '.join(KINDS)}", (*place, "picture")
        if "picture" not in given:
            return None, [Mistake(picture, f"missing: expected {words}")]
        return None, [refusal(picture, given["picture"], words)]
    if ball and issubclass(KINDS[given["picture"]], Scene):
        given = {"ball": ball} | given
    scene, mistakes = _read_scene(given, place, others)
    errors = scene.cross_field_errors() if scene else ()
    mistakes += [refusal((*place, *at), value, allowed) for at, value, allowed in errors]
    return scene, mistakes


def _read_scene(
    given: YamlMapping, place: Place, others: Mapping[str, Any]
) -> tuple[Picture | None, list[Mistake]]:
    """Return a scene with shorthands written out, or None, and the mistakes in its fields."""
    scene, mistakes = validate(KINDS[given["picture"]], given, place)
    if scene is None or (isinstance(scene, Scene) and scene.ball is None):
        return None, mistakes
    try:
        return (_drawn_over(scene, others) if scene.drawn_over else scene).completed(), mistakes
    except CompletionError as error:
        at, value, allowed = error.args
        return None, [*mistakes, refusal((*place, *at), value, allowed)]


def _drawn_over(scene: Picture, others: Mapping[str, Any]) -> Picture:
    """Return a scene with the fields of the scene over which it is drawn."""
    name = scene.as_mapping()["over"]
    kind, over = KINDS[scene.picture], KINDS[scene.drawn_over]
    given = others.get(name)
    if not isinstance(given, dict) or given.get("picture") != scene.drawn_over:
        raise CompletionError(("over",), name, f"a scene of kind {scene.drawn_over}")
    below, mistakes = validate(over, given, ())
    if below is None or mistakes:
        raise CompletionError(("over",), name, "a scene without mistakes")
    both: type[Picture] = create_model(kind.__name__, __base__=(kind, over))
    fields = below.completed().as_mapping() | scene.as_mapping()
    return both.model_validate(fields, context=TYPES_ALONE)


def derive_variant(
    scenes: YamlMapping, ball: YamlMapping, name: str, variant: Variant
) -> tuple[dict[str, Picture], dict[str, str], list[Mistake]]:
    """Return the scenes of a variant, why others are left out, and the mistakes in it.

    `scenes` are those of the paper as they are given, and `ball` is theirs. A scene is left out if
    the values that the variant gives for all scenes do not suit it. It is a mistake if they suit no
    scene, or if what the variant gives for the scene itself is wrong.
    """
    place, changes, mistakes = ("variants", name), variant.scenes or {}, list[Mistake]()
    for scene, change in changes.items():
        where, picture = (*place, "scenes", scene), scenes.get(scene, change).get("picture")
        if scene not in scenes:
            mistakes.append(Mistake(where, unknown("scene", scene, scenes)))
        elif change.get("picture", picture) != picture:
            words = f"{picture}, which a variant does not change"
            mistakes.append(refusal((*where, "picture"), change["picture"], words))
    if mistakes:
        return {}, {}, mistakes
    derived, left_out = dict[str, Picture](), {}
    mistaken: dict[Mistake, list[str]] = {}  # with the scenes that the value does not suit
    unsuitable: dict[Mistake, list[str]] = {}
    for scene, given in scenes.items():
        change, where = changes.get(scene, {}), (*place, "scenes", scene)
        merged, wrong = _read_scene(_merge_variant(given, ball, variant, change), where, scenes)
        mistakes += wrong
        if merged is None:
            continue
        errors = [*merged.cross_field_errors()]
        if not errors:
            derived[scene] = _scaled(merged, variant.scale or 1)
            continue
        # The variant's fields for this scene are wrong if they contain an error, or cause one.
        unchanged, _ = _read_scene(_merge_variant(given, ball, variant, {}), where, scenes)
        before = {at[0] for at, *_ in unchanged.cross_field_errors()} if unchanged else set()
        own = [error for error in errors if error[0][0] not in before - change.keys()]
        for at, value, allowed in own or errors:
            shared = at[0] in variant.model_fields_set and at[0] not in change
            mistake = refusal((*(place if shared else where), *at), value, allowed)
            (mistaken if own else unsuitable).setdefault(mistake, []).extend([scene] * shared)
        if not own:
            left_out[scene] = f"left out: {refusal(*errors[0])}"
    for mistake, names in (mistaken if derived else mistaken | unsuitable).items():
        more = f", for {', '.join(names)}" if names else ""
        mistakes.append(mistake._replace(words=mistake.words + more))
    return derived, left_out, mistakes


def _merge_variant(
    block: YamlMapping, ball: YamlMapping, variant: Variant, change: YamlMapping
) -> YamlMapping:
    """Merge a variant's values into a scene's block, to which its ball is added."""
    kind, replaced = KINDS[block["picture"]], YamlMapping()
    if issubclass(kind, Scene):
        block = {"ball": ball} | block
        replaced = variant.as_mapping(("ball", "energy", "method"))
    if "method" in replaced:  # methods are replaced as a whole
        block = block | {"method": {}}
    derived: YamlMapping = merge(merge(block, replaced), change)
    framing = ("ball", "energy", *kind.axes_depend_on)
    if variant.scale not in (None, 1) or any(block.get(f) != derived.get(f) for f in framing):
        derived.pop("axes", None)
        derived |= {"axes": change["axes"]} if "axes" in change else {}
    return derived


def merge(old: Any, new: Any) -> Any:
    """Merge mappings key by key; replace anything else."""
    if not (isinstance(old, dict) and isinstance(new, dict)):
        return new
    return old | {key: merge(old.get(key), value) for key, value in new.items()}


def _scaled(scene: Picture, scale: float) -> Picture:
    """Express a scene in another unit of length."""
    if scale == 1 or not isinstance(scene, Scene):
        return scene
    ball = scene.ball.model_copy(update={"g": _times(scene.ball.g, scale)})
    scaled: YamlMapping = {"ball": ball}
    for name in ["energy", "energies", "marks"] + ["span", "step"] * scene.along_energy():
        if (value := getattr(scene, name, None)) is not None:
            scaled[name] = _times(value, scale, scale)
    starts = getattr(scene, "starts", None)  # or their number
    if isinstance(starts, list):  # fractions of the section stay
        scaled["starts"] = [_times(s, scale) if isinstance(s, Point) else s for s in starts]
    return scene.model_copy(update=scaled)


def _times(values: Any, *factors: float) -> Any:
    """Multiply decimals as written and round once, so that 3 times 0.01 gives 0.03."""
    if isinstance(values, list):
        return [_times(value, *factors) for value in values]
    if isinstance(values, Point):
        scaled = {key: _times(value, *factors) for key, value in values.as_mapping().items()}
        return values.model_copy(update=scaled)
    return float(math.prod(map(as_decimal, (values, *factors))))
