"""Read config.yaml, check it, and say what each scene needs computed.

Whatever is wrong with the file becomes one `ConfigError`, whose one line names the key, its value
and what is allowed. Importing this module is cheap: it is part of every start.
"""

import difflib
import json
import sys
from fractions import Fraction
from functools import cache
from pathlib import Path

import yaml

from .sweep import grid

SCHEMA = Path(__file__).resolve().parents[2] / "workflow" / "schemas" / "config.schema.yaml"
LARGEST = 10_000_000  # impacts of a scene, and points of a manifold: above it a number is a slip

# What each kind of picture is drawn from: stage -> the fields of the scene that decide its data.
STAGES = {
    "portrait": {"orbits": ("starts", "impacts")},
    "motion": {"periodic": ("period",), "motion": ("period", "type", "duration")},
    "tangle": {
        "orbits": ("starts", "impacts"),
        "periodic": ("period",),
        "manifolds": ("period", "type", "branches", "resolution"),
    },
    "closeup": {
        "periodic": ("period",),
        "manifolds": ("period", "type", "point", "window", "resolution", "length"),
    },
    "exponents": {"lyapunov": ("starts", "impacts", "records")},
}
SHOWN = ("png", "svg")  # formats that are published; pdf stays in results


class ConfigError(Exception):
    """One line about what is wrong in the config and what is allowed."""


# ---- reading ----


class _Loader(yaml.SafeLoader):
    """YAML that refuses a key given twice, of which plain PyYAML keeps the last without a word."""

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key, _ in node.value if isinstance(node, yaml.MappingNode) else ():
            if not isinstance(key, yaml.ScalarNode):
                continue  # PyYAML itself refuses a list or a mapping as a key
            if key.value in seen:
                raise yaml.constructor.ConstructorError(
                    None, None, f"the key {key.value} is given twice", key.start_mark
                )
            seen.add(key.value)
        return super().construct_mapping(node, deep)


def load(path) -> dict:
    """The checked config at `path`; every scene complete with its `ball` and `formats`.

    Raises ConfigError, with the one line to show.
    """
    path = Path(path)
    try:
        return check(_parse(path))
    except ConfigError as error:
        raise ConfigError(f"{path.name}: {error}") from None
    except RecursionError:
        raise ConfigError(f"{path.name}: nested too deeply") from None


def _parse(path):
    try:
        return yaml.load(path.read_text(encoding="utf-8"), _Loader)
    except OSError as error:
        raise ConfigError(f"cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise ConfigError(f"is not UTF-8 text: byte {error.start}") from None
    except (yaml.YAMLError, ValueError) as error:  # ValueError: a date that does not exist
        mark = getattr(error, "problem_mark", None)
        place = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
        problem = getattr(error, "problem", None) or str(error).splitlines()[0]
        raise ConfigError(f"{place}not valid YAML: {problem}") from None
    except (LookupError, AttributeError):  # what PyYAML makes of `!!bool x`
        raise ConfigError("not valid YAML: a value that is not what its !!tag says") from None


# ---- checking ----


def check(document) -> dict:
    """The complete config of a parsed YAML `document`; raises ConfigError where there is none."""
    _check_structure(document, "config", ())
    ball = document["ball"]
    _check_ball(ball, ("ball",))
    scenes = {}
    for name, given in document["scenes"].items():
        place = ("scenes", name)
        _check_structure(given, "scene", place, extra_keys=True)
        _check_structure(given, given["picture"], place)
        block = {"ball": ball, "formats": ["png"]} | given
        if "png" not in block["formats"]:
            raise _refusal((*place, "formats"), block["formats"], "a list that has png in it")
        _check_ball(block["ball"], (*place, "ball"))
        _check_energy(block, place)
        _check_amounts(block, place)
        _check_ranges(block, place)
        scenes[name] = block
    sweeps = grid.check(document.get("sweeps", {}), _check_structure, _refusal)
    return {"ball": ball, "scenes": scenes, "sweeps": sweeps}


def _check_ball(ball, place):
    if not ball["g"] < ball["k"]:
        raise _refusal((*place, "g"), ball["g"], f"0 < g < k = {ball['k']}")


def _check_energy(block, place):
    ball = block["ball"]
    # The decimals as written: as floats 0.2 / 2 - 0.04 is a little more than 0.06.
    k, g, energy = (Fraction(str(x)) for x in (ball["k"], ball["g"], block["energy"]))
    lowest, highest = -g * g / (2 * k), k / 2 - g
    place = (*place, "energy")
    if not energy > lowest:
        what = f"a number above -g^2/(2k) = {float(lowest):g}, where the ball rests on the floor"
        raise _refusal(place, block["energy"], what)
    if not energy < highest:
        what = (
            f"a number below k/2 - g = {float(highest):g}, where the ball could flatten to nothing"
        )
        raise _refusal(place, block["energy"], what)


def _check_amounts(block, place):
    impacts, starts = block.get("impacts"), block.get("starts")
    if isinstance(impacts, list) and len(impacts) != len(starts):
        what = f"one number for each of the {len(starts)} starts"
        raise _refusal((*place, "impacts"), impacts, what)
    if impacts is not None:
        total = sum(impacts) if isinstance(impacts, list) else impacts * len(starts)
        if total > LARGEST:
            what = f"at most {LARGEST} impacts in a scene, counted over all its starts"
            raise _refusal((*place, "impacts"), impacts, what)
    if "records" in block and block["records"] > impacts:
        raise _refusal((*place, "records"), block["records"], f"at most impacts = {impacts}")
    if "point" in block and block["point"] >= block["period"]:
        what = f"a whole number from 0 to period - 1 = {block['period'] - 1}"
        raise _refusal((*place, "point"), block["point"], what)
    for place_in_starts in block.get("sea", []):
        if place_in_starts >= len(starts):
            what = f"a place in starts, from 0 to {len(starts) - 1}"
            raise _refusal((*place, "sea"), place_in_starts, what)
    branches = block.get("branches", {})
    lengths = {("branches", side, "length"): branches[side]["length"] for side in branches}
    if "length" in block:
        lengths["length",] = block["length"]
    for where, length in lengths.items():
        longest = LARGEST * block["resolution"]["distance"]
        if length > longest:
            what = f"at most {LARGEST} times resolution.distance = {longest:g}"
            raise _refusal((*place, *where), length, what)


def _check_ranges(block, place):
    for axis, (low, high) in block.get("window", {}).items():
        if not low < high:
            raise _refusal((*place, "window", axis), [low, high], "two increasing numbers")
    for axis, drawn in block.get("axes", {}).items():
        low, high = drawn["limits"]
        if not low < high:
            where = (*place, "axes", axis, "limits")
            raise _refusal(where, drawn["limits"], "two increasing numbers")
        for tick in drawn["ticks"]:
            if not low <= tick <= high:
                what = f"numbers within the limits {_shown(drawn['limits'])}"
                raise _refusal((*place, "axes", axis, "ticks"), tick, what)


@cache
def _strict():
    """The class of validators that take no bool, infinity or NaN for a number, no 6.0 for a 6."""
    from jsonschema import Draft202012Validator, validators

    types = Draft202012Validator.TYPE_CHECKER.redefine_many(
        {
            "integer": lambda _, x: isinstance(x, int) and not isinstance(x, bool),
            "number": lambda _, x: (
                isinstance(x, int | float)
                and not isinstance(x, bool)
                and abs(x) <= sys.float_info.max  # neither infinite nor NaN
            ),
        }
    )
    return validators.extend(Draft202012Validator, type_checker=types)


@cache
def _validators():
    """One validator for each definition of the schema file."""
    schema = yaml.safe_load(SCHEMA.read_text(encoding="utf-8"))
    return {
        name: _strict()({"$ref": f"#/$defs/{name}", "$defs": schema["$defs"]})
        for name in schema["$defs"]
    }


def _check_structure(instance, definition, place, extra_keys=False):
    """Check against one definition of the schema and raise the first finding, topmost first.

    `extra_keys` leaves unknown keys to a later, narrower check.
    """
    findings = [
        error
        for error in _validators()[definition].iter_errors(instance)
        if not (extra_keys and error.validator == "additionalProperties" and not error.path)
    ]
    if findings:
        # A misspelt key leaves the right one missing: say the former.
        rank = {"additionalProperties": 0, "required": 1}
        first = min(findings, key=lambda e: (len(e.path), rank.get(e.validator, 2)))
        raise _explain(first, place)


def _explain(error, place) -> ConfigError:
    place = (*place, *error.absolute_path)
    if error.validator == "additionalProperties":
        known = list(error.schema["properties"])
        key = next(key for key in error.instance if key not in known)
        near = difflib.get_close_matches(str(key), known, 1, 0.5)
        hint = f"did you mean {near[0]}?" if near else f"allowed here: {', '.join(known)}"
        return ConfigError(f"{_dotted((*place, key))}: unknown key: {hint}")
    if error.validator == "required":
        key = next(key for key in error.validator_value if key not in error.instance)
        return ConfigError(f"{_dotted((*place, key))}: missing")
    what = error.schema.get("description", "something else")
    value = error.instance
    if isinstance(value, str):
        number = _number_in(value)
        if _strict()(error.schema).is_valid(number):
            plain = repr(number)
            if "." not in plain:
                plain = plain.replace("e", ".0e")  # YAML 1.1 takes 1e-3 for text
            what += f"; this is text to YAML, write {plain}"
    return _refusal(place, value, what)


def _number_in(text):
    """The number that a text was meant to be, whole where it can be, or None."""
    try:
        number = float(text)
    except ValueError:
        return None
    return int(number) if number.is_integer() and abs(number) < 1e15 else number


def _refusal(place, value, allowed) -> ConfigError:
    where = f"{_dotted(place)}: " if place else ""
    return ConfigError(f"{where}{_shown(value)} is not allowed: expected {allowed}")


def _dotted(place) -> str:
    text = ""
    for part in place:
        text += f"[{part}]" if isinstance(part, int) else f".{part}"
    return text.removeprefix(".")


def _shown(value) -> str:
    text = "nothing" if value is None else repr(value) if value not in (True, False) else ""
    text = text or str(value).lower()
    return text if len(text) <= 60 else text[:57] + "..."


# ---- what a scene needs ----


def stages(block: dict) -> dict[str, dict]:
    """Stage -> the smallest block that decides its data, for one scene of a checked config."""
    return {
        stage: {field: block[field] for field in ("ball", "energy", *fields)}
        for stage, fields in STAGES[block["picture"]].items()
    }


def drawing(block: dict) -> dict:
    """What decides how a scene is drawn."""
    return {key: value for key, value in block.items() if key != "formats"}


def owners(scenes: dict[str, dict]) -> dict[tuple[str, str], str]:
    """(scene, stage) -> the scene whose artifact serves it: the first with the same parameters."""
    first, serves = {}, {}
    for name, block in scenes.items():
        for stage, parameters in stages(block).items():
            key = stage, json.dumps(parameters, sort_keys=True)
            serves[name, stage] = first.setdefault(key, name)
    return serves


def artifact(stage: str, owner: str, variant: str = "paper") -> str:
    """Where the data of a stage are, from the project's root."""
    return f"results/{variant}/{stage}_{owner}.nc"


def drawn(scene: str, extension: str, variant: str = "paper") -> str:
    """Where a figure is drawn."""
    return f"results/{variant}/figures/{scene}.{extension}"


def shown(scene: str, extension: str) -> str:
    """Where users look for the figure: in paper_figures/, or in results if it is not published."""
    return f"paper_figures/{scene}.{extension}" if extension in SHOWN else drawn(scene, extension)


def figures(scenes: dict[str, dict]) -> dict[str, tuple[str, list[str]]]:
    """Each figure, where users look for it -> its scene, its data files and last its drawing."""
    serves = owners(scenes)
    return {
        shown(name, extension): (
            name,
            [artifact(stage, serves[name, stage]) for stage in STAGES[block["picture"]]]
            + [drawn(name, extension)],
        )
        for name, block in scenes.items()
        for extension in block["formats"]
    }
