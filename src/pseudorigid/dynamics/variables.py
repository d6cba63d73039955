"""What datasets of orbits are made of: names, variables, dims; and what is picked out of them."""

import numpy as np

# Scales: a number of a dataset times its scale is the quantity. R is the ball's radius, omega the
# frequency of its stretching and m its mass.
LENGTH, SPEED, RATE, TIME = "R", "omega R", "omega", "1/omega"
ENERGY, AREA, RADIUS = "m omega^2 R^2", "omega R^2", "section radius"
NAMES = {
    "x": ("position at impact, downwards", LENGTH),
    "xdot": ("velocity of the mass centre just before impact", SPEED),
    "udot": ("strain rate just before impact", RATE),
    "tau": ("time of flight since the previous impact", TIME),
}


def variables(dims, values, names=NAMES):
    """Variables of a Dataset, dimensionless, each with what it means.

    Parameters
    ----------
    dims : str or tuple of str
        The same of all.
    values : iterable of array
    names : dict
        Name and meaning of each, or (meaning, scale), in the order of `values`.

    Returns
    -------
    dict
        {name: (dims, array, attributes)}.
    """
    about = {name: (text,) if isinstance(text, str) else text for name, text in names.items()}
    pairs = zip(about.items(), values, strict=True)
    return described({name: (dims, array, *text) for (name, text), array in pairs})


def described(table):
    """Variables of a Dataset, dimensionless numbers or words, each with what it means.

    Parameters
    ----------
    table : dict
        {name: (dims, values, meaning)}, or (dims, values, meaning, scale) of what is no pure
        number.

    Returns
    -------
    dict
        {name: (dims, array, attributes)}.
    """
    found = {}
    for name, (dims, values, *about) in table.items():
        array = np.asarray(values)
        words = array.dtype.kind in "OU"
        attributes = {"long_name": about[0]} if words else attributes_of(*about)
        found[name] = dims, array.astype(object) if words else array, attributes
    return found


def attributes_of(meaning, scale="1"):
    """The attributes of a variable: what it means, and its scale.

    Parameters
    ----------
    meaning : str
    scale : str
        What the numbers are multiples of; "1" for pure numbers.

    Returns
    -------
    dict
        long_name, units ("1": all numbers are dimensionless) and scale.
    """
    return {"long_name": meaning, "units": "1", "scale": scale}


def of_rows(table, rows):
    """The same of rows of values, which are in the order of the table.

    Parameters
    ----------
    table : dict
        {name: (dims, meaning)} or {name: (dims, meaning, scale)}; the first of the dims counts
        the rows.
    rows : sequence of tuple

    Returns
    -------
    dict
        {name: (dims, array, attributes)}.
    """
    columns = zip(table.items(), zip(*rows, strict=True), strict=True)
    return described({name: (dims, column, *text) for (name, (dims, *text)), column in columns})


def states_of(dataset):
    """The states x, xdot, udot of a dataset as one array, a row each."""
    return np.stack([dataset[name].values for name in ("x", "xdot", "udot")])


def chart(k, x, xdot, udot):
    """The points (x, y) of states in the section's chart, y = xdot - k udot: (2, ...)."""
    return np.stack([x, xdot - k * udot])


def orbit_dims(shape):
    """The dims of many orbits: `orbit`, or of more than one dimension `orbit_0`, `orbit_1`, ..."""
    return ("orbit",) if len(shape) == 1 else tuple(f"orbit_{i}" for i in range(len(shape)))


class NoOrbitError(ValueError):
    """There is no periodic orbit of that type, and so nothing that is made from it."""

    lasting = True


def of_type(orbits, kind, period=None):
    """The first orbit of a type among those of `symmetric_orbits`.

    Parameters
    ----------
    orbits : xarray.Dataset
        On (orbit, point), with type.
    kind : {"elliptic", "hyperbolic", "inverse hyperbolic"}
    period : int, optional
        What the orbits' period must be.

    Returns
    -------
    xarray.Dataset
        On `point`.

    Raises
    ------
    NoOrbitError
        Where there is none, saying what there is.
    ValueError
        Where the orbits have another period.
    """
    if period not in (None, orbits.sizes["point"]):
        raise ValueError(f"orbits of period {orbits.sizes['point']}, not {period}")
    (matches,) = np.nonzero(orbits["type"].values == kind)
    if matches.size == 0:
        there = ", ".join(sorted(set(orbits["type"].values.tolist()))) or "none at all"
        raise NoOrbitError(
            f"no {kind} orbit of period {orbits.sizes['point']} "
            f"at energy {orbits.attrs['energy']:g} (found: {there})"
        )
    return orbits.isel(orbit=int(matches[0]))


def final_exponents(lyapunov):
    """The exponents of each orbit at its last record, sorted by value.

    Parameters
    ----------
    lyapunov : xarray.Dataset
        exponent (impact, orbit, index), as from `lyapunov_spectrum`; NaN beyond an orbit's end.

    Returns
    -------
    ndarray, shape (orbit, index)
        Nats an impact, the largest of each orbit first.
    """
    exponent = lyapunov["exponent"].values
    there = ~np.isnan(exponent[:, :, 0])
    last = exponent.shape[0] - 1 - np.argmax(there[::-1], axis=0)
    return np.sort(exponent[last, np.arange(exponent.shape[1])], axis=1)[:, ::-1]
