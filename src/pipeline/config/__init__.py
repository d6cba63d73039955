"""Reading of config.yaml, and what has to be computed for each scene.

Mistakes in the file raise one `ConfigError`, with a line for each mistake that names the key, its
value and what is allowed. Every command imports this package, so importing it must be fast.
"""

from .results import Config
from .schema.parts import MAIN, PUBLISHED
from .validation.document import check, load
from .validation.mistakes import ConfigError, unknown

__all__ = ["MAIN", "PUBLISHED", "Config", "ConfigError", "check", "load", "unknown"]
