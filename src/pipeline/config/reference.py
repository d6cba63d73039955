"""Documentation of config.yaml from the declarations: docs/config.md, and sections for parts.

docs/config.md has the ball, variants and the scenes of the main set. The fields of another part's
scenes stand on the page of the part.
"""

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from textwrap import dedent, fill
from typing import Any, get_args, get_origin

import jinja2

from ..declaration import files, imported, parts
from ..records.sources import ROOT
from .json_schema import Described
from .schema import fields
from .schema.fields import BallBlock, Block
from .schema.kinds import KINDS
from .schema.method import METHOD_BLOCKS, Scan
from .schema.scene import Picture, Scene
from .schema.sets import MAIN, SETS
from .schema.stages import upstream
from .schema.variant import Variant
from .validation.document import with_shipped

EXAMPLES = tuple(files("examples.yaml").values())
_MAIN_PART = next(name for name, part in parts().items() if MAIN in part.sets)
_OTHERS = {name: part for name, part in parts().items() if name != _MAIN_PART}


def page() -> str:
    """Return the text of docs/config.md."""
    return _rendered("page", _MAIN_PART)


def section(part: str) -> str:
    """Return the fields of a part's scenes as a section of its page; empty if it adds none."""
    if part not in _OTHERS or not (kinds_of(part) or blocks_of(part)):
        return ""
    return _rendered("section", part)


def table_of_parts() -> str:
    """Return a table of the commands of all parts but the main one, for README.md."""
    lines = ["| part | command | what it does |", "|---|---|---|"]
    for name, part in _OTHERS.items():
        for command, each in part.commands.items():
            lines.append(f"| {_link(name)} | `./reproduce {command}` | {each.line} |")
    return "\n".join(["", *lines, "", ""])


def _link(part: str, up: str = "") -> str:
    """Return a part's name as a link to its page, if it has one."""
    pages = {file.parent.name: file.relative_to(ROOT) for file in files("README.md").values()}
    return f"[{part}]({up}{pages[part]})" if part in pages else part


def others() -> Iterator[tuple[str, str, str, str]]:
    """Yield each key of config.yaml of another part, its command, folder and the part's page."""
    for name, part in _OTHERS.items():
        for each in part.sets.values():
            if each.key:
                yield each.key, each.command, each.folder, _link(name, "../")
        for key in part.settings:
            yield key, "", "", _link(name, "../")


def kinds_of(part: str) -> dict[str, type[Picture]]:
    """Return the kinds of picture that a part declares, by their names."""
    return {n: kind for n, kind in KINDS.items() if kind.__module__.split(".")[-2] == part}


def blocks_of(part: str) -> dict[str, type[Block]]:
    """Return the classes of other blocks that a part declares, by the words of a heading."""
    declared = parts()[part]
    methods = {f"method: {key}": place for key, place in declared.methods.items()}
    return {key: imported(place) for key, place in {**declared.settings, **methods}.items()}


def example(name: str) -> str:
    """Return the YAML text of an example scene of a kind of picture."""
    for file in EXAMPLES:
        _, _, text = f"\n{file.read_text(encoding='utf-8')}".partition(f"\n{name}:\n")
        if text:
            return dedent(text.partition("\n\n")[0]).rstrip()
    raise LookupError(f"{name}: no example")


def nested(part: str) -> dict[str, type[Block]]:
    """Map places in a part's scenes to the Block classes there that the main part does not use."""
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

    for kind in kinds_of(part).values():
        look_in(kind)
    known = {BallBlock, *METHOD_BLOCKS.values()}
    known |= {*nested(_MAIN_PART).values()} if part != _MAIN_PART else set()
    return {place: model for model, place in found.items() if model not in known}


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


def listed(model: type[Block]) -> str:
    """Return a Markdown list of the fields of a model."""
    return "\n".join(_items(model).values())


def listed_of_kind(name: str, part: str) -> str:
    """Return a Markdown list of a kind's own fields, where each field is described once.

    A field that an earlier kind, of the main part or of this one, has too is only named.
    """
    earlier: dict[str, str] = {}  # item -> the first kind with it
    for each, kind in (kinds_of(_MAIN_PART) | kinds_of(part)).items():
        items = {key: _items(kind)[key] for key in own_fields(kind)}
        if each == name:
            break
        earlier = {item: each for item in items.values()} | earlier
    same: dict[str, list[str]] = {}
    for key, item in items.items():
        same.setdefault(earlier.get(item, ""), []).append(key)
    lines = [items[key] for key in same.pop("", [])]
    for other, keys in same.items():
        elsewhere = part != _MAIN_PART and other in kinds_of(_MAIN_PART)
        text = f"- {', '.join(f'`{key}`' for key in keys)}: as of `{other}`"
        text += " (`docs/config.md`)." if elsewhere else "."
        lines.append(fill(text, 100, subsequent_indent="  "))
    return "\n".join(lines)


@cache
def _items(model: type[Block]) -> dict[str, str]:
    """Return items of a Markdown list: each field's default, meaning and what is allowed."""
    schema, items = model.model_json_schema(schema_generator=Described), {}
    for key, field in schema["properties"].items():
        if "default" in field:
            default = f"default `{field['default']}`"
        else:
            default = "required" if key in schema.get("required", ()) else "optional"
        if field["description"].startswith("Allowed: "):
            raise ValueError(f"{model.__name__}.{key} has no docstring")
        meaning = field["description"].replace(" Allowed: ", " *Allowed:* ")
        text = f"- `{key}` ({default}): {meaning}"
        items[key] = fill(text, 100, subsequent_indent="  ", break_on_hyphens=False)
    return items


def _rendered(template: str, part: str) -> str:
    """Return what a template of reference_templates/ makes of a part."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).with_name("reference_templates")),
        trim_blocks=True,
        keep_trailing_newline=True,
        undefined=jinja2.StrictUndefined,
    )
    used: tuple[Any, ...] = (Scene, Variant, Scan, key_of, listed, nested, listed_of_kind)
    used += (own_fields, upstream, others, kinds_of, blocks_of, parts)
    environment.globals |= {each.__name__: each for each in used} | {"fields": fields}
    text = environment.get_template(f"{template}.md").render(part=part)
    return re.sub(r"\n{3,}", "\n\n", text)
