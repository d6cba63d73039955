"""Dynamics of a pseudo-rigid ball bouncing on a rigid foundation (Kanso & Papadopoulos).

The public names are `__all__`; docs/api.md describes them with examples. Each is imported when it
is first used, so that a program loads only what it uses.

All functions read numbers by one rule:

- A number is an int, float, Fraction or Decimal of Python, an integer or float of numpy, or an
  array with one element and no dimension. It is rounded to the nearest double. Text, None, bools,
  complex numbers, dates and numbers beyond the range of doubles are refused.
- Coordinates (x, xdot, udot, y, fraction, and the energy of a state) may also be arrays that
  broadcast, of any shape, also empty: lists, numpy arrays, pandas Series and xarray DataArrays (of
  which only the values count, not the names of dims). Results are arrays of the broadcast shape.
  Where a coordinate is NaN, infinite or masked, everything computed from that element is NaN, and
  nothing else changes. A finite coordinate that is no state is refused.
- Every other number (k, g, a step, the energy of periodic orbits, a length, a count) is one number,
  finite and within its range. A count is whole and below 2^53.
- A refused argument raises ValueError with one line: the name, the value, and what is allowed.
"""

import hashlib
import importlib
import os
import sys
from collections.abc import Sequence
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from types import CodeType, ModuleType
from typing import Any

_MODULES = {
    "Ball": "dynamics.ball",
    "orbit": "dynamics.orbits",
    "motion": "dynamics.motion",
    "symmetric_orbits": "dynamics.periodic",
    "trace_manifold": "dynamics.manifolds",
    "lyapunov_spectrum": "dynamics.lyapunov",
    "rotation_number": "sweep.quantities",
    "residue": "sweep.quantities",
    "classify_orbits": "sweep.quantities",
    "turnstile_flux": "sweep.quantities",
    "Picture": "figures.picture",
    "prove_orbit": "proofs.theorems.requests",
    "prove_curve": "proofs.theorems.requests",
}

__all__ = list(_MODULES)

# The modules of this package are compiled from their text, which takes milliseconds. Python would
# run a cached .pyc if the source has the size and the second that the .pyc states, and so miss an
# edit of the same length within one second. No .pyc of this package is read or written.
LOADED: "dict[str, set[str]]" = {}  # real path of a file -> sha256 of each text loaded from it
_PACKAGES_FROM_TEXT: "set[str]" = set()


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return getattr(importlib.import_module(f".{_MODULES[name]}", __name__), name)
    if name == "__version__":
        return _version()
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> "list[str]":
    return sorted([*globals(), *__all__, "__version__"])


def _version() -> str:
    """Return the version in pyproject.toml, or that of the installed package."""
    import tomllib
    from importlib import metadata
    from pathlib import Path

    root = Path(__file__).parents[2]
    if (root / "src" / __name__).is_dir():
        version: str = tomllib.loads((root / "pyproject.toml").read_text())["project"]["version"]
        return version
    return metadata.version(__name__)


def note_loaded(path: "str | os.PathLike[str]", data: bytes) -> None:
    """Add the hash of a file's content, as this process read it, to LOADED."""
    digest = hashlib.sha256(data).hexdigest()
    LOADED.setdefault(os.path.realpath(path), set()).add(digest)


def load_from_text(package: str) -> None:
    """Load the modules of a package from their text from now on."""
    _PACKAGES_FROM_TEXT.add(package)
    if _Finder not in sys.meta_path:
        sys.meta_path.insert(0, _Finder)


class _Loader(SourceFileLoader):
    """Compile a module from the text that its file has now."""

    def get_code(self, fullname: str) -> CodeType:
        path = self.get_filename(fullname)
        data = self.get_data(path)
        note_loaded(path, data)
        code: CodeType = self.source_to_code(data, path)
        return code


class _Finder:
    """Find the modules of packages that are loaded from their text."""

    @staticmethod
    def find_spec(
        fullname: str, path: "Sequence[str] | None" = None, target: "ModuleType | None" = None
    ) -> "ModuleSpec | None":
        if fullname.partition(".")[0] not in _PACKAGES_FROM_TEXT:
            return None
        spec = PathFinder.find_spec(fullname, path, target)
        if spec is not None and type(spec.loader) is SourceFileLoader:
            spec.loader = _Loader(fullname, spec.loader.path)
        return spec


load_from_text(__name__)
