"""The lines that say what is wrong in the config and what is allowed."""

import difflib
from itertools import islice


class ConfigError(Exception):
    """What is wrong in the config, a line for each mistake: place, value, and what is allowed."""

    def __init__(self, *lines: str):
        # A key may have line breaks in it: a mistake stays on its line.
        self.lines = tuple(
            "".join(c if c.isprintable() else repr(c)[1:-1] for c in line) for line in lines
        )
        super().__init__("\n".join(self.lines))


def refusal(place, value, allowed) -> str:
    """The line for a value that is not allowed."""
    where = f"{dotted(place)}: " if place else ""
    return f"{where}{shown(value)} is not allowed: expected {allowed}"


def unknown(kind, name, known) -> str:
    """In words that there is no such thing, and which was meant."""
    there = f"config.yaml has {', '.join(known) or 'none'}"
    return f"no {kind} {name}: {' '.join([*meant(name, known), there])}"


def meant(name, known) -> list[str]:
    """The question which was meant, of an unknown name; empty where none is near."""
    return [f"did you mean {near}?" for near in difflib.get_close_matches(str(name), known, 1, 0.5)]


def dotted(place) -> str:
    """A place in the config as scenes.fig2.starts[1]."""
    texts = (f"[{part}]" if isinstance(part, int) else f".{part}" for part in place)
    return "".join(texts).removeprefix(".")


def shown(value) -> str:
    """A value as in YAML, shortened to a part of a line."""
    # Aliases in YAML can make a value of any size.
    text = "".join(islice(_pieces(value), 61))
    return text if len(text) <= 60 else text[:57] + "..."


def _pieces(value):
    """What a value is written with, piece by piece."""
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
