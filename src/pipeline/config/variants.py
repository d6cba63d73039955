"""Variants: the paper's document with some of its values replaced.

A variant's `ball` is laid over the default ball, its `energy` and `method` replace those of every
scene, and what it says under `scenes` is laid over these. Mappings merge, numbers, texts and lists
replace. Its `scale` L changes the unit of length at the very end: g is multiplied by L, energies by
L^2, and the ball's radius is L; bounds are those of the numbers before.
"""

import difflib
from fractions import Fraction

from .structure import check_structure
from .words import ConfigError, dotted, refusal

PAPER = "paper"
# Folders in results/ and words that a variant's name must leave alone.
RESERVED = (PAPER, "study", "sweep", "sweeps", "atlas", "compare", "report")
# Axes belong to a ball and an energy, and to these fields: a variant that changes one of them has
# its own axes, or those of its data.
FRAMING = {
    "motion": ("period", "type", "duration"),
    "closeup": ("period", "type", "point", "window"),
    "exponents": ("impacts",),
}


def derive(document, name, place):
    """The ball and the scenes, not yet checked, of the variant `name` of a checked document.

    Returns (ball, {scene: block}, {scene: place of its energy}). Raises ConfigError.
    """
    if name in RESERVED:
        what = f"a name other than {', '.join(RESERVED)}"
        raise refusal(place[:-1], name, what)
    given = document["variants"][name]
    check_structure(given, "variant", place)
    ball = document["ball"] | given.get("ball", {})
    changes = given.get("scenes", {})
    for scene, change in changes.items():
        _check_change(document["scenes"], scene, change, (*place, "scenes", scene))
    scenes, energy_places = {}, {}
    for scene, block in document["scenes"].items():
        change = changes.get(scene, {})
        start = {"ball": ball} | block
        own = (*place, "scenes", scene, "energy")
        if "energy" in given and "energy" not in change:
            start["energy"] = given["energy"]
            own = (*place, "energy")
        if "method" in given:
            start["method"] = given["method"]
        after = merged(start, change)
        before = {"ball": document["ball"]} | block
        fields = ("ball", "energy", *FRAMING.get(block["picture"], ()))
        if given.get("scale", 1) != 1 or any(before.get(f) != after.get(f) for f in fields):
            after.pop("axes", None)
            after |= {key: change[key] for key in ("axes",) if key in change}
        scenes[scene] = after
        energy_places[scene] = own
    return ball, scenes, energy_places


def merged(old, new):
    """`new` laid over `old`: mappings key by key, anything else in its place."""
    if not (isinstance(old, dict) and isinstance(new, dict)):
        return new
    return old | {key: merged(old.get(key), value) for key, value in new.items()}


def unknown(kind, name, known):
    """In words that there is no such thing, and which was meant."""
    near = difflib.get_close_matches(str(name), known, 1, 0.5)
    hint = f"did you mean {near[0]}? " if near else ""
    return f"no {kind} {name}: {hint}config.yaml has {', '.join(known) or 'none'}"


def _check_change(scenes, scene, change, place):
    if scene not in scenes:
        raise ConfigError(f"{dotted(place)}: {unknown('scene', scene, list(scenes))}")
    if not isinstance(change, dict):
        raise refusal(place, change, "a mapping with fields of the scene")
    if change.get("picture", scenes[scene]["picture"]) != scenes[scene]["picture"]:
        what = f"{scenes[scene]['picture']}, which a variant does not change"
        raise refusal((*place, "picture"), change["picture"], what)


def scaled(block, scale):
    """A complete block in another unit of length."""
    ball = block["ball"] | {"g": _product(block["ball"]["g"], scale)}
    return block | {"ball": ball, "energy": _product(block["energy"], scale, scale)}


def _product(*factors):
    """Of the decimals as written: 3 times 0.01 is 0.03."""
    product = Fraction(1)
    for factor in factors:
        product *= Fraction(str(factor))
    return float(product)
