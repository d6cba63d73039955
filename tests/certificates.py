"""Numbers of certificates, and certificates that are changed so that they prove nothing."""

import re
from fractions import Fraction

# of a horseshoe's sets: columns, their factor, and the columns of which half is added
CHANGES_OF_A_SET = [
    ((2, 3), Fraction("1.3"), None),
    ((4, 5), Fraction("0.7"), None),
    ((0, 1), 1, 2),
    ((0, 1), 1, 4),
]
CHANGED_ROWS = [0, 30, -2]
OTHER_CONSTANTS = [("k", "1/4"), ("g", "1/24"), ("energy", "1/99")]
IMPOSSIBLE_NUMBERS = [
    "1e-999999999", "1e999999999", "1e400", "1e-999", "1_0.5", "true", "0x10", '"1/0"', "[1]",
]  # fmt: skip
FIELDS = {
    "points", "radius", "saddles", "approach", "middle", "width", "twist", "energy", "point",
    "near_image", "far_image", "outer_end", "inner_end", "speed", "roots", "energy_below",
    "energy_up_to", "theta_below", "theta", "trace_above", "zero", "resonance",
    "event",
}  # fmt: skip


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


def with_changed_set(text, row, columns, factor, shift):
    """A horseshoe's certificate with one set wider, thinner or shifted."""
    rows = numbers(text, "approach")
    values = [Fraction(a) for a in rows[row]]
    for i in columns:
        values[i] = values[i] * factor + (values[i + shift] / 2 if shift else 0)
    rows[row] = [f'"{value}"' for value in values]
    return with_rows(text, "approach", rows)


def with_impossible_margins(text):
    """A horseshoe's certificate with margins that are not positive and finite."""
    for margin in ("-1.0", "nan", "inf", "-inf"):
        yield with_rows(text, "margins", [[margin, margin] for _ in numbers(text, "margins")])


def with_impossible_number(text, number):
    """The certificates with this number in one of their fields of one number."""
    for field in ("k", "g", "energy", "energy_up_to", "energy_below", "radius"):
        for value in (number, f'"{number}"'):
            if (other := with_field(text, field, value)) != text:
                yield other


def with_arabic_digits(text):
    """The certificate with k = 1/5 in Arabic digits."""
    return text.replace('k = "1/5"', 'k = "\u0661/\u0665"')


def unreadable(text):
    """The certificate with parts that are missing or garbled."""
    return [
        "", text[: len(text) // 2], text.replace("k = ", "kk = "),
        with_field(text, "kind", '"poem"'), re.sub(r"\d+", "x", text),
    ]  # fmt: skip


def leading_digits(text):
    """(field, number, certificate) of every changed leading digit in one of FIELDS."""
    start, field = 0, None
    for line in text.splitlines(keepends=True):
        named = re.match(r"(\w+) = ", line)
        field = named.group(1) if named else field
        values = named.end() if named else 0
        if field in FIELDS and not line.startswith(("#", "]")):
            for number in re.finditer(r"-?\d[\d.e-]*", line[values:]):
                if digit := re.search(r"[1-9]", number.group(0)):
                    at = start + values + number.start() + digit.start()
                    for other in "123456789".replace(text[at], ""):
                        yield field, number.group(0), text[:at] + other + text[at + 1 :]
        start += len(line)


def some_leading_digits(text):
    """All changed leading digits of a short certificate, some of each field of a long one."""
    changes = list(leading_digits(text))
    if len(changes) <= 200:
        return changes
    fields = [[change for change in changes if change[0] == field] for field in FIELDS]
    return [change for group in fields for change in group[:: max(1, len(group) // 4)]]
