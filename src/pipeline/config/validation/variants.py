"""The block `variants:`: ranges become variants, and a faulty variant stops only itself.

A block with `values` is a range. It becomes one variant for each value, its members: with the name
gravity, `values: {ball.g: [0.02, 0.03]}` makes gravity-0p02 and gravity-0p03.
"""

import re
from functools import reduce
from typing import Any

from pydantic import create_model

from ...declaration import parts
from ..results import Config, Range
from ..schema.fields import Block, YamlMapping
from ..schema.parts import SETS
from ..schema.scene import VARIANTS, Variant
from .mistakes import Mistake, Place, dotted, refusal, validate
from .scenes import derive_variant, merge

_Alone: Any = create_model("_Alone", __base__=Block, variants=(VARIANTS, ...))


def add_variants(
    config: Config, given: YamlMapping, scenes: YamlMapping, ball: YamlMapping | None
) -> None:
    """Add the variants and ranges of a block; without a ball, only its mistakes.

    `scenes` are those of the paper as they are given, and `ball` is theirs.
    """
    faulty, blocks = dict[str, list[Mistake]](), dict(given)
    for name, block in given.items():
        if isinstance(block, dict) and "values" in block:
            del blocks[name]
            _, faulty[name] = _read(name, block, scenes)
            if faulty[name]:
                continue
            of, members = _expand(name, block)
            if len(members) < len(block["values"][of.path]) or {*members} & {*given, *blocks}:
                words = f"values whose variants have names of their own, not {', '.join(members)}"
                place = ("variants", name, "values", of.path)
                faulty[name] = [refusal(place, block["values"][of.path], words)]
                continue
            config.ranges[name] = of
            blocks |= members
    for name, block in blocks.items():
        variant, faulty[name] = _read(name, block, scenes)
        if variant and ball and not faulty[name]:
            derived, left_out, faulty[name] = derive_variant(scenes, ball, name, variant)
            if not faulty[name]:
                config.variants[name], config.left_out[name] = derived, left_out
    for name, each in config.ranges.items():
        faulty |= _in_range(name, each, {member: faulty[member] for member in each.members})
    config.faulty.update((name, mistakes) for name, mistakes in faulty.items() if mistakes)


def _read(name: str, block: object, scenes: YamlMapping) -> tuple[Variant | None, list[Mistake]]:
    """Return a variant or a range, and the mistakes in its name and its fields."""
    found, mistakes = validate(_Alone, {"variants": {name: block}}, ())
    reserved = [*SETS, *(folder for part in parts().values() for folder in part.folders)]
    if name in reserved or name in scenes:
        words = f"a name that no scene has, other than {', '.join(reserved)}"
        mistakes.append(refusal(("variants",), name, words, key=name))
    return found and found.variants.get(name), mistakes


def _expand(name: str, block: YamlMapping) -> tuple[Range, dict[str, YamlMapping]]:
    """Return a range and the blocks of its members."""
    ((path, values),) = block["values"].items()
    common = {key: value for key, value in block.items() if key != "values"}
    members, blocks = dict[str, Any](), {}
    for value in values:
        text = re.sub("[^A-Za-z0-9_-]+", "-", str(value).replace(".", "p").replace("+", ""))
        members[f"{name}-{text}"] = value
        nested = reduce(lambda inner, key: {key: inner}, reversed(path.split(".")), value)
        blocks[f"{name}-{text}"] = merge(common, nested)
    return Range(path, members), blocks


def _in_range(name: str, of: Range, found: dict[str, list[Mistake]]) -> dict[str, list[Mistake]]:
    """Return the mistakes of a range's members with the places in the range that they come from.

    A mistake that all members have is one of the range, another one is one of the value.
    """
    keys, every = tuple(of.path.split(".")), [*found.values()]

    def relocated(i: int, mistake: Mistake) -> Mistake:
        rest, words = mistake.place[2:], mistake.words
        everywhere = all((rest, words) in [(m.place[2:], m.words) for m in each] for each in every)
        in_path = rest[: len(keys)] == keys[: len(rest)]
        if everywhere and not in_path:
            return Mistake(("variants", name, *rest), words)
        place: Place = ("variants", name, "values", of.path, *([] if everywhere else [i]))
        return Mistake(place, words if in_path else f"{dotted(rest)}: {words}")

    return {m: [relocated(i, each) for each in found[m]] for i, m in enumerate(found)}
