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
    page = _page_of(part)
    return f"[{part}]({up}{page})" if page else part


def _page_of(part: str) -> Path | None:
    """Return the page of a part, from the root, if it has one."""
    pages = {file.parent.name: file.relative_to(ROOT) for file in files("README.md").values()}
    return pages.get(part)


def others() -> Iterator[tuple[str, str, str]]:
    """Yield each key of config.yaml of another part, its command, and the part's page."""
    for name, part in _OTHERS.items():
        for each in part.sets.values():
            if each.key:
                yield each.key, each.command, _link(name, "../")
        for key in part.settings:
            yield key, "", _link(name, "../")


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


def place_of(name: str) -> str:
    """Return where scenes of a kind stand, and which blocks of other scenes they lack."""
    without = "" if "ball" in KINDS[name].model_fields else ", without ball, energy and method"
    return f"under `{key_of(name)}:`{without}"


def common_place(part: str) -> str:
    """Return the place of all scenes of a part's kinds; empty if they differ."""
    places = {place_of(name) for name in kinds_of(part)}
    return places.pop() if len(places) == 1 else ""


def listed(model: type[Block]) -> str:
    """Return a Markdown list of the fields of a model."""
    return "\n".join(_items(model).values())


def listed_of_kind(name: str, part: str) -> str:
    """Return a Markdown list of a kind's own fields, where each field is described once.

    A field that an earlier kind has too, also of a part that this one needs, is only named.
    """
    pages = {_MAIN_PART: " (`docs/config.md`)"}
    pages |= {each: f" (`{_page_of(each)}`)" for each in parts()[part].needs if each not in pages}
    pages[part] = ""
    place = {each: page for other, page in pages.items() for each in kinds_of(other)}
    earlier: dict[str, str] = {}  # item -> the first kind with it
    for each in place:
        items = {key: _items(KINDS[each])[key] for key in own_fields(KINDS[each])}
        if each == name:
            break
        earlier = {item: each for item in items.values()} | earlier
    same: dict[str, list[str]] = {}
    for key, item in items.items():
        same.setdefault(earlier.get(item, ""), []).append(key)
    lines = [items[key] for key in same.pop("", [])]
    for other, keys in same.items():
        text = f"- {', '.join(f'`{key}`' for key in keys)}: as of `{other}`{place[other]}."
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
    used: tuple[Any, ...] = (Scene, Variant, Scan, place_of, common_place, listed, nested)
    used += (listed_of_kind, own_fields, upstream, others, kinds_of, blocks_of, parts)
    environment.globals |= {each.__name__: each for each in used} | {"fields": fields}
    text = environment.get_template(f"{template}.md").render(part=part)
    return re.sub(r"\n{3,}", "\n\n", text)
