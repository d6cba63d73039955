"""Synthetic data for each of the paper's kinds of picture."""

from functools import cache
from importlib import import_module

import numpy as np
import xarray as xr

from pipeline.config.schema.kinds import KINDS as DRAWN_BY

VIEW = {"elevation": 40, "azimuth": 115}
SPACE = {
    "x": {"limits": [-0.2, 0.6], "ticks": [-0.2, 0, 0.2, 0.4]},
    "xdot": {"limits": [-0.4, 0.4], "ticks": [-0.4, -0.2, 0, 0.2, 0.4]},
    "udot": {"limits": [-0.2, 0.4], "ticks": [-0.1, 0.1, 0.3]},
}
FLAT = {
    "x": {"limits": [-0.05, 0.45], "ticks": [0, 0.2, 0.4]},
    "xdot": {"limits": [-0.1, 0.1], "ticks": [-0.05, 0.05]},
    "udot": {"limits": [-0.1, 0.25], "ticks": [-0.05, 0.05, 0.15]},
}
SCENES = {
    "portrait": {"axes": SPACE, "view": VIEW},
    "tangle": {"axes": SPACE, "view": VIEW, "type": "hyperbolic"},
    "motion": {
        "axes": {
            "t": {"limits": [0, 16], "ticks": [0, 2, 4, 6, 8, 10, 12, 14, 16]},
            "displacement": {"limits": [-0.4, 0.2], "ticks": [-0.4, -0.2, 0, 0.2]},
        }
    },
    "closeup": {
        "axes": {
            "x": {"limits": [0.21, 0.2116], "ticks": [0.21, 0.2116]},
            "xdot": {"limits": [0.0925, 0.0932], "ticks": [0.0925, 0.0932]},
        }
    },
    "exponents": {
        "starts": [0.6, 0.62, 0.65],
        "axes": {
            "impact": {"limits": [0, 200000], "ticks": list(range(0, 200001, 20000))},
            "exponent": {"limits": [-0.3, 0.3], "ticks": [-0.2, -0.1, 0, 0.1, 0.2, 0.3]},
        },
    },
}
for scene in SCENES.values():
    scene |= {"energy": 0.01, "ball": {"k": 0.2, "g": 0.04}}
KINDS = list(SCENES)
ATTRS = {"k": 0.2, "g": 0.04, "energy": 0.01}


def states(count, seed):
    """Random states on the energy surface, computed without library functions."""
    k, g, energy = ATTRS["k"], ATTRS["g"], ATTRS["energy"]
    radius = np.sqrt(2 * energy + g * g / k)
    x, y = np.random.default_rng(seed).uniform(-0.7, 0.7, (2, count)) * radius
    s = np.sqrt((radius * radius - x * x - y * y) * (1 + k) / k)
    x, y = g / k + x / np.sqrt(k), y * np.sqrt(1 + k)
    return {"x": x, "xdot": (y + k * s) / (1 + k), "udot": (s - y) / (1 + k)}


def orbits(sizes=(300, 200, 900)):
    variables = {name: ("point", value) for name, value in states(sum(sizes), 1).items()}
    variables["row_size"] = ("orbit", np.array(sizes, dtype=np.int32))
    variables["type"] = ("orbit", ["regular", "regular", "chaotic"])
    return xr.Dataset(variables, attrs=ATTRS)


def manifolds():
    state = states(400, 2)
    for name in state:
        state[name] = np.sort(state[name])
        state[name][100:103] = np.nan
    variables = {name: ("vertex", value) for name, value in state.items()}
    variables["row_size"] = ("branch", np.array([250, 150], dtype=np.int32))
    variables["stable"] = ("branch", np.array([0, 1], dtype=np.int8))
    return xr.Dataset(variables, attrs=ATTRS)


def periodic():
    state = states(12, 3)
    variables = {name: (("orbit", "point"), value.reshape(2, 6)) for name, value in state.items()}
    variables["type"] = ("orbit", ["elliptic", "hyperbolic"])
    return xr.Dataset(variables, attrs=ATTRS)


def window():
    along = np.linspace(0.2, 0.22, 500)
    wiggle = 0.0929 + (along - 0.211) * 0.4 + (along - 0.2105) * (along - 0.2115) * 90
    both = {"x": np.tile(along, 2), "xdot": np.concatenate([wiggle, 0.1858 - wiggle])}
    variables = {name: ("vertex", value) for name, value in both.items()}
    variables["row_size"] = ("branch", np.array([500, 500], dtype=np.int32))
    variables["stable"] = ("branch", np.array([0, 1], dtype=np.int8))
    return xr.Dataset(variables, attrs=ATTRS | {"point_x": 0.211, "point_xdot": 0.0929})


def motion(flights=5, length=3.1, samples=40):
    s = np.tile(np.linspace(0, 1, samples), flights)
    start = np.repeat(np.arange(flights), samples)
    x = 0.0212 - 0.19 * s * (1 - s)
    variables = {
        "t": ("sample", (start + s) * length),
        "position": ("sample", x),
        "strain": ("sample", -x - 1.2 * s * (1 - s)),
        "impact_t": ("impact", np.arange(flights + 1) * length),
        "impact_position": ("impact", np.full(flights + 1, 0.0212)),
    }
    return xr.Dataset(variables, attrs=ATTRS)


def exponents():
    impact = np.arange(1, 201) * 1000
    walk = np.random.default_rng(4).uniform(-1, 1, (200, 3)).cumsum(axis=0) / impact[:, None]
    history = np.stack([0.232 + walk, 0.5 / impact[:, None] + 0 * walk, -0.232 - walk], axis=2)
    variables = {"exponent": (("impact", "orbit", "index"), history)}
    variables["type"] = ("orbit", ["chaotic"] * 3)
    return xr.Dataset(variables, coords={"impact": impact}, attrs=ATTRS)


DATA = {
    "portrait": lambda: (orbits(),),
    "tangle": lambda: (orbits(), manifolds(), periodic()),
    "motion": lambda: (motion(),),
    "closeup": lambda: (window(),),
    "exponents": lambda: (exponents(),),
}


def module(kind):
    """The module that draws a kind of picture."""
    return import_module(DRAWN_BY[kind].drawn_by.rpartition(".")[0])


def draw(kind):
    return module(kind).draw(SCENES[kind], *DATA[kind]())


@cache
def drawn(kind):
    """The figure of a kind, drawn once for all tests that do not change it."""
    return draw(kind)
