"""The page docs/config.md, written from the declarations and the template reference.md.

Run `.venv/bin/python -m pipeline.config.reference` to renew it.
"""

from collections.abc import Iterable
from pathlib import Path
from textwrap import dedent, fill

import jinja2

from ..records.files import write_whole
from ..records.sources import ROOT
from .json_schema import Described
from .schema import fields
from .schema.fields import Block, fields_of
from .schema.kinds import KINDS
from .schema.scene import Scene
from .schema.stages import STAGES, upstream
from .schema.sweep import Span, Sweep
from .schema.variant import Prove, Variant

EXAMPLES = Path(__file__).parent / "schema" / "kinds" / "examples.yaml"


def page() -> str:
    """Return the text of the page."""
    text = Path(__file__).with_suffix(".md").read_text(encoding="utf-8")
    template = jinja2.Template(
        text, trim_blocks=True, keep_trailing_newline=True, undefined=jinja2.StrictUndefined
    )
    declared = (Prove, Scene, Span, Sweep, Variant, example, listed, own_fields, quoted, upstream)
    names = {each.__name__: each for each in declared}
    return str(template.render(names, KINDS=KINDS, STAGES=STAGES, fields=fields))


def example(name: str) -> str:
    """Return the example of a kind of picture as YAML, a block of `scenes:`."""
    _, _, text = EXAMPLES.read_text(encoding="utf-8").partition(f"\n{name}:\n")
    return dedent(text.partition("\n\n")[0]).rstrip()


def own_fields(kind: type[Scene]) -> list[str]:
    """Return the fields of a kind of picture that not every scene has, or that differ from it."""
    of_scene = {key: field.annotation for key, field in Scene.model_fields.items()}
    own = fields_of(kind).items()
    return [k for k, field in own if k not in of_scene or field.annotation != of_scene[k]]


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
