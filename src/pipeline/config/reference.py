"""Generator of docs/config.md, from the classes in schema/ and the template reference.md.

Run `.venv/bin/python -m pipeline.config.reference` to renew the page.
"""

from collections.abc import Iterable
from pathlib import Path
from textwrap import dedent, fill
from typing import Any, get_args, get_origin

import jinja2

from ..declaration import files
from ..records.files import write_whole
from ..records.sources import ROOT
from .json_schema import Described
from .schema import fields
from .schema.fields import BallBlock, Block
from .schema.kinds import KINDS
from .schema.method import METHOD_BLOCKS
from .schema.scene import Picture, Scene
from .schema.sets import MAIN, SETS
from .schema.stages import STAGES, upstream
from .schema.variant import Variant
from .validation.document import BLOCKS, with_shipped

EXAMPLES = tuple(files("examples.yaml").values())


def page() -> str:
    """Return the text of docs/config.md."""
    text = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")
    template = jinja2.Template(
        text, trim_blocks=True, keep_trailing_newline=True, undefined=jinja2.StrictUndefined
    )
    used: tuple[Any, ...] = (Scene, Variant, example, key_of, listed)
    used += (mappings, nested, own_fields, upstream)
    names = {each.__name__: each for each in used}
    tables = {"KINDS": KINDS, "STAGES": STAGES, "METHOD_BLOCKS": METHOD_BLOCKS, "BLOCKS": BLOCKS}
    sets = {each.key: each for name, each in SETS.items() if each.key and name != MAIN}
    return str(template.render(names | tables, SETS=sets, fields=fields))


def example(name: str) -> str:
    """Return the YAML text of an example scene of a kind of picture."""
    for file in EXAMPLES:
        _, _, text = f"\n{file.read_text(encoding='utf-8')}".partition(f"\n{name}:\n")
        if text:
            return dedent(text.partition("\n\n")[0]).rstrip()
    raise LookupError(f"{name}: no example")


def mappings(kind: type[Picture]) -> dict[str, type[Block]]:
    """Map names to the Block classes that a kind's module declares for values of its fields."""
    declared = [each for each in Block.__subclasses__() if each.__module__ == kind.__module__]
    return {each.__name__.lower(): each for each in declared if not issubclass(each, Picture)}


def nested(kinds: Iterable[type[Picture]]) -> dict[str, type[Block]]:
    """Map places to the Block classes that groups of fields declare for values of their fields."""
    found: dict[type[Block], str] = {}

    def look(place: str, annotation: Any) -> None:
        block = isinstance(annotation, type) and issubclass(annotation, Block)
        if block and found.setdefault(annotation, place) == place:
            look_in(annotation, f"{place}: ")
        place += {dict: ": each", list: ": an entry"}.get(get_origin(annotation), "")
        for each in get_args(annotation):
            look(place, each)

    def look_in(model: type[Block], before: str = "") -> None:
        for name, field in model.model_fields.items():
            look(f"{before}{name}", field.annotation)

    for kind in kinds:
        look_in(kind)
    own = {BallBlock, *METHOD_BLOCKS.values()} | {m for k in kinds for m in mappings(k).values()}
    return {place: model for model, place in found.items() if model not in own}


def own_fields(kind: type[Picture]) -> list[str]:
    """Return the fields of a kind of picture that its base class lacks or declares differently."""
    base = (Scene if issubclass(kind, Scene) else Picture).model_fields
    inherited = {key: (field.annotation, field.metadata) for key, field in base.items()}
    own = kind.model_fields.items()
    return [key for key, field in own if inherited.get(key) != (field.annotation, field.metadata)]


def key_of(name: str) -> str:
    """Return the key of config.yaml whose shipped scenes include one of a kind, or `scenes`."""
    shipped = with_shipped({})
    assert isinstance(shipped, dict)
    kinds = {each.key: each.kind for each in SETS.values()}
    for key in kinds.keys() & shipped.keys():
        if name in {scene.get("picture", kinds[key]) for scene in shipped[key].values()}:
            return key
    return "scenes"


def listed(model: type[Block], keys: Iterable[str] = ()) -> str:
    """Return a Markdown list of the fields `keys` of a model, by default of all its fields.

    An item has the field's default, its meaning and what is allowed.
    """
    schema, items = model.model_json_schema(schema_generator=Described), []
    for key in keys or schema["properties"]:
        field = schema["properties"][key]
        if "default" in field:
            default = f"default `{field['default']}`"
        else:
            default = "required" if key in schema.get("required", ()) else "optional"
        if field["description"].startswith("Allowed: "):
            raise ValueError(f"{model.__name__}.{key} has no docstring")
        meaning = field["description"].replace(" Allowed: ", " *Allowed:* ")
        text = f"- `{key}` ({default}): {meaning}"
        items.append(fill(text, 100, subsequent_indent="  ", break_on_hyphens=False))
    return "\n".join(items)


if __name__ == "__main__":
    write_whole(ROOT / "docs" / "config.md", page())
