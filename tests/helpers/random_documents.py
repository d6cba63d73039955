"""Random documents and bytes."""

import copy
import json

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st

SCALARS = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5)
JSON = st.recursive(
    SCALARS,
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3)
    ),
    max_leaves=5,
)
PATHS = ["/tmp/x", "../../x", "results/paper/../../x", "\0", "", "x" * 300, "/proc/self/mem", ".."]
VALUES = JSON | st.sampled_from(PATHS)


@st.composite
def edited(draw, document):
    """Replace, add or remove some values of a JSON document."""
    document = copy.deepcopy(document)
    for _ in range(draw(st.integers(1, 3))):
        part = document
        while isinstance(part, (dict, list)) and part:
            keys = sorted(part) if isinstance(part, dict) else range(len(part))
            key = draw(st.sampled_from(list(keys)))
            if not isinstance(part[key], (dict, list)) or draw(st.integers(0, 2)) == 0:
                if draw(st.booleans()):
                    part[key] = draw(VALUES)
                elif isinstance(part, dict):
                    part[draw(st.sampled_from(PATHS))] = part.pop(key)
                else:
                    part.append(draw(VALUES))
                break
            part = part[key]
    return document


@st.composite
def spoilt(draw, data):
    """Change, cut out, double or append some bytes."""
    for _ in range(draw(st.integers(1, 3))):
        start = draw(st.integers(0, len(data))) // draw(st.sampled_from([1, 512, 1]))
        size = draw(st.sampled_from([1, 3, 12, 512, 5000]))
        part = draw(st.binary(max_size=20) | st.just(data[start : start + size]))
        data = data[:start] + part + data[start + draw(st.sampled_from([0, size, len(part)])) :]
    return data


TAGS = {bool: "!!bool ", int: "!!int ", float: "!!float ", str: "!!str "}


@st.composite
def in_yaml(draw, value, known=None):
    """YAML of a JSON value: with tags, anchors, aliases of equal parts, and overridden merges."""
    known = {} if known is None else known
    text = json.dumps(value)
    if not isinstance(value, (dict, list)):
        return draw(st.sampled_from(["", TAGS[type(value)]])) + text
    if text in known and draw(st.booleans()):
        return f"*{known[text]}"
    if isinstance(value, list):
        written = f"[{', '.join(draw(in_yaml(each, known)) for each in value)}]"
    else:
        merged = draw(st.lists(st.sampled_from(sorted(value)), unique=True)) if value else []
        overridden = {key for key in merged if draw(st.booleans())}
        base = {key: "overridden" if key in overridden else value[key] for key in merged}
        pairs = [f"<<: {draw(in_yaml(base, known))}"] if merged else []
        for key in sorted(value.keys() - {*merged} | overridden):
            pairs.append(f"{json.dumps(key)}: {draw(in_yaml(value[key], known))}")
        written = f"{{{', '.join(pairs)}}}"
    if text in known:
        return written
    known[text] = f"a{len(known)}"
    return f"&{known[text]} {written}"


# Examples differ from day to day: tests/conftest.py chooses their seed.
FUZZ = settings(max_examples=20, deadline=None, suppress_health_check=[*HealthCheck])
