"""Names, meanings and dims of variables in datasets of orbits, and selections from them."""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import xarray as xr

Variables = dict[str, tuple[Any, Any, dict[str, str]]]

# Scales, by which numbers in datasets are multiplied. R is the ball's radius, omega the frequency
# of its vibration and m its mass.
LENGTH, SPEED, RATE, TIME = "R", "omega R", "omega", "1/omega"
ENERGY, AREA, RADIUS = "m omega^2 R^2", "omega R^2", "section radius"
NAMES = {
    "x": ("position at impact, downwards", LENGTH),
    "xdot": ("velocity of the mass centre just before impact", SPEED),
    "udot": ("strain rate just before impact", RATE),
    "tau": ("time of flight since the previous impact", TIME),
}
PARAMETERS = {
    "k": ("Euler inertia", "m R^2"),
    "g": ("gravity", "omega^2 R"),
    "energy": ("total energy", ENERGY),
}


def variables(dims: Any, values: Iterable[Any], names: dict[str, Any] = NAMES) -> Variables:
    """Return Dataset variables {name: (dims, array, attributes)} that share their dims.

    `names` has, in the order of `values`, the meaning of each name, or (meaning, scale).
    """
    texts = {name: (text,) if isinstance(text, str) else text for name, text in names.items()}
    pairs = zip(texts.items(), values, strict=True)
    return described({name: (dims, array, *text) for (name, text), array in pairs})


def described(table: dict[str, tuple[Any, ...]]) -> Variables:
    """Return Dataset variables {name: (dims, array, attributes)} from a table.

    `table` is {name: (dims, values, meaning[, scale])}. Values are dimensionless numbers or words.
    """
    result = {}
    for name, (dims, values, *text) in table.items():
        array = np.asarray(values)
        words = array.dtype.kind in "OU"
        attributes = {"long_name": text[0]} if words else attributes_of(*text)
        result[name] = dims, array.astype(object) if words else array, attributes
    return result


def attributes_of(meaning: str, scale: str = "1") -> dict[str, str]:
    """Return long_name, units and scale: a variable's quantity is the number times the scale."""
    return {"long_name": meaning, "units": "1", "scale": scale}


def of_rows(table: dict[str, tuple[Any, ...]], rows: Iterable[Sequence[Any]]) -> Variables:
    """Return Dataset variables from rows of values in the order of `table`.

    `table` is {name: (dims, meaning[, scale])}; the first dim counts the rows.
    """
    columns = zip(table.items(), zip(*rows, strict=True), strict=True)
    return described({name: (dims, column, *text) for (name, (dims, *text)), column in columns})


def states_of(dataset: xr.Dataset) -> np.ndarray:
    """Return the states of a dataset as an array with the rows x, xdot, udot."""
    return np.stack([dataset[name].values for name in ("x", "xdot", "udot")])


def rows(dataset: xr.Dataset) -> list[slice]:
    """Return a slice for each row of a CF contiguous ragged array, from its `row_size`."""
    ends = [0, *np.cumsum(dataset["row_size"].values, dtype=np.int64).tolist()]
    return [slice(start, end) for start, end in pairwise(ends)]


def chart(k: float, x: Any, xdot: Any, udot: Any) -> np.ndarray:
    """Return the points (x, y = xdot - k udot) of states as an array (2, ...)."""
    return np.stack([x, xdot - k * udot])


def orbit_dims(shape: tuple[int, ...]) -> tuple[str, ...]:
    """Return the dim `orbit` of many orbits, or orbit_0, orbit_1, ... for more dimensions."""
    return ("orbit",) if len(shape) == 1 else tuple(f"orbit_{i}" for i in range(len(shape)))


class NoOrbitError(ValueError):
    """There is no periodic orbit of the requested type."""

    lasting = True


def of_type(orbits: xr.Dataset, kind: str, period: int | None = None) -> xr.Dataset:
    """Return the first orbit of a type, on `point`, among those of `symmetric_orbits`.

    Raises NoOrbitError if there is none, and ValueError if the orbits have another period.
    """
    if period not in (None, orbits.sizes["point"]):
        raise ValueError(f"orbits of period {orbits.sizes['point']}, not {period}")
    (matches,) = np.nonzero(orbits["type"].values == kind)
    if matches.size == 0:
        available = ", ".join(sorted(set(orbits["type"].values.tolist()))) or "none at all"
        raise NoOrbitError(
            f"no {kind} orbit of period {orbits.sizes['point']} "
            f"at energy {orbits.attrs['energy']:g} (found: {available})"
        )
    return orbits.isel(orbit=int(matches[0]))


def final_exponents(lyapunov: xr.Dataset) -> np.ndarray:
    """Return exponents (orbit, index) at each orbit's last record before NaN, the largest first."""
    exponent = lyapunov["exponent"].values
    recorded = ~np.isnan(exponent[:, :, 0])
    last = exponent.shape[0] - 1 - np.argmax(recorded[::-1], axis=0)
    return np.sort(exponent[last, np.arange(exponent.shape[1])], axis=1)[:, ::-1]


def with_parameters(dataset: xr.Dataset) -> xr.Dataset:
    """Make coordinates of the attributes k, g and energy, which `xarray.concat` would lose.

    Parameters
    ----------
    dataset : xarray.Dataset
        A result of a function of this package, or a file of the workflow.

    Returns
    -------
    xarray.Dataset
        With k (m R^2), g (omega^2 R) and energy (m omega^2 R^2) as scalar coordinates. An attribute
        stays one if a variable has its name.

    Raises
    ------
    ValueError
        It is no Dataset, or has no k and g.

    Examples
    --------
    >>> import xarray
    >>> from pseudorigid import Ball, symmetric_orbits, with_parameters
    >>> found = [symmetric_orbits(Ball(k=0.2, g=0.04), energy, 1) for energy in (0.001, 0.01)]
    >>> xarray.concat([with_parameters(orbits) for orbits in found], "energy")["energy"].values
    array([0.001, 0.01 ])
    """
    if not (isinstance(dataset, xr.Dataset) and {*"kg"} <= {*dataset.attrs, *dataset.variables}):
        raise ValueError("dataset is not allowed: a Dataset with the attributes k and g")
    named = dataset.attrs.keys() & PARAMETERS.keys() - dataset.variables.keys()
    values = {n: ((), dataset.attrs[n], attributes_of(*PARAMETERS[n])) for n in sorted(named)}
    result = dataset.assign_coords(values)
    result.attrs = {name: value for name, value in dataset.attrs.items() if name not in named}
    return result
