"""Conversion of numbers by public functions, by the rule in `help(pseudorigid)`."""

import datetime
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from functools import partial
from typing import NamedTuple

import numpy as np
import pandas
import pytest
import xarray as xr

from pseudorigid import (
    Ball,
    classify_orbits,
    lyapunov_spectrum,
    motion,
    orbit,
    periodic_orbits,
    residue,
    rotation_number,
    symmetric_orbits,
    trace_manifold,
)
from pseudorigid.dynamics.ensemble import ImpactMap
from pseudorigid.dynamics.orbits import scene_orbits

BALL = Ball(0.25, 0.0625)
SADDLE = symmetric_orbits(Ball(0.2, 0.04), 0.01, 6).isel(orbit=1)


def trace(**arguments):
    short = {"length": 0.125, "distance": 0.0625, "bend": 32.0}
    return trace_manifold(Ball(0.2, 0.04), 0.01, SADDLE, **short | arguments)


def values_of(found):
    """Return the values of a function's result."""
    if isinstance(found, xr.Dataset):
        return [found[variable].values for variable in sorted(found.data_vars)]
    if isinstance(found, Ball):
        return [found.k, found.g]
    if isinstance(found, ImpactMap):
        return list(found.scan)
    return list(found) if isinstance(found, tuple) else [found]


class Case(NamedTuple):
    """An argument of a function, and the values of all its arguments."""

    name: str
    function: Callable
    arguments: dict

    @property
    def value(self):
        return self.arguments[self.name]

    def results(self, value):
        """Return the values of the function's result for another value of the argument."""
        return values_of(self.function(**self.arguments | {self.name: value}))


def cases(function, **arguments):
    """Return a case for each argument."""
    return [Case(name, function, arguments) for name in arguments]


STATE = {"x": 0.125, "xdot": 0.25, "udot": 0.5}
START = tuple(STATE.values())
FUNCTIONS_OF_STATES = [
    BALL.energy,
    BALL.reflect,
    BALL.time_to_impact,
    BALL.impact,
    BALL.inverse_impact,
    BALL.jacobian,
    lambda x, xdot, udot: orbit(BALL, (x, xdot, udot), 3, keep="last"),
    lambda x, xdot, udot: lyapunov_spectrum(BALL, (x, xdot, udot), 3, 1),
]
COORDINATES = [case for function in FUNCTIONS_OF_STATES for case in cases(function, **STATE)]
COORDINATES += cases(BALL.state, x=0.125, xdot=0.125, energy=0.03125)
COORDINATES += cases(BALL.state_xy, x=0.125, y=0.0625, energy=0.03125)
COORDINATES += cases(BALL.start, fraction=0.25, energy=0.03125)
COORDINATES += cases(lambda energy: BALL.section(energy)[1], energy=0.03125)
NUMBERS = [
    *cases(Ball, k=0.5, g=0.25),
    *cases(lambda step, tolerance: ImpactMap((step, tolerance)), step=0.25, tolerance=0.5),
    *cases(partial(BALL.state, 0.125, 0.25, 0.03125), branch=-1.0),
    *cases(partial(symmetric_orbits, BALL, period=1), energy=0.03125),
    *cases(partial(periodic_orbits, BALL, period=1), energy=0.03125),
    *cases(trace, length=0.125, distance=0.0625, bend=32.0),
]
COUNTS = [
    *cases(partial(orbit, BALL, START), impacts=3),
    *cases(partial(BALL.jacobian, *START), impacts=3),
    *cases(partial(BALL.chart_jacobian, *START), impacts=3),
    *cases(partial(lyapunov_spectrum, BALL, START), impacts=9, records=3),
    *cases(partial(symmetric_orbits, BALL, 0.03125), period=1),
    *cases(partial(periodic_orbits, BALL, 0.03125), period=1),
    *cases(trace, saddle=3),
]
INVALID = (
    True, "0.25", b"1", None, 0.25 + 0j, {}, datetime.date(2020, 1, 1), np.timedelta64(1, "ns"),
    np.array(True), 10**400, -(10**5000), Decimal("sNaN"), Fraction(10**400), xr.DataArray(True),
    SADDLE, pandas.NA, lambda: 1.0, [True, 0.25], ["0.25", 0.25], [0.25, 1j], [[1], [1, 2]],
    np.array(["0.25"]), pandas.Series(["a"]), np.array([0.25, None]), np.zeros(2, dtype="f8, f8"),
)  # fmt: skip


def same(found, expected):
    pairs = zip(found, expected, strict=True)
    return all(np.asarray(a).tobytes() == np.asarray(b).tobytes() for a, b in pairs)


OUT_OF_RANGE = {"saddle": [6], "energy": [0.0625], "k": [0.0, 1.0000001], "bend": [0.0, 180.0]}


@pytest.mark.parametrize("case", [*COORDINATES, *NUMBERS, *COUNTS])
def test_other_values_are_rejected_in_one_line(case):
    bad = [*INVALID]
    if case not in COORDINATES:  # one finite number within a range
        bad += [np.nan, np.inf, -np.inf, np.ma.masked, Decimal("NaN")]
        bad += [[], [case.value], np.array([case.value] * 2), *OUT_OF_RANGE.get(case.name, [0.0])]
        bad += [-2.5, 200.5, 2**53 + 1] if case in COUNTS else [-0.25]
    for value in bad:
        with pytest.raises(ValueError, match=rf"^{case.name} = .* is not allowed: ") as error:
            case.results(value)
        assert "\n" not in str(error.value) and len(str(error.value)) < 160


QUICK = [case for case in (*COORDINATES, *NUMBERS, *COUNTS)
         if getattr(case.function, "func", None) != periodic_orbits]  # fmt: skip


@pytest.mark.parametrize("case", QUICK)
def test_the_type_of_a_number_is_irrelevant(case):
    value = case.value
    kinds = [np.float64, np.float16, np.longdouble, Decimal, Fraction, np.array, xr.DataArray]
    kinds += [int, np.int8] if value == int(value) else []
    for kind in kinds:
        assert same(case.results(kind(value)), case.results(value)), kind


@pytest.mark.parametrize("case", COORDINATES)
def test_a_coordinate_that_is_not_finite_gives_nan_only_there(case):
    value = case.value
    expected = [np.asarray(a).ravel() for a in case.results(value)]
    arrays = [[value, bad, value] for bad in (np.nan, np.inf, -np.inf, np.ma.masked)]
    arrays += [tuple(arrays[0]), np.float32(arrays[0]), pandas.Series(arrays[0])]
    arrays += [np.ma.array([value, 9.0, value], mask=[0, 1, 0]), xr.DataArray(arrays[0])]
    arrays += [[Decimal(value), Decimal("Infinity"), Fraction(value)]]
    for array in arrays:
        for found, one in zip(case.results(array), expected, strict=True):
            orbits = np.moveaxis(np.asarray(found), np.shape(found).index(3), 0)
            if np.shape(found)[:2] == (1, 3):  # the exponents, on (impact, orbit, index)
                orbits = found[0]
            assert np.isnan(orbits[1]).all()
            assert orbits[0].tobytes() == orbits[2].tobytes() == one.tobytes()
    for bad in (np.nan, np.inf, -np.inf, np.ma.masked):
        for found in case.results(bad):
            assert np.isnan(found).all()


@pytest.mark.parametrize("call", FUNCTIONS_OF_STATES)
def test_each_element_has_the_bits_of_the_scalar_call(call):
    """The arrays are read-only, and in order of columns, strided, and to be broadcast."""
    x = np.asfortranarray(np.linspace(-0.3, 0.3, 12).reshape(3, 4))
    state = x, np.array(0.1), np.linspace(0.1, 0.3, 8)[::2]
    for array in state:
        array.flags.writeable = False
    found = values_of(call(*state))
    x, xdot, udot = np.broadcast_arrays(*state)
    for i in np.ndindex(3, 4):
        for all_of, alone in zip(found, values_of(call(x[i], xdot[i], udot[i])), strict=True):
            assert all_of.dtype == np.float64 and type(alone) in (float, np.ndarray)
            assert np.reshape(all_of, (3, 4, -1))[i].tobytes() == np.asarray(alone).tobytes()


@pytest.mark.parametrize("call", FUNCTIONS_OF_STATES)
def test_states_that_do_not_fit_together_or_the_section_are_rejected(call):
    with pytest.raises(ValueError, match="broadcast"):
        call(np.zeros(2), np.zeros(3), 0.1)
    for udot in (-0.2, [0.2, -0.2], np.nextafter(-0.1, -1.0)):
        if call != BALL.energy:
            with pytest.raises(ValueError, match=r"xdot \+ udot"):
                call(0.1, 0.1, udot)


@pytest.mark.filterwarnings("error")
def test_a_flight_that_is_too_long_is_an_error_for_one_state_and_nan_in_an_array():
    slow, long, short = Ball(0.25, 1e-8), (0.0, 0.0, 0.25), (0.0, 1e-9, 1e-9)
    message = r"^a flight lasts 2\^20/omega or longer: take a larger"
    for call in (slow.impact, slow.time_to_impact, lambda *state: orbit(slow, state, 3)):
        with pytest.raises(ValueError, match=message):
            call(*long)
    both = np.array([long, short]).T
    assert np.isnan(slow.time_to_impact(*both)).tolist() == [True, False]
    for keep in ("all", "last"):
        x = orbit(slow, both, 3, keep=keep)["x"]
        assert np.isnan(x).any("impact" if keep == "all" else None).values.any()
        assert np.isfinite(x.isel(orbit=1)).all()


OF_A_STATE = orbit, lyapunov_spectrum, rotation_number, classify_orbits
OF_A_BALL = [partial(function, state=START, impacts=100) for function in OF_A_STATE]
SEARCHES = symmetric_orbits, periodic_orbits
OF_A_BALL += [partial(search, energy=0.01, period=1) for search in SEARCHES]
OF_A_BALL += [partial(motion, start=START, duration=1.0)]
OF_A_BALL += [partial(trace_manifold, energy=0.01, orbit=SADDLE)]


@pytest.mark.parametrize(("name", "function", "allowed", "values"), [
    ("keep", partial(orbit, BALL, START, 3), "'all' or 'last'", ("some", None, ["all"])),
    ("side", lambda side: trace(side=side), "'inner' or 'outer'", ("left", np.ones(2))),
    ("stable", lambda stable: trace(stable=stable), "True or False", ("no", 1, np.ones(2))),
    ("window", lambda window: trace(window=window), r"\(x_low, ",
     (3, (0, 1, 2), (1, 0, 0, 1), (0, 1, 0, np.nan), "abcd", (0, 1, 0, [1]))),
    ("orbit", partial(trace_manifold, BALL, 0.01), "a Dataset with x",
     (None, "orbit", SADDLE.drop_vars("udot"))),
    ("orbits", residue, "a Dataset with trace", (None, 3, SADDLE.drop_vars("trace"))),
    ("start", partial(motion, BALL, duration=1.0), "one state or one orbit",
     (SADDLE.drop_vars("x"), SADDLE.isel(point=[]), SADDLE.expand_dims("orbit"),
      SADDLE.drop_vars("multiplier"))),
    ("state", partial(BALL.after, impacts=3), r"\(x, xdot, udot\)", (None, 3, (1, 2), "ab")),
    ("scan", ImpactMap, r"None, or \(step", (3, (0.1,))),
    ("map", partial(Ball, 0.2, 0.04), "an ImpactMap", (None, (0.1, 1e-6))),
    *(("ball", call, "a Ball", (None, (0.2, 0.04), 0.2, Ball, SADDLE)) for call in OF_A_BALL),
])  # fmt: skip
def test_other_words_and_objects_are_rejected(name, function, allowed, values):
    for value in values:
        with pytest.raises(ValueError, match=rf"^{name} = .* is not allowed: {allowed}"):
            function(value)


def test_a_periodic_orbit_of_another_ball_is_refused():
    balls = {"k = 0.2, not 0.25": Ball(0.25, 0.04), "g = 0.04, not 0.05": Ball(0.2, 0.05)}
    calls = (
        partial(motion, start=SADDLE, duration=1.0),
        partial(trace_manifold, energy=0.01, orbit=SADDLE),
    )
    for words, ball in balls.items():
        for call in calls:
            with pytest.raises(ValueError, match=f"^the orbit is of another ball, with {words}$"):
                call(ball)


@pytest.mark.parametrize("start", [0.5, [0.5, -0.25, 0.75], [[0.5, -0.25]]])
def test_an_orbit_continues_from_a_dataset(start):
    """It has the bits of the whole orbit, for any order of dims."""
    state = BALL.start(start, 0.01)
    whole, first = (orbit(BALL, state, impacts).drop_vars("impact") for impacts in (50, 20))
    for before in (first, orbit(BALL, state, 20, keep="last"), first.transpose(*first.sizes)):
        rest = orbit(BALL, before, 30).drop_vars("impact")
        assert rest.equals(whole.isel(impact=slice(20, None)))
    assert np.array_equal(orbit(BALL, first.isel(impact=4), 3)["x"], whole["x"][5:8])
    last = [first[name].values[-1] for name in STATE]
    assert lyapunov_spectrum(BALL, first, 9, 1).equals(lyapunov_spectrum(BALL, last, 9, 1))


def test_an_orbit_continues_from_a_periodic_orbit_and_a_scene():
    ball = Ball(0.2, 0.04)
    again = orbit(ball, SADDLE, 6)  # from the last point on
    assert np.allclose(again["x"], SADDLE["x"], atol=1e-13)
    scene = scene_orbits(ball, 0.01, [0.5, -0.2], [3, 2])
    whole = orbit(ball, ball.start([0.5, -0.2], 0.01), 9)["x"].values
    rest = orbit(ball, scene, 4)["x"].values
    assert np.array_equal(rest, np.stack([whole[3:7, 0], whole[2:6, 1]], axis=1))


SHORT_SCENE = scene_orbits(BALL, 0.01, [0.5, -0.2], [3, 2]).isel(point=slice(0, 3))


@pytest.mark.parametrize(
    "state", [SADDLE.drop_vars("udot"), SADDLE.isel(point=[]), SHORT_SCENE, None, (0.1, 0.2), "ab"]
)
def test_invalid_states_are_rejected_in_one_line(state):
    for call in (orbit, lyapunov_spectrum):
        with pytest.raises(ValueError, match=r"^state(:| = .* is not allowed)") as error:
            call(BALL, state, 3)
        assert "\n" not in str(error.value)


def test_results_beyond_memory_are_rejected():
    with pytest.raises(ValueError, match=r"^impacts = .* is not allowed: fewer"):
        orbit(BALL, (0.125, 0.25, 0.5), 2**52)
    with pytest.raises(ValueError, match=r"^records = .* is not allowed: fewer"):
        lyapunov_spectrum(BALL, (0.125, 0.25, 0.5), 2**52, 2**52)


def test_a_map_that_may_miss_impacts_is_refused_where_none_may_be_missed():
    scan = Ball(0.2, 0.04, map=ImpactMap((0.3, 1e-12)))
    for call in (rotation_number, classify_orbits):
        call(BALL, BALL.start(0.3, 0.01), 100)
        with pytest.raises(ValueError, match=r"^ball.map = .* is not allowed: the default"):
            call(scan, BALL.start(0.3, 0.01), 100)
