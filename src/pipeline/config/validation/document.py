"""Reading of config.yaml, and its validation: a complete config, or all mistakes at once."""

import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import yaml
from pydantic import create_model

from pseudorigid.dynamics.bounds import g_mistake

from ...command_list import all_commands
from ...declaration import ONLY_SET, SRC, SourceError, files, imported
from ...loading import note_loaded
from ...records.files import read_text, read_yaml
from ..results import Config, Variants
from ..schema.fields import ABSENT, BallBlock, Block, Name, YamlMapping, allowed
from ..schema.parts import BLOCKS, MAIN, SETS
from ..schema.scene import VARIANTS, Picture
from . import scenes
from .mistakes import ConfigError, Mistake, refusal, validate
from .variants import add_variants

_SCENES = Annotated[dict[Name, Any], allowed("a mapping from names to scenes")]
_AT_LEAST_ONE = allowed("a mapping from names to scenes, at least one", min_length=1)
_FIELDS: dict[str, Any] = {
    "ball": (BallBlock, ...),
    "scenes": (dict[Name, Any], _AT_LEAST_ONE),
    "variants": (VARIANTS, {}),
    **{each.key: (_SCENES, {}) for name, each in SETS.items() if each.key and name != MAIN},
    **{key: (block, ABSENT) for key, block in BLOCKS.items()},
}
Document: Any = create_model("Document", __base__=Block, **_FIELDS)


def load(path: str | Path) -> Config:
    """Return the checked config of a file with the shipped blocks; raise ConfigError."""
    path = Path(path)
    try:
        document, alone = _parse(path), os.environ.get(ONLY_SET) == MAIN
        config = check(document if alone else with_shipped(document), alone)
        faulty = {n: [_located(path, each) for each in of] for n, of in config.faulty.items()}
        return replace(config, faulty=faulty)
    except ConfigError as error:
        raise ConfigError(*(_located(path, mistake) for mistake in error.mistakes)) from None
    except RecursionError:
        raise ConfigError(f"{path.name}: nested too deeply") from None


def _located(path: Path, mistake: Mistake | str) -> str:
    """Return a line about a mistake, with the file and the line of its key, or of the key above.

    The file is config.yaml or the shipped one that has the block. If the block is that of a part,
    the line says which command it concerns.
    """
    if isinstance(mistake, str):
        return f"{path.name}: {mistake}"
    keys, name = [*mistake.place, *filter(None, [mistake.key])], path.name
    key, among_others = keys[0] if keys else "", keys[:1] == ["variants"] and len(keys) > 1
    for file in (path, *(files("scenes.yaml").values() if key != "ball" else ())):
        found = [*_lines_of(keys, yaml.compose(read_text(file), _Loader))]
        if len(found) > among_others:
            name = path.name if file == path else os.path.relpath(file, SRC.parent)
            name += f": line {found[-1]}"
            break
    owners = [each.command for n, each in SETS.items() if key and n != MAIN and each.key == key]
    owners += [f"the part {BLOCKS[key].__module__.split('.')[-2]}"] if key in BLOCKS else []
    of = "".join(f" (this concerns {each} alone)" for each in owners)
    return f"{name}: {mistake}{of}"


def _lines_of(keys: Sequence[int | str], node: yaml.Node | None) -> Iterator[int]:
    """Yield the line of each of the nested keys and indices, as far as a YAML node has them."""
    for key in keys:
        if isinstance(node, yaml.SequenceNode):
            items = {i: (item, item) for i, item in enumerate(node.value)}
        elif isinstance(node, yaml.MappingNode):
            _Loader("").flatten_mapping(node)  # puts what `<<` names among its keys
            items = {each.value: (each, value) for each, value in node.value}
        else:
            return
        if key not in items:
            return
        at, node = items[key]
        yield at.start_mark.line + 1


def check(given: object, main_alone: bool = False) -> Config:
    """Return the complete config of a parsed YAML document, or the main set of scenes alone.

    Raises ConfigError with all mistakes, unless they are in variants alone.
    """
    blocks = given.items() if isinstance(given, dict) else ()
    mappings = {key: block for key, block in blocks if isinstance(block, dict)}
    own = mappings.get("variants", {})  # validated one by one
    document, mistakes = validate(Document, dict(blocks) | {"variants": {}} if own else given, ())
    ball, _ = validate(BallBlock, mappings.get("ball"), ())
    if ball and (words := g_mistake(ball.k, ball.g)):
        mistakes.append(refusal(("ball", "g"), ball.g, words))
        ball = None
    own_ball = ball.as_mapping() if ball else None
    sets = Variants()
    for name, declared in SETS.items():
        if name == MAIN or declared.key in mappings or not main_alone:
            sets[name], more = _scenes_of_set(name, mappings, own_ball)
            mistakes += more
    config = Config(sets, {}, document, {}, {})
    add_variants(config, own, mappings.get("scenes", {}), None if mistakes else own_ball)
    if mistakes or document is None:
        faulty = (mistake for each in config.faulty.values() for mistake in each)
        raise ConfigError(*dict.fromkeys([*mistakes, *faulty]))
    return replace(config, variants={MAIN: sets[MAIN]}) if main_alone else config


def _scenes_of_set(
    name: str, mappings: YamlMapping, ball: YamlMapping | None
) -> tuple[dict[str, Picture], list[Mistake]]:
    """Return the scenes of a set that can be checked, and the mistakes in all."""
    declared, found, mistakes = SETS[name], dict[str, Picture](), list[Mistake]()
    key = declared.key or name
    given = imported(declared.scenes)() if declared.scenes else mappings.get(key, {})
    kind = {"picture": declared.kind} if declared.kind else {}
    given = {s: kind | block if isinstance(block, dict) else block for s, block in given.items()}
    for scene, block in given.items():
        checked, more = scenes.check_scene(block, ball, (key, scene), given)
        mistakes += more
        if scene in all_commands() or scene == "all":
            words = "a name that is no command of ./reproduce"
            mistakes.append(refusal((key,), scene, words, key=scene))
        if name != MAIN and scene in mappings.get("scenes", {}):
            words = f"a name that no scene of the {MAIN} has"
            mistakes.append(refusal((key,), scene, words, key=scene))
        if checked:
            found[scene] = checked
    return found, mistakes


def with_shipped(document: object) -> object:
    """Add the shipped blocks that a document does not have, and the shipped variants.

    A block of the same name in the document replaces a shipped one. The `ball` of a shipped file
    is that of its scenes.
    """
    if not isinstance(document, dict):
        return document
    shipped: YamlMapping = {}
    for file in files("scenes.yaml").values():
        try:
            parsed: Any = _parse(file)
            parsed = {key: {**block} for key, block in {**parsed}.items()}
        except (ConfigError, TypeError) as error:  # TypeError: no mapping
            raise SourceError(file, error) from None
        ball = parsed.pop("ball", None)
        for key, block in parsed.items():
            for name, scene in block.items() if ball and key != "variants" else ():
                if isinstance(scene, dict) and "energy" in scene:  # it is of a ball's motion
                    block[name] = {"ball": ball} | scene
            shipped[key] = shipped.get(key, {}) | block
    variants = document.get("variants", {})
    if isinstance(variants, dict):
        document = document | {"variants": variants | shipped.pop("variants", {}) | variants}
    return shipped | document


class _Loader(yaml.SafeLoader):
    """A YAML loader that refuses duplicate keys, keys that are no text, and what misleads.

    It reads 1e-3 as a number, as YAML 1.2 does. What YAML 1.1 takes for another value than 1.2, or
    than a reader, misleads: 012 is 10, 1:30 is 90, and yes is true.
    """

    def compose_mapping_node(self, anchor: Any) -> yaml.MappingNode:
        node, seen = super().compose_mapping_node(anchor), set[str]()
        for key, _ in node.value:  # before a merge adds keys, which the mapping may override
            if isinstance(key, yaml.ScalarNode):  # PyYAML itself refuses lists and mappings
                if key.value in seen:
                    raise _mistake(
                        key.start_mark, f"not valid YAML: the key {key.value} is given twice"
                    )
                if key.tag.rpartition(":")[2] not in ("str", "merge"):
                    words = f"the key {key.value} is no text in YAML 1.1: write '{key.value}'"
                    raise _mistake(key.start_mark, words)
                seen.add(key.value)
        return node

    def construct_scalar(self, node: yaml.ScalarNode | yaml.MappingNode) -> Any:
        text = super().construct_scalar(node)
        if node.tag.endswith((":int", ":float", ":bool")) and _MISLEADING.fullmatch(text):
            value = str(yaml.safe_load(text)).lower()
            words = f"{text} means {value} in YAML 1.1: write {value} or what you mean"
            raise _mistake(node.start_mark, f"{words}; a text is '{text}', in quotes")
        return text


def _mistake(mark: yaml.Mark | None, words: str) -> ConfigError:
    """Return the error of a mistake, with its place if that is known."""
    place = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
    return ConfigError(f"{place}{words}")


_MISLEADING = re.compile("(?i)yes|no|on|off|[-+]?0[0-7_]+|.*:.*")  # octal, and to base 60
_NUMBER = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)[eE][-+]?[0-9]+$")
_Loader.add_implicit_resolver("tag:yaml.org,2002:float", _NUMBER, [*"-+.0123456789"])


def _parse(path: Path) -> object:
    try:
        text = read_yaml(path)
    except ValueError as error:
        raise ConfigError(str(error)) from None
    note_loaded(path, text.encode())
    try:
        return yaml.load(text, _Loader)
    except (yaml.YAMLError, ValueError) as error:  # ValueError: an impossible date
        problem = getattr(error, "problem", None) or str(error).splitlines()[0]
        mark = getattr(error, "problem_mark", None)
        raise _mistake(mark, f"not valid YAML: {problem}") from None
    except (LookupError, AttributeError):  # raised by PyYAML for `!!bool x`
        raise ConfigError("not valid YAML: a value that is not what its !!tag says") from None
