"""Structure and bounds of a whole config; every scene made complete."""

from fractions import Fraction

from pseudorigid.sweep import grid

from .structure import check_structure
from .variants import PAPER, derive, scaled
from .words import refusal, shown

LARGEST = 10_000_000  # impacts of a scene, and points of a manifold: above it a number is a slip


def check(document) -> dict:
    """The complete config of a parsed YAML `document`; raises ConfigError where there is none.

    Its `variants` begin with the paper itself: name -> scene -> block.
    """
    check_structure(document, "config", ())
    ball = document["ball"]
    _check_ball(ball, ("ball",))
    scenes = {
        name: _scene(given, ball, ("scenes", name)) for name, given in document["scenes"].items()
    }
    variants = {PAPER: scenes}
    for name in document.get("variants", {}):
        variants[name] = _variant(document, name)
    sweeps = grid.check(document.get("sweeps", {}), check_structure, refusal)
    return {"ball": ball, "scenes": scenes, "variants": variants, "sweeps": sweeps}


def _variant(document, name):
    place = ("variants", name)
    ball, scenes, energy_places = derive(document, name, place)
    _check_ball(ball, (*place, "ball"))
    checked = {
        scene: _scene(given, ball, (*place, "scenes", scene), energy_places[scene])
        for scene, given in scenes.items()
    }
    scale = document["variants"][name].get("scale", 1)
    if scale == 1:
        return checked
    return {scene: scaled(block, scale) for scene, block in checked.items()}


def _scene(given, ball, place, energy_place=None):
    """The checked and complete block of one scene."""
    check_structure(given, "scene", place, extra_keys=True)
    check_structure(given, given["picture"], place)
    block = {"ball": ball, "formats": ["png"]} | given
    if "png" not in block["formats"]:
        raise refusal((*place, "formats"), block["formats"], "a list that has png in it")
    _check_ball(block["ball"], (*place, "ball"))
    _check_energy(block, energy_place or (*place, "energy"))
    _check_amounts(block, place)
    _check_ranges(block, place)
    return block


def _check_ball(ball, place):
    if not ball["g"] < ball["k"]:
        raise refusal((*place, "g"), ball["g"], f"0 < g < k = {ball['k']}")


def _check_energy(block, place):
    ball = block["ball"]
    # The decimals as written: as floats 0.2 / 2 - 0.04 is a little more than 0.06.
    k, g, energy = (Fraction(str(x)) for x in (ball["k"], ball["g"], block["energy"]))
    lowest, highest = -g * g / (2 * k), k / 2 - g
    if not energy > lowest:
        what = f"a number above -g^2/(2k) = {float(lowest):g}, where the ball rests on the floor"
        raise refusal(place, block["energy"], what)
    if not energy < highest:
        what = (
            f"a number below k/2 - g = {float(highest):g}, where the ball could flatten to nothing"
        )
        raise refusal(place, block["energy"], what)


def _check_amounts(block, place):
    impacts, starts = block.get("impacts"), block.get("starts")
    if isinstance(impacts, list) and len(impacts) != len(starts):
        what = f"one number for each of the {len(starts)} starts"
        raise refusal((*place, "impacts"), impacts, what)
    if impacts is not None:
        total = sum(impacts) if isinstance(impacts, list) else impacts * len(starts)
        if total > LARGEST:
            what = f"at most {LARGEST} impacts in a scene, counted over all its starts"
            raise refusal((*place, "impacts"), impacts, what)
    if "records" in block and block["records"] > impacts:
        raise refusal((*place, "records"), block["records"], f"at most impacts = {impacts}")
    if "point" in block and block["point"] >= block["period"]:
        what = f"a whole number from 0 to period - 1 = {block['period'] - 1}"
        raise refusal((*place, "point"), block["point"], what)
    for place_in_starts in block.get("sea", []):
        if place_in_starts >= len(starts):
            what = f"a place in starts, from 0 to {len(starts) - 1}"
            raise refusal((*place, "sea"), place_in_starts, what)
    branches = block.get("branches", {})
    lengths = {("branches", side, "length"): branches[side]["length"] for side in branches}
    if "length" in block:
        lengths["length",] = block["length"]
    for where, length in lengths.items():
        longest = LARGEST * block["resolution"]["distance"]
        if length > longest:
            what = f"at most {LARGEST} times resolution.distance = {longest:g}"
            raise refusal((*place, *where), length, what)


def _check_ranges(block, place):
    for axis, (low, high) in block.get("window", {}).items():
        if not low < high:
            raise refusal((*place, "window", axis), [low, high], "two increasing numbers")
    for axis, drawn in block.get("axes", {}).items():
        low, high = drawn["limits"]
        if not low < high:
            where = (*place, "axes", axis, "limits")
            raise refusal(where, drawn["limits"], "two increasing numbers")
        for tick in drawn["ticks"]:
            if not low <= tick <= high:
                what = f"numbers within the limits {shown(drawn['limits'])}"
                raise refusal((*place, "axes", axis, "ticks"), tick, what)
