"""Datasets describe themselves; docs/data.md has their stages and attributes, its examples run."""

import re

import numpy as np
import pytest
import xarray as xr
from described import PAGE, assert_described, assert_describes_itself, stages_of
from test_documents import blocks, text_of

from pipeline.config.schema.parts import STAGES
from pipeline.records import artifacts
from pseudorigid import Ball, lyapunov_spectrum, orbit, symmetric_orbits, trace_manifold
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
    return path


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


def test_xarray_and_the_project_read_the_same(path):
    with xr.open_dataset(path) as data:
        assert data.load().identical(artifacts.load(path))


def test_datasets_of_the_python_api_have_the_same_attributes():
    six = symmetric_orbits(BALL, 0.01, 6)
    start = BALL.start([0.5], 0.01)
    orbits = orbit(BALL, start, 3)
    branch = trace_manifold(BALL, 0.01, six.isel(orbit=1), length=0.1)
    for data in (orbits, six, branch, lyapunov_spectrum(BALL, start, 3)):
        assert_described(data)
    scales = {name: orbits[name].attrs["scale"] for name in ("x", "xdot", "udot", "tau")}
    assert scales == {"x": "R", "xdot": "omega R", "udot": "omega", "tau": "1/omega"}
