"""Describe in words how two records of one result differ."""

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


def differing_layers(
    before: Mapping[str, Any], after: Mapping[str, Any], was: str = "", now: str = ""
) -> dict[str, str]:
    """Compare what makes one result in two records: layer -> how `after` differs, the cause first.

    The layers are config, source and environment, without those that have no difference. With `was`
    and `now`, values of config and versions of packages are named by where they stand.
    """
    form = f"{{}}: {{}} {was}, {{}} {now}" if was else "{} {} -> {}"
    blocks = differing_keys(before["config"], after["config"])
    old, new = before["environment"], after["environment"]
    packages = (
        f"{name} {old.get(name)} {was or 'then'}, {new.get(name) or 'not installed'} here"
        for name in differing_names(old, new)
    )
    layers = {
        "config": "; ".join(form.format(key, brief(old), brief(new)) for key, old, new in blocks),
        "source": _differing_files(before["sources"], after["sources"]),
        "environment": "; ".join(packages),
    }
    return {layer: words for layer, words in layers.items() if words}


def differing_names(before: Mapping[str, Any], after: Mapping[str, Any]) -> list[str]:
    """Return the sorted keys whose values differ; None stands for no value."""
    return [key for key in sorted({*before, *after}) if before.get(key) != after.get(key)]


def _differing_files(before: Mapping[str, str | None], after: Mapping[str, str | None]) -> str:
    """Name the first file whose hash differs, or return "". A hash of None says: gone."""
    path, *others = differing_names(before, after) or [""]
    verb = "is new" if path not in before else "is gone" if after.get(path) is None else "differs"
    more = f" (and {len(others)} more)" if others else ""
    return path and f"{path} {verb}{more}"


def differing_data(before: Mapping[str, Any], after: Mapping[str, Any]) -> str | None:
    """Describe the first difference of two descriptions of a dataset; None without one."""
    old, new = before.get("variables", {}), after["variables"]
    for name in differing_names(old, new):
        return f"variable {name}{_differing_variable(old.get(name), new.get(name))}"
    names = differing_names(before.get("attributes", {}), after["attributes"])
    verb = "attributes {} differ" if len(names) > 1 else "attribute {} differs"
    return verb.format(", ".join(names)) if names else None


def _differing_variable(old: Mapping[str, Any] | None, new: Mapping[str, Any] | None) -> str:
    """Describe the first difference of two descriptions of a variable."""
    if old is None or new is None:
        return f" is {'new' if old is None else 'gone'}"
    for what in ("dims", "dtype", "shape", "attributes"):
        if old.get(what) != new[what]:
            words = "" if what == "attributes" else f": {old.get(what)} then, {new[what]} now"
            return f": another {what.removesuffix('s')}{words}"
    return " differs"


def brief(value: Any) -> str:
    """Return a value as text of at most 40 characters."""
    text = value if isinstance(value, str) else json.dumps(value)
    return text if len(text) <= 40 else text[:37] + "..."


def columns(rows: Iterable[Sequence[str]]) -> list[str]:
    """Format rows of texts, all of one length, as lines with aligned columns."""
    rows = list(rows)
    form = "  ".join(f"{{:{max(map(len, column))}}}" for column in zip(*rows, strict=True))
    return [form.format(*row).rstrip() for row in rows]
