"""The kinds of picture that parts declare: each is a class named in CamelCase."""

import importlib
import re

from ...declaration import files
from .scene import Picture


def _declared() -> dict[str, type[Picture]]:
    """Return the classes that are declared, by the kinds' names, in the order of declaration."""
    kinds = {}
    for package in files("kinds.py"):
        module = importlib.import_module(f"{package}.kinds")
        template = getattr(module, "DRAWN_BY", f"{package}.figures.{{}}.draw")
        for name, value in vars(module).items():
            ours = isinstance(value, type) and value.__module__ == module.__name__
            if ours and issubclass(value, Picture):
                kind = re.sub("(?<=[a-z])(?=[A-Z])", "_", name).lower()
                value.drawn_by = vars(value).get("drawn_by") or template.format(kind)
                figures = value.drawn_by.rsplit(".", 2)[0]
                value.reported_by = f"{figures}.reports.{kind}"
                kinds[kind] = value
    return kinds


KINDS = _declared()
