"""Each function of the public API has an example, quantities are right; bad input is one line."""

import inspect
import math
import re

import numpy as np
import pytest
import yaml

import pseudorigid
from helpers.project import ROOT
from pseudorigid import Ball, symmetric_orbits

BALL = Ball(k=0.2, g=0.04)
REGULAR, CHAOTIC = -0.2, 0.6  # starts at E = 0.01, in section radii


@pytest.mark.parametrize("name", pseudorigid.__all__)
def test_each_function_has_an_example(name):
    assert f"{name}(" in inspect.getdoc(getattr(pseudorigid, name)).partition(">>> ")[2]


def with_parameters_of_their_own():
    """The functions of the API, and the public methods of its classes."""
    for name in pseudorigid.__all__:
        value = getattr(pseudorigid, name)
        yield value
        if inspect.isclass(value):
            members = inspect.getmembers(value, inspect.isfunction)
            yield from (method for own, method in members if not own.startswith("_"))


@pytest.mark.parametrize(
    "function", [*with_parameters_of_their_own()], ids=lambda f: f.__qualname__
)
def test_each_parameter_is_described(function):
    names = {name for name in inspect.signature(function).parameters if name != "self"}
    section = inspect.getdoc(function).partition("Parameters\n----------\n")[2].partition("\n\n")[0]
    lines = re.findall(r"^(?=\S)([\w*, ]+)(?: : .+)?$", section, re.M)
    assert {name.strip("* ") for line in lines for name in line.split(",")} == names


def test_the_rotation_number_tends_to_that_of_the_fixed_point():
    fixed_point = symmetric_orbits(BALL, 0.01, 1).isel(orbit=0)
    near = BALL.state_xy(float(fixed_point["x"][0]) + 1e-5, 0.0, 0.01)
    expected = float(fixed_point["rotation_number"])
    assert pseudorigid.rotation_number(BALL, near) == pytest.approx(expected, abs=1e-8)


def test_the_rotation_number_keeps_shape_and_knows_several_energies():
    energies = np.array([[0.01], [0.001]])
    states = BALL.start([[REGULAR, math.nan]] * 2, energies)
    numbers = pseudorigid.rotation_number(BALL, states)
    assert numbers.shape == (2, 2) and np.isnan(numbers[:, 1]).all()
    for row, energy in enumerate(energies[:, 0]):
        alone = pseudorigid.rotation_number(BALL, BALL.start(REGULAR, energy))
        assert isinstance(alone, float) and alone == numbers[row, 0]


def test_the_residue_tells_the_types_apart():
    six = symmetric_orbits(BALL, 0.01, 6)
    elliptic, hyperbolic, inverse = pseudorigid.residue(six).values
    assert 0 < elliptic < 1 and hyperbolic < 0 and inverse > 1
    turns = float(six["rotation_number"][0])
    assert elliptic == pytest.approx(math.sin(math.pi * turns) ** 2)  # Greene 1979
    assert pseudorigid.residue(six.isel(orbit=0)).shape == ()


def test_a_motion_of_a_periodic_orbit_has_its_impacts_again_and_again():
    six = symmetric_orbits(BALL, 0.01, 6).isel(orbit=0)
    cycle = pseudorigid.motion(BALL, six, 2 * float(six["total_time"]))["impact_position"].values
    assert np.array_equal(cycle[:12], np.tile(six["x"], 2))


STATE = BALL.start(REGULAR, 0.01)


@pytest.mark.parametrize(("name", "arguments", "words"), [
    ("rotation_number", (BALL, 1), "state = 1 "),
    ("rotation_number", (BALL, STATE, 99), "impacts = 99 "),
    ("classify_orbits", (BALL, (0.1, -1.0, 0.0)), "a state just before an impact"),
    ("motion", (BALL, BALL.start([REGULAR, CHAOTIC], 0.01), 1.0), "start = "),
    ("motion", (BALL, STATE, -1.0), "duration = -1.0 "),
])  # fmt: skip
def test_bad_input_is_one_line(name, arguments, words):
    with pytest.raises(ValueError) as raised:
        getattr(pseudorigid, name)(*arguments)
    assert str(raised.value).startswith(words) and "\n" not in str(raised.value)


def test_the_version_is_that_of_the_project_and_other_names_are_refused():
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))["version"]
    assert pseudorigid.__version__ == cited and "__version__" in dir(pseudorigid)
    with pytest.raises(AttributeError, match="module 'pseudorigid' has no attribute 'Bal'"):
        pseudorigid.Bal  # noqa: B018
