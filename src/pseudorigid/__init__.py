"""Dynamics of a pseudo-rigid ball bouncing on a rigid foundation (Kanso & Papadopoulos).

The public names are `__all__`. Each is imported when it is first used, so that a program loads
only what it uses.

All numbers are dimensionless: lengths in R, times in 1/omega, energies in m omega^2 R^2. A *state*
is (x, xdot, udot) just before an impact, with x pointing down; it lies on the section if xdot +
udot >= 0. Methods of `Ball` give a state of a given energy: `start`, a fraction of the section's
radius along the symmetry line; `state_xy`, in the chart y = xdot - k udot, in which the map keeps
areas; `state`, from x and xdot.

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

import importlib
import pkgutil
from typing import Any

__version__ = "0.1.0"
_STUB = pkgutil.get_data(__name__, "__init__.pyi") or b""  # the names are declared there alone
_IMPORTS = [line.split() for line in _STUB.decode().splitlines() if line.startswith("from .")]
_MODULES = {name: module for _, module, _, name, *_ in _IMPORTS}
__all__ = list(_MODULES)


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        return getattr(importlib.import_module(_MODULES[name], __name__), name)
    except AttributeError as error:  # `from pseudorigid import` would hide it
        raise ImportError(f"cannot import {name}: {error}") from error


def __dir__() -> "list[str]":
    return sorted([*globals(), *__all__])
