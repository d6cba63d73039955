"""Reading certificates, for the tests of theorems."""

import re


def numbers(text, field):
    """The rows of a certificate's field, as text."""
    block = re.search(rf"^{field} = \[\n(.*?)^\]", text, re.MULTILINE | re.DOTALL).group(1)
    return [re.findall(r"[-\d.e]+", line) for line in block.splitlines()]
