"""The page docs/config.md, written from the declarations and the template reference.md.

Run `.venv/bin/python -m pipeline.config.reference` to renew it.
"""

from collections.abc import Iterable
from importlib import import_module
from pathlib import Path
from textwrap import dedent, fill
from typing import Any

import jinja2

from ..declaration import files
from ..records.files import write_whole
from ..records.sources import ROOT
from .json_schema import Described
from .schema import fields
from .schema.fields import Block, fields_of
from .schema.kinds import KINDS
from .schema.method import METHOD_BLOCKS
from .schema.scene import Picture, Scene
from .schema.sets import PAPER, SETS
from .schema.stages import STAGES, upstream
from .schema.variant import Variant
from .validation.document import BLOCKS
from .validation.reading import with_shipped

EXAMPLES = (Path(__file__).parent / "schema" / "kinds" / "examples.yaml", *files("examples.yaml"))


def page() -> str:
    """Return the text of the page."""
    text = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")
    template = jinja2.Template(
        text, trim_blocks=True, keep_trailing_newline=True, undefined=jinja2.StrictUndefined
    )
    declared: tuple[Any, ...] = (Scene, Variant, example, has_picture, key_of, listed)
    declared += (mappings, own_fields, quoted, upstream)
    names = {each.__name__: each for each in declared}
    tables = {"KINDS": KINDS, "STAGES": STAGES, "METHOD_BLOCKS": METHOD_BLOCKS, "BLOCKS": BLOCKS}
    sets = {each.key: each for name, each in SETS.items() if each.key and name != PAPER}
    return str(template.render(names | tables, SETS=sets, fields=fields))


def example(name: str) -> str:
    """Return the example of a kind of picture as YAML, a block of `scenes:`."""
    for file in EXAMPLES:
        _, _, text = f"\n{file.read_text(encoding='utf-8')}".partition(f"\n{name}:\n")
        if text:
            return dedent(text.partition("\n\n")[0]).rstrip()
    raise LookupError(f"{name}: no example")


def mappings(kind: type[Picture]) -> dict[str, type[Block]]:
    """Return the blocks that only this kind has as values, by the fields."""
    module = import_module(kind.__module__)
    return {
        name.lower(): value
        for name, value in vars(module).items()
        if isinstance(value, type)
        and issubclass(value, Block)
        and not issubclass(value, Picture)
        and value.__module__ == kind.__module__
    }


def own_fields(kind: type[Picture]) -> list[str]:
    """Return the fields of a kind of picture that not every scene has, or that differ from it."""
    base = fields_of(Scene if issubclass(kind, Scene) else Picture)
    shared = {key: (field.annotation, field.metadata) for key, field in base.items()}
    own = fields_of(kind).items()
    return [key for key, f in own if shared.get(key) != (f.annotation, f.metadata)]


def has_picture(kind: type[Picture]) -> bool:
    """Return whether scenes of a kind are drawn."""
    return bool(kind.model_fields["formats"].default)


def key_of(name: str) -> str:
    """Return the key of config.yaml whose shipped block has scenes of a kind, or `scenes`."""
    shipped = with_shipped({})
    assert isinstance(shipped, dict)
    kinds = {each.key: each.kind for each in SETS.values()}
    for key in kinds.keys() & shipped.keys():
        if name in {scene.get("picture", kinds[key]) for scene in shipped[key].values()}:
            return key
    return "scenes"


def listed(model: type[Block], keys: Iterable[str] = ()) -> str:
    """List fields of a model, or all of them, with their meanings and what they allow."""
    described, items = model.model_json_schema(schema_generator=Described), []
    for key in keys or described["properties"]:
        field = described["properties"][key]
        if "default" in field:
            default = f"default `{field['default']}`"
        else:
            default = "required" if key in described.get("required", ()) else "optional"
        if field["description"].startswith("Allowed: "):
            raise ValueError(f"{model.__name__}.{key} has no docstring")
        words = field["description"].replace(" Allowed: ", " *Allowed:* ")
        text = f"- `{key}` ({default}): {words}"
        items.append(fill(text, 100, subsequent_indent="  ", break_on_hyphens=False))
    return "\n".join(items)


def quoted(names: Iterable[str]) -> str:
    """Return names in backquotes, with commas between them."""
    return ", ".join(f"`{name}`" for name in names)


if __name__ == "__main__":
    write_whole(ROOT / "docs" / "config.md", page())
