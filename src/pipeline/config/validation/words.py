"""The form of error messages about the config: place, value, and what is allowed."""

from collections.abc import Iterable, Iterator
from itertools import islice

from ...records.names import suggestion

Place = tuple[int | str, ...]  # keys and indices that lead to a value
_LONGEST_VALUE = 60  # characters of a value in a message


class ConfigError(Exception):
    """Mistakes in the config, a line for each: place, value, and what is allowed."""

    def __init__(self, *lines: str) -> None:
        # A key may contain line breaks, but a mistake must stay on its line.
        self.lines = tuple(
            "".join(c if c.isprintable() else repr(c)[1:-1] for c in line) for line in lines
        )
        super().__init__("\n".join(self.lines))


def refusal(place: Place, value: object, allowed: str) -> str:
    """Return the line for a value that is not allowed."""
    where = f"{dotted(place)}: " if place else ""
    return f"{where}{_shown(value)} is not allowed: expected {allowed}"


def unknown(kind: str, name: str, known: Iterable[str]) -> str:
    """Say that there is no such thing, what may be meant, and what there is."""
    names = list(known)
    inventory = f"config.yaml has {', '.join(names) or 'none'}"
    return f"no {kind} {name}: " + f"{suggestion(name, names)} {inventory}".strip()


def dotted(place: Place) -> str:
    """Return a place in the config in the form scenes.fig2.starts[1]."""
    texts = (f"[{part}]" if isinstance(part, int) else f".{part}" for part in place)
    return "".join(texts).removeprefix(".")


def _shown(value: object) -> str:
    """Return a value as in YAML, shortened. Aliases in YAML can make a value of any size."""
    text = "".join(islice(_pieces(value), _LONGEST_VALUE + 1))
    return text if len(text) <= _LONGEST_VALUE else text[: _LONGEST_VALUE - 3] + "..."


def _pieces(value: object) -> Iterator[str]:
    """Yield the text of a value piece by piece."""
    if isinstance(value, dict | list):
        yield "{" if isinstance(value, dict) else "["
        for i, item in enumerate(value):
            if i:
                yield ", "
            yield from _pieces(item)
            if isinstance(value, dict):
                yield ": "
                yield from _pieces(value[item])
        yield "}" if isinstance(value, dict) else "]"
    elif value is None:
        yield "nothing"
    elif isinstance(value, int) and value.bit_length() > 14_000:  # too long for decimals
        yield hex(value)
    else:
        yield str(value).lower() if isinstance(value, bool) else repr(value)
