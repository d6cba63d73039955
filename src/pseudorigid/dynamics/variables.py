"""What datasets of orbits are made of: names, variables, dims."""

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
