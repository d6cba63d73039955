"""Read numbers from certificates, for the tests of theorems."""

import re


def numbers(text, field):
    """The numbers in each row of a field of a certificate, as text."""
    block = re.search(rf"^{field} = \[\n(.*?)^\]", text, re.MULTILINE | re.DOTALL).group(1)
    return [re.findall(r"[-\d.e]+", line) for line in block.splitlines()]
