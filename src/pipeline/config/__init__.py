"""Read config.yaml, check it, and say what each scene needs computed.

Whatever is wrong with the file becomes one `ConfigError`, with a line for each mistake that names
the key, its value and what is allowed. Importing this package is cheap: it is part of every start.
"""

from .paths import PAPER, PUBLISHED, figures
from .validation.document import check
from .validation.reading import load
from .validation.words import ConfigError, unknown

__all__ = ["PAPER", "PUBLISHED", "ConfigError", "check", "figures", "load", "unknown"]
