"""Read config.yaml, check it, and say what each scene needs computed.

Whatever is wrong with the file becomes one `ConfigError`, with a line for each mistake that names
the key, its value and what is allowed. Importing this package is cheap: it is part of every start.
"""

from .checking.document import check
from .checking.reading import load
from .checking.variants import PAPER
from .checking.words import ConfigError, unknown
from .declared.kinds import KINDS
from .declared.stages import STAGES
from .places import (
    PUBLISHED,
    SHOWN,
    absent_file,
    artifact,
    drawing,
    drawing_code,
    drawn,
    figures,
    served,
    shown,
    stage_code,
    stages,
    wanted_orbits,
)

__all__ = [
    "KINDS",
    "PAPER",
    "PUBLISHED",
    "SHOWN",
    "STAGES",
    "ConfigError",
    "absent_file",
    "artifact",
    "check",
    "drawing",
    "drawing_code",
    "drawn",
    "figures",
    "load",
    "served",
    "shown",
    "stage_code",
    "stages",
    "unknown",
    "wanted_orbits",
]
