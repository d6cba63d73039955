"""Read config.yaml, check it, and say what each scene needs computed.

Whatever is wrong with the file becomes one `ConfigError`, whose one line names the key, its value
and what is allowed. Importing this package is cheap: it is part of every start.
"""

from .checking import check
from .needs import SHOWN, STAGES, artifact, drawing, drawn, figures, owners, shown, stages
from .reading import load
from .words import ConfigError

__all__ = [
    "SHOWN",
    "STAGES",
    "ConfigError",
    "artifact",
    "check",
    "drawing",
    "drawn",
    "figures",
    "load",
    "owners",
    "shown",
    "stages",
]
