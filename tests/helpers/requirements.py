"""What requirements/ asks for."""

import re

from helpers.project import ROOT


def requested(name):
    """Name -> version, or nothing, of each package that requirements/NAME.in asks for."""
    found = {}
    for line in (ROOT / "requirements" / f"{name}.in").read_text().splitlines():
        if line and not line.startswith("#"):
            pin = re.split("[;<~]", line)[0].strip()  # without its condition
            package, _, version = pin.lower().replace("_", "-").partition("==")
            found[package] = version
    return found
