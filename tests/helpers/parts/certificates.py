"""Certificates with other numbers."""

import dataclasses
import re
from contextlib import nullcontext

import pytest

from extensions.proofs import THEOREMS
from extensions.proofs.checkers.certificate import NotProvedError

# A theorem of each checker.
ONE_OF_EACH = [*{theorem.checker: name for name, theorem in reversed(THEOREMS.items())}.values()]


def numbers(text, field):
    """The numbers in each row of a field of a certificate, as text."""
    block = re.search(rf"^{field} = \[\n(.*?)^\]", text, re.MULTILINE | re.DOTALL).group(1)
    return [re.findall(r"[-\d.e]+", line) for line in block.splitlines()]


def with_field(text, field, value):
    """The certificate with another value of a field of one line."""
    return re.sub(rf"^{field} = .*$", f"{field} = {value}", text, flags=re.MULTILINE)


def with_rows(text, field, rows):
    """The certificate with other rows of a field."""
    lines = "".join(f"  [{', '.join(row)}],\n" for row in rows)
    pattern = re.compile(rf"^{field} = \[\n.*?^\]", re.DOTALL | re.MULTILINE)
    return pattern.sub(f"{field} = [\n{lines}]", text)


def with_bounds(theorem, **bounds):
    """Return a theorem with other numbers in its statement."""
    return dataclasses.replace(theorem, bounds=theorem.bounds | bounds)


def told(reason, error=NotProvedError):
    """Expect an error with a reason, or none if the reason is empty."""
    return pytest.raises(error, match=reason) if reason else nullcontext()


def refused(theorem, text=None, **bounds):
    """Return the reason, one line, why its checker does not take a certificate as a proof.

    A theorem may be given by its name. `bounds` replace numbers of its statement, and the
    certificate is by default its own.
    """
    theorem = THEOREMS[theorem] if isinstance(theorem, str) else theorem
    result = with_bounds(theorem, **bounds).check(text)
    assert result.verdict == "not proved" and result.reason and "\n" not in result.reason
    return result.reason


# Fields of which leading digits are changed.
FIELDS = {
    "points", "radius", "saddles", "approach", "middle", "width", "twist", "energy", "point",
    "near_image", "far_image", "outer_end", "inner_end", "speed", "roots", "energy_below",
    "energy_up_to", "theta_below", "theta", "trace_above", "zero", "resonance",
    "event",
}  # fmt: skip


def altered(text):
    """(field, number, certificate) with another leading digit of a number of FIELDS.

    Of each number of a short certificate, and of one in each field of a long one.
    """
    changes, start, field = [], 0, None
    for line in text.splitlines(keepends=True):
        named = re.match(r"(\w+) = ", line)
        field = named.group(1) if named else field
        values = named.end() if named else 0
        if field in FIELDS and not line.startswith(("#", "]")):
            for number in re.finditer(r"-?\d[\d.e-]*", line[values:]):
                if digit := re.search(r"[1-9]", number.group(0)):
                    at = start + values + number.start() + digit.start()
                    other = "2" if text[at] == "1" else "1"
                    changes.append((field, number.group(0), f"{text[:at]}{other}{text[at + 1 :]}"))
        start += len(line)
    groups = [[change for change in changes if change[0] == field] for field in FIELDS]
    return changes if len(changes) <= 30 else [group[len(group) // 3] for group in groups if group]
