"""The kinds of picture that parts declare: each is a class named in CamelCase."""

import sys
from collections.abc import Iterator, Mapping

from ...declaration import files
from .fields import declared_in
from .scene import Picture


class _Kinds(Mapping[str, type[Picture]]):
    """The classes by the kinds' names, in the order of declaration.

    A part's kinds are loaded once a name is asked for that no earlier part has.
    """

    def __init__(self) -> None:
        self.loaded: dict[str, type[Picture]] = {}
        self.packages = [*files("kinds.py")]  # that are not loaded

    def __getitem__(self, name: str) -> type[Picture]:
        while name not in self.loaded and self.packages:
            package = self.packages.pop(0)
            for kind, value in declared_in(f"{package}.kinds").items():
                if issubclass(value, Picture):
                    module = sys.modules[value.__module__]
                    template = getattr(module, "DRAWN_BY", f"{package}.figures.{{}}.draw")
                    value.drawn_by = vars(value).get("drawn_by") or template.format(kind)
                    value.reported_by = f"{value.drawn_by.rsplit('.', 2)[0]}.reports.{kind}"
                    self.loaded[kind] = value
        return self.loaded[name]

    def __iter__(self) -> Iterator[str]:
        self.get("")  # no kind, so that all are loaded
        return iter(self.loaded)

    def __len__(self) -> int:
        return sum(1 for _ in self)


KINDS = _Kinds()
