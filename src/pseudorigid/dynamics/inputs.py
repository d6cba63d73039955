"""Conversion of the arguments of public functions; `help(pseudorigid)` states the rule."""

import math
import reprlib
from collections.abc import Callable, Sequence
from decimal import Decimal
from numbers import Real
from typing import Any, Protocol, SupportsFloat

import numpy as np
import xarray as xr
from typing_extensions import TypeAliasType

Condition = Callable[[float], bool]


class _Array(Protocol):  # a Series of pandas is one
    def __array__(self) -> np.ndarray: ...


# Real numbers, also Fractions and arrays, and lists of them. The ArrayLike of numpy includes text.
_Real = SupportsFloat | _Array
Reals = TypeAliasType("Reals", _Real | Sequence[_Real | Sequence[SupportsFloat]])
StateLike = TypeAliasType("StateLike", tuple[Reals, Reals, Reals] | list | np.ndarray | xr.Dataset)
_STATE = ("x", "xdot", "udot")
_END_OF_COUNTS = 2**53  # beyond it a double does not hold every whole number


def doubles(name: str, value: Any) -> np.ndarray:
    """Convert a real number, or an array of them, to doubles; masked elements become NaN.

    Raises ValueError, with the argument's name, for text, None, a bool, a complex number, ..., and
    for numbers beyond the range of doubles.
    """
    if type(value) is float or (type(value) is np.ndarray and value.dtype == np.float64):
        return np.asarray(value)
    try:
        return _converted(value)
    except OverflowError:
        allowed = "a number within the range of doubles"
    except (TypeError, ValueError):
        allowed = "a real number or an array of them"
    raise not_allowed(name, value, allowed)


def coordinates(**values: Any) -> list[np.ndarray]:
    """Convert named numbers and arrays that broadcast to arrays of one shape, by `doubles`.

    Where one of them is not finite, all are NaN. Raises ValueError if shapes do not broadcast.
    """
    arrays = [doubles(name, value) for name, value in values.items()]
    try:
        arrays = [*np.broadcast_arrays(*arrays)]
    except ValueError:
        shapes = ", ".join(str(array.shape) for array in arrays)
        raise ValueError(f"{', '.join(values)} of shapes {shapes} do not broadcast") from None
    finite = np.logical_and.reduce([np.isfinite(array) for array in arrays])
    return arrays if finite.all() else [np.where(finite, array, np.nan) for array in arrays]


def number(
    name: str, value: Any, allowed: str = "one finite number", holds: Condition = math.isfinite
) -> float:
    """Convert one finite number for which `holds` is true; `allowed` is the text of the error."""
    try:
        array = doubles(name, value)
    except ValueError:
        raise not_allowed(name, value, allowed) from None
    if array.shape == () and math.isfinite(array) and holds(float(array)):
        return float(array)
    raise not_allowed(name, value, allowed)


def whole_number(name: str, value: Any, least: int = 1) -> int:
    """Convert one whole number from `least` to 2^53 - 1."""
    allowed = f"a whole number, at least {least} and below 2^53"
    return int(number(name, value, allowed, lambda v: least <= v < _END_OF_COUNTS and v == int(v)))


def one_of(name: str, value: Any, words: Sequence[str]) -> None:
    """Raise ValueError unless the value is one of some words."""
    if not (isinstance(value, str) and value in words):
        raise not_allowed(name, value, " or ".join(map(repr, words)))


def state_of(state: Any) -> tuple[Any, ...]:
    """Return x, xdot and udot of a state (x, xdot, udot), or of a Dataset.

    Of a Dataset they are those of the last state of each orbit.
    """
    if hasattr(state, "data_vars"):
        return _last_state(state)
    try:
        x, xdot, udot = state
    except (TypeError, ValueError):
        allowed = "(x, xdot, udot), or a Dataset with these"
        raise not_allowed("state", state, allowed) from None
    return x, xdot, udot


def not_allowed(name: str, value: Any, allowed: str) -> ValueError:
    """Return the ValueError, of one line, for an argument."""
    return ValueError(f"{name} = {in_one_line(value)} is not allowed: {allowed}")


def in_one_line(value: Any) -> str:
    """Return a short text for a value."""
    try:
        return " ".join(reprlib.repr(value).split())
    except ValueError:  # an integer with more digits than Python prints
        return f"<{type(value).__name__}>"


def _converted(value: Any) -> np.ndarray:
    """Convert to an array of doubles; raise TypeError or OverflowError if that is impossible."""
    if hasattr(value, "__array__") and not np.ma.isMaskedArray(value):
        value = np.asarray(value)
    # As objects bools, None and whole numbers beyond 64 bits are still seen one by one.
    elif isinstance(value, (list, tuple)) and not any(map(np.ma.isMaskedArray, value)):
        value = np.array(value, dtype=object)
    elif not np.ma.isMaskedArray(value):  # a scalar, or a list that has masked arrays
        value = np.ma.array(value, dtype=object)
    data = np.ma.getdata(value)
    if data.dtype.kind == "O":
        array = np.array([_double(a) for a in data.flat], dtype=float).reshape(data.shape)
    elif data.dtype.kind in "iuf":
        with np.errstate(over="ignore"):
            array = data.astype(float, copy=False)
        if np.any(np.isinf(array) & np.isfinite(data)):
            raise OverflowError
    else:
        raise TypeError
    mask = np.ma.getmaskarray(value)
    return np.where(mask, np.nan, array) if mask.any() else array


def _double(element: Any) -> float:
    """Convert one element of an array of objects."""
    if np.ma.is_masked(element):
        return math.nan
    if getattr(element, "shape", None) == ():  # a scalar of numpy, or an array without dimensions
        return float(_converted(element))
    if isinstance(element, bool) or not isinstance(element, (Real, Decimal)):
        raise TypeError
    value = float(element)
    if abs(value) == math.inf and element != value:
        raise OverflowError
    return value


def _last_state(data: xr.Dataset) -> tuple[Any, ...]:
    """Return x, xdot and udot of the last state of each orbit in a Dataset."""
    if missing := [name for name in _STATE if name not in data]:
        raise ValueError(f"state: a Dataset without {', '.join(missing)}")
    # All orbits lie along "point", one after the other; row_size counts the points of each.
    if "row_size" in data and data["row_size"].attrs.get("sample_dimension") == "point":
        counts = np.atleast_1d(data["row_size"].values)
        complete = data["x"].dims == ("point",) and counts.sum() == data.sizes["point"]
        if not complete or np.any(counts < 1):
            raise ValueError(
                "state: row_size does not count the points of the Dataset: "
                "select one orbit's points, and drop row_size"
            )
        data = data.isel(point=np.cumsum(counts) - 1)
    else:
        data = data[list(_STATE)]
        for dim in {"impact", "point"} & set(data.dims):
            if data.sizes[dim] == 0:
                raise ValueError(f"state: a Dataset without any {dim}")
            data = data.isel({dim: -1})
    dims = data["x"].dims
    if any(data[name].dims != dims for name in _STATE):
        raise ValueError("state: a Dataset in which x, xdot and udot have different dims")
    return tuple(data[name].values for name in _STATE)
