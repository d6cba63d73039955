"""What differs between two blocks of config, two sets of files or of packages, in words."""

import json


def differing_keys(before, after, place=""):
    """The differences of two blocks.

    Parameters
    ----------
    before, after : dict, list, str, number, bool or None
    place : str
        Dotted key of the blocks.

    Yields
    ------
    str, object, object
        Dotted key, value before, value after; 1 and 1.0 differ, and true and 1.
    """
    if isinstance(before, dict) and isinstance(after, dict):
        for key in sorted({*before, *after}):
            where = f"{place}.{key}" if place else key
            if key not in before or key not in after:
                yield where, before.get(key, "nothing"), after.get(key, "nothing")
            else:
                yield from differing_keys(before[key], after[key], where)
    # 1 and 1.0 differ as text and as data, true and 1 too.
    elif json.dumps(before) != json.dumps(after):
        yield place, before, after


def differing_block(before, after, was="then", now="now"):
    """Words about the first key that differs between two blocks.

    Parameters
    ----------
    before, after : dict
    was, now : str
        What the two are called.

    Returns
    -------
    str or None
    """
    for key, old, new in differing_keys(before, after):
        return f"{key}: {brief(old)} {was}, {brief(new)} {now}"
    return None


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
    """Words about the first package whose version differs.

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
    for name in sorted({*before, *after}):
        if before.get(name) != after.get(name):
            here = f"{after[name]} here" if after.get(name) else "not installed here"
            return f"{name} {before.get(name)} {was}, {here}"
    return None


def brief(value):
    """A value as JSON, shortened to a part of a line."""
    text = json.dumps(value)
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
