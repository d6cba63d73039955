"""The fields of config.yaml, from their declarations: Markdown for pages, and a JSON schema."""

import ast
import inspect
import json
import re
from collections.abc import Iterable, Iterator
from itertools import pairwise
from textwrap import dedent, fill
from typing import Any

from pydantic.json_schema import GenerateJsonSchema, models_json_schema

from ..declaration import RENEW, parts
from .schema.fields import Block
from .schema.kinds import KINDS
from .schema.parts import MAIN, SETS, SETTINGS, upstream
from .schema.scene import Scene, Variant
from .validation.document import Document, with_shipped
from .validation.mistakes import allowed_at

EVERY = "every scene"  # the section of the fields that all kinds of picture share
_KEYS = r" \*Allowed:\* a mapping with the keys? [\w, ]+\.$"


class _Described(GenerateJsonSchema):
    """Pydantic's generator with the meaning of each field, and in words what it allows."""

    def model_schema(self, schema: Any) -> dict[str, Any]:
        made: dict[str, Any] = super().model_schema(schema)
        meanings = _meanings(schema["cls"])
        for key, field in made["properties"].items():
            allowed = f"Allowed: {allowed_at(schema['cls'], (key,))}."
            field["description"] = f"{meanings.get(key, '')} {allowed}".lstrip()
            field.pop("title", None)
            if field.get("default", 0) is None:  # the field has no value if it is left out
                del field["default"]
        return made


def _meanings(model: type[Block]) -> dict[str, str]:
    """Return the docstrings of fields. Pydantic would read them at every start, in 0.05 s."""
    found = {}
    for base in model.__mro__[model.__mro__.index(Block) - 1 :: -1]:
        if base is not Document:  # which has no source
            (tree,) = ast.parse(dedent(inspect.getsource(base))).body
            for pair in pairwise(getattr(tree, "body", [])):
                match pair:
                    case ast.AnnAssign(target=ast.Name(name)), ast.Expr(ast.Constant(str(words))):
                        found[model.model_fields[name].alias or name] = inspect.cleandoc(words)
    return found


def json_schema() -> str:
    """Return the text of config.schema.json: each key, type and bound of a single value."""
    models: list[Any] = [(model, "validation") for model in (Document, *KINDS.values())]
    references, whole = models_json_schema(models, schema_generator=_Described)
    document = whole["$defs"].pop("Document")
    of_kinds = [
        {"if": {"properties": {"picture": {"const": name}}}, "then": references[model]}
        for name, model in zip(KINDS, models[1:], strict=True)
    ]
    picture = {"required": ["picture"], "properties": {"picture": {"enum": list(KINDS)}}}
    whole["$defs"]["AnyScene"] = {"type": "object", **picture, "allOf": of_kinds}
    for field in document["properties"].values():
        for pattern, block in field.get("patternProperties", {}).items():
            field["patternProperties"] = {pattern: block or {"$ref": "#/$defs/AnyScene"}}
            field["additionalProperties"] = False
    document |= whole | {"title": "config.yaml", "$comment": f"Written by {RENEW}."}
    document["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    return json.dumps(document, indent=1, sort_keys=True, ensure_ascii=False) + "\n"


def fields() -> str:
    """Return the fields that each part adds to config.yaml, as Markdown."""
    seen: dict[tuple[str, str], tuple[str, str]] = {}
    return "".join(_of_part(part, seen) for part in parts())


def _of_part(part: str, seen: dict[tuple[str, str], tuple[str, str]]) -> str:
    """Return the section of a part; empty if it adds no fields."""
    declared, texts = parts()[part], list[str]()
    shipped: Any = with_shipped({})
    scenes = ((each, shipped.get(each.key, {}).values()) for each in SETS.values())
    keys = {block.get("picture", each.kind): each.key for each, of in scenes for block in of}
    models: dict[str, Any] = {**SETTINGS, EVERY: Scene, "a variant": Variant, **KINDS}
    for title, model in models.items():
        of_all = model in (Scene, Variant)
        if not of_all and model.__module__.split(".")[-2] != part:
            continue
        schema = model.model_json_schema(schema_generator=_Described)
        lines = [f"### {title}\n", *_listed(schema, schema.get("$defs", {}), title, seen)]
        if title in KINDS:
            about = f"{model.__doc__[0].upper()}{model.__doc__[1:]}.\n\nStages: "
            about += f"{_quoted(upstream(model.stages))}; under `{keys.get(title, 'scenes')}:`"
            lacking = [key for key in Scene.model_fields if key not in schema["properties"]]
            about += f"; without {_quoted(lacking)}.\n" if lacking else ".\n"
            lines[:1] = [f"### picture: {title}\n", about]
        if not of_all or MAIN in declared.sets:
            texts.append("\n".join(lines))
    rows = ["### stages\n\n| stage | fields | made from | follows `method` |\n|---|---|---|---|"]
    for name, stage in declared.stages.items():
        cells = f"`{name}` | {_quoted(stage.fields.split())} | {_quoted(stage.inputs)}"
        rows.append(f"| {cells} | {'yes' if stage.follows else 'no'} |")
    texts += ["\n".join(rows)] if declared.stages else []
    return "\n\n".join([f"\n## Fields of {part}", *texts, ""]) if texts else ""


def _listed(block: Any, blocks: Any, where: str, seen: Any, indent: str = "") -> Iterator[str]:
    """Yield a list of fields; one that `seen`, its words -> where, has from elsewhere is named."""
    named: dict[tuple[str, str], list[str]] = {}
    for key, field in block["properties"].items():
        default = "required" if key in block.get("required", ()) else "optional"
        default = f"default `{field['default']}`" if "default" in field else default
        blocks_of = re.findall(r"#/\$defs/(\w+)", json.dumps(field))
        words = field["description"].replace("Allowed:", "*Allowed:*")
        words = re.sub(_KEYS, "", words) if blocks_of else words  # their list follows
        mark = "" if default == "required" else f" ({default})"
        if (key, words) not in seen:
            seen[key, words] = where, default
            below = f"{indent}  "
            item = f"{indent}- `{key}`{mark}: {words}"
            yield fill(item, 100, subsequent_indent=below, break_on_hyphens=False)
            for name in blocks_of:
                yield from _listed(blocks[name], blocks, where, seen, below)
        else:
            first, of_first = seen[key, words]
            if (first, of_first) == (EVERY, default) and where in KINDS:
                continue  # the page says once that each kind has them
            place = "above" if first == where else f"of {first}"
            own = "" if of_first == default else f" ({default})"
            named.setdefault((place, own), []).append(key)
    for (place, own), keys in named.items():
        yield f"{indent}- {_quoted(keys)}{own}: as {place}."


def _quoted(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)
