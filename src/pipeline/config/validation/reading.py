"""From the file to a checked config."""

from pathlib import Path

import yaml

import pseudorigid

from ...records.files import FileError, read_bytes
from .document import check
from .words import ConfigError

# Bytes of a config: what is larger is a slip, and would take long to parse. (The faster parser of
# libyaml is not used: it crashes where text is nested deeply.)
LARGEST = 500_000


class _Loader(yaml.SafeLoader):
    """YAML that refuses a key given twice, of which plain PyYAML keeps the last without a word."""

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key, _ in node.value if isinstance(node, yaml.MappingNode) else ():
            if not isinstance(key, yaml.ScalarNode):
                continue  # PyYAML itself refuses a list or a mapping as a key
            if key.value in seen:
                raise yaml.constructor.ConstructorError(
                    None, None, f"the key {key.value} is given twice", key.start_mark
                )
            seen.add(key.value)
        return super().construct_mapping(node, deep)


def load(path) -> dict:
    """The checked config; every scene complete with its `ball` and `formats`.

    Parameters
    ----------
    path : path

    Returns
    -------
    dict

    Raises
    ------
    ConfigError
        With a line to show for each mistake.
    """
    path = Path(path)
    try:
        return check(_parse(path))
    except ConfigError as error:
        raise ConfigError(*(f"{path.name}: {line}" for line in error.lines)) from None
    except RecursionError:
        raise ConfigError(f"{path.name}: nested too deeply") from None


def _parse(path):
    try:
        if path.is_file() and path.stat().st_size > LARGEST:
            raise ConfigError(f"has {path.stat().st_size} bytes: expected at most {LARGEST}")
        data = read_bytes(path)
        pseudorigid.note_loaded(path, data)
        return yaml.load(data.decode("utf-8"), _Loader)
    except FileError as error:
        raise ConfigError(str(error).removeprefix(f"{path}: ")) from None
    except OSError as error:
        raise ConfigError(f"cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise ConfigError(f"is not UTF-8 text: byte {error.start}") from None
    except (yaml.YAMLError, ValueError) as error:  # ValueError: a date that does not exist
        mark = getattr(error, "problem_mark", None)
        place = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
        problem = getattr(error, "problem", None) or str(error).splitlines()[0]
        raise ConfigError(f"{place}not valid YAML: {problem}") from None
    except (LookupError, AttributeError):  # what PyYAML makes of `!!bool x`
        raise ConfigError("not valid YAML: a value that is not what its !!tag says") from None
