"""Reading of config.yaml, and its validation: a complete config, or all mistakes at once."""

import re
from collections.abc import Hashable
from pathlib import Path
from typing import Annotated, Any

import yaml
from pydantic import create_model

from ...commands import all_commands
from ...declaration import SourceError, files, imported, parts
from ...loading import note_loaded
from ...records.files import FileError, read_bytes
from ..results import Config, Variants
from ..schema.fields import ABSENT, NOT_EMPTY, BallBlock, Block, Name, YamlMapping, allowed
from ..schema.scene import Picture
from ..schema.sets import MAIN, SETS
from ..schema.variant import Variant
from . import scenes
from .mistakes import ConfigError, refusal, validate

# Largest size of a config, in bytes. A larger file is a slip and would take long to parse. (The
# faster parser of libyaml is not used: it crashes on deeply nested text.)
LARGEST_FILE = 500_000
_SCENES = Annotated[dict[Name, Any], allowed("a mapping from names to scenes")]
_AT_LEAST_ONE = allowed("a mapping from names to scenes, at least one", min_length=1)
_VARIANTS = Annotated[
    dict[Name, Annotated[Variant, NOT_EMPTY]], allowed("a mapping from names to variants")
]
# Key -> the class of a block of a part that is no scenes.
BLOCKS: dict[str, type[Block]] = {
    key: imported(place) for each in parts().values() for key, place in each.settings.items()
}


class _Document(Block):
    """a mapping with the keys ball and scenes"""

    ball: BallBlock
    scenes: dict[Name, Any] = _AT_LEAST_ONE
    variants: _VARIANTS = {}


_OF_PARTS: dict[str, Any] = {
    **{each.key: (_SCENES, {}) for name, each in SETS.items() if each.key and name != MAIN},
    **{key: (block, ABSENT) for key, block in BLOCKS.items()},
}
Document = create_model("Document", __base__=_Document, __doc__=_Document.__doc__, **_OF_PARTS)


def load(path: str | Path) -> Config:
    """Return the checked config of a file with the shipped blocks; raise ConfigError."""
    path = Path(path)
    try:
        return check(with_shipped(_parse(path)))
    except ConfigError as error:
        raise ConfigError(*(f"{path.name}: {line}" for line in error.lines)) from None
    except RecursionError:
        raise ConfigError(f"{path.name}: nested too deeply") from None


def check(given: object) -> Config:
    """Return the complete config of a parsed YAML document.

    Raises ConfigError with a line for each mistake.
    """
    document, lines = validate(Document, given, ())
    blocks = given.items() if isinstance(given, dict) else ()
    mappings = {key: block for key, block in blocks if isinstance(block, dict)}
    ball, _ = validate(BallBlock, mappings.get("ball"), ())
    if ball and not ball.g < ball.k:
        lines.append(refusal(("ball", "g"), ball.g, f"0 < g < k = {ball.k}"))
        ball = None
    own_ball = ball.as_mapping() if ball else None
    variants, left_out = Variants(), dict[str, dict[str, str]]()
    for name in SETS:
        variants[name], more = _scenes_of_set(name, mappings, own_ball)
        lines += more
    if document and own_ball and not lines:
        for name, variant in document.variants.items():
            derived = scenes.derive_variant(mappings["scenes"], own_ball, name, variant)
            variants[name], left_out[name], more = derived
            lines += more
    if lines or document is None:
        raise ConfigError(*dict.fromkeys(lines))
    return Config(variants, left_out, {k: v for k, v in document if k in BLOCKS and v})


def _scenes_of_set(
    name: str, mappings: YamlMapping, ball: YamlMapping | None
) -> tuple[dict[str, Picture], list[str]]:
    """Return the scenes of a set that can be checked, and a line for each mistake."""
    declared, found, lines = SETS[name], dict[str, Picture](), list[str]()
    key = declared.key or name
    given = imported(declared.scenes)() if declared.scenes else mappings.get(key, {})
    if declared.kind:
        kind = {"picture": declared.kind}
        given = {
            s: kind | block if isinstance(block, dict) else block for s, block in given.items()
        }
    for scene, block in given.items():
        checked, mistakes = scenes.check_scene(block, ball, (key, scene), given)
        lines += mistakes
        if scene in all_commands() or scene == "all":
            lines.append(refusal((key,), scene, "a name that is no command of ./reproduce"))
        if name != MAIN and scene in mappings.get("scenes", {}):
            lines.append(refusal((key,), scene, f"a name that no scene of the {MAIN} has"))
        if checked:
            found[scene] = checked
    return found, lines


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
            own = ball if key != "variants" else None
            scenes = {name: _with_ball(scene, own) for name, scene in block.items()}
            shipped[key] = shipped.get(key, {}) | scenes
    variants = document.get("variants", {})
    if isinstance(variants, dict):
        document = document | {"variants": variants | shipped.pop("variants", {}) | variants}
    return shipped | document


def _with_ball(scene: Any, ball: YamlMapping | None) -> Any:
    """Return a scene with a ball, if there is one and it is a scene of a ball's motion."""
    of_ball = ball and isinstance(scene, dict) and "energy" in scene
    return {"ball": ball} | scene if of_ball else scene


class _Loader(yaml.SafeLoader):
    """A YAML loader that refuses duplicate keys, and reads 1e-3 as a number, as YAML 1.2 does."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Hashable, Any]:
        seen: set[str] = set()
        for key, _ in node.value if isinstance(node, yaml.MappingNode) else ():
            if isinstance(key, yaml.ScalarNode):  # PyYAML itself refuses lists and mappings
                if key.value in seen:
                    problem = f"the key {key.value} is given twice"
                    raise yaml.MarkedYAMLError(problem=problem, problem_mark=key.start_mark)
                seen.add(key.value)
        return super().construct_mapping(node, deep)


_NUMBER = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)[eE][-+]?[0-9]+$")
_Loader.add_implicit_resolver("tag:yaml.org,2002:float", _NUMBER, [*"-+.0123456789"])


def _parse(path: Path) -> object:
    try:
        if path.is_file() and path.stat().st_size > LARGEST_FILE:
            raise ConfigError(f"has {path.stat().st_size} bytes: expected at most {LARGEST_FILE}")
        data = read_bytes(path)
        note_loaded(path, data)
        return yaml.load(data.decode("utf-8"), _Loader)
    except FileError as error:
        raise ConfigError(str(error).removeprefix(f"{path}: ")) from None
    except OSError as error:
        raise ConfigError(f"cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise ConfigError(f"is not UTF-8 text: byte {error.start}") from None
    except (yaml.YAMLError, ValueError) as error:  # ValueError: an impossible date
        mark = getattr(error, "problem_mark", None)
        place = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
        problem = getattr(error, "problem", None) or str(error).splitlines()[0]
        raise ConfigError(f"{place}not valid YAML: {problem}") from None
    except (LookupError, AttributeError):  # raised by PyYAML for `!!bool x`
        raise ConfigError("not valid YAML: a value that is not what its !!tag says") from None
