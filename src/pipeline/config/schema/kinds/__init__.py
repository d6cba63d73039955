"""The kinds of picture: every module here declares one, and its name is the module's."""

import importlib
import pkgutil

from ..scene import Scene

KINDS: dict[str, type[Scene]] = {}
for _found in pkgutil.iter_modules(__path__):
    _module = importlib.import_module(f"{__name__}.{_found.name}")
    (KINDS[_found.name],) = (
        kind
        for kind in vars(_module).values()
        if isinstance(kind, type)
        and issubclass(kind, Scene)
        and kind.__module__ == _module.__name__
    )
