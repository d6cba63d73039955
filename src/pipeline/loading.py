"""Loading of modules from their text, and a record of what this process loaded.

The modules of this project are compiled from their text, which takes milliseconds. Python would run
a cached .pyc if the source has the size and the second that the .pyc states, and so miss an edit of
the same length within one second. No .pyc of these packages is read or written.
"""

import hashlib
import os
from collections.abc import Sequence
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from pathlib import Path
from types import CodeType, ModuleType

# All that lie beside this one, but for plugins of snakemake.
_SRC = Path(__file__).parents[1]
PACKAGES = {f.parent.name for f in _SRC.glob("*/__init__.py") if "_plugin_" not in f.parent.name}
LOADED: dict[str, set[str]] = {}  # real path of a file -> sha256 of each text loaded from it


def note_loaded(path: str | os.PathLike[str], data: bytes) -> None:
    """Add the hash of a file's content, as this process read it, to LOADED."""
    digest = hashlib.sha256(data).hexdigest()
    LOADED.setdefault(os.path.realpath(path), set()).add(digest)


class _Loader(SourceFileLoader):
    """Compile a module from the text that its file has now."""

    def exec_module(self, module: ModuleType) -> None:
        try:
            super().exec_module(module)
        except (SyntaxError, ImportError, NameError, AttributeError, TypeError) as error:
            from .declaration import SourceError  # when modules are loaded from their text

            raise SourceError(self.path, error) from error

    def get_code(self, fullname: str) -> CodeType:
        path = self.get_filename(fullname)
        data = self.get_data(path)
        note_loaded(path, data)
        code: CodeType = self.source_to_code(data, path)
        return code


class Finder:
    """Find the modules of packages that are loaded from their text."""

    @staticmethod
    def find_spec(
        fullname: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if fullname.partition(".")[0] not in PACKAGES:
            return None
        spec = PathFinder.find_spec(fullname, path, target)
        if spec is not None and type(spec.loader) is SourceFileLoader:
            spec.loader = _Loader(fullname, spec.loader.path)
        return spec
