"""Read config.yaml, check it, and say what each scene needs computed.

Whatever is wrong with the file becomes one `ConfigError`, whose one line names the key, its value
and what is allowed. Importing this package is cheap: it is part of every start.
"""

from .checking import check
from .needs import (
    SHOWN,
    STAGES,
    absent_file,
    artifact,
    drawing,
    drawn,
    figures,
    served,
    shown,
    stages,
    wanted_orbits,
)
from .reading import load
from .variants import PAPER, unknown
from .words import ConfigError

__all__ = [
    "PAPER",
    "SHOWN",
    "STAGES",
    "ConfigError",
    "absent_file",
    "artifact",
    "check",
    "drawing",
    "drawn",
    "figures",
    "load",
    "served",
    "shown",
    "stages",
    "unknown",
    "wanted_orbits",
]
