"""Certificates with other numbers, and their refusal by both checkers."""

import dataclasses
import re
from contextlib import nullcontext

import pytest
import second_checker
from slowly import slowly

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


def refused(theorem, text=None, checker="package", **bounds):
    """Return the reason, one line, why a checker does not take a certificate as a proof.

    A theorem may be given by its name. `bounds` replace numbers of its statement, and the
    certificate is by default its own.
    """
    if checker == "second":
        with pytest.raises(second_checker.NotProvedError) as refusal:
            second_checker.check(theorem, text, **bounds)
        reason = str(refusal.value)
    else:
        theorem = THEOREMS[theorem] if isinstance(theorem, str) else theorem
        result = with_bounds(theorem, **bounds).check(text)
        assert result.verdict == "not proved"
        reason = result.reason
    assert reason
    assert "\n" not in reason
    return reason


def by_both(names):
    """Return (checker, name) of each theorem; the second checker, which is slow, has few."""
    names = list(names)
    second = (("second", name) for name in names if name in second_checker.STATEMENTS)
    return [*(("package", name) for name in names), *slowly(*second)]
