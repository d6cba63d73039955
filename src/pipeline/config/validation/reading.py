"""Reading of config.yaml."""

import re
from collections.abc import Hashable
from pathlib import Path
from typing import Any

import yaml

from ...declaration import files
from ...loading import note_loaded
from ...records.files import FileError, read_bytes
from ..paths import Config
from ..schema.fields import YamlMapping
from .document import check
from .words import ConfigError

# Largest size of a config, in bytes. A larger file is a slip and would take long to parse. (The
# faster parser of libyaml is not used: it crashes on deeply nested text.)
LARGEST_FILE = 500_000


class _Loader(yaml.SafeLoader):
    """A YAML loader that refuses duplicate keys, and reads 1e-3 as a number, as YAML 1.2 does."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Hashable, Any]:
        seen: set[str] = set()
        keys = [key for key, _ in node.value] if isinstance(node, yaml.MappingNode) else []
        for key in keys:
            if isinstance(key, yaml.ScalarNode):  # PyYAML itself refuses lists and mappings
                if key.value in seen:
                    problem = f"the key {key.value} is given twice"
                    raise yaml.MarkedYAMLError(problem=problem, problem_mark=key.start_mark)
                seen.add(key.value)
        return super().construct_mapping(node, deep)


_NUMBER = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)[eE][-+]?[0-9]+$")
_Loader.add_implicit_resolver("tag:yaml.org,2002:float", _NUMBER, [*"-+.0123456789"])


# Blocks that are shipped. A block of the same name in config.yaml replaces them.
_STUDY = Path(__file__).parents[1] / "study.yaml"


def load(path: str | Path) -> Config:
    """Return the checked config of a file with the shipped blocks; raise ConfigError."""
    path = Path(path)
    try:
        return check(with_shipped(_parse(path)))
    except ConfigError as error:
        raise ConfigError(*(f"{path.name}: {line}" for line in error.lines)) from None
    except RecursionError:
        raise ConfigError(f"{path.name}: nested too deeply") from None


def with_shipped(document: object) -> object:
    """Add the shipped blocks that a document does not have, and the shipped variants.

    The `ball` of a shipped file is that of its scenes.
    """
    if not isinstance(document, dict):
        return document
    shipped: YamlMapping = {}
    for file in (_STUDY, *files("scenes.yaml")):
        parsed: Any = _parse(file)
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
