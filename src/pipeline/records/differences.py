"""What differs between two blocks of config, two sets of files or of packages, in words."""

import json


def differing_keys(before, after, place=""):
    """Compare two blocks of config key by key.

    Of a list that differs, the first differing entry is told, and both lengths if they differ.

    Parameters
    ----------
    before, after : dict, list, str, number, bool or None
    place : str
        Dotted key of the blocks.

    Yields
    ------
    str, object, object
        Dotted key, as `starts[2].x`, value before, value after; 1 and 1.0 differ, and true and 1.
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
    # 1 and 1.0 differ as text and as data, true and 1 too.
    elif json.dumps(before) != json.dumps(after):
        yield place, before, after


def differing_block(before, after, was="then", now="now"):
    """Describe every key that differs between two blocks of config.

    Parameters
    ----------
    before, after : dict
    was, now : str
        What the two are called.

    Returns
    -------
    str or None
    """
    different = differing_keys(before, after)
    words = [f"{key}: {brief(old)} {was}, {brief(new)} {now}" for key, old, new in different]
    return "; ".join(words) or None


def differing_files(before, after):
    """Words about the first file whose hash differs.

    Parameters
    ----------
    before, after : dict
        File -> hash, or None where it is gone.

    Returns
    -------
    str or None
    """
    different = [path for path in sorted({*before, *after}) if before.get(path) != after.get(path)]
    if not different:
        return None
    path = different[0]
    verb = "is new" if path not in before else "is gone" if after.get(path) is None else "differs"
    more = f" (and {len(different) - 1} more)" if len(different) > 1 else ""
    return f"{path} {verb}{more}"


def differing_package(before, after, was="then"):
    """Describe every package whose version differs.

    Parameters
    ----------
    before, after : dict
        Package -> version, or None where it is not installed.
    was : str
        What the first is called.

    Returns
    -------
    str or None
    """
    words = []
    for name in sorted({*before, *after}):
        if before.get(name) != after.get(name):
            here = f"{after[name]} here" if after.get(name) else "not installed here"
            words.append(f"{name} {before.get(name)} {was}, {here}")
    return "; ".join(words) or None


def brief(value):
    """Shorten a value to a part of a line: text as it is, all else as JSON."""
    text = value if isinstance(value, str) else json.dumps(value)
    return text if len(text) <= 40 else text[:37] + "..."


def columns(rows):
    """Rows of texts as lines with aligned columns.

    Parameters
    ----------
    rows : list of sequence of str
        All of one length.

    Returns
    -------
    list of str
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    padded = [[f"{text:{w}}" for text, w in zip(row, widths, strict=True)] for row in rows]
    return ["  ".join(row).rstrip() for row in padded]
