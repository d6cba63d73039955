"""Describe in words how two config blocks, sets of files or sets of packages differ."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any


def differing_keys(before: Any, after: Any, place: str = "") -> Iterator[tuple[str, Any, Any]]:
    """Yield each key whose values differ, dotted as in `starts[2].x`, and the two values.

    Of two lists, only the first entry that differs is reported, and the lengths if they differ.
    Values are compared as JSON: 1 differs from 1.0 and from true.
    """
    if isinstance(before, dict) and isinstance(after, dict):
        for key in sorted({*before, *after}):
            where = f"{place}.{key}" if place else key
            if key not in before or key not in after:
                yield where, before.get(key, "nothing"), after.get(key, "nothing")
            else:
                yield from differing_keys(before[key], after[key], where)
    elif isinstance(before, list) and isinstance(after, list):
        for i, (old, new) in enumerate(zip(before, after, strict=False)):
            if different := list(differing_keys(old, new, f"{place}[{i}]")):
                yield from different
                break
        if len(before) != len(after):
            yield f"{place}: number of entries", len(before), len(after)
    elif json.dumps(before) != json.dumps(after):
        yield place, before, after


def differing_block(
    before: dict[str, Any], after: dict[str, Any], was: str = "", now: str = ""
) -> str | None:
    """Describe every key that differs between two blocks of config; None if there is none.

    A description reads `key old -> new` or, with `was` and `now`, `key: old {was}, new {now}`.
    """
    form = f"{{}}: {{}} {was}, {{}} {now}" if was else "{} {} -> {}"
    different = differing_keys(before, after)
    return (
        "; ".join(form.format(key, brief(old), brief(new)) for key, old, new in different) or None
    )


def differing_files(
    before: Mapping[str, str | None], after: Mapping[str, str | None]
) -> str | None:
    """Name the first file whose hash differs; None if there is none. A hash of None says: gone."""
    different = [path for path in sorted({*before, *after}) if before.get(path) != after.get(path)]
    if not different:
        return None
    path = different[0]
    verb = "is new" if path not in before else "is gone" if after.get(path) is None else "differs"
    others = f" (and {len(different) - 1} more)" if len(different) > 1 else ""
    return f"{path} {verb}{others}"


def differing_package(
    before: Mapping[str, str | None], after: Mapping[str, str | None], was: str = "then"
) -> str | None:
    """Describe every package whose version differs; None if there is none."""
    words = []
    for name in (name for name in sorted({*before, *after}) if before.get(name) != after.get(name)):
        here = f"{after[name]} here" if after.get(name) else "not installed here"
        words.append(f"{name} {before.get(name)} {was}, {here}")
    return "; ".join(words) or None


def differing_origin(
    before: Mapping[str, Any], after: Mapping[str, Any], was: str = "", now: str = ""
) -> dict[str, str]:
    """Compare what a result was made from with what it is made from now: layer -> difference.

    Both mappings have the block of config, the hashes of the sources and the environment. Layers
    without a difference are left out.
    """
    packages = before["environment"], after["environment"]
    layers = {
        "config": differing_block(before["config"], after["config"], was, now),
        "source": differing_files(before["sources"], after["sources"]),
        "environment": differing_package(*packages, was or "then"),
    }
    return {layer: words for layer, words in layers.items() if words}


def brief(value: Any) -> str:
    """Return a value as text of at most 40 characters."""
    text = value if isinstance(value, str) else json.dumps(value)
    return text if len(text) <= 40 else text[:37] + "..."


def columns(rows: Iterable[Sequence[str]]) -> list[str]:
    """Format rows of texts, all of one length, as lines with aligned columns."""
    rows = list(rows)
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    padded = [[f"{text:{w}}" for text, w in zip(row, widths, strict=True)] for row in rows]
    return ["  ".join(row).rstrip() for row in padded]
