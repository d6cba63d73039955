"""The kinds of picture: each is a class of a module of this package, named in CamelCase."""

import importlib
import pkgutil
import re

from ..scene import Scene


def _declared() -> dict[str, type[Scene]]:
    """Return the classes that the modules of this package declare, by the kinds' names."""
    kinds = {}
    for found in pkgutil.iter_modules(__path__):
        module = importlib.import_module(f"{__name__}.{found.name}")
        for name, value in vars(module).items():
            if isinstance(value, type) and value.__module__ == module.__name__:
                kinds[re.sub("(?<=[a-z])(?=[A-Z])", "_", name).lower()] = value
    return dict(sorted(kinds.items()))


KINDS = _declared()
