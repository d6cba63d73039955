"""How the arguments of public functions are read; `help(pseudorigid)` states the rule."""

import math
import reprlib
from decimal import Decimal
from numbers import Real

import numpy as np

_STATE = ("x", "xdot", "udot")
_MOST = 2**53  # from here on a double does not hold every whole number


def doubles(name, value):
    """Read a real number, or an array of them, as doubles.

    Parameters
    ----------
    name : str
        What the message calls it.
    value : number or array
        Masked elements become NaN.

    Returns
    -------
    ndarray of float

    Raises
    ------
    ValueError
        What is no real number (text, None, a bool, a complex number, ...), or beyond the range of
        doubles.
    """
    if type(value) is float:
        return np.asarray(value)
    try:
        return _converted(value)
    except OverflowError:
        allowed = "a number within the range of doubles"
    except (TypeError, ValueError):
        allowed = "a real number or an array of them"
    raise not_allowed(name, value, allowed)


def coordinates(**values):
    """Read numbers and arrays that broadcast.

    Parameters
    ----------
    **values : number or array
        Under their names.

    Returns
    -------
    list of ndarray
        Of one shape. Where one of them is not finite, all are NaN.

    Raises
    ------
    ValueError
        As from `doubles`, and for shapes that do not broadcast.
    """
    arrays = [doubles(name, value) for name, value in values.items()]
    try:
        arrays = np.broadcast_arrays(*arrays)
    except ValueError:
        shapes = ", ".join(str(array.shape) for array in arrays)
        raise ValueError(f"{', '.join(values)} of shapes {shapes} do not broadcast") from None
    finite = np.logical_and.reduce([np.isfinite(array) for array in arrays])
    return arrays if finite.all() else [np.where(finite, array, np.nan) for array in arrays]


def number(name, value, allowed="one finite number", holds=math.isfinite):
    """Read one finite number.

    Parameters
    ----------
    name : str
        What the message calls it.
    value : number
    allowed : str
        What the message says of it.
    holds : callable
        Whether a finite number is allowed.

    Returns
    -------
    float

    Raises
    ------
    ValueError
        For anything else.
    """
    try:
        found = doubles(name, value)
    except ValueError:
        raise not_allowed(name, value, allowed) from None
    if found.shape == () and math.isfinite(found) and holds(float(found)):
        return float(found)
    raise not_allowed(name, value, allowed)


def whole_number(name, value, least=1):
    """Read one whole number.

    Parameters
    ----------
    name : str
        What the message calls it.
    value : number
    least : int

    Returns
    -------
    int
        From `least` to 2^53 - 1.

    Raises
    ------
    ValueError
        For anything else.
    """
    allowed = f"a whole number, at least {least} and below 2^53"
    return int(number(name, value, allowed, lambda v: least <= v < _MOST and v == int(v)))


def one_of(name, value, words):
    """Refuse what is none of some words.

    Parameters
    ----------
    name : str
        What the message calls it.
    value : str
    words : sequence of str

    Raises
    ------
    ValueError
        For anything else.
    """
    if not (isinstance(value, str) and value in words):
        raise not_allowed(name, value, " or ".join(map(repr, words)))


def state_of(state):
    """Read where an orbit starts.

    Parameters
    ----------
    state : (x, xdot, udot) or xarray.Dataset
        Of a Dataset the last state along `impact` or `point`, of each orbit that it has.

    Returns
    -------
    x, xdot, udot : number or array

    Raises
    ------
    ValueError
        What is neither.
    """
    if hasattr(state, "data_vars"):
        return _last_state(state)
    try:
        x, xdot, udot = state
    except (TypeError, ValueError):
        allowed = "(x, xdot, udot), or a Dataset with these"
        raise not_allowed("state", state, allowed) from None
    return x, xdot, udot


def not_allowed(name, value, allowed):
    """The ValueError of one line for an argument.

    Parameters
    ----------
    name : str
    value : object
    allowed : str

    Returns
    -------
    ValueError
    """
    try:
        text = " ".join(reprlib.repr(value).split())
    except ValueError:  # an integer of more digits than Python prints
        text = f"<{type(value).__name__}>"
    return ValueError(f"{name} = {text} is not allowed: {allowed}")


def _converted(value):
    """Convert to an array of doubles; TypeError or OverflowError where that loses the meaning."""
    if hasattr(value, "__array__") and not np.ma.isMaskedArray(value):
        value = np.asarray(value)
    elif isinstance(value, (list, tuple)) and not any(map(np.ma.isMaskedArray, value)):
        value = np.array(value, dtype=object)
    elif not np.ma.isMaskedArray(value):
        value = np.ma.array(value, dtype=object)
    given = np.ma.getdata(value)
    if given.dtype.kind == "O":
        found = np.array([_double(one) for one in given.flat], dtype=float).reshape(given.shape)
    elif given.dtype.kind in "iuf":
        with np.errstate(over="ignore"):
            found = given.astype(float, copy=False)
        if np.any(np.isinf(found) & np.isfinite(given)):
            raise OverflowError
    else:
        raise TypeError
    mask = np.ma.getmaskarray(value)
    return np.where(mask, np.nan, found) if mask.any() else found


def _double(one):
    """Convert one element of an array of objects."""
    if np.ma.is_masked(one):
        return math.nan
    if getattr(one, "shape", None) == ():
        return float(_converted(one))
    if isinstance(one, bool) or not isinstance(one, (Real, Decimal)):
        raise TypeError
    found = float(one)
    if abs(found) == math.inf and one != found:
        raise OverflowError
    return found


def _last_state(data):
    if missing := [name for name in _STATE if name not in data]:
        raise ValueError(f"state: a Dataset without {', '.join(missing)}")
    if "row_size" in data and data["row_size"].attrs.get("sample_dimension") == "point":
        counts = np.atleast_1d(data["row_size"].values)
        whole = data["x"].dims == ("point",) and counts.sum() == data.sizes["point"]
        if not whole or np.any(counts < 1):
            raise ValueError(
                "state: row_size does not count the points of the Dataset: "
                "select one orbit's points, and drop row_size"
            )
        data = data.isel(point=np.cumsum(counts) - 1)
    else:
        data = data[list(_STATE)]
        for dim in {"impact", "point"} & set(data.dims):
            if data.sizes[dim] == 0:
                raise ValueError(f"state: a Dataset of no {dim}")
            data = data.isel({dim: -1})
    dims = data["x"].dims
    if any(data[name].dims != dims for name in _STATE):
        raise ValueError("state: a Dataset in which x, xdot and udot have different dims")
    return tuple(data[name].values for name in _STATE)
