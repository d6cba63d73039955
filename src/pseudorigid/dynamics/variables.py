"""What datasets of orbits are made of: names, variables, dims; and what is picked out of them."""

import numpy as np

NAMES = {
    "x": "position at impact, downwards",
    "xdot": "velocity of the mass centre just before impact",
    "udot": "strain rate just before impact",
    "tau": "time of flight since the previous impact",
}


def variables(dims, values, names=NAMES):
    """Dataset variables from arrays: {name: (dims, array, attributes)}."""
    return {
        name: (dims, array, {"long_name": names[name], "units": "1"})
        for name, array in zip(names, values, strict=True)
    }


def orbit_dims(shape):
    """The dims of many orbits: `orbit`, or of more than one dimension `orbit_0`, `orbit_1`, ..."""
    return ("orbit",) if len(shape) == 1 else tuple(f"orbit_{i}" for i in range(len(shape)))


def of_type(orbits, kind, period=None):
    """The first orbit of this type, a Dataset on `point`; ValueError, saying what there is, where
    there is none, or where the orbits have another period than `period`.
    """
    if period not in (None, orbits.sizes["point"]):
        raise ValueError(f"orbits of period {orbits.sizes['point']}, not {period}")
    (matches,) = np.nonzero(orbits["type"].values == kind)
    if matches.size == 0:
        there = ", ".join(sorted(set(orbits["type"].values.tolist()))) or "none at all"
        raise ValueError(
            f"no {kind} orbit of period {orbits.sizes['point']} "
            f"at energy {orbits.attrs['energy']:g} (found: {there})"
        )
    return orbits.isel(orbit=int(matches[0]))


def final_exponents(lyapunov):
    """The exponents of each orbit at its last record, (orbit, index), of a history of exponents."""
    exponent = lyapunov["exponent"].values
    there = ~np.isnan(exponent[:, :, 0])
    last = exponent.shape[0] - 1 - np.argmax(there[::-1], axis=0)
    return exponent[last, np.arange(exponent.shape[1])]
