"""The kinds of picture. Every module of this package declares one kind, which has its name."""

import importlib
import pkgutil

from ..scene import Scene

KINDS: dict[str, type[Scene]] = {}
for _module in pkgutil.iter_modules(__path__):  # last_curve declares the class LastCurve
    _class = _module.name.title().replace("_", "")
    KINDS[_module.name] = vars(importlib.import_module(f"{__name__}.{_module.name}"))[_class]
