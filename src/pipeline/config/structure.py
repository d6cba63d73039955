"""Whether a part of the config has the structure that the schema file asks of it."""

import difflib
import sys
from functools import cache
from pathlib import Path

import yaml

from .words import ConfigError, dotted, refusal

SCHEMA = Path(__file__).resolve().parents[3] / "workflow" / "schemas" / "config.schema.yaml"


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


def check_structure(instance, definition, place, extra_keys=False):
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
        return ConfigError(f"{dotted((*place, key))}: unknown key: {hint}")
    if error.validator == "required":
        key = next(key for key in error.validator_value if key not in error.instance)
        return ConfigError(f"{dotted((*place, key))}: missing")
    what = error.schema.get("description", "something else")
    value = error.instance
    if isinstance(value, str):
        number = _number_in(value)
        if _strict()(error.schema).is_valid(number):
            plain = repr(number)
            if "." not in plain:
                plain = plain.replace("e", ".0e")  # YAML 1.1 takes 1e-3 for text
            what += f"; this is text to YAML, write {plain}"
    return refusal(place, value, what)


def _number_in(text):
    """The number that a text was meant to be, whole where it can be, or None."""
    try:
        number = float(text)
    except ValueError:
        return None
    return int(number) if number.is_integer() and abs(number) < 1e15 else number
