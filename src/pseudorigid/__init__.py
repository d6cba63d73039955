"""Dynamics of a pseudo-rigid ball bouncing on a rigid foundation (Kanso & Papadopoulos).

The names below are loaded when they are first used, so that a program pays for what it uses.

All of them read numbers by one rule:

- A number is an int, float, Fraction or Decimal of Python, an integer or float of numpy, or an
  array with one element and no dimension. It is rounded to the nearest double; what is beyond the
  range of doubles is refused. So are text, None, bools, complex numbers and dates.
- Coordinates (x, xdot, udot, y, fraction, and the energy of a state) may also be arrays that
  broadcast, of any shape, the empty one too: lists, numpy arrays, xarray DataArrays (their values
  alone; names of dims are not looked at) and pandas Series. Results are arrays of the broadcast
  shape. Where a coordinate is NaN, infinite or masked, everything computed from that element is
  NaN, and nothing else is touched. A finite coordinate that is no state is refused.
- Every other number (k, g, a step, the energy of periodic orbits, a length, a count) is one number,
  finite, within its range; a count is whole and below 2^53.
- What is refused raises ValueError with one line: the name, the value, and what is allowed.
"""

import hashlib
import importlib
import os
import sys
from importlib.machinery import PathFinder, SourceFileLoader

_HOMES = {
    "Ball": "dynamics.ball",
    "orbit": "dynamics.orbits",
    "symmetric_orbits": "dynamics.periodic",
    "trace_manifold": "dynamics.manifolds",
    "lyapunov_spectrum": "dynamics.lyapunov",
}

__all__ = list(_HOMES)

# Modules of this package are compiled from their text, which takes milliseconds, and the hash of
# each text is noted here. Python itself would run a cached .pyc whenever the source still has the
# size and the second that the .pyc states, so that an edit of the same length within one second
# goes unseen. No .pyc of this package is read or written.
LOADED = {}  # real path of a file -> sha256 of each text that this process loaded from it
_FROM_TEXT = set()


def __getattr__(name):
    if name in _HOMES:
        return getattr(importlib.import_module(f".{_HOMES[name]}", __name__), name)
    if name == "__version__":
        return _version()
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return sorted([*globals(), *__all__, "__version__"])


def _version():
    """Return the version in pyproject.toml, or that of the installed package."""
    import tomllib
    from importlib import metadata
    from pathlib import Path

    root = Path(__file__).parents[2]
    if (root / "src" / __name__).is_dir():
        return tomllib.loads((root / "pyproject.toml").read_text())["project"]["version"]
    return metadata.version(__name__)


def note_loaded(path, data):
    """Note that this process loaded a file.

    Parameters
    ----------
    path : path
    data : bytes
        What was read from it.
    """
    digest = hashlib.sha256(data).hexdigest()
    LOADED.setdefault(os.path.realpath(str(path)), set()).add(digest)


def load_from_text(package):
    """Load the modules of a package from their text from now on.

    Parameters
    ----------
    package : str
        Its name.
    """
    _FROM_TEXT.add(package)
    if _Finder not in sys.meta_path:
        sys.meta_path.insert(0, _Finder)


class _Loader(SourceFileLoader):
    """Compile a module from the text that its file has now."""

    def get_code(self, fullname):
        path = self.get_filename(fullname)
        data = self.get_data(path)
        note_loaded(path, data)
        return self.source_to_code(data, path)


class _Finder:
    """Find the modules of packages that are loaded from their text."""

    @staticmethod
    def find_spec(fullname, path=None, target=None):
        if fullname.partition(".")[0] not in _FROM_TEXT:
            return None
        spec = PathFinder.find_spec(fullname, path, target)
        if spec is not None and type(spec.loader) is SourceFileLoader:
            spec.loader = _Loader(fullname, spec.loader.path)
        return spec


load_from_text(__name__)
