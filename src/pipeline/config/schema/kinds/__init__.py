"""The kinds of picture, here and in extensions: each is a class named in CamelCase."""

import importlib
import pkgutil
import re

from ....declaration import files
from ..scene import Picture

_FIGURES = "pseudorigid.figures.kinds"  # has one module of `draw` for each kind


def _declared() -> dict[str, type[Picture]]:
    """Return the classes that are declared, by the kinds' names."""
    drawn_by = {f"{__name__}.{each.name}": _FIGURES for each in pkgutil.iter_modules(__path__)}
    folders = [file.parent.name for file in files("kinds.py")]
    drawn_by |= {f"extensions.{name}.kinds": f"extensions.{name}.figures" for name in folders}
    kinds = {}
    for declaring, figures in drawn_by.items():
        module = importlib.import_module(declaring)
        template = getattr(module, "DRAWN_BY", f"{figures}.{{}}.draw")
        for name, value in vars(module).items():
            ours = isinstance(value, type) and value.__module__ == module.__name__
            if ours and issubclass(value, Picture):
                kind = re.sub("(?<=[a-z])(?=[A-Z])", "_", name).lower()
                value.drawn_by = vars(value).get("drawn_by") or template.format(kind)
                value.reported_by = f"{figures}.reports.{kind}"
                kinds[kind] = value
    return dict(sorted(kinds.items()))


KINDS = _declared()
