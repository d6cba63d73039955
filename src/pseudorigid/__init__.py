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

import importlib

_HOMES = {
    "Ball": "dynamics.ball",
    "orbit": "dynamics.orbits",
    "symmetric_orbits": "dynamics.periodic",
    "trace_manifold": "dynamics.manifolds",
    "lyapunov_spectrum": "dynamics.lyapunov",
}

__all__ = list(_HOMES)


def __getattr__(name):
    if name in _HOMES:
        return getattr(importlib.import_module(f".{_HOMES[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return sorted([*globals(), *__all__])
