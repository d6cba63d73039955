"""The JSON schema of config.yaml, made from the declarations, for editors and validators.

The schema knows every key, type and bound of one value. Conditions between fields, such as eq.
(31), are checked by `./reproduce` alone.
"""

import ast
import inspect
import json
from functools import cache
from itertools import pairwise
from textwrap import dedent
from typing import Any, Literal

from pydantic.json_schema import GenerateJsonSchema, models_json_schema

from ..declaration import RENEW, parts
from .schema.fields import Block
from .schema.kinds import KINDS
from .validation.document import Document
from .validation.mistakes import allowed_at

_DIALECT = "https://json-schema.org/draft/2020-12/schema"
Schema = dict[str, Any]


def schema() -> Schema:
    """Return the JSON schema of config.yaml."""
    models: list[type[Block]] = [Document, *KINDS.values()]
    mode: Literal["validation"] = "validation"
    references, definitions = models_json_schema(
        [(model, mode) for model in models], schema_generator=Described
    )
    blocks: dict[str, Schema] = definitions["$defs"]

    blocks["AnyScene"] = {
        "type": "object",
        "required": ["picture"],
        "properties": {"picture": {"enum": list(KINDS)}},
        "allOf": [
            {"if": {"properties": {"picture": {"const": name}}}, "then": references[kind, mode]}
            for name, kind in KINDS.items()
        ],
    }
    document = blocks.pop("Document")
    for field in document["properties"].values():
        for pattern, block in field.get("patternProperties", {}).items():
            field["patternProperties"] = {pattern: block or {"$ref": "#/$defs/AnyScene"}}
            field["additionalProperties"] = False
    # Sorted by keys, the comment stands in the first two lines, where a run looks for it.
    comment = f"Parts: {', '.join(sorted(parts()))}. Written by {RENEW}."
    head = {"$comment": comment, "$schema": _DIALECT, "title": "config.yaml"}
    return {**head, **document, "$defs": blocks}


class Described(GenerateJsonSchema):
    """Pydantic's generator with the meaning of each field and in words what it allows.

    There are no titles, and no null as the value of an absent field.
    """

    def default_schema(self, schema: Any) -> Schema:
        made: Schema = super().default_schema(schema)
        if made.get("default", 0) is None:
            del made["default"]
        return made

    def model_schema(self, schema: Any) -> Schema:
        made: Schema = super().model_schema(schema)
        for key, field in made["properties"].items():
            allowed = f"Allowed: {allowed_at(schema['cls'], (key,))}."
            meaning = _meanings(schema["cls"]).get(key, "")
            field["description"] = f"{meaning} {allowed}".lstrip()
        return made

    def field_title_should_be_set(self, schema: Any) -> bool:
        return False


@cache
def _meanings(model: type[Block]) -> dict[str, str]:
    """Return the docstrings of the fields of a model, by their keys.

    Pydantic can read them too, but does so whenever a class is made, at each start of a command.
    """
    found: dict[str, str] = {}
    for base in model.__mro__[model.__mro__.index(Block) - 1 :: -1]:
        try:
            (tree,) = ast.parse(dedent(inspect.getsource(base))).body
        except OSError:  # a class that was made by a function
            continue
        assert isinstance(tree, ast.ClassDef)
        for field, text in pairwise(tree.body):
            match field, text:
                case ast.AnnAssign(target=ast.Name(name)), ast.Expr(ast.Constant(str(words))):
                    found[model.model_fields[name].alias or name] = inspect.cleandoc(words)
    return found


def text() -> str:
    """Return the text of config.schema.json."""
    return json.dumps(schema(), indent=1, sort_keys=True, ensure_ascii=False) + "\n"
