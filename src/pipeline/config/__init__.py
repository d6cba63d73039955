"""Read config.yaml, check it, and say what each scene needs computed.

Whatever is wrong with the file becomes one `ConfigError`, with a line for each mistake that names
the key, its value and what is allowed. Importing this package is cheap: it is part of every start.
"""

from .checking.document import check
from .checking.reading import load
from .checking.words import ConfigError, unknown
from .places import PAPER, PUBLISHED, figures

__all__ = ["PAPER", "PUBLISHED", "ConfigError", "check", "figures", "load", "unknown"]
