"""Datasets describe themselves; docs/data.md has their stages and attributes, its examples run."""

import re

import numpy as np
import pytest
import xarray as xr

from helpers.described import PAGE, assert_described, assert_describes_itself, stages_of
from helpers.pages import blocks, text_of
from pipeline.config.schema.parts import STAGES
from pipeline.records import artifacts
from pseudorigid import (
    Ball,
    classify_orbits,
    lyapunov_spectrum,
    motion,
    orbit,
    symmetric_orbits,
    trace_manifold,
    with_parameters,
)
from pseudorigid.dynamics.lyapunov import scene_exponents
from pseudorigid.dynamics.orbits import scene_orbits

BALL = Ball(0.2, 0.04)


def test_datasets_of_the_papers_figures_describe_themselves(finished):
    files = (finished.path / "results" / "paper").glob("*.nc")
    assert {assert_describes_itself(file) for file in files} == stages_of("pseudorigid.")


def test_the_page_has_each_stage():
    """Also those of the extensions of this repository, as far as they are there."""
    rows = re.findall(r"^\| (`.*?) \|", text_of(PAGE), re.M)
    named = [name for row in rows for name in re.findall(r"`(\w+)`", row)]
    assert len(set(named)) == len(named) and set(STAGES) <= set(named)


@pytest.fixture
def path(tmp_path):
    """A small dataset where the page's examples read it."""
    data = scene_orbits(BALL, 0.01, [0.1, -0.2, 0.6], [30, 20, 25])
    path = tmp_path / "results" / "paper" / "orbits_fig2.nc"
    artifacts.save(data, path, {}, k=0.2, g=0.04, energy=0.01, title="orbits")
    for variant, energy in VARIANTS.items():
        file = tmp_path / "results" / variant / "lyapunov_fig7.nc"
        artifacts.save(exponents_at(energy), file, {}, k=0.2, g=0.04, energy=energy)
    return path


VARIANTS = {"paper": 0.01, "low": 0.001}


def exponents_at(energy):
    return scene_exponents(BALL, energy, [0.6, 0.65], 100, 4)


def test_the_examples_in_python_run(path, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks(PAGE):
        if not block.startswith("ncdump"):
            exec(block, names)
    printed = capsys.readouterr().out
    assert "xdot:scale = omega R ;" in printed and "time of flight" in printed
    assert ":references = E. Kanso and P. Papadopoulos" in printed
    data = artifacts.load(path)
    assert np.array_equal(names["second"]["x"], data["x"][30:50])
    means = names["table"].groupby("orbit")["tau"].mean()
    assert np.allclose(means, [part.mean() for part in np.split(data["tau"].values, [30, 50])])
    start = BALL.start(-0.2, 0.01)
    assert np.array_equal(names["more"]["x"][:, 1], orbit(BALL, start, 120)["x"][20:])
    assert names["both"]["energy"].values.tolist() == [0.01, 0.001]
    for energy in VARIANTS.values():
        alone = exponents_at(energy)
        assert np.array_equal(names["both"]["exponent"].sel(energy=energy), alone["exponent"])


def test_xarray_and_the_project_read_the_same(path):
    with xr.open_dataset(path) as data:
        assert data.load().identical(artifacts.load(path))


def test_results_say_what_they_were_computed_for():
    six = symmetric_orbits(BALL, 0.01, 6)
    start, about = BALL.start([0.5], 0.01), {"k": 0.2, "g": 0.04}
    functions = (orbit, lyapunov_spectrum, classify_orbits)
    results = [function(BALL, start, 100) for function in functions]
    results.append(motion(BALL, six.isel(orbit=0), 1.0))
    assert all(result.attrs == about for result in results)
    for result in (six, trace_manifold(BALL, 0.01, six.isel(orbit=1), length=0.1)):
        assert about.items() | {("energy", 0.01)} <= result.attrs.items()


def test_parameters_as_coordinates_are_written_and_combined(tmp_path):
    found = [with_parameters(symmetric_orbits(BALL, energy, 1)) for energy in (0.01, 0.001)]
    both = xr.concat(found, "energy")
    assert both["energy"].values.tolist() == [0.01, 0.001] and both["k"] == 0.2
    assert "energy" not in both.attrs and both.attrs["period"] == 1
    both.to_netcdf(tmp_path / "both.nc")
    with xr.open_dataset(tmp_path / "both.nc") as read:
        assert read.load().equals(both)
    assert with_parameters(found[0]).identical(found[0])
    grid = xr.Dataset(
        {"energy": ("energy", [0.01, 0.02])}, attrs={"k": 0.2, "g": 0.04, "energy": 1}
    )
    assert with_parameters(grid).attrs == {"energy": 1}


@pytest.mark.parametrize("value", [3, xr.Dataset(), xr.Dataset(attrs={"k": 0.2})])
def test_what_does_not_say_its_ball_has_no_parameters(value):
    with pytest.raises(ValueError, match=r"^dataset is not allowed: a Dataset with .* k and g$"):
        with_parameters(value)


def test_datasets_of_the_python_api_have_the_same_attributes():
    six = symmetric_orbits(BALL, 0.01, 6)
    start = BALL.start([0.5], 0.01)
    orbits = orbit(BALL, start, 3)
    branch = trace_manifold(BALL, 0.01, six.isel(orbit=1), length=0.1)
    for data in (orbits, six, branch, lyapunov_spectrum(BALL, start, 3)):
        assert_described(data)
    scales = {name: orbits[name].attrs["scale"] for name in ("x", "xdot", "udot", "tau")}
    assert scales == {"x": "R", "xdot": "omega R", "udot": "omega", "tau": "1/omega"}
