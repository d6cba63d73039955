"""The kinds of picture. Every module of this package declares one kind, which has its name."""

import importlib
import pkgutil

from ..scene import Scene


def _declared(name: str) -> type[Scene]:
    """Return the one kind of picture that a module declares."""
    module = importlib.import_module(f"{__name__}.{name}")
    (kind,) = (
        value
        for value in vars(module).values()
        if isinstance(value, type)
        and issubclass(value, Scene)
        and value.__module__ == module.__name__
    )
    return kind


KINDS = {module.name: _declared(module.name) for module in pkgutil.iter_modules(__path__)}
