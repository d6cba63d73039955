"""The JSON schema of config.yaml, made from the declarations, for editors and validators.

Run `.venv/bin/python -m pipeline.config.json_schema` to renew config.schema.json. The schema knows
every key, type and bound of one value. Conditions between fields, such as eq. (31), are checked by
`./reproduce` alone.
"""

import json
from typing import Any, Literal

from pydantic.json_schema import GenerateJsonSchema, models_json_schema

from ..records.files import write_whole
from ..records.sources import ROOT
from .reference import meanings
from .schema.fields import Block
from .schema.kinds import KINDS
from .validation.document import Document

FILE = "config.schema.json"
_DIALECT = "https://json-schema.org/draft/2020-12/schema"
Schema = dict[str, Any]


def schema() -> Schema:
    """Return the JSON schema of config.yaml."""
    models: list[type[Block]] = [Document, *KINDS.values()]
    mode: Literal["validation"] = "validation"
    references, definitions = models_json_schema(
        [(model, mode) for model in models], schema_generator=_Generator
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
    return {"$schema": _DIALECT, "title": "config.yaml", **document, "$defs": blocks}


class _Generator(GenerateJsonSchema):
    """Pydantic's generator without titles and without null as the value of an absent field."""

    def default_schema(self, schema: Any) -> Schema:
        made: Schema = super().default_schema(schema)
        if made.get("default", 0) is None:
            del made["default"]
        return made

    def model_schema(self, schema: Any) -> Schema:
        """Put the docstrings of the fields before the words for what is allowed."""
        made: Schema = super().model_schema(schema)
        for key, meaning in meanings(schema["cls"]).items():
            field = made["properties"][key]
            words = [f"Allowed: {field['description']}."] if "description" in field else []
            field["description"] = " ".join([meaning, *words])
        return made

    def field_title_should_be_set(self, schema: Any) -> bool:
        return False


def text() -> str:
    """Return the text of config.schema.json."""
    return json.dumps(schema(), indent=1, sort_keys=True, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    write_whole(ROOT / FILE, text())
